//! The place in the source that is being read.

use super::token::{Lexeme, Token};
use crate::diagnostic::{Diagnostic, Span};
use logos::{Lexer, Logos};

/// Hands out tokens one by one, lexing as it goes: memory does not grow with the source.
pub(crate) struct Cursor<'s> {
    lexer: Lexer<'s, Token>,
    now: Lexeme<'s>,
    /// The token after.
    after: Lexeme<'s>,
    /// The token before.
    last: Lexeme<'s>,
}

impl<'s> Cursor<'s> {
    /// A cursor at the first token of a source (a byte order mark is skipped).
    pub(crate) fn new(source: &'s str) -> Self {
        let mut lexer = Token::lexer(source);
        if source.starts_with('\u{feff}') {
            lexer.bump('\u{feff}'.len_utf8());
        }
        let start = Span::at(lexer.span().end);
        Self::start(lexer, start)
    }

    /// A cursor at `span.start` of a source, for another look at a part of it.
    pub(crate) fn within(source: &'s str, span: Span) -> Self {
        let mut lexer = Token::lexer(source.get(..span.end).unwrap_or_default());
        lexer.bump(source.floor_char_boundary(span.start.min(span.end)));
        Self::start(lexer, Span::at(span.start))
    }

    fn start(mut lexer: Lexer<'s, Token>, start: Span) -> Self {
        let last = Lexeme { token: Token::Unknown, span: start, text: "" };
        let now = next(&mut lexer);
        let after = next(&mut lexer);
        Self { lexer, now, after, last }
    }

    /// The token here.
    pub(crate) const fn now(&self) -> Lexeme<'s> {
        self.now
    }

    /// The token after it; at the end, the end again.
    pub(crate) const fn after(&self) -> Lexeme<'s> {
        self.after
    }

    /// The token before it.
    pub(crate) const fn last(&self) -> Lexeme<'s> {
        self.last
    }

    /// Moves on; gives the token passed.
    pub(crate) fn bump(&mut self) -> Lexeme<'s> {
        self.last = self.now;
        if self.now.token != Token::End {
            self.now = self.after;
            self.after = next(&mut self.lexer);
        }
        self.last
    }

    /// The token here and those after it, `count` in all or up to the end.
    pub(crate) fn ahead(&self, count: usize) -> Vec<Lexeme<'s>> {
        let mut lexer = self.lexer.clone();
        let mut tokens = vec![self.now];
        if self.now.token != Token::End {
            tokens.push(self.after);
        }
        tokens.truncate(count);
        while tokens.len() < count && tokens.last().is_some_and(|lexeme| lexeme.token != Token::End) {
            tokens.push(next(&mut lexer));
        }
        tokens
    }

    /// The error about the comments passed so far.
    pub(crate) fn comment_error(&self) -> Option<Diagnostic> {
        self.lexer.extras.complaint()
    }
}

/// The next token; adjacent unknown characters make one.
fn next<'s>(lexer: &mut Lexer<'s, Token>) -> Lexeme<'s> {
    let lexeme = |token, span: Span, source: &'s str| Lexeme { token, span, text: span.text(source) };
    match lexer.next() {
        Some(Ok(token)) => lexeme(token, lexer.span().into(), lexer.source()),
        None => lexeme(Token::End, Span::at(lexer.source().len()), lexer.source()),
        Some(Err(())) => {
            let mut span = Span::from(lexer.span());
            let mut ahead = lexer.clone();
            while ahead.next() == Some(Err(())) && ahead.span().start == span.end {
                span.end = ahead.span().end;
                *lexer = ahead.clone();
            }
            lexeme(Token::Unknown, span, lexer.source())
        }
    }
}
