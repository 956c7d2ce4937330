//! The values of literals.

use std::borrow::Cow;

/// The value of a number as it is written; 0 for what is not a number.
pub(crate) fn number(text: &str) -> f64 {
    if let Some(digits) = text.strip_suffix("deg") {
        return plain(digits) * (std::f64::consts::PI / 180.0);
    }
    match text.strip_suffix('%') {
        Some(digits) => plain(digits) / 100.0,
        None => plain(text),
    }
}

fn plain(digits: &str) -> f64 {
    let digits: Cow<'_, str> = match digits.contains('_') {
        true => Cow::Owned(digits.replace('_', "")),
        false => Cow::Borrowed(digits),
    };
    digits.parse().unwrap_or(0.0)
}

/// What a text says.
pub(super) fn text(written: &str) -> String {
    let mut inner = written.chars();
    inner.next();
    let mut inner = inner.as_str();
    if let Some(last) = inner.chars().next_back().filter(|last| !last.is_alphanumeric()) {
        inner = inner.strip_suffix(last).unwrap_or(inner);
    }
    let mut said = String::with_capacity(inner.len());
    let mut characters = inner.chars();
    while let Some(character) = characters.next() {
        if character != '\\' {
            said.push(character);
            continue;
        }
        match characters.next() {
            Some('n') => said.push('\n'),
            Some('t') => said.push('\t'),
            Some(other) => said.push(other),
            None => said.push('\\'),
        }
    }
    said
}

/// The bytes of a colour; black for what is not a colour.
pub(super) fn color(text: &str) -> [u8; 3] {
    let digits = text.get(1..).unwrap_or("");
    let byte = |from: usize, to: usize| {
        digits.get(from..to).and_then(|digits| u8::from_str_radix(digits, 16).ok()).unwrap_or(0)
    };
    match digits.len() {
        3 => [byte(0, 1) * 17, byte(1, 2) * 17, byte(2, 3) * 17],
        6 => [byte(0, 2), byte(2, 4), byte(4, 6)],
        _ => [0; 3],
    }
}
