//! From the nodes to the abstract syntax.
//!
//! It trusts nothing about the shape of a node, since the parser leaves nodes incomplete where the text is: what is not
//! there becomes [`ExprKind::Error`](crate::hry::ast::ExprKind::Error) and its like.

mod expr;
mod literal;
mod pattern;

pub(crate) use literal::number;

use super::kind::SyntaxKind;
use super::lexer::Token;
use super::tree::{Node, children_reversed};
use crate::diagnostic::Span;
use crate::hry::ast::{Definition, Import, ImportNames, Module, Name, Pattern, PatternKind, TypeExpr};
use std::sync::Arc;

/// How many names are remembered so that equal ones share their text.
const REMEMBERED: usize = 1024;

/// The abstract syntax of a file.
pub(super) fn module(text: &str, base: usize, tokens: &[Token], nodes: &[Node]) -> Module {
    let mut lower = Lower { text, base, tokens, nodes, names: vec![None; REMEMBERED] };
    let Some(root) = nodes.len().checked_sub(1) else { return Module::default() };
    let items = lower.children(root as u32);
    let mut module = Module::default();
    for item in &items {
        if lower.kind(*item) == SyntaxKind::Import {
            module.imports.extend(lower.import(*item));
        }
    }
    module.definitions = lower.definitions(&items);
    module.definitions.retain(|definition| matches!(definition.target.kind, PatternKind::Name(_)));
    module
}

struct Lower<'t> {
    text: &'t str,
    base: usize,
    tokens: &'t [Token],
    nodes: &'t [Node],
    /// Names seen lately, by a hash of their text.
    names: Vec<Option<Arc<str>>>,
}

impl<'t> Lower<'t> {
    fn node(&self, node: u32) -> Node {
        let none = Node { kind: SyntaxKind::ErrorExpr, first_node: node, first_token: 0, end_token: 0 };
        self.nodes.get(node as usize).copied().unwrap_or(none)
    }

    fn kind(&self, node: u32) -> SyntaxKind {
        self.node(node).kind
    }

    fn children(&self, node: u32) -> Vec<u32> {
        let mut children: Vec<u32> = children_reversed(self.nodes, node).collect();
        children.reverse();
        children
    }

    fn token(&self, token: u32) -> Option<&'t Token> {
        self.tokens.get(token as usize)
    }

    fn token_kind(&self, token: u32) -> SyntaxKind {
        self.token(token).map_or(SyntaxKind::End, |token| token.kind)
    }

    fn token_text(&self, token: u32) -> &'t str {
        self.token(token)
            .and_then(|token| self.text.get(token.start as usize..token.end as usize))
            .unwrap_or("")
    }

    fn token_span(&self, token: u32) -> Span {
        self.token(token).map_or(Span::at(self.base + self.text.len()), |token| {
            Span::new(self.base + token.start as usize, self.base + token.end as usize)
        })
    }

    fn span(&self, node: u32) -> Span {
        let node = self.node(node);
        if node.first_token < node.end_token {
            self.token_span(node.first_token).to(self.token_span(node.end_token - 1))
        } else {
            let before = node.first_token.checked_sub(1);
            Span::at(before.map_or(self.base, |token| self.token_span(token).end))
        }
    }

    /// A name's text, shared with the same name seen lately.
    fn shared(&mut self, text: &str) -> Arc<str> {
        // The hash of Fowler, Noll and Vo; what it does to the order of anything is nothing.
        let hash = text
            .bytes()
            .fold(0x811c_9dc5_u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
        let Some(place) = self.names.get_mut(hash as usize % REMEMBERED) else { return Arc::from(text) };
        match place {
            Some(known) if **known == *text => known.clone(),
            _ => place.insert(Arc::from(text)).clone(),
        }
    }

    fn name(&mut self, token: u32) -> Name {
        Name { text: self.shared(self.token_text(token)), span: self.token_span(token) }
    }

    fn import(&mut self, node: u32) -> Option<Import> {
        let Node { first_token, end_token, .. } = self.node(node);
        let path = first_token + 1;
        if self.token_kind(path) != SyntaxKind::Text || path >= end_token {
            return None;
        }
        let mut names: Vec<Name> = Vec::new();
        for token in path + 1..end_token {
            if self.token_kind(token) == SyntaxKind::Name {
                names.push(self.name(token));
            }
        }
        let names = match self.token_kind(path + 1) {
            SyntaxKind::AsKeyword if path + 1 < end_token => ImportNames::As(names.into_iter().next()?),
            SyntaxKind::OpenParen if path + 1 < end_token => ImportNames::Listed(names),
            _ => ImportNames::All,
        };
        Some(Import {
            span: self.span(node),
            path: Arc::from(literal::text(self.token_text(path))),
            path_span: self.token_span(path),
            names,
        })
    }

    /// The definitions among some nodes, each with the annotation before it.
    fn definitions(&mut self, nodes: &[u32]) -> Vec<Definition> {
        let mut definitions = Vec::new();
        let mut annotation: Option<u32> = None;
        for node in nodes {
            match self.kind(*node) {
                SyntaxKind::Annotation => annotation = Some(*node),
                SyntaxKind::Definition => definitions.extend(self.definition(*node, annotation.take())),
                _ => annotation = None,
            }
        }
        definitions
    }

    fn definition(&mut self, node: u32, annotation: Option<u32>) -> Option<Definition> {
        let mut patterns: Vec<Pattern> = Vec::new();
        let mut body = None;
        for child in self.children(node) {
            let kind = self.kind(child);
            if body.is_some() {
                break;
            } else if kind.is_pattern() {
                patterns.push(self.pattern(child));
            } else if kind.is_expr() {
                body = Some(self.expr(child));
            }
        }
        let mut patterns = patterns.into_iter();
        let target = patterns.next()?;
        let first = self.node(node).first_token;
        let of_same_name = |lower: &Self, annotation: &u32| {
            lower.token_text(lower.node(*annotation).first_token) == lower.token_text(first)
        };
        let annotation = annotation.filter(|annotation| of_same_name(self, annotation));
        let above = annotation.and_then(|annotation| self.doc(self.node(annotation).first_token));
        let doc = above.or_else(|| self.doc(first));
        Some(Definition {
            target,
            parameters: patterns.collect(),
            body: body.unwrap_or_else(|| self.missing(node)),
            annotation: annotation.and_then(|annotation| self.annotation(annotation)),
            doc,
            span: self.span(node),
        })
    }

    fn annotation(&mut self, node: u32) -> Option<TypeExpr> {
        let annotation = self.children(node).into_iter().find(|child| self.kind(*child).is_type())?;
        Some(self.type_expr(annotation))
    }

    /// The `--|` lines directly above a token.
    fn doc(&self, token: u32) -> Option<Arc<str>> {
        let start = match token.checked_sub(1) {
            Some(before) => self.token(before)?.end as usize,
            None => 0,
        };
        let gap = self.text.get(start..self.token(token)?.start as usize)?;
        let mut above = gap.rsplit('\n');
        // What is before the token on its own line.
        above.next()?;
        let lines: Vec<&str> = above.map_while(|line| line.trim().strip_prefix("--|")).collect();
        // The first piece of the gap belongs to the line of the token before.
        let is_trailing = start > 0 && lines.len() == gap.matches('\n').count();
        let count = lines.len() - usize::from(is_trailing && !lines.is_empty());
        let lines: Vec<&str> =
            lines.into_iter().take(count).map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
        let mut lines = lines;
        lines.reverse();
        (!lines.is_empty()).then(|| Arc::from(lines.join("\n")))
    }
}
