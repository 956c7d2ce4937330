//! What the language has to say about a source text, as plain data, and the rendering of it as text.
//!
//! A [`Diagnostic`] knows nothing of terminals: an editor can show it in its own way. [`render`] lays it out
//! with the source line, the span underlined, and the suggestion spelt out, [`render_sources`] over several files;
//! [`Places`] gives lines and columns to programs.

mod excerpt;
mod files;
mod locate;
mod places;
mod render;
mod span;

pub use places::{Place, Places, Point};
pub use render::{render, render_sources};
pub use span::Span;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The text means something, but probably not what was meant.
    Warning,
    /// The text means nothing, so there is nothing to render.
    Error,
}

/// One thing to say about a source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// A stable name for this kind of diagnostic, such as `unknown-word`.
    pub code: &'static str,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// Where, and what was expected there.
    pub primary: Label,
    /// Other places that explain it, such as the bracket that is not closed.
    pub secondary: Vec<Label>,
    /// What else is good to know, one entry a remark.
    pub notes: Vec<String>,
    /// What to do, where no single replacement does it.
    pub help: Option<String>,
    /// A replacement that would mend it.
    pub suggestion: Option<Suggestion>,
}

/// A remark about a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// The remark; empty where the underline says enough.
    pub text: String,
}

/// A replacement of some source text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Suggestion {
    /// What to replace; empty to insert.
    pub span: Span,
    /// What to put there; empty to remove.
    pub replacement: String,
    /// The suggestion in words.
    pub text: String,
}

impl Diagnostic {
    /// An error at `span`, where `label` says what was expected.
    #[must_use]
    pub fn error(
        code: &'static str,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Self {
        Self {
            severity: Severity::Error,
            code,
            message: message.into(),
            primary: Label { span, text: label.into() },
            secondary: Vec::new(),
            notes: Vec::new(),
            help: None,
            suggestion: None,
        }
    }

    /// A warning at `span`.
    #[must_use]
    pub fn warning(
        code: &'static str,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, message, span, label) }
    }

    /// The same with a remark about another place.
    #[must_use]
    pub fn with_secondary(mut self, span: Span, text: impl Into<String>) -> Self {
        self.secondary.push(Label { span, text: text.into() });
        self
    }

    /// The same with a note.
    #[must_use]
    pub fn with_note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// The same with advice.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same with a replacement.
    #[must_use]
    pub fn with_suggestion(
        mut self,
        span: Span,
        replacement: impl Into<String>,
        text: impl Into<String>,
    ) -> Self {
        self.suggestion = Some(Suggestion { span, replacement: replacement.into(), text: text.into() });
        self
    }

    /// Whether it is an error.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }

    /// Whether it is about a file as a whole, such as one that lacks something: it points at nothing.
    #[must_use]
    pub fn is_about_the_file(&self) -> bool {
        self.primary.span.is_empty() && self.primary.text.is_empty() && self.secondary.is_empty()
    }

    /// Every span it mentions.
    pub fn spans(&self) -> impl Iterator<Item = Span> {
        let labels = std::iter::once(&self.primary).chain(&self.secondary).map(|label| label.span);
        labels.chain(self.suggestion.iter().map(|suggestion| suggestion.span))
    }
}
