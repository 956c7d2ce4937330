//! Where the findings of the lints go.

use super::{LINTS, Level, LintLevels};
use crate::classic::Spans;
use crate::diagnostic::{Diagnostic, Severity, Span};

/// Of each lint so many findings are shown; the others are counted.
pub const MOST_PER_LINT: usize = 5;

/// Collects findings at their levels.
pub(crate) struct Sink<'s> {
    source: &'s str,
    levels: &'s LintLevels,
    counts: [usize; LINTS.len()],
    found: Vec<Diagnostic>,
}

impl<'s> Sink<'s> {
    pub(crate) fn new(source: &'s str, levels: &'s LintLevels) -> Self {
        Self { source, levels, counts: [0; LINTS.len()], found: Vec::new() }
    }

    /// Adds a finding. It is put into words only if it is shown.
    pub(crate) fn report(&mut self, code: &'static str, finding: impl FnOnce(&Words<'s>) -> Diagnostic) {
        let level = self.levels.get(code);
        let Some(count) = self.counts.iter_mut().zip(LINTS).find(|(_, lint)| lint.code == code) else {
            return;
        };
        let count = count.0;
        *count += 1;
        if level == Level::Allow || *count > MOST_PER_LINT {
            return;
        }
        let mut diagnostic = finding(&Words { source: self.source, code });
        if level == Level::Deny {
            diagnostic.severity = Severity::Error;
        }
        self.found.push(diagnostic);
    }

    /// The findings in the order of the source.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        for (count, lint) in self.counts.iter().zip(LINTS) {
            let more = count.saturating_sub(MOST_PER_LINT);
            let last = self.found.iter_mut().rev().find(|diagnostic| diagnostic.code == lint.code);
            if let (1.., Some(last)) = (more, last) {
                last.notes.push(format!("there are {more} more findings of this kind"));
            }
        }
        self.found.sort_by_key(|diagnostic| diagnostic.primary.span);
        self.found
    }
}

/// What it takes to put a finding into words.
pub(crate) struct Words<'s> {
    source: &'s str,
    code: &'static str,
}

impl Words<'_> {
    pub(crate) fn warning(
        &self,
        message: impl Into<String>,
        span: Span,
        label: impl Into<String>,
    ) -> Diagnostic {
        Diagnostic::warning(self.code, message, span, label)
    }

    /// The place of `count` numbers of an element, the first of them number `first`.
    pub(crate) fn numbers(&self, element: Span, first: usize, count: usize) -> Span {
        Spans::numbers(self.source, element, first, count)
    }

    /// The place of the shape of a primitive.
    pub(crate) fn shape(&self, primitive: Span) -> Span {
        Spans::shape(self.source, primitive)
    }

    /// The text at a place.
    pub(crate) fn text(&self, span: Span) -> &str {
        span.text(self.source)
    }
}
