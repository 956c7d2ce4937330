//! The picture as a whole.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

fn camera() -> impl Strategy<Value = Camera> {
    (triple(200.0), (1..200i64, 1..200i64)).prop_map(|(eye, dim)| mk_camera(eye, dim))
}

/// A number as one would write it, or one that nobody would.
fn number(usual: std::ops::Range<f64>) -> impl Strategy<Value = f64> {
    let odd = vec![0.0, -0.0, 1.0, -1.0, 2.0, 1e-300, 1e300, -1e300, f64::INFINITY, f64::NAN];
    prop_oneof![8 => usual, 1 => proptest::sample::select(odd)]
}

fn noise_f() -> impl Strategy<Value = NoiseF> {
    let grid = || number(0.1..50.0);
    let freq = || prop_oneof![9 => 0..6u64, 1 => 1020..1030u64];
    prop_oneof![
        (color(), grid()).prop_map(|(base, grid_s)| NoiseF::PerlinSolid { base, grid_s }),
        (color(), freq(), grid()).prop_map(|(base, freq, grid_s)| NoiseF::PerlinSemiTurbulence {
            base,
            freq,
            grid_s
        }),
        (color(), freq(), grid()).prop_map(|(base, freq, grid_s)| NoiseF::PerlinTurbulence {
            base,
            freq,
            grid_s
        }),
        (color(), color(), freq(), grid()).prop_map(|(add_color, base, freq, grid_s)| NoiseF::PerlinFire {
            add_color,
            base,
            freq,
            grid_s
        }),
        grid().prop_map(|grid_s| NoiseF::PerlinPlasma { grid_s }),
        (color(), freq(), grid(), triple(1.0), number(0.0..40.0)).prop_map(
            |(base, freq, grid_s, factors, pow)| NoiseF::PerlinMarble { base, freq, grid_s, factors, pow }
        ),
        (color(), color(), freq(), grid(), triple(1.0), number(0.0..40.0)).prop_map(
            |(base, add_color, freq, grid_s, factors, pow)| NoiseF::PerlinMarbleBase {
                base,
                add_color,
                freq,
                grid_s,
                factors,
                pow
            }
        ),
        (color(), freq(), grid(), number(0.1..2.0), number(0.0..5.0)).prop_map(
            |(base, freq, grid_s, xy_fact, pow)| NoiseF::PerlinWood { base, freq, grid_s, xy_fact, pow }
        ),
    ]
}

fn texture() -> impl Strategy<Value = Texture> {
    let diff = prop_oneof![color().prop_map(Diff::Solid), noise_f().prop_map(Diff::Perlin)];
    (diff, number(0.0..1.0), -3..80i64, number(0.0..1.0), number(0.5..2.0)).prop_map(
        |(diff, refl_coef, spec_coef, refr_coef, refr_index)| Texture {
            diff,
            refl_coef,
            spec_coef,
            refr_coef,
            refr_index,
        },
    )
}

fn light() -> impl Strategy<Value = Light> {
    let int = || (number(0.0..1.0), number(0.0..1.0), number(0.0..1.0));
    prop_oneof![int().prop_map(ambient), (triple(200.0), int()).prop_map(|(pos, int)| point_light(pos, int))]
}

fn scene() -> impl Strategy<Value = Scene> {
    let odd_object = prop_oneof![
        9 => object(),
        1 => (number(-50.0..50.0), number(-1.0..1.0)).prop_map(|(d, c)| plane(0.0, 0.0, c, d)),
        1 => (number(-50.0..50.0), triple(50.0)).prop_map(|(rad, cen)| sphere(cen, rad)),
    ];
    (
        camera(),
        color(),
        proptest::collection::vec((odd_object, texture()), 0..6),
        proptest::collection::vec(light(), 0..4),
    )
        .prop_map(|(camera, background, objects, lights)| Scene { camera, background, objects, lights })
}

