//! The chapters of the reference that are made from the tables: constructors and library.

use super::library::{CONSTRUCTORS, Constructor, FieldSpec, FieldType, Makes, NATIVES, Range};
use super::program::{Global, Program, standard};
use super::types::Checked;
use std::fmt::Write as _;

/// The chapter of all constructors and their fields, in Markdown.
#[must_use]
pub fn constructors() -> String {
    let mut text = String::from(
        "# Constructors\n\n\
         A constructor takes a record and makes one of a scene's own kinds of value. Fields may be written in any order; \
         those with a default may be left out. **Varies** marks fields that take a function of the hit, too: `T` or \
         `Hit -> T`. Wherever a colour is expected, a number gives a grey.\n",
    );
    for (makes, title) in [
        (Makes::Scene, "The scene"),
        (Makes::Camera, "Cameras"),
        (Makes::Light, "Lights"),
        (Makes::Shape, "Shapes"),
        (Makes::Material, "Materials"),
    ] {
        let _ = write!(text, "\n## {title}\n");
        for constructor in CONSTRUCTORS.iter().filter(|constructor| constructor.makes == makes) {
            describe(constructor, &mut text);
        }
    }
    text
}

fn describe(constructor: &Constructor, text: &mut String) {
    // Writing to a text does not fail.
    let _ = write!(
        text,
        "\n### {}\n\n{}\n\n```hry\n{}\n```\n\n| field | takes | default | meaning |\n|---|---|---|---|\n",
        constructor.name, constructor.doc, constructor.example
    );
    for field in constructor.fields {
        let default = match field.default {
            None => "must be given".to_owned(),
            Some("") => "none".to_owned(),
            Some(default) => format!("`{default}`"),
        };
        let varies = if field.varies { ", **varies**" } else { "" };
        let _ = writeln!(
            text,
            "| `{}` | {}{varies} | {default} | {} |",
            field.name,
            takes(field),
            meaning(field)
        );
    }
}

/// What a field takes, with its unit.
fn takes(field: &FieldSpec) -> String {
    let kind = match field.kind {
        FieldType::Number => "Number",
        FieldType::Bool => "Bool",
        FieldType::Text => "Text",
        FieldType::Vec2 => "Vec2",
        FieldType::Vec3 => "Vec3",
        FieldType::Color => "Color",
        FieldType::Material => "Material",
        FieldType::Camera => "Camera",
        FieldType::Lights => "[Light]",
        FieldType::Shapes => "[Shape]",
        FieldType::Points => "[Vec3]",
        FieldType::Pairs => "[Vec2]",
        FieldType::Faces => "[[Number]]",
        FieldType::Integrator => "Integrator",
        FieldType::Encoding => "Encoding",
        FieldType::Background => "Color or Vec3 -> Color",
        FieldType::Height => "Hit -> Number",
        FieldType::Space => "Vec3 -> Number",
    };
    if field.unit.is_empty() { kind.to_owned() } else { format!("{kind}, {}", field.unit) }
}

fn meaning(field: &FieldSpec) -> String {
    let degrees = |v: f64| v.to_degrees().round();
    let range = match field.range {
        Range::Any => return field.doc.to_owned(),
        Range::Positive => "Greater than 0.".to_owned(),
        Range::Radius => "Greater than 0; otherwise hray warns.".to_owned(),
        Range::Normal => "Not zero; otherwise hray warns.".to_owned(),
        Range::NonNegative => "0 or greater.".to_owned(),
        Range::Share => "From 0 to 1; beyond, hray warns.".to_owned(),
        Range::Between(low, high) if field.unit == "radians" => {
            format!("Between {}deg and {}deg.", degrees(low), degrees(high))
        }
        Range::Between(low, high) => format!("Between {low} and {high}."),
        Range::Whole(low, high) => format!("Whole, from {low} to {high}."),
        Range::Direction => "Not zero.".to_owned(),
        Range::Light => "0 or greater; below, hray warns.".to_owned(),
        Range::Positives => "Greater than 0 in every component.".to_owned(),
    };
    format!("{} {range}", field.doc)
}

/// The chapter of all functions and values of the library, in Markdown. `program` is any, with what was found of it.
#[must_use]
pub fn library(checked: &Checked) -> String {
    let mut text = String::from(
        "# Library\n\n\
         All of this is in scope everywhere. A definition of yours may use the same name, and then wins. `numeric` stands \
         for a number, a vector or a colour; `vector` for a vector of two or three; `placeable` for a shape, a material, a \
         light, a camera or a function of a hit; `appendable` for a list or a text; other names in lower case for any type.\n\n\
         What is *built in* is listed first; everything after it is written in hry: an editor's *go to definition* opens its \
         text, to be looked at and copied (it lies in `crates/hray-lang/std` of hray's source).\n\n## Built in\n",
    );
    let mut group = "";
    for native in NATIVES {
        if native.group != group {
            group = native.group;
            let _ = write!(text, "\n### {group}\n\n");
        }
        let _ = writeln!(text, "- **`{}`** : `{}`  \n  {}", native.name, native.signature, native.doc);
    }
    text.push_str("\n## Written in hry\n");
    for (module, loaded) in standard().modules.iter().enumerate() {
        let _ = write!(text, "\n### {}\n\n", title(&loaded.path));
        for (index, definition) in loaded.syntax.definitions.iter().enumerate() {
            let Some(name) = definition.name().filter(|name| !name.text.starts_with('_')) else { continue };
            let scheme = checked.scheme_of(Global::Definition { module, index }).unwrap_or_default();
            let doc = definition.doc.as_deref().unwrap_or_default().replace('\n', " ");
            let _ = writeln!(text, "- **`{}`** : `{scheme}`  \n  {doc}", name.text);
        }
    }
    text
}

fn title(module: &str) -> String {
    match module {
        "classic" => "Textures of 2005".to_owned(),
        "prelude" => "Numbers, vectors, lists".to_owned(),
        name => {
            let mut letters = name.chars();
            letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
        }
    }
}

/// What is known of a program that says nothing: enough to ask for the library.
#[must_use]
pub fn nothing() -> Checked {
    let mut diagnostics = Vec::new();
    let program = Program::load(
        "scene.hry",
        "scene.hry",
        "scene = {}".into(),
        &[],
        &super::assets::NoAssets,
        &mut diagnostics,
    );
    super::types::check(&program, &mut diagnostics)
}
