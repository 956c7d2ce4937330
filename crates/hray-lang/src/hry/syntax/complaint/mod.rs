//! What is said about a text that is not hry: every message of the lexer and the parser, by what it is about.

mod bindings;
mod bracketed;
pub(crate) mod brackets;
pub(crate) mod characters;
mod expressions;
pub(crate) mod foreign;
mod found;
mod imports;
pub(crate) mod numbers;
mod patterns;
mod povray;
mod values;

use super::parser::MOST_ERRORS;
use crate::diagnostic::{Diagnostic, Span};

/// Puts errors in their order, without those that others explain, and no more than anybody reads.
pub(crate) fn tidy(text: &str, base: usize, mut errors: Vec<Diagnostic>) -> Vec<Diagnostic> {
    errors.sort_by_key(|error| (error.primary.span.start, rank(error)));
    let comment =
        errors.iter().find(|error| error.code == "unclosed-comment").map(|error| error.primary.span.start);
    if let Some(comment) = comment {
        let start =
            text.get(..comment.saturating_sub(base)).and_then(|text| text.rfind('\n')).map_or(0, |at| at + 1);
        // The comment hides the rest of the text, so what is missing there is not missing.
        errors.retain(|error| {
            is_lexical(error.code)
                || error.primary.span.end < base + start && error.code != "unclosed-bracket"
        });
    }
    // A text that is not closed takes the closing brackets of its line with it.
    let swallowed: Vec<Span> = errors
        .iter()
        .filter(|error| matches!(error.code, "unclosed-text" | "tight-comment"))
        .map(|error| error.primary.span)
        .filter(|span| {
            let rest = text.get(span.start.saturating_sub(base)..).and_then(|rest| rest.lines().next());
            rest.is_some_and(|rest| rest.contains([')', ']', '}']))
        })
        .collect();
    errors.retain(|error| {
        let place = error.suggestion.as_ref().map_or(error.primary.span, |suggestion| suggestion.span);
        error.code != "unclosed-bracket"
            || !swallowed
                .iter()
                .any(|text| error.primary.span.start < text.start && text.start <= place.start)
    });
    let mut kept: Vec<Diagnostic> = Vec::new();
    for error in errors {
        // What is inside the place of another error may say it better.
        if rank(&error) == 1 && kept.last().is_some_and(|last| rank(last) == 2 && overlap(last, &error)) {
            kept.pop();
        }
        if !kept.last().is_some_and(|last| explains(text, base, last, &error)) {
            kept.push(error);
        }
    }
    kept.truncate(MOST_ERRORS);
    kept
}

/// Of two errors at one place the one that says more goes first: what is wrong with the characters, unless the parser
/// knows what they were meant for.
fn rank(error: &Diagnostic) -> u8 {
    match error.code {
        "missing-backslash" | "list-pattern" | "list-spread" => 0,
        code if is_lexical(code) => 1,
        _ => 2,
    }
}

fn is_lexical(code: &str) -> bool {
    let codes = [
        "foreign-comment",
        "foreign-operator",
        "number-too-large",
        "odd-color",
        "odd-number",
        "odd-quotes",
        "odd-space",
        "tight-comment",
        "tight-modulo",
        "unclosed-comment",
        "unclosed-text",
        "unknown-character",
        "unknown-escape",
    ];
    codes.contains(&code)
}

fn overlap(a: &Diagnostic, b: &Diagnostic) -> bool {
    let (a, b) = (a.primary.span, b.primary.span);
    a.start == b.start || a.start < b.end && b.start < a.end
}

/// Whether an error would not be there without the one before it.
fn explains(text: &str, base: usize, before: &Diagnostic, error: &Diagnostic) -> bool {
    let between =
        text.get(before.primary.span.end.saturating_sub(base)..error.primary.span.start.saturating_sub(base));
    let is_same_line = between.is_some_and(|between| !between.contains('\n'));
    let means_nothing = matches!(before.code, "unknown-character" | "unclosed-text");
    overlap(before, error) || means_nothing && is_same_line && (rank(error) != 1 || error.code == before.code)
}

/// Source text between backticks, cut where it is long.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let line = text.lines().next().unwrap_or("");
    match line.get(..line.floor_char_boundary(LONGEST)) {
        Some(head) if line.len() > LONGEST || line.len() < text.len() => format!("`{head}...`"),
        _ => format!("`{line}`"),
    }
}

/// A name with a lower-case initial.
pub(crate) fn lower_case(name: &str) -> String {
    let is_shouted = name.len() > 1 && name.chars().all(|c| c.is_uppercase() || c == '_');
    let mut rest = name.chars();
    match rest.next() {
        _ if is_shouted => name.to_lowercase(),
        Some(initial) => initial.to_lowercase().chain(rest).collect(),
        None => String::new(),
    }
}
