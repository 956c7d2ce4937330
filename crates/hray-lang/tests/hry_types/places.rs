//! What an editor asks of places.

use crate::common::{Files, checked};
use hray_lang::diagnostic::Span;
use hray_lang::hry::types::Target;

const TEXT: &str = "\
size = 2
tiles h = let q = h.p / size in mix white black q.x
ball r = sphere { radius = r, center = (0, size, 0) }
scene = { objects = [ ball 1 |> paint (classic { color = tiles }) ] }
";

/// The offset of the n-th occurrence of a piece of text.
fn at(piece: &str, n: usize) -> usize {
    TEXT.match_indices(piece).nth(n).map_or(usize::MAX, |(offset, _)| offset)
}

#[test]
fn types() {
    let (_, checked, diagnostics) = checked(TEXT, &Files(&[]));
    assert_eq!(diagnostics, []);
    let type_at =
        |offset| checked.type_at(offset).map(|(span, ty)| (span.text(TEXT).to_owned(), ty)).unwrap();
    let pair = |text: &str, ty: &str| (text.to_owned(), ty.to_owned());
    assert_eq!(type_at(at("size", 0)), pair("size", "Number"));
    assert_eq!(type_at(at("tiles", 0)), pair("tiles", "Hit -> Color"));
    assert_eq!(type_at(at("h ", 0)), pair("h", "Hit"));
    assert_eq!(type_at(at("q = ", 0)), pair("q", "Vec3"));
    assert_eq!(type_at(at("h.p", 0)), pair("h", "Hit"));
    assert_eq!(type_at(at("mix", 0)), pair("mix", "Color -> Color -> Number -> Color"));
    assert_eq!(type_at(at("sphere", 0)), pair("sphere", "Shape"));
    assert_eq!(type_at(at("tiles", 1)), pair("tiles", "Hit -> Color"));
}

#[test]
fn definitions_and_references() {
    let (_, checked, _) = checked(TEXT, &Files(&[]));
    let places = |offset| {
        let target = checked.definition_at(offset).unwrap();
        checked.references(&target).iter().map(|span| span.start).collect::<Vec<_>>()
    };
    assert_eq!(places(at("size", 0)), [at("size", 0), at("size", 1), at("size", 2)]);
    assert_eq!(places(at("size", 2)), places(at("size", 0)));
    assert_eq!(places(at("r = sphere", 0)), [at("r = sphere", 0), at("r, center", 0)]);
    assert_eq!(places(at("r, center", 0)), [at("r = sphere", 0), at("r, center", 0)]);
    assert_eq!(places(at("q.x", 0)), [at("q = ", 0), at("q.x", 0)]);
    assert!(
        matches!(checked.definition_at(at("radius", 0)), Some(Target::Field(c, f)) if c.name == "sphere" && f.name == "radius")
    );
    assert!(matches!(checked.definition_at(at("mix", 0)), Some(Target::Global(_))));
    assert!(checked.definition_at(at("= 2", 0)).is_none());
}

#[test]
fn completion() {
    let (_, checked, _) = checked(TEXT, &Files(&[]));
    let fields: Vec<String> =
        checked.completion_at(at("p / size", 0)).fields.into_iter().map(|(name, _)| name).collect();
    assert_eq!(fields, ["p", "world", "normal", "uv", "time"]);
    let inside = checked.completion_at(at("radius", 0));
    let (constructor, given) = inside.record.unwrap();
    assert_eq!((constructor.name, given), ("sphere", vec!["radius", "center"]));
    assert_eq!(inside.locals, [("r".to_owned(), "Number".to_owned())]);
    let names: Vec<String> =
        checked.completion_at(at("mix", 0)).locals.into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["q", "h"]);
}

#[test]
fn definitions_of_other_files() {
    const FILES: Files = Files(&[("palette.hry", "gold = #ffd700\n")]);
    let text = "import \"palette.hry\" (gold)\nscene = { background = gold }\n";
    let (_, checked, _) = checked(text, &FILES);
    let target = checked.definition_at(text.rfind("gold").unwrap()).unwrap();
    let places = checked.references(&target);
    let base = text.len() + 1;
    let here = |offset: usize| Span::new(offset, offset + 4);
    assert_eq!(places, [here(text.find("gold").unwrap()), here(text.rfind("gold").unwrap()), here(base)]);
}
