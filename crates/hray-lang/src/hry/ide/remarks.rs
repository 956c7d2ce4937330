//! What is wrong, ready to be shown in one file.

use super::analysis::{Analysis, FileId, Place};
use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::hry::assets::resolve;
use crate::hry::program::Program;
use std::collections::HashSet;

/// A diagnostic in the file that was analysed.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// How bad it is.
    pub severity: Severity,
    /// Its stable name.
    pub code: &'static str,
    /// Where it is.
    pub span: Span,
    /// What is wrong and what to do, in one or more lines.
    pub message: String,
    /// Other places that explain it.
    pub related: Vec<(Place, String)>,
    /// A replacement that would mend it.
    pub fix: Option<Fix>,
    /// Whether the text under it could be removed.
    pub is_unnecessary: bool,
}

/// A replacement of text in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Fix {
    /// What it does, in words.
    pub title: String,
    /// What is replaced.
    pub span: Span,
    /// What by.
    pub replacement: String,
}

/// A diagnostic as a remark. Nothing where it does not concern somebody who edits the file: a file without a scene may be
/// there to be imported.
pub(super) fn remark(analysis: &Analysis, diagnostic: &Diagnostic) -> Option<Remark> {
    if diagnostic.code == "no-scene" && diagnostic.suggestion.is_none() {
        return None;
    }
    let own = FileId::Own(analysis.path.clone());
    let primary = analysis.place(diagnostic.primary.span)?;
    let labels = diagnostic.secondary.iter();
    let labels = labels.map(|label| (label.span, label.text.clone()));
    let mut related: Vec<(Place, String)> =
        labels.filter_map(|(span, text)| Some((analysis.place(span)?, text))).collect();
    let is_own = primary.file == own;
    let span = if is_own {
        primary.span
    } else {
        related.insert(0, (primary.clone(), diagnostic.message.clone()));
        import_of(analysis, &primary.file)
    };
    let fix = diagnostic.suggestion.as_ref().filter(|_| is_own).and_then(|suggestion| {
        let place = analysis.place(suggestion.span).filter(|place| place.file == own)?;
        let (title, replacement) = (suggestion.text.clone(), suggestion.replacement.clone());
        Some(Fix { title, span: place.span, replacement })
    });
    Some(Remark {
        severity: diagnostic.severity,
        code: diagnostic.code,
        span: within(span, &analysis.text),
        message: message(diagnostic, (!is_own).then_some(&primary.file)),
        related,
        fix,
        is_unnecessary: diagnostic.code.starts_with("unused-"),
    })
}

/// All that a diagnostic says, a line each.
fn message(diagnostic: &Diagnostic, elsewhere: Option<&FileId>) -> String {
    let mut lines = match elsewhere {
        Some(FileId::Own(path)) => vec![format!("in {path:?}: {}", diagnostic.message)],
        Some(FileId::Library(name)) => vec![format!("in {name} of the library: {}", diagnostic.message)],
        None => vec![diagnostic.message.clone()],
    };
    if !diagnostic.primary.text.is_empty() {
        lines.push(diagnostic.primary.text.clone());
    }
    lines.extend(diagnostic.notes.iter().map(|note| format!("note: {note}")));
    lines.extend(diagnostic.help.iter().map(|help| format!("help: {help}")));
    lines.extend(diagnostic.suggestion.iter().map(|suggestion| format!("help: {}", suggestion.text)));
    lines.join("\n")
}

/// The part of a span that is in the text.
fn within(span: Span, text: &str) -> Span {
    let start = text.floor_char_boundary(span.start.min(text.len()));
    Span::new(start, text.floor_char_boundary(span.end.min(text.len())).max(start))
}

/// The place of the import that brings a file in, directly or by way of others.
fn import_of(analysis: &Analysis, file: &FileId) -> Span {
    let (Some((program, _)), FileId::Own(path)) = (&analysis.hry, file) else { return Span::at(0) };
    let Some(root) = program.root() else { return Span::at(0) };
    let brings = |import: &&crate::hry::ast::Import| {
        let first = resolve(&root.path, &import.path);
        first.is_some_and(|first| reaches(program, first, path))
    };
    root.syntax.imports.iter().find(brings).map_or(Span::at(0), |import| import.path_span)
}

/// Whether the file at `from` is the file at `to`, or imports it.
fn reaches(program: &Program, from: String, to: &str) -> bool {
    let (mut open, mut seen) = (vec![from], HashSet::new());
    while let Some(path) = open.pop() {
        if path == to {
            return true;
        }
        let module = program.modules.iter().find(|module| !module.is_standard && module.path == path);
        if let (Some(module), true) = (module, seen.insert(path)) {
            open.extend(
                module.syntax.imports.iter().filter_map(|import| resolve(&module.path, &import.path)),
            );
        }
    }
    false
}
