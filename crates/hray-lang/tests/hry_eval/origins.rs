//! From objects and lights back to the text that made them.

use crate::common::{Files, run_with, shown};
use hray_lang::hry::Program;
use hray_lang::hry::eval::{Evaluated, Evaluator, Limits, Origin};

fn run(text: &str) -> (Program, Evaluated) {
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, &Limits::default());
    assert!(evaluated.description.is_some(), "{}", shown(&program, &evaluated.diagnostics));
    (program, evaluated)
}

fn text(program: &Program, origin: Option<Origin>) -> String {
    program.sources.text(origin.unwrap().span).to_owned()
}

#[test]
fn objects_and_lights_know_the_calls_that_made_them() {
    let (program, evaluated) = run("ball = sphere { radius = 2 }
scene = { objects = [cube {} |> translate (1, 0, 0) |> paint (classic {}), group [ball, box { size = (1, 2, 3) }] |> scale 2],
          lights = [point { position = (1, 2, 3) } |> translate (1, 0, 0), ambient {}] }");
    let made = |object| text(&program, evaluated.origins.object(object));
    assert_eq!([made(0), made(1), made(2)], ["cube {}", "sphere { radius = 2 }", "box { size = (1, 2, 3) }"]);
    let lights = [0, 1].map(|light| text(&program, evaluated.origins.light(light)));
    assert_eq!(lights, ["point { position = (1, 2, 3) }", "ambient {}"]);
    assert!(evaluated.origins.object(3).is_none() && evaluated.origins.light(2).is_none());
    assert!(evaluated.origins.part(0, 0).is_none());
}

#[test]
fn the_calls_that_led_there_are_known() {
    let (program, evaluated) = run("ball r = sphere { radius = r }
row n = [ball i | i <- [1..n]]
scene = { objects = row 2 ++ [ball 7] }");
    let calls = |object: usize| {
        let origin = evaluated.origins.object(object).unwrap();
        origin.calls.iter().map(|call| program.sources.text(*call).to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(calls(0), ["ball i", "row 2"]);
    assert_eq!(calls(1), ["ball i", "row 2"]);
    assert_eq!(calls(2), ["ball 7"]);
}

/// A definition is worked out where it is needed first, which has nothing to do with it.
#[test]
fn definitions_are_not_called_by_who_needs_them_first() {
    let (_, evaluated) = run("ball = sphere {}\npick x = ball\nscene = { objects = [pick 1] }");
    assert_eq!(evaluated.origins.object(0).unwrap().calls, []);
}

#[test]
fn solids_know_their_parts() {
    let (program, evaluated) = run("hole = sphere { radius = 0.5 }
two = group [sphere {}, group [cube {}, sphere { radius = 3 }]]
scene = { objects = [sphere { radius = 9 }, difference two (hole |> translate (1, 0, 0)), union (group []) hole] }");
    assert_eq!(text(&program, evaluated.origins.object(1)), "difference two (hole |> translate (1, 0, 0))");
    let parts: Vec<String> = (0..4).map(|part| text(&program, evaluated.origins.part(1, part))).collect();
    assert_eq!(parts, ["sphere {}", "cube {}", "sphere { radius = 3 }", "sphere { radius = 0.5 }"]);
    assert!(evaluated.origins.part(1, 4).is_none());
    // Nothing and something is the something.
    assert_eq!(text(&program, evaluated.origins.object(2)), "sphere { radius = 0.5 }");
}

#[test]
fn what_is_clipped_knows_its_parts() {
    let (program, evaluated) = run("hole = sphere { radius = 0.5 }
scene = { objects = [clip (inverse hole) (group [cube {}, union (sphere {}) hole])] }");
    for object in 0..2 {
        assert_eq!(text(&program, evaluated.origins.object(object)).split(' ').next(), Some("clip"));
    }
    let parts = |object| -> Vec<String> {
        let parts = (0..9).map_while(|part| evaluated.origins.part(object, part));
        parts.map(|origin| text(&program, Some(origin))).collect()
    };
    assert_eq!(parts(0), ["cube {}", "sphere { radius = 0.5 }"]);
    assert_eq!(parts(1), ["(sphere {})", "sphere { radius = 0.5 }", "sphere { radius = 0.5 }"]);
}

#[test]
fn what_is_kept_from_moment_to_moment_keeps_its_place() {
    let text =
        "still = sphere { radius = 4 }\nscene t = { objects = if t > 1 then [cube {}, still] else [still] }";
    let mut diagnostics = Vec::new();
    let files = Files::default();
    let program = Program::load("scene.hry", "scene.hry", text.into(), &[], &files, &mut diagnostics);
    let mut evaluator = Evaluator::new(&program, &files, &Limits::default());
    let made = |evaluated: Evaluated, object| self::text(&program, evaluated.origins.object(object));
    assert_eq!(made(evaluator.at(0.0), 0), "sphere { radius = 4 }");
    let later = evaluator.at(2.0);
    assert_eq!([made(later.clone(), 0), made(later, 1)], ["cube {}", "sphere { radius = 4 }"]);
}

/// Every object of every example has a place, and every solid as many as it has parts.
#[test]
fn everything_in_the_examples_has_a_place() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let mut solids = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let Some(text) =
            std::fs::read_to_string(&path).ok().filter(|_| path.extension().is_some_and(|e| e == "hry"))
        else {
            continue;
        };
        let (program, evaluated) = run_with(&text, &Files::default(), 0.0, &Limits::default());
        // Some want files.
        let Some(description) = evaluated.description else { continue };
        for (i, primitive) in description.scene.primitives.iter().enumerate() {
            let origin = evaluated.origins.object(i).unwrap();
            assert!(!program.sources.text(origin.span).is_empty(), "{}: object {i}", path.display());
            if primitive.shape.is_made_of_others() {
                solids += 1;
                let parts = primitive.leaves().count();
                assert!(
                    (0..parts).all(|part| evaluated.origins.part(i, part).is_some()),
                    "{}",
                    path.display()
                );
                assert!(evaluated.origins.part(i, parts).is_none(), "{}", path.display());
            }
        }
        assert!((0..description.scene.lights.len()).all(|i| evaluated.origins.light(i).is_some()));
    }
    assert!(solids > 3, "{solids}");
}
