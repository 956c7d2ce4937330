//! Arithmetic on values that are known or depend on a hit.

use super::compile::internal;
use super::failure::{Failure, Outcome};
use super::machine::Machine;
use super::value::{FunctionKind, FunctionValue, HitValue, Kind, RecordValue, Scalar, Symbolic, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::BinaryOperator;
use hray_expr::{Binary, Builder, GraphTooLarge, NodeId, Unary};
use std::sync::Arc;

/// A value as its kind and its components, where it is made of numbers.
pub(super) fn parts(value: &Value) -> Option<(Kind, [Scalar; 3])> {
    let zero = Scalar::Known(0.0);
    let known = Scalar::Known;
    Some(match value {
        Value::Number(n) => (Kind::Number, [known(*n), zero, zero]),
        Value::Bool(b) => (Kind::Bool, [known(f64::from(u8::from(*b))), zero, zero]),
        Value::Vec2([x, y]) => (Kind::Vec2, [known(*x), known(*y), zero]),
        Value::Vec3(v) => (Kind::Vec3, v.map(known)),
        Value::Color(c) => (Kind::Color, c.map(known)),
        Value::Symbolic(symbolic) => (symbolic.kind, symbolic.parts),
        _ => return None,
    })
}

/// The value of that kind with these components.
pub(super) fn assemble(kind: Kind, parts: [Scalar; 3]) -> Value {
    let known = |scalar: Scalar| match scalar {
        Scalar::Known(value) => Some(value),
        Scalar::Node(_) => None,
    };
    let whole = match kind {
        Kind::Number => known(parts[0]).map(Value::Number),
        Kind::Bool => known(parts[0]).map(|b| Value::Bool(b != 0.0)),
        Kind::Vec2 => known(parts[0]).zip(known(parts[1])).map(|(x, y)| Value::Vec2([x, y])),
        Kind::Vec3 | Kind::Color => {
            let [x, y, z] = parts.map(known);
            x.zip(y).zip(z).map(|((x, y), z)| {
                if kind == Kind::Color { Value::Color([x, y, z]) } else { Value::Vec3([x, y, z]) }
            })
        }
    };
    whole.unwrap_or_else(|| Value::Symbolic(Arc::new(Symbolic { kind, parts })))
}

impl Machine<'_> {
    /// Does something with the graph that is being built.
    pub(super) fn build<T>(
        &mut self,
        span: Span,
        make: impl FnOnce(&mut Builder) -> Result<T, GraphTooLarge>,
    ) -> Outcome<T> {
        let Some(graph) = &mut self.graph else {
            return Err(internal(span, "something depends on a hit outside of a function of a hit").into());
        };
        make(graph).map_err(|error| {
            Failure::new(
                Diagnostic::error(
                    "function-too-large",
                    format!("this function of a hit takes more than {} operations", error.budget),
                    span,
                    "the budget is used up here",
                )
                .with_help("do less for each hit; or raise the budget with `--eval-nodes`"),
            )
        })
    }

    pub(super) fn node(&mut self, scalar: Scalar, span: Span) -> Outcome<NodeId> {
        match scalar {
            Scalar::Node(node) => Ok(node),
            Scalar::Known(value) => self.build(span, |graph| graph.constant(value)),
        }
    }

    /// A scalar from a node: known where the graph found it to be constant.
    pub(super) fn scalar(&self, node: NodeId) -> Scalar {
        let known = self.graph.as_ref().and_then(|graph| graph.as_constant(node));
        known.map_or(Scalar::Node(node), Scalar::Known)
    }

    pub(super) fn unary(&mut self, f: Unary, a: Scalar, span: Span) -> Outcome<Scalar> {
        match a {
            Scalar::Known(a) => Ok(Scalar::Known(f.apply(a))),
            Scalar::Node(a) => {
                let node = self.build(span, |graph| graph.unary(f, a))?;
                Ok(self.scalar(node))
            }
        }
    }

    pub(super) fn binary(&mut self, f: Binary, a: Scalar, b: Scalar, span: Span) -> Outcome<Scalar> {
        if let (Scalar::Known(a), Scalar::Known(b)) = (a, b) {
            return Ok(Scalar::Known(f.apply(a, b)));
        }
        let (a, b) = (self.node(a, span)?, self.node(b, span)?);
        let node = self.build(span, |graph| graph.binary(f, a, b))?;
        Ok(self.scalar(node))
    }

    pub(super) fn select(&mut self, condition: Scalar, a: Scalar, b: Scalar, span: Span) -> Outcome<Scalar> {
        let condition = match condition {
            Scalar::Known(c) => return Ok(if c != 0.0 { a } else { b }),
            Scalar::Node(condition) => condition,
        };
        let (a, b) = (self.node(a, span)?, self.node(b, span)?);
        let node = self.build(span, |graph| graph.select(condition, a, b))?;
        Ok(self.scalar(node))
    }

    /// A power. The square and the cube are products, so that they cost what they should wherever they stand.
    fn power(&mut self, a: Scalar, b: Scalar, span: Span) -> Outcome<Scalar> {
        match b {
            Scalar::Known(1.0) => Ok(a),
            Scalar::Known(2.0) => self.binary(Binary::Mul, a, a, span),
            Scalar::Known(3.0) => {
                let square = self.binary(Binary::Mul, a, a, span)?;
                self.binary(Binary::Mul, square, a, span)
            }
            _ => self.binary(Binary::Pow, a, b, span),
        }
    }

    fn scalar_arithmetic(&mut self, f: BinaryOperator, a: Scalar, b: Scalar, span: Span) -> Outcome<Scalar> {
        let f = match f {
            BinaryOperator::Add => Binary::Add,
            BinaryOperator::Subtract => Binary::Sub,
            BinaryOperator::Multiply => Binary::Mul,
            BinaryOperator::Divide => Binary::Div,
            BinaryOperator::Modulo => Binary::Modulo,
            BinaryOperator::Power => return self.power(a, b, span),
            _ => return Err(internal(span, "an operator that does not compute").into()),
        };
        self.binary(f, a, b, span)
    }

    /// `a + b` and its like. Of a number and something larger, the number applies to every component.
    pub(super) fn arithmetic(
        &mut self,
        f: BinaryOperator,
        a: &Value,
        b: &Value,
        span: Span,
    ) -> Outcome<Value> {
        if let (Value::Number(a), Value::Number(b)) = (a, b) {
            let simple = match f {
                BinaryOperator::Add => Some(a + b),
                BinaryOperator::Subtract => Some(a - b),
                BinaryOperator::Multiply => Some(a * b),
                BinaryOperator::Divide => Some(a / b),
                _ => None,
            };
            if let Some(result) = simple {
                return Ok(Value::Number(result));
            }
        }
        let (Some((kind_a, parts_a)), Some((kind_b, parts_b))) = (parts(a), parts(b)) else {
            return Err(
                internal(span, &format!("{} and {} in arithmetic", a.describe(), b.describe())).into()
            );
        };
        let kind = if kind_a == Kind::Number { kind_b } else { kind_a };
        let mut result = [Scalar::Known(0.0); 3];
        for (i, result) in result.iter_mut().enumerate().take(kind.len()) {
            let a = parts_a[if kind_a == Kind::Number { 0 } else { i }];
            let b = parts_b[if kind_b == Kind::Number { 0 } else { i }];
            *result = self.scalar_arithmetic(f, a, b, span)?;
        }
        Ok(assemble(kind, result))
    }

    /// Applies a function of one number to every component.
    pub(super) fn each(&mut self, f: Unary, a: &Value, span: Span) -> Outcome<Value> {
        if let Value::Number(a) = a {
            return Ok(Value::Number(f.apply(*a)));
        }
        let Some((kind, mut components)) = parts(a) else {
            return Err(internal(span, &format!("{} in arithmetic", a.describe())).into());
        };
        for component in components.iter_mut().take(kind.len()) {
            *component = self.unary(f, *component, span)?;
        }
        Ok(assemble(kind, components))
    }

    /// Applies a function of two numbers to every pair of components.
    pub(super) fn each_pair(&mut self, f: Binary, a: &Value, b: &Value, span: Span) -> Outcome<Value> {
        let (Some((kind_a, parts_a)), Some((kind_b, parts_b))) = (parts(a), parts(b)) else {
            return Err(
                internal(span, &format!("{} and {} in arithmetic", a.describe(), b.describe())).into()
            );
        };
        let kind = if kind_a == Kind::Number { kind_b } else { kind_a };
        let mut result = [Scalar::Known(0.0); 3];
        for (i, result) in result.iter_mut().enumerate().take(kind.len()) {
            let a = parts_a[if kind_a == Kind::Number { 0 } else { i }];
            let b = parts_b[if kind_b == Kind::Number { 0 } else { i }];
            *result = self.binary(f, a, b, span)?;
        }
        Ok(assemble(kind, result))
    }

    /// `a < b` and its like, on numbers.
    pub(super) fn comparison(
        &mut self,
        f: BinaryOperator,
        a: &Value,
        b: &Value,
        span: Span,
    ) -> Outcome<Value> {
        let (Some((_, [a, ..])), Some((_, [b, ..]))) = (parts(a), parts(b)) else {
            return Err(internal(span, "a comparison of something else than numbers").into());
        };
        let truth = match f {
            BinaryOperator::Less => self.binary(Binary::Less, a, b, span)?,
            BinaryOperator::LessEqual => self.binary(Binary::LessEqual, a, b, span)?,
            BinaryOperator::Greater => self.binary(Binary::Less, b, a, span)?,
            _ => self.binary(Binary::LessEqual, b, a, span)?,
        };
        Ok(assemble(Kind::Bool, [truth; 3]))
    }

    /// Whether two values of one type are equal: 1, 0, or a node.
    pub(super) fn equal(&mut self, a: &Value, b: &Value, span: Span) -> Outcome<Scalar> {
        if let (Some((kind, a)), Some((_, b))) = (parts(a), parts(b)) {
            let mut all = Scalar::Known(1.0);
            for (a, b) in a.into_iter().zip(b).take(kind.len()) {
                let equal = self.binary(Binary::Equal, a, b, span)?;
                all = self.both(all, equal, span)?;
            }
            return Ok(all);
        }
        let pairs: Vec<(&Value, &Value)> = match (a, b) {
            (Value::Text(a), Value::Text(b)) => return Ok(truth(a.text == b.text)),
            (Value::Integrator(a), Value::Integrator(b)) => return Ok(truth(a == b)),
            (Value::Encoding(a), Value::Encoding(b)) => return Ok(truth(a == b)),
            (Value::List(a), Value::List(b)) if a.items.len() != b.items.len() => return Ok(truth(false)),
            (Value::List(a), Value::List(b)) => a.items.iter().zip(&b.items).collect(),
            (Value::Record(a), Value::Record(b)) => {
                let other = |name| b.get(name);
                a.names
                    .iter()
                    .zip(&a.values)
                    .filter_map(|(name, value)| Some((value, other(*name)?)))
                    .collect()
            }
            _ => {
                let message = format!("{} cannot be compared", a.describe());
                return Err(Failure::new(Diagnostic::error(
                    "not-comparable",
                    message,
                    span,
                    "compared here",
                )));
            }
        };
        let mut all = Scalar::Known(1.0);
        for (a, b) in pairs {
            self.step(span)?;
            let equal = self.equal(a, b, span)?;
            all = self.both(all, equal, span)?;
            if matches!(all, Scalar::Known(0.0)) {
                break;
            }
        }
        Ok(all)
    }

    /// Whether both are true.
    pub(super) fn both(&mut self, a: Scalar, b: Scalar, span: Span) -> Outcome<Scalar> {
        match (a, b) {
            (Scalar::Known(0.0), _) | (_, Scalar::Known(0.0)) => Ok(Scalar::Known(0.0)),
            (Scalar::Known(_), other) | (other, Scalar::Known(_)) => Ok(other),
            _ => self.binary(Binary::And, a, b, span),
        }
    }

    /// One value or the other, depending on the hit.
    pub(super) fn merge(&mut self, condition: Scalar, a: &Value, b: &Value, span: Span) -> Outcome<Value> {
        if let (Some((kind, a)), Some((_, b))) = (parts(a), parts(b)) {
            let mut merged = [Scalar::Known(0.0); 3];
            for (i, merged) in merged.iter_mut().enumerate().take(kind.len()) {
                *merged = self.select(condition, a[i], b[i], span)?;
            }
            return Ok(assemble(kind, merged));
        }
        match (a, b) {
            (Value::Record(a), Value::Record(b)) => {
                let mut values = Vec::with_capacity(a.values.len());
                for (name, value) in a.names.iter().zip(&a.values) {
                    let other = b.get(*name).ok_or_else(|| internal(span, "records of different types"))?;
                    values.push(self.merge(condition, value, other, span)?);
                }
                Ok(Value::Record(Arc::new(RecordValue { names: a.names.clone(), values })))
            }
            (Value::List(a), Value::List(b)) if a.items.len() == b.items.len() => {
                let pairs = a.items.iter().zip(&b.items);
                let items = pairs.map(|(a, b)| self.merge(condition, a, b, span)).collect::<Outcome<_>>()?;
                self.list(items, span)
            }
            (Value::Function(_), Value::Function(_)) => {
                let kind = FunctionKind::Select(condition, a.clone(), b.clone());
                self.function(kind, a.nesting().max(b.nesting()) + 1, span)
            }
            (Value::Hit(a), Value::Hit(b)) => {
                let (a, b) = (**a, **b);
                let mut three = |a: [Scalar; 3], b: [Scalar; 3]| -> Outcome<[Scalar; 3]> {
                    Ok([
                        self.select(condition, a[0], b[0], span)?,
                        self.select(condition, a[1], b[1], span)?,
                        self.select(condition, a[2], b[2], span)?,
                    ])
                };
                let p = three(a.p, b.p)?;
                let world = three(a.world, b.world)?;
                let normal = three(a.normal, b.normal)?;
                let [u, v, time] = three([a.uv[0], a.uv[1], a.time], [b.uv[0], b.uv[1], b.time])?;
                Ok(Value::Hit(Arc::new(HitValue { p, world, normal, uv: [u, v], time })))
            }
            (Value::Text(x), Value::Text(y)) if x.text == y.text => Ok(a.clone()),
            (Value::Image(x), Value::Image(y)) if Arc::ptr_eq(x, y) => Ok(a.clone()),
            _ => {
                let what = match (a, b) {
                    (Value::List(_), _) => "the length of a list",
                    (Value::Text(_), _) => "a text",
                    _ => "which of two values this is",
                };
                let message = format!("{what} would depend on the hit");
                let help = "only numbers, truth values, vectors, colours, and records, lists and functions of these can \
                            depend on a hit";
                Err(Failure::new(
                    Diagnostic::error("depends-on-hit", message, span, "the condition depends on the hit")
                        .with_help(help),
                ))
            }
        }
    }

    /// A function value, where functions do not nest too deeply.
    pub(super) fn function(&self, kind: FunctionKind, nesting: u32, span: Span) -> Outcome<Value> {
        const DEEPEST: u32 = 1000;
        if nesting > DEEPEST {
            let message = format!("more than {DEEPEST} functions are put one into the other");
            return Err(Failure::new(
                Diagnostic::error("nested-too-deeply", message, span, "one too many here").with_help(
                    "keep the values that the functions are made of in a list, and fold over it when called",
                ),
            ));
        }
        Ok(Value::Function(Arc::new(FunctionValue { kind, nesting })))
    }
}

pub(super) fn truth(value: bool) -> Scalar {
    Scalar::Known(f64::from(u8::from(value)))
}
