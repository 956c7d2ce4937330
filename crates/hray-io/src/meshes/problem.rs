//! What is wrong with a file of meshes, and where.

use std::fmt;

/// Why a file cannot be understood.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Problem {
    at: At,
    what: String,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
enum At {
    /// A line, counted from 1.
    Line(usize),
    /// Bytes from the start.
    Byte(usize),
    /// A place in a JSON document, such as `nodes[3]`; the file as a whole where it is empty.
    Part(String),
}

pub(crate) type Outcome<T> = Result<T, Problem>;

impl Problem {
    pub(crate) fn line(line: usize, what: impl Into<String>) -> Self {
        Self { at: At::Line(line), what: what.into() }
    }

    pub(crate) fn byte(byte: usize, what: impl Into<String>) -> Self {
        Self { at: At::Byte(byte), what: what.into() }
    }

    pub(crate) fn part(part: impl Into<String>, what: impl Into<String>) -> Self {
        Self { at: At::Part(part.into()), what: what.into() }
    }

    pub(crate) fn file(what: impl Into<String>) -> Self {
        Self::part("", what)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.at {
            At::Line(line) => write!(f, "line {line}: ")?,
            At::Byte(byte) => write!(f, "at byte {byte}: ")?,
            At::Part(part) if part.is_empty() => {}
            At::Part(part) => write!(f, "{part}: ")?,
        }
        f.write_str(&self.what)
    }
}
