//! Expressions.

use super::Lower;
use super::literal;
use crate::diagnostic::Span;
use crate::hry::ast::{BinaryOperator, Expr, ExprKind, FieldValue, Pattern, Qualifier, UnaryOperator};
use crate::hry::syntax::kind::SyntaxKind;
use crate::hry::syntax::tree::children_reversed;
use std::sync::Arc;

impl Lower<'_> {
    /// What is not there.
    pub(super) fn missing(&self, node: u32) -> Expr {
        Expr { kind: ExprKind::Error, span: Span::at(self.span(node).end) }
    }

    pub(super) fn expr(&mut self, node: u32) -> Expr {
        let kind = self.expr_kind(node);
        Expr { kind: kind.unwrap_or(ExprKind::Error), span: self.span(node) }
    }

    /// None where something is missing.
    fn expr_kind(&mut self, node: u32) -> Option<ExprKind> {
        let here = self.node(node);
        Some(match here.kind {
            SyntaxKind::Literal => self.literal(here.first_token),
            SyntaxKind::NameExpr => ExprKind::Name(self.shared(self.token_text(here.first_token))),
            SyntaxKind::ParenExpr => self.inner(node)?,
            SyntaxKind::AnnotatedExpr => self.annotated(node)?,
            SyntaxKind::VectorExpr => ExprKind::Vector(self.exprs(node)),
            SyntaxKind::ListExpr => ExprKind::List(self.exprs(node)),
            SyntaxKind::RangeExpr => self.range(node)?,
            SyntaxKind::ComprehensionExpr => self.comprehension(node)?,
            SyntaxKind::RecordExpr => ExprKind::Record(self.fields(node)),
            SyntaxKind::UpdateExpr => {
                let record = Box::new(self.first_expr(node)?);
                ExprKind::Update { record, fields: self.fields(node) }
            }
            SyntaxKind::FieldExpr => {
                let record = Box::new(self.first_expr(node)?);
                ExprKind::Field { record, name: self.name(here.end_token.checked_sub(1)?) }
            }
            SyntaxKind::ApplyExpr => {
                let (function, argument) = self.two(node)?;
                ExprKind::Apply { function, argument }
            }
            SyntaxKind::UnaryExpr => {
                let operator = match self.token_kind(here.first_token) {
                    SyntaxKind::Minus => UnaryOperator::Negate,
                    _ => UnaryOperator::Not,
                };
                ExprKind::Unary { operator, operand: Box::new(self.first_expr(node)?) }
            }
            SyntaxKind::BinaryExpr => self.binary(node)?,
            SyntaxKind::IfExpr => self.if_then_else(node)?,
            SyntaxKind::LetExpr => {
                let children = self.children(node);
                let bindings = self.definitions(&children);
                let body = children.last().copied().filter(|last| self.kind(*last).is_expr())?;
                ExprKind::Let { bindings, body: Box::new(self.expr(body)) }
            }
            SyntaxKind::LambdaExpr => {
                let (parameters, body) = self.patterns_and_body(node);
                ExprKind::Lambda { parameters, body: Box::new(body?) }
            }
            SyntaxKind::MatchExpr => self.match_arms(node)?,
            _ => return None,
        })
    }

    fn literal(&self, token: u32) -> ExprKind {
        let text = self.token_text(token);
        match self.token_kind(token) {
            SyntaxKind::Number => ExprKind::Number(literal::number(text)),
            SyntaxKind::Color => ExprKind::Color(literal::color(text)),
            SyntaxKind::Text => ExprKind::Text(Arc::from(literal::text(text))),
            kind => ExprKind::Bool(kind == SyntaxKind::TrueKeyword),
        }
    }

    /// What is in parentheses.
    fn inner(&mut self, node: u32) -> Option<ExprKind> {
        Some(self.first_expr(node)?.kind)
    }

    fn first_expr(&mut self, node: u32) -> Option<Expr> {
        let mut first = None;
        for child in children_reversed(self.nodes, node) {
            first = Some(child);
        }
        let first = first.filter(|child| self.kind(*child).is_expr())?;
        Some(self.expr(first))
    }

    fn exprs(&mut self, node: u32) -> Vec<Expr> {
        let children = self.children(node);
        let mut exprs = Vec::with_capacity(children.len());
        for child in children {
            if self.kind(child).is_expr() {
                exprs.push(self.expr(child));
            }
        }
        exprs
    }

    fn two(&mut self, node: u32) -> Option<(Box<Expr>, Box<Expr>)> {
        let mut children = children_reversed(self.nodes, node);
        let (second, first) = (children.next()?, children.next()?);
        let first = Box::new(self.expr(first));
        Some((first, Box::new(self.expr(second))))
    }

    fn binary(&mut self, node: u32) -> Option<ExprKind> {
        let left = children_reversed(self.nodes, node).nth(1)?;
        let token = self.node(left).end_token;
        let operator = binary_operator(self.token_kind(token))?;
        let operator_span = self.token_span(token);
        let (left, right) = self.two(node)?;
        Some(ExprKind::Binary { operator, operator_span, left, right })
    }

    fn if_then_else(&mut self, node: u32) -> Option<ExprKind> {
        let [condition, then, otherwise] = self.children(node).try_into().ok()?;
        Some(ExprKind::If {
            condition: Box::new(self.expr(condition)),
            then: Box::new(self.expr(then)),
            otherwise: Box::new(self.expr(otherwise)),
        })
    }

    fn annotated(&mut self, node: u32) -> Option<ExprKind> {
        let children = self.children(node);
        let annotation = children.into_iter().find(|child| self.kind(*child).is_type())?;
        let expression = Box::new(self.first_expr(node)?);
        Some(ExprKind::Annotated { expression, annotation: self.type_expr(annotation) })
    }

    fn range(&mut self, node: u32) -> Option<ExprKind> {
        let mut exprs = self.exprs(node).into_iter().map(Box::new);
        let (first, next, last) = (exprs.next()?, exprs.next()?, exprs.next());
        Some(match last {
            Some(last) => ExprKind::Range { first, second: Some(next), last },
            None => ExprKind::Range { first, second: None, last: next },
        })
    }

    fn comprehension(&mut self, node: u32) -> Option<ExprKind> {
        let body = Box::new(self.first_expr(node)?);
        let mut qualifiers = Vec::new();
        for child in self.children(node) {
            qualifiers.extend(self.qualifier(child));
        }
        Some(ExprKind::Comprehension { body, qualifiers })
    }

    fn qualifier(&mut self, node: u32) -> Option<Qualifier> {
        Some(match self.kind(node) {
            SyntaxKind::Generator => {
                let (patterns, list) = self.patterns_and_body(node);
                let pattern = patterns.into_iter().next()?;
                Qualifier::Generator { pattern, list: list? }
            }
            SyntaxKind::Guard => Qualifier::Guard(self.first_expr(node)?),
            SyntaxKind::LetQualifier => {
                let children = self.children(node);
                Qualifier::Let(self.definitions(&children))
            }
            _ => return None,
        })
    }

    fn fields(&mut self, node: u32) -> Vec<FieldValue> {
        let children = self.children(node);
        let mut fields = Vec::with_capacity(children.len());
        for child in children {
            if self.kind(child) == SyntaxKind::FieldValue {
                let name = self.name(self.node(child).first_token);
                let value = self.first_expr(child);
                let short = || Expr { kind: ExprKind::Name(name.text.clone()), span: name.span };
                let value = value.unwrap_or_else(short);
                fields.push(FieldValue { name, value });
            }
        }
        fields
    }

    fn match_arms(&mut self, node: u32) -> Option<ExprKind> {
        let subject = Box::new(self.first_expr(node)?);
        let mut arms = Vec::new();
        for child in self.children(node) {
            if self.kind(child) == SyntaxKind::MatchArm {
                let (patterns, body) = self.patterns_and_body(child);
                arms.extend(patterns.into_iter().next().zip(body));
            }
        }
        Some(ExprKind::Match { subject, arms })
    }

    /// The patterns of a node, and the expression after them.
    fn patterns_and_body(&mut self, node: u32) -> (Vec<Pattern>, Option<Expr>) {
        let (mut patterns, mut body) = (Vec::new(), None);
        for child in self.children(node) {
            let kind = self.kind(child);
            if kind.is_pattern() {
                patterns.push(self.pattern(child));
            } else if kind.is_expr() && body.is_none() {
                body = Some(self.expr(child));
            }
        }
        (patterns, body)
    }
}

