//! Diagnostics as text.

use super::excerpt::{Excerpt, excerpts};
use super::files::{File, Files};
use super::{Diagnostic, Label, Severity, Suggestion};
use crate::hry::Sources;
use annotate_snippets::{Annotation, AnnotationKind, Level, Origin, Patch, Renderer, Snippet};
use std::collections::BTreeMap;
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
    page(Files::single(file_name, source, diagnostics), diagnostics, color)
}

/// The diagnostics of a program as text, as [`render`] makes it: each label in its own file.
#[must_use]
pub fn render_sources(diagnostics: &[Diagnostic], sources: &Sources, color: bool) -> String {
    page(Files::of(sources, diagnostics), diagnostics, color)
}

fn page(files: Files<'_>, diagnostics: &[Diagnostic], color: bool) -> String {
    // The excerpts are cut to size already, so no line is to be cut again.
    let renderer = if color { Renderer::styled() } else { Renderer::plain() }.term_width(10_000);
    let page = Page { files, renderer };
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

/// What all diagnostics of a program share.
struct Page<'a> {
    files: Files<'a>,
    renderer: Renderer,
}

/// An excerpt, and what it is of.
struct Shown<'p, 'a> {
    file: &'p File<'a>,
    excerpt: Excerpt,
}

impl<'a> Page<'a> {
    fn render(&self, diagnostic: &Diagnostic) -> String {
        let level = match diagnostic.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let labels: Vec<&Label> = std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary).collect();
        let texts: Vec<String> = labels.iter().map(|label| clean(&label.text)).collect();
        let shown = if diagnostic.is_about_the_file() { Vec::new() } else { self.shown(&labels) };

        let mut group = level.primary_title(clean(&diagnostic.message)).id(diagnostic.code).elements(
            shown.iter().map(|Shown { file, excerpt }| {
                let annotations = excerpt.labels.iter().map(|label| annotation(label, &texts));
                Snippet::source(&excerpt.text)
                    .line_start(excerpt.line)
                    .path(&file.name)
                    .annotations(annotations)
            }),
        );
        if shown.is_empty()
            && let Some(file) = self.files.get(self.files.position(diagnostic.primary.span))
        {
            group = group.element(Origin::path(&file.name));
        }
        group = group.elements(diagnostic.notes.iter().map(|note| Level::NOTE.message(clean_lines(note))));
        group = group.elements(diagnostic.help.iter().map(|help| Level::HELP.message(clean_lines(help))));
        let patched = diagnostic.suggestion.as_ref().map(|suggestion| self.patched(suggestion));
        let text = match (&patched, &diagnostic.suggestion) {
            (Some(Some((Shown { file, excerpt }, patch))), Some(suggestion)) => {
                let snippet = Snippet::source(&excerpt.text).line_start(excerpt.line).path(&file.name);
                let title = Level::HELP.secondary_title(clean(&suggestion.text));
                self.renderer.render(&[group, title.element(snippet.patch(patch.clone()))])
            }
            (_, Some(suggestion)) => {
                let help = Level::HELP.message(clean(&suggestion.text));
                self.renderer.render(&[group.element(help)])
            }
            _ => self.renderer.render(&[group]),
        };
        self.with_true_columns(text, &shown, &labels)
    }

    /// What is shown of the files for some labels. What holds the first of them goes first: it gives the diagnostic
    /// its place.
    fn shown(&self, labels: &[&Label]) -> Vec<Shown<'_, 'a>> {
        let mut by_file: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (index, label) in labels.iter().enumerate() {
            by_file.entry(self.files.position(label.span)).or_default().push(index);
        }
        let mut shown = Vec::new();
        for (position, indices) in by_file {
            let Some(file) = self.files.get(position) else { continue };
            let spans = indices.iter().filter_map(|index| labels.get(*index)).map(|label| file.fit(label.span));
            for mut excerpt in excerpts(file.text, &file.locations, &spans.collect::<Vec<_>>()) {
                for (index, _) in &mut excerpt.labels {
                    *index = indices.get(*index).copied().unwrap_or_default();
                }
                shown.push(Shown { file, excerpt });
            }
        }
        shown.sort_by_key(|shown| !shown.excerpt.labels.iter().any(|(index, _)| *index == 0));
        shown
    }

    /// The excerpt that shows a suggestion, and the suggestion as a change of that excerpt. None where it
    /// spans lines or is long: then its words have to do.
    fn patched<'s>(&self, suggestion: &'s Suggestion) -> Option<(Shown<'_, 'a>, Patch<'s>)> {
        let file = self.files.get(self.files.position(suggestion.span))?;
        let span = file.fit(suggestion.span);
        let whole = span.end - span.start == suggestion.span.end.saturating_sub(suggestion.span.start);
        let one_line = whole && !suggestion.replacement.contains(['\n', '\r']);
        if !one_line || suggestion.replacement.len() > LONGEST_PATCH {
            return None;
        }
        let excerpt = excerpts(file.text, &file.locations, &[span]).pop()?;
        let range = excerpt.labels.first()?.1.clone();
        let whole = range.len() == span.end - span.start;
        whole.then(|| (Shown { file, excerpt }, Patch::new(range, clean(&suggestion.replacement))))
    }

    /// The layout derives columns from the excerpt; where that is only a part of the line, this puts the
    /// column in the file in its stead.
    fn with_true_columns(&self, mut text: String, shown: &[Shown<'_, '_>], labels: &[&Label]) -> String {
        let mut from = text.find('\n').unwrap_or(0);
        for Shown { file, excerpt } in shown {
            // The label that the layout takes: the primary one where there is one, else the first.
            let primary = excerpt.labels.iter().find(|(index, _)| *index == 0);
            let Some((index, range)) = primary.or(excerpt.labels.first()) else { continue };
            let start = labels.get(*index).map_or(0, |label| file.fit(label.span).start);
            let place = file.locations.get(start);
            let before = excerpt.text.get(..range.start).unwrap_or_default();
            let shown = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
            let printed = format!("{}:{}:{shown}", file.name, place.line);
            let Some(at) = text.get(from..).and_then(|rest| rest.find(&printed)).map(|at| at + from) else {
                continue;
            };
            let mut truth = String::new();
            let _ = write!(truth, "{}:{}:{}", file.name, place.line, place.column);
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

/// Text for one line of a terminal: what could move the cursor, change colours or turn the direction of
/// writing is replaced.
pub(super) fn clean(text: &str) -> String {
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
