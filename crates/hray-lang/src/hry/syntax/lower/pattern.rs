//! Patterns and types.

use super::{Lower, literal};
use crate::hry::ast::{Name, Pattern, PatternKind, TypeExpr, TypeExprKind};
use crate::hry::syntax::kind::SyntaxKind;
use std::sync::Arc;

impl Lower<'_> {
    pub(super) fn pattern(&mut self, node: u32) -> Pattern {
        let kind = self.pattern_kind(node).unwrap_or(PatternKind::Error);
        Pattern { kind, span: self.span(node) }
    }

    fn pattern_kind(&mut self, node: u32) -> Option<PatternKind> {
        let here = self.node(node);
        Some(match here.kind {
            SyntaxKind::NamePattern => PatternKind::Name(self.shared(self.token_text(here.first_token))),
            SyntaxKind::WildcardPattern => PatternKind::Wildcard,
            SyntaxKind::LiteralPattern => self.literal_pattern(here.first_token),
            SyntaxKind::ParenPattern => {
                let inner = *self.children(node).first()?;
                self.pattern(inner).kind
            }
            SyntaxKind::VectorPattern => PatternKind::Vector(self.patterns(node)),
            SyntaxKind::ListPattern => {
                PatternKind::List { items: self.patterns(node), rest: self.rest(node) }
            }
            SyntaxKind::RecordPattern => PatternKind::Record(self.field_patterns(node)),
            _ => return None,
        })
    }

    fn literal_pattern(&self, token: u32) -> PatternKind {
        let text = self.token_text(token);
        match self.token_kind(token) {
            SyntaxKind::Minus => PatternKind::Number(-literal::number(self.token_text(token + 1))),
            SyntaxKind::Number => PatternKind::Number(literal::number(text)),
            SyntaxKind::Text => PatternKind::Text(Arc::from(literal::text(text))),
            kind => PatternKind::Bool(kind == SyntaxKind::TrueKeyword),
        }
    }

    fn patterns(&mut self, node: u32) -> Vec<Pattern> {
        let children = self.children(node).into_iter();
        let patterns: Vec<u32> = children
            .filter(|child| self.kind(*child).is_pattern() && self.kind(*child) != SyntaxKind::RestPattern)
            .collect();
        patterns.into_iter().map(|child| self.pattern(child)).collect()
    }

    fn rest(&mut self, node: u32) -> Option<Option<Name>> {
        let rest =
            self.children(node).into_iter().find(|child| self.kind(*child) == SyntaxKind::RestPattern)?;
        let here = self.node(rest);
        let has_name = here.end_token > here.first_token + 1;
        Some(has_name.then(|| self.name(here.first_token + 1)))
    }

    fn field_patterns(&mut self, node: u32) -> Vec<(Name, Pattern)> {
        let mut fields = Vec::new();
        for child in self.children(node) {
            if self.kind(child) == SyntaxKind::FieldPattern {
                let name = self.name(self.node(child).first_token);
                let pattern = match self.children(child).first() {
                    Some(pattern) => self.pattern(*pattern),
                    None => Pattern { kind: PatternKind::Name(name.text.clone()), span: name.span },
                };
                fields.push((name, pattern));
            }
        }
        fields
    }

    pub(super) fn type_expr(&mut self, node: u32) -> TypeExpr {
        let kind = self.type_kind(node).unwrap_or(TypeExprKind::Error);
        TypeExpr { kind, span: self.span(node) }
    }

    fn type_kind(&mut self, node: u32) -> Option<TypeExprKind> {
        let here = self.node(node);
        let children = self.children(node);
        let first = children.first().copied();
        Some(match here.kind {
            SyntaxKind::NameType => TypeExprKind::Name(self.shared(self.token_text(here.first_token))),
            SyntaxKind::ListType => TypeExprKind::List(Box::new(self.type_expr(first?))),
            SyntaxKind::FunctionType => {
                let from = Box::new(self.type_expr(first?));
                TypeExprKind::Function(from, Box::new(self.type_expr(*children.get(1)?)))
            }
            SyntaxKind::RecordType => {
                let mut fields = Vec::new();
                for child in children {
                    if self.kind(child) == SyntaxKind::FieldType {
                        let name = self.name(self.node(child).first_token);
                        let of = self.children(child).first().copied()?;
                        fields.push((name, self.type_expr(of)));
                    }
                }
                TypeExprKind::Record(fields)
            }
            SyntaxKind::ParenType => self.type_expr(first?).kind,
            _ => return None,
        })
    }
}
