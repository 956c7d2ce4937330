//! Which brackets belong together.
//!
//! Where all do, this says nothing. Where some do not, it decides which are to blame, from the order of all brackets and
//! from the lines that look like definitions, reports those, and leaves the parser a text whose brackets are in order: a
//! bracket that is not closed gets a place where reading has to stop.

use super::complaint::brackets::{self as complaint, After};
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
pub(crate) fn check(base: usize, tokens: &mut Vec<Token>) -> Brackets {
    if are_balanced(tokens) {
        return Brackets::default();
    }
    let mut check =
        Check { base, open: Vec::new(), waiting: [0; 3], limit: 0, searches: 0, result: Brackets::default() };
    let mut stray = Vec::new();
    for number in 0..tokens.len() {
        let Some(token) = tokens.get(number).copied() else { break };
        check.line(tokens, number, token);
        if token.kind.is_open() {
            check.push(number, token.kind.closing());
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

/// The place of a kind of closing bracket in a table.
const fn slot(closing: SyntaxKind) -> usize {
    match closing {
        SyntaxKind::CloseParen => 0,
        SyntaxKind::CloseBracket => 1,
        _ => 2,
    }
}

struct Check {
    base: usize,
    /// The brackets that are open here, each with what closes it.
    open: Vec<(usize, SyntaxKind)>,
    /// How many of those each kind closes.
    waiting: [usize; 3],
    /// The column of the definition at the top that this is in, plus one.
    limit: u32,
    searches: usize,
    result: Brackets,
}

impl Check {
    fn span(&self, token: Token) -> Span {
        Span::new(self.base + token.start as usize, self.base + token.end as usize)
    }

    fn report(&mut self, error: Diagnostic) {
        if self.result.errors.len() < MOST_ERRORS {
            self.result.errors.push(error);
        }
    }

    fn push(&mut self, number: usize, closing: SyntaxKind) {
        self.open.push((number, closing));
        if let Some(waiting) = self.waiting.get_mut(slot(closing)) {
            *waiting += 1;
        }
    }

    fn pop(&mut self) -> Option<usize> {
        let (number, closing) = self.open.pop()?;
        if let Some(waiting) = self.waiting.get_mut(slot(closing)) {
            *waiting -= 1;
        }
        Some(number)
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
        while self.open.len() > from {
            let Some(open) = self.pop() else { return };
            let Some(token) = tokens.get(open).copied() else { continue };
            let (wall, after) = match self.next_field(tokens, open, wall) {
                Some(field) => (field, After::Field),
                None if tokens.get(wall).is_some_and(|next| next.kind.is_close()) => (wall, After::Closing),
                None => (wall, After::Definition),
            };
            self.result.unclosed.insert(open as u32, wall as u32);
            let mut last = wall.saturating_sub(1);
            let is_one_line = after == After::Field || token.kind != SyntaxKind::OpenBrace;
            if is_one_line
                && last > open
                && tokens.get(last).is_some_and(|last| last.kind == SyntaxKind::Comma)
            {
                last -= 1;
            }
            let end = self.base + tokens.get(last).map_or(0, |last| last.end as usize);
            let next = tokens.get(wall).map(|next| (after, self.span(*next)));
            self.report(complaint::unclosed(token.kind, self.span(token), end, next));
        }
    }

    /// What looks like a field, `name =`, in round or square brackets, where there can be none.
    fn next_field(&mut self, tokens: &[Token], open: usize, wall: usize) -> Option<usize> {
        let opener = tokens.get(open)?;
        self.searches += 1;
        if opener.kind == SyntaxKind::OpenBrace || self.searches > MOST_SEARCHES {
            return None;
        }
        let mut depth = 0_usize;
        for at in open + 1..wall {
            let token = tokens.get(at)?;
            if token.kind.is_open() {
                depth += 1;
            } else if token.kind.is_close() {
                depth = depth.checked_sub(1)?;
            }
            let is_name = depth == 0 && token.kind == SyntaxKind::Name;
            if is_name && tokens.get(at + 1).is_some_and(|next| next.kind == SyntaxKind::Define) {
                let follows_comma = tokens.get(at - 1).is_some_and(|before| before.kind == SyntaxKind::Comma);
                return (token.starts_line || follows_comma).then_some(at);
            }
        }
        None
    }

    fn close(&mut self, tokens: &[Token], number: usize, token: Token) -> Closing {
        let Some((last, closing)) = self.open.last().copied() else {
            self.report(complaint::stray(token.kind, self.span(token), None));
            return Closing::Stray;
        };
        if closing == token.kind {
            self.pop();
            return Closing::Partner;
        }
        if self.waiting.get(slot(token.kind)).is_some_and(|waiting| *waiting > 0) {
            let deeper = self.open.iter().rposition(|(_, closing)| *closing == token.kind);
            self.unclosed_from(tokens, deeper.unwrap_or(0) + 1, number);
            self.pop();
            return Closing::Partner;
        }
        let opener = tokens.get(last).copied().unwrap_or(token);
        let shown = Some((opener.kind, self.span(opener)));
        if self.is_closed_later(tokens, number + 1, opener.kind.closing()) {
            self.report(complaint::stray(token.kind, self.span(token), shown));
            return Closing::Stray;
        }
        self.report(complaint::wrong(token.kind, self.span(token), opener.kind, self.span(opener)));
        self.pop();
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
