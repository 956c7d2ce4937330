//! Operators.

use super::{Expected, Infer, Origin, Why};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{BinaryOperator as B, Expr, ExprKind};
use crate::hry::types::kind::{Head, Kind};
use crate::hry::types::scheme::Demand;
use crate::hry::types::store::{Node, Ty};

/// An operator as it is written.
pub(in crate::hry::types) const fn written(operator: B) -> &'static str {
    match operator {
        B::Pipe => "|>",
        B::Compose => ">>",
        B::Or => "or",
        B::And => "and",
        B::Equal => "==",
        B::NotEqual => "!=",
        B::Less => "<",
        B::LessEqual => "<=",
        B::Greater => ">",
        B::GreaterEqual => ">=",
        B::Append => "++",
        B::Add => "+",
        B::Subtract => "-",
        B::Multiply => "*",
        B::Divide => "/",
        B::Modulo => "%",
        B::Power => "^",
    }
}

impl<'p> Infer<'p> {
    pub(super) fn binary(
        &mut self,
        expr: &'p Expr,
        operator: B,
        span: Span,
        sides: [&'p Expr; 2],
        expected: Expected<'p>,
    ) -> Ty {
        match operator {
            B::Pipe => self.pipe(expr, sides, expected),
            B::Append => self.append(expr, span, sides, expected),
            _ => {
                let found = self.plain_binary(operator, span, sides);
                self.settle(expr, found, expected)
            }
        }
    }

    fn plain_binary(&mut self, operator: B, span: Span, [left, right]: [&'p Expr; 2]) -> Ty {
        match operator {
            B::And | B::Or => {
                for side in [left, right] {
                    self.expr(side, Some((Ty::BOOL, Why::Logic(span, written(operator)))));
                }
                Ty::BOOL
            }
            B::Less | B::LessEqual | B::Greater | B::GreaterEqual => {
                let errors = self.errors;
                let expected = Some((Ty::NUMBER, Why::Order(span, operator)));
                self.expr(left, expected);
                self.expr(right, if self.errors > errors { None } else { expected });
                Ty::BOOL
            }
            B::Equal | B::NotEqual => self.compare(operator, span, left, right),
            B::Compose => self.compose(span, left, right),
            B::Power => self.power(span, left, right),
            _ => self.calculate(operator, span, left, right),
        }
    }

    fn calculate(&mut self, operator: B, span: Span, left: &'p Expr, right: &'p Expr) -> Ty {
        let (l, r) = (self.expr(left, None), self.expr(right, None));
        if matches!(operator, B::Divide | B::Modulo) {
            self.division_by_zero(operator, span, right);
        }
        let store = &self.types.store;
        if store.head(l) == Some(Head::Number) && store.head(r) == Some(Head::Number) {
            return Ty::NUMBER;
        }
        let result = self.fresh_of(Kind::NUMERIC);
        let demand = Demand::Arithmetic { operator, left: l, right: r, result };
        let origin = Origin { span: left.span.to(right.span), via: None, detail: span };
        // Tried here first: while the operands are at hand, an error can say more.
        match self.decide(&demand, origin) {
            Ok(true) => {}
            Ok(false) => self.demand(demand, origin),
            Err(_) => {
                let error = self.operands(operator, span, (left, l), (right, r));
                self.report(error);
                let _ = self.unify(result, Ty::ERROR);
            }
        }
        self.solve();
        result
    }

    fn power(&mut self, span: Span, base: &'p Expr, exponent: &'p Expr) -> Ty {
        let ty = self.expr(base, None);
        if self.narrow(ty, Kind::NUMERIC).is_err() {
            let error = self.not_numeric("^", span, base, ty);
            self.report(error);
            self.expr(exponent, None);
            return Ty::ERROR;
        }
        self.expr(exponent, Some((Ty::NUMBER, Why::Exponent(span))));
        ty
    }

    pub(super) fn negate(&mut self, expr: &'p Expr, operand: &'p Expr) -> Ty {
        let ty = self.expr(operand, None);
        if self.narrow(ty, Kind::NUMERIC).is_err() {
            let sign = Span::new(expr.span.start, expr.span.start + 1);
            let error = self.not_numeric("-", sign, operand, ty);
            self.report(error);
            return Ty::ERROR;
        }
        ty
    }

    fn compare(&mut self, operator: B, span: Span, left: &'p Expr, right: &'p Expr) -> Ty {
        let (l, r) = (self.expr(left, None), self.expr(right, None));
        if self.unify(r, l).is_err() {
            let error = self.not_same(operator, span, (left, l), (right, r));
            self.report(error);
        } else if self.narrow(l, Kind::EQUATABLE).is_err() {
            let error = self.not_comparable(operator, span, left, l);
            self.report(error);
        }
        Ty::BOOL
    }

    fn compose(&mut self, span: Span, left: &'p Expr, right: &'p Expr) -> Ty {
        let (l, r) = (self.expr(left, None), self.expr(right, None));
        let mut parts = [Ty::ERROR; 4];
        for (i, (side, ty)) in [(left, l), (right, r)].into_iter().enumerate() {
            let (from, to) = (self.fresh(), self.fresh());
            let function = self.types.store.function(from, to);
            if self.unify(ty, function).is_err() {
                let error = self.not_a_function_beside(">>", span, side, ty);
                self.report(error);
                return Ty::ERROR;
            }
            if let Some(pair) = parts.get_mut(2 * i..2 * i + 2) {
                pair.copy_from_slice(&[from, to]);
            }
        }
        let [from, between, taken, to] = parts;
        if self.unify(between, taken).is_err() {
            let error = self.not_composed(span, (left, between), (right, taken));
            self.report(error);
        }
        self.types.store.function(from, to)
    }

    /// `x |> f a` is `f a x`.
    fn pipe(&mut self, expr: &'p Expr, [value, function]: [&'p Expr; 2], expected: Expected<'p>) -> Ty {
        let (callee, mut arguments) = crate::hry::program::application(function);
        if matches!(function.kind, ExprKind::Apply { .. } | ExprKind::Name(_)) {
            arguments.push(value);
            return self.call(expr, callee, &arguments, expected);
        }
        self.call(expr, function, &[value], expected)
    }

    fn append(
        &mut self,
        expr: &'p Expr,
        span: Span,
        [left, right]: [&'p Expr; 2],
        expected: Expected<'p>,
    ) -> Ty {
        let known = expected.filter(|(ty, _)| {
            matches!(self.types.store.get(*ty), Node::List(_))
                || self.types.store.head(*ty) == Some(Head::Text)
        });
        if let Some((ty, why)) = known {
            self.expr(left, Some((ty, why)));
            self.expr(right, Some((ty, why)));
            return ty;
        }
        let first = self.expr(left, None);
        if self.narrow(first, Kind::APPENDABLE).is_err() {
            let error = self.not_appendable(span, left, first);
            self.report(error);
            self.expr(right, None);
            return Ty::ERROR;
        }
        self.expr(right, Some((first, Why::Append { left: left.span })));
        self.settle(expr, first, expected)
    }

    fn division_by_zero(&mut self, operator: B, span: Span, right: &Expr) {
        if matches!(right.kind, ExprKind::Number(0.0)) {
            let message = if operator == B::Divide {
                "this divides by 0"
            } else {
                "this is the rest of a division by 0"
            };
            let warning =
                Diagnostic::warning("division-by-zero", message, span.to(right.span), "gives no number");
            self.report(
                warning.with_help("a surface with such a value is black or white, or not there at all"),
            );
        }
    }

    pub(super) fn constant_condition(&mut self, condition: &Expr) {
        if let ExprKind::Bool(value) = condition.kind {
            let branch = if value { "else" } else { "then" };
            let message = format!("this condition is always {value}");
            let warning =
                Diagnostic::warning("constant-condition", message, condition.span, "always the same");
            self.report(warning.with_help(format!("what follows `{branch}` is never used")));
        }
    }
}
