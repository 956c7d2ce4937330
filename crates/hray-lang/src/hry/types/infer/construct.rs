//! Constructors and their records.

use super::expr::made;
use super::solve::{Allowed, at};
use super::{Infer, Why};
use crate::diagnostic::Span;
use crate::hry::ast::{Expr, ExprKind, FieldValue};
use crate::hry::library::{Constructor, FieldSpec, FieldType};
use crate::hry::types::scheme::Demand;
use crate::hry::types::store::{Node, Ty};
use std::collections::HashMap;
use std::sync::Arc;

impl<'p> Infer<'p> {
    /// `sphere { radius = 1 }`
    pub(super) fn constructor_call(
        &mut self,
        expr: &'p Expr,
        constructor: &'static Constructor,
        callee: &'p Expr,
        arguments: &[&'p Expr],
    ) -> Ty {
        let Some((argument, surplus)) = arguments.split_first() else { return made(constructor) };
        let made = made(constructor);
        self.note(callee.span, made);
        match &argument.kind {
            ExprKind::Record(fields) => {
                let typed = self.constructor_fields(constructor, argument.span, fields);
                let record = self.types.store.record(typed);
                self.note(argument.span, record);
            }
            _ => {
                let ty = self.expr(argument, None);
                let may_be_record = matches!(self.types.store.get(ty), Node::Record(_) | Node::Error)
                    || self.types.store.is_variable(ty);
                if !may_be_record {
                    for rest in surplus {
                        self.expr(rest, None);
                    }
                    let error = self.without_braces(expr, constructor, callee, arguments, ty);
                    self.report(error);
                    return made;
                }
                self.demand(Demand::Construct { record: ty, constructor }, at(argument.span));
            }
        }
        if !surplus.is_empty() {
            for rest in surplus {
                self.expr(rest, None);
            }
            // What was wrong with the record explains what follows it: `sphere {}.translate (0, 1, 0)`.
            if matches!(&argument.kind, ExprKind::Field { .. }) {
                return Ty::ERROR;
            }
            let error = self.surplus_for_constructor(constructor, callee, arguments, made);
            self.report(error);
        }
        made
    }

    /// The fields of a record that is written for a constructor; their types.
    pub(super) fn constructor_fields(
        &mut self,
        constructor: &'static Constructor,
        span: Span,
        fields: &'p [FieldValue],
    ) -> Vec<(Arc<str>, Ty)> {
        self.literals.push((span, constructor));
        let mut places: HashMap<Arc<str>, Span> = HashMap::new();
        let mut typed = Vec::with_capacity(fields.len());
        for value in fields {
            let name = &value.name;
            if let Some(first) = places.get(&name.text) {
                self.twice(name, *first);
                self.expr(&value.value, None);
                continue;
            }
            places.insert(name.text.clone(), name.span);
            let ty = match constructor.field(&name.text) {
                Some((_, field)) => {
                    self.fields.push((name.span, constructor, field));
                    self.field_value(constructor, field, value)
                }
                None => {
                    let ty = self.expr(&value.value, None);
                    match self.one_of_a_list(constructor, value, ty) {
                        Some(error) => self.report(error),
                        None => {
                            self.unknown_constructor_field(constructor, &name.text, name.span, None, true);
                        }
                    }
                    ty
                }
            };
            typed.push((name.text.clone(), ty));
        }
        let given: Vec<&str> = fields.iter().map(|field| &*field.name.text).collect();
        self.missing_fields(constructor, &given, span, None);
        typed
    }

    /// A value for a field of a constructor.
    fn field_value(
        &mut self,
        constructor: &'static Constructor,
        field: &'static FieldSpec,
        value: &'p FieldValue,
    ) -> Ty {
        let expr = &value.value;
        let why = Why::Field { constructor, field, name: value.name.span };
        let allowed = Allowed::of(field);
        if let Some(of) = allowed.list {
            let list = self.list_of(of, allowed);
            return self.expr(expr, Some((list, why)));
        }
        if let (None, Some(head)) = (allowed.from, allowed.heads.only()) {
            let ty = self.expr(expr, Some((Ty::alone(head), why)));
            self.range(constructor, field, expr);
            return ty;
        }
        let ty = match (&expr.kind, allowed.from) {
            (ExprKind::Lambda { parameters, .. }, Some(from)) if parameters.len() == 1 => {
                let to = self.fresh();
                let function = self.types.store.function(from, to);
                self.expr(expr, Some((function, why)))
            }
            _ => self.expr(expr, None),
        };
        match self.slot(ty, field) {
            Ok(true) => {}
            Ok(false) => {
                self.demand(Demand::Slot { value: ty, constructor, field }, at(expr.span));
            }
            Err(_) => {
                let error = self.wrong_slot(
                    Some(expr),
                    expr.span,
                    ty,
                    constructor,
                    field,
                    Some(value.name.span),
                    None,
                );
                self.report(error);
            }
        }
        self.solve();
        if !matches!(field.kind, FieldType::Height | FieldType::Space) {
            self.range(constructor, field, expr);
        }
        ty
    }
}
