//! Patterns.

use super::super::kind::SyntaxKind;
use super::{Mark, Parser, Set};

impl Parser<'_> {
    /// Whether the current token begins a pattern.
    pub(super) fn begins_pattern(&self) -> bool {
        matches!(
            self.current,
            SyntaxKind::Name
                | SyntaxKind::Underscore
                | SyntaxKind::Number
                | SyntaxKind::Minus
                | SyntaxKind::Text
                | SyntaxKind::TrueKeyword
                | SyntaxKind::FalseKeyword
                | SyntaxKind::TypeName
                | SyntaxKind::OpenParen
                | SyntaxKind::OpenBracket
                | SyntaxKind::OpenBrace
        )
    }

    /// A pattern; `may_fail` where it may be one that does not take every value.
    pub(super) fn pattern(&mut self, may_fail: bool) {
        let start = self.mark();
        let read = self.nested(|parser| parser.pattern_here(may_fail));
        if read.is_none() {
            self.node(SyntaxKind::ErrorPattern, start);
        }
    }

    fn pattern_here(&mut self, may_fail: bool) {
        let (start, first) = (self.mark(), self.at);
        let kind = match self.current {
            SyntaxKind::Name => {
                self.bump();
                SyntaxKind::NamePattern
            }
            SyntaxKind::Underscore => {
                self.bump();
                SyntaxKind::WildcardPattern
            }
            SyntaxKind::Minus if self.kind_ahead(1) == SyntaxKind::Number => {
                self.bump();
                self.bump();
                self.literal_pattern(first, may_fail)
            }
            SyntaxKind::Number | SyntaxKind::Text | SyntaxKind::TrueKeyword | SyntaxKind::FalseKeyword => {
                self.bump();
                self.literal_pattern(first, may_fail)
            }
            SyntaxKind::OpenParen => self.vector_pattern(may_fail),
            SyntaxKind::OpenBracket => {
                let kind = self.list_pattern();
                if !may_fail {
                    self.may_fail(first, "a list pattern takes lists of some lengths only");
                }
                kind
            }
            SyntaxKind::OpenBrace => self.record_pattern(may_fail),
            _ => self.no_pattern(),
        };
        self.node(kind, start);
    }

    fn literal_pattern(&mut self, first: usize, may_fail: bool) -> SyntaxKind {
        if !may_fail {
            self.may_fail(first, "this takes one value only");
        }
        SyntaxKind::LiteralPattern
    }

    /// `(pattern)`, `(x, y)`, `(x, y, z)`
    fn vector_pattern(&mut self, may_fail: bool) -> SyntaxKind {
        let first = self.at;
        let outer = self.open();
        let mut count = 0;
        if self.is(SyntaxKind::CloseParen) {
            self.empty_parentheses(first);
        }
        self.elements(SyntaxKind::CloseParen, |parser| {
            parser.pattern(may_fail);
            count += 1;
        });
        self.close(SyntaxKind::CloseParen, outer);
        match count {
            1 => SyntaxKind::ParenPattern,
            2 | 3 => SyntaxKind::VectorPattern,
            0 => SyntaxKind::ErrorPattern,
            _ => {
                self.too_many_components(first, count);
                SyntaxKind::ErrorPattern
            }
        }
    }

    /// `[a, b]`, `[a, ..rest]`
    fn list_pattern(&mut self) -> SyntaxKind {
        let outer = self.open();
        let mut has_rest = false;
        self.elements(SyntaxKind::CloseBracket, |parser| {
            if has_rest {
                parser.fail(Self::after_rest);
            }
            if parser.is(SyntaxKind::DotDot) {
                let start = parser.mark();
                parser.bump();
                parser.eat(SyntaxKind::Name);
                parser.node(SyntaxKind::RestPattern, start);
                has_rest = true;
            } else {
                parser.pattern(true);
                if parser.is(SyntaxKind::DotDot) {
                    parser.missing_comma_before_rest();
                    let start = parser.mark();
                    parser.bump();
                    parser.eat(SyntaxKind::Name);
                    parser.node(SyntaxKind::RestPattern, start);
                    has_rest = true;
                }
            }
        });
        self.close(SyntaxKind::CloseBracket, outer);
        SyntaxKind::ListPattern
    }

    /// `{ a, b = pattern }`
    fn record_pattern(&mut self, may_fail: bool) -> SyntaxKind {
        let outer = self.open();
        self.elements(SyntaxKind::CloseBrace, |parser| parser.field_pattern(may_fail));
        self.close(SyntaxKind::CloseBrace, outer);
        SyntaxKind::RecordPattern
    }

    fn field_pattern(&mut self, may_fail: bool) {
        let start: Mark = self.mark();
        if !self.field_label() {
            self.skip_until(Set::of(&[SyntaxKind::Comma]));
            return;
        }
        if self.defines_field() {
            self.bump();
            self.pattern(may_fail);
        }
        self.node(SyntaxKind::FieldPattern, start);
    }
}
