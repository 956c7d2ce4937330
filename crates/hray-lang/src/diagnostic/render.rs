//! Diagnostics as text.

use super::excerpt::{Excerpt, excerpts};
use super::locate::Locations;
use super::{Diagnostic, Severity, Span, Suggestion};
use annotate_snippets::{Annotation, AnnotationKind, Level, Patch, Renderer, Snippet};
use std::fmt::Write as _;

/// The longest replacement that is spelt out as a patch of the source.
const LONGEST_PATCH: usize = 200;

/// The diagnostics as text: for each its place as `file:line:column`, the source line with the span
/// underlined, notes, and the suggestion carried out. `color` adds terminal colours.
///
/// Spans that do not fit `source` are moved to where they do, so any combination renders. Of a source of any
/// size only the lines that carry a label are copied, and of long lines only the surroundings of the labels.
#[must_use]
pub fn render(diagnostics: &[Diagnostic], file_name: &str, source: &str, color: bool) -> String {
    let offsets =
        diagnostics.iter().flat_map(Diagnostic::spans).map(|span| fit(source, span).start).collect();
    // The excerpts are cut to size already, so no line is to be cut again.
    let renderer = if color { Renderer::styled() } else { Renderer::plain() }.term_width(10_000);
    let page =
        Page { source, file_name: &clean(file_name), locations: Locations::new(source, offsets), renderer };
    let mut text = String::new();
    for diagnostic in diagnostics {
        text.push_str(&page.render(diagnostic));
        text.push_str("\n\n");
    }
    text.truncate(text.trim_end().len());
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

/// What all diagnostics of a source share.
struct Page<'a> {
    source: &'a str,
    file_name: &'a str,
    locations: Locations,
    renderer: Renderer,
}

impl Page<'_> {
    fn render(&self, diagnostic: &Diagnostic) -> String {
        let level = match diagnostic.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let labels: Vec<_> = std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary).collect();
        let spans: Vec<Span> = labels.iter().map(|label| fit(self.source, label.span)).collect();
        let texts: Vec<String> = labels.iter().map(|label| clean(&label.text)).collect();
        let mut excerpts = excerpts(self.source, &self.locations, &spans);
        // The excerpt of the primary label goes first: it gives the diagnostic its place.
        excerpts.sort_by_key(|excerpt| !excerpt.labels.iter().any(|(index, _)| *index == 0));

        let mut group = level.primary_title(clean(&diagnostic.message)).id(diagnostic.code).elements(
            excerpts.iter().map(|excerpt| {
                let annotations = excerpt.labels.iter().map(|label| annotation(label, &texts));
                Snippet::source(&excerpt.text)
                    .line_start(excerpt.line)
                    .path(self.file_name)
                    .annotations(annotations)
            }),
        );
        group = group.elements(diagnostic.notes.iter().map(|note| Level::NOTE.message(clean_lines(note))));
        group = group.elements(diagnostic.help.iter().map(|help| Level::HELP.message(clean_lines(help))));
        let patched = diagnostic.suggestion.as_ref().map(|suggestion| self.patched(suggestion));
        let text = match (&patched, &diagnostic.suggestion) {
            (Some(Some((excerpt, patch))), Some(suggestion)) => {
                let snippet = Snippet::source(&excerpt.text).line_start(excerpt.line).path(self.file_name);
                let title = Level::HELP.secondary_title(clean(&suggestion.text));
                self.renderer.render(&[group, title.element(snippet.patch(patch.clone()))])
            }
            (_, Some(suggestion)) => {
                let help = Level::HELP.message(clean(&suggestion.text));
                self.renderer.render(&[group.element(help)])
            }
            _ => self.renderer.render(&[group]),
        };
        self.with_true_columns(text, &excerpts, &spans)
    }

    /// The excerpt that shows a suggestion, and the suggestion as a change of that excerpt. None where it
    /// spans lines or is long: then its words have to do.
    fn patched<'s>(&self, suggestion: &'s Suggestion) -> Option<(Excerpt, Patch<'s>)> {
        let span = fit(self.source, suggestion.span);
        let one_line = span == suggestion.span && !suggestion.replacement.contains(['\n', '\r']);
        if !one_line || suggestion.replacement.len() > LONGEST_PATCH {
            return None;
        }
        let excerpt = excerpts(self.source, &self.locations, &[span]).pop()?;
        let range = excerpt.labels.first()?.1.clone();
        let whole = range.len() == span.end - span.start;
        whole.then(|| (excerpt, Patch::new(range, clean(&suggestion.replacement))))
    }

    /// The layout derives columns from the excerpt; where that is only a part of the line, this puts the
    /// column in the file in its stead.
    fn with_true_columns(&self, mut text: String, excerpts: &[Excerpt], spans: &[Span]) -> String {
        let mut from = text.find('\n').unwrap_or(0);
        for excerpt in excerpts {
            // The label that the layout takes: the primary one where there is one, else the first.
            let primary = excerpt.labels.iter().find(|(index, _)| *index == 0);
            let Some((index, range)) = primary.or(excerpt.labels.first()) else { continue };
            let place = self.locations.get(spans.get(*index).map_or(0, |span| span.start));
            let before = excerpt.text.get(..range.start).unwrap_or_default();
            let shown = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
            let printed = format!("{}:{}:{shown}", self.file_name, place.line);
            let Some(at) = text.get(from..).and_then(|rest| rest.find(&printed)).map(|at| at + from) else {
                continue;
            };
            let mut truth = String::new();
            let _ = write!(truth, "{}:{}:{}", self.file_name, place.line, place.column);
            text.replace_range(at..at + printed.len(), &truth);
            from = at + truth.len();
        }
        text
    }
}

fn annotation<'t>((index, range): &(usize, std::ops::Range<usize>), texts: &'t [String]) -> Annotation<'t> {
    let kind = if *index == 0 { AnnotationKind::Primary } else { AnnotationKind::Context };
    let label = texts.get(*index).map(String::as_str).filter(|text| !text.is_empty());
    kind.span(range.clone()).label(label)
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

/// Text for one line of a terminal: what could move the cursor, change colours or turn the direction of
/// writing is replaced.
fn clean(text: &str) -> String {
    text.chars().map(|c| if is_command(c) { '\u{fffd}' } else { c }).collect()
}

/// The same for text that may have several lines.
fn clean_lines(text: &str) -> String {
    text.chars().map(|c| if is_command(c) && c != '\n' { '\u{fffd}' } else { c }).collect()
}

/// Whether a terminal could take a character for a command.
fn is_command(character: char) -> bool {
    let turns = matches!(
        character,
        '\u{061c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    turns || character.is_control()
}