fn binary_operator(kind: SyntaxKind) -> Option<BinaryOperator> {
    Some(match kind {
        SyntaxKind::Pipe => BinaryOperator::Pipe,
        SyntaxKind::Compose => BinaryOperator::Compose,
        SyntaxKind::OrKeyword => BinaryOperator::Or,
        SyntaxKind::AndKeyword => BinaryOperator::And,
        SyntaxKind::Equal | SyntaxKind::Define => BinaryOperator::Equal,
        SyntaxKind::NotEqual => BinaryOperator::NotEqual,
        SyntaxKind::Less => BinaryOperator::Less,
        SyntaxKind::LessEqual => BinaryOperator::LessEqual,
        SyntaxKind::Greater => BinaryOperator::Greater,
        SyntaxKind::GreaterEqual => BinaryOperator::GreaterEqual,
        SyntaxKind::Append => BinaryOperator::Append,
        SyntaxKind::Plus => BinaryOperator::Add,
        SyntaxKind::Minus => BinaryOperator::Subtract,
        SyntaxKind::Star => BinaryOperator::Multiply,
        SyntaxKind::Slash => BinaryOperator::Divide,
        SyntaxKind::Percent => BinaryOperator::Modulo,
        SyntaxKind::Caret => BinaryOperator::Power,
        _ => return None,
    })
}
