//! The lint of surfaces that lie in each other.

use crate::common::{Files, run_with};
use hray_lang::hry::eval::Limits;

/// The warnings of this lint: the text of the places of each, that of the other surface last.
fn warned(text: &str) -> Vec<Vec<String>> {
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, &Limits::default());
    let of_lint = evaluated.diagnostics.iter().filter(|diagnostic| diagnostic.code == "coincident-surfaces");
    let places = |diagnostic: &hray_lang::diagnostic::Diagnostic| {
        let labels = std::iter::once(&diagnostic.primary).chain(&diagnostic.secondary);
        labels.map(|label| program.sources.text(label.span).to_owned()).collect()
    };
    assert!(evaluated.description.is_some(), "{:?}", evaluated.diagnostics);
    of_lint.map(places).collect()
}

const PAINTS: &str = "red = classic { color = #f00 }
blue = classic { color = #00f }
glass = classic { color = #fff, transparency = 0.9 }
pattern = classic { color = \\h -> rgb h.p.x h.p.y 1 }
worldly = classic { color = \\h -> rgb h.world.x 0 1 }
eye = perspective { from = (3, 4, 9), to = (0, 0, 0) }
lamps = [point { position = (0, 9, 9), intensity = 1 }]
";

fn objects(objects: &str) -> Vec<Vec<String>> {
    warned(&format!("{PAINTS}scene = {{ camera = eye, lights = lamps, objects = [{objects}] }}"))
}

fn clean(text: &str) {
    assert_eq!(objects(text), Vec::<Vec<String>>::new(), "{text}");
}

fn told(text: &str) {
    assert_eq!(objects(text).len(), 1, "{text}: {:?}", objects(text));
}

#[test]
fn both_places_are_named() {
    let found = objects("box { size = (2, 1, 2), material = red }, cube { size = 1, material = blue }");
    assert_eq!(found, [["cube { size = 1, material = blue }", "box { size = (2, 1, 2), material = red }"]]);
    // What is made in one place is told once.
    let found = objects(
        "group [box { size = (2, 1, 2), center = (i, 0, 0), material = at (i % 2) [red, blue] } | i <- [0 .. 7]]",
    );
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].len(), 1);
}

#[test]
fn planes_discs_and_ends_of_cylinders() {
    told("plane { material = red }, plane { material = blue }");
    told("plane { material = red }, plane { normal = (0, -1, 0), material = blue } |> translate (1, 0, 3)");
    told("plane { material = red }, disc { radius = 2, material = blue }");
    told(
        "box { size = (1, 1, 1), material = red }, disc { center = (0, 0.5, 0), radius = 0.3, material = blue }",
    );
    told(
        "cylinder { to = (0, 1, 0), radius = 0.5, material = red }, disc { center = (0, 1, 0), radius = 0.3, material = blue }",
    );
    told(
        "cylinder { to = (0, 1, 0), radius = 0.5, material = red }, cylinder { from = (0, 0.3, 0), to = (0, 0.8, 0), radius = 0.5, material = blue }",
    );
    told("disc { radius = 1, material = red }, disc { radius = 2, hole = 0.5, material = blue }");
    clean("disc { radius = 1, material = red }, disc { radius = 2, hole = 1, material = blue }");
    clean("plane { material = red }, plane { offset = 0.001, material = blue }");
    clean("plane { material = red }, plane { normal = (0.001, 1, 0), material = blue }");
    clean(
        "disc { radius = 1, material = red }, disc { radius = 1, center = (2.001, 0, 0), material = blue }",
    );
}

#[test]
fn round_surfaces() {
    told("sphere { material = red }, sphere { material = blue }");
    told("sphere { radius = 2, material = red }, sphere { material = blue } |> rotate up 1 |> scale 2");
    told(
        "sphere { material = red } |> stretch (1, 2, 1), sphere { radius = 2, material = blue } |> stretch (0.5, 1, 0.5)",
    );
    told(
        "torus { radius = 1, tube = 0.2, material = red }, torus { radius = 2, tube = 0.4, material = blue } |> scale 0.5",
    );
    told(
        "cone { to = (0, 2, 0), radius = 1, material = red }, cone { to = (0, 1, 0), radius = 1, top = 0.5, material = blue }",
    );
    clean("sphere { material = red }, sphere { radius = 1.001, material = blue }");
    clean("sphere { material = red } |> stretch (1, 2, 1), sphere { material = blue } |> stretch (2, 1, 1)");
    clean(
        "cylinder { to = (0, 1, 0), radius = 0.5, material = red }, cylinder { from = (0, 1, 0), to = (0, 2, 0), radius = 0.5, material = blue }",
    );
}

