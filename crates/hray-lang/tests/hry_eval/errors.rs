//! Errors that only the values show, as a newcomer sees them.

use crate::common::{Files, errors, run_with, shown};
use hray_lang::hry::eval::Limits;
use insta::assert_snapshot;

macro_rules! mistakes {
    ($($name:ident: $text:expr;)+) => {$(
        #[test]
        fn $name() {
            assert_snapshot!(stringify!($name), errors($text));
        }
    )+};
}

/// Scenes that are rendered all the same.
macro_rules! oddities {
    ($($name:ident: $text:expr;)+) => {$(
        #[test]
        fn $name() {
            let (program, evaluated) = run_with($text, &Files::default(), 0.0, &Limits::default());
            assert!(evaluated.description.is_some());
            assert_snapshot!(stringify!($name), shown(&program, &evaluated.diagnostics));
        }
    )+};
}

oddities! {
    no_objects: "scene = { lights = [ambient {}] }";
    no_lights: "scene = { objects = [sphere {}] }";
    light_in_a_sphere: "scene = { lights = [point { position = (0, 5, 0) }], objects = [sphere {}, sphere { radius = 2 } |> translate (0, 5, 0)] }";
    camera_in_a_sphere: "scene = { lights = [point { position = (9, 9, 9) }], objects = [sphere { radius = 8 }] }";
    surface_that_is_nowhere: "scene = { lights = [ambient {}], objects = [implicit { function = \\p -> length p + 1 }] }";
    surface_outside_of_its_box: "scene = { lights = [ambient {}], objects = [implicit { function = \\p -> length p - 9, size = (2, 2, 2) }] }";
    surface_that_jumps: "scene = { lights = [ambient {}], objects = [implicit { function = \\p -> p.y - tan p.x, size = (4, 4, 4) }] }";
    surface_with_poles: "scene = { lights = [ambient {}], objects = [implicit { function = \\p -> 1 / p.x + p.y, size = (4, 4, 4) }] }";
    coincident_objects: "scene = { lights = [ambient {}], objects = [plane { material = classic { color = gold } }, disc {}] }";
    coincident_in_solids: "hole = cylinder { from = (0, -0.5, 0), to = (0, 0.5, 0), radius = 0.2 }
scene = {
  lights = [ambient {}],
  objects = [
    difference (cube {}) hole,
    union (cube {}) (cube { material = classic { color = gold } } |> rotate up 1) |> translate (3, 0, 0),
    disc {} |> clip (plane {}) |> translate (-3, 0, 0),
  ],
}";
    depth_of_nothing: "scene = { depth = -1, lights = [ambient {}], objects = [sphere {}] }";
    negative_shine: "s = 2 - 5\nscene = { lights = [ambient {}], objects = [sphere { material = classic { shine = s, ior = s, reflection = 0.1, transparency = 0.5 } }] }";
}

