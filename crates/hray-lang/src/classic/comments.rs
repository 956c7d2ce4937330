//! Comments, which the classic grammar does not have.
//!
//! They are skipped like white space, wherever they stand, and reported once: a file full of them has one
//! thing wrong with it, not a hundred.

use super::token::Token;
use crate::diagnostic::{Diagnostic, Span};
use logos::{Lexer, Skip};

/// The comments met so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Comments {
    first: Option<Span>,
    count: usize,
    /// That the rest of the file closes no block comment: to look again at every opening would take a time
    /// that grows with the square of the file.
    no_block_end: bool,
}

/// Skips the rest of a comment: up to its end, or to the end of the line.
pub(crate) fn skip_comment<'s>(lexer: &mut Lexer<'s, Token>) -> Skip {
    let rest = lexer.remainder();
    let block_end = match lexer.slice() {
        "{-" => Some("-}"),
        "/*" => Some("*/"),
        _ => None,
    };
    let mut length = None;
    if let Some(block_end) = block_end.filter(|_| !lexer.extras.no_block_end) {
        length = rest.find(block_end).map(|at| at + block_end.len());
        lexer.extras.no_block_end = length.is_none();
    }
    let length = length.or_else(|| rest.find('\n')).unwrap_or(rest.len());
    lexer.bump(length);
    lexer.extras.count += 1;
    if lexer.extras.first.is_none() {
        let span = lexer.span();
        lexer.extras.first = Some(Span::new(span.start, span.start + lexer.slice().trim_end().len()));
    }
    Skip
}

impl Comments {
    /// What there is to say about them.
    pub(crate) fn complaint(&self) -> Option<Diagnostic> {
        let error = Diagnostic::error(
            "comment",
            "the classic scene language has no comments",
            self.first?,
            "this reads like a comment",
        );
        Some(match self.count {
            1 => error.with_help("remove it"),
            2 => error.with_help("remove it, and the other one further on"),
            n => error.with_help(format!("remove it, and the {} others further on", n - 1)),
        })
    }
}
