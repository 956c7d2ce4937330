//! The types of expressions.

use super::annotation::Variables;
use super::solve::at;
use super::{Expected, Infer, Why};
use crate::diagnostic::Span;
use crate::hry::ast::{Definition, Expr, ExprKind, Pattern, Qualifier, UnaryOperator};
use crate::hry::library::{Constructor, Makes};
use crate::hry::program::Global;
use crate::hry::types::kind::{Head, Kind};
use crate::hry::types::names::Meaning;
use crate::hry::types::scheme::{Binding, Demand};
use crate::hry::types::store::{Node, Ty};

/// What a constructor makes, as a type.
pub(in crate::hry::types) const fn made(constructor: &Constructor) -> Ty {
    match constructor.makes {
        Makes::Shape => Ty::alone(Head::Shape),
        Makes::Material => Ty::alone(Head::Material),
        Makes::Light => Ty::alone(Head::Light),
        Makes::Camera => Ty::alone(Head::Camera),
        Makes::Scene => Ty::ERROR,
    }
}

impl<'p> Infer<'p> {
    /// The type of an expression. Where one is expected, the expression is made to have it, or an error says
    /// that it has not, and the expected type is given.
    pub(super) fn expr(&mut self, expr: &'p Expr, expected: Expected<'p>) -> Ty {
        if self.exhausted {
            return Ty::ERROR;
        }
        let ty = match &expr.kind {
            ExprKind::Number(_) => self.settle(expr, Ty::NUMBER, expected),
            ExprKind::Bool(_) => self.settle(expr, Ty::BOOL, expected),
            ExprKind::Text(_) => self.settle(expr, Ty::TEXT, expected),
            ExprKind::Color(_) => self.settle(expr, Ty::COLOR, expected),
            ExprKind::Error => Ty::ERROR,
            ExprKind::If { condition, then, otherwise } => {
                self.conditional(expr, [condition, then, otherwise], expected)
            }
            ExprKind::Let { bindings, body } => self.let_in(bindings, body, expected),
            ExprKind::Match { subject, arms } => self.matching(expr, subject, arms, expected),
            ExprKind::Lambda { parameters, body } => self.lambda(expr, parameters, body, expected),
            ExprKind::List(items) => self.list(expr, items, expected),
            ExprKind::Comprehension { body, qualifiers } => {
                self.comprehension(expr, body, qualifiers, expected)
            }
            ExprKind::Binary { operator, operator_span, left, right } => {
                self.binary(expr, *operator, *operator_span, [left, right], expected)
            }
            ExprKind::Apply { .. } => self.application(expr, expected),
            _ => {
                let found = self.simple(expr);
                self.settle(expr, found, expected)
            }
        };
        self.note(expr.span, ty);
        ty
    }

    /// Expressions whose parts do not depend on what is expected.
    fn simple(&mut self, expr: &'p Expr) -> Ty {
        match &expr.kind {
            ExprKind::Name(_) => self.name(expr.span),
            ExprKind::Vector(parts) => self.vector(parts),
            ExprKind::Range { first, second, last } => {
                let bounds = [Some(&**first), second.as_deref(), Some(&**last)];
                for bound in bounds.into_iter().flatten() {
                    self.expr(bound, Some((Ty::NUMBER, Why::Bound)));
                }
                self.types.store.list(Ty::NUMBER)
            }
            ExprKind::Record(fields) => self.record(fields),
            ExprKind::Update { record, fields } => self.update(record, fields),
            ExprKind::Field { record, name } => self.field_read(expr, record, name),
            ExprKind::Unary { operator: UnaryOperator::Not, operand } => {
                let span = Span::new(expr.span.start, expr.span.start + "not".len());
                self.expr(operand, Some((Ty::BOOL, Why::Logic(span, "not"))));
                Ty::BOOL
            }
            ExprKind::Unary { operator: UnaryOperator::Negate, operand } => self.negate(expr, operand),
            ExprKind::Annotated { expression, annotation } => {
                let ty = self.written(annotation, &mut Variables::default(), 0);
                self.expr(expression, Some((ty, Why::Annotation(annotation.span))))
            }
            _ => Ty::ERROR,
        }
    }

    /// A use of a name.
    pub(super) fn name(&mut self, span: Span) -> Ty {
        match self.names.uses.get(&span.start) {
            Some(Meaning::Local(local)) => match self.locals.get(*local).cloned().flatten() {
                Some(binding) => self.bound(&binding, span),
                None => Ty::ERROR,
            },
            Some(Meaning::Global(global)) => self.global(*global, span),
            Some(Meaning::Nothing) | None => Ty::ERROR,
        }
    }

    fn bound(&mut self, binding: &Binding, span: Span) -> Ty {
        match binding {
            Binding::Mono(ty) => *ty,
            Binding::Poly(scheme) => self.instantiate(scheme, span),
        }
    }