mistakes! {
    needs_itself: "a = b + 1\nb = a * 2\nscene = { objects = [sphere { radius = a }] }";
    size_worked_out_to_be_negative: "r = 1 - 3\nscene = { objects = [cube { size = r }] }";
    radius_not_a_number: "scene = { objects = [sphere { radius = 0 / 0.0 + 1 }] }";
    root_of_a_negative_number: "scene = { objects = [sphere { radius = sqrt (0 - 1) }] }";
    infinite: "scene = { objects = [sphere { radius = exp 1000 }] }";
    cylinder_of_no_length: "scene = { objects = [cylinder { from = (0, 1, 0) }] }";
    thick_torus: "scene = { objects = [torus { radius = 1, tube = 2 }] }";
    quadric_of_nothing: "scene = { objects = [quadric { constant = 3 }] }";
    surface_without_end: "scene = { objects = [implicit { function = \\p -> p.y - sin p.x }] }";
    surface_that_may_have_no_end: "scene = { objects = [implicit { function = \\p -> length p - 1 / p.x }] }";
    surface_inside_out: "scene = { objects = [implicit { function = \\p -> 1 - length p }] }";
    surface_of_a_constant: "scene = { objects = [implicit { function = \\_ -> 3 }] }";
    surface_that_is_flat_to_its_box: "scene = { objects = [implicit { function = \\p -> length p - 1, size = (2, 0, 2) }] }";
    disc_in_a_solid: "scene = { objects = [difference (sphere {}) (disc {})] }";
    size_not_whole: "w = 640 / 7\nscene = { size = (w, 480) }";
    angle_without_deg: "a = 60\nscene = { camera = perspective { from = (0, 0, 5), fov = a } }";
    no_such_element: "scene = { objects = [sphere { radius = at 3 [1, 2, 3] }] }";
    error_in_a_function: "pick i = at i [1, 2]\n\nring n = [sphere { radius = pick i } | i <- [0 .. n]]\n\nscene = { objects = ring 4 }";
    camera_looks_at_itself: "scene = { camera = perspective { from = (0, 1, 0), to = (0, 1, 0) } }";
    camera_looks_along_up: "scene = { camera = perspective { from = (0, 5, 0), to = (0, 0, 0) } }";
    length_depends_on_hit: "f h = count [i | i <- [0 .. h.p.x]]\nscene = { objects = [sphere { material = classic { reflection = f } }] }";
    text_depends_on_hit: "f h = if (if h.p.x > 0 then \"a\" else \"b\") == \"a\" then 1 else 0\nscene = { objects = [sphere { material = classic { reflection = f } }] }";
    seed_not_whole: "scene = { objects = [sphere { radius = 2 + perlin 0.5 (1, 2, 3) }] }";
    noise_of_1985_outside: "scene = { objects = [sphere { radius = 2 + perlin1985 0 (1, 2, 3) }] }";
    flat: "scene = { objects = [sphere {} |> stretch (1, 0, 1)] }";
    axis_of_zero: "scene = { objects = [sphere {} |> rotate (0, 0, 0) 30deg] }";
    flat_after_a_variable: "by = 0\nscene = { objects = [sphere {} |> translate up |> scale by] }";
    flat_call: "scene = { objects = [stretch (0, 2, 0) (sphere {})] }";
    flat_matrix: "scene = { objects = [sphere {} |> matrix { x = right, y = right, z = up, origin = (0, 0, 0) }] }";
    flat_in_a_function: "thin n shape = shape |> scale n\nscene = { objects = [sphere {} |> thin 0] }";
    moved_window: "scene = { camera = translate (1, 0, 0) (window { eye = (0, 0, 9), size = (4, 3) }) }";
    range_without_steps: "scene = { objects = [sphere { radius = sum [1, 1 .. 5] }] }";
    slope_of_a_loop: "f h = iterate 9 (\\x -> x > h.p.y) (\\x -> x * 2) h.p.x\nscene = { objects = [sphere { material = classic { bump = f } }] }";
    image_outside: "scene = { objects = [sphere { material = classic { color = imageMap (image \"../secret.png\") } }] }";
    image_missing: "scene = { objects = [sphere { material = classic { color = imageMap (image \"moon.jpg\") } }] }";
}

/// A sphere around the light and around where rays start is a room.
#[test]
fn a_room_is_no_mistake() {
    for camera in [
        "perspective { from = (0, 0, 1) }",
        "orthographic { from = (0, 0, 1) }",
        "window { eye = (0, 0, 9), size = (4, 3) }",
    ] {
        let text = format!(
            "scene = {{ camera = {camera}, lights = [point {{ position = (0, 2, 0) }}], objects = [sphere {{ radius = 20 }}] }}"
        );
        let (_, evaluated) = run_with(&text, &Files::default(), 0.0, &Limits::default());
        assert!(evaluated.description.is_some());
        assert_eq!(evaluated.diagnostics, [], "{camera}");
    }
}

#[test]
fn warnings_about_values_do_not_stop_the_scene() {
    let text = "share = 3 / 2\nscene = { objects = [sphere { material = classic { reflection = share } }] }";
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, &Limits::default());
    assert!(evaluated.description.is_some());
    assert_snapshot!("a_share_beyond_one", shown(&program, &evaluated.diagnostics));
}
