//! Words and numbers of files that are text.

use super::problem::{Outcome, Problem};
use std::fmt;

/// The most bytes of a word that a message shows.
const SHOWN: usize = 40;

/// The words of a text, whatever lines they are on.
#[derive(Clone, Debug)]
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The line of the last word, counted from 1.
    line: usize,
}

impl<'a> Words<'a> {
    /// The words from an offset on, which lies in a line.
    pub(super) fn new(bytes: &'a [u8], at: usize, line: usize) -> Self {
        Self { bytes, at, line }
    }

    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Bytes that are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len().saturating_sub(self.at)
    }

    /// The rest of the line.
    pub(super) fn skip_line(&mut self) {
        while self.bytes.get(self.at).is_some_and(|byte| *byte != b'\n') {
            self.at += 1;
        }
    }

    pub(super) fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            let byte = *self.bytes.get(self.at)?;
            if !byte.is_ascii_whitespace() {
                break;
            }
            self.line += usize::from(byte == b'\n');
            self.at += 1;
        }
        let start = self.at;
        while self.bytes.get(self.at).is_some_and(|byte| !byte.is_ascii_whitespace()) {
            self.at += 1;
        }
        self.bytes.get(start..self.at)
    }

    /// The next word, which is there for `what`.
    pub(super) fn expect(&mut self, what: &str) -> Outcome<&'a [u8]> {
        self.next()
            .ok_or_else(|| Problem::line(self.line, format!("the file ends where {what} should follow")))
    }
}

/// A word in a message: in quotes, and not too long.
pub(super) struct Word<'a>(pub(super) &'a [u8]);

impl fmt::Display for Word<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = self.0.get(..SHOWN).unwrap_or(self.0);
        let text = String::from_utf8_lossy(shown);
        let more = if shown.len() < self.0.len() { "..." } else { "" };
        write!(f, "{text:?}{more}")
    }
}

fn parsed<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// A number in single precision, which is finite.
pub(super) fn float(word: &[u8], what: &str, line: usize) -> Outcome<f32> {
    match parsed::<f32>(word) {
        Some(number) if number.is_finite() => Ok(number),
        Some(_) => Err(Problem::line(line, format!("{what} is {}, and must be a finite number", Word(word)))),
        None => Err(Problem::line(line, format!("{what} must be a number, and is {}", Word(word)))),
    }
}

/// A whole number. Some programs write those with a point.
pub(super) fn whole(word: &[u8], what: &str, line: usize) -> Outcome<i64> {
    let found = parsed::<i64>(word).or_else(|| {
        let number = parsed::<f64>(word)?;
        (number.fract() == 0.0 && number.abs() < 9e15).then_some(number as i64)
    });
    found.ok_or_else(|| Problem::line(line, format!("{what} must be a whole number, and is {}", Word(word))))
}
