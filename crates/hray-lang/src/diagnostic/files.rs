//! The files that diagnostics speak of.

use super::locate::Locations;
use super::render::clean;
use super::{Diagnostic, Span};
use crate::hry::Sources;
use std::collections::BTreeMap;

/// A file with the places that are needed in it.
pub(super) struct File<'a> {
    /// Its name, fit for a terminal.
    pub(super) name: String,
    pub(super) text: &'a str,
    /// The offset that spans give its first byte.
    base: usize,
    pub(super) locations: Locations,
}

impl File<'_> {
    /// A span as bytes of this file; moved to where it fits, and cut where its first line ends.
    pub(super) fn fit(&self, span: Span) -> Span {
        let local = Span::new(span.start.saturating_sub(self.base), span.end.saturating_sub(self.base));
        fit(self.text, local)
    }
}

/// The files that some diagnostics speak of, in the order of their offsets.
pub(super) struct Files<'a>(Vec<File<'a>>);

impl<'a> Files<'a> {
    /// One file, of which the offsets are its own.
    pub(super) fn single(name: &str, text: &'a str, diagnostics: &[Diagnostic]) -> Self {
        let spans = diagnostics.iter().flat_map(Diagnostic::spans);
        Self(vec![file(name, text, 0, spans.collect())])
    }

    /// Those of a program.
    pub(super) fn of(sources: &'a Sources, diagnostics: &[Diagnostic]) -> Self {
        let mut found = BTreeMap::new();
        for span in diagnostics.iter().flat_map(Diagnostic::spans) {
            if let Some(file) = sources.file(span.start) {
                found.entry(file.base).or_insert((file, Vec::new())).1.push(span);
            }
        }
        let files = found.into_values().map(|(of, spans)| file(&of.name, &of.text, of.base, spans));
        Self(files.collect())
    }

    /// The file that a span lies in, by its place among all.
    pub(super) fn position(&self, span: Span) -> usize {
        self.0.partition_point(|file| file.base <= span.start).saturating_sub(1)
    }

    /// The file at a place among all.
    pub(super) fn get(&self, position: usize) -> Option<&File<'a>> {
        self.0.get(position)
    }
}

fn file<'a>(name: &str, text: &'a str, base: usize, spans: Vec<Span>) -> File<'a> {
    let mut file = File { name: clean(name), text, base, locations: Locations::new(text, Vec::new()) };
    let offsets = spans.into_iter().flat_map(|span| {
        let Span { start, end } = file.fit(span);
        [start, end]
    });
    let offsets = offsets.collect();
    file.locations = Locations::new(text, offsets);
    file
}

/// The part of a span that lies in the source, on character boundaries and on its first line.
fn fit(source: &str, span: Span) -> Span {
    let text_start = if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
    let start = source.floor_char_boundary(span.start).max(text_start);
    let end = source.ceil_char_boundary(span.end).max(start);
    // A longer underline is not shown, so there is no need to look for its end further on.
    let near = source.ceil_char_boundary(end.min(start + 1000));
    let text = source.get(start..near).unwrap_or_default();
    let end = text.find('\n').map_or(end, |length| start + length);
    if source.get(start..end).is_some_and(|text| text.len() > 1 && text.ends_with('\r')) {
        return Span::new(start, end - 1);
    }
    Span::new(start, end)
}
