//! What is wrong and what was expected, in words that someone understands who has never seen the grammar.
//!
//! One file per way of being wrong: something is missing, superfluous, or stands for something else.

mod misplaced;
mod missing;
mod replaced;
mod surplus;

use super::grammar::{Choice, Form, Item, NumberKind};
use super::parser::{Halt, Parser};
use super::repair::Edit;
use super::route::{Route, Slot, Step};
use super::sections::Section;
use super::token::Token;
use crate::diagnostic::{Diagnostic, Span};

/// How many of the brackets that are still open are pointed at.
const MOST_OPEN_SHOWN: usize = 4;

impl Parser<'_> {
    /// Reports changes of one kind, about to be carried out at the token here.
    pub(crate) fn complain(&mut self, edits: &[Edit], route: &Route) {
        let Some(step) = route.step() else { return };
        match *edits {
            [] => {}
            [Edit::Delete, ..] => self.complain_surplus(edits.len(), step, route),
            [Edit::Replace(step)] => self.complain_replaced(step),
            [Edit::ReplaceTuple(step)] => self.complain_unexpected(step),
            [Edit::ReplaceForm(choice, form)] if self.cursor.now().token == Token::Word => {
                self.complain_word(form.word, Some(choice));
            }
            [Edit::ReplaceForm(choice, _)] => self.complain_unexpected(Step::Choice(choice)),
            [Edit::SkipForm(choice)] => self.complain_unknown_form(choice),
            _ => self.complain_missing(edits, route),
        }
    }

    /// Reports that the token here is not what is due and nothing helps.
    pub(crate) fn complain_unexpected(&mut self, step: Step) {
        let now = self.cursor.now();
        let message = format!("expected {}, found {}", step.brief(), now.describe());
        let label = format!("expected {}", step.expected());
        let error = Diagnostic::error("unexpected-token", message, now.span, label);
        self.report(match step {
            Step::Choice(choice) if choice.is_wide() => error.with_note(choice.explanation()),
            _ => error,
        });
    }

    /// Reports that the file ends inside a sequence.
    pub(crate) fn unfinished(&mut self, route: &Route) -> Halt {
        let step = route.step();
        let expected = step.map_or(String::new(), Step::expected);
        self.report_unfinished(&expected, matches!(step, Some(Step::Close(_, _, None))))
    }

    /// Reports that the file ends where `expected` is due; `only_brackets`: only closing brackets are.
    pub(crate) fn report_unfinished(&mut self, expected: &str, only_brackets: bool) -> Halt {
        let end = self.gap();
        let mut error = Diagnostic::error(
            "unfinished-file",
            "the file ends before the scene is complete",
            end,
            format!("expected {expected}"),
        );
        let open = self.open.iter().rev().filter_map(|open| open.span.map(|span| (open, span)));
        for (open, span) in open.clone().take(MOST_OPEN_SHOWN) {
            let text = format!("this `{}` opens {} and is not closed", span.text(self.source), open.what);
            error = error.with_secondary(span, text);
        }
        if only_brackets && self.in_last_section {
            let brackets: Vec<&str> = self.open.iter().rev().map(|open| open.bracket.closing()).collect();
            let brackets = brackets.join(" ");
            let text = format!("close what is open: `{brackets}`");
            error = error.with_suggestion(end, format!(" {brackets}"), text);
        }
        let unmet: Vec<&str> = self.unmet().map(Section::word).collect();
        self.report(match unmet[..] {
            [] => error,
            [one] => error.with_note(format!("the {one} section is still to come")),
            _ => error.with_note(format!("the sections {} are still to come", join(&unmet, "and"))),
        });
        Halt::Stop
    }

    /// The same error with a label at the bracket that opens the innermost group.
    fn with_opener(&self, error: Diagnostic) -> Diagnostic {
        match self.open.last() {
            Some(open) if let Some(span) = open.span => {
                error.with_secondary(span, format!("this `{}` opens {}", span.text(self.source), open.what))
            }
            _ => error,
        }
    }

    /// The place of the bracket that opens the innermost group.
    fn opener(&self) -> Option<Span> {
        self.open.last().and_then(|open| open.span)
    }
}

impl Step {
    /// What is due, briefly: "`)`", "the sphere's radius".
    pub(crate) fn brief(self) -> String {
        match self {
            Self::Word(word) => format!("`{word}`"),
            Self::Open(_, what, Some(_)) => what.into(),
            Self::Open(bracket, ..) => format!("`{}`", bracket.opening()),
            Self::Close(bracket, ..) => format!("`{}`", bracket.closing()),
            Self::Comma(..) => "`,`".into(),
            Self::Number(slot) => slot.what(),
            Self::Choice(choice) => format!("a {}", choice.what),
        }
    }

    /// What is due, so that one could write it: "the sphere's radius, a real number such as 40.0".
    pub(crate) fn expected(self) -> String {
        match self {
            Self::Word(word) => format!("the word `{word}`"),
            Self::Open(_, what, Some(tuple)) => format!("{what}, such as {}", tuple.example),
            Self::Open(bracket, what, None) => format!("`{}`, which opens {what}", bracket.opening()),
            Self::Close(bracket, what, _) => format!("`{}`, which closes {what}", bracket.closing()),
            Self::Comma(tuple, index) => {
                let next = tuple.components.get(index + 1).copied().unwrap_or_default();
                format!("`,` and the {next} of {}", tuple.what)
            }
            Self::Number(slot) => slot.expected(),
            Self::Choice(choice) if choice.is_wide() => format!("a {}", choice.what),
            Self::Choice(choice) => format!("a {}: {}", choice.what, choice.alternatives()),
        }
    }
}

impl Slot {
    /// "the sphere's radius, a real number such as 40.0".
    pub(crate) fn expected(self) -> String {
        format!("{}, {} such as {}", self.what(), self.kind().name(), self.example())
    }
}

impl NumberKind {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Integer => "an integer",
            Self::Real => "a real number",
        }
    }
}

impl Choice {
    /// "`sphere` or `plane`".
    pub(crate) fn alternatives(&self) -> String {
        let words: Vec<String> = self.forms.iter().map(|form| format!("`{}`", form.word)).collect();
        join(&words, "or")
    }

    /// "a shape is `sphere` or `plane`".
    pub(crate) fn explanation(&self) -> String {
        format!("a {} is {}", self.what, self.alternatives())
    }
}

impl Form {
    /// One text of this form, choices left open.
    pub(crate) fn example(&self) -> String {
        let mut text = self.word.to_string();
        for item in self.items {
            text.push(' ');
            text.push_str(match item {
                Item::Word(word) => word,
                Item::Open(bracket, _) => bracket.opening(),
                Item::Close(bracket, _) => bracket.closing(),
                Item::Number(number) => number.example,
                Item::Tuple(tuple) => tuple.example,
                Item::Choice(_) => "...",
            });
        }
        text
    }
}

/// "x, y and z".
pub(crate) fn join(parts: &[impl AsRef<str>], conjunction: &str) -> String {
    let parts: Vec<&str> = parts.iter().map(AsRef::as_ref).collect();
    match parts.split_last() {
        None => String::new(),
        Some((last, [])) => (*last).into(),
        Some((last, first)) => format!("{} {conjunction} {last}", first.join(", ")),
    }
}

/// A small number in words.
pub(crate) fn in_words(count: usize) -> String {
    match count {
        1 => "one".into(),
        2 => "two".into(),
        3 => "three".into(),
        4 => "four".into(),
        _ => count.to_string(),
    }
}
