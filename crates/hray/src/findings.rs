//! Diagnostics for programs: plain data with lines and columns.

use crate::Diagnostic;
use hray_lang::diagnostic::{Places, Severity, Span};
use hray_lang::hry::Sources;
use serde::Serialize;

/// The findings about a scene, in the order in which they are reported. They serialise to a list.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Findings(pub Vec<Finding>);

/// An error or a warning.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// The name of the file it is about.
    pub file: String,
    /// `error` or `warning`.
    pub severity: &'static str,
    /// The kind of finding, such as `unknown-name`; warnings are allowed and denied by it.
    pub code: String,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// The places, the one that it is about first.
    pub labels: Vec<FindingLabel>,
    /// What else is good to know.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
    /// A replacement that would mend it.
    pub suggestion: Option<FindingSuggestion>,
}

/// A place, and a remark about it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FindingLabel {
    /// Where.
    #[serde(flatten)]
    pub place: FindingPlace,
    /// The remark; may be empty.
    pub text: String,
    /// Whether it is the place that the finding is about.
    pub primary: bool,
}

/// A stretch of a file. Lines and columns count from 1, columns in characters; the end is one past the last character.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FindingPlace {
    /// The name of the file.
    pub file: String,
    /// The line of the start.
    pub line: usize,
    /// The column of the start.
    pub column: usize,
    /// The line of the end.
    pub end_line: usize,
    /// The column of the end.
    pub end_column: usize,
    /// The start in bytes from the start of the file.
    pub start: usize,
    /// The end in bytes.
    pub end: usize,
}

/// A replacement of some text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct FindingSuggestion {
    /// What to replace; empty to insert.
    #[serde(flatten)]
    pub place: FindingPlace,
    /// What to put there; empty to remove.
    pub replacement: String,
    /// The suggestion in words.
    pub text: String,
}

impl Findings {
    pub(crate) fn of(diagnostics: &[Diagnostic], sources: &Sources) -> Self {
        let places = Places::new(sources, diagnostics);
        Self(diagnostics.iter().map(|diagnostic| Finding::of(diagnostic, &places)).collect())
    }
}

impl Finding {
    /// A finding about a file that is not about a place in it.
    #[must_use]
    pub fn about_file(file: &str, code: &str, message: String) -> Self {
        Self {
            file: file.to_owned(),
            severity: "error",
            code: code.to_owned(),
            message,
            labels: Vec::new(),
            notes: Vec::new(),
            help: None,
            suggestion: None,
        }
    }

    fn of(diagnostic: &Diagnostic, places: &Places<'_>) -> Self {
        let labels = std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary).enumerate();
        let label = |(index, label): (usize, &hray_lang::diagnostic::Label)| {
            let place = place(places, label.span)?;
            Some(FindingLabel { place, text: label.text.clone(), primary: index == 0 })
        };
        let suggestion = diagnostic.suggestion.as_ref().and_then(|suggestion| {
            Some(FindingSuggestion {
                place: place(places, suggestion.span)?,
                replacement: suggestion.replacement.clone(),
                text: suggestion.text.clone(),
            })
        });
        Self {
            file: places.of(diagnostic.primary.span).map(|place| place.file.to_owned()).unwrap_or_default(),
            severity: if diagnostic.severity == Severity::Error { "error" } else { "warning" },
            code: diagnostic.code.to_owned(),
            message: diagnostic.message.clone(),
            labels: if diagnostic.is_about_the_file() {
                Vec::new()
            } else {
                labels.filter_map(label).collect()
            },
            notes: diagnostic.notes.clone(),
            help: diagnostic.help.clone(),
            suggestion,
        }
    }
}

fn place(places: &Places<'_>, span: Span) -> Option<FindingPlace> {
    let place = places.of(span)?;
    Some(FindingPlace {
        file: place.file.to_owned(),
        line: place.start.line,
        column: place.start.column,
        end_line: place.end.line,
        end_column: place.end.column,
        start: place.start.offset,
        end: place.end.offset,
    })
}
