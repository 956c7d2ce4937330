//! The syntax of hry: text to tokens, to a tree that keeps every character, and to the abstract syntax.
//!
//! - `lexer`: tokens, and what is said about characters.
//! - `brackets`: which brackets belong together, decided before anything is parsed.
//! - `parser`: the nodes; goes on after an error.
//! - `tree`: the nodes as a list, and as the lossless tree.
//! - `lower`: the abstract syntax.
//! - `complaint`: all messages.
//!
//! All of it takes time in proportion to the text, and limits how deep anything is nested, so that whoever walks over the
//! tree may recurse.

mod brackets;
pub(crate) mod complaint;
mod kind;
mod lexer;
mod lower;
mod parser;
mod tree;

pub use kind::{Hry, SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};

use super::ast::{ExprKind, Module};
use crate::diagnostic::{Diagnostic, Span};
pub(super) use lexer::{Token, trivia};
use std::sync::Arc;
pub(super) use tree::{Node, children_reversed};

/// The largest text that is read, in bytes.
const LARGEST: usize = 1 << 30;

/// A text that was read.
#[derive(Clone, Debug)]
pub struct Parse {
    text: Arc<str>,
    base: usize,
    tokens: Vec<Token>,
    nodes: Vec<Node>,
    errors: Vec<Diagnostic>,
}

/// Reads a text, whatever it is. `base` is the offset of its first byte: it is added to every span.
///
/// What cannot be read is reported, and is an [`ErrorExpr`](SyntaxKind::ErrorExpr) or the like in the tree. A text of more
/// than a gibibyte is not read at all.
#[must_use]
pub fn parse(text: &str, base: usize) -> Parse {
    if text.len() > LARGEST {
        let error =
            Diagnostic::error("file-too-large", "this file is too large", Span::at(base), "more than 1 GiB");
        let errors = vec![error];
        return Parse { text: Arc::from(""), base, tokens: Vec::new(), nodes: Vec::new(), errors };
    }
    let (mut tokens, mut errors) = lexer::lex(text, base);
    let brackets = brackets::check(base, &mut tokens);
    let (nodes, found) = parser::parse(text, base, &tokens, &brackets);
    errors.extend(tight_comments(text, base, &tokens));
    errors.extend(brackets.errors);
    errors.extend(found);
    let errors = complaint::tidy(text, base, errors);
    Parse { text: Arc::from(text), base, tokens, nodes, errors }
}

/// Comments that were meant to be two minus signs: `3--2`.
fn tight_comments(text: &str, base: usize, tokens: &[Token]) -> Vec<Diagnostic> {
    let tight = tokens.iter().filter(|token| {
        let is_value = matches!(token.kind, SyntaxKind::Number | SyntaxKind::Name | SyntaxKind::CloseParen);
        let rest = text.get(token.end as usize..).and_then(|rest| rest.strip_prefix("--"));
        is_value && rest.is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit() || c == '('))
    });
    tight.map(|token| complaint::characters::tight_comment(Span::at(base + token.end as usize))).collect()
}

impl Parse {
    /// The abstract syntax. Definitions that could be read are in it, whatever else is wrong.
    #[must_use]
    pub fn module(&self) -> Module {
        let mut module = lower::module(&self.text, self.base, &self.tokens, &self.nodes);
        // What is left of a value without a character that means nothing may mean anything.
        for error in self.errors.iter().filter(|error| error.code == "unknown-character") {
            let place = error.primary.span.start;
            let around = module
                .definitions
                .iter_mut()
                .find(|definition| definition.span.start <= place && place < definition.span.end);
            if let Some(definition) = around {
                definition.body.kind = ExprKind::Error;
            }
        }
        module
    }

    /// What is wrong with the text, in its order; the twenty first errors at most.
    #[must_use]
    pub fn errors(&self) -> &[Diagnostic] {
        &self.errors
    }

    /// The tokens and the nodes over them.
    pub(super) fn parts(&self) -> (&[Token], &[Node]) {
        (&self.tokens, &self.nodes)
    }

    /// The lossless tree: its text is the text that was read. Its offsets begin at 0.
    #[must_use]
    pub fn root(&self) -> SyntaxNode {
        tree::lossless(&self.text, &self.tokens, &self.nodes)
    }
}
