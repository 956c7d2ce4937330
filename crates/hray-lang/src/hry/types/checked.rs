//! What is known of a program after the pass, for those who ask about a place.

use super::kind::Head;
use super::names::{Meaning, Names, same};
use super::print::Printer;
use super::scheme::{Access, Binding, Types};
use super::store::{Node, Ty};
use crate::diagnostic::Span;
use crate::hry::ast::Definition;
use crate::hry::library::{Constructor, FieldSpec};
use crate::hry::program::{Global, Program, standard};

/// The names and types of a program.
#[derive(Clone, Debug)]
pub struct Checked {
    names: Names,
    types: Types,
    locals: Vec<Option<Binding>>,
    /// In the order of their starts, and of those that start together the longer first.
    notes: Vec<(Span, Ty)>,
    fields: Vec<(Span, &'static Constructor, &'static FieldSpec)>,
    literals: Vec<(Span, &'static Constructor)>,
    accesses: Vec<(Span, Span)>,
    /// The places where the program's own definitions are named, by module and definition.
    definitions: Vec<Vec<Option<Span>>>,
}

/// What a name at a place refers to.
#[derive(Clone, Copy, Debug)]
pub enum Target {
    /// A name bound inside a definition, by the place where it is bound.
    Local(Span),
    /// Something at the top of a file, or of the library.
    Global(Global),
    /// A field of a constructor.
    Field(&'static Constructor, &'static FieldSpec),
}

impl PartialEq for Target {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Local(a), Self::Local(b)) => a == b,
            (Self::Global(a), Self::Global(b)) => same(*a, *b),
            (Self::Field(a, f), Self::Field(b, g)) => a.name == b.name && f.name == g.name,
            _ => false,
        }
    }
}

/// What can be written at a place.
#[derive(Clone, Debug, Default)]
pub struct Completion {
    /// The fields of the expression before the point, with their types.
    pub fields: Vec<(String, String)>,
    /// The constructor whose record the place is in, and the fields that the record has already.
    pub record: Option<(&'static Constructor, Vec<&'static str>)>,
    /// The names bound inside the definition that may be used here, with their types; those bound further in
    /// first.
    pub locals: Vec<(String, String)>,
}

