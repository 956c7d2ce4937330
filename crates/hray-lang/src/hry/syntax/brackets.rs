//! Which brackets belong together.
//!
//! Where all do, this says nothing. Where some do not, it decides which are to blame, from the order of all brackets and
//! from the lines that look like definitions, reports those, and leaves the parser a text whose brackets are in order: a
//! bracket that is not closed gets a place where reading has to stop.

use super::complaint::brackets as complaint;
use super::kind::SyntaxKind;
use super::lexer::Token;
use super::parser::MOST_ERRORS;
use crate::diagnostic::{Diagnostic, Span};
use std::collections::HashMap;

/// What became of the brackets of a file.
#[derive(Debug, Default)]
pub(crate) struct Brackets {
    /// For every opening bracket that is not closed, the token before which it has to end.
    pub(crate) unclosed: HashMap<u32, u32>,
    pub(crate) errors: Vec<Diagnostic>,
}

/// How often the search looks ahead to tell a bracket too many from a wrong one.
const MOST_SEARCHES: usize = 50;

/// Checks the brackets. Closing brackets without a partner are taken out of `tokens`, those of the wrong kind replaced.
pub(crate) fn check(text: &str, base: usize, tokens: &mut Vec<Token>) -> Brackets {
    if are_balanced(tokens) {
        return Brackets::default();
    }
    let mut check =
        Check { text, base, open: Vec::new(), limit: 0, searches: 0, result: Brackets::default() };
    let mut stray = Vec::new();
    for number in 0..tokens.len() {
        let Some(token) = tokens.get(number).copied() else { break };
        check.line(tokens, number, token);
        if token.kind.is_open() {
            check.open.push(number);
        } else if token.kind.is_close() {
            match check.close(tokens, number, token) {
                Closing::Partner => {}
                Closing::Stray => stray.push(number),
                Closing::Instead(kind) => {
                    if let Some(token) = tokens.get_mut(number) {
                        token.kind = kind;
                    }
                }
            }
        }
    }
    let end = tokens.len();
    check.unclosed_from(tokens, 0, end);
    let Brackets { unclosed, errors } = check.result;
    // The numbers of tokens after the strays are out.
    let moved = |number: u32| number - stray.partition_point(|stray| *stray < number as usize) as u32;
    let unclosed = unclosed.into_iter().map(|(open, wall)| (moved(open), moved(wall))).collect();
    let mut number = 0;
    tokens.retain(|_| {
        number += 1;
        stray.binary_search(&(number - 1)).is_err()
    });
    Brackets { unclosed, errors }
}

fn are_balanced(tokens: &[Token]) -> bool {
    let mut open = Vec::new();
    for token in tokens {
        if token.kind.is_open() {
            open.push(token.kind.closing());
        } else if token.kind.is_close() && open.pop() != Some(token.kind) {
            return false;
        }
    }
    open.is_empty()
}

/// What a closing bracket does.
enum Closing {
    Partner,
    Stray,
    Instead(SyntaxKind),
}

struct Check<'t> {
    text: &'t str,
    base: usize,
    /// The brackets that are open here.
    open: Vec<usize>,
    /// The column of the definition at the top that this is in, plus one.
    limit: u32,
    searches: usize,
    result: Brackets,
}

