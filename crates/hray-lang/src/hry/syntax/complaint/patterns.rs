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
        match self.current {
            SyntaxKind::TypeName => {
                self.upper_case();
                self.bump();
                return SyntaxKind::NamePattern;
            }
            kind if kind.is_keyword() => self.fail(Self::keyword_as_name),
            _ => self.fail(|parser| {
                let message = format!("expected a pattern, found {}", parser.found());
                let label = "expected a name, `_`, a value, or parts in brackets";
                Diagnostic::error("missing-pattern", message, parser.here(), label)
            }),
        }
        if self.is(SyntaxKind::Minus) {
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
        let error = Diagnostic::error("missing-type", message, self.here(), "expected a type here");
        error.with_help("types are `Number`, `[Color]`, `{ size : Vec2 }`, `Hit -> Color` and the like")
    }

    pub(in super::super) fn after_type(&self) -> Diagnostic {
        let message = format!("expected the end of the type, found {}", self.found());
        let error = Diagnostic::error("annotation", message, self.here(), "not expected in a type");
        match self.current {
            SyntaxKind::Comma => error.with_help(
                "the types of vectors are `Vec2` and `Vec3`; other things go into records or lists",
            ),
            SyntaxKind::Name | SyntaxKind::TypeName => error.with_help("a list of numbers is `[Number]`"),
            _ => error,
        }
    }

    pub(in super::super) fn no_field_type(&self) -> Diagnostic {
        let message = format!("expected `:` and a type, found {}", self.found());
        Diagnostic::error("annotation", message, self.here(), "expected `:`")
    }
}