impl Checked {
    #[allow(clippy::too_many_arguments, reason = "what the pass has found, each once")]
    pub(super) fn new(
        program: &Program,
        names: Names,
        types: Types,
        locals: Vec<Option<Binding>>,
        mut notes: Vec<(Span, Ty)>,
        fields: Vec<(Span, &'static Constructor, &'static FieldSpec)>,
        literals: Vec<(Span, &'static Constructor)>,
        accesses: Vec<(Span, Span)>,
    ) -> Self {
        notes.sort_by_key(|(span, _)| (span.start, std::cmp::Reverse(span.end)));
        let name = |definition: &Definition| definition.name().map(|name| name.span);
        let definitions = program
            .modules
            .iter()
            .map(|module| module.syntax.definitions.iter().map(name).collect())
            .collect();
        Self { names, types, locals, notes, fields, literals, accesses, definitions }
    }

    /// The type of a definition, a native function or a constructor. None where an error kept it from being
    /// known.
    #[must_use]
    pub fn scheme_of(&self, global: Global) -> Option<String> {
        let mut printer = Printer::new(&self.types.store);
        match global {
            Global::Definition { module, index } => match self.types.definitions.get(module)?.get(index)? {
                Binding::Poly(scheme) if !self.types.store.is_error(scheme.ty) => {
                    Some(printer.scheme(scheme))
                }
                _ => None,
            },
            Global::Native(native) => {
                self.types.natives.get(native.native as usize).map(|scheme| printer.scheme(scheme))
            }
            Global::Constructor(constructor) => {
                let made = printer.show(super::infer::made(constructor));
                Some(format!("{{ {} }} -> {made}", constructor_fields(constructor)))
            }
        }
    }

    /// The type of the innermost expression or name at an offset, and its place. Of the program's own files.
    #[must_use]
    pub fn type_at(&self, offset: usize) -> Option<(Span, String)> {
        let before = self.notes.partition_point(|(span, _)| span.start <= offset);
        let covering = self.notes.iter().take(before).filter(|(span, _)| offset < span.end);
        let innermost = covering.min_by_key(|(span, _)| span.end - span.start)?;
        if let Some(scheme) = self.scheme_at(innermost.0) {
            return Some((innermost.0, scheme));
        }
        let text = Printer::new(&self.types.store).show(innermost.1);
        Some((innermost.0, text))
    }

    /// The type for every use of what is defined at a place.
    fn scheme_at(&self, span: Span) -> Option<String> {
        if let Some(local) = self.names.bound.get(&span.start).and_then(|local| self.locals.get(*local)) {
            return match local {
                Some(Binding::Poly(scheme)) => Some(Printer::new(&self.types.store).scheme(scheme)),
                _ => None,
            };
        }
        self.definition_named(span.start)
            .filter(|(_, name)| *name == span)
            .and_then(|(global, _)| self.scheme_of(global))
    }

    /// The definition whose name stands at an offset.
    fn definition_named(&self, offset: usize) -> Option<(Global, Span)> {
        let own = standard().modules.len();
        for (module, definitions) in self.definitions.iter().enumerate().skip(own) {
            let found = definitions.iter().enumerate().filter_map(|(index, span)| Some((index, (*span)?)));
            if let Some((index, span)) = found.into_iter().find(|(_, span)| touches(*span, offset)) {
                return Some((Global::Definition { module, index }, span));
            }
        }
        None
    }

    /// What the name at an offset refers to. A name's end belongs to it.
    #[must_use]
    pub fn definition_at(&self, offset: usize) -> Option<Target> {
        let found = self.names.places.iter().find(|(span, _)| touches(*span, offset));
        if let Some((_, meaning)) = found {
            return match meaning {
                Meaning::Local(local) => self.names.locals.get(*local).map(|local| Target::Local(local.span)),
                Meaning::Global(global) => Some(Target::Global(*global)),
                Meaning::Nothing => None,
            };
        }
        if let Some(local) = self.names.locals.iter().find(|local| touches(local.span, offset)) {
            return Some(Target::Local(local.span));
        }
        if let Some((global, _)) = self.definition_named(offset) {
            return Some(Target::Global(global));
        }
        let field = self.fields.iter().find(|(span, ..)| touches(*span, offset));
        field.map(|(_, constructor, field)| Target::Field(constructor, field))
    }

    /// Every place in the program's own files where something is named, where it is defined included, in
    /// order.
    #[must_use]
    pub fn references(&self, target: &Target) -> Vec<Span> {
        let mut found: Vec<Span> = match target {
            Target::Local(span) => {
                let local = self.names.bound.get(&span.start).copied();
                let uses = self.names.places.iter();
                let uses =
                    uses.filter(|(_, meaning)| matches!(meaning, Meaning::Local(l) if Some(*l) == local));
                uses.map(|(span, _)| *span).chain([*span]).collect()
            }
            Target::Global(global) => {
                let uses = self.names.places.iter();
                let uses =
                    uses.filter(|(_, meaning)| matches!(meaning, Meaning::Global(g) if same(*g, *global)));
                uses.map(|(span, _)| *span).chain(self.own_place(*global)).collect()
            }
            Target::Field(constructor, field) => {
                let uses = self.fields.iter();
                let uses = uses.filter(|(_, c, f)| c.name == constructor.name && f.name == field.name);
                uses.map(|(span, ..)| *span).collect()
            }
        };
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Where one of the program's own definitions is named.
    fn own_place(&self, global: Global) -> Option<Span> {
        match global {
            Global::Definition { module, index } if module >= standard().modules.len() => {
                *self.definitions.get(module)?.get(index)?
            }
            _ => None,
        }
    }

    /// What can be written at an offset: the fields of the expression that ends one byte before it (where
    /// that byte is a point), or whose field the offset is in; the constructor whose record it is in; and the
    /// locals in scope.
    #[must_use]
    pub fn completion_at(&self, offset: usize) -> Completion {
        let access =
            self.accesses.iter().find(|(record, name)| touches(*name, offset) || record.end + 1 == offset);
        let record = access.map(|(record, _)| *record);
        let expression = self.notes.iter().filter(|(span, _)| match record {
            Some(record) => *span == record,
            None => span.end + 1 == offset,
        });
        let ty = expression.max_by_key(|(span, _)| span.end - span.start).map(|(_, ty)| *ty);
        let inside = self.literals.iter().filter(|(span, _)| span.start < offset && offset <= span.end);
        let literal = inside.min_by_key(|(span, _)| span.end - span.start);
        Completion {
            fields: ty.map(|ty| self.fields_of(ty)).unwrap_or_default(),
            record: literal.map(|(span, constructor)| (*constructor, self.given(*span, constructor))),
            locals: self.locals_at(offset),
        }
    }

    /// The fields that a type has.
    fn fields_of(&self, ty: Ty) -> Vec<(String, String)> {
        let fixed = |names: &[&str], head: Head| {
            let typed = |name: &&str| {
                let ty = super::infer::field_of(head, name, Access::Read)?;
                Some(((*name).to_owned(), Printer::new(&self.types.store).show(ty)))
            };
            names.iter().filter_map(typed).collect()
        };
        match self.types.store.get(ty) {
            Node::Record(fields) => fields
                .iter()
                .map(|(name, ty)| (name.to_string(), Printer::new(&self.types.store).show(*ty)))
                .collect(),
            Node::Alone(Head::Hit) => fixed(&["p", "world", "normal", "uv", "time"], Head::Hit),
            Node::Alone(Head::Color) => fixed(&["r", "g", "b"], Head::Color),
            Node::Alone(Head::Vec2) => fixed(&["x", "y", "yx"], Head::Vec2),
            Node::Alone(Head::Vec3) => fixed(&["x", "y", "z", "xy", "xz", "yz"], Head::Vec3),
            // What may still be a hit probably is one.
            Node::Variable { .. } if self.types.store.heads(ty).has(Head::Hit) => {
                fixed(&["p", "world", "normal", "uv", "time"], Head::Hit)
            }
            _ => Vec::new(),
        }
    }

    fn given(&self, span: Span, constructor: &Constructor) -> Vec<&'static str> {
        let inside = self.fields.iter().filter(|(field, owner, _)| {
            owner.name == constructor.name && span.start <= field.start && field.end <= span.end
        });
        inside.map(|(_, _, field)| field.name).collect()
    }

    fn locals_at(&self, offset: usize) -> Vec<(String, String)> {
        let all = self.names.locals.iter().enumerate();
        let mut inside: Vec<_> =
            all.filter(|(_, local)| local.scope.start <= offset && offset <= local.scope.end).collect();
        inside.sort_by_key(|(place, local)| (local.scope.end - local.scope.start, *place));
        let mut found: Vec<(String, String)> = Vec::new();
        for (place, local) in inside {
            if found.iter().any(|(name, _)| **name == *local.name) {
                continue;
            }
            let mut printer = Printer::new(&self.types.store);
            let ty = match self.locals.get(place) {
                Some(Some(Binding::Mono(ty))) => printer.show(*ty),
                Some(Some(Binding::Poly(scheme))) => printer.scheme(scheme),
                _ => "?".into(),
            };
            found.push((local.name.to_string(), ty));
        }
        found
    }
}

/// The fields of a constructor with their types; in `?` those that may be left out.
fn constructor_fields(constructor: &Constructor) -> String {
    let field = |field: &FieldSpec| {
        let mark = if field.default.is_some() { "?" } else { "" };
        format!("{}{mark} : {}", field.name, super::infer::Allowed::written(field))
    };
    constructor.fields.iter().map(field).collect::<Vec<_>>().join(", ")
}

/// Whether an offset is at a name, its end included.
fn touches(span: Span, offset: usize) -> bool {
    span.start <= offset && offset <= span.end
}
