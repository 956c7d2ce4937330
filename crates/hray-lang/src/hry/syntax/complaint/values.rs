//! A value is missing, or is not written as one.

use super::super::kind::SyntaxKind;
use super::super::parser::{Around, Done, Parser};
use super::{lower_case, quoted};
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// No expression begins here.
    pub(in super::super) fn no_expr(&mut self) -> Done {
        let start = self.mark();
        match self.current {
            SyntaxKind::TypeName => {
                self.upper_case();
                self.bump();
                return self.expr_node(SyntaxKind::NameExpr, start, 0);
            }
            SyntaxKind::Dot if self.kind_ahead(1) == SyntaxKind::Number => {
                self.fail(Self::no_zero);
                self.bump();
                self.bump();
            }
            SyntaxKind::Dot if self.kind_ahead(1) == SyntaxKind::Name => {
                self.fail(Self::accessor);
                self.bump();
                self.bump();
            }
            SyntaxKind::Less | SyntaxKind::From if self.is_angle_vector() => {
                self.fail(Self::angle_brackets);
                // All that follows is in that notation, too.
                self.is_quiet |= self.errors.last().is_some_and(|error| error.code == "povray");
                self.skip_angle_brackets();
            }
            SyntaxKind::Plus => {
                self.fail(Self::plus);
                self.bump();
                if !self.is(SyntaxKind::CloseParen) {
                    return self.postfix();
                }
            }
            SyntaxKind::Underscore => {
                self.fail(Self::wildcard);
                self.bump();
            }
            _ => self.fail(Self::no_value),
        }
        self.error_expr(start)
    }

    /// A name with an upper-case initial, where a name of a value belongs. Once for every name.
    pub(in super::super) fn upper_case(&mut self) {
        let name = self.text_of(self.at);
        if self.upper_case_names.contains(&name) {
            return;
        }
        self.fail(|parser| {
            let (code, span) = ("upper-case-name", parser.here());
            let word = match name {
                "True" | "TRUE" => Some("true"),
                "False" | "FALSE" => Some("false"),
                _ => None,
            };
            if let Some(word) = word {
                let error = Diagnostic::error(
                    code,
                    format!("`{name}` is written `{word}`"),
                    span,
                    "a lower-case word",
                );
                return error.with_suggestion(span, word, format!("write `{word}`"));
            }
            let is_prefix =
                parser.kind_ahead(1) == SyntaxKind::Dot && parser.kind_ahead(2) == SyntaxKind::Name;
            if is_prefix && matches!(name, "Math" | "THREE" | "Vec3" | "Color" | "Number") {
                let message = format!("the functions of hry need no `{name}.` before them");
                let whole = Span::new(span.start, parser.span_of(parser.at + 2).start);
                let error = Diagnostic::error(code, message, span, "expected the name of a function");
                return error.with_suggestion(whole, "", "leave it out");
            }
            let message = format!("{} begins with a capital, but only types do", quoted(name));
            let error = Diagnostic::error(code, message, span, "expected the name of a value");
            let lower = lower_case(name);
            error.with_suggestion(span, lower.clone(), format!("write `{lower}`"))
        });
        self.upper_case_names.push(name);
    }

    /// `.5`
    fn no_zero(&self) -> Diagnostic {
        let span = self.here().to(self.span_of(self.at + 1));
        let error = Diagnostic::error(
            "odd-number",
            "a number begins with a digit",
            span,
            "expected a digit before the point",
        );
        error.with_suggestion(Span::at(span.start), "0", "write a zero")
    }

    /// `.name` alone.
    fn accessor(&self) -> Diagnostic {
        let field = self.text_of(self.at + 1);
        let span = self.here().to(self.span_of(self.at + 1));
        let message = format!("`.{field}` needs something before it to take `{field}` of");
        let error =
            Diagnostic::error("missing-value", message, span, "expected a value directly before the `.`");
        error.with_suggestion(
            span,
            format!("(\\r -> r.{field})"),
            "for a function that takes the field, write",
        )
    }

    /// `<1, 2, 3>`
    fn angle_brackets(&self) -> Diagnostic {
        let open = self.at.checked_sub(1).filter(|open| self.kind_of(*open) == SyntaxKind::OpenBrace);
        let name = open.and_then(|open| open.checked_sub(1));
        if let Some(name) = name.filter(|name| self.kind_of(*name) == SyntaxKind::Name) {
            return self.povray(name);
        }
        let message = "a vector is written in parentheses, not in `<` and `>`";
        let span = self.here();
        let error = Diagnostic::error("angle-brackets", message, span, "expected a value");
        let end = self.closing_angle();
        let inner = end.and_then(|end| {
            // The sign may be a part of what looks like an arrow.
            let range = span.start + 1..self.span_of(end).start;
            Some((self.span_of(end).end, self.slice(Span::from(range))?))
        });
        let is_color = self
            .at
            .checked_sub(1)
            .is_some_and(|before| matches!(self.text_of(before), "rgb" | "rgbf" | "rgbt"));
        match inner {
            Some((end, inner)) if is_color => {
                let words: Vec<&str> = inner.split(',').map(str::trim).collect();
                error.with_suggestion(
                    Span::new(span.start, end),
                    words.join(" "),
                    "the parts of a colour are arguments",
                )
            }
            Some((end, inner)) => {
                let whole = Span::new(span.start, end);
                error.with_suggestion(whole, format!("({})", inner.trim()), "write parentheses")
            }
            None => error.with_help("write `(0, 1, 2)`"),
        }
    }

    /// `sphere { <0, 1, 0>, 2 ... }`, the name at a token.
    pub(in super::super) fn povray(&self, name: usize) -> Diagnostic {
        let word = self.text_of(name);
        let message = "this is the notation of POV-Ray; in hry the fields of a thing have names";
        let label = format!("what {} takes is written `{{ field = value, ... }}`", quoted(word));
        let error = Diagnostic::error("povray", message, self.span_of(name), label);
        let translated = self.translated(name);
        let help = translated.as_deref().unwrap_or(match word {
            "sphere" => {
                "write `sphere { center = (0, 1, 0), radius = 2, material = classic { color = #ff0000 } }`"
            }
            "box" => {
                "write `box { center = (0, 1, 0), size = (2, 2, 2), material = classic { color = #ff0000 } }`"
            }
            "plane" => "write `plane { normal = up, offset = -1, material = classic { color = #ff0000 } }`",
            "light_source" => {
                "write `point { position = (3, 4, 5), intensity = 1 }` in the list `lights` of the scene"
            }
            "camera" => "write `camera = perspective { from = (0, 2, 9), to = (0, 1, 0) }` in the scene",
            _ => {
                "for example `sphere { center = (0, 1, 0), radius = 2, material = classic { color = #ff0000 } }`"
            }
        });
        let note = "what is to be seen stands in one record: `scene = { lights = [ ... ], objects = [ ... ] }`; colours, textures and \
             moves inside a statement are not carried over";
        let error = if help.contains('(') {
            error.with_note(
                "the z axis points towards you here, and away from you in POV-Ray: its sign changes",
            )
        } else {
            error
        };
        error.with_note(note).with_help(help)
    }

    /// Whether a vector in angle brackets begins here.
    pub(in super::super) fn is_angle_vector(&self) -> bool {
        if !matches!(self.current, SyntaxKind::Less | SyntaxKind::From) {
            return false;
        }
        let is_first = self.is(SyntaxKind::Less) && self.nothing_before();
        is_first
            || self.closing_angle().is_some_and(|end| {
                (self.at..end).filter(|token| self.kind_of(*token) == SyntaxKind::Comma).count() == 2
            })
    }

    /// Whether no value is directly before this, so that an operator cannot be meant.
    fn nothing_before(&self) -> bool {
        use SyntaxKind as S;
        self.at.checked_sub(1).is_none_or(|before| {
            matches!(
                self.kind_of(before),
                S::OpenBrace | S::OpenParen | S::OpenBracket | S::Define | S::Comma
            )
        })
    }

    /// The `>` that seems to close a `<`.
    fn closing_angle(&self) -> Option<usize> {
        use SyntaxKind as S;
        let tokens = self.at + 1..self.at + 20;
        let mut tokens = tokens.take_while(|token| {
            matches!(self.kind_of(*token), S::Number | S::Name | S::Minus | S::Comma | S::Star | S::Greater)
        });
        tokens.find(|token| self.kind_of(*token) == S::Greater)
    }

    fn skip_angle_brackets(&mut self) {
        let end = self.closing_angle().unwrap_or(self.at);
        while self.at <= end && !self.is_end() {
            self.bump();
        }
    }

    fn plus(&self) -> Diagnostic {
        if self.follows_open_paren() {
            return self.section();
        }
        let error = Diagnostic::error(
            "missing-value",
            "nothing is before the `+`",
            self.here(),
            "expected a value before this",
        );
        error.with_suggestion(self.here(), "", "a number needs no plus sign")
    }

    fn follows_open_paren(&self) -> bool {
        self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::OpenParen)
    }

    /// `(+ 1)`
    fn section(&self) -> Diagnostic {
        let operator = self.text_of(self.at);
        let message = format!("`{operator}` needs a value on both sides");
        let error = Diagnostic::error("operator-section", message, self.here(), "nothing is before this");
        match self.kind_ahead(1) {
            SyntaxKind::CloseParen => {
                error.with_help(format!("for the function, write `(\\a b -> a {operator} b)`"))
            }
            _ => {
                let operand = self.text_of(self.at + 1);
                error.with_help(format!("for the function, write `(\\x -> x {operator} {operand})`"))
            }
        }
    }

    fn wildcard(&self) -> Diagnostic {
        let error = Diagnostic::error("missing-value", "`_` has no value", self.here(), "expected a value");
        error.with_help("`_` stands for what a pattern takes and nobody needs; give it a name to use it")
    }

    fn no_value(&self) -> Diagnostic {
        use SyntaxKind as S;
        let before = self.at.checked_sub(1);
        let before_kind = before.map_or(S::End, |before| self.kind_of(before));
        match self.current {
            _ if self.is_end() => return self.nothing_follows(before),
            S::Comma if before_kind == S::Comma => return self.doubled_comma(),
            S::Comma if before_kind.is_open() => return self.leading_comma(),
            kind if kind.is_close() && before_kind == S::Percent => return self.percent_apart(),
            S::Comma if before_kind == S::Percent => return self.percent_apart(),
            kind if is_operator(kind) && before_kind == S::OpenParen => return self.section(),
            S::Pipe => {
                let error = Diagnostic::error(
                    "missing-value",
                    "nothing is before the `|>`",
                    self.here(),
                    "expected a value before this",
                );
                return error
                    .with_help("`value |> function` passes a value on: remove what ended it before this");
            }
            kind if kind.is_keyword() && matches!(self.kind_ahead(1), S::Define | S::Comma) => {
                return self.keyword_as_name();
            }
            S::DotDot => {
                let error = Diagnostic::error(
                    "range",
                    "a range is written in brackets",
                    self.here(),
                    "not expected here",
                );
                return error.with_help("write `[0 .. 10]`");
            }
            S::Define => {
                return Diagnostic::error(
                    "missing-value",
                    "expected a value, found a second `=`",
                    self.here(),
                    "expected a value",
                );
            }
            _ => {}
        }
        let after = before.map_or(String::new(), |before| format!(" after {}", self.described(before)));
        let message = format!("expected a value{after}, found {}", self.found());
        Diagnostic::error("missing-value", message, self.here(), "expected a value before this")
    }

    /// The binding or the file is over where a value belongs.
    fn nothing_follows(&self, before: Option<usize>) -> Diagnostic {
        let Some(before) = before else {
            return Diagnostic::error(
                "missing-value",
                "expected a value",
                self.here(),
                "expected a value here",
            );
        };
        if self.kind_of(before) == SyntaxKind::Percent {
            return self.percent_apart();
        }
        let name = self.definition_name();
        let text = self.text_of(before);
        let (message, label) = match (self.kind_of(before), name) {
            (SyntaxKind::Define, Some(name)) => {
                (format!("{} has no value", quoted(name)), "expected a value after this")
            }
            _ => (format!("nothing follows the `{text}`"), "expected a value after this"),
        };
        let error = Diagnostic::error("missing-value", message, self.span_of(before), label);
        let counts = before.checked_sub(1).is_some_and(|operand| self.kind_of(operand) == SyntaxKind::Name)
            && self.tokens.get(before).is_some_and(|token| !token.spaced);
        let error = match text {
            "++" if counts => error
                .with_note("`++` joins two lists or texts; nothing can be counted up, since nothing changes"),
            _ => error,
        };
        self.with_layout(error)
    }

    /// Says so where a line that begins too far left ended the binding.
    pub(in super::super) fn with_layout(&self, error: Diagnostic) -> Diagnostic {
        let Some((name, place, line)) = self.ended_by_layout() else { return error };
        let is_next =
            super::super::brackets::begins_item(self.tokens, self.at) || self.kind_of(self.at).is_keyword();
        if is_next
            && !matches!(
                self.kind_of(self.at),
                SyntaxKind::IfKeyword
                    | SyntaxKind::LetKeyword
                    | SyntaxKind::ElseKeyword
                    | SyntaxKind::ThenKeyword
            )
        {
            return error;
        }
        let name = quoted(name);
        error
            .with_secondary(
                line,
                format!("this line begins no further right than {name}, so it is not part of it"),
            )
            .with_secondary(place, format!("{name} begins here"))
            .with_help("indent what belongs to a definition more than its name")
    }

    /// `50 %`
    fn percent_apart(&self) -> Diagnostic {
        let before = self.at.saturating_sub(1);
        let percent = self.span_of(before);
        let error = Diagnostic::error(
            "missing-value",
            "nothing follows the `%`",
            percent,
            "expected what to divide by",
        );
        let number = before.saturating_sub(1);
        if self.kind_of(number) != SyntaxKind::Number {
            return error.with_help("`a % b` is the remainder of a division");
        }
        let gap = Span::new(self.span_of(number).end, percent.start);
        error.with_suggestion(gap, "", "for per cent, write the sign directly after the digits")
    }

    fn doubled_comma(&self) -> Diagnostic {
        let error = Diagnostic::error(
            "missing-value",
            "there is nothing between two commas",
            self.here(),
            "a second comma",
        );
        error.with_suggestion(self.here(), "", "remove one")
    }

    fn leading_comma(&self) -> Diagnostic {
        let error = Diagnostic::error(
            "missing-value",
            "nothing is before the comma",
            self.here(),
            "expected a value before this",
        );
        error.with_suggestion(self.here(), "", "remove it")
    }

    /// A word of the language as a name.
    pub(in super::super) fn keyword_as_name(&self) -> Diagnostic {
        let word = self.text_of(self.at);
        let message = format!("`{word}` is a word of the language, so it cannot be a name");
        let error = Diagnostic::error("keyword-as-name", message, self.here(), "expected a name");
        error.with_suggestion(self.here(), format!("{word}_"), "take another name, such as")
    }

    /// Something that is no function in front of an argument. False where that is not meant as an argument at all.
    pub(in super::super) fn check_application(&mut self, function: Done) -> bool {
        use SyntaxKind as S;
        let what = match function.kind() {
            S::Literal => match self.kind_of(Self::token_of(function.start())) {
                S::Number => "number",
                S::Text => "text",
                S::Color => "colour",
                _ => "truth value",
            },
            S::VectorExpr => "vector",
            S::ListExpr | S::RangeExpr | S::ComprehensionExpr => "list",
            S::RecordExpr | S::UpdateExpr => "record",
            _ => return true,
        };
        let (open, at) = self.last_comma;
        if open == self.open && self.at - at <= 2 && at > 0 {
            // The commas of a list are all missing: said once.
            self.failed_at = Some(self.at);
        }
        self.fail(|parser| parser.not_a_function(what, function));
        self.last_comma = (self.open, self.at);
        let is_next_element =
            self.open > 0 && self.around == Around::Condition || self.around == Around::Test;
        !is_next_element
            || matches!(self.text_of(self.at), "deg" | "-")
            || self.text_of(self.at - 1).ends_with('%')
    }

    fn not_a_function(&self, what: &str, function: Done) -> Diagnostic {
        let gap = self.gap();
        let operand = self.text_of(self.at);
        let head = Span::new(self.span_of(Self::token_of(function.start())).start, gap.end);
        let text = self.text_of(self.at.saturating_sub(1));
        let error = |code, message: String| {
            Diagnostic::error(code, message, self.here(), "not expected here")
                .with_secondary(head, format!("a {what}"))
        };
        if what == "number" && matches!(operand, "deg" | "degrees" | "degree") {
            let span = Span::new(gap.start, self.here().end);
            let message = "the unit of an angle directly follows its digits";
            let error =
                Diagnostic::error("odd-number", message, self.here(), "expected no space before this");
            return error.with_suggestion(span, "deg", "write `deg` without a space");
        }
        if what == "number" && text.ends_with('%') {
            let percent = Span::new(gap.end - 1, gap.end);
            let message = format!("`{text}` is a percentage, and {} follows it", self.found());
            return error("tight-modulo", message).with_suggestion(
                percent,
                " %",
                "for the remainder of a division, put a space before the `%`",
            );
        }
        if let ("number", Some((span, words))) = (what, self.components_apart(function))
            && (operand != "-" || words.len() == 3)
        {
            let message = format!("{} numbers stand here without anything between them", words.len());
            let error = Diagnostic::error("missing-comma", message, span, "not one value");
            let text = "a vector is written in parentheses, with commas:";
            return error.with_suggestion(span, format!("({})", words.join(", ")), text);
        }
        if what == "number" && operand == "-" {
            let minus = self.here();
            let span = Span::new(minus.start, self.span_of(self.at + 1).start);
            let message = "this reads as two numbers, because the `-` belongs to the second";
            return error("missing-operator", message.into()).with_suggestion(
                span,
                "- ",
                "to subtract, put a space after the `-`",
            );
        }
        if self.open > 0 && matches!(operand, "step" | "by") && self.kind_ahead(1) == SyntaxKind::Number {
            let error = error("range", "the step of a range is given by its second element".into());
            return error.with_help("write `[0, 2 .. 10]`: 0, 2, 4 and so on up to 10");
        }
        if self.open > 0 && self.around == Around::Condition {
            let message = format!("missing `,` between this {what} and {}", self.found());
            return error("missing-comma", message).with_suggestion(gap, ",", "add a comma");
        }
        if self.around == Around::Test {
            let message = format!("missing `then` before {}", self.found());
            return Diagnostic::error("incomplete-if", message, self.here(), "expected `then` before this")
                .with_suggestion(gap, " then", "add `then`");
        }
        let message = format!("a {what} cannot be applied to {}", self.found());
        let error = error("not-a-function", message);
        if let ("number", Some(gap)) = (what, self.minus_apart(Self::token_of(function.start()))) {
            let error = error.with_note("a minus with a space on both sides subtracts");
            return error.with_suggestion(
                gap,
                "",
                "for a negative argument, write the minus directly before the digits:",
            );
        }
        match what {
            "number" if operand == "mod" => error.with_help("the remainder of a division is `a % b`"),
            "number" if operand == "div" => error.with_help("the whole quotient is `floor (a / b)`"),
            "number"
                if self.is(SyntaxKind::Name)
                    && self.open > 0
                    && self.around == Around::Binding
                    && matches!(
                        self.kind_ahead(1),
                        SyntaxKind::OpenParen | SyntaxKind::Number | SyntaxKind::OpenBracket
                    ) =>
            {
                error.with_help(format!("is it the next field? Then `, {operand} = ...`"))
            }
            "number" if self.is(SyntaxKind::Name) && self.kind_ahead(1) == SyntaxKind::OpenBrace => {
                error.with_help("is the number one too many, or a comma missing?")
            }
            "number" => error.with_suggestion(gap, " *", "for a product, write the `*`"),
            _ => error,
        }
    }
}

