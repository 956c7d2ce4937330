//! What a user sees of what is legal but was surely meant otherwise.

use crate::common::{Files, checked, shown, with_scene};
use hray_lang::diagnostic::{Diagnostic, render};
use hray_lang::hry::types::LINTS;
use insta::assert_snapshot;

#[test]
fn of_definitions_beside_a_scene() {
    for (name, text) in [
        ("unused_definition", "ball = sphere {}\n_other = cube {}\nbig = ball |> scale 2"),
        ("unused_local", "_a = let x = 1\n         y = 2\n     in y"),
        ("shadowing", "size = 1\n_f size = size + 1\n_g x = \\x -> x + size"),
        ("unreachable", "_f x = match x { 0 -> 1, other -> other, 2 -> 3 }"),
        ("constant_condition", "_a = if true then 1 else 2"),
        ("division_by_zero", "_a = 1 / 0\n_b = 5 % 0"),
        ("share", "_a = classic { reflection = 2, transparency = -0.1 }"),
        (
            "negative_light",
            "_a = ambient { intensity = -1 }\n_b = point { position = (0, 0, 0), intensity = rgb 1 -1 0 }",
        ),
    ] {
        assert_snapshot!(name, shown(&with_scene(text)));
    }
}

#[test]
fn of_imports() {
    const FILES: Files = Files(&[("palette.hry", "gold = #ffd700\nink = #101820\nunused = 1\n")]);
    for (name, text) in [
        ("import_all", "import \"palette.hry\"\n"),
        ("import_listed", "import \"palette.hry\" (gold, ink)\n_a = gold\n"),
        ("import_as", "import \"palette.hry\" as p\n"),
    ] {
        let text = with_scene(text);
        let (_, _, diagnostics) = checked(&text, &FILES);
        assert_snapshot!(name, render(&diagnostics, "scene.hry", &text, false));
    }
    for text in [
        "import \"palette.hry\"\n_a = gold",
        "import \"palette.hry\" (gold)\n_a = gold",
        "import \"palette.hry\" as p\n_a = p.gold",
    ] {
        let (_, _, diagnostics) = checked(&with_scene(text), &FILES);
        assert_eq!(diagnostics, [], "{text}");
    }
}

#[test]
fn names_of_an_import_that_it_does_not_have() {
    const FILES: Files = Files(&[("palette.hry", "gold = #ffd700\nink = #101820\n")]);
    let text = with_scene("import \"palette.hry\" as p\n_a = p.glod\n_b = gold");
    let (_, _, diagnostics) = checked(&text, &FILES);
    assert_snapshot!("qualified", render(&diagnostics, "scene.hry", &text, false));
}

#[test]
fn a_sensible_scene_gives_none() {
    let text = "\
tiles h = if odd (floor h.p.x + floor h.p.z) then black else #f4efe6

veined size h =
  let q    = h.p / size
      vein = sin (q.x * 4 + 6 * turbulence 8 q)
  in mix white #1d3b53 (vein / 2 + 0.5)

ring n radius shape =
  [ shape |> translate (radius * cos a, 0, radius * sin a)
  | i <- [0 .. n - 1], let a = turn * i / n ]

ball = sphere { radius = 0.4, center = (0, 0.4, 0), material = classic { color = #ffd700, reflection = 0.6, shine = 80 } }

scene t = {
  size    = (1280, 720),
  camera  = perspective { from = (0, 3, 7), to = (0, 0.5, 0), fov = 35deg },
  background = #cfe3ff,
  lights  = [ point { position = (4, 6, 3), intensity = 0.8 }, ambient { intensity = 0.1 } ],
  objects = [ plane { normal = up, material = classic { color = tiles } }
            , difference (cube { size = 1.2 }) (sphere { radius = 0.75 })
                |> paint (classic { color = veined 0.5 })
                |> rotate up (turn * t) |> translate (0, 0.6, 0) ]
         ++ ring 12 2.4 ball,
}
";
    assert_eq!(shown(text), "");
}

#[test]
fn every_warning_has_its_explanation() {
    assert!(LINTS.is_sorted_by(|a, b| a.code < b.code));
    let kebab = |c: char| c.is_ascii_lowercase() || c == '-';
    assert!(LINTS.iter().all(|lint| lint.code.chars().all(kebab)));
    let text = with_scene(
        "a = 1\n_b = if true then 1 / 0 else let c = 2 in 3\n_f c = \\c -> match c { _ -> 1, 1 -> 2 }\n_d = classic { reflection = 2 }\n_e = ambient { intensity = -1 }",
    );
    let (_, _, diagnostics) = checked(&text, &Files(&[]));
    assert!(diagnostics.iter().all(|diagnostic| !diagnostic.is_error()), "{diagnostics:#?}");
    let known = |diagnostic: &Diagnostic| LINTS.iter().any(|lint| lint.code == diagnostic.code);
    assert!(diagnostics.iter().all(known), "{diagnostics:#?}");
    assert!(diagnostics.len() >= 7, "{diagnostics:#?}");
}
