//! Functions of a hit: compiled once, and the same as what they say.

use crate::common::{color_function, material, number, number_function};
use hray_core::{Field, NoiseTables, Rgb, Texture};
use hray_expr::Input;
use proptest::prelude::*;

fn hit(p: [f64; 3]) -> [f64; Input::COUNT] {
    let mut inputs = [0.0; Input::COUNT];
    inputs[Input::Px as usize..=Input::Pz as usize].copy_from_slice(&p);
    inputs[Input::Wx as usize..=Input::Wz as usize].copy_from_slice(&p);
    inputs[Input::Ny as usize] = 1.0;
    inputs[Input::U as usize] = 0.25;
    inputs[Input::V as usize] = 0.75;
    inputs
}

fn at(function: &hray_core::Function, p: [f64; 3]) -> Vec<f64> {
    function.evaluate(&NoiseTables::default(), &hit(p))
}

#[test]
fn a_function_that_does_not_vary_is_a_constant() {
    assert_eq!(
        material("", "color = \\h -> rgb 0.1 0.2 0.3").texture,
        Texture::Solid(Rgb::new(0.1, 0.2, 0.3))
    );
    assert_eq!(material("", "reflection = \\h -> 0.5 * 0.5").reflection, Field::Constant(0.25));
}

#[test]
fn conditions_become_selections() {
    let f = color_function("", "\\h -> if h.p.x > 0 then (if h.p.y > 0 then red else green) else blue");
    let color = |p| at(&f, p);
    assert_ne!(color([1.0, 1.0, 0.0]), color([1.0, -1.0, 0.0]));
    assert_eq!(color([-1.0, 1.0, 0.0]), color([-1.0, -1.0, 0.0]));
}

#[test]
fn selections_go_through_records_lists_vectors_and_functions() {
    let f = number_function(
        "",
        "\\h -> let on = h.p.x > 0
                    r = if on then { v = (1, 2), l = [3, 4], f = \\x -> x * 10 } else { v = (5, 6), l = [7, 8], f = \\x -> x }
                in r.v.y + at 1 r.l + r.f 2",
    );
    assert_eq!(at(&f, [1.0, 0.0, 0.0]), [2.0 + 4.0 + 20.0]);
    assert_eq!(at(&f, [-1.0, 0.0, 0.0]), [6.0 + 8.0 + 2.0]);
}

#[test]
fn a_number_is_a_grey() {
    let f = color_function("", "\\h -> h.p.x");
    assert_eq!(at(&f, [0.25, 0.0, 0.0]), [0.25; 3]);
}

#[test]
fn all_of_a_hit_is_there() {
    let f = number_function("", "\\h -> h.world.z + 10 * h.normal.y + 100 * h.uv.x + 1000 * h.uv.y");
    assert_eq!(at(&f, [0.0, 0.0, 0.5]), [0.5 + 10.0 + 25.0 + 750.0]);
}

#[test]
fn matches_may_depend_on_the_hit() {
    let f = number_function("", "\\h -> match floor h.p.x { 0 -> 10, 1 -> 20, _ -> 30 }");
    assert_eq!(
        [at(&f, [0.5, 0.0, 0.0]), at(&f, [1.5, 0.0, 0.0]), at(&f, [9.0, 0.0, 0.0])],
        [[10.0], [20.0], [30.0]]
    );
}

/// The escape count of the Mandelbrot set, against the loop as one would write it.
#[test]
fn loops_may_end_where_the_hit_says_so() {
    let f = number_function(
        "step c s = { z = (s.z.x ^ 2 - s.z.y ^ 2 + c.x, 2 * s.z.x * s.z.y + c.y), n = s.n + 1 }\nout s = dot s.z s.z > 4",
        "\\h -> (iterate 50 out (step h.p.xy) { z = (0, 0), n = 0 }).n",
    );
    for (x, y) in [(0.0, 0.0), (0.3, 0.5), (-0.75, 0.1), (1.0, 1.0), (-2.0, 0.0), (0.4, 0.4)] {
        let (mut zx, mut zy, mut n) = (0.0f64, 0.0f64, 0.0);
        while n < 50.0 && zx * zx + zy * zy <= 4.0 {
            (zx, zy, n) = (zx * zx - zy * zy + x, 2.0 * zx * zy + y, n + 1.0);
        }
        assert_eq!(at(&f, [x, y, 0.0]), [n], "at ({x}, {y})");
    }
}

