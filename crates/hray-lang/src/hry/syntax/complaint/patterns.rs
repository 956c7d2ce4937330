//! Patterns and types.

use super::super::kind::SyntaxKind;
use super::super::parser::Parser;
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// A pattern that does not take every value, where it has to.
    pub(in super::super) fn may_fail(&mut self, first: usize, label: &str) {
        let span = Span::new(self.span_of(first).start, self.gap().end);
        let message = "only patterns that take every value may be here";
        let error = Diagnostic::error("refutable-pattern", message, span, label);
        self.report(error.with_help("take a name here and look at it with `match name { ... }`"));
    }

    pub(in super::super) fn no_pattern(&mut self) -> SyntaxKind {
        self.fail(|parser| {
            let message = format!("expected a pattern, found {}", parser.found());
            Diagnostic::error(
                "missing-pattern",
                message,
                parser.here(),
                "expected a name, `_`, a value, or parts in brackets",
            )
        });
        if self.is(SyntaxKind::TypeName) || self.is(SyntaxKind::Minus) {
            self.bump();
        }
        SyntaxKind::ErrorPattern
    }

    pub(in super::super) fn after_rest(&self) -> Diagnostic {
        let message = "the rest of a list is the last thing in its pattern";
        Diagnostic::error("list-pattern", message, self.here(), "expected `]`")
    }

    pub(in super::super) fn missing_comma_before_rest(&mut self) {
        let error = Diagnostic::error(
            "missing-comma",
            "expected `,` before `..`",
            self.here(),
            "expected `,` before this",
        );
        let error = error.with_suggestion(self.gap(), ",", "add a comma");
        self.report(error);
    }

    pub(in super::super) fn no_type(&self) -> Diagnostic {
        let message = format!("expected a type, found {}", self.found());
        let error = Diagnostic::error("missing-type", message, self.here(), "expected a type");
        error.with_help("types are `Number`, `[Color]`, `{ size : Vec2 }`, `Hit -> Color` and the like")
    }

    pub(in super::super) fn after_type(&self) -> Diagnostic {
        let message = format!("expected the end of the type, found {}", self.found());
        Diagnostic::error("type", message, self.here(), "not expected in a type")
    }

    pub(in super::super) fn no_field_type(&self) -> Diagnostic {
        let message = format!("expected `:` and a type, found {}", self.found());
        Diagnostic::error("type", message, self.here(), "expected `:`")
    }
}
