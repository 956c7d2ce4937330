//! Lengths, colours and pixels.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

proptest! {
    #[test]
    fn a_normalised_vector_has_length_1_and_the_same_direction(v in triple(1e6)) {
        prop_assume!(len(v) >= NO_LENGTH);
        let n = norm(v);
        prop_assert!((len(n) - 1.0).abs() < 1e-15);
        prop_assert!(dot(n, v) > 0.0 && len(cross(n, v)) <= 1e-15 * len(v));
    }

    #[test]
    fn distance_is_the_length_of_the_difference_and_symmetric(p in triple(1e3), q in triple(1e3)) {
        prop_assert_eq!(dist(p, q), len(sub(q, p)));
        prop_assert_eq!(dist(p, q), dist(q, p));
        prop_assert_eq!(dist(p, p), 0.0);
    }

    #[test]
    fn a_ray_through_a_point_reaches_it_at_their_distance(p in triple(1e3), q in triple(1e3)) {
        let r = mk_ray(p, q);
        prop_assert!(dist(add(start(r), scale(dir(r), dist(p, q))), q) < 1e-12 * 1e3);
    }

    #[test]
    fn clip_gives_a_colour_and_leaves_a_colour_alone(c in (any::<f64>(), any::<f64>(), any::<f64>())) {
        let (r, g, b) = clip(c);
        for v in [r, g, b] {
            prop_assert!((0.0..=1.0).contains(&v));
        }
        prop_assert_eq!(clip((r, g, b)), (r, g, b));
    }

    /// The window reaches from -w/2 to w/2, the far edges exclusive.
    #[test]
    fn a_pixel_lies_in_the_window(
        (rx, px) in (1..2000i64).prop_flat_map(|r| (Just(r), 0..r)),
        (ry, py) in (1..2000i64).prop_flat_map(|r| (Just(r), 0..r)),
        w in 1..1000i64, h in 1..1000i64,
    ) {
        let (x, y, z) = map_to_win((rx, ry), (w, h), (px, py));
        let (half_w, half_h) = (w as f64 / 2.0, h as f64 / 2.0);
        prop_assert!(-half_w <= x && x < half_w);
        prop_assert!(-half_h <= y && y < half_h);
        prop_assert_eq!(z, 0.0);
    }
}

#[test]
fn a_vector_without_length_stays_null() {
    assert_eq!(norm((0.0, 0.0, 0.0)), (0.0, 0.0, 0.0));
    // Chapter 2 would give a direction to this one, the program does not.
    assert_eq!(norm((0.9e-9, 0.0, 0.0)), (0.0, 0.0, 0.0));
    assert_eq!(norm((1.1e-9, 0.0, 0.0)).0, 1.0);
}

#[test]
fn clip_maps_nan_to_1_and_negative_zero_to_zero() {
    assert_eq!(clip((f64::NAN, f64::INFINITY, f64::NEG_INFINITY)), (1.0, 1.0, 0.0));
    let (zero, _, _) = clip((-0.0, 0.0, 0.0));
    assert!(zero.is_sign_positive());
}

#[test]
fn the_middle_pixel_is_the_origin_and_the_first_the_lower_left_corner() {
    assert_eq!(map_to_win((800, 600), (100, 75), (400, 300)), (0.0, 0.0, 0.0));
    assert_eq!(map_to_win((800, 600), (100, 75), (0, 0)), (-50.0, -37.5, 0.0));
    // An odd resolution has no middle pixel.
    assert_eq!(map_to_win((3, 3), (3, 3), (1, 1)), (-0.5, -0.5, 0.0));
}
