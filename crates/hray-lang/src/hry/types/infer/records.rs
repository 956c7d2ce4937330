//! Records: their fields read and changed.

use super::{Infer, Origin, Why};
use crate::diagnostic::Span;
use crate::hry::ast::{Expr, ExprKind, FieldValue, Name};
use crate::hry::types::scheme::{Access, Demand};
use crate::hry::types::store::{Node, Ty};
use std::collections::HashMap;
use std::sync::Arc;

impl<'p> Infer<'p> {
    pub(super) fn record(&mut self, fields: &'p [FieldValue]) -> Ty {
        let mut places: HashMap<Arc<str>, Span> = HashMap::new();
        let mut typed = Vec::with_capacity(fields.len());
        for field in fields {
            let ty = self.expr(&field.value, None);
            match places.get(&field.name.text) {
                Some(first) => self.twice(&field.name, *first),
                None => {
                    places.insert(field.name.text.clone(), field.name.span);
                    typed.push((field.name.text.clone(), ty));
                }
            }
        }
        self.types.store.record(typed)
    }

    pub(super) fn update(&mut self, record: &'p Expr, fields: &'p [FieldValue]) -> Ty {
        let ty = self.expr(record, None);
        let mut places: HashMap<Arc<str>, Span> = HashMap::new();
        for field in fields {
            if let Some(first) = places.insert(field.name.text.clone(), field.name.span) {
                self.twice(&field.name, first);
                self.expr(&field.value, None);
                continue;
            }
            let value = self.demand_field(record, ty, &field.name, Access::Whole);
            self.expr(&field.value, Some((value, Why::Update { name: &field.name, record: record.span })));
        }
        ty
    }

    pub(super) fn field_read(&mut self, expr: &'p Expr, record: &'p Expr, name: &'p Name) -> Ty {
        if let (ExprKind::Name(_), Some(global)) =
            (&record.kind, self.names.qualifiers.get(&record.span.start))
        {
            return self.global(*global, expr.span);
        }
        self.accesses.push((record.span, name.span));
        let ty = self.expr(record, None);
        self.demand_field(record, ty, name, Access::Read)
    }

    /// The type of a field; an error where there is none.
    fn demand_field(&mut self, record: &'p Expr, ty: Ty, name: &'p Name, access: Access) -> Ty {
        if let Node::Record(fields) = self.types.store.get(ty)
            && let Some((_, ty)) = fields.iter().find(|field| field.0 == name.text)
        {
            return *ty;
        }
        let result = self.fresh();
        let demand = Demand::Field { record: ty, name: name.text.clone(), result, access };
        let origin = Origin { span: record.span, via: None, detail: name.span };
        match self.decide(&demand, origin) {
            Ok(true) => {}
            Ok(false) => self.demand(demand, origin),
            Err(_) => {
                let error = self.no_field(Some(record), ty, &name.text, access, origin);
                self.report(error);
                let _ = self.unify(result, Ty::ERROR);
            }
        }
        self.solve();
        result
    }
}