    pub(super) fn global(&mut self, global: Global, span: Span) -> Ty {
        match global {
            Global::Definition { module, index } => {
                let binding = self.types.definitions.get(module).and_then(|m| m.get(index)).cloned();
                binding.map_or(Ty::ERROR, |binding| self.bound(&binding, span))
            }
            Global::Native(native) => {
                let scheme = self.types.natives.get(native.native as usize).cloned();
                scheme.map_or(Ty::ERROR, |scheme| self.instantiate(&scheme, span))
            }
            Global::Constructor(constructor) => {
                let record = self.fresh_of(Kind::of(&[Head::Record]));
                self.demand(Demand::Construct { record, constructor }, at(span));
                self.types.store.function(record, made(constructor))
            }
        }
    }

    fn vector(&mut self, parts: &'p [Expr]) -> Ty {
        for part in parts {
            self.expr(part, Some((Ty::NUMBER, Why::Component)));
        }
        if parts.len() == 2 { Ty::VEC2 } else { Ty::VEC3 }
    }

    fn conditional(
        &mut self,
        expr: &'p Expr,
        [condition, then, otherwise]: [&'p Expr; 3],
        expected: Expected<'p>,
    ) -> Ty {
        let word = Span::new(expr.span.start, expr.span.start + 2);
        self.expr(condition, Some((Ty::BOOL, Why::Condition(word))));
        self.constant_condition(condition);
        if let Some(expected) = self.telling(expected) {
            self.expr(then, Some(expected));
            return self.expr(otherwise, Some(expected));
        }
        let first = self.expr(then, None);
        self.expr(otherwise, Some((first, Why::Branch { first: then.span })));
        self.settle(expr, first, expected)
    }

    fn let_in(&mut self, bindings: &'p [Definition], body: &'p Expr, expected: Expected<'p>) -> Ty {
        self.bindings(bindings);
        self.expr(body, expected)
    }

    fn lambda(
        &mut self,
        expr: &'p Expr,
        parameters: &'p [Pattern],
        body: &'p Expr,
        expected: Expected<'p>,
    ) -> Ty {
        let known = expected.map(|(ty, _)| self.types.store.parameters(ty));
        let known = known.filter(|(taken, _)| taken.len() >= parameters.len());
        if let (Some(_), Some((mut ty, why))) = (known, expected) {
            for parameter in parameters {
                let Some((from, to)) = self.function_parts(ty) else { break };
                self.pattern(parameter, from, parameter.span, false);
                ty = to;
            }
            self.expr(body, Some((ty, why)));
            return expected.map_or(Ty::ERROR, |(ty, _)| ty);
        }
        let types: Vec<Ty> = parameters.iter().map(|_| self.fresh()).collect();
        for (parameter, ty) in parameters.iter().zip(&types) {
            self.pattern(parameter, *ty, parameter.span, false);
        }
        let result = self.expr(body, None);
        let found = types.iter().rev().fold(result, |to, from| self.types.store.function(*from, to));
        self.settle(expr, found, expected)
    }

    /// Parameter and result of a function type.
    pub(super) fn function_parts(&self, ty: Ty) -> Option<(Ty, Ty)> {
        match self.types.store.get(ty) {
            Node::Function(from, to) => Some((*from, *to)),
            _ => None,
        }
    }

    /// The type of the elements that are expected of a list, where that says something.
    fn expected_item(&self, expected: Expected<'p>) -> Expected<'p> {
        let (ty, why) = expected?;
        match self.types.store.get(ty) {
            Node::List(of) => self.telling(Some((*of, why))),
            _ => None,
        }
    }

    fn list(&mut self, expr: &'p Expr, items: &'p [Expr], expected: Expected<'p>) -> Ty {
        if let (Some(item), Some((ty, _))) = (self.expected_item(expected), expected) {
            for element in items {
                self.expr(element, Some(item));
            }
            return ty;
        }
        let item = match items.split_first() {
            None => self.fresh(),
            Some((first, others)) => {
                let item = self.expr(first, None);
                for other in others {
                    self.expr(other, Some((item, Why::Item { first: first.span })));
                }
                item
            }
        };
        let list = self.types.store.list(item);
        self.settle(expr, list, expected)
    }

    fn comprehension(
        &mut self,
        expr: &'p Expr,
        body: &'p Expr,
        qualifiers: &'p [Qualifier],
        expected: Expected<'p>,
    ) -> Ty {
        for qualifier in qualifiers {
            match qualifier {
                Qualifier::Generator { pattern, list } => {
                    let item = self.fresh();
                    let items = self.types.store.list(item);
                    self.expr(list, Some((items, Why::Generator(pattern.span))));
                    self.pattern(pattern, item, list.span, false);
                }
                Qualifier::Guard(guard) => {
                    self.expr(guard, Some((Ty::BOOL, Why::Guard)));
                }
                Qualifier::Let(bindings) => self.bindings(bindings),
            }
        }
        if let (Some(item), Some((ty, _))) = (self.expected_item(expected), expected) {
            self.expr(body, Some(item));
            return ty;
        }
        let item = self.expr(body, None);
        let list = self.types.store.list(item);
        self.settle(expr, list, expected)
    }
}
