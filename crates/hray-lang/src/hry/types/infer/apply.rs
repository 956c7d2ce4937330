//! Functions and their arguments.

use super::{Expected, Infer, Why};
use crate::hry::ast::{Expr, ExprKind};
use crate::hry::library::Constructor;
use crate::hry::program::{Global, application};
use crate::hry::types::names::Meaning;
use crate::hry::types::store::{Node, Ty};

impl<'p> Infer<'p> {
    /// `f a b`
    pub(super) fn application(&mut self, expr: &'p Expr, expected: Expected<'p>) -> Ty {
        let (callee, arguments) = application(expr);
        self.call(expr, callee, &arguments, expected)
    }

    pub(super) fn call(
        &mut self,
        expr: &'p Expr,
        callee: &'p Expr,
        arguments: &[&'p Expr],
        expected: Expected<'p>,
    ) -> Ty {
        let found = match self.constructor_of(callee) {
            Some(constructor) => self.constructor_call(expr, constructor, callee, arguments),
            None => self.function_call(callee, arguments),
        };
        self.settle(expr, found, expected)
    }

    /// The constructor that a name means.
    pub(super) fn constructor_of(&self, callee: &Expr) -> Option<&'static Constructor> {
        match (&callee.kind, self.names.uses.get(&callee.span.start)) {
            (ExprKind::Name(_), Some(Meaning::Global(Global::Constructor(constructor)))) => Some(constructor),
            _ => None,
        }
    }

    fn function_call(&mut self, callee: &'p Expr, arguments: &[&'p Expr]) -> Ty {
        let whole = self.expr(callee, None);
        let mut ty = whole;
        for (index, argument) in arguments.iter().enumerate() {
            let Some((from, to)) = self.taken(ty) else {
                if !self.types.store.is_error(ty) {
                    let error = self.not_a_function(callee, whole, arguments, index);
                    self.report(error);
                }
                for rest in arguments.iter().skip(index) {
                    self.expr(rest, None);
                }
                return Ty::ERROR;
            };
            if index == 0 && self.is_call_with_commas(whole, from, argument) {
                let error = self.call_with_commas(callee, whole, argument);
                self.report(error);
                for rest in arguments {
                    self.expr(rest, None);
                }
                return Ty::ERROR;
            }
            self.expr(argument, Some((from, Why::Argument { callee, index, whole })));
            ty = to;
        }
        ty
    }

    /// What a function takes and gives. What is not known yet becomes a function.
    fn taken(&mut self, ty: Ty) -> Option<(Ty, Ty)> {
        if let Node::Function(from, to) = self.types.store.get(ty) {
            return Some((*from, *to));
        }
        if !self.types.store.is_variable(ty) {
            return None;
        }
        let (from, to) = (self.fresh(), self.fresh());
        let function = self.types.store.function(from, to);
        self.unify(ty, function).ok().map(|()| (from, to))
    }

    /// Whether `f (a, b)` surely meant `f a b`: a vector is not what `f` takes, but its components may be.
    fn is_call_with_commas(&self, whole: Ty, from: Ty, argument: &Expr) -> bool {
        let ExprKind::Vector(parts) = &argument.kind else { return false };
        let vector = if parts.len() == 2 { Ty::VEC2 } else { Ty::VEC3 };
        let (Some(taken), Some(given)) = (self.types.store.head(from), self.types.store.head(vector)) else {
            let heads = self.types.store.heads(from);
            let given = self.types.store.head(vector);
            return given.is_some_and(|given| !heads.has(given));
        };
        taken != given && self.types.store.parameters(whole).0.len() >= parts.len()
    }
}
