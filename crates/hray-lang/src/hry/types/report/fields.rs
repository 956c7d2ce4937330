//! Fields that are not there.

use super::super::infer::{Infer, Origin, field_of};
use super::super::kind::Head;
use super::super::scheme::Access;
use super::super::store::{Node, Ty};
use super::super::unknown::near;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::Expr;
use crate::hry::program::listed;

impl<'p> Infer<'p> {
    /// `record.name`, where the record has no such field.
    pub(in crate::hry::types) fn no_field(
        &self,
        record: Option<&'p Expr>,
        ty: Ty,
        name: &str,
        access: Access,
        origin: Origin,
    ) -> Diagnostic {
        let is = self.words(ty);
        let message = match (access, self.types.store.get(ty)) {
            _ if origin.via.is_some() => {
                let user = self.quoted(origin.span).unwrap_or("this function");
                format!("`{user}` uses the field `{name}` of what it is given, but {is} has none")
            }
            (Access::Whole, Node::Alone(Head::Vec2 | Head::Vec3 | Head::Color)) => {
                format!("only records and hits are taken apart or changed by fields, but this is {is}")
            }
            (_, Node::Alone(Head::Hit)) => format!("a hit has no field `{name}`"),
            (_, Node::Record(_)) => format!("this record has no field `{name}`"),
            _ => format!("{is} has no field `{name}`"),
        };
        let label =
            if origin.via.is_some() { "is given something without the field" } else { "no such field" };
        let mut error = Diagnostic::error("unknown-field", message, origin.detail, label);
        match record {
            Some(record) => error = error.with_secondary(record.span, format!("`{}`", self.show(ty))),
            None if origin.span != origin.detail => {
                error = error.with_secondary(origin.span, format!("`{}`", self.show(ty)));
            }
            None => {}
        }
        if let Some(via) = origin.inside() {
            error = error.with_secondary(via, "the field is used here");
        }
        self.field_hint(error, ty, name, access, origin)
    }

    fn field_hint(
        &self,
        error: Diagnostic,
        ty: Ty,
        name: &str,
        access: Access,
        origin: Origin,
    ) -> Diagnostic {
        let is_method = access == Access::Read
            && origin.via.is_none()
            && self
                .root
                .and_then(|root| self.modules.get(root))
                .is_some_and(|module| module.scope.get(name).is_some());
        if let (
            true,
            Node::Record(_) | Node::Alone(Head::Shape | Head::Material | Head::Light | Head::Camera),
        ) = (is_method, self.types.store.get(ty))
        {
            // The dot stands directly before the name.
            let dot = Span::new(origin.detail.start.saturating_sub(1), origin.detail.start);
            let text = format!("`{name}` is a function; a value is passed on to one with `|>`:");
            return error.with_suggestion(dot, " |> ", text);
        }
        let names: Vec<String> = match self.types.store.get(ty) {
            Node::Record(fields) => fields.iter().map(|field| field.0.to_string()).collect(),
            Node::Alone(Head::Hit) => ["p", "world", "normal", "uv", "time"].map(String::from).to_vec(),
            Node::Alone(Head::Color) if access == Access::Read => {
                let help = match name {
                    "x" | "y" | "z" => "a colour has `.r`, `.g` and `.b`",
                    "a" => "a colour has `.r`, `.g` and `.b`, and no alpha; a material has `transparency`",
                    _ => "a colour has `.r`, `.g` and `.b`",
                };
                return error.with_help(help);
            }
            Node::Alone(head @ (Head::Vec2 | Head::Vec3)) => return vector_hint(error, *head, name, access),
            Node::Alone(Head::Shape | Head::Material | Head::Light | Head::Camera) => {
                return error.with_help("what a constructor has made cannot be taken apart; keep the number that it was made from");
            }
            Node::List(_) => {
                return error.with_help(match name {
                    "length" | "len" | "size" | "count" => "the number of elements is `count list`",
                    _ => "elements are taken by `at i list`; to use each, write `[ x.field | x <- list ]`",
                });
            }
            Node::Function(..) => {
                return error.with_help(
                    "the function still needs its arguments; the field of its result is `(f x).field`",
                );
            }
            _ => return error,
        };
        let hit = self.types.store.head(ty) == Some(Head::Hit);
        let usual = hit.then(|| hit_synonym(name)).flatten();
        match usual.or_else(|| near(name, names.iter().map(String::as_str))) {
            Some(near) if origin.via.is_none() => {
                let all = format!("it has {}", listed(&names));
                error.with_note(all).with_suggestion(origin.detail, near, format!("did you mean `{near}`?"))
            }
            _ if names.is_empty() => error.with_help("it has no fields at all"),
            _ => error.with_help(format!("it has {}", listed(&names))),
        }
    }
}

fn hit_synonym(name: &str) -> Option<&'static str> {
    Some(match name {
        "position" | "pos" | "point" | "local" | "object" => "p",
        "x" => "p.x",
        "y" => "p.y",
        "z" => "p.z",
        "n" => "normal",
        "u" | "v" | "st" | "texcoord" => "uv",
        "t" => "time",
        "worldPosition" | "global" => "world",
        _ => return None,
    })
}

fn vector_hint(error: Diagnostic, head: Head, name: &str, access: Access) -> Diagnostic {
    if access == Access::Whole {
        return error.with_help(
            "take a vector apart by a vector pattern, `(x, y, z)`, and write a new one: `(v.x, 0, v.z)`",
        );
    }
    let all = if head == Head::Vec2 { "`.x` and `.y`" } else { "`.x`, `.y` and `.z`" };
    let help = match name {
        "length" | "len" | "norm" | "magnitude" => "the length of a vector v is `length v`".to_owned(),
        "normal" | "normalize" | "normalized" | "unit" => {
            "a vector v made length 1 is `normalize v`".to_owned()
        }
        "r" | "g" | "b" => format!("a vector has {all}; the components of colours are `.r`, `.g` and `.b`"),
        "p" => "this is a vector already; only a hit has the field `p`".to_owned(),
        _ if name.len() > 3 && name.chars().all(|c| "xyz".contains(c)) => {
            format!("vectors have two or three components: {all}")
        }
        _ if field_of(Head::Vec3, name, access).is_some() => format!("a vector of two has {all} only"),
        _ => format!("a vector has {all}, and several at once as in `.xy`"),
    };
    error.with_help(help)
}
