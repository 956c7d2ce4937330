//! The part of a comprehension after its bar.

use super::super::brackets::leads_to;
use super::super::kind::SyntaxKind;
use super::{Around, Parser};

impl Parser<'_> {
    /// `| qualifiers` after the body.
    pub(super) fn qualifiers(&mut self, count: usize, height: &mut u32) -> SyntaxKind {
        if count > 1 {
            self.long_body();
        }
        self.bump();
        if self.is(SyntaxKind::CloseBracket) {
            self.fail(Self::no_qualifiers);
            return SyntaxKind::ErrorExpr;
        }
        self.elements(SyntaxKind::CloseBracket, |parser| *height = (*height).max(parser.qualifier()));
        if count > 1 { SyntaxKind::ErrorExpr } else { SyntaxKind::ComprehensionExpr }
    }

    /// `pattern <- list`, `let bindings`, or a condition; how deep it is.
    fn qualifier(&mut self) -> u32 {
        let start = self.mark();
        if self.is(SyntaxKind::LetKeyword) {
            return self.let_qualifier();
        }
        if self.is_for_of_python() {
            self.for_of_python();
            self.bump();
        }
        let is_first = self.at.checked_sub(1).is_some_and(|before| self.kind_of(before) == SyntaxKind::Bar);
        if is_first && self.is(SyntaxKind::Name) && self.kind_ahead(1) == SyntaxKind::Define {
            self.pattern(false);
            self.define_for_from();
            self.bump();
            let list = self.inside(Around::Condition, Self::expr);
            self.node(SyntaxKind::Generator, start);
            return list.height + 1;
        }
        if self.kind_ahead(1) == SyntaxKind::InKeyword && self.is(SyntaxKind::Name) {
            self.pattern(false);
            self.in_for_from();
            self.bump();
            let list = self.inside(Around::Condition, Self::expr);
            self.node(SyntaxKind::Generator, start);
            return list.height + 1;
        }
        if leads_to(self.tokens, self.at, SyntaxKind::From, false).is_some() {
            self.pattern(false);
            if !self.is(SyntaxKind::From) {
                self.fail(Self::no_generator);
            }
            self.eat(SyntaxKind::From);
            let (first, begin) = (self.at, self.mark());
            let mut list = self.inside(Around::Condition, Self::expr);
            if self.is(SyntaxKind::DotDot) {
                self.bump();
                self.inside(Around::Condition, Self::expr);
                self.bare_range(first);
                list = self.error_expr(begin);
            }
            self.node(SyntaxKind::Generator, start);
            return list.height + 1;
        }
        let guard = self.inside(Around::Condition, Self::expr);
        if self.is(SyntaxKind::InKeyword) {
            self.in_for_from();
            self.bump();
            self.inside(Around::Condition, Self::expr);
            self.error_expr(start);
        }
        self.node(SyntaxKind::Guard, start);
        guard.height + 1
    }

    /// `let bindings`, with `in` it is a condition after all.
    fn let_qualifier(&mut self) -> u32 {
        let start = self.mark();
        self.bump();
        let height = self.let_bindings();
        if !self.is(SyntaxKind::InKeyword) {
            self.node(SyntaxKind::LetQualifier, start);
            return height + 1;
        }
        self.bump();
        let body = self.inside(Around::Condition, Self::expr);
        let guard = self.expr_node(SyntaxKind::LetExpr, start, height.max(body.height));
        self.node(SyntaxKind::Guard, start);
        guard.height + 1
    }
}
