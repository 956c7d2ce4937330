//! Characters, comments and texts.

use super::super::kind::SyntaxKind;
use super::super::lexer::is_closed_comment;
use super::quoted;
use crate::diagnostic::{Diagnostic, Span};

/// Something that is no part of the language.
pub(crate) fn unknown(text: &str, span: Span) -> Diagnostic {
    let message = match text {
        "`" => "a function is not written between backticks".to_owned(),
        _ => format!("the character {} means nothing in hry", quoted(text)),
    };
    let error = Diagnostic::error("unknown-character", message, span, "not a part of the language");
    match text {
        "\u{b0}" => error.with_suggestion(span, "deg", "degrees are written"),
        "?" => error.with_help("a choice is written `if condition then a else b`"),
        "$" => error.with_help("put the argument in parentheses, or write `argument |> function`"),
        "@" => error.with_help("to name a whole and its parts, match on the name in the body"),
        "`" => error.with_help("functions come before their arguments: `f a b`"),
        "~" => error.with_help("`not` negates a condition, `-` a number"),
        "\"" | "'" => error.with_help("texts are written between double quotes: \"text\""),
        _ => error,
    }
}

/// A comment between `{-` and `-}`, where it is not closed.
pub(crate) fn block_comment(text: &str, span: Span) -> Option<Diagnostic> {
    if is_closed_comment(text) {
        return None;
    }
    let open = Span::new(span.start, span.start + 2);
    let message = "this comment is not closed";
    let error = Diagnostic::error(
        "unclosed-comment",
        message,
        open,
        "begins here and goes on to the end of the file",
    );
    let nests = text.matches("{-").count() > 1 && text.contains("-}");
    let error =
        if nests { error.with_note("comments nest: every `{-` needs a `-}` of its own") } else { error };
    if text.chars().nth(2).is_some_and(|next| next.is_alphanumeric() || next == '(') {
        let minus = Span::at(span.start + 1);
        return Some(error.with_suggestion(
            minus,
            " ",
            "for a negative value in braces, put a space before the `-`",
        ));
    }
    Some(error.with_help("close it with `-}`; a comment of one line is written `-- ...`"))
}

/// White space that only looks like it.
pub(crate) fn odd_space(text: &str, span: Span) -> Diagnostic {
    let first = text.chars().next().unwrap_or(' ');
    let (what, replacement) = match first {
        '\u{a0}' | '\u{202f}' => ("a non-breaking space", " "),
        '\u{ad}' | '\u{200b}'..='\u{200d}' | '\u{2060}' | '\u{feff}' => ("an invisible character", ""),
        '\u{2028}' | '\u{2029}' | '\u{85}' => ("an unusual line break", "\n"),
        _ => ("an unusual space", " "),
    };
    let message = format!("{what} (U+{:04X}) stands here", first as u32);
    let error = Diagnostic::error("odd-space", message, span, "looks harmless, but is not a space");
    match replacement {
        "" => error.with_suggestion(span, "", "remove it"),
        _ => error.with_suggestion(span, replacement, "write an ordinary one"),
    }
}

/// A comment as other languages write it.
pub(crate) fn foreign_comment(text: &str, span: Span) -> Diagnostic {
    let (mark, length) = match text.get(..2) {
        Some(mark @ ("//" | "/*")) => (mark, 2),
        _ => ("#", 1),
    };
    let place = Span::new(span.start, span.start + length);
    let message = format!("`{mark}` does not begin a comment here");
    let error = Diagnostic::error("foreign-comment", message, place, "a comment begins with `--`");
    match mark {
        "/*" => {
            let inner = text.get(2..).unwrap_or("");
            let inner = inner.strip_suffix("*/").unwrap_or(inner);
            error.with_suggestion(
                span,
                format!("{{-{inner}-}}"),
                "a comment over several lines is written `{- ... -}`",
            )
        }
        "//" => error
            .with_note("there is no operator `//` either; a whole quotient is `floor (a / b)`")
            .with_suggestion(place, "--", "write `--`"),
        _ => error.with_suggestion(place, "--", "write `--`"),
    }
}