#[test]
fn patterns_can_be_moved() {
    let moved = number_function("", "translate (1, 2, 3) (\\h -> h.p.x + 10 * h.p.y + 100 * h.p.z)");
    assert_eq!(at(&moved, [1.0, 2.0, 3.0]), [0.0]);
    let scaled = number_function("", "scale 2 (\\h -> h.p.x)");
    assert_eq!(at(&scaled, [3.0, 0.0, 0.0]), [1.5]);
    let turned = number_function("", "rotate up 90deg (\\h -> h.p.x)");
    // Counter-clockwise seen from above, x goes to -z.
    assert_eq!(at(&turned, [0.0, 0.0, -1.0]), [1.0]);
    let normal = number_function("", "rotate right 90deg (\\h -> h.normal.z)");
    assert!((at(&normal, [0.0; 3])[0] + 1.0).abs() < 1e-12);
    let updated = number_function("", "\\h -> (\\g -> g.p.x) { h | p = h.p * 3 }");
    assert_eq!(at(&updated, [2.0, 0.0, 0.0]), [6.0]);
}

#[test]
fn a_bump_is_a_slope() {
    let bump = material("", "bump = \\h -> h.p.x ^ 2 + 3 * h.p.y").bump.clone().unwrap();
    assert_eq!(at(&bump, [2.0, 5.0, 7.0]), [4.0, 3.0, 0.0]);
    assert_eq!(material("", "bump = \\h -> 7").bump, None);
}

/// The textures of 2005 are written in hry; used as they are they are the integrator's own.
#[test]
fn the_textures_of_2005_are_recognised() {
    let texture = material(
        "",
        "color = perlinMarble { color = gold, octaves = 4, grid = 0.5, direction = (1, 0, 0), power = 3 }",
    );
    assert!(matches!(texture.texture, Texture::Noise(_)), "{:?}", texture.texture);
    let wrapped = material("", "color = \\h -> perlinPlasma { grid = 2 } h");
    assert!(matches!(wrapped.texture, Texture::Function(_)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// What is compiled for all hits is what the evaluator says of one point.
    #[test]
    fn compiled_functions_agree_with_evaluation(x in -9.0..9.0f64, y in -9.0..9.0f64, z in -9.0..9.0f64, which in 0..BODIES.len()) {
        let body = BODIES[which];
        let compiled = at(&number_function(&format!("f p = {body}"), "\\h -> f h.p"), [x, y, z]);
        let direct = number(&format!("f p = {body}"), &format!("f ({x:?}, {y:?}, {z:?})"));
        prop_assert_eq!(compiled[0].to_bits(), direct.to_bits(), "{} at {:?}", body, (x, y, z));
    }
}

const BODIES: [&str; 12] = [
    "p.x * p.y - p.z / 3",
    "turbulence 5 p",
    "fbm 4 (p * 0.7)",
    "ridged 3 p",
    "(cells 2 p).nearest + (cells 2 p).id",
    "crackle p",
    "sin p.x + cos p.y * atan2 p.y p.z",
    "if p.x < p.y then sqrt (abs p.z) else (fract p).y ^ 1.7",
    "max (min p.x p.y) (p.z % 1.3)",
    "random 3 (floor p.x)",
    "iterate 20 (\\s -> s > 100) (\\s -> s * 1.5 + abs p.x) 1",
    "exp (-dot p p) + ln (1 + abs p.x)",
];
