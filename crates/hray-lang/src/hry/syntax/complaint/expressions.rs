//! Expressions, outside brackets.

use super::super::kind::SyntaxKind;
use super::super::parser::{Done, Mark, Parser};
use super::quoted;
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

    /// Goes past a word of `if`, which began at `start`.
    pub(in super::super) fn expect_word(&mut self, word: SyntaxKind, start: Mark) {
        if self.eat(word) {
            return;
        }
        self.fail(|parser| parser.no_word(word, start));
        if !self.is(word) {
            self.skip_expr();
        }
        self.eat(word);
    }

    fn no_word(&self, word: SyntaxKind, start: Mark) -> Diagnostic {
        let word = word.spelling();
        let message = format!("this `if` has no `{word}`");
        let label = format!("expected `{word}` here, found {}", self.found());
        let error = Diagnostic::error("incomplete-if", message, self.here(), label);
        let error = error.with_secondary(self.span_of(Self::token_of(start)), "the `if`");
        error.with_help("an `if` is a value, so it needs both: `if condition then a else b`")
    }

    pub(in super::super) fn no_arms(&self, start: Mark) -> Diagnostic {
        let message = format!("expected the arms of this `match`, found {}", self.found());
        let error = Diagnostic::error("missing-arms", message, self.here(), "expected `{`");
        let error = error.with_secondary(self.span_of(Self::token_of(start)), "the `match`");
        error.with_help("write `match list { [] -> 0, [first, .. rest] -> first }`")
    }

    /// A number and the like in front of an argument.
    pub(in super::super) fn check_application(&mut self, function: Done) {
        let _ = function;
    }

    /// A function, `let` or `if` as an argument, without parentheses.
    pub(in super::super) fn bare_argument(&mut self) -> Done {
        let word = self.text_of(self.at).to_owned();
        let what = match self.current {
            SyntaxKind::Backslash => "a function".to_owned(),
            _ => format!("`{word}`"),
        };
        let message = format!("{what} as an argument needs parentheses");
        let (place, label) = (self.here(), "expected `(` before it");
        let done = self.operation();
        let end = self.gap();
        let error = Diagnostic::error("bare-argument", message, place, label);
        let whole = Span::new(place.start, end.end);
        let text = self.text.get(whole.start - self.base..whole.end - self.base).unwrap_or("").to_owned();
        self.report(error.with_suggestion(whole, format!("({text})"), "put it in parentheses"));
        done
    }

    /// Goes past `.name`, if it is that.
    pub(in super::super) fn field_name(&mut self, record: Done) -> bool {
        let is_name = matches!(self.kind_ahead(1), SyntaxKind::Name)
            && self.tokens.get(self.at + 1).is_some_and(|name| !name.spaced);
        if is_name {
            self.bump();
            self.bump();
            return true;
        }
        let _ = record;
        self.fail(|parser| {
            let message = "expected the name of a field directly after the `.`";
            Diagnostic::error("missing-field", message, parser.here(), "no name follows this")
        });
        self.bump();
        false
    }

    /// No expression begins here.
    pub(in super::super) fn no_expr(&mut self) -> Done {
        let start = self.mark();
        self.fail(Self::no_value);
        if matches!(self.current, SyntaxKind::TypeName | SyntaxKind::Underscore) {
            self.bump();
        }
        self.error_expr(start)
    }

    fn no_value(&self) -> Diagnostic {
        let message = format!("expected a value, found {}", self.found());
        let error = Diagnostic::error("missing-value", message, self.here(), "expected a value here");
        match self.ended_by_layout() {
            Some((name, place, line)) => error
                .with_secondary(
                    line,
                    format!("this line starts at or left of {}, so it ended that", quoted(name)),
                )
                .with_secondary(place, format!("{} starts here", quoted(name)))
                .with_help("what belongs to a definition is indented more than its name"),
            None => error,
        }
    }
}