proptest! {
    /// (2.5): the domain of rayTrace r s is □ (r 0) × □ (r 1).
    #[test]
    fn the_domain_of_a_picture_is_its_resolution(s in scene(), rx in -2..6i64, ry in -2..6i64) {
        let image = ray_trace(1, (rx, ry), &s, tables()).unwrap();
        prop_assert_eq!(image.domain(), (0..rx, 0..ry));
        prop_assert_eq!(image.resolution(), (rx, ry));
        for px in -3..8 {
            for py in -3..8 {
                let inside = 0 <= px && px < rx && 0 <= py && py < ry;
                let outside = Err(OutsideDomain { pixel: (px, py), resolution: (rx, ry) });
                prop_assert_eq!(image.at(px, py).is_ok(), inside);
                prop_assert!(inside || image.at(px, py) == outside);
            }
        }
    }

    /// (2.6): without objects, rayTrace r (c, b, ε, l) = (□ (r 0) × □ (r 1)) • b. Any b: it is not clipped.
    #[test]
    fn a_scene_without_objects_is_the_constant_picture_of_its_background(
        s in scene(), b in triple(3.0), depth in 0..5i64, rx in 1..6i64, ry in 1..6i64,
    ) {
        let s = Scene { background: b, objects: vec![], ..s };
        let (picture, constant) = (ray_trace(depth, (rx, ry), &s, tables()).unwrap(), Image::new((rx, ry), |_| b));
        prop_assert_eq!(picture.domain(), constant.domain());
        for px in 0..rx {
            for py in 0..ry {
                prop_assert_eq!(picture.at(px, py), constant.at(px, py));
            }
        }
    }

    #[test]
    fn every_colour_of_a_picture_is_a_colour_if_the_background_is(s in scene(), depth in -1..3i64) {
        for (r, g, b) in get_image(depth, (4, 3), &s, tables()).unwrap() {
            for v in [r, g, b] {
                prop_assert!((0.0..=1.0).contains(&v), "{}", v);
            }
        }
    }

    /// The picture is (rayTracePt s) ∘ (mapToWin r d), listed from the top row down and from left to right.
    #[test]
    fn a_picture_is_listed_from_the_top_row_down(s in scene(), rx in 1..5i64, ry in 1..5i64) {
        let colors = get_image(1, (rx, ry), &s, tables()).unwrap();
        let image = ray_trace(1, (rx, ry), &s, tables()).unwrap();
        let depth = Depth::new(1).unwrap();
        let mut listed = colors.iter();
        for row_from_top in 0..ry {
            for px in 0..rx {
                let py = ry - 1 - row_from_top;
                let p = map_to_win((rx, ry), s.camera.dim, (px, py));
                let color = ray_trace_pt(depth, &s, p, tables());
                prop_assert_eq!(listed.next(), Some(&color));
                prop_assert_eq!(image.at(px, py), Ok(color));
            }
        }
        prop_assert_eq!(listed.next(), None);
    }
}

#[test]
fn an_empty_resolution_has_an_empty_picture() {
    let s = Scene {
        camera: mk_camera((0.0, 0.0, 150.0), (100, 75)),
        background: grey(0.8),
        objects: vec![],
        lights: vec![],
    };
    for resolution in [(0, 5), (5, 0), (-3, 5), (5, -3)] {
        assert_eq!(get_image(0, resolution, &s, tables()), Ok(vec![]));
    }
}

/// (2.6) needs a depth of at least 0: at -1 the program sees black, which the model without a depth cannot.
#[test]
fn at_depth_minus_1_every_picture_is_black() {
    let s = Scene {
        camera: mk_camera((0.0, 0.0, 150.0), (100, 75)),
        background: grey(0.8),
        objects: vec![],
        lights: vec![],
    };
    assert_eq!(get_image(-1, (1, 1), &s, tables()), Ok(vec![grey(0.0)]));
}

#[test]
fn what_lies_between_the_eye_and_the_window_is_not_seen() {
    let mut s = Scene {
        camera: mk_camera((0.0, 0.0, 150.0), (100, 75)),
        background: grey(0.8),
        objects: vec![(sphere((0.0, 0.0, 50.0), 10.0), plain(grey(0.0)))],
        lights: vec![],
    };
    let middle = |s: &Scene| ray_trace_pt(Depth::new(0).unwrap(), s, (0.0, 0.0, 0.0), tables());
    assert_eq!(middle(&s), grey(0.8));
    s.objects.push((sphere((0.0, 0.0, -50.0), 10.0), plain(grey(0.0))));
    assert_eq!(middle(&s), grey(0.0));
}
