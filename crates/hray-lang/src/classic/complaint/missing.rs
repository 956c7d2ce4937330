//! Something that is due is missing.

use super::{in_words, join};
use crate::classic::grammar::{Choice, Form, Tuple};
use crate::classic::parser::Parser;
use crate::classic::repair::Edit;
use crate::classic::route::{Route, Step};
use crate::classic::token::{Bracket, Token};
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// Reports that all this is missing before the token here.
    pub(super) fn complain_missing(&mut self, edits: &[Edit], route: &Route) {
        match *edits {
            [Edit::Insert(Step::Comma(tuple, index))] => self.complain_commas(tuple, index),
            [Edit::Insert(Step::Comma(tuple, index)), ..] => self.complain_short_tuple(tuple, index + 1),
            [Edit::Insert(Step::Close(bracket, what, _))] => self.complain_missing_close(bracket, what),
            [Edit::InsertForm(choice, form)] => self.complain_missing_form(choice, form),
            _ => self.complain_missing_parts(edits, route),
        }
    }

    /// A comma of a tuple is missing, or some other character stands for it: once for all commas of the tuple.
    pub(super) fn complain_commas(&mut self, tuple: &Tuple, index: usize) {
        let now = self.cursor.now();
        if now.span.start < self.commas_reported {
            return;
        }
        let component = |index: usize| tuple.components.get(index).copied().unwrap_or_default();
        let (message, span) = match now.token {
            Token::Unknown => (format!("expected `,`, found {}", now.describe()), now.span),
            _ => (format!("missing `,` in {}", tuple.what), self.gap()),
        };
        let label = format!("expected `,` between {} and {}", component(index), component(index + 1));
        let error = Diagnostic::error("missing-comma", message, span, label);
        let (changed, text) = self.with_commas(tuple.components.len() - index);
        self.report(error.with_suggestion(changed, text, "separate the components by commas"));
    }

    /// The source from here on with commas between the remaining `count` components of a tuple, as far as
    /// that changes it. They count as reported.
    fn with_commas(&mut self, count: usize) -> (Span, String) {
        let start = self.gap().start;
        let (mut text, mut end) = (String::new(), start);
        let (mut pending, mut after_number) = (start, true);
        for lexeme in self.cursor.ahead(2 * count) {
            self.commas_reported = lexeme.span.end;
            match lexeme.token {
                Token::Unknown => {
                    text.push_str(Span::new(end, pending).text(self.source));
                    text.push(',');
                    (end, pending, after_number) = (lexeme.span.end, lexeme.span.end, false);
                }
                Token::Comma => (pending, after_number) = (lexeme.span.end, false),
                Token::Integer | Token::Real | Token::OddNumber => {
                    if after_number {
                        text.push_str(Span::new(end, pending).text(self.source));
                        text.push(',');
                        end = pending;
                    }
                    (pending, after_number) = (lexeme.span.end, true);
                }
                _ => break,
            }
        }
        (Span::new(start, end), text)
    }

    /// `given` components and then the end.
    fn complain_short_tuple(&mut self, tuple: &Tuple, given: usize) {
        let now = self.cursor.now();
        let end = if matches!(now.token, Token::Close(_)) { now.span } else { self.gap() };
        let span = self.opener().map_or(end, |open| open.to(end));
        let message = format!(
            "{} has {} components, but only {} {} given",
            tuple.what,
            in_words(tuple.components.len()),
            in_words(given),
            if given == 1 { "is" } else { "are" }
        );
        let label = format!("expected {}, such as {}", join(tuple.components, "and"), tuple.example);
        self.report(Diagnostic::error("tuple-size", message, span, label));
    }

    fn complain_missing_close(&mut self, bracket: Bracket, what: &str) {
        let closing = bracket.closing();
        let error = Diagnostic::error(
            "missing-bracket",
            format!("missing `{closing}` at the end of {what}"),
            self.gap(),
            format!("expected `{closing}` here"),
        );
        let inserted = if bracket == Bracket::Round { closing.to_string() } else { format!(" {closing}") };
        let error = self.with_opener(error).with_suggestion(self.gap(), inserted, format!("add `{closing}`"));
        self.report(error);
    }

    fn complain_missing_form(&mut self, choice: &Choice, form: &Form) {
        let now = self.cursor.now();
        let message = format!("missing the word that says which {} this is", choice.what);
        let label = format!("expected {} before this", choice.alternatives());
        let error = Diagnostic::error("missing-word", message, now.span, label).with_suggestion(
            Span::at(now.span.start),
            format!("{} ", form.word),
            format!("what follows would suit `{}`", form.word),
        );
        self.report(error);
    }

    fn complain_missing_parts(&mut self, edits: &[Edit], route: &Route) {
        let now = self.cursor.now();
        let parts: Vec<Part> = edits.iter().filter_map(|edit| part(*edit)).collect();
        let Some(first) = parts.first() else { return };
        let names: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
        let message = format!("missing {} before {}", join(&names, "and"), now.describe());
        let comma = if first.expected.contains([',', ':']) { "," } else { "" };
        let label = format!("expected {}{comma} before this", first.expected);
        let is_number = matches!(edits.first(), Some(Edit::Insert(Step::Number(_)) | Edit::InsertTuple(_)));
        let code = match edits.first() {
            _ if is_number => "missing-number",
            Some(Edit::Insert(Step::Open(..))) => "missing-bracket",
            _ => "missing-word",
        };
        let mut error = Diagnostic::error(code, message, now.span, label);
        if is_number {
            error.notes.extend(numbers_note(route));
        }
        if parts.iter().all(|part| part.text.is_some()) {
            let text: String = parts.iter().filter_map(|part| part.text.as_deref()).collect();
            let words = format!("add `{}`", text.trim_end());
            error = error.with_suggestion(Span::at(now.span.start), text, words);
        }
        self.report(error);
    }
}

/// One thing that is missing.
struct Part {
    name: String,
    expected: String,
    /// The text to add, where it is the same in every scene.
    text: Option<String>,
}

fn part(edit: Edit) -> Option<Part> {
    let (step, text) = match edit {
        Edit::Insert(step @ Step::Word(word)) => (step, Some(format!("{word} "))),
        Edit::Insert(Step::Open(bracket, what, _)) => {
            let text = bracket.opening();
            let space = if bracket == Bracket::Round { "" } else { " " };
            return Some(Part {
                name: format!("`{text}`"),
                expected: format!("`{text}`, which opens {what}"),
                text: Some(format!("{text}{space}")),
            });
        }
        Edit::Insert(step @ Step::Close(bracket, ..)) => (step, Some(bracket.closing().into())),
        Edit::Insert(step @ Step::Comma(..)) => (step, Some(",".into())),
        Edit::Insert(step) | Edit::InsertTuple(step) => (step, None),
        Edit::InsertForm(choice, form) => {
            return Some(Part {
                name: format!("`{}`", form.word),
                expected: Step::Choice(choice).expected(),
                text: Some(format!("{} ", form.word)),
            });
        }
        _ => return None,
    };
    Some(Part { name: step.brief(), expected: step.expected(), text })
}

/// In which order the numbers stand that were being read.
pub(super) fn numbers_note(route: &Route) -> Option<String> {
    if let Some(form) = route.form() {
        return Some(format!("it is written like this: `{}`", form.example()));
    }
    let numbers = route.numbers_here();
    let names: Vec<String> =
        numbers.iter().map(|number| format!("{} ({})", number.what, number.kind.name())).collect();
    (names.len() > 1).then(|| format!("the numbers here are, in this order, {}", join(&names, "and")))
}
