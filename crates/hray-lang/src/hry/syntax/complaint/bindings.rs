//! Annotations, definitions and `let`.

use super::super::brackets::defines;
use super::super::kind::SyntaxKind;
use super::super::parser::{Parser, Promise};
use super::quoted;
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// An annotation has to be followed by its definition, which begins with token `next`.
    pub(in super::super) fn kept_promise(&mut self, promise: &mut Option<Promise>, next: Option<usize>) {
        let Some(promised) = promise.take() else { return };
        let name = self.text_of(promised.name());
        let next_name = next.map(|next| self.text_of(next));
        if next_name == Some(name) {
            return;
        }
        let message = format!("the type of {} is given, but its definition does not follow", quoted(name));
        let label = format!("expected `{name} = ...` directly below this");
        let error = Diagnostic::error("missing-definition", message, self.span_of(promised.name()), label);
        self.report(error);
    }

    /// The type of a name is given once more.
    pub(in super::super) fn second_annotation(&mut self, first: Promise, second: usize) {
        let message = format!("the type of {} is given twice", quoted(self.text_of(second)));
        let error = Diagnostic::error("second-annotation", message, self.span_of(second), "here again");
        let error =
            error.with_secondary(self.span_of(first.name()), "given here").with_help("remove one of them");
        self.report(error);
    }

    pub(in super::super) fn after_annotation(&self, first: usize) -> Diagnostic {
        let name = self.text_of(first);
        let code = "annotation";
        let message = format!("expected the end of the type of {}, found {}", quoted(name), self.found());
        let error = Diagnostic::error(code, message, self.here(), "not expected in a type");
        match self.current {
            SyntaxKind::Define => {
                let message = format!("the type of {} and its value are written on two lines", quoted(name));
                let error = Diagnostic::error(code, message, self.here(), "expected a new line");
                error.with_help(format!("begin a new line with `{name} = ...`"))
            }
            SyntaxKind::TypeName | SyntaxKind::Name => {
                error.with_help("a list of numbers is `[Number]`, a function `Number -> Number`")
            }
            _ => error,
        }
    }

    /// What a definition at the top binds has to be a name.
    pub(in super::super) fn check_target(&mut self, first: usize) {
        if matches!(self.kind_of(first), SyntaxKind::Name | SyntaxKind::TypeName) {
            return;
        }
        let span = Span::new(self.span_of(first).start, self.gap().end);
        let message = "a definition at the top begins with a name";
        let error = Diagnostic::error("definition", message, span, "expected a name");
        self.report(error.with_help("patterns may be taken apart in `let`, in functions and in `match`"));
    }

    /// The tokens from `first` on are no definition; where that shows is the current token.
    pub(in super::super) fn no_define(&self, first: usize) -> Diagnostic {
        use SyntaxKind as S;
        let name = quoted(self.text_of(first));
        let (code, here) = ("missing-equals", self.here());
        match self.current {
            kind if kind.is_keyword() && self.at > first => {
                let message = format!(
                    "{} is a word of the language, so it cannot be a parameter",
                    quoted(self.text_of(self.at))
                );
                return Diagnostic::error("keyword-as-name", message, here, "expected a name or `=`");
            }
            S::Dot => {
                let message = format!("nothing can be changed, so a field of {name} cannot be set");
                let error = Diagnostic::error(code, message, here, "expected `=`");
                return error.with_help(format!(
                    "a record with another field is `{{ {} | field = value }}`",
                    self.text_of(first)
                ));
            }
            S::Bar => {
                let message = "a function has one body, without guards";
                let error =
                    Diagnostic::error(code, message, here, format!("expected `=` and the value of {name}"));
                return error.with_help("write `f x = if x > 0 then 1 else 2`");
            }
            S::Equal | S::Arrow => {
                let message =
                    format!("a definition is written with `=`, not with `{}`", self.text_of(self.at));
                let error = Diagnostic::error(code, message, here, "expected `=`");
                return error.with_suggestion(here, "=", "write `=`");
            }
            S::Comma => {
                let message = "a definition at the top has one name";
                let error = Diagnostic::error(code, message, here, format!("expected `=` after {name}"));
                return error
                    .with_help("in a `let`, a vector can be taken apart: `let (x, y) = point in x + y`");
            }
            S::OpenBrace | S::OpenBracket => return self.nameless(first),
            S::Number | S::Text | S::Color | S::OpenParen | S::TrueKeyword | S::FalseKeyword => {
                let message = format!("expected `=` after {name}, found {}", self.found());
                let error = Diagnostic::error(code, message, here, "expected `=` before this");
                return error.with_suggestion(self.gap(), " =", "add `=`");
            }
            _ => {}
        }
        let message = format!("expected `=` after {name}, found {}", self.found());
        let error = Diagnostic::error(code, message, here, format!("expected `=` and the value of {name}"));
        self.with_layout(error)
    }

    /// A value stands where a definition belongs.
    fn nameless(&self, first: usize) -> Diagnostic {
        if self.is(SyntaxKind::OpenBrace) && self.is_povray(first) {
            return self.povray(first);
        }
        let is_definition = self.kind_of(first) == SyntaxKind::Name
            && self.kind_of(first + 1) == SyntaxKind::Name
            && self.kind_of(first + 2) == SyntaxKind::OpenBrace;
        if is_definition {
            let name = self.text_of(first);
            let place = Span::at(self.span_of(first).end);
            let message = format!("`=` is missing after `{name}`");
            let error = Diagnostic::error(
                "missing-equals",
                message,
                self.span_of(first + 1),
                "expected `=` before this",
            );
            return error.with_suggestion(place, " =", "add `=`");
        }
        let message = "this value has no name, so nothing can use it";
        let error =
            Diagnostic::error("missing-name", message, self.span_of(first), "expected `name = ` before this");
        error.with_help("what is rendered is called `scene`: `scene = { objects = [ ... ], ... }`")
    }

    /// Whether the `{` here follows a name, and what is in it is POV-Ray's.
    pub(in super::super) fn is_povray_here(&self) -> bool {
        self.at
            .checked_sub(1)
            .is_some_and(|name| self.kind_of(name) == SyntaxKind::Name && self.is_povray(name))
    }

    /// Whether `name { <0, 1, 0>` or `name { location <0, 1, 0>` begins at a token.
    fn is_povray(&self, first: usize) -> bool {
        use SyntaxKind as S;
        let kind = |after: usize| self.kind_of(first + after);
        let is_number = matches!(self.text_of(first), "sphere" | "box" | "torus" | "cone" | "cylinder")
            && kind(2) == S::Number
            && kind(3) == S::Comma;
        let is_axis = matches!(self.text_of(first + 2), "x" | "y" | "z") && kind(3) == S::Comma;
        matches!(kind(2), S::Less | S::From)
            || kind(2) == S::Name && matches!(kind(3), S::Less | S::OpenBrace)
            || is_axis
            || is_number
    }

    /// `let` before a definition at the top.
    pub(in super::super) fn let_at_the_top(&mut self) {
        let span = Span::new(self.here().start, self.span_of(self.at + 1).start);
        let message = "a definition at the top needs no `let`";
        let error = Diagnostic::error("definition", message, self.here(), "not expected here");
        self.report(error.with_suggestion(span, "", "remove it"));
        self.is_quiet = true;
    }

    /// `x = a, b` at the top, where the value begins with token `body`.
    pub(in super::super) fn commas_in_definition(&mut self, body: usize) {
        let here = self.here();
        let mut last = self.at;
        while self.tokens.get(last + 1).is_some_and(|next| !next.starts_line) {
            last += 1;
        }
        let takes_list = matches!(self.text_of(body), "group" | "concat" | "sum" | "count" | "reverse");
        let first = if takes_list { body + 1 } else { body };
        let span = self.span_of(first).to(self.span_of(last));
        let is_last = last == self.at;
        let message = "a comma stands outside of brackets";
        let error = Diagnostic::error("unexpected", message, here, "not expected here");
        let error = match self.slice(span) {
            _ if is_last => {
                error.with_suggestion(here, "", "definitions are not separated by commas; remove it")
            }
            Some(text) => {
                let help = "several values are a list, in brackets (a vector is written in parentheses):";
                error.with_suggestion(span, format!("[{text}]"), help)
            }
            None => error.with_help("several values are a list, in brackets: `[a, b]`"),
        };
        self.report(error);
    }

    /// Whether a statement of POV-Ray begins here.
    pub(in super::super) fn begins_povray(&self) -> bool {
        self.is(SyntaxKind::Name)
            && self.starts_line()
            && self.kind_ahead(1) == SyntaxKind::OpenBrace
            && self.is_povray(self.at)
    }

    /// `;` after a definition.
    pub(in super::super) fn semicolon(&mut self) {
        let here = self.here();
        let error =
            Diagnostic::error("unexpected", "definitions do not end with `;`", here, "not expected here");
        let is_last = self.tokens.get(self.at + 1).is_none_or(|next| next.starts_line);
        let help = "begin the next definition on a line of its own";
        self.fail(
            |_| if is_last { error.with_suggestion(here, "", "remove it") } else { error.with_help(help) },
        );
    }

    /// Something follows the body of a binding that began with token `first`.
    pub(in super::super) fn after_body(&self, first: usize, is_top: bool) -> Diagnostic {
        use SyntaxKind as S;
        let here = self.here();
        let name = quoted(self.text_of(first));
        let text = self.text_of(self.at);
        let error = |code, message: &str, label: &str| Diagnostic::error(code, message, here, label);
        match self.current {
            S::Comma => error("unexpected", "definitions are not separated by commas", "not expected here").with_suggestion(here, "", "remove it"),
            S::Define | S::Name | S::Colon => self.second_define(first, is_top),
            S::Arrow => self.no_backslash(),
            S::From => error("unexpected", "`<-` takes the elements of a list, inside `[ ... | x <- list ]`", "not expected here")
                .with_suggestion(here, "< -", "to compare with a negative number, write a space"),
            S::Dot if self.kind_ahead(1) == S::Name
                && self.tokens.get(self.at + 1).is_some_and(|next| next.spaced)
                && self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == S::Name) =>
            {
                let (before, after) = (self.at - 1, self.at + 1);
                let joined = format!("{} >> {}", self.text_of(after), self.text_of(before));
                error("foreign-operator", "functions are not joined by `.`", "not an operator of hry").with_suggestion(
                    self.span_of(before).to(self.span_of(after)),
                    joined,
                    "`f >> g` does `f` first, then `g`:",
                )
            }
            S::Dot => {
                let span = Span::new(self.gap().end, here.start);
                error("missing-field", "a field directly follows its value, without a space", "expected no space before this")
                    .with_suggestion(span, "", "remove the space")
                    .with_note("a function that takes a field is written `(\\r -> r.x)`")
            }
            S::Bang => error("unexpected", "there is no operator `!`", "not expected here")
                .with_help("an element of a list is `at 3 list`; `not` negates a condition"),
            S::ThenKeyword | S::ElseKeyword => error("incomplete-if", &format!("this `{text}` has no `if`"), "not expected here")
                .with_help("write `if condition then a else b`"),
            S::InKeyword => error("missing-binding", "this `in` has no `let`", "not expected here").with_help("write `let y = x * 2 in y + 1`"),
            S::DotDot => error("range", "a range is written in brackets", "not expected here").with_help("write `[0 .. 10]`"),
            S::Bar if self.kind_ahead(1) == S::Name => {
                error("unexpected", "a value is passed on with `|>`, not with `|`", "expected `|>`")
                    .with_suggestion(here, "|>", "write `|>`")
            }
            S::Bar => error("unexpected", "nothing is to be told apart here", "not expected here")
                .with_help("`|` belongs in `[x | x <- list]` and `{ record | field = value }`; conditions are `if` and `or`"),
            _ => {
                let message = format!("{} cannot follow here", self.found());
                let label = format!("expected an operator, an argument, or the end of {name}");
                Diagnostic::error("unexpected", message, here, label)
            }
        }
    }

    /// An `=` or `:` after the body of a binding, or a name before one.
    fn second_define(&self, first: usize, is_top: bool) -> Diagnostic {
        let name = quoted(self.text_of(first));
        let line = (first..=self.at)
            .rev()
            .take(100)
            .find(|token| self.tokens.get(*token).is_some_and(|token| token.starts_line));
        let body = defines(self.tokens, first).map(|define| define + 1);
        match line.filter(|line| *line > first && self.kind_of(*line) == SyntaxKind::Name) {
            Some(line) if Some(line) == body => self.local_without_let(line, first),
            Some(line) => self.indented(line, first, is_top),
            None if self.is(SyntaxKind::Colon) => {
                let message = "a type is given on a line of its own, or in parentheses";
                let error = Diagnostic::error("annotation", message, self.here(), "not expected here");
                error.with_help("write `radius : Number` above the definition, or `(x : Number)`")
            }
            None if self.is(SyntaxKind::Name) => {
                let message = "two definitions are on one line";
                let error =
                    Diagnostic::error("unexpected", message, self.here(), "expected a new line before this");
                error.with_secondary(self.span_of(first), format!("the definition of {name} begins here"))
            }
            None => {
                let message = "a definition has one `=`";
                let error = Diagnostic::error("single-equals", message, self.here(), "a second `=`");
                error.with_suggestion(self.here(), "==", "to compare, write `==`")
            }
        }
    }

    /// `f x =`, and on the next line `y = ...`
    fn local_without_let(&self, line: usize, first: usize) -> Diagnostic {
        let local = self.text_of(line);
        let message = "a definition inside another is written with `let` and `in`";
        let error =
            Diagnostic::error("local-definition", message, self.span_of(line), "expected `let` before this");
        let error = error.with_secondary(
            self.span_of(first),
            format!("inside the definition of {}", quoted(self.text_of(first))),
        );
        error.with_help(format!("write `let {local} = ...`, and `in` before the value"))
    }

    /// A definition that is indented more than the one before.
    fn indented(&self, line: usize, first: usize, is_top: bool) -> Diagnostic {
        let (inner, outer) = (quoted(self.text_of(line)), quoted(self.text_of(first)));
        let message = format!("{inner} is indented, so it is part of the definition of {outer}");
        let error = Diagnostic::error(
            "indented-definition",
            message,
            self.span_of(line),
            format!("begins further right than {outer}"),
        );
        let error = error.with_secondary(self.span_of(first), format!("{outer} begins here"));
        let start = self.span_of(line).start;
        let column = self.tokens.get(line).map_or(0, |token| token.column as usize);
        let outer_column = self.tokens.get(first).map_or(0, |token| token.column as usize);
        let surplus = column.saturating_sub(outer_column);
        let spaces = Span::new(start.saturating_sub(surplus), start);
        let is_blank = self.slice(spaces).is_some_and(|text| text.bytes().all(|byte| byte == b' '));
        let help = if is_top { "begin it in the same column" } else { "begin both in the same column" };
        if is_blank { error.with_suggestion(spaces, "", help) } else { error.with_help(help) }
    }

    /// The bindings of a `let` are over, and no `in` follows.
    pub(in super::super) fn no_in(&self, first: usize) -> Diagnostic {
        let here = self.here();
        let label = format!("expected `in`, found {}", self.found());
        let error = Diagnostic::error("missing-in", "this `let` has no `in`", here, label);
        let error = error.with_secondary(self.span_of(first), "the `let`");
        if self.is_end() || self.current.is_close() || self.is(SyntaxKind::Comma) {
            let error =
                error.with_help("`let` names values for what follows its `in`: `let y = x * 2 in y + 1`");
            return self.with_layout(error);
        }
        error.with_suggestion(Span::at(here.start), "in ", "add `in` before the value")
    }

    pub(in super::super) fn no_binding(&self) -> Diagnostic {
        if self.current.is_keyword() && self.kind_ahead(1) == SyntaxKind::Define {
            return self.keyword_as_name();
        }
        let message = format!("nothing is defined between `let` and {}", self.found());
        let error =
            Diagnostic::error("missing-binding", message, self.here(), "expected `name = value` before this");
        error.with_help("write `let y = x * 2 in y + 1`")
    }

    /// What some write between the bindings of a `let`; goes past it.
    pub(in super::super) fn between_bindings(&mut self) {
        let here = self.here();
        let error = |text: &str| {
            let message =
                format!("the bindings of a `let` are not separated by `{text}`, but by line breaks");
            Diagnostic::error("one-binding-a-line", message, here, "expected a new line")
        };
        let help = "begin each binding on a line of its own, all in the same column";
        match self.current {
            SyntaxKind::Semicolon => {
                let error = error(";");
                let is_last = self.tokens.get(self.at + 1).is_none_or(|next| next.starts_line)
                    || self.kind_ahead(1) == SyntaxKind::InKeyword;
                let error = if is_last {
                    error.with_suggestion(here, "", "remove it")
                } else {
                    error.with_help(help)
                };
                self.report(error);
                self.bump();
            }
            SyntaxKind::Comma if self.separates_bindings() => {
                self.report(error(",").with_help(help));
                self.bump();
            }
            SyntaxKind::Name if !self.starts_line() && self.kind_ahead(1) == SyntaxKind::Define => {
                let message = "two bindings are on one line";
                let error =
                    Diagnostic::error("one-binding-a-line", message, here, "expected a new line before this");
                self.report(error.with_help(help));
            }
            _ => {}
        }
    }

    /// Whether the comma here is before another binding.
    pub(in super::super) fn separates_bindings(&self) -> bool {
        defines(self.tokens, self.at + 1).is_some()
    }

    /// Neither an import nor a definition begins here.
    pub(in super::super) fn no_definition(&mut self) {
        use SyntaxKind as S;
        let first = self.at;
        self.fail_for_good(|parser| {
            let here = parser.here();
            match parser.current {
                kind if kind.is_keyword() && matches!(parser.kind_ahead(1), S::Define | S::Colon) => {
                    parser.keyword_as_name()
                }
                S::Number
                | S::Text
                | S::Color
                | S::OpenParen
                | S::OpenBracket
                | S::OpenBrace
                | S::Backslash => parser.nameless(first),
                S::IfKeyword | S::LetKeyword | S::MatchKeyword | S::NotKeyword => parser.nameless(first),
                _ if first == 0 => {
                    let message = format!("expected a definition, found {}", parser.found());
                    let error = Diagnostic::error("definition", message, here, "expected `name = value`");
                    error.with_help(
                        "a scene begins like this: `scene = { objects = [ sphere { radius = 1 } ] }`",
                    )
                }
                S::Semicolon => {
                    Diagnostic::error("unexpected", "nothing ends with `;` in hry", here, "not expected here")
                        .with_suggestion(here, "", "remove it")
                }
                _ => {
                    let message = format!("expected a definition, found {}", parser.found());
                    let error = Diagnostic::error(
                        "definition",
                        message,
                        here,
                        "begins too far left to be part of the definition above",
                    );
                    error.with_suggestion(
                        Span::at(here.start),
                        "  ",
                        "indent what belongs to the definition above",
                    )
                }
            }
        });
    }
}