/// `3--2`, at the place of the `--`.
pub(crate) fn tight_comment(place: Span) -> Diagnostic {
    let span = Span::new(place.start, place.start + 2);
    let message = "`--` begins a comment, so the rest of this line is left out";
    Diagnostic::error("tight-comment", message, span, "a comment from here on").with_suggestion(
        span,
        " - -",
        "to subtract a negative number, put spaces around the first minus",
    )
}

/// A text whose second quote is missing.
pub(crate) fn unclosed_text(text: &str, span: Span) -> Diagnostic {
    let message = "this text is not closed";
    let error = Diagnostic::error("unclosed-text", message, span, "expected `\"` before the end of the line");
    let end = span.start + text.trim_end().len();
    error
        .with_suggestion(Span::at(end), "\"", "close it with `\"`")
        .with_note("a text stays on one line; `\\n` in it stands for a line break")
}

/// A text between other quotes.
pub(crate) fn odd_text(text: &str, span: Span) -> Diagnostic {
    let mut inner = text.chars();
    let (open, close) = (inner.next().unwrap_or('\''), inner.next_back().unwrap_or('\''));
    let message = format!("a text is written between double quotes, not between `{open}` and `{close}`");
    let error = Diagnostic::error("odd-quotes", message, span, "expected `\"...\"`");
    let replacement = format!("\"{}\"", inner.as_str().replace('"', "\\\""));
    error.with_suggestion(span, replacement, "use double quotes")
}

/// The escapes of a text: the first that means nothing.
pub(crate) fn escapes(text: &str, span: Span) -> Option<Diagnostic> {
    let mut characters = text.char_indices();
    while let Some((at, character)) = characters.next() {
        if character != '\\' {
            continue;
        }
        match characters.next() {
            Some((_, 'n' | 't' | '"' | '\\')) => {}
            Some((next, odd)) => {
                let place = Span::new(span.start + at, span.start + next + odd.len_utf8());
                let message = format!("`\\{odd}` means nothing in a text");
                let label = "known are `\\n`, `\\t`, `\\\"` and `\\\\`";
                let error = Diagnostic::error("unknown-escape", message, place, label);
                return Some(error.with_suggestion(
                    Span::at(place.start),
                    "\\",
                    "for a backslash, write two",
                ));
            }
            None => {}
        }
    }
    None
}

/// An operator as other languages write it; `kind` is what it is taken for.
pub(crate) fn foreign_operator(text: &str, kind: SyntaxKind, span: Span) -> Diagnostic {
    if kind == SyntaxKind::Unknown {
        let message = format!("there is no operator `{text}`");
        let error = Diagnostic::error("foreign-operator", message, span, "not an operator of hry");
        return error.with_help("write `argument |> function`, or put the argument in parentheses");
    }
    let spelling = kind.spelling();
    let message = match text {
        "\u{2212}" | "\u{2013}" | "\u{2014}" => {
            format!("`{text}` (U+{:04X}) only looks like a minus", code(text))
        }
        "&&" | "||" => format!("`{text}` is written `{spelling}` in hry"),
        "&" => "`&` is written `and` in hry".to_owned(),
        "+=" | "-=" | "*=" => format!("nothing can be changed, so there is no `{text}`"),
        _ => format!("`{text}` is written `{spelling}` in hry"),
    };
    let error = Diagnostic::error("foreign-operator", message, span, format!("expected `{spelling}`"));
    match text {
        "+=" | "-=" | "*=" => error.with_help("give the new value a name of its own: `b = a + 1`"),
        "<<" => error.with_help("`f >> g` does `f` first, then `g`"),
        "::" => error.with_suggestion(span, spelling, "a type follows one `:`"),
        _ => error.with_suggestion(span, spelling, format!("write `{spelling}`")),
    }
}

fn code(text: &str) -> u32 {
    text.chars().next().map_or(0, |character| character as u32)
}
