//! Numbers and colours.

use super::quoted;
use crate::diagnostic::{Diagnostic, Span};

/// A number that is not written as one.
pub(crate) fn odd_number(text: &str, span: Span) -> Diagnostic {
    let error = |message: String, label: &str| Diagnostic::error("odd-number", message, span, label);
    let digits = text.find(|c: char| !c.is_ascii_digit() && !matches!(c, '_' | '.')).unwrap_or(text.len());
    let (number, rest) = text.split_at(digits);
    if let Some(value) = hexadecimal(text) {
        let message = format!("{} is not a number in hry", quoted(text));
        let error = error(message, "numbers are written in decimal digits");
        return error
            .with_suggestion(span, value.to_string(), "in decimal digits that is")
            .with_note("a colour is written `#rrggbb`");
    }
    if number.matches('.').count() > 1 {
        return error(
            format!("{} has more than one decimal point", quoted(text)),
            "expected one point at most",
        );
    }
    let place = Span::at(span.start + digits);
    let unit = Span::new(span.start + digits, span.end);
    match rest {
        "e" | "E" => error(
            format!("the exponent of {} is missing", quoted(text)),
            "expected digits after the `e`, such as `1e-3`",
        ),
        "rad" => error("angles are in radians already".into(), "expected a plain number").with_suggestion(
            unit,
            "",
            "leave the `rad` out",
        ),
        "degrees" | "degree" | "DEG" | "Deg" => error(
            format!("the unit of an angle is `deg`, not `{rest}`"),
            "expected `deg`",
        )
        .with_suggestion(unit, "deg", "write `deg`"),
        "f" | "d" | "F" | "L" | "u" => error(
            format!("a number has no suffix `{rest}`"),
            "there is one kind of number",
        )
        .with_suggestion(unit, "", "leave it out"),
        _ => error(
            format!("{} is neither a number nor a name", quoted(text)),
            "a name does not begin with a digit",
        )
        .with_suggestion(place, " * ", "for a product, write the `*`"),
    }
}

fn hexadecimal(text: &str) -> Option<u64> {
    let lower = text.to_ascii_lowercase();
    if let Some(digits) = lower.strip_prefix("0x") {
        return u64::from_str_radix(digits, 16).ok();
    }
    u64::from_str_radix(lower.strip_prefix("0b")?, 2).ok()
}

/// A number beyond what a float holds.
pub(crate) fn too_large(text: &str, span: Span) -> Option<Diagnostic> {
    let is_short = text.len() < 16 && !text.contains(['e', 'E']);
    if is_short || super::super::lower::number(text).is_finite() {
        return None;
    }
    Some(Diagnostic::error(
        "number-too-large",
        format!("{} is too large", quoted(text)),
        span,
        "the largest number is about 1.8e308",
    ))
}

/// `7%2`: a percentage or a remainder?
pub(crate) fn tight_modulo(number: &str, rest: &str, span: Span) -> Diagnostic {
    let percent = Span::new(span.end, span.end + 1);
    let next = rest.chars().nth(1).unwrap_or(' ');
    let message = format!("`{number}%{next}...` could be a percentage or a remainder");
    let error =
        Diagnostic::error("tight-modulo", message, percent, "directly after digits `%` means per cent");
    error.with_suggestion(percent, " % ", "for the remainder of a division, put spaces around it")
}

/// A colour whose digits are not right.
pub(crate) fn color(text: &str, span: Span) -> Option<Diagnostic> {
    let digits = text.get(1..).unwrap_or("");
    let odd = digits.char_indices().find(|(_, c)| !c.is_ascii_hexdigit());
    if odd.is_none() && matches!(digits.len(), 3 | 6) {
        return None;
    }
    let message = format!("{} is not a colour", quoted(text));
    if let Some((at, odd)) = odd {
        let place = Span::new(span.start + 1 + at, span.start + 1 + at + odd.len_utf8());
        let error = Diagnostic::error(
            "odd-color",
            message,
            place,
            format!("`{odd}` is not one of the digits 0 to 9 and a to f"),
        );
        let directives = [
            "declare", "local", "macro", "include", "version", "if", "while", "end", "default", "define",
            "import",
        ];
        if directives.contains(&digits) {
            let message = format!("there are no directives such as `{text}` in hry");
            let error = Diagnostic::error("odd-color", message, span, "not a part of the language");
            return Some(
                error.with_help("a value gets a name with `name = value`, other files come in with `import`"),
            );
        }
        let looks_like_a_word = digits.chars().all(char::is_alphabetic);
        let help = "a colour is `#` and 3 or 6 hexadecimal digits, such as `#ffb000`";
        return Some(match looks_like_a_word {
            true => error.with_help(format!("{help}; a comment begins with `--`")),
            false => error.with_help(help),
        });
    }
    let label = format!("expected 3 or 6 hexadecimal digits, found {}", digits.len());
    let error = Diagnostic::error("odd-color", message, span, label);
    Some(match digits.len() {
        8 => error.with_suggestion(
            Span::new(span.start + 7, span.end),
            "",
            "colours have no opacity; leave it out",
        ),
        4 => error.with_suggestion(
            Span::new(span.start + 4, span.end),
            "",
            "colours have no opacity; leave it out",
        ),
        _ => error.with_help("`#f80` is short for `#ff8800`: red, green and blue"),
    })
}
