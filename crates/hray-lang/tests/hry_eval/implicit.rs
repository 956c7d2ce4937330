//! Implicit surfaces: their functions, the boxes that are found for them, and the library of distances.

use crate::common::scene;
use glam::DVec3;
use hray_core::{Implicit, NoiseTables, Shape};
use hray_expr::Input;
use std::sync::Arc;

fn surfaces(definitions: &str, objects: &str) -> Vec<Arc<Implicit>> {
    let primitives = scene(&format!("{definitions}\nscene = {{ objects = [{objects}] }}")).scene.primitives;
    let surface = |primitive: &hray_core::Primitive| match &primitive.shape {
        Shape::Implicit(surface) => surface.clone(),
        other => panic!("{other:?}"),
    };
    primitives.iter().map(surface).collect()
}

fn surface(object: &str) -> Arc<Implicit> {
    surfaces("", object).remove(0)
}

fn value(surface: &Implicit, p: [f64; 3]) -> f64 {
    let mut inputs = [0.0; Input::COUNT];
    inputs[..3].copy_from_slice(&p);
    surface.function.evaluate(&NoiseTables::default(), &inputs)[0]
}

/// A box holds what it should, and not much more.
fn assert_box(surface: &Implicit, min: [f64; 3], max: [f64; 3]) {
    let (min, max) = (DVec3::from(min), DVec3::from(max));
    let slack = 0.15 * (max - min);
    assert!(
        surface.min.cmple(min).all() && surface.min.cmpge(min - slack).all(),
        "{} for {min}",
        surface.min
    );
    assert!(
        surface.max.cmpge(max).all() && surface.max.cmple(max + slack).all(),
        "{} for {max}",
        surface.max
    );
}

#[test]
fn a_box_is_found_around_what_has_an_end() {
    assert_box(&surface("implicit { function = \\p -> length p - 1 }"), [-1.0; 3], [1.0; 3]);
    // Far from the origin, however it is looked for.
    let far = surface("implicit { function = \\p -> distance p (1000, 0, -5) - 2 }");
    assert_box(&far, [998.0, -2.0, -7.0], [1002.0, 2.0, -3.0]);
    let small = surface("implicit { function = \\p -> length p - 0.000001 }");
    assert_box(&small, [-1e-6; 3], [1e-6; 3]);
    let large = surface("implicit { function = \\p -> length p - 1e12 }");
    assert_box(&large, [-1e12; 3], [1e12; 3]);
    // Not the first power that decides is the greatest: 5 x^2 is more than x^4 near the origin.
    let tangle = "implicit { function = \\p -> p.x ^ 4 - 5 * p.x ^ 2 + p.y ^ 4 - 5 * p.y ^ 2 + p.z ^ 4 - 5 * p.z ^ 2 + 11.8 }";
    // Ranges make more of that than it is.
    let tangle = surface(tangle);
    assert!(
        tangle.min.cmple(DVec3::splat(-2.27)).all() && tangle.min.cmpge(DVec3::splat(-3.5)).all(),
        "{}",
        tangle.min
    );
    assert!(
        tangle.max.cmpge(DVec3::splat(2.27)).all() && tangle.max.cmple(DVec3::splat(3.5)).all(),
        "{}",
        tangle.max
    );
    let flat = surface("implicit { function = boxField (4, 0.5, 2) }");
    assert_box(&flat, [-2.0, -0.25, -1.0], [2.0, 0.25, 1.0]);
}

#[test]
fn a_box_that_is_given_is_kept() {
    let gyroid = surface("implicit { function = gyroidField, size = (2, 4, 6), center = (1, 0, 0) }");
    assert_eq!((gyroid.min, gyroid.max), (DVec3::new(0.0, -2.0, -3.0), DVec3::new(2.0, 2.0, 3.0)));
}

#[test]
fn the_same_surface_is_made_once() {
    let many = surfaces(
        "ball r = implicit { function = \\p -> length p - r }",
        "ball 1, ball 2, ball 1 |> translate up, implicit { function = \\p -> length p - 1, size = (4, 4, 4) }",
    );
    assert!(Arc::ptr_eq(&many[0], &many[2]));
    assert!(!Arc::ptr_eq(&many[0], &many[1]) && !Arc::ptr_eq(&many[0], &many[3]));
}

#[test]
fn fields_of_the_library_are_distances() {
    let at = |field: &str, p: [f64; 3]| {
        value(&surface(&format!("implicit {{ function = {field}, size = (9, 9, 9) }}")), p)
    };
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    near(at("ballField 2", [3.0, 0.0, 4.0]), 3.0);
    near(at("boxField (2, 4, 6)", [4.0, 6.0, 3.0]), 5.0);
    near(at("boxField (2, 4, 6)", [0.5, 0.0, 0.0]), -0.5);
    near(at("rodField (0, 0, 0) (0, 2, 0) 0.5", [3.0, 1.0, 0.0]), 2.5);
    near(at("rodField (0, 0, 0) (0, 2, 0) 0.5", [3.0, 6.0, 0.0]), 4.5);
    near(at("ringField 2 0.5", [2.0, 1.0, 0.0]), 0.5);
    near(at("moved (1, 0, 0) (ballField 1)", [4.0, 0.0, 0.0]), 2.0);
    near(at("grown 0.25 (ballField 1)", [2.0, 0.0, 0.0]), 0.75);
    near(at("shell 0.5 (ballField 2)", [0.0, 1.0, 0.0]), 0.75);
    near(at("repeat (4, 4, 4) (ballField 1)", [4.0, 8.0, -6.0]), 1.0);
    // A quarter of a turn for each unit upwards: at a height of 1, +x is where -z was, or +z.
    let turned = at("twist 90deg (boxField (2, 9, 1))", [0.0, 1.0, 0.9]);
    near(turned, -0.1);
    // Apart by more than the radius of blending it is the plain union; where both are equal it is less by a quarter.
    let two = "(ballField 1) (moved (4, 0, 0) (ballField 1))";
    near(at(&format!("smoothUnion 0.5 {two}"), [-1.0, 0.0, 0.0]), 0.0);
    near(at(&format!("smoothUnion 0.5 {two}"), [2.0, 0.0, 0.0]), 1.0 - 0.125);
    near(at(&format!("smoothIntersection 0.5 {two}"), [2.0, 0.0, 0.0]), 1.0 + 0.125);
    near(at(&format!("smoothDifference 0.5 {two}"), [0.0, 0.0, 0.0]), -1.0);
    near(at("blobField 0.5 [{ center = (0, 0, 0), radius = 2, strength = 1 }]", [0.0, 0.0, 0.0]), -0.5);
    near(at("blobField 0.5 [{ center = (0, 0, 0), radius = 2, strength = 1 }]", [0.0, 3.0, 0.0]), 0.5);
}

#[test]
fn shapes_of_the_library() {
    let blob = surface("blob [{ center = (0, 1, 0), radius = 1, strength = 1 }]");
    // (1 - d²)² = 1/2
    let r = (1.0 - 0.5f64.sqrt()).sqrt();
    assert_box(&blob, [-r, 1.0 - r, -r], [r, 1.0 + r, r]);
    assert_box(&surface("roundedBox (2, 1, 1) 0.1"), [-1.0, -0.5, -0.5], [1.0, 0.5, 0.5]);
    let ball = surface("superellipsoid 1 1");
    assert!(value(&ball, [0.6, 0.0, 0.8]).abs() < 1e-12);
    let star = surface("superellipsoid 2 2");
    assert!(value(&star, [0.25, 0.5, 0.25]).abs() < 1e-12, "{}", value(&star, [0.25, 0.5, 0.25]));
}
