//! Decides demands as soon as enough is known.

use super::{Infer, Origin};
use crate::diagnostic::Span;
use crate::hry::ast::BinaryOperator;
use crate::hry::library::{Constructor, FieldSpec, FieldType};
use crate::hry::types::kind::{Head, Kind};
use crate::hry::types::scheme::{Access, Demand};
use crate::hry::types::store::{Clash, Node, Ty};
use std::sync::Arc;

/// Why a demand cannot be met.
#[derive(Clone, Copy, Debug)]
pub(in crate::hry::types) enum Failure {
    /// Types that do not agree.
    Clash,
    /// There is no such field.
    NoField,
    /// The operands do not go together.
    Operands,
    /// A constructor was given no record.
    NotARecord,
    /// A field of a constructor does not take that.
    Slot,
}

impl From<Clash> for Failure {
    fn from(_: Clash) -> Self {
        Self::Clash
    }
}

/// Whether a demand was decided.
type Decided = Result<bool, Failure>;

const NUMBER: Kind = Kind::of(&[Head::Number]);

impl Infer<'_> {
    /// Decides what became decidable, and what becomes so by that.
    pub(super) fn solve(&mut self) {
        loop {
            let woken = self.types.store.woken();
            if woken.is_empty() {
                return;
            }
            for variable in woken {
                let fields = self.waiting_fields.remove(&variable).unwrap_or_default();
                for id in self.waiting.remove(&variable).unwrap_or_default().into_iter().chain(fields) {
                    self.registered.remove(&(variable, id));
                    self.attempt(id);
                }
            }
        }
    }

    /// Decides a demand, or makes it wait for its variables.
    pub(super) fn attempt(&mut self, id: usize) {
        if self.solved.get(id) != Some(&false) || self.exhausted {
            return;
        }
        let Some(constraint) = self.constraints.get(id).cloned() else { return };
        match self.decide(&constraint.demand, constraint.origin) {
            Ok(true) => self.done(id),
            Ok(false) => self.wait(id, &constraint.demand),
            Err(failure) => {
                self.done(id);
                self.failed(&constraint, failure);
            }
        }
    }

    pub(super) fn done(&mut self, id: usize) {
        if let Some(solved) = self.solved.get_mut(id) {
            *solved = true;
        }
    }

    fn wait(&mut self, id: usize, demand: &Demand) {
        let is_field = matches!(demand, Demand::Field { .. });
        for (place, ty) in demand.types().into_iter().enumerate() {
            let variable = self.types.store.find(ty);
            let wakes = !is_field || place == 0;
            if wakes && self.types.store.is_variable(variable) && self.registered.insert((variable, id)) {
                let waiting = if is_field { &mut self.waiting_fields } else { &mut self.waiting };
                waiting.entry(variable).or_default().push(id);
            }
        }
    }

    pub(super) fn decide(&mut self, demand: &Demand, origin: Origin) -> Decided {
        match demand {
            Demand::Arithmetic { operator, left, right, result } => {
                self.arithmetic(*operator, *left, *right, *result)
            }
            Demand::Field { record, name, result, access } => self.field(*record, name, *result, *access),
            Demand::Construct { record, constructor } => self.construct(*record, constructor, origin),
            Demand::Slot { value, field, .. } => self.slot(*value, field),
        }
    }

    /// The rule of arithmetic: both sides the same type, or one of them a number.
    fn arithmetic(&mut self, _operator: BinaryOperator, left: Ty, right: Ty, result: Ty) -> Decided {
        let store = &mut self.types.store;
        if store.is_error(left) || store.is_error(right) {
            store.unify(result, Ty::ERROR)?;
            return Ok(true);
        }
        for side in [left, right] {
            store.narrow(side, Kind::NUMERIC).map_err(|_| Failure::Operands)?;
        }
        if store.head(left) == Some(Head::Number) {
            store.unify(result, right)?;
            return Ok(true);
        }
        if store.head(right) == Some(Head::Number) || store.find(left) == store.find(right) {
            store.unify(result, left)?;
            return Ok(true);
        }
        if store.head(result) == Some(Head::Number) {
            store.unify(left, Ty::NUMBER)?;
            store.unify(right, Ty::NUMBER)?;
            return Ok(true);
        }
        for (one, other) in [(left, right), (right, left)] {
            if self.types.store.heads(one).has(Head::Number) {
                continue;
            }
            let store = &mut self.types.store;
            store.unify(result, one)?;
            if !store.heads(other).has(Head::Number) {
                store.unify(one, other).map_err(|_| Failure::Operands)?;
                return Ok(true);
            }
            if let Some(head) = store.head(one) {
                store.narrow(other, NUMBER.or(head)).map_err(|_| Failure::Operands)?;
                return Ok(true);
            }
        }
        if let Some(head) = self.types.store.head(result) {
            for side in [left, right] {
                self.types.store.narrow(side, NUMBER.or(head))?;
            }
        }
        Ok(false)
    }

    fn field(&mut self, record: Ty, name: &Arc<str>, result: Ty, access: Access) -> Decided {
        let found = match self.types.store.get(record).clone() {
            Node::Error => Some(Ty::ERROR),
            Node::Record(fields) => fields.iter().find(|field| field.0 == *name).map(|field| field.1),
            Node::Alone(head) => field_of(head, name, access),
            Node::Variable { .. } => return self.field_of_variable(record, name, result, access),
            Node::Rigid { kind, .. } if kind.within(Kind::VECTOR) => field_of(Head::Vec2, name, access),
            _ => None,
        };
        let found = found.ok_or(Failure::NoField)?;
        self.types.store.unify(result, found)?;
        Ok(true)
    }

    fn field_of_variable(&mut self, record: Ty, name: &Arc<str>, result: Ty, access: Access) -> Decided {
        let heads: Vec<Head> =
            Head::ALONE.into_iter().filter(|head| field_of(*head, name, access).is_some()).collect();
        let possible = Kind::of(&heads).or(Head::Record);
        self.types.store.narrow(record, possible).map_err(|_| Failure::NoField)?;
        let heads = self.types.store.heads(record);
        if let Some(head) = self.types.store.head(record) {
            let found = field_of(head, name, access).ok_or(Failure::NoField)?;
            self.types.store.unify(result, found)?;
            return Ok(true);
        }
        if heads.within(Kind::VECTOR) {
            let found = field_of(Head::Vec3, name, access).ok_or(Failure::NoField)?;
            self.types.store.unify(result, found)?;
            return Ok(true);
        }
        // A second use of the same field has the same type, and then demands nothing new.
        let variable = self.types.store.find(record);
        let others = self.waiting_fields.get(&variable).cloned().unwrap_or_default();
        for other in others {
            let demand = self.constraints.get(other).map(|constraint| constraint.demand.clone());
            if let Some(Demand::Field { name: known, result: first, .. }) = demand
                && known == *name
                && self.solved.get(other) == Some(&false)
            {
                self.types.store.unify(result, first)?;
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The fields that are demanded of something that is not known yet.
    pub(in crate::hry::types) fn demanded_fields(&self, ty: Ty) -> Vec<Arc<str>> {
        let variable = self.types.store.find(ty);
        let waiting = self.waiting_fields.get(&variable).into_iter().flatten();
        let demands = waiting.filter_map(|id| self.constraints.get(*id));
        let names = demands.filter_map(|constraint| match &constraint.demand {
            Demand::Field { name, .. } => Some(name.clone()),
            _ => None,
        });
        names.collect()
    }

    /// A record that a constructor takes.
    fn construct(&mut self, record: Ty, constructor: &'static Constructor, origin: Origin) -> Decided {
        match self.types.store.get(record).clone() {
            Node::Error => Ok(true),
            Node::Record(fields) => {
                self.fields_of_record(&fields, constructor, origin);
                Ok(true)
            }
            Node::Variable { .. } => {
                let record_kind = Kind::of(&[Head::Record]);
                self.types.store.narrow(record, record_kind).map_err(|_| Failure::NotARecord)?;
                Ok(false)
            }
            _ => Err(Failure::NotARecord),
        }
    }

    fn fields_of_record(
        &mut self,
        fields: &[(Arc<str>, Ty)],
        constructor: &'static Constructor,
        origin: Origin,
    ) {
        for (name, ty) in fields {
            match constructor.field(name) {
                Some((_, field)) => {
                    let slot = Demand::Slot { value: *ty, constructor, field };
                    let id = self.constraints.len();
                    self.constraints.push(crate::hry::types::scheme::Constraint { demand: slot, origin });
                    self.solved.push(false);
                    self.pending.push(id);
                    self.attempt(id);
                }
                None => self.unknown_constructor_field(constructor, name, origin.span, origin.via, false),
            }
        }
        let given: Vec<&str> = fields.iter().map(|field| &*field.0).collect();
        self.missing_fields(constructor, &given, origin.span, origin.via);
    }

    /// The type of the lists that a field takes.
    pub(super) fn list_of(&mut self, of: Ty, allowed: Allowed) -> Ty {
        let list = self.types.store.list(of);
        if allowed.is_nested { self.types.store.list(list) } else { list }
    }

    /// A value that a field of a constructor takes.
    pub(super) fn slot(&mut self, value: Ty, field: &'static FieldSpec) -> Decided {
        let allowed = Allowed::of(field);
        let wrong = |_: Clash| Failure::Slot;
        if let Some(of) = allowed.list {
            let list = self.list_of(of, allowed);
            self.types.store.unify(value, list).map_err(wrong)?;
            return Ok(true);
        }
        match self.types.store.get(value).clone() {
            Node::Function(from, to) => {
                let taken = allowed.from.ok_or(Failure::Slot)?;
                self.types.store.unify(from, taken).map_err(wrong)?;
                self.types.store.narrow(to, allowed.heads).map_err(wrong)?;
                Ok(true)
            }
            Node::Variable { .. } => {
                let heads =
                    if allowed.from.is_some() { allowed.all().or(Head::Function) } else { allowed.heads };
                self.types.store.narrow(value, heads).map_err(wrong)?;
                let only_function = allowed.from.filter(|_| allowed.all().is_empty());
                if let Some(from) = only_function {
                    let to = self.fresh_of(allowed.heads);
                    let function = self.types.store.function(from, to);
                    self.types.store.unify(value, function).map_err(wrong)?;
                    return Ok(true);
                }
                Ok(allowed.from.is_none() || !self.types.store.is_variable(value))
            }
            _ => {
                self.types.store.narrow(value, allowed.all()).map_err(wrong)?;
                Ok(true)
            }
        }
    }
}

/// The types that a field of a constructor takes.
#[derive(Clone, Copy)]
pub(in crate::hry::types) struct Allowed {
    /// Plain values, or what a function gives.
    pub(in crate::hry::types) heads: Kind,
    /// A list of those.
    pub(in crate::hry::types) list: Option<Ty>,
    /// Whether it is a list of such lists.
    pub(in crate::hry::types) is_nested: bool,
    /// What a function takes, where functions are allowed.
    pub(in crate::hry::types) from: Option<Ty>,
    /// Whether nothing but a function is allowed.
    only_functions: bool,
}

impl Allowed {
    pub(in crate::hry::types) fn of(field: &FieldSpec) -> Self {
        let hit = field.varies.then_some(Ty::HIT);
        let plain = |head: Head| Self {
            heads: Kind::of(&[head]),
            list: None,
            is_nested: false,
            from: hit,
            only_functions: false,
        };
        let list = |head: Head| Self {
            heads: Kind::of(&[Head::List]),
            list: Some(Ty::alone(head)),
            is_nested: false,
            from: None,
            only_functions: false,
        };
        match field.kind {
            FieldType::Number => plain(Head::Number),
            FieldType::Bool => plain(Head::Bool),
            FieldType::Text => plain(Head::Text),
            FieldType::Vec2 => plain(Head::Vec2),
            FieldType::Vec3 => plain(Head::Vec3),
            FieldType::Material => plain(Head::Material),
            FieldType::Camera => plain(Head::Camera),
            FieldType::Integrator => plain(Head::Integrator),
            FieldType::Encoding => plain(Head::Encoding),
            FieldType::Color => Self { heads: NUMBER.or(Head::Color), ..plain(Head::Color) },
            FieldType::Background => {
                Self { heads: NUMBER.or(Head::Color), from: Some(Ty::VEC3), ..plain(Head::Color) }
            }
            FieldType::Height => Self { from: Some(Ty::HIT), only_functions: true, ..plain(Head::Number) },
            FieldType::Space => Self { from: Some(Ty::VEC3), only_functions: true, ..plain(Head::Number) },
            FieldType::Lights => list(Head::Light),
            FieldType::Shapes => list(Head::Shape),
            FieldType::Points => list(Head::Vec3),
            FieldType::Pairs => list(Head::Vec2),
            FieldType::Faces => Self { is_nested: true, ..list(Head::Number) },
        }
    }

    /// The plain values.
    pub(in crate::hry::types) const fn all(self) -> Kind {
        if self.only_functions { Kind::of(&[]) } else { self.heads }
    }

    /// As a type is written.
    pub(in crate::hry::types) fn written(field: &FieldSpec) -> String {
        let plain = match field.kind {
            FieldType::Number => "Number",
            FieldType::Bool => "Bool",
            FieldType::Text => "Text",
            FieldType::Vec2 => "Vec2",
            FieldType::Vec3 => "Vec3",
            FieldType::Color => "Color",
            FieldType::Material => "Material",
            FieldType::Camera => "Camera",
            FieldType::Integrator => "Integrator",
            FieldType::Encoding => "Encoding",
            FieldType::Background => return "Color or Vec3 -> Color".into(),
            FieldType::Height => return "Hit -> Number".into(),
            FieldType::Space => return "Vec3 -> Number".into(),
            FieldType::Lights => return "[Light]".into(),
            FieldType::Shapes => return "[Shape]".into(),
            FieldType::Points => return "[Vec3]".into(),
            FieldType::Pairs => return "[Vec2]".into(),
            FieldType::Faces => return "[[Number]]".into(),
        };
        if field.varies { format!("{plain} or Hit -> {plain}") } else { plain.into() }
    }
}

/// The type of a field, or swizzle, of a type that stands alone.
pub(in crate::hry::types) fn field_of(head: Head, name: &str, access: Access) -> Option<Ty> {
    let swizzle = |components: &str| {
        let known = access == Access::Read && name.chars().all(|c| components.contains(c));
        match name.len() {
            1 if known => Some(Ty::NUMBER),
            2 if known => Some(Ty::VEC2),
            3 if known => Some(Ty::VEC3),
            _ => None,
        }
    };
    match (head, name) {
        (Head::Vec2, _) => swizzle("xy"),
        (Head::Vec3, _) => swizzle("xyz"),
        (Head::Color, "r" | "g" | "b") if access == Access::Read => Some(Ty::NUMBER),
        (Head::Hit, "p" | "world" | "normal") => Some(Ty::VEC3),
        (Head::Hit, "uv") => Some(Ty::VEC2),
        (Head::Hit, "time") => Some(Ty::NUMBER),
        _ => None,
    }
}

/// The fields that make an otherwise unknown value a hit.
pub(super) const TELLING_HIT_FIELDS: [&str; 3] = ["p", "world", "normal"];

/// The place that an origin is shown at.
pub(super) const fn at(span: Span) -> Origin {
    Origin { span, via: None, detail: span }
}
