//! Something stands where it does not belong.

use super::in_words;
use super::missing::numbers_note;
use crate::classic::parser::Parser;
use crate::classic::route::{Route, Step};
use crate::classic::token::{Lexeme, Token, quoted};
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// Reports that `count` tokens from here on are superfluous, `step` being due.
    pub(super) fn complain_surplus(&mut self, count: usize, step: Step, route: &Route) {
        let tokens = self.cursor.ahead(count);
        let (Some(first), Some(last)) = (tokens.first(), tokens.last()) else { return };
        let span = first.span.to(last.span);
        let error = if tokens.iter().all(|lexeme| lexeme.token == Token::Unknown) {
            self.unknown_characters(&tokens, span, step)
        } else if let (Step::Close(_, what, Some(tuple)), Token::Comma) = (step, first.token) {
            let components = in_words(tuple.components.len());
            if tokens.len() == 1 {
                let message = format!("unexpected `,` after the last component of {what}");
                Diagnostic::error("unexpected-token", message, span, "expected `)` instead")
            } else {
                let message = format!("{what} has {components} components, but more are given");
                let label = format!("expected `)` before this; {what} is written as {}", tuple.example);
                self.with_opener(Diagnostic::error("tuple-size", message, span, label))
            }
        } else if tokens.len() == 1 && self.repeats_the_last(first) {
            let message = format!("one `{}` too many", first.text);
            let label = format!("there is one just before; expected {}", step.expected());
            Diagnostic::error("unexpected-token", message, span, label)
        } else {
            let message = format!("unexpected {}", describe(&tokens));
            let label = format!("expected {}", step.expected());
            let error = Diagnostic::error("unexpected-token", message, span, label);
            match first.token {
                Token::Comma => {
                    error.with_note("commas stand only between numbers in brackets, such as (0.8,0.8,0.8)")
                }
                Token::Integer | Token::Real if !matches!(step, Step::Choice(_)) => {
                    numbers_note(route).into_iter().fold(error, Diagnostic::with_note)
                }
                _ => error,
            }
        };
        self.report(error.with_suggestion(span, "", "remove it"));
    }

    /// Whether a bracket or comma is the same as the one before it.
    fn repeats_the_last(&self, lexeme: &Lexeme<'_>) -> bool {
        let mark = matches!(lexeme.token, Token::Open(_) | Token::Close(_) | Token::Comma);
        mark && self.cursor.last().token == lexeme.token
    }

    fn unknown_characters(&self, tokens: &[Lexeme<'_>], span: Span, step: Step) -> Diagnostic {
        let all: String = tokens.iter().map(|lexeme| lexeme.text).collect();
        let mut characters = all.chars();
        let message = match (characters.next(), characters.next()) {
            (Some(one), None) => format!("the character {} has no meaning in a scene", named(one)),
            _ => format!("the characters {} have no meaning in a scene", quoted(span.text(self.source))),
        };
        Diagnostic::error("unknown-character", message, span, format!("expected {}", step.expected()))
    }
}

/// "`;`", "`…` (U+2026)".
fn named(character: char) -> String {
    if character.is_ascii_graphic() {
        format!("`{character}`")
    } else if character.is_control() {
        format!("U+{:04X}", u32::from(character))
    } else {
        format!("`{character}` (U+{:04X})", u32::from(character))
    }
}

/// A few tokens as a message names them.
fn describe(tokens: &[Lexeme<'_>]) -> String {
    match tokens {
        [one] => one.name(),
        _ => {
            let texts: Vec<&str> = tokens.iter().map(|lexeme| lexeme.text).collect();
            quoted(&texts.join(" "))
        }
    }
}
