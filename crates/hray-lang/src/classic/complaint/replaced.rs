//! Something stands for what is due.

use super::join;
use crate::classic::grammar::{Choice, NumberKind, Tuple};
use crate::classic::number::{fault, rewritten};
use crate::classic::parser::Parser;
use crate::classic::route::{Slot, Step};
use crate::classic::token::{Bracket, Lexeme, Token, quoted};
use crate::classic::words::{WORDS, nearest};
use crate::diagnostic::{Diagnostic, Span};

impl<'s> Parser<'s> {
    /// Reports that the token here stands for `step`.
    pub(super) fn complain_replaced(&mut self, step: Step) {
        let now = self.cursor.now();
        match (step, now.token) {
            (Step::Number(slot), Token::Integer | Token::Real) => self.complain_kind(slot, &now),
            (Step::Number(slot), Token::OddNumber) => self.complain_odd_number(slot, &now),
            (Step::Word(word), Token::Word) => self.complain_word(word, None),
            (Step::Open(bracket, ..), Token::Open(_)) => self.complain_bracket(step, bracket.opening()),
            (Step::Close(bracket, ..), Token::Close(_)) => self.complain_bracket(step, bracket.closing()),
            (Step::Comma(tuple, index), Token::Unknown) => self.complain_commas(tuple, index),
            _ => self.complain_unexpected(step),
        }
    }

    /// An integer stands for a real number, or the other way round: once for all numbers of a tuple.
    fn complain_kind(&mut self, slot: Slot, now: &Lexeme<'_>) {
        if now.span.start < self.kinds_reported {
            return;
        }
        let numbers = match slot {
            Slot::Single(_) => vec![*now],
            Slot::Component(tuple, index) => self.numbers_of_other_kind(tuple, index),
        };
        let (Some(first), Some(last)) = (numbers.first(), numbers.last()) else { return };
        self.kinds_reported = last.span.end;
        let error = kind_error(slot, first, numbers.len());
        let others = numbers.iter().skip(1);
        let error = others.fold(error, |error, other| error.with_secondary(other.span, ""));
        let span = first.span.to(last.span);
        self.report(match self.with_rewritten(&numbers, slot.kind()) {
            Some(text) => error.with_suggestion(span, text, advice(slot.kind(), numbers.len())),
            None => error.with_help(format!("round {} to a whole number", quoted(first.text))),
        });
    }

    /// The numbers from here to the end of a tuple that are not of its kind.
    fn numbers_of_other_kind(&self, tuple: &Tuple, index: usize) -> Vec<Lexeme<'s>> {
        let ahead = self.cursor.ahead(2 * (tuple.components.len() - index));
        let of_tuple = ahead.into_iter().take_while(|lexeme| {
            matches!(lexeme.token, Token::Integer | Token::Real | Token::Comma | Token::OddNumber)
        });
        let other = match tuple.kind {
            NumberKind::Integer => Token::Real,
            NumberKind::Real => Token::Integer,
        };
        of_tuple.filter(|lexeme| lexeme.token == other).collect()
    }

    /// The source from the first to the last number, each rewritten.
    fn with_rewritten(&self, numbers: &[Lexeme<'_>], kind: NumberKind) -> Option<String> {
        let mut text = String::new();
        let mut end = numbers.first()?.span.start;
        for number in numbers {
            text.push_str(Span::new(end, number.span.start).text(self.source));
            text.push_str(&rewritten(number.text, kind)?);
            end = number.span.end;
        }
        Some(text)
    }

    fn complain_odd_number(&mut self, slot: Slot, now: &Lexeme<'_>) {
        let message = format!("{} is not a number", quoted(now.text));
        let error = Diagnostic::error("malformed-number", message, now.span, fault(now.text));
        self.report(match rewritten(now.text, slot.kind()) {
            Some(text) => {
                let words = format!("write {} as {}", slot.what(), slot.kind().name());
                error.with_suggestion(now.span, text, words)
            }
            None => error.with_help(format!("expected {}", slot.expected())),
        });
    }

    /// A word stands for `meant`, which is the word of a form of `choice` where that is given.
    pub(super) fn complain_word(&mut self, meant: &str, choice: Option<&'static Choice>) {
        let now = self.cursor.now();
        let found = quoted(now.text);
        let (code, message) = if WORDS.contains(&now.text) {
            ("wrong-word", format!("expected `{meant}`, found {found}"))
        } else {
            ("unknown-word", format!("unknown word {found}"))
        };
        let mut error = match choice {
            Some(choice) => form_error(code, message, now.span, choice),
            None => Diagnostic::error(code, message, now.span, format!("expected the word `{meant}`")),
        };
        if now.text.eq_ignore_ascii_case(meant) {
            error = error.with_note("capital and small letters are different letters here");
        }
        let near = nearest(now.text, WORDS.iter().copied().filter(|word| *word == meant)).is_some();
        let words = if near { format!("did you mean `{meant}`?") } else { format!("write `{meant}`") };
        self.report(error.with_suggestion(now.span, meant, words));
    }

    /// Something stands where a form is due, and it is like none of them.
    pub(super) fn complain_unknown_form(&mut self, choice: &'static Choice) {
        let now = self.cursor.now();
        if now.token != Token::Word || WORDS.contains(&now.text) {
            return self.complain_unexpected(Step::Choice(choice));
        }
        let message = format!("unknown {} {}", choice.what, quoted(now.text));
        self.report(form_error("unknown-word", message, now.span, choice));
    }

    /// A bracket of the wrong kind.
    fn complain_bracket(&mut self, step: Step, due: &str) {
        let now = self.cursor.now();
        let message = format!("expected `{due}`, found `{}`", now.text);
        let label = match step {
            Step::Open(_, what, _) => format!("expected `{due}`, which opens {what}"),
            _ => format!("expected {}", step.expected()),
        };
        let error = Diagnostic::error("wrong-bracket", message, now.span, label);
        let error = if matches!(step, Step::Close(..)) { self.with_opener(error) } else { error };
        self.report(error.with_suggestion(now.span, due, format!("write `{due}`")));
    }

    /// A number with a decimal comma, or a tuple full of them. Such a text would otherwise be taken for too
    /// many integers. Returns whether it was one; it is then passed.
    pub(crate) fn mend_decimal_comma(
        &mut self,
        step: Step,
        route: &mut crate::classic::route::Route,
    ) -> bool {
        let Step::Number(slot) = step else { return false };
        let count = match slot {
            Slot::Single(_) => 1,
            Slot::Component(tuple, 0) => tuple.components.len(),
            Slot::Component(..) => return false,
        };
        let tokens = self.cursor.ahead(4 * count);
        let (numbers, end) = tokens.split_at((4 * count - 1).min(tokens.len()));
        let closed = matches!(slot, Slot::Single(_))
            || matches!(end, [Lexeme { token: Token::Close(Bracket::Round), .. }]);
        if slot.kind() != NumberKind::Real || !closed || !all_decimal_commas(numbers) {
            return false;
        }
        let points: Vec<String> = numbers.chunks(4).filter_map(with_point).collect();
        let (Some(first), Some(last)) = (numbers.first(), numbers.last()) else { return false };
        let span = first.span.to(last.span);
        let message = format!("{} is written with decimal commas", slot_or_tuple(slot));
        let error = Diagnostic::error("decimal-comma", message, span, "a real number has a decimal point");
        self.report(error.with_suggestion(span, points.join(","), "write points"));
        for _ in numbers {
            self.cursor.bump();
        }
        for _ in 0..2 * count - 1 {
            route.advance();
        }
        true
    }
}

