//! Lists, records and vectors.

use super::super::kind::SyntaxKind;
use super::super::parser::{Mark, Parser};
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// What stands where a comma or the closing bracket belongs. True where the next element can be read as it is.
    pub(in super::super) fn separator(&mut self, closing: SyntaxKind) -> bool {
        let is_semicolon = self.is(SyntaxKind::Semicolon);
        let before = self.at;
        let gap = self.gap();
        self.fail(|parser| {
            let bracket = closing.spelling();
            let message = format!("expected `,` or `{bracket}`, found {}", parser.found());
            if is_semicolon {
                let error = Diagnostic::error(
                    "missing-comma",
                    message,
                    parser.here(),
                    "elements are separated by commas",
                );
                return error.with_suggestion(parser.here(), ",", "write `,`");
            }
            let error = Diagnostic::error(
                "missing-comma",
                message,
                parser.here(),
                format!("expected `,` or `{bracket}` before this"),
            );
            let begins = matches!(
                parser.current,
                SyntaxKind::Name
                    | SyntaxKind::OpenParen
                    | SyntaxKind::OpenBracket
                    | SyntaxKind::OpenBrace
                    | SyntaxKind::Number
                    | SyntaxKind::Underscore
            );
            if begins { error.with_suggestion(gap, ",", "add a comma") } else { error }
        });
        if is_semicolon {
            self.bump();
            return true;
        }
        before == self.at && matches!(self.current, SyntaxKind::Name)
    }

    pub(in super::super) fn empty_parentheses(&mut self, first: usize) {
        let span = self.span_of(first).to(self.here());
        let message = "there is nothing in these parentheses";
        let error = Diagnostic::error("empty-parentheses", message, span, "expected a value");
        self.report(
            error.with_help("a function without arguments is just a value: leave the parentheses out"),
        );
        self.failed_at = Some(self.at);
    }

    pub(in super::super) fn one_component(&mut self, first: usize) -> SyntaxKind {
        let span = self.span_of(first).to(self.gap());
        let message = "a vector has two or three components, this has one";
        let comma = Span::new(
            self.span_of(self.at.saturating_sub(2)).start,
            self.span_of(self.at.saturating_sub(2)).end,
        );
        let error = Diagnostic::error("vector-size", message, span, "expected another component");
        self.report(error.with_suggestion(comma, "", "for parentheses only, leave the comma out"));
        SyntaxKind::ErrorExpr
    }

    pub(in super::super) fn too_many_components(&mut self, first: usize, count: usize) -> SyntaxKind {
        let span = self.span_of(first).to(self.gap());
        let message = format!("a vector has two or three components, this has {count}");
        let error = Diagnostic::error("vector-size", message, span, "expected two or three");
        self.report(
            error.with_help("for more values use a list `[a, b, c, d]` or a record `{ a = 1, b = 2 }`"),
        );
        SyntaxKind::ErrorExpr
    }

    /// `[.. last]`, `[1, 2, .. last]`
    pub(in super::super) fn range_without_start(&mut self, count: usize) {
        let here = self.here();
        if count == 0 {
            let error = Diagnostic::error(
                "range",
                "this range has no first element",
                here,
                "expected a number before `..`",
            );
            self.report(error.with_help("a range is written `[0 .. 10]` or, with a step, `[0, 2 .. 10]`"));
        } else {
            let comma = self.span_of(self.at.saturating_sub(1));
            let error =
                Diagnostic::error("range", "no comma belongs before `..`", comma, "not expected here");
            self.report(error.with_suggestion(comma, "", "remove the comma"));
        }
    }

    pub(in super::super) fn long_range(&mut self) {
        let error = Diagnostic::error(
            "range",
            "a range begins with one or two elements",
            self.here(),
            "more than two before this",
        );
        self.report(error.with_help("`[0, 2 .. 10]` gives the first element, the second and the last"));
    }

    pub(in super::super) fn endless_range(&mut self) {
        let dots = self.span_of(self.at.saturating_sub(1));
        let error =
            Diagnostic::error("range", "this range has no end", dots, "expected the last element after this");
        self.report(error.with_help("lists are finite: `[0 .. 10]` is 0 up to 10, both included"));
    }

    pub(in super::super) fn after_range(&self) -> Diagnostic {
        let message = format!("a range ends with its last element, found {}", self.found());
        Diagnostic::error("range", message, self.here(), "expected `]`")
    }

    pub(in super::super) fn no_fields(&self) -> Diagnostic {
        let message = "nothing is changed here";
        Diagnostic::error(
            "missing-field",
            message,
            self.here(),
            "expected a field and its new value, `name = value`",
        )
    }

    pub(in super::super) fn not_a_record(&self, start: Mark) -> Diagnostic {
        let first = Self::token_of(start) + 1;
        let message = format!("expected a field, found {}", self.described(first));
        let error = Diagnostic::error(
            "missing-field",
            message,
            self.span_of(first),
            "a field is written `name = value`",
        );
        error.with_help("to change fields of a record, write `{ record | name = value }`")
    }

    /// Goes past the name of a field.
    pub(in super::super) fn field_label(&mut self) -> bool {
        if self.eat(SyntaxKind::Name) {
            return true;
        }
        self.fail(|parser| {
            let message = format!("expected the name of a field, found {}", parser.found());
            Diagnostic::error("missing-field", message, parser.here(), "a field is written `name = value`")
        });
        false
    }

    /// Whether an `=` follows, or what is taken for one.
    pub(in super::super) fn defines_field(&mut self) -> bool {
        if self.is(SyntaxKind::Colon) {
            let error = Diagnostic::error(
                "colon-in-record",
                "a field takes its value with `=`, not with `:`",
                self.here(),
                "expected `=`",
            );
            let error = error.with_suggestion(self.here(), " =", "write `=`");
            self.report(error);
            return true;
        }
        self.is(SyntaxKind::Define)
    }

    pub(in super::super) fn begins_value(&self) -> bool {
        matches!(
            self.current,
            SyntaxKind::Number
                | SyntaxKind::Color
                | SyntaxKind::Text
                | SyntaxKind::OpenParen
                | SyntaxKind::OpenBracket
        )
    }

    pub(in super::super) fn missing_equals(&self) -> Diagnostic {
        let message = format!("expected `=` after the name of the field, found {}", self.found());
        let error = Diagnostic::error("missing-equals", message, self.here(), "expected `=` before this");
        error.with_suggestion(self.gap(), " =", "add `=`")
    }

    pub(in super::super) fn long_body(&mut self) {
        let error = Diagnostic::error(
            "comprehension",
            "only one element may be before the `|`",
            self.here(),
            "more than one before this",
        );
        self.report(error.with_help("`[x * x | x <- [1 .. 3]]` makes one element for every x"));
    }

    pub(in super::super) fn no_qualifiers(&self) -> Diagnostic {
        let message = "nothing follows the `|`";
        let error = Diagnostic::error(
            "comprehension",
            message,
            self.here(),
            "expected where elements come from, such as `x <- list`",
        );
        error.with_help("`[x * x | x <- [1 .. 3]]` is `[1, 4, 9]`")
    }

    pub(in super::super) fn no_generator(&self) -> Diagnostic {
        let message = format!("expected `<-`, found {}", self.found());
        Diagnostic::error("comprehension", message, self.here(), "expected `<-` and a list")
    }
}
