//! Numbers: what the literals mean, and what was meant by those that are none.

use super::grammar::NumberKind;
use super::token::quoted;
use crate::diagnostic::{Diagnostic, Span};

/// A longer replacement would not help anyone.
const LONGEST_SUGGESTION: usize = 40;

/// The value of a real literal, correctly rounded; none where it is too large for one.
pub(crate) fn read_real(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|value| value.is_finite())
}

/// The value of an integer literal; none where it is too large for one.
pub(crate) fn read_integer(text: &str) -> Option<i64> {
    text.parse::<i64>().ok()
}

/// The error about a literal that is too large.
pub(crate) fn too_large(kind: NumberKind, text: &str, span: Span) -> Diagnostic {
    let (noun, label) = match kind {
        NumberKind::Real => {
            ("real number", "the largest real number is about 1.8 times 10 to the power 308".to_string())
        }
        NumberKind::Integer => ("integer", format!("integers lie between {} and {}", i64::MIN, i64::MAX)),
    };
    let message = format!("the {noun} {} is too large", quoted(text));
    Diagnostic::error("number-too-large", message, span, label)
}

/// How to write `text` (a number in any notation) as a number of this kind; none where that is not clear,
/// or where the number is not whole and has to be.
pub(crate) fn rewritten(text: &str, kind: NumberKind) -> Option<String> {
    let plain = plain(text)?;
    let rewritten = match kind {
        NumberKind::Real if plain.contains('.') => plain,
        NumberKind::Real => plain + ".0",
        NumberKind::Integer => match plain.split_once('.') {
            None => plain,
            Some((whole, fraction)) if fraction.bytes().all(|digit| digit == b'0') => whole.into(),
            Some(_) => return None,
        },
    };
    (rewritten.len() <= LONGEST_SUGGESTION).then_some(rewritten)
}

/// A number in any notation as digits with at most one point, which has digits on both sides.
fn plain(text: &str) -> Option<String> {
    let digits = text.trim_start_matches(['+', '-', '−', '–', '—', ' ', '\t']);
    let signs = text.get(..text.len() - digits.len()).unwrap_or_default();
    let minus = if signs.contains(['-', '−', '–', '—']) { "-" } else { "" };
    if digits.is_empty() || digits.len() > LONGEST_SUGGESTION || digits.matches('.').count() > 1 {
        return None;
    }
    let value = if digits.contains(['e', 'E']) {
        let value: f64 = digits.parse().ok()?;
        // The notation of `Display` has no exponent.
        format!("{value}")
    } else {
        digits.to_string()
    };
    let (whole, fraction) = value.split_once('.').map_or((&*value, None), |(w, f)| (w, Some(f)));
    let whole = if whole.is_empty() { "0" } else { whole };
    Some(match fraction {
        None => format!("{minus}{whole}"),
        Some("") => format!("{minus}{whole}.0"),
        Some(fraction) => format!("{minus}{whole}.{fraction}"),
    })
}

/// What is wrong with a number in a notation that the grammar does not have.
pub(crate) fn fault(text: &str) -> &'static str {
    let signs: Vec<char> = text.chars().take_while(|c| !c.is_ascii_digit() && *c != '.').collect();
    if !text.contains(|c: char| c.is_ascii_digit()) {
        return "a sign belongs directly before the digits of a number";
    }
    match signs[..] {
        ['+', ..] => "a positive number has no sign",
        ['−' | '–' | '—', ..] => "the minus sign is the plain `-` of the keyboard",
        ['-', ' ' | '\t', ..] => "the `-` belongs directly before the digits",
        ['-', _, ..] => "a number has one sign at most",
        _ if text.contains(['e', 'E']) => "numbers are written out, without an exponent",
        _ if text.matches('.').count() > 1 => "a number has one point at most",
        _ => "a point has digits on both sides",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use NumberKind::{Integer, Real};

    #[test]
    fn odd_notations_are_rewritten_where_the_meaning_is_clear() {
        for (text, kind, expected) in [
            ("1", Real, Some("1.0")),
            ("-3", Real, Some("-3.0")),
            ("10.0", Integer, Some("10")),
            ("10.5", Integer, None),
            ("1.", Real, Some("1.0")),
            ("1.", Integer, Some("1")),
            (".5", Real, Some("0.5")),
            ("-.5", Real, Some("-0.5")),
            ("1e5", Real, Some("100000.0")),
            ("1.5e-3", Real, Some("0.0015")),
            ("1e3", Integer, Some("1000")),
            ("1e300", Real, None),
            ("+5", Real, Some("5.0")),
            ("- 5", Integer, Some("-5")),
            ("−5.5", Real, Some("-5.5")),
            ("--5", Integer, Some("-5")),
            ("1.2.3", Real, None),
            ("1..2", Real, None),
        ] {
            assert_eq!(rewritten(text, kind).as_deref(), expected, "{text}");
        }
    }

    #[test]
    fn reals_are_rounded_correctly_and_keep_the_sign_of_zero() {
        assert_eq!(read_real("0.1"), Some(0.1));
        assert!(read_real("-0.0").unwrap().is_sign_negative());
        assert_eq!(read_real(&format!("1{}.0", "0".repeat(400))), None);
        assert_eq!(read_integer("-9223372036854775808"), Some(i64::MIN));
        assert_eq!(read_integer("9223372036854775808"), None);
    }
}
