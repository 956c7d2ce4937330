//! From the value of `scene` to a description.

use crate::common::{Files, errors, run_with, scene, shown};
use hray_core::{Background, Camera, CsgOperation, DVec3, Encoding, Integrator, Light, Rgb, Shape, Texture};
use hray_lang::hry::Program;
use hray_lang::hry::eval::{Evaluator, Limits};
use std::collections::BTreeMap;

#[test]
fn defaults() {
    let description = scene("scene = {}");
    assert_eq!((description.resolution.width(), description.resolution.height()), (800, 600));
    assert_eq!((description.max_depth, description.samples.get()), (5, 16));
    assert_eq!((description.integrator, description.encoding), (Integrator::Classic, Encoding::Srgb));
    assert!(matches!(description.scene.camera, Camera::Perspective(_)));
    assert_eq!(description.scene.background, Background::Uniform(Rgb::BLACK));
}

#[test]
fn everything_a_classic_file_says_can_be_said() {
    let description = scene(
        "scene = { size = (40, 30), depth = -1, samples = 1, integrator = classic2005, encoding = raw,
           camera = window { eye = (0, 0, 150), size = (100, 75) }, background = rgb 0.1 0.2 1.5 }",
    );
    assert_eq!((description.max_depth, description.samples.get()), (-1, 1));
    assert_eq!((description.integrator, description.encoding), (Integrator::Classic2005, Encoding::Raw));
    assert_eq!(description.scene.background, Background::Uniform(Rgb::new(0.1, 0.2, 1.5)));
}

#[test]
fn colours_are_decoded_to_linear_light() {
    let description = scene("scene = { background = #ff8000 }");
    let Background::Uniform(color) = description.scene.background else { panic!() };
    assert_eq!((color.r, color.b), (1.0, 0.0));
    assert!((color.g - 0.2158605).abs() < 1e-6, "{}", color.g);
}

#[test]
fn the_innermost_paint_wins_and_groups_are_flat() {
    let description = scene(
        "own = sphere { material = classic { color = rgb 1 0 0 } }\nscene = { objects = [group [own, sphere {}, group [cube {}]]
           |> paint (classic { color = rgb 0 1 0 }) |> paint (classic { color = rgb 0 0 1 })] }",
    );
    let colors: Vec<_> = description.scene.primitives.iter().map(|p| p.material.texture.clone()).collect();
    let solid = |r, g, b| Texture::Solid(Rgb::new(r, g, b));
    assert_eq!(colors, [solid(1.0, 0.0, 0.0), solid(0.0, 1.0, 0.0), solid(0.0, 1.0, 0.0)]);
}

#[test]
fn transforms_compose_in_the_order_they_are_written() {
    let description =
        scene("scene = { objects = [sphere {} |> translate (1, 0, 0) |> rotate up 90deg |> scale 2] }");
    let transform = description.scene.primitives[0].transform.as_ref().unwrap();
    let center = transform.transform_point3(DVec3::ZERO);
    assert_eq!(center, DVec3::new(0.0, 0.0, -2.0));
}

#[test]
fn lights_and_cameras_move_too() {
    let description = scene(
        "scene = { lights = [translate (0, 1, 0) (point { position = (1, 2, 3), intensity = 0.5 })],
                   camera = perspective { from = (0, 0, 5) } |> rotate up 90deg }",
    );
    let Light::Point { position, intensity } = description.scene.lights[0] else { panic!() };
    assert_eq!((position, intensity), (DVec3::new(1.0, 3.0, 3.0), Rgb::new(0.5, 0.5, 0.5)));
    let Camera::Perspective(camera) = description.scene.camera else { panic!() };
    assert_eq!(camera.from, DVec3::new(5.0, 0.0, 0.0));
}

#[test]
fn solids_of_groups_are_unions() {
    let description = scene(
        "scene = { objects = [difference (cube { size = 2 }) (group [sphere {}, sphere { radius = 0.5 }])] }",
    );
    let Shape::Csg(csg) = &description.scene.primitives[0].shape else { panic!() };
    assert_eq!(csg.operation, CsgOperation::Difference);
    let Shape::Csg(cut) = &csg.operands[1].shape else { panic!() };
    assert_eq!(cut.operation, CsgOperation::Union);
}

#[test]
fn nothing_cuts_nothing() {
    let count = |objects: &str| scene(&format!("scene = {{ objects = [{objects}] }}")).scene.primitives.len();
    assert_eq!(count("difference (sphere {}) (group [])"), 1);
    assert_eq!(count("intersection (sphere {}) (group [])"), 0);
    assert_eq!(count("union (group []) (sphere {})"), 1);
    // What is not nothing is everything.
    assert_eq!(count("intersection (sphere {}) (inverse (group []))"), 1);
    assert_eq!(count("clip (group []) (sphere {})"), 0);
    assert_eq!(count("clip (sphere {}) (group [])"), 0);
}

#[test]
fn an_inverse_is_of_the_union_of_a_group() {
    let description = scene("scene = { objects = [inverse (group [sphere {}, cube {}]) |> translate up] }");
    let primitive = &description.scene.primitives[0];
    let Shape::Inverse(solid) = &primitive.shape else { panic!() };
    assert!(matches!(&solid.shape, Shape::Csg(csg) if csg.operation == CsgOperation::Union));
    assert_eq!(primitive.transform.as_ref().unwrap().translation, DVec3::Y);
}

