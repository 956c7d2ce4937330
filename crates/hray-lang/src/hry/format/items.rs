//! Files, definitions, annotations and imports.

use super::source::Part;
use super::writer::{Lead, Writer};
use crate::hry::syntax::SyntaxKind;

impl Writer<'_, '_> {
    pub(super) fn file(&mut self) {
        for item in self.source.children(self.source.root()) {
            self.lead = Lead::item(0);
            self.continuation = 2;
            self.item(item, 0);
        }
    }

    /// A binding that begins at column `indent`.
    pub(super) fn item(&mut self, item: u32, indent: usize) {
        let outer = std::mem::replace(&mut self.continuation, indent + 2);
        match self.source.kind_of(item) {
            SyntaxKind::Import => self.import(item),
            SyntaxKind::Annotation => self.annotation(item, indent),
            _ => self.definition(item, indent),
        }
        self.continuation = outer;
    }

    fn import(&mut self, item: u32) {
        let node = self.source.node(item);
        if self.fits(node.first_token, node.end_token, 0) {
            return self.tokens(node.first_token, node.end_token);
        }
        for token in node.first_token..node.end_token {
            match self.source.kind(token) {
                SyntaxKind::Comma => self.comma(Some(token)),
                SyntaxKind::CloseParen => {
                    if self.source.kind(token - 1) == SyntaxKind::Name {
                        self.comma(None);
                    }
                    self.lead = Lead::closing(0, 2);
                    self.token(token);
                }
                SyntaxKind::Name if self.source.kind(node.first_token + 2) == SyntaxKind::OpenParen => {
                    self.lead = Lead::line(2);
                    self.token(token);
                }
                _ => self.token(token),
            }
        }
    }

    /// `name : type`
    fn annotation(&mut self, item: u32, indent: usize) {
        let node = self.source.node(item);
        if self.fits(node.first_token, node.end_token, 0) {
            return self.tokens(node.first_token, node.end_token);
        }
        let mut parts = self.source.parts(item);
        let of = parts.pop();
        for part in parts {
            self.part(part, indent);
        }
        self.lead = Lead::line(indent + 2);
        if let Some(Part::Node(of)) = of {
            self.arrows(of, indent + 2);
        }
    }

    /// A function type, an arrow a line.
    fn arrows(&mut self, mut of: u32, indent: usize) {
        while self.source.kind_of(of) == SyntaxKind::FunctionType {
            let parts = self.source.parts(of);
            let [Part::Node(from), Part::Token(arrow), Part::Node(to)] = parts.as_slice() else { break };
            self.generic(*from, indent);
            self.lead = Lead::line(indent);
            self.token(*arrow);
            of = *to;
        }
        self.generic(of, indent);
    }

    /// `name parameters = body`
    fn definition(&mut self, item: u32, indent: usize) {
        let parts = self.source.parts(item);
        let Some((Part::Node(body), head)) = parts.split_last() else { return };
        for part in head {
            self.part(*part, indent);
        }
        self.body(*body, indent, 0);
    }

    /// The parts of a node in order, on one line as far as may be.
    pub(super) fn generic(&mut self, node: u32, indent: usize) {
        for part in self.source.parts(node) {
            self.part(part, indent);
        }
    }

    fn part(&mut self, part: Part, indent: usize) {
        match part {
            Part::Token(token) if self.source.is_last_comma(token) => self.tokens(token, token + 1),
            Part::Token(token) => self.token(token),
            Part::Node(node) if self.source.kind_of(node).is_expr() => self.expr(node, indent, 1),
            Part::Node(node) => self.generic(node, indent),
        }
    }
}
