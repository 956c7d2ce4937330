//! Expressions, outside brackets.

use super::super::kind::SyntaxKind;
use super::super::parser::{Done, Mark, Parser};
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// `=` in a condition.
    pub(in super::super) fn single_equals(&mut self) {
        let message = "`=` gives a name to a value; two values are compared with `==`";
        let error = Diagnostic::error("single-equals", message, self.here(), "expected `==`");
        let error = error.with_suggestion(self.here(), "==", "to compare, write `==`");
        self.report(error);
    }

    /// `!` before an operand.
    pub(in super::super) fn bang(&mut self) {
        let error = Diagnostic::error(
            "foreign-operator",
            "`!` is written `not` in hry",
            self.here(),
            "expected `not`",
        );
        let space = if self.tokens.get(self.at + 1).is_some_and(|next| next.spaced) { "" } else { " " };
        let error = error.with_suggestion(self.here(), format!("not{space}"), "write `not`");
        self.report(error);
    }

    /// `a < b < c`; `first` is the first operator.
    pub(in super::super) fn chained_comparison(&mut self, first: usize) {
        let middle = Span::new(self.span_of(first + 1).start, self.gap().end);
        let text = middle
            .start
            .checked_sub(self.base)
            .and_then(|start| self.text.get(start..middle.end - self.base));
        let text = text.unwrap_or("").to_owned();
        let message = "comparisons do not chain";
        let error = Diagnostic::error("chained-comparison", message, self.here(), "a second comparison")
            .with_secondary(self.span_of(first), "the first is true or false");
        let error = if text.len() <= 40 && !text.contains('\n') {
            error.with_suggestion(Span::at(self.here().start), format!("and {text} "), "compare twice")
        } else {
            error.with_help("write `a < b and b < c`")
        };
        self.report(error);
    }

    pub(in super::super) fn no_parameter(&self) -> Diagnostic {
        let message = format!("a function needs a parameter, found {}", self.found());
        let error = Diagnostic::error("missing-parameter", message, self.here(), "expected a name");
        error.with_help("a function is written `\\x -> x + 1`")
    }

    /// Goes past the `->` of a function or an arm.
    pub(in super::super) fn expect_arrow(&mut self) {
        if self.eat(SyntaxKind::Arrow) {
            return;
        }
        if self.is(SyntaxKind::Colon) && self.kind_ahead(2) == SyntaxKind::Arrow {
            self.cons_pattern();
            return;
        }
        self.fail(|parser| {
            let message = format!("expected `->`, found {}", parser.found());
            let error =
                Diagnostic::error("missing-arrow", message, parser.here(), "expected `->` and a value");
            if parser.is(SyntaxKind::Define) || parser.is(SyntaxKind::Colon) {
                return error.with_suggestion(parser.here(), "->", "write `->`");
            }
            error
        });
        if self.is(SyntaxKind::Define) || self.is(SyntaxKind::Colon) {
            self.bump();
        }
    }

    /// `first :: rest ->`; goes past that.
    fn cons_pattern(&mut self) {
        let (first, rest) = (self.at.saturating_sub(1), self.at + 1);
        let span = self.span_of(first).to(self.span_of(rest));
        let message = "a list is taken apart in brackets";
        let error = Diagnostic::error("list-pattern", message, self.here(), "not a part of a pattern");
        let pattern = format!("[{}, ..{}]", self.text_of(first), self.text_of(rest));
        self.report(error.with_suggestion(span, pattern, "write"));
        self.bump();
        self.bump();
        self.bump();
    }

    /// A `|` before an arm of a `match`; said once.
    pub(in super::super) fn bar_before_arm(&mut self) {
        if self.has_bars {
            return;
        }
        let message = "the arms of a `match` are separated by commas, and do not begin with `|`";
        let error = Diagnostic::error("missing-pattern", message, self.here(), "expected a pattern");
        let error = error.with_suggestion(self.here(), "", "remove it");
        self.report(error);
        self.has_bars = true;
    }

    /// Goes past a word of `if`, which began at `start`.
    pub(in super::super) fn expect_word(&mut self, word: SyntaxKind, start: Mark) {
        if self.eat(word) {
            return;
        }
        self.fail(|parser| parser.no_word(word, start));
        let goes_on =
            word == SyntaxKind::ThenKeyword && matches!(self.current, SyntaxKind::Name | SyntaxKind::Number);
        if !self.is(word) && !goes_on {
            self.skip_expr();
        }
        self.eat(word);
    }

    /// `if c { a } else { b }`, at the `else`.
    fn braces_after_condition(&self, start: Mark) -> Option<Diagnostic> {
        let close = self.at.checked_sub(1).filter(|close| self.kind_of(*close) == SyntaxKind::CloseBrace)?;
        let first = Self::token_of(start);
        let open = (first..close).rev().find(|token| self.kind_of(*token) == SyntaxKind::OpenBrace)?;
        let span = self.span_of(open).to(self.span_of(close));
        let message = "an `if` needs no braces; what is in braces is a record";
        let condition = Span::new(self.span_of(first + 1).start, self.span_of(open).start);
        let inner = self.slice(Span::new(self.span_of(open).end, self.span_of(close).start))?.trim();
        let error = Diagnostic::error("braces", message, span, "expected `then` and a value")
            .with_secondary(condition, "the condition");
        Some(error.with_help(format!("write `then {inner} else ...`, without braces")))
    }

    fn no_word(&self, word: SyntaxKind, start: Mark) -> Diagnostic {
        if let (SyntaxKind::ThenKeyword, SyntaxKind::ElseKeyword, Some(error)) =
            (word, self.current, self.braces_after_condition(start))
        {
            return error;
        }
        let word = word.spelling();
        let message = format!("this `if` has no `{word}`");
        let label = format!("expected `{word}`, found {}", self.found());
        let error = Diagnostic::error("incomplete-if", message, self.here(), label);
        let error = error.with_secondary(self.span_of(Self::token_of(start)), "the `if`");
        let error = error.with_help("an `if` is a value, so it needs both: `if condition then a else b`");
        self.with_layout(error)
    }

    pub(in super::super) fn no_subject(&self) -> Diagnostic {
        let message = "this `match` does not say what it looks at";
        let error = Diagnostic::error("missing-value", message, self.here(), "expected a value before this");
        error.with_help("write `match list { [] -> 0, [first, ..rest] -> first }`")
    }

    pub(in super::super) fn no_arms(&self, start: Mark) -> Diagnostic {
        let message = format!("expected the arms of this `match`, found {}", self.found());
        let error = Diagnostic::error("missing-arms", message, self.here(), "expected `{`");
        let error = error.with_secondary(self.span_of(Self::token_of(start)), "the `match`");
        error.with_help("write `match list { [] -> 0, [first, ..rest] -> first }`")
    }

    /// A function, `let` or `if` as an argument, without parentheses.
    pub(in super::super) fn bare_argument(&mut self) -> Done {
        let word = self.text_of(self.at).to_owned();
        let what = match self.current {
            SyntaxKind::Backslash => "a function".to_owned(),
            _ => format!("`{word}`"),
        };
        let message = format!("{what} as an argument needs parentheses");
        let (place, is_function) = (self.here(), self.is(SyntaxKind::Backslash));
        // Where it ends is not known, so what else seems wrong in it is not to be trusted.
        let is_quiet = std::mem::replace(&mut self.is_quiet, true);
        let done = self.operation();
        self.is_quiet = is_quiet;
        let error = Diagnostic::error("bare-argument", message, place, "expected `(` before this");
        let whole = Span::new(place.start, self.gap().end);
        let error = match self.slice(whole) {
            Some(text) if !is_function => {
                error.with_suggestion(whole, format!("({text})"), "put it in parentheses")
            }
            _ => error.with_help("put the function in parentheses: `map (\\x -> x + 1) list`"),
        };
        self.report(error);
        done
    }

    /// Goes past `.name`, if it is that.
    pub(in super::super) fn field_name(&mut self) -> bool {
        let is_tight = self.tokens.get(self.at + 1).is_some_and(|name| !name.spaced);
        if self.kind_ahead(1) == SyntaxKind::Name && is_tight {
            self.bump();
            self.bump();
            return true;
        }
        self.fail(|parser| parser.no_field_name(is_tight));
        self.bump();
        match self.current {
            SyntaxKind::Name | SyntaxKind::TypeName | SyntaxKind::Number => self.bump(),
            kind if kind.is_keyword() && is_tight => self.bump(),
            _ => return false,
        }
        true
    }

    /// What is wrong after a `.`.
    fn no_field_name(&self, is_tight: bool) -> Diagnostic {
        let (dot, next) = (self.here(), self.span_of(self.at + 1));
        let name = self.text_of(self.at + 1);
        let error =
            |message: &str, span: Span, label: &str| Diagnostic::error("missing-field", message, span, label);
        let is_number =
            self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::Number);
        match self.kind_ahead(1) {
            _ if is_number => {
                let message = "a number has digits after its point";
                Diagnostic::error("odd-number", message, dot, "expected a digit after this").with_suggestion(
                    dot,
                    "",
                    "leave the point out",
                )
            }
            SyntaxKind::Name => error(
                "a field follows its `.` without a space",
                Span::new(dot.end, next.start),
                "expected no space here",
            )
            .with_suggestion(Span::new(dot.end, next.start), "", "remove the space"),
            SyntaxKind::TypeName if is_tight => {
                let lower = super::lower_case(name);
                let error =
                    error("fields begin with a lower-case letter", next, "expected the name of a field");
                error.with_suggestion(next, lower.clone(), format!("write `{lower}`"))
            }
            SyntaxKind::Number if is_tight => {
                let error =
                    error("parts of a vector have names, not numbers", next, "expected the name of a field");
                let part = match name {
                    "0" => "x",
                    "1" => "y",
                    "2" => "z",
                    _ => {
                        return error
                            .with_help("they are `.x`, `.y` and `.z`; an element of a list is `at 3 list`");
                    }
                };
                error.with_suggestion(
                    next,
                    part,
                    format!("write `{part}`; an element of a list is `at {name} list`"),
                )
            }
            SyntaxKind::OpenBracket => {
                error("a `.` is followed by the name of a field", next, "expected the name of a field")
                    .with_help("an element of a list is `at 0 list`")
            }
            kind if kind.is_keyword() && is_tight => {
                let message = format!("`{name}` is a word of the language, so it is no field");
                error(&message, next, "expected the name of a field")
            }
            _ => error(
                "a `.` is followed by the name of a field",
                dot,
                "expected the name of a field directly after this",
            ),
        }
    }

    /// The parameters of a function stood in the parentheses that began with token `first`.
    pub(in super::super) fn parameters_in_parentheses(&mut self, first: usize) {
        let names: Vec<&str> = (first + 1..self.at)
            .filter(|token| self.kind_of(*token) == SyntaxKind::Name)
            .map(|token| self.text_of(token))
            .collect();
        let written = format!("\\{} ->", names.join(" "));
        let span = self.span_of(first).to(self.here());
        let message = "a function begins with a `\\`, and its parameters have no parentheses";
        let error = Diagnostic::error("missing-backslash", message, span, "not how a function is written");
        self.report(error.with_suggestion(span, written, "write"));
    }

    /// `->` without a `\` before its parameters.
    pub(in super::super) fn no_backslash(&self) -> Diagnostic {
        let mut first = self.at;
        while let Some(before) = first.checked_sub(1) {
            if !matches!(self.kind_of(before), SyntaxKind::Name | SyntaxKind::Underscore) {
                break;
            }
            first = before;
        }
        let message = "a function begins with a `\\`";
        let error = Diagnostic::error(
            "missing-backslash",
            message,
            self.here(),
            "expected a `\\` before the parameters of this",
        );
        let parameters = Span::new(self.span_of(first).start, self.gap().end);
        let error = if first < self.at {
            let whole = parameters.to(self.here());
            Diagnostic::error("missing-backslash", message, whole, "expected a `\\` before this")
        } else {
            error
        };
        match self.slice(parameters).filter(|_| first < self.at) {
            Some(names) => {
                let whole = parameters.to(self.here());
                error.with_suggestion(whole, format!("\\{names} ->"), "write")
            }
            None => error.with_help("write `\\x -> x * 2`"),
        }
    }
}