impl Check<'_> {
    fn span(&self, token: Token) -> Span {
        Span::new(self.base + token.start as usize, self.base + token.end as usize)
    }

    fn report(&mut self, error: Diagnostic) {
        if self.result.errors.len() < MOST_ERRORS {
            self.result.errors.push(error);
        }
    }

    /// Closes all brackets at a line that looks like the next definition.
    fn line(&mut self, tokens: &[Token], number: usize, token: Token) {
        if !token.starts_line {
            return;
        }
        if self.limit == 0 {
            self.limit = token.column + 1;
        } else if token.column < self.limit {
            if self.open.is_empty() {
                self.limit = token.column + 1;
            } else if begins_item(tokens, number) {
                self.unclosed_from(tokens, 0, number);
                self.limit = token.column + 1;
            }
        }
    }

    /// The brackets from the `from`th open one on are not closed before token `wall`.
    fn unclosed_from(&mut self, tokens: &[Token], from: usize, wall: usize) {
        for open in self.open.split_off(from.min(self.open.len())) {
            let Some(token) = tokens.get(open).copied() else { continue };
            let last = wall.checked_sub(1).and_then(|last| tokens.get(last)).copied().unwrap_or(token);
            let next = tokens.get(wall).copied();
            self.result.unclosed.insert(open as u32, wall as u32);
            self.report(complaint::unclosed(
                token.kind,
                self.span(token),
                self.base + last.end as usize,
                next.map(|next| (next.kind.is_close(), self.span(next))),
                self.text,
                self.base,
            ));
        }
    }

    fn close(&mut self, tokens: &[Token], number: usize, token: Token) -> Closing {
        let kind = |open: &usize| tokens.get(*open).map(|token| token.kind.closing());
        let Some(last) = self.open.last().copied() else {
            self.report(complaint::stray(token.kind, self.span(token), None));
            return Closing::Stray;
        };
        if kind(&last) == Some(token.kind) {
            self.open.pop();
            return Closing::Partner;
        }
        if let Some(deeper) = self.open.iter().rposition(|open| kind(open) == Some(token.kind)) {
            self.unclosed_from(tokens, deeper + 1, number);
            self.open.pop();
            return Closing::Partner;
        }
        let opener = tokens.get(last).copied().unwrap_or(token);
        let shown = Some((opener.kind, self.span(opener)));
        if self.is_closed_later(tokens, number + 1, opener.kind.closing()) {
            self.report(complaint::stray(token.kind, self.span(token), shown));
            return Closing::Stray;
        }
        self.report(complaint::wrong(token.kind, self.span(token), opener.kind, self.span(opener)));
        self.open.pop();
        Closing::Instead(opener.kind.closing())
    }

    /// Whether the innermost bracket has a partner after token `from`.
    fn is_closed_later(&mut self, tokens: &[Token], from: usize, closing: SyntaxKind) -> bool {
        self.searches += 1;
        if self.searches > MOST_SEARCHES {
            return true;
        }
        let mut open = 0_usize;
        for (number, token) in tokens.iter().enumerate().skip(from) {
            if token.starts_line && token.column < self.limit && begins_item(tokens, number) {
                return false;
            }
            if token.kind.is_open() {
                open += 1;
            } else if token.kind.is_close() {
                match open.checked_sub(1) {
                    Some(left) => open = left,
                    None => return token.kind == closing,
                }
            }
        }
        false
    }
}

/// Whether a line that begins with a token looks like an import, an annotation or a definition: `name ... =`.
pub(crate) fn begins_item(tokens: &[Token], number: usize) -> bool {
    let kind = |number: usize| tokens.get(number).map(|token| token.kind);
    match kind(number) {
        Some(SyntaxKind::ImportKeyword) => kind(number + 1) == Some(SyntaxKind::Text),
        Some(SyntaxKind::Name) => {
            kind(number + 1) == Some(SyntaxKind::Colon) || defines(tokens, number).is_some()
        }
        _ => false,
    }
}

/// The `=` of what looks like `patterns =`, where a token begins that.
pub(crate) fn defines(tokens: &[Token], number: usize) -> Option<usize> {
    leads_to(tokens, number, SyntaxKind::Define, true)
}

/// The token of a kind that follows what looks like patterns, where a token begins those. With `layout`, a line that
/// starts at or left of the first token ends the search, as it ends a binding; so searches that begin at different
/// lines do not read the same tokens again and again.
pub(crate) fn leads_to(tokens: &[Token], number: usize, wanted: SyntaxKind, layout: bool) -> Option<usize> {
    use SyntaxKind as S;
    let column = tokens.get(number)?.column;
    let mut open = 0_usize;
    for (at, token) in tokens.iter().enumerate().skip(number) {
        let is_inside = open > 0 || at == number;
        match token.kind {
            _ if layout && !is_inside && token.starts_line && token.column <= column => return None,
            kind if kind == wanted && open == 0 => return (at > number).then_some(at),
            S::OpenParen | S::OpenBracket | S::OpenBrace => open += 1,
            S::CloseParen | S::CloseBracket | S::CloseBrace => open = open.checked_sub(1)?,
            S::Define | S::Comma | S::DotDot | S::Colon if open > 0 => {}
            S::Name | S::TypeName | S::Underscore | S::Number | S::Minus | S::Text => {}
            S::TrueKeyword | S::FalseKeyword => {}
            _ => return None,
        }
    }
    None
}
