//! The library in words: types, documentation, ranges and units, as Markdown.

use super::analysis::Analysis;
use crate::hry::ast::Definition;
use crate::hry::library::{Constructor, FieldSpec, FieldType, Range};
use crate::hry::program::Global;

/// What an entry of the library or a definition of the program is called and what type it has, as hry writes it.
pub(super) fn signature(analysis: &Analysis, name: &str, global: Global) -> String {
    let scheme = analysis.hry.as_ref().and_then(|(_, checked)| checked.scheme_of(global));
    match global {
        Global::Constructor(constructor) => format!("{name} : {{ ... }} -> {}", made(constructor)),
        Global::Native(native) => format!("{name} : {}", native.signature),
        Global::Definition { .. } => {
            scheme.map_or_else(|| name.to_owned(), |scheme| format!("{name} : {scheme}"))
        }
    }
}

/// The type of what a constructor makes.
pub(super) fn made(constructor: &Constructor) -> &'static str {
    use crate::hry::library::Makes;
    match constructor.makes {
        Makes::Shape => "Shape",
        Makes::Material => "Material",
        Makes::Light => "Light",
        Makes::Camera => "Camera",
        Makes::Scene => "Scene",
    }
}

/// The documentation of an entry, as Markdown; empty where it has none.
pub(super) fn documentation(analysis: &Analysis, global: Global) -> String {
    match global {
        Global::Native(native) => native.doc.to_owned(),
        Global::Constructor(constructor) => constructor_text(constructor),
        Global::Definition { .. } => {
            definition(analysis, global).and_then(|d| d.doc.as_deref()).unwrap_or("").to_owned()
        }
    }
}

/// The definition that a global is, where it is one.
pub(super) fn definition(analysis: &Analysis, global: Global) -> Option<&Definition> {
    let (program, _) = analysis.hry.as_ref()?;
    match global {
        Global::Definition { module, index } => program.definition(module, index),
        _ => None,
    }
}

fn constructor_text(constructor: &Constructor) -> String {
    let fields: Vec<String> =
        constructor.fields.iter().map(|field| format!("- {}", field_line(field))).collect();
    format!("{}\n\n```hry\n{}\n```\n\n{}", constructor.doc, constructor.example, fields.join("\n"))
}

fn field_line(field: &FieldSpec) -> String {
    format!("`{}` : `{}`{}. {}", field.name, field_type(field), conditions(field), field.doc)
}

/// What a field is, as Markdown.
pub(super) fn field_text(constructor: &Constructor, field: &FieldSpec) -> String {
    let rest = conditions(field);
    let rest = rest.trim_start_matches(", ");
    let rest = if rest.is_empty() { String::new() } else { format!("\n\n{}", capital(rest)) };
    format!("{}{rest}\n\nA field of `{}`.", field.doc, constructor.name)
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

/// `, in scene units, greater than 0, 1 by default`.
fn conditions(field: &FieldSpec) -> String {
    let mut text = String::new();
    if !field.unit.is_empty() && field.unit != "share" {
        text += &format!(", in {}", field.unit);
    }
    if let Some(range) = range(field.range) {
        text += &format!(", {range}");
    }
    match field.default {
        None => text += ", must be given",
        Some("") => text += ", may be left out",
        Some(default) => text += &format!(", `{default}` by default"),
    }
    text
}

/// A range in words.
fn range(range: Range) -> Option<String> {
    Some(match range {
        Range::Any => return None,
        Range::Positive | Range::Radius => "greater than 0".into(),
        Range::NonNegative => "0 or greater".into(),
        Range::Share => "from 0 to 1".into(),
        Range::Between(from, to) => format!("between {from} and {}", pi(to)),
        Range::Whole(from, to) => format!("a whole number from {from} to {to}"),
        Range::Direction | Range::Normal => "not zero".into(),
        Range::Light => "0 or greater in every component".into(),
        Range::Positives => "greater than 0 in every component".into(),
    })
}

fn pi(number: f64) -> String {
    if number == std::f64::consts::PI { "180deg".into() } else { number.to_string() }
}

/// The type of a field, as hry writes it.
pub(super) fn field_type(field: &FieldSpec) -> String {
    let plain = match field.kind {
        FieldType::Number => "Number",
        FieldType::Bool => "Bool",
        FieldType::Text => "Text",
        FieldType::Vec2 => "Vec2",
        FieldType::Vec3 => "Vec3",
        FieldType::Color => "Color or Number",
        FieldType::Material => "Material",
        FieldType::Camera => "Camera",
        FieldType::Lights => "[Light]",
        FieldType::Shapes => "[Shape]",
        FieldType::Points => "[Vec3]",
        FieldType::Pairs => "[Vec2]",
        FieldType::Faces => "[[Number]]",
        FieldType::Integrator => "Integrator",
        FieldType::Encoding => "Encoding",
        FieldType::Background => "Color, Number or Vec3 -> Color",
        FieldType::Height => "Hit -> Number",
        FieldType::Space => "Vec3 -> Number",
    };
    match (field.varies, field.kind) {
        (false, _) => plain.to_owned(),
        (true, FieldType::Color) => "Color, Number or Hit -> Color".to_owned(),
        (true, _) => format!("{plain} or Hit -> {plain}"),
    }
}
