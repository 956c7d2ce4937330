//! The library: every part of it works, is documented, and stands in the reference as it is.

use crate::common::{material, scene};
use hray_lang::hry::library::CONSTRUCTORS;
use hray_lang::hry::program::standard;
use hray_lang::hry::reference;
use std::path::Path;

#[test]
fn every_definition_of_the_library_has_a_type_and_documentation() {
    for module in &standard().modules {
        for definition in &module.syntax.definitions {
            let name = definition.name().unwrap().text;
            if !name.starts_with('_') {
                assert!(
                    definition.doc.is_some() && definition.annotation.is_some(),
                    "{name} in {}",
                    module.path
                );
            }
        }
    }
}

#[test]
fn every_example_of_a_constructor_makes_a_scene() {
    for constructor in CONSTRUCTORS {
        let example = constructor.example;
        scene(&match constructor.name {
            "scene" => example.to_owned(),
            "perspective" | "orthographic" | "window" => format!("scene = {{ camera = {example} }}"),
            "classic" => format!("scene = {{ objects = [sphere {{ material = {example} }}] }}"),
            "point" | "ambient" | "directional" | "spotlight" => {
                format!("scene = {{ lights = [{example}] }}")
            }
            _ => format!("scene = {{ objects = [{example}] }}"),
        });
    }
}

#[test]
fn every_pattern_is_a_colour() {
    for pattern in [
        "by (\\p -> rgb p.x p.y p.z)",
        "rampX [red, white, blue]",
        "rampY [red, white]",
        "rampRadial [red, white]",
        "rampAngle [red, white]",
        "checker red white",
        "tiles { a = red, b = white, joint = grey 0.2, gap = 0.05 }",
        "stripes red white",
        "waves red white",
        "rings red white",
        "spiral 3 red white",
        "dots 0.3 red white",
        "brick red white",
        "hexagon red white blue",
        "wood { light = orange, dark = brown, rings = 8, grain = 0.2 }",
        "marble { color = white, vein = ink, bend = 3 }",
        "agate { colors = [red, orange, white], bend = 0.5 }",
        "granite { a = grey 0.2, b = grey 0.6, c = white }",
        "cracked ivory ink 0.05",
        "mosaic [red, green, blue]",
        "clouds sky white",
        "fire",
        "by (warp 0.5 (\\p -> mix red white (noise p)))",
        "imageMap (image \"a.png\")",
        "imageOn (image \"a.png\")",
    ] {
        material("", &format!("color = {pattern}"));
    }
    for bump in ["ripples 0.1", "wrinkles 0.1", "bumps 0.1", "dents 0.1", "scale 0.1 (dents 0.2)"] {
        assert!(material("", &format!("bump = {bump}")).bump.is_some(), "{bump}");
    }
}

/// `HRAY_BLESS=1` writes the chapters anew.
#[test]
fn the_reference_is_what_the_tables_say() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference");
    let chapters = [
        ("constructors.md", reference::constructors()),
        ("library.md", reference::library(&reference::nothing())),
    ];
    for (name, text) in chapters {
        let path = folder.join(name);
        if std::env::var_os("HRAY_BLESS").is_some() {
            std::fs::write(&path, &text).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(found == text, "{name} is out of date; HRAY_BLESS=1 cargo test -p hray-lang writes it");
    }
}
