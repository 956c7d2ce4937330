//! Lists, records, vectors and matches over several lines.

use super::source::Part;
use super::writer::{Lead, Writer};
use crate::hry::syntax::SyntaxKind;

impl Writer<'_, '_> {
    /// An element a line, each with a comma after it, up to the closing bracket.
    fn elements(&mut self, parts: &[Part], indent: usize) {
        self.elements_at(parts, indent, indent + 2, false);
    }

    /// The same at a column; the first may be behind what is on the line already.
    fn elements_at(&mut self, parts: &[Part], indent: usize, inside: usize, is_behind: bool) {
        let outer = std::mem::replace(&mut self.continuation, inside + 2);
        let mut is_first = true;
        for (number, part) in parts.iter().enumerate() {
            match part {
                Part::Node(element) => {
                    let is_apart = !is_behind || self.source.has_comments(self.source.first_token(*element));
                    self.lead = match is_first {
                        true if is_apart => Lead::line(inside),
                        true => Lead::Flat,
                        false => Lead::item(inside),
                    };
                    is_first = false;
                    self.element(*element, inside);
                    let comma = match parts.get(number + 1) {
                        Some(Part::Token(comma)) if self.source.kind(*comma) == SyntaxKind::Comma => {
                            Some(*comma)
                        }
                        _ => None,
                    };
                    self.comma(comma);
                }
                Part::Token(token) if self.source.kind(*token) != SyntaxKind::Comma => {
                    self.lead = Lead::closing(indent, inside);
                    self.token(*token);
                }
                Part::Token(_) => {}
            }
        }
        self.continuation = outer;
    }

    fn element(&mut self, element: u32, indent: usize) {
        match self.source.kind_of(element) {
            SyntaxKind::FieldValue => self.field_value(element, indent),
            SyntaxKind::MatchArm => self.arm(element, indent),
            kind if kind.is_expr() => self.expr(element, indent, 1),
            _ => self.generic(element, indent),
        }
    }

    /// `name = value`
    fn field_value(&mut self, field: u32, indent: usize) {
        let node = self.source.node(field);
        if self.fits(node.first_token, node.end_token, 1) {
            return self.tokens(node.first_token, node.end_token);
        }
        self.token(node.first_token);
        if node.first_token + 1 < node.end_token {
            self.token(node.first_token + 1);
        }
        if let Some(value) = self.source.children(field).first() {
            self.body(*value, indent, 1);
        }
    }

    /// `pattern -> body`
    fn arm(&mut self, arm: u32, indent: usize) {
        let node = self.source.node(arm);
        if self.fits(node.first_token, node.end_token, 1) {
            return self.tokens(node.first_token, node.end_token);
        }
        let parts = self.source.parts(arm);
        let Some((Part::Node(body), head)) = parts.split_last() else { return };
        for part in head {
            match part {
                Part::Token(token) => self.token(*token),
                Part::Node(pattern) => self.generic(*pattern, indent),
            }
        }
        self.body(*body, indent, 1);
    }

    /// `[a, b]`, `{ a = 1 }`, `(x, y)`
    pub(super) fn broken_list(&mut self, node: u32, indent: usize) {
        let parts = self.source.parts(node);
        if let Some((Part::Token(open), rest)) = parts.split_first() {
            self.token(*open);
            self.elements(rest, indent);
        }
    }

    /// `{ record`, `| a = 1,`, `}`: the fields below each other, the first of them behind the bar.
    pub(super) fn broken_update(&mut self, node: u32, indent: usize) {
        let parts = self.source.parts(node);
        let [Part::Token(open), Part::Node(record), Part::Token(bar), rest @ ..] = parts.as_slice() else {
            return;
        };
        self.token(*open);
        self.expr(*record, indent + 2, 0);
        self.lead = Lead::line(indent + 2);
        self.token(*bar);
        self.elements_at(rest, indent, indent + 4, true);
    }

    /// `match subject { arms }`
    pub(super) fn broken_match(&mut self, node: u32, indent: usize) {
        let parts = self.source.parts(node);
        let [Part::Token(word), Part::Node(subject), Part::Token(open), rest @ ..] = parts.as_slice() else {
            return;
        };
        self.token(*word);
        self.expr(*subject, indent, 2);
        self.token(*open);
        self.elements(rest, indent);
    }

    /// `[ body`, `| qualifiers`, `]`, all three in one column.
    pub(super) fn broken_comprehension(&mut self, node: u32) {
        let parts = self.source.parts(node);
        let [Part::Token(open), Part::Node(body), Part::Token(bar), qualifiers @ .., Part::Token(close)] =
            parts.as_slice()
        else {
            return;
        };
        self.token(*open);
        let column = self.column_of(*open);
        let outer = std::mem::replace(&mut self.continuation, column + 2);
        self.pad();
        self.expr(*body, column + 2, 0);
        self.lead = Lead::closing(column, column + 2);
        self.token(*bar);
        self.qualifiers(qualifiers, bar + 1, *close, column + 2);
        self.lead = Lead::closing(column, column + 2);
        self.token(*close);
        self.continuation = outer;
    }

    fn qualifiers(&mut self, qualifiers: &[Part], first: u32, close: u32, indent: usize) {
        // The comments of a last comma come after the line.
        let end = close - u32::from(self.source.is_last_comma(close - 1));
        if self.fits(first, end, 0) {
            return self.tokens(first, close);
        }
        let mut is_first = true;
        for (number, part) in qualifiers.iter().enumerate() {
            match part {
                Part::Node(qualifier) => {
                    if !is_first {
                        self.lead = Lead::line(indent);
                    }
                    is_first = false;
                    let is_last = number + 2 > qualifiers.len();
                    self.qualifier(*qualifier, indent, usize::from(!is_last));
                }
                Part::Token(comma) if self.source.is_last_comma(*comma) => self.tokens(*comma, comma + 1),
                Part::Token(comma) => self.comma(Some(*comma)),
            }
        }
    }

    fn qualifier(&mut self, qualifier: u32, indent: usize, rest: usize) {
        let node = self.source.node(qualifier);
        if self.fits(node.first_token, node.end_token, rest) {
            return self.tokens(node.first_token, node.end_token);
        }
        let parts = self.source.parts(qualifier);
        match self.source.kind_of(qualifier) {
            SyntaxKind::LetQualifier => {
                self.token(node.first_token);
                let column = self.column_of(node.first_token) + 4;
                self.bindings(&self.source.children(qualifier), column);
            }
            SyntaxKind::Generator => {
                let Some((Part::Node(list), head)) = parts.split_last() else { return };
                for part in head {
                    match part {
                        Part::Token(token) => self.token(*token),
                        Part::Node(pattern) => self.generic(*pattern, indent),
                    }
                }
                self.body(*list, indent, rest);
            }
            _ => {
                for child in self.source.children(qualifier) {
                    self.expr(child, indent, rest);
                }
            }
        }
    }
}
