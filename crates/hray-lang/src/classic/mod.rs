//! The scene language of 2005: the grammar of thesis appendix A.5.
//!
//! [`parse`] reads it and [`write`](fn@write) prints it. A file that is wrong gives several errors in one
//! run, each with its place, what was expected, and a suggestion where one is near.
//!
//! The grammar is data (`grammar`): a handful of flat sequences in which every number has a name.
//! `sequence` walks a sequence and the tokens side by side. Where they part, `repair` finds the least change
//! that brings them together again, `complaint` puts that change into words, and reading goes on as if it
//! had been made. Nothing recurses, and the work is linear in the length of the source: after 20 errors the
//! rest is not read.

mod build;
mod comments;
mod complaint;
mod cursor;
mod elements;
mod grammar;
mod number;
mod parser;
mod repair;
mod route;
mod sections;
mod sequence;
mod spans;
mod token;
mod values;
mod words;
mod write;

pub use spans::Spans;
pub use write::write;

use crate::diagnostic::Diagnostic;
use hray_core::Description;
use parser::{MOST_ERRORS, Parser};

/// What came of reading a source.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// What the source describes; none where there are errors.
    pub description: Option<Description>,
    /// Where its parts stand; complete where there is a description.
    pub spans: Spans,
    /// The errors, in the order of the source.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a source. Primitives and lights keep its order; a byte order mark at its start is skipped.
///
/// Time is linear in the length of the source and memory in the length of the scene.
#[must_use]
pub fn parse(source: &str) -> Parsed {
    let mut parser = Parser::new(source);
    let halted = parser.file().is_err();
    let full = halted && parser.is_full();
    let Parser { mut diagnostics, built, cursor, .. } = parser;
    diagnostics.extend(cursor.comment_error());
    diagnostics.sort_by_key(|diagnostic| diagnostic.primary.span);
    if full && let Some(last) = diagnostics.last_mut() {
        let note = format!("too many errors: the rest is not read after {MOST_ERRORS} of them");
        last.notes.push(note);
    }
    let (description, spans) = built.finish();
    let description = description.filter(|_| diagnostics.is_empty() && !halted);
    Parsed { description, spans, diagnostics }
}
