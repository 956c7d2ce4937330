//! Mirrors in mirrors, and how they end.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

const TO_THE_BACK: Vector = (0.0, 0.0, 1.0);

/// The two facing mirrors of §2.3.3, at z = 100 and z = -100, with coefficient k; every level of the recursion
/// sees ambient light a.
fn facing_mirrors(k: f64, a: f64) -> Scene {
    Scene {
        camera: mk_camera((0.0, 0.0, -50.0), (100, 75)),
        background: grey(0.5),
        objects: vec![(plane(0.0, 0.0, -1.0, 100.0), mirror(k)), (plane(0.0, 0.0, 1.0, 100.0), mirror(k))],
        lights: vec![ambient(grey(a))],
    }
}

/// The colour in the middle of the window.
fn middle(depth: i64, scene: &Scene) -> Color {
    ray_trace_pt(Depth::new(depth).unwrap(), scene, (0.0, 0.0, 0.0), tables())
}

/// What a ray along z sees.
fn along_z(depth: i64, b: Color, objects: &[TexturedObject]) -> Color {
    let ray = mk_ray_dir((0.0, 0.0, 0.0), TO_THE_BACK);
    color_pt(Depth::new(depth).unwrap(), ray, b, objects, &[], tables())
}

proptest! {
    /// Perfect mirrors add the same 2^-20 at every level, so the colour counts the levels: depth + 1.
    #[test]
    fn facing_mirrors_recurse_to_the_depth_and_no_further(depth in -1..100i64) {
        let a = 1.0 / f64::from(1u32 << 20);
        prop_assert_eq!(middle(depth, &facing_mirrors(1.0, a)), grey((depth + 1) as f64 * a));
    }

    /// The sum of a geometric series: c(d) = a (1 - k^(d + 1)) / (1 - k), here with a = 1/4 and k = 1/2.
    #[test]
    fn facing_mirrors_of_coefficient_one_half_sum_a_geometric_series(depth in -1..40i32) {
        let rest = 1.0 / (1u64 << (depth + 1)) as f64;
        prop_assert_eq!(middle(depth.into(), &facing_mirrors(0.5, 0.25)), grey(0.5 * (1.0 - rest)));
    }

    #[test]
    fn a_depth_below_minus_1_is_an_error(depth in prop_oneof![Just(-2), i64::MIN..-1]) {
        let scene = facing_mirrors(1.0, 0.25);
        prop_assert_eq!(ray_trace(depth, (4, 3), &scene, tables()).unwrap_err(), EndlessRecursion { depth });
        prop_assert_eq!(get_image(depth, (4, 3), &scene, tables()), Err(EndlessRecursion { depth }));
        prop_assert_eq!(Depth::new(depth), Err(EndlessRecursion { depth }));
    }

    /// n clear panes dim the background by c² each: once as it is handed on, once as it comes back.
    #[test]
    fn a_pane_dims_the_background_twice(n in 0..8usize, b in color()) {
        let panes: Vec<_> = (1..=n).map(|k| (plane(0.0, 0.0, -1.0, k as f64), clear(0.5, 1.0))).collect();
        let mut expected = b;
        for _ in 0..n {
            expected = scale(expected, 0.25);
        }
        prop_assert_eq!(along_z(n as i64, b, &panes), expected);
        if n > 0 {
            prop_assert_eq!(along_z(n as i64 - 1, b, &panes), grey(0.0));
        }
    }
}

#[test]
fn ten_thousand_levels_end() {
    let run = || middle(10_000, &facing_mirrors(1.0, 1.0 / f64::from(1u32 << 20)));
    let color = std::thread::Builder::new().stack_size(256 << 20).spawn(run).unwrap().join().unwrap();
    assert_eq!(color, grey(10_001.0 / f64::from(1u32 << 20)));
}

#[test]
fn depth_minus_1_is_black_even_where_nothing_is_hit() {
    assert_eq!(along_z(-1, grey(0.5), &[]), grey(0.0));
    assert_eq!(along_z(0, grey(0.5), &[]), grey(0.5));
}

/// With k = -2 and a = 0.75 the levels are 0.75, 0.75 - 1.5 clipped to 0, and then 0.75 again; clipped only at
/// the end the last would be 1.
#[test]
fn every_level_is_clipped() {
    let scene = facing_mirrors(-2.0, 0.75);
    assert_eq!(middle(0, &scene), grey(0.75));
    assert_eq!(middle(1, &scene), grey(0.0));
    assert_eq!(middle(2, &scene), grey(0.75));
}

#[test]
fn a_mirror_shows_black_for_the_background() {
    let mirror_at_10 = (plane(0.0, 0.0, -1.0, 10.0), mirror(1.0));
    assert_eq!(along_z(5, grey(0.5), &[mirror_at_10]), grey(0.0));
}

/// A mirror at 45 degrees shows what is beside it, and light that is mirrored away from the viewer.
#[test]
fn a_mirror_shows_what_lies_in_the_mirrored_direction() {
    let slanted = (plane(1.0, 0.0, -1.0, 10.0), mirror(0.5));
    let lamp = (sphere((30.0, 0.0, 10.0), 5.0), plain(grey(1.0)));
    let ray = mk_ray_dir((0.0, 0.0, 0.0), TO_THE_BACK);
    let lights = [point_light((12.0, 0.0, 10.0), grey(0.5))];
    let seen = |o: &[TexturedObject]| color_pt(Depth::new(1).unwrap(), ray, grey(0.75), o, &lights, tables());
    // The light grazes the mirror at 45 degrees, a black one at that, and meets the lamp head on. The highlight
    // of the mirror has exponent 0 and is its coefficient times the light.
    assert_eq!(seen(&[slanted]), grey(0.25));
    let (r, _, _) = seen(&[slanted, lamp]);
    assert!((r - (0.25 + 0.5 * 0.5)).abs() < 1e-12, "{r}");
}

#[test]
fn total_internal_reflection_shows_black() {
    // From inside the plane's half-space, at 45 degrees: √2 sin 45° = 1 is the limit.
    let ray = mk_ray_dir((0.0, 0.0, 0.0), norm((1.0, 0.0, 1.0)));
    let seen = |index: f64| {
        let o = [(plane(0.0, 0.0, 1.0, -10.0), clear(1.0, index))];
        color_pt(Depth::new(3).unwrap(), ray, grey(0.5), &o, &[], tables())
    };
    assert_eq!(seen(1.40), grey(0.5));
    assert_eq!(seen(1.42), grey(0.0));
}

#[test]
fn mirror_and_pane_add_up() {
    // The mirror half of the material sees the lit wall behind the viewer, the clear half the background.
    let wall = (plane(0.0, 0.0, 1.0, 10.0), plain(grey(1.0)));
    let both = Texture { refl_coef: 0.5, ..clear(0.5, 1.0) };
    let pane = (plane(0.0, 0.0, -1.0, 10.0), both);
    let ray = mk_ray_dir((0.0, 0.0, 0.0), TO_THE_BACK);
    let lights = [ambient(grey(0.125))];
    let color = color_pt(Depth::new(1).unwrap(), ray, grey(0.75), &[wall, pane], &lights, tables());
    assert_eq!(color, grey(0.125 + 0.5 * 0.125 + 0.25 * 0.75));
}
