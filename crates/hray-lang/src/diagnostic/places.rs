//! Places for programs: what an editor needs to know of a span.

use super::locate::Locations;
use super::{Diagnostic, Span};
use crate::hry::Sources;

/// A place in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// The offset in bytes from the start of the file.
    pub offset: usize,
}

/// A stretch of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place<'a> {
    /// The name of the file.
    pub file: &'a str,
    /// The first character.
    pub start: Point,
    /// One past the last.
    pub end: Point,
}

/// The places of all spans of some diagnostics, found with one walk over each file.
pub struct Places<'a> {
    /// In the order of their bases: the base of a file, its name, the length of its text, and its places.
    files: Vec<(usize, &'a str, &'a str, Locations)>,
}

impl std::fmt::Debug for Places<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Places").finish_non_exhaustive()
    }
}

impl<'a> Places<'a> {
    /// The places that diagnostics mention.
    #[must_use]
    pub fn new(sources: &'a Sources, diagnostics: &[Diagnostic]) -> Self {
        let mut spans: Vec<Span> = diagnostics.iter().flat_map(Diagnostic::spans).collect();
        spans.sort_unstable();
        let base = |span: &Span| sources.file(span.start).map(|file| file.base);
        let files = spans.chunk_by(|a, b| base(a) == base(b)).filter_map(|spans| {
            let file = sources.file(spans.first()?.start)?;
            let offsets = spans.iter().flat_map(|span| [span.start, span.end]);
            let offsets = offsets.map(|offset| local(&file.text, file.base, offset)).collect();
            Some((file.base, &*file.name, &*file.text, Locations::new(&file.text, offsets)))
        });
        Self { files: files.collect() }
    }

    /// The place of a span of those diagnostics; none of one that is in no file.
    #[must_use]
    pub fn of(&self, span: Span) -> Option<Place<'a>> {
        let after = self.files.partition_point(|file| file.0 <= span.start);
        let (base, file, text, locations) = self.files.get(after.checked_sub(1)?)?;
        let point = |offset| {
            let offset = local(text, *base, offset);
            let location = locations.get(offset);
            Point { line: location.line, column: location.column, offset }
        };
        Some(Place { file, start: point(span.start), end: point(span.end.max(span.start)) })
    }
}

/// The offset in a file, on a character boundary.
fn local(text: &str, base: usize, offset: usize) -> usize {
    text.floor_char_boundary(offset.saturating_sub(base))
}