/// An error about the word of a form, with all words that could stand there.
fn form_error(code: &'static str, message: String, span: Span, choice: &Choice) -> Diagnostic {
    let alternatives = choice.alternatives();
    if choice.is_wide() {
        let error = Diagnostic::error(code, message, span, format!("expected a {}", choice.what));
        return error.with_note(choice.explanation());
    }
    Diagnostic::error(code, message, span, format!("expected {alternatives}"))
}

/// Whether tokens are integers joined in pairs by commas, and the pairs separated by commas.
fn all_decimal_commas(tokens: &[Lexeme<'_>]) -> bool {
    let pairs = tokens.chunks(4);
    let touching = |a: &Lexeme<'_>, b: &Lexeme<'_>| a.span.end == b.span.start;
    tokens.len() % 4 == 3
        && pairs.into_iter().all(|pair| match pair {
            [whole, comma, fraction, rest @ ..] => {
                whole.token == Token::Integer
                    && comma.token == Token::Comma
                    && fraction.token == Token::Integer
                    && !fraction.text.starts_with('-')
                    && touching(whole, comma)
                    && touching(comma, fraction)
                    && rest.iter().all(|lexeme| lexeme.token == Token::Comma)
            }
            _ => false,
        })
}

fn with_point(pair: &[Lexeme<'_>]) -> Option<String> {
    match pair {
        [whole, _, fraction, ..] => Some(format!("{}.{}", whole.text, fraction.text)),
        _ => None,
    }
}

fn slot_or_tuple(slot: Slot) -> String {
    match slot {
        Slot::Single(number) => number.what.into(),
        Slot::Component(tuple, _) => tuple.what.into(),
    }
}

/// The error about `count` numbers of the wrong kind, the first of them `first`.
fn kind_error(slot: Slot, first: &Lexeme<'_>, count: usize) -> Diagnostic {
    let found = quoted(first.text);
    let (code, other, rule) = match slot.kind() {
        NumberKind::Real => {
            ("integer-for-real", "integer", "a real number has a point, with digits on both sides")
        }
        NumberKind::Integer => ("real-for-integer", "real number", "an integer has no point"),
    };
    let found = match count {
        1 => format!("{found} is {}", if other == "integer" { "an integer" } else { "a real number" }),
        _ => format!("these are {other}s"),
    };
    let message = match slot {
        Slot::Single(number) => format!("{} is {}, but {found}", number.what, slot.kind().name()),
        Slot::Component(tuple, _) => {
            let components = join(tuple.components, "and");
            let kinds = if slot.kind() == NumberKind::Real { "real numbers" } else { "integers" };
            format!("{} ({components}) is made of {kinds}, but {found}", tuple.what)
        }
    };
    Diagnostic::error(code, message, first.span, rule)
}

const fn advice(kind: NumberKind, count: usize) -> &'static str {
    match (kind, count) {
        (NumberKind::Real, 1) => "write it with a point",
        (NumberKind::Real, _) => "write them with a point",
        (NumberKind::Integer, 1) => "write it without a point",
        (NumberKind::Integer, _) => "write them without a point",
    }
}
