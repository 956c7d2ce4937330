//! Lists, records and vectors.

use super::super::kind::SyntaxKind;
use super::super::parser::{Mark, Parser};
use super::quoted;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::library::{CONSTRUCTORS, NATIVES, NativeSpec};

impl Parser<'_> {
    /// What stands where a comma or the closing bracket belongs. True where the next element can be read as it is.
    /// `is_known` where commas of the same brackets were found missing before.
    pub(in super::super) fn separator(&mut self, closing: SyntaxKind, is_known: &mut bool) -> bool {
        if self.is(SyntaxKind::Bar) && self.has_bars {
            return true;
        }
        let is_semicolon = self.is(SyntaxKind::Semicolon);
        let is_element = is_semicolon || self.begins_element();
        if is_element && *is_known {
            self.failed_at = Some(self.at);
        } else {
            self.fail(|parser| parser.no_comma(closing));
        }
        *is_known |= is_element;
        if is_semicolon {
            self.bump();
        }
        is_element
    }

    /// Whether the next element seems to begin here, so that only a comma is missing.
    fn begins_element(&self) -> bool {
        use SyntaxKind as S;
        matches!(
            self.current,
            S::Name
                | S::Number
                | S::Text
                | S::Color
                | S::Underscore
                | S::OpenParen
                | S::OpenBracket
                | S::OpenBrace
                | S::TrueKeyword
                | S::FalseKeyword
        )
    }

    fn no_comma(&self, closing: SyntaxKind) -> Diagnostic {
        use SyntaxKind as S;
        let (here, gap) = (self.here(), self.gap());
        let bracket = closing.spelling();
        let error = |message: String, label: &str| Diagnostic::error("missing-comma", message, here, label);
        match self.current {
            S::Arrow => self.no_backslash(),
            S::Semicolon => error("elements are separated by `,`, not by `;`".into(), "expected `,`")
                .with_suggestion(here, ",", "write `,`"),
            S::Name if closing == S::CloseBrace && self.kind_ahead(1) == S::Define => {
                let message = format!("missing `,` before the field `{}`", self.text_of(self.at));
                error(message, "expected `,` before this").with_suggestion(gap, ",", "add a comma")
            }
            _ if closing == S::CloseBrace && self.begins_element() => {
                let message = format!("missing `,` before {}", self.found());
                error(message, "expected `,` before this").with_suggestion(gap, ",", "add a comma")
            }
            S::DotDot => {
                let error =
                    Diagnostic::error("range", "a range is written in brackets", here, "not expected here");
                error.with_help("write `[0 .. 10]`")
            }
            S::Colon if closing == S::CloseParen => {
                let error = Diagnostic::error(
                    "annotation",
                    "a type cannot be given here",
                    here,
                    "expected `,` or `)`",
                );
                error.with_help("give the type of a function on a line above it: `f : Number -> Number`")
            }
            S::Dot
                if self.kind_ahead(1) == S::Name
                    && self.tokens.get(self.at + 1).is_some_and(|next| next.spaced)
                    && self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == S::Name) =>
            {
                let (first, second) = (self.at - 1, self.at + 1);
                let message = "functions are not joined by `.`";
                let error = Diagnostic::error("foreign-operator", message, here, "not an operator of hry");
                let whole = self.span_of(first).to(self.span_of(second));
                let joined = format!("{} >> {}", self.text_of(second), self.text_of(first));
                error.with_suggestion(whole, joined, "`f >> g` does `f` first, then `g`:")
            }
            S::Dot => {
                let message = "a field directly follows its value, without a space";
                let error =
                    Diagnostic::error("missing-field", message, here, "expected no space before this");
                let error = error.with_suggestion(Span::new(gap.end, here.start), "", "remove the space");
                error.with_note("a function that takes a field is written `(\\r -> r.x)`")
            }
            S::Bar => {
                let message = format!("`|` cannot follow here, expected `,` or `{bracket}`");
                error(message, "not expected here")
                    .with_note("`|` belongs in `[x | x <- list, x > 0]` and `{ record | field = value }`")
                    .with_suggestion(here, ",", "what follows the first `|` is separated by commas")
            }
            _ => {
                let message = format!("expected `,` or `{bracket}`, found {}", self.found());
                let label = format!("expected `,` or `{bracket}` before this");
                let error = error(message, &label);
                if self.begins_element() { error.with_suggestion(gap, ",", "add a comma") } else { error }
            }
        }
    }

    pub(in super::super) fn empty_parentheses(&mut self, first: usize) {
        let span = self.span_of(first).to(self.here());
        let message = "there is nothing in these parentheses";
        let error = Diagnostic::error("empty-parentheses", message, span, "expected something in them");
        let before = first.checked_sub(1).filter(|before| self.kind_of(*before) == SyntaxKind::Name);
        let error = match before {
            Some(name) if takes_arguments(self.text_of(name)).is_some() => {
                let doc = takes_arguments(self.text_of(name)).map_or("", |native| native.doc);
                error.with_help(format!("{} takes arguments: {doc}", quoted(self.text_of(name))))
            }
            Some(name) => {
                let surplus = Span::new(self.span_of(name).end, span.end);
                error.with_suggestion(surplus, "", "what takes no arguments is just a value: leave them out")
            }
            None => error.with_help("parentheses hold a value, or the two or three components of a vector"),
        };
        self.report(error);
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
        } else if matches!(self.text_of(self.at), "..." | "\u{2026}") {
            let error =
                Diagnostic::error("list-spread", "lists are joined with `++`", here, "not a part of a list");
            self.report(error.with_help("write `[1, 2] ++ rest`"));
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

    /// Neither a field nor the record to change follows the `{` at `start`.
    pub(in super::super) fn not_a_record(&self, start: Mark) -> Diagnostic {
        let open = Self::token_of(start);
        let first = open + 1;
        let before = open.checked_sub(1).map_or(SyntaxKind::End, |before| self.kind_of(before));
        let code = "missing-field";
        let is_condition = before == SyntaxKind::CloseParen && self.is_in_condition(open);
        if matches!(before, SyntaxKind::ThenKeyword | SyntaxKind::ElseKeyword) || is_condition {
            let message = "an `if` needs no braces; what is in braces is a record";
            let error = Diagnostic::error("braces", message, self.span_of(open), "expected a value");
            return error.with_help("write `if condition then a else b`");
        }
        let last = self.at.saturating_sub(1);
        if let Some(with) = (first..=last).find(|token| self.text_of(*token) == "with") {
            let message = "a record with other fields is written with `|`";
            let error = Diagnostic::error(code, message, self.span_of(with), "expected `|`");
            return error.with_suggestion(self.span_of(with), "|", "write `|`");
        }
        let is_negative = last == first + 2 && self.kind_of(first + 1) == SyntaxKind::Minus;
        if self.kind_of(first) == SyntaxKind::Name && (last == first + 1 || is_negative) {
            let name = quoted(self.text_of(first));
            let value = self.span_of(first + 1).to(self.span_of(last));
            let found =
                if is_negative { quoted(self.slice(value).unwrap_or("-")) } else { self.described(last) };
            let message = format!("expected `=` after {name}, found {found}");
            let error = Diagnostic::error("missing-equals", message, value, "expected `=` before this");
            return error.with_suggestion(Span::at(self.span_of(first).end), " =", "add `=`");
        }
        let is_part = self.kind_of(first) == SyntaxKind::Name
            && self.kind_of(first + 1) == SyntaxKind::Dot
            && self.kind_of(first + 2) == SyntaxKind::Name
            && self.kind_of(first + 3) == SyntaxKind::Define;
        if is_part {
            let name = self.text_of(first);
            let message = format!("`{name}` is set as a whole, not part by part");
            let span = self.span_of(first).to(self.span_of(first + 2));
            let error = Diagnostic::error(code, message, span, "expected the name of a field");
            return error.with_help(format!("write the whole vector, as in `{name} = (1, 0, 0)`"));
        }
        let owner = open.checked_sub(1).filter(|owner| self.kind_of(*owner) == SyntaxKind::Name);
        let owner = owner.and_then(|owner| {
            CONSTRUCTORS.iter().find(|constructor| constructor.name == self.text_of(owner))
        });
        if let Some(constructor) = owner {
            let message = format!("what `{}` takes has names", constructor.name);
            let error = Diagnostic::error(
                "fields-without-names",
                message,
                self.span_of(first),
                "expected a field, `name = value`",
            );
            return error.with_help(format!("for example: {}", constructor.example));
        }
        let message = format!("expected a field, found {}", self.described(first));
        let error =
            Diagnostic::error(code, message, self.span_of(first), "a field is written `name = value`");
        error.with_help("to change fields of a record, write `{ record | name = value }`")
    }

    /// Whether the parentheses that end before token `end` follow an `if`.
    fn is_in_condition(&self, end: usize) -> bool {
        let mut before = (0..end).rev().take(40);
        before.find(|token| self.kind_of(*token) == SyntaxKind::OpenParen).is_some_and(|open| {
            open.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::IfKeyword)
        })
    }

    /// Goes past the name of a field.
    pub(in super::super) fn field_label(&mut self) -> bool {
        if self.eat(SyntaxKind::Name) {
            return true;
        }
        if self.is(SyntaxKind::TypeName) {
            self.upper_case();
            self.bump();
            return true;
        }
        self.fail(Self::no_label);
        let is_label = matches!(self.kind_ahead(1), SyntaxKind::Define | SyntaxKind::Colon);
        if is_label && (self.is(SyntaxKind::Text) || self.current.is_keyword()) {
            self.bump();
            return true;
        }
        false
    }

    fn no_label(&self) -> Diagnostic {
        use SyntaxKind as S;
        let here = self.here();
        let error = |message: &str, label: &str| Diagnostic::error("missing-field", message, here, label);
        match self.current {
            kind if kind.is_keyword() && matches!(self.kind_ahead(1), S::Define | S::Colon) => {
                self.keyword_as_name()
            }
            S::Text => {
                let text = self.text_of(self.at).trim_matches('"');
                error("the name of a field is written without quotes", "expected a name").with_suggestion(
                    here,
                    text,
                    "leave the quotes out",
                )
            }
            S::DotDot => error("a record with other fields is written with `|`", "expected a field")
                .with_help("write `{ record | name = value }`"),
            S::Comma if self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == S::Comma) => {
                error("there is nothing between two commas", "a second comma").with_suggestion(
                    here,
                    "",
                    "remove one",
                )
            }
            // `radius = 1,5`
            S::Number
                if self.is_tight()
                    && self.at.checked_sub(2).is_some_and(|whole| self.kind_of(whole) == S::Number)
                    && self.kind_of(self.at - 1) == S::Comma =>
            {
                let whole = self.span_of(self.at - 2).to(here);
                let written = format!("{}.{}", self.text_of(self.at - 2), self.text_of(self.at));
                let message = "the decimals of a number follow a point, not a comma";
                Diagnostic::error("odd-number", message, whole, "two values").with_suggestion(
                    whole,
                    written,
                    "write a point",
                )
            }
            S::Comma => error("nothing is before the comma", "expected a field before this").with_suggestion(
                here,
                "",
                "remove it",
            ),
            _ => error(
                &format!("expected the name of a field, found {}", self.found()),
                "a field is written `name = value`",
            ),
        }
    }

    /// Whether an `=` follows, or what is taken for one.
    pub(in super::super) fn defines_field(&mut self) -> bool {
        let text = match self.current {
            SyntaxKind::Define => return true,
            SyntaxKind::Colon => ":",
            SyntaxKind::Equal => "==",
            _ => return false,
        };
        let here = self.here();
        let message = format!("a field takes its value with `=`, not with `{text}`");
        let error = Diagnostic::error("colon-in-record", message, here, "expected `=`");
        let space = if self.is_tight() { " " } else { "" };
        self.report(error.with_suggestion(here, format!("{space}="), "write `=`"));
        true
    }

    pub(in super::super) fn begins_value(&self) -> bool {
        matches!(
            self.current,
            SyntaxKind::Number
                | SyntaxKind::Color
                | SyntaxKind::Text
                | SyntaxKind::OpenParen
                | SyntaxKind::OpenBracket
        ) || self.is(SyntaxKind::Minus) && self.kind_ahead(1) == SyntaxKind::Number
    }

    pub(in super::super) fn missing_equals(&self) -> Diagnostic {
        let value = self.here().to(self.span_of(self.at + 1));
        let (here, found) = match self.slice(value).filter(|_| self.is(SyntaxKind::Minus)) {
            Some(negative) => (value, quoted(negative)),
            None => (self.here(), self.found()),
        };
        let message = format!("expected `=` after the name of the field, found {found}");
        let error = Diagnostic::error("missing-equals", message, here, "expected `=` before this");
        error.with_suggestion(self.gap(), " =", "add `=`")
    }

    /// Fields in the parentheses that began with token `first`, which are closed now.
    pub(in super::super) fn fields_in_parentheses(&mut self, first: usize) {
        let last = self.at.saturating_sub(1);
        let span = self.span_of(first).to(self.span_of(last));
        let name = first.checked_sub(1).map_or("", |name| self.text_of(name));
        if !CONSTRUCTORS.iter().any(|constructor| constructor.name == name) {
            let message = "arguments have no names";
            let error = Diagnostic::error("named-arguments", message, span, "expected values only");
            self.report(error.with_help(format!(
                "values are given one after another, `{name} a b`; to compare, write `==`"
            )));
            return;
        }
        let message = format!("the fields of {} stand in braces, not in parentheses", quoted(name));
        let error = Diagnostic::error("braces", message, span, "expected `{ ... }`");
        let inner = self.slice(Span::new(self.span_of(first).end, self.span_of(last).start));
        let error = match inner.filter(|_| self.kind_of(last) == SyntaxKind::CloseParen) {
            Some(inner) => {
                let space = if self.tokens.get(first).is_some_and(|open| open.spaced) { "" } else { " " };
                error.with_suggestion(span, format!("{space}{{ {} }}", inner.trim()), "write braces")
            }
            None => error.with_help("write `name { field = value }`"),
        };
        self.report(error);
    }

    /// `x = list` after the `|` of a comprehension.
    pub(in super::super) fn define_for_from(&mut self) {
        let message = "the elements of a list are taken with `<-`";
        let error = Diagnostic::error("comprehension", message, self.here(), "expected `<-`");
        let text = "write `<-` (a name for a value is `let x = ...`)";
        self.report(error.with_suggestion(self.here(), "<-", text));
    }

    /// `first .. last` without brackets, from a token on.
    pub(in super::super) fn bare_range(&mut self, first: usize) {
        let span = Span::new(self.span_of(first).start, self.gap().end);
        let error = Diagnostic::error("range", "a range is written in brackets", span, "not a list");
        let text = self.slice(span).unwrap_or("0 .. 10");
        self.report(error.with_suggestion(span, format!("[{text}]"), "write brackets"));
    }

    /// `for x in list` of a comprehension of Python.
    pub(in super::super) fn for_of_python(&mut self) {
        let here = self.here();
        let follows_bar =
            self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::Bar);
        let bar = if follows_bar { "" } else { "| " };
        let message = "there is no `for` in hry; a comprehension has a `|` and `<-`";
        let (name, last) = (self.at + 1, self.at + 6);
        let is_range = self.kind_of(self.at + 2) == SyntaxKind::InKeyword
            && self.text_of(self.at + 3) == "range"
            && self.kind_of(self.at + 4) == SyntaxKind::OpenParen
            && self.kind_of(last) == SyntaxKind::CloseParen;
        let name = self.text_of(name);
        let (end, written) = if is_range {
            let count = self.text_of(self.at + 5);
            (last, format!("{bar}{name} <- [0 .. {count} - 1]"))
        } else {
            (self.at + 2, format!("{bar}{name} <-"))
        };
        let span = here.to(self.span_of(end));
        let error = Diagnostic::error("foreign-word", message, span, "not how a comprehension is written");
        self.report(error.with_suggestion(span, written, "write"));
        // The `in` is part of it.
        self.failed_at = Some(self.at + 2);
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

    /// `x in list`
    pub(in super::super) fn in_for_from(&mut self) {
        if self.failed_at == Some(self.at) {
            return;
        }
        let message = "the elements of a list are taken with `<-`";
        let error = Diagnostic::error("comprehension", message, self.here(), "expected `<-`");
        let error = error.with_suggestion(self.here(), "<-", "write `<-`");
        self.report(error);
    }

    pub(in super::super) fn no_generator(&self) -> Diagnostic {
        let message = format!("expected `<-`, found {}", self.found());
        Diagnostic::error("comprehension", message, self.here(), "expected `<-` and a list")
    }
}

/// The function of the library that a name means, where it is one.
fn takes_arguments(name: &str) -> Option<&'static NativeSpec> {
    NATIVES.iter().find(|native| native.name == name && native.signature.contains("->"))
}