#[test]
fn each_of_a_group_is_clipped_by_itself() {
    let text =
        "scene = { objects = [group [disc {}, sphere { radius = 2 } |> translate up] |> clip (cube {})] }";
    let description = scene(text);
    let [a, b] = &description.scene.primitives[..] else { panic!() };
    let (Shape::Clip(a), Shape::Clip(b)) = (&a.shape, &b.shape) else { panic!() };
    assert!(matches!(a.shape.shape, Shape::Disc(_)) && matches!(b.shape.shape, Shape::Sphere(_)));
    assert!([a, b].iter().all(|clip| matches!(clip.within.shape, Shape::Cuboid(_))));
    assert_eq!(b.shape.transform.as_ref().unwrap().translation, DVec3::Y);
}

/// A part of a solid, or of what is clipped, may be what gives light.
#[test]
fn parts_that_glow_are_lights() {
    let warnings = |object: &str| {
        let text = format!(
            "lamp = sphere {{ material = classic {{ color = black, glow = white }} }}\nscene = {{ objects = [{object}] }}"
        );
        run_with(&text, &Files::default(), 0.0, &Limits::default()).1.diagnostics.len()
    };
    assert_eq!(warnings("lamp |> clip (plane {})"), 0);
    assert_eq!(warnings("difference (cube {}) (lamp |> translate up)"), 0);
    assert_eq!(warnings("difference (cube {}) (sphere {} |> translate up)"), 1);
}

#[test]
fn what_is_clipped_has_no_inside() {
    let refused = |objects: &str, expected: &str| {
        let errors = errors(&format!("scene = {{ objects = [{objects}] }}"));
        assert!(errors.contains("cannot be part of a solid") && errors.contains(expected), "{errors}");
    };
    refused("sphere {} |> clip (plane {}) |> inverse", "something that is clipped is in it");
    refused(
        "union (sphere {}) (group [sphere {} |> clip (cube {})])",
        "something that is clipped is in one of the two",
    );
    refused("clip (disc {}) (sphere {})", "a disc or something open is in what it is clipped by");
    refused("inverse (disc {})", "a disc or something open is in it");
}

#[test]
fn a_scene_may_be_a_function_of_the_time() {
    let text = "still = sum [1 .. 100]\nscene t = { objects = [sphere { radius = still + t, material = classic { reflection = \\h -> h.time * h.p.x } }] }";
    let mut diagnostics = Vec::new();
    let files = Files::default();
    let program = Program::load("scene.hry", "scene.hry", text.into(), &[], &files, &mut diagnostics);
    let mut evaluator = Evaluator::new(&program, &files, &Limits::default());
    for time in [0.0, 1.5] {
        let evaluated = evaluator.at(time);
        assert!(evaluated.animated);
        let description = evaluated.description.unwrap();
        let Shape::Sphere(sphere) = &description.scene.primitives[0].shape else { panic!() };
        assert_eq!((sphere.radius, description.scene.time), (5050.0 + time, time));
    }
}

#[test]
fn imports_bring_names_in() {
    let files = Files(BTreeMap::from([
        ("lib/colors.hry", "import \"base.hry\" as base\nwarm = base.hot\nhidden = 3"),
        ("lib/base.hry", "hot = rgb 1 0.5 0"),
        ("all.hry", "radius = 7"),
    ]));
    let text = "import \"lib/colors.hry\" (warm)\nimport \"all.hry\"\nimport \"lib/base.hry\" as b\nscene = { objects = [sphere { radius = radius, material = classic { color = warm } }], background = b.hot }";
    let (program, evaluated) = run_with(text, &files, 0.0, &Limits::default());
    let description =
        evaluated.description.unwrap_or_else(|| panic!("{}", shown(&program, &evaluated.diagnostics)));
    assert_eq!(description.scene.background, Background::Uniform(Rgb::new(1.0, 0.5, 0.0)));
}

#[test]
fn imports_in_a_circle_and_outside_are_refused() {
    let files =
        Files(BTreeMap::from([("a.hry", "import \"b.hry\"\nx = 1"), ("b.hry", "import \"a.hry\"\ny = 1")]));
    let (program, evaluated) =
        run_with("import \"a.hry\"\nimport \"../up.hry\"\nscene = {}", &files, 0.0, &Limits::default());
    let text = shown(&program, &evaluated.diagnostics);
    assert!(
        text.contains("a.hry -> b.hry -> a.hry") && text.contains("leads out of the root folder"),
        "{text}"
    );
}

#[test]
fn definitions_are_set_from_outside() {
    let mut diagnostics = Vec::new();
    let set = [("n".to_owned(), "2 + 3".to_owned())];
    let files = Files::default();
    let text = "n = 1\nscene = { objects = [sphere { radius = i } | i <- [1 .. n]] }";
    let program = Program::load("scene.hry", "scene.hry", text.into(), &set, &files, &mut diagnostics);
    let evaluated = hray_lang::hry::eval::evaluate(&program, &files, 0.0, &Limits::default());
    assert_eq!(evaluated.description.unwrap().scene.primitives.len(), 5);
}

/// Equal materials are compiled once and shared.
#[test]
fn a_material_is_compiled_once() {
    let description = scene(
        "m = classic { color = \\h -> rgb h.p.x 0 0 }\nscene = { objects = [sphere { material = m } | i <- [1 .. 3]] }",
    );
    let [a, b, _] = &description.scene.primitives[..] else { panic!() };
    assert!(std::sync::Arc::ptr_eq(&a.material, &b.material));
}
