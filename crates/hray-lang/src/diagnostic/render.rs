//! Diagnostics as text.

use super::excerpt::{Excerpt, excerpts};
use super::files::{File, Files};
use super::{Diagnostic, Severity, Span, Suggestion};
use crate::hry::Sources;
use annotate_snippets::{Annotation, AnnotationKind, Level, Origin, Patch, Renderer, Snippet};
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
    write(diagnostics, &Files::one(file_name, source, diagnostics), color)
}

/// The same of diagnostics whose spans are offsets into the files of a program: each label is shown in its own file,
/// that of the primary one first.
#[must_use]
pub fn render_sources(diagnostics: &[Diagnostic], sources: &Sources, color: bool) -> String {
    write(diagnostics, &Files::of(sources, diagnostics), color)
}

fn write(diagnostics: &[Diagnostic], files: &Files<'_>, color: bool) -> String {
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

/// What all diagnostics share.
struct Page<'a> {
    files: &'a Files<'a>,
    renderer: Renderer,
}

/// An excerpt of one of the files. Its labels are numbered as in the diagnostic.
struct Shown<'a> {
    file: &'a File<'a>,
    excerpt: Excerpt,
}

impl Page<'_> {
    fn render(&self, diagnostic: &Diagnostic) -> String {
        let level = match diagnostic.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let labels: Vec<_> = std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary).collect();
        let texts: Vec<String> = labels.iter().map(|label| clean(&label.text)).collect();
        let spans: Vec<(usize, Span)> = labels.iter().map(|label| self.files.local(label.span)).collect();
        let shown = if diagnostic.is_about_the_file() { Vec::new() } else { self.shown(&spans) };

        let mut group = level.primary_title(clean(&diagnostic.message)).id(diagnostic.code).elements(
            shown.iter().map(|Shown { file, excerpt }| {
                let annotations = excerpt.labels.iter().map(|label| annotation(label, &texts));
                Snippet::source(&excerpt.text)
                    .line_start(excerpt.line)
                    .path(&file.name)
                    .annotations(annotations)
            }),
        );
        if let (true, Some(file)) =
            (shown.is_empty(), spans.first().and_then(|(file, _)| self.files.get(*file)))
        {
            group = group.element(Origin::path(&file.name));
        }
        group = group.elements(diagnostic.notes.iter().map(|note| Level::NOTE.message(clean_lines(note))));
        group = group.elements(diagnostic.help.iter().map(|help| Level::HELP.message(clean_lines(help))));
        let patched = diagnostic.suggestion.as_ref().map(|suggestion| self.patched(suggestion));
        let text = match (&patched, &diagnostic.suggestion) {
            (Some(Some((file, excerpt, patch))), Some(suggestion)) => {
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
        if shown.is_empty() {
            // The layout leaves no room for the numbers of lines where it shows none.
            return text.replace('\n', "\n ");
        }
        with_true_columns(text, &shown, &spans)
    }

    /// The excerpts that show spans (each with the number of its file), file by file; the excerpt of the first span
    /// goes first: it gives the diagnostic its place.
    fn shown(&self, spans: &[(usize, Span)]) -> Vec<Shown<'_>> {
        let mut order: Vec<usize> = Vec::new();
        for (file, _) in spans {
            if !order.contains(file) {
                order.push(*file);
            }
        }
        let mut shown = Vec::new();
        for number in order {
            let Some(file) = self.files.get(number) else { continue };
            let mine = || spans.iter().enumerate().filter(|(_, (of, _))| *of == number);
            let numbers: Vec<usize> = mine().map(|(index, _)| index).collect();
            let here: Vec<Span> = mine().map(|(_, (_, span))| *span).collect();
            let mut excerpts = excerpts(file.text, &file.locations, &here);
            for (index, _) in excerpts.iter_mut().flat_map(|excerpt| &mut excerpt.labels) {
                *index = numbers.get(*index).copied().unwrap_or(usize::MAX);
            }
            excerpts.sort_by_key(|excerpt| !excerpt.labels.iter().any(|(index, _)| *index == 0));
            shown.extend(excerpts.into_iter().map(|excerpt| Shown { file, excerpt }));
        }
        shown
    }

    /// The excerpt that shows a suggestion, and the suggestion as a change of that excerpt. None where it
    /// spans lines or is long: then its words have to do.
    fn patched<'s>(&self, suggestion: &'s Suggestion) -> Option<(&File<'_>, Excerpt, Patch<'s>)> {
        let (number, span) = self.files.local(suggestion.span);
        let file = self.files.get(number)?;
        let fits =
            span.start + file.base == suggestion.span.start && span.end + file.base == suggestion.span.end;
        let one_line = fits && !suggestion.replacement.contains(['\n', '\r']);
        if !one_line || suggestion.replacement.len() > LONGEST_PATCH {
            return None;
        }
        let excerpt = excerpts(file.text, &file.locations, &[span]).pop()?;
        let range = excerpt.labels.first()?.1.clone();
        let whole = range.len() == span.end - span.start;
        whole.then(|| (file, excerpt, Patch::new(range, clean(&suggestion.replacement))))
    }
}

/// The layout derives columns from the excerpt; where that is only a part of the line, this puts the
/// column in the file in its stead.
fn with_true_columns(mut text: String, shown: &[Shown<'_>], spans: &[(usize, Span)]) -> String {
    let mut from = text.find('\n').unwrap_or(0);
    for Shown { file, excerpt } in shown {
        // The label that the layout takes: the primary one where there is one, else the first.
        let primary = excerpt.labels.iter().find(|(index, _)| *index == 0);
        let Some((index, range)) = primary.or(excerpt.labels.first()) else { continue };
        let place = file.locations.get(spans.get(*index).map_or(0, |(_, span)| span.start));
        let before = excerpt.text.get(..range.start).unwrap_or_default();
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        let printed = format!("{}:{}:{column}", file.name, place.line);
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
