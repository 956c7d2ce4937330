//! Patterns: what they take, and what they bind.

use super::{Infer, Why};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Pattern, PatternKind};
use crate::hry::types::scheme::{Access, Binding, Demand, Origin};
use crate::hry::types::store::Ty;
use std::sync::Arc;

impl<'p> Infer<'p> {
    /// Binds the names of a pattern that takes a value of this type. `subject` is where the value comes from;
    /// whether the pattern may refuse the value is `may_refuse`.
    pub(super) fn pattern(&mut self, pattern: &'p Pattern, ty: Ty, subject: Span, may_refuse: bool) {
        self.note(pattern.span, ty);
        match &pattern.kind {
            PatternKind::Name(_) => self.bind_at(pattern.span, ty),
            PatternKind::Wildcard | PatternKind::Error => {}
            PatternKind::Number(_) => self.literal_pattern(pattern, Ty::NUMBER, ty, subject, may_refuse),
            PatternKind::Bool(_) => self.literal_pattern(pattern, Ty::BOOL, ty, subject, may_refuse),
            PatternKind::Text(_) => self.literal_pattern(pattern, Ty::TEXT, ty, subject, may_refuse),
            PatternKind::Vector(parts) => {
                let vector = if parts.len() == 2 { Ty::VEC2 } else { Ty::VEC3 };
                self.pattern_of(pattern, vector, ty, subject);
                parts.iter().for_each(|part| self.pattern(part, Ty::NUMBER, subject, may_refuse));
            }
            PatternKind::List { items, rest } => {
                if !may_refuse {
                    self.refutable(pattern);
                }
                let item = self.fresh();
                let list = self.types.store.list(item);
                self.pattern_of(pattern, list, ty, subject);
                items.iter().for_each(|part| self.pattern(part, item, subject, may_refuse));
                if let Some(Some(rest)) = rest {
                    self.note(rest.span, list);
                    self.bind_at(rest.span, list);
                }
            }
            PatternKind::Record(fields) => {
                for (name, part) in fields {
                    let field = self.fresh();
                    let origin = Origin { span: name.span, via: None, detail: name.span };
                    let demand = Demand::Field {
                        record: ty,
                        name: Arc::clone(&name.text),
                        result: field,
                        access: Access::Whole,
                    };
                    self.demand(demand, origin);
                    self.pattern(part, field, subject, may_refuse);
                }
            }
        }
    }

    fn bind_at(&mut self, span: Span, ty: Ty) {
        let local = self.names.bound.get(&span.start);
        if let Some(slot) = local.and_then(|local| self.locals.get_mut(*local)) {
            *slot = Some(Binding::Mono(ty));
        }
    }

    fn literal_pattern(
        &mut self,
        pattern: &'p Pattern,
        literal: Ty,
        ty: Ty,
        subject: Span,
        may_refuse: bool,
    ) {
        if may_refuse {
            self.pattern_of(pattern, literal, ty, subject);
        } else {
            self.refutable(pattern);
        }
    }

    fn pattern_of(&mut self, pattern: &'p Pattern, takes: Ty, ty: Ty, subject: Span) {
        if let Err(clash) = self.unify(takes, ty) {
            let error = self.mismatch(None, pattern.span, takes, ty, Why::Pattern { subject }, clash);
            self.report(error);
        }
    }

    fn refutable(&mut self, pattern: &Pattern) {
        let error = Diagnostic::error(
            "refutable-pattern",
            "a parameter or binding takes every value, but this pattern takes only some",
            pattern.span,
            "expected a name, `_`, a vector or a record",
        );
        self.report(error.with_help("take the value by a name, then look at it: `match x { ... }`"));
    }
}
