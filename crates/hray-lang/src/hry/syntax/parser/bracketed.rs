//! Expressions in brackets: parentheses, vectors, lists, records.

use super::super::kind::SyntaxKind;
use super::{Around, Done, Mark, Parser, Set};

impl Parser<'_> {
    /// Elements separated by commas up to a closing bracket; a comma may follow the last.
    pub(super) fn elements(&mut self, closing: SyntaxKind, mut element: impl FnMut(&mut Self)) {
        let mut is_known = false;
        while !self.is(closing) && !self.is_end() {
            let before = self.at;
            element(self);
            if self.is(closing) || self.is_end() {
                return;
            }
            if self.is(SyntaxKind::Comma) {
                self.bump();
                continue;
            }
            if self.separator(closing, &mut is_known) && self.at > before {
                continue;
            }
            self.skip_until(Set::of(&[SyntaxKind::Comma]));
            if !self.eat(SyntaxKind::Comma) && self.at == before {
                return;
            }
        }
    }

    /// `(expression)`, `(x, y)`, `(x, y, z)`, `(expression : type)`
    pub(super) fn parenthesised(&mut self) -> Done {
        let (start, first) = (self.mark(), self.at);
        if self.is_lambda_of_others() {
            return self.lambda_of_others();
        }
        if self.holds_fields() {
            return self.record_in_parentheses(start, first);
        }
        let outer = self.open();
        let (mut count, mut height) = (0, 0);
        let mut kind = SyntaxKind::ParenExpr;
        if self.is(SyntaxKind::CloseParen) {
            self.empty_parentheses(first);
        }
        self.elements(SyntaxKind::CloseParen, |parser| {
            let done = parser.inside(Around::Condition, Self::expr);
            (count, height) = (count + 1, height.max(done.height));
            if parser.is(SyntaxKind::Colon) && count == 1 {
                parser.bump();
                parser.type_expr();
                kind = SyntaxKind::AnnotatedExpr;
            }
        });
        let has_comma = self.at.checked_sub(1).is_some_and(|last| self.kind_of(last) == SyntaxKind::Comma);
        self.close(SyntaxKind::CloseParen, outer);
        let kind = match count {
            1 if has_comma => self.one_component(first),
            1 => kind,
            2 | 3 => SyntaxKind::VectorExpr,
            0 => SyntaxKind::ErrorExpr,
            _ => self.too_many_components(first, count),
        };
        self.expr_node(kind, start, height)
    }

    /// Whether the parentheses here hold `name = value`, after the name of what takes it.
    fn holds_fields(&self) -> bool {
        use SyntaxKind as S;
        let is_after_name = self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == S::Name);
        let is_field = match self.kind_ahead(2) {
            S::Define => true,
            S::Colon => matches!(self.kind_ahead(3), S::Number | S::Text | S::Color | S::Minus),
            _ => false,
        };
        is_after_name && is_field && self.kind_ahead(1) == S::Name && self.around != Around::Test
    }

    /// `sphere (radius = 1)`, read as if it had braces.
    fn record_in_parentheses(&mut self, start: Mark, first: usize) -> Done {
        let outer = self.open();
        let mut height = 0;
        self.elements(SyntaxKind::CloseParen, |parser| height = height.max(parser.field()));
        self.close(SyntaxKind::CloseParen, outer);
        self.fields_in_parentheses(first);
        self.expr_node(SyntaxKind::RecordExpr, start, height)
    }

    /// Whether `(a, b) =>` or `(a, b) ->` begins here.
    fn is_lambda_of_others(&self) -> bool {
        use SyntaxKind as S;
        let mut token = self.at + 1;
        while self.kind_of(token) == S::Name {
            token += 1;
            if self.kind_of(token) == S::Comma {
                token += 1;
            }
        }
        let is_parameters = token > self.at + 1 && self.kind_of(token) == S::CloseParen;
        is_parameters && self.around != Around::Arm && self.kind_of(token + 1) == S::Arrow
    }

    /// `(a, b) => body`, read as the function that it is.
    fn lambda_of_others(&mut self) -> Done {
        let (start, first) = (self.mark(), self.at);
        let outer = self.open();
        while !self.is(SyntaxKind::CloseParen) && !self.is_end() {
            if self.is(SyntaxKind::Name) {
                self.pattern(false);
            } else {
                self.bump();
            }
        }
        self.close(SyntaxKind::CloseParen, outer);
        self.parameters_in_parentheses(first);
        self.eat(SyntaxKind::Arrow);
        let body = self.expr();
        self.expr_node(SyntaxKind::LambdaExpr, start, body.height)
    }

    pub(in super::super) fn kind_of(&self, token: usize) -> SyntaxKind {
        self.tokens.get(token).map_or(SyntaxKind::End, |token| token.kind)
    }

    /// `[a, b]`, `[first .. last]`, `[first, second .. last]`, `[body | qualifiers]`
    pub(super) fn list(&mut self) -> Done {
        let start = self.mark();
        let outer = self.open();
        let (mut count, mut height) = (0_usize, 0);
        let mut kind = SyntaxKind::ListExpr;
        self.elements(SyntaxKind::CloseBracket, |parser| {
            if parser.is(SyntaxKind::DotDot) {
                parser.range_without_start(count);
            } else {
                height = height.max(parser.inside(Around::Condition, Self::expr).height);
                count += 1;
            }
            if parser.is(SyntaxKind::DotDot) && kind == SyntaxKind::ListExpr {
                kind = parser.range_end(count, &mut height);
            } else if parser.is_for_of_python() && kind == SyntaxKind::ListExpr {
                parser.for_of_python();
                kind = parser.qualifiers(count, &mut height);
            } else if parser.is(SyntaxKind::Bar) && kind == SyntaxKind::ListExpr {
                kind = parser.qualifiers(count, &mut height);
            }
        });
        self.close(SyntaxKind::CloseBracket, outer);
        self.expr_node(kind, start, height)
    }

    /// Whether `for name in` begins here.
    pub(super) fn is_for_of_python(&self) -> bool {
        self.is(SyntaxKind::Name)
            && self.text_of(self.at) == "for"
            && self.kind_ahead(1) == SyntaxKind::Name
            && self.kind_ahead(2) == SyntaxKind::InKeyword
    }

    /// `.. last]` after one or two elements.
    fn range_end(&mut self, count: usize, height: &mut u32) -> SyntaxKind {
        if count > 2 {
            self.long_range();
        }
        self.bump();
        if self.is(SyntaxKind::CloseBracket) {
            self.endless_range();
            return SyntaxKind::ErrorExpr;
        }
        *height = (*height).max(self.inside(Around::Condition, Self::expr).height);
        if !self.is(SyntaxKind::CloseBracket) {
            self.fail(Self::after_range);
            self.skip_until(Set::of(&[]));
        }
        if count > 2 { SyntaxKind::ErrorExpr } else { SyntaxKind::RangeExpr }
    }

    /// `{ a = 1, b }`, `{ record | a = 1 }`
    pub(super) fn record(&mut self) -> Done {
        let start = self.mark();
        if self.is_povray_here() {
            self.fail(|parser| parser.povray(parser.at - 1));
            let is_quiet = std::mem::replace(&mut self.is_quiet, true);
            let outer = self.open();
            self.skip_until(Set::of(&[]));
            self.close(SyntaxKind::CloseBrace, outer);
            self.is_quiet = is_quiet;
            return self.error_expr(start);
        }
        let outer = self.open();
        let mut height = 0;
        let mut kind = SyntaxKind::RecordExpr;
        if self.begins_update() {
            height = self.inside(Around::Binding, Self::expr).height;
            kind = SyntaxKind::UpdateExpr;
            if self.is(SyntaxKind::Bar) {
                self.bump();
                if self.is(SyntaxKind::CloseBrace) {
                    self.fail(Self::no_fields);
                }
            } else {
                self.fail_at_record(start);
                kind = SyntaxKind::ErrorExpr;
            }
        }
        self.elements(SyntaxKind::CloseBrace, |parser| height = height.max(parser.field()));
        self.close(SyntaxKind::CloseBrace, outer);
        self.expr_node(kind, start, height)
    }

    /// Whether what is in braces begins with the record that is to be changed.
    fn begins_update(&self) -> bool {
        match self.current {
            SyntaxKind::CloseBrace | SyntaxKind::End | SyntaxKind::Comma => false,
            SyntaxKind::Name | SyntaxKind::TypeName | SyntaxKind::Text => !matches!(
                self.kind_ahead(1),
                SyntaxKind::Define
                    | SyntaxKind::Comma
                    | SyntaxKind::CloseBrace
                    | SyntaxKind::Colon
                    | SyntaxKind::Semicolon
                    | SyntaxKind::Equal
            ),
            kind => !kind.is_keyword() || self.kind_ahead(1) != SyntaxKind::Define,
        }
    }

    /// `name = value` or `name`; how deep it is.
    fn field(&mut self) -> u32 {
        let start = self.mark();
        if !self.field_label() {
            self.skip_until(Set::of(&[SyntaxKind::Comma]));
            return 0;
        }
        let mut height = 1;
        if self.defines_field() {
            self.bump();
            height += self.inside(Around::Binding, Self::expr).height;
        } else if self.begins_value() {
            self.fail(Self::missing_equals);
            height += self.inside(Around::Binding, Self::expr).height;
        }
        self.node(SyntaxKind::FieldValue, start);
        height
    }

    fn fail_at_record(&mut self, start: Mark) {
        self.fail(|parser| parser.not_a_record(start));
        self.is_quiet |=
            self.errors.last().is_some_and(|error| matches!(error.code, "braces" | "fields-without-names"));
        self.skip_until(Set::of(&[SyntaxKind::Comma]));
        self.eat(SyntaxKind::Comma);
    }

    /// Makes an error node of everything since `start`.
    pub(super) fn error_since(&mut self, start: Mark) {
        if self.mark().token > start.token {
            self.node(SyntaxKind::ErrorExpr, start);
        }
    }
}
