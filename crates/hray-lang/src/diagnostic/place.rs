//! Places as editors and programs count them.

use super::locate::Locations;
use super::{Diagnostic, Span};
use crate::hry::Sources;
use std::collections::BTreeMap;

/// Where a span lies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The name of its file.
    pub file: String,
    /// The line of its start, from 1.
    pub line: usize,
    /// The column of its start in characters, from 1.
    pub column: usize,
    /// The line of its end.
    pub end_line: usize,
    /// The column of its end: one past its last character.
    pub end_column: usize,
    /// Its bytes in that file.
    pub span: Span,
}

/// The places of all spans of some diagnostics, found in one walk over each file.
pub struct Places<'a> {
    sources: &'a Sources,
    /// By the base of a file.
    locations: BTreeMap<usize, Locations>,
}

impl std::fmt::Debug for Places<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Places").finish_non_exhaustive()
    }
}

impl<'a> Places<'a> {
    /// Those of `diagnostics` about `sources`.
    #[must_use]
    pub fn new(sources: &'a Sources, diagnostics: &[Diagnostic]) -> Self {
        let mut offsets: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for span in diagnostics.iter().flat_map(Diagnostic::spans) {
            if let Some((base, local)) = local(sources, span) {
                offsets.entry(base).or_default().extend([local.start, local.end]);
            }
        }
        let located = |(base, offsets): (usize, Vec<usize>)| {
            let text = sources.file(base).map_or("", |file| &file.text);
            (base, Locations::new(text, offsets))
        };
        Self { sources, locations: offsets.into_iter().map(located).collect() }
    }

    /// Where a span of one of the diagnostics lies; none where there is no file at its offset.
    #[must_use]
    pub fn get(&self, span: Span) -> Option<Place> {
        let (base, span) = local(self.sources, span)?;
        let locations = self.locations.get(&base)?;
        let (start, end) = (locations.get(span.start), locations.get(span.end));
        let file = self.sources.file(base)?.name.clone();
        let ((line, column), (end_line, end_column)) = ((start.line, start.column), (end.line, end.column));
        Some(Place { file, line, column, end_line, end_column, span })
    }
}

/// The base of a span's file, and its bytes in that file.
fn local(sources: &Sources, span: Span) -> Option<(usize, Span)> {
    let file = sources.file(span.start)?;
    let start = file.text.floor_char_boundary(span.start - file.base);
    let end = file.text.ceil_char_boundary(span.end.saturating_sub(file.base)).max(start);
    Some((file.base, Span::new(start, end)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_in_their_own_files() {
        let mut sources = Sources::default();
        sources.add("a.hry".into(), "one\ntwö three".into());
        let second = sources.add("b.hry".into(), "x\ny".into());
        let base = sources.files()[second].base;
        let diagnostic = Diagnostic::error("e", "m", Span::new(9, 14), "")
            .with_secondary(Span::new(base, base + 3), "")
            .with_secondary(Span::new(base + 2, base + 900), "");
        let places = Places::new(&sources, std::slice::from_ref(&diagnostic));
        let get = |span| {
            let place = places.get(span).unwrap();
            (place.file, [place.line, place.column, place.end_line, place.end_column], place.span)
        };
        assert_eq!(get(Span::new(9, 14)), ("a.hry".into(), [2, 5, 2, 10], Span::new(9, 14)));
        assert_eq!(get(diagnostic.secondary[0].span), ("b.hry".into(), [1, 1, 2, 2], Span::new(0, 3)));
        assert_eq!(get(diagnostic.secondary[1].span), ("b.hry".into(), [2, 1, 2, 2], Span::new(2, 3)));
    }
}