/// What stands on something, or beside it, is as it should be.
#[test]
fn what_only_touches_is_not_told() {
    clean("plane { offset = -0.5, material = red }, cube { material = blue }");
    clean("plane { offset = -0.5, material = red }, cube { material = glass }");
    clean("plane { normal = (0, -1, 0), offset = 0.5, material = red }, cube { material = blue }");
    clean("cube { material = red }, cube { material = blue } |> translate (1, 0.3, 0)");
    clean("cube { material = red }, cube { material = blue } |> translate (0, 1, 0)");
    // Two that overlap and stand on one floor: their undersides are not seen.
    clean(
        "box { size = (2, 1, 1), material = red }, box { size = (1, 2, 2), center = (0, 0.5, 0), material = blue }",
    );
    // In a room, something stands against its wall.
    clean(
        "box { size = (30, 30, 30), material = red }, box { size = (2, 2, 2), center = (-14, 0, 0), material = blue }",
    );
    // One is inside of the other, and both are seen.
    told("cube { material = glass }, cube { material = glass } |> translate (0, 1, 0)");
}

#[test]
fn what_looks_the_same_is_not_told() {
    clean("box { size = (2, 1, 2), material = red }, cube { size = 1, material = red }");
    clean("box { size = (2, 1, 2), material = worldly }, cube { material = worldly } |> rotate up 1");
    clean("box { size = (2, 1, 2), material = pattern }, cube { material = pattern }");
    told(
        "box { size = (2, 1, 2), material = pattern }, cube { material = pattern } |> rotate (1, 0, 0) 90deg",
    );
}

#[test]
fn in_solids() {
    let hole = "cylinder { from = (0, -0.5, 0), to = (0, 0.5, 0), radius = 0.2, material = red }";
    // Below and above.
    told(&format!("difference (cube {{ material = red }}) ({hole})"));
    clean(&format!("difference (cube {{ material = red }}) ({hole} |> stretch (1, 1.1, 1))"));
    told(
        "intersection (cube { material = red }) (cube { material = red } |> rotate up 0.3 |> translate (0, 1, 0))",
    );
    clean("union (cube { material = red }) (cube { material = red } |> rotate up 0.3)");
    told("union (cube { material = red }) (cube { material = blue } |> rotate up 0.3)");
    clean(
        "union (cube { material = red }) (cube { material = blue } |> rotate up 0.3 |> translate (0, 1, 0))",
    );
    told(
        "union (cube { material = glass }) (cube { material = glass } |> rotate up 0.3 |> translate (0, 1, 0))",
    );
    // What is cut away flush to the bit leaves nothing.
    clean("difference (cube { material = red }) (box { size = (0.2, 1, 0.2), material = red })");
    clean("difference (cube { material = red }) (inverse (cube { material = red }))");
    told("difference (sphere { material = red }) (sphere { material = red } |> rotate up 1)");
    // Elsewhere it is covered.
    clean(&format!("union (difference (cube {{ material = red }}) ({hole})) (sphere {{ material = red }})"));
    // Between solids.
    told(
        "difference (cube { material = red }) (sphere { radius = 0.2 }), disc { center = (0, 0.5, 0), radius = 0.3, material = blue }",
    );
}

#[test]
fn where_something_is_clipped() {
    told("sphere { material = red } |> clip (sphere { material = blue } |> rotate up 1)");
    // The boundary belongs to the solid, where it is the same to the bit.
    clean("sphere { material = red } |> clip (sphere { material = blue })");
    told("disc { material = red } |> clip (plane {})");
    told(
        "cube { material = red } |> clip (cylinder { from = (0, -0.5, 0), to = (0, 0.5, 0), radius = 0.4 })",
    );
    clean("sphere { material = red } |> clip (cube {})");
    clean("disc { material = red } |> clip (cylinder { from = (0, -1, 0), to = (0, 1, 0), radius = 0.5 })");
    told("disc { material = red } |> clip (cube {}), plane { material = blue }");
    clean("disc { material = red } |> clip (cube {} |> translate up), plane { material = blue }");
}

#[test]
fn a_scene_of_many_objects_is_not_slow() {
    clean(
        "group [cube { size = 0.8, material = red } |> translate (x, 0, z) | x <- [0 .. 199], z <- [0 .. 199]], plane { offset = -0.4, material = blue }",
    );
}

/// The examples are as one would want to find them.
#[test]
fn no_example_is_warned_of() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let is_scene = path.extension().is_some_and(|extension| extension == "hry");
        let Some(text) = std::fs::read_to_string(&path).ok().filter(|_| is_scene) else { continue };
        let (_, evaluated) = run_with(&text, &Files::default(), 0.5, &Limits::default());
        let found: Vec<_> = evaluated
            .diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.code == "coincident-surfaces")
            .collect();
        assert!(found.is_empty(), "{}: {found:#?}", path.display());
    }
}
