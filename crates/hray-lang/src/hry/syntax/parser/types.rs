//! Types as they are written.

use super::super::kind::SyntaxKind;
use super::{Parser, Set};

impl Parser<'_> {
    /// A type.
    pub(super) fn type_expr(&mut self) {
        let start = self.mark();
        if self.nested(Self::arrows).is_none() {
            self.node(SyntaxKind::ErrorType, start);
        }
    }

    /// `a -> b -> c`
    fn arrows(&mut self) {
        let chain = self.chain;
        let mut starts = Vec::new();
        loop {
            let start = self.mark();
            self.type_operand();
            if !self.is(SyntaxKind::Arrow) {
                break;
            }
            self.bump();
            starts.push(start);
            self.chain += 1;
            if self.chain >= super::LONGEST_CHAIN {
                self.too_deep();
                self.skip_until(Set::of(&[SyntaxKind::Comma]));
                self.node(SyntaxKind::ErrorType, self.mark());
                break;
            }
        }
        for start in starts.into_iter().rev() {
            self.node(SyntaxKind::FunctionType, start);
        }
        self.chain = chain;
    }

    fn type_operand(&mut self) {
        let start = self.mark();
        let kind = match self.current {
            SyntaxKind::Name | SyntaxKind::TypeName => {
                self.bump();
                SyntaxKind::NameType
            }
            SyntaxKind::OpenBracket => {
                let outer = self.open();
                self.type_expr();
                self.close_type(SyntaxKind::CloseBracket);
                self.close(SyntaxKind::CloseBracket, outer);
                SyntaxKind::ListType
            }
            SyntaxKind::OpenParen => {
                let outer = self.open();
                self.type_expr();
                self.close_type(SyntaxKind::CloseParen);
                self.close(SyntaxKind::CloseParen, outer);
                SyntaxKind::ParenType
            }
            SyntaxKind::OpenBrace => {
                let outer = self.open();
                self.elements(SyntaxKind::CloseBrace, Self::field_type);
                self.close(SyntaxKind::CloseBrace, outer);
                SyntaxKind::RecordType
            }
            _ => {
                self.fail(Self::no_type);
                SyntaxKind::ErrorType
            }
        };
        self.node(kind, start);
    }

    fn close_type(&mut self, closing: SyntaxKind) {
        if !self.is(closing) {
            self.fail(Self::after_type);
        }
    }

    fn field_type(&mut self) {
        let start = self.mark();
        if !self.field_label() {
            self.skip_until(Set::of(&[SyntaxKind::Comma]));
            return;
        }
        if self.is(SyntaxKind::Colon) {
            self.bump();
        } else {
            self.fail(Self::no_field_type);
            self.eat(SyntaxKind::Define);
        }
        self.type_expr();
        self.node(SyntaxKind::FieldType, start);
    }
}