impl Parser<'_> {
    /// `1 2 3` or `0 -1 2` from the literal `function` on: two or three numbers side by side, and no more.
    fn components_apart(&self, function: Done) -> Option<(Span, Vec<String>)> {
        let first = Self::token_of(function.start());
        let (mut token, mut words) = (first, Vec::new());
        while words.len() <= 3 {
            let sign = usize::from(self.kind_of(token) == SyntaxKind::Minus && !words.is_empty());
            if self.kind_of(token + sign) != SyntaxKind::Number {
                break;
            }
            words.push(self.slice(self.span_of(token).to(self.span_of(token + sign)))?.to_owned());
            token += sign + 1;
        }
        let ends =
            !matches!(self.kind_of(token), SyntaxKind::Name | SyntaxKind::OpenParen | SyntaxKind::Color);
        let is_argument =
            first.checked_sub(1).is_some_and(|before| self.kind_of(before) != SyntaxKind::Define);
        let span = self.span_of(first).to(self.span_of(token.checked_sub(1)?));
        ((2..=3).contains(&words.len()) && ends && !is_argument).then_some((span, words))
    }

    /// The space between a minus and the number at a token, in `f 1 - 1.6 x`.
    fn minus_apart(&self, number: usize) -> Option<Span> {
        let minus = number.checked_sub(1).filter(|minus| self.kind_of(*minus) == SyntaxKind::Minus)?;
        let is_after_value = matches!(
            self.kind_of(minus.checked_sub(1)?),
            SyntaxKind::Number | SyntaxKind::Name | SyntaxKind::CloseParen | SyntaxKind::Color
        );
        let gap = Span::new(self.span_of(minus).end, self.span_of(number).start);
        (is_after_value && gap.start < gap.end).then_some(gap)
    }
}

/// Whether a token only stands between two values.
fn is_operator(kind: SyntaxKind) -> bool {
    use SyntaxKind as S;
    matches!(
        kind,
        S::Star
            | S::Slash
            | S::Percent
            | S::Caret
            | S::Append
            | S::Compose
            | S::Pipe
            | S::Equal
            | S::NotEqual
            | S::LessEqual
            | S::Greater
            | S::GreaterEqual
            | S::AndKeyword
            | S::OrKeyword
    )
}
