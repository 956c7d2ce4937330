//! The files that diagnostics are about.

use super::locate::Locations;
use super::render::clean;
use super::{Diagnostic, Span};
use crate::hry::Sources;

/// A file, and the places in it that are mentioned.
pub(super) struct File<'a> {
    /// What it is called, fit for a terminal.
    pub(super) name: String,
    pub(super) text: &'a str,
    /// What is added to its offsets in a span.
    pub(super) base: usize,
    pub(super) locations: Locations,
}

/// The files that are mentioned, in the order of their bases.
pub(super) struct Files<'a>(Vec<File<'a>>);

impl<'a> Files<'a> {
    /// A single file, in which every span is.
    pub(super) fn one(name: &str, text: &'a str, diagnostics: &[Diagnostic]) -> Self {
        Self(vec![File::new(name, text, 0, diagnostics.iter().flat_map(Diagnostic::spans))])
    }

    /// The files of a program that diagnostics mention.
    pub(super) fn of(sources: &'a Sources, diagnostics: &[Diagnostic]) -> Self {
        let mut spans: Vec<Span> = diagnostics.iter().flat_map(Diagnostic::spans).collect();
        spans.sort_unstable();
        let base = |span: &Span| sources.file(span.start).map(|file| file.base);
        let files = spans.chunk_by(|a, b| base(a) == base(b)).filter_map(|spans| {
            let file = sources.file(spans.first()?.start)?;
            Some(File::new(&file.name, &file.text, file.base, spans.iter().copied()))
        });
        Self(files.collect())
    }

    pub(super) fn get(&self, number: usize) -> Option<&File<'a>> {
        self.0.get(number)
    }

    /// The number of the file that a span is in, and the part of the span that lies in it, on character boundaries and
    /// on its first line.
    pub(super) fn local(&self, span: Span) -> (usize, Span) {
        let number = self.0.partition_point(|file| file.base <= span.start).saturating_sub(1);
        (number, self.0.get(number).map_or(span, |file| file.fit(span)))
    }
}

impl<'a> File<'a> {
    fn new(name: &str, text: &'a str, base: usize, spans: impl Iterator<Item = Span>) -> Self {
        let mut file = Self { name: clean(name), text, base, locations: Locations::new("", Vec::new()) };
        let ends = spans.flat_map(|span| {
            let span = file.fit(span);
            [span.start, span.end]
        });
        file.locations = Locations::new(text, ends.collect());
        file
    }

    fn fit(&self, span: Span) -> Span {
        fit(self.text, Span::new(span.start.saturating_sub(self.base), span.end.saturating_sub(self.base)))
    }
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
