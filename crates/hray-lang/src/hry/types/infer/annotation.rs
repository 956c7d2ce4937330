//! Types as they are written.

use super::Infer;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Name, TypeExpr, TypeExprKind};
use crate::hry::program::nearest;
use crate::hry::types::kind::{Head, Kind};
use crate::hry::types::scheme::Scheme;
use crate::hry::types::store::{MOST_NESTED, Ty};
use std::collections::HashMap;
use std::sync::Arc;

/// The variables of one annotation.
#[derive(Default)]
pub(super) struct Variables {
    known: HashMap<Arc<str>, Ty>,
    /// Whether they must stay what they are.
    rigid: bool,
}

impl Variables {
    /// Those of the annotation of a definition, which holds for all values of its variables.
    pub(super) fn rigid() -> Self {
        Self { known: HashMap::new(), rigid: true }
    }
}

impl Infer<'_> {
    /// What a type is for every use, as it is written.
    pub(in crate::hry::types) fn declared(&mut self, written: &TypeExpr) -> Scheme {
        let ty = self.written(written, &mut Variables::rigid(), 0);
        let (bound, _) = self.types.store.variables([ty]);
        Scheme { ty, bound, constraints: Vec::new() }
    }

    /// What is known of something whose type cannot be read.
    pub(in crate::hry::types) const fn declared_error(&self) -> Scheme {
        Scheme { ty: Ty::ERROR, bound: Vec::new(), constraints: Vec::new() }
    }

    /// The type that is written.
    pub(super) fn written(&mut self, written: &TypeExpr, variables: &mut Variables, depth: usize) -> Ty {
        if depth > MOST_NESTED {
            return Ty::ERROR;
        }
        match &written.kind {
            TypeExprKind::Name(name) if name.starts_with(|c: char| c.is_lowercase() || c == '_') => {
                self.type_variable(name, variables)
            }
            TypeExprKind::Name(name) => match Head::ALONE.into_iter().find(|head| head.name() == &**name) {
                Some(head) => Ty::alone(head),
                None => {
                    self.unknown_type(name, written.span);
                    Ty::ERROR
                }
            },
            TypeExprKind::List(of) => {
                let of = self.written(of, variables, depth + 1);
                self.types.store.list(of)
            }
            TypeExprKind::Function(from, to) => {
                let from = self.written(from, variables, depth + 1);
                let to = self.written(to, variables, depth + 1);
                self.types.store.function(from, to)
            }
            TypeExprKind::Record(fields) => self.record_type(fields, variables, depth),
            TypeExprKind::Error => Ty::ERROR,
        }
    }

    fn record_type(&mut self, fields: &[(Name, TypeExpr)], variables: &mut Variables, depth: usize) -> Ty {
        let mut places: HashMap<Arc<str>, Span> = HashMap::new();
        let mut typed = Vec::new();
        for (name, ty) in fields {
            let ty = self.written(ty, variables, depth + 1);
            match places.get(&name.text) {
                Some(first) => self.twice(name, *first),
                None => {
                    places.insert(name.text.clone(), name.span);
                    typed.push((name.text.clone(), ty));
                }
            }
        }
        self.types.store.record(typed)
    }

    fn type_variable(&mut self, name: &Arc<str>, variables: &mut Variables) -> Ty {
        if let Some(known) = variables.known.get(name) {
            return *known;
        }
        let kind = Kind::named(name);
        let ty = if variables.rigid {
            self.types.store.rigid(name.clone(), self.level, kind)
        } else {
            self.fresh_of(kind)
        };
        variables.known.insert(name.clone(), ty);
        ty
    }

    fn unknown_type(&mut self, name: &str, span: Span) {
        let names = Head::ALONE.map(Head::name);
        let error =
            Diagnostic::error("unknown-type", format!("there is no type `{name}`"), span, "not a type");
        let here = match name {
            "Int" | "Integer" | "Float" | "Double" | "Real" | "Num" | "Scalar" => Some("Number"),
            "String" | "Str" | "Char" => Some("Text"),
            "Boolean" => Some("Bool"),
            "Colour" | "RGB" | "Rgb" => Some("Color"),
            "Vector" | "Vec" | "Vector3" | "Point" | "Float3" => Some("Vec3"),
            "Vector2" | "Float2" => Some("Vec2"),
            "Object" | "Solid" => Some("Shape"),
            "Texture" => Some("Hit -> Color"),
            "List" | "Array" => {
                self.report(error.with_help("the type of lists of numbers is written `[Number]`"));
                return;
            }
            _ => nearest(name, names.iter().copied()),
        };
        self.report(match here {
            Some(near) => error.with_suggestion(span, near, format!("did you mean `{near}`?")),
            None => error.with_help(format!(
                "the types are {}, lists `[a]`, records `{{ name : Type }}` and functions `a -> b`",
                names.map(|name| format!("`{name}`")).join(", ")
            )),
        });
    }

    /// The complaint about a field that is given twice.
    pub(super) fn twice(&mut self, name: &Name, first: Span) {
        let error = Diagnostic::error(
            "field-twice",
            format!("the field `{}` is given twice", name.text),
            name.span,
            "given again here",
        );
        self.report(error.with_secondary(first, "first given here").with_help("remove one of them"));
    }
}
