//! Mirrored and broken directions.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

/// A direction and a normal, both of length 1, where the direction runs against the normal.
fn arriving() -> impl Strategy<Value = (Vector, Vector)> {
    (unit(), unit()).prop_map(|(i, n)| if dot(i, n) > 0.0 { (i, scale(n, -1.0)) } else { (i, n) })
}

/// The part of a direction along the surface.
fn along(v: Vector, n: Vector) -> Vector {
    sub(v, scale(n, dot(v, n)))
}

fn near(v: Vector, w: Vector, tolerance: f64) -> bool {
    dist(v, w) <= tolerance
}

proptest! {
    #[test]
    fn a_mirrored_direction_keeps_its_length_and_mirrors_the_angle(i in triple(10.0), n in unit()) {
        let r = reflect_dir(i, n);
        prop_assert!((len(r) - len(i)).abs() < 1e-14 * 10.0);
        prop_assert!((dot(r, n) + dot(i, n)).abs() < 1e-14 * 10.0);
        prop_assert!(near(along(r, n), along(i, n), 1e-14 * 10.0));
        prop_assert!(near(reflect_dir(r, n), i, 1e-14 * 10.0));
    }

    /// sin α / sin β = r, on the far side of the normal, in the plane of incidence.
    #[test]
    fn entering_a_direction_obeys_snells_law(
        // Light that enters a thinner medium can be totally reflected too.
        ((i, n), r) in (arriving(), 0.3..3.0f64)
            .prop_filter("totally reflected", |((i, n), r)| len(cross(*i, *n)) / r < 0.999_999),
    ) {
        let sin_a = len(cross(i, n));
        let t = refract_dir(i, n, r);
        prop_assert!((len(t) - 1.0).abs() < 1e-12);
        prop_assert!((r * len(cross(t, n)) - sin_a).abs() < 1e-9);
        prop_assert!(dot(t, n) < 0.0);
        prop_assert!(dot(along(t, n), along(i, n)) >= 0.0);
        prop_assert!(dot(t, cross(i, n)).abs() < 1e-12);
    }

    /// The thesis does not turn the normal round for a ray that leaves, so the component along it is
    /// 2 r cos α - cos β where Snell's law has cos β.
    #[test]
    fn leaving_a_direction_bends_by_the_formula_and_stays_in_the_plane_of_incidence(
        ((i, against), r) in (arriving(), 0.3..3.0f64)
            .prop_filter("totally reflected", |((i, n), r)| len(cross(*i, *n)) * r < 0.999_999),
    ) {
        let n = scale(against, -1.0);
        let (cos_a, sin_a) = (dot(i, n), len(cross(i, n)));
        let cos_b = (1.0 - r * r * sin_a * sin_a).sqrt();
        let sum = add(scale(along(i, n), r), scale(n, 2.0 * r * cos_a - cos_b));
        // Where the two parts cancel nearly, the direction is as uncertain as they are.
        prop_assume!(len(sum) > 1e-3);
        let t = refract_dir(i, n, r);
        prop_assert!(near(t, scale(sum, 1.0 / len(sum)), 1e-6));
        prop_assert!(dot(t, cross(i, n)).abs() < 1e-9);
    }

    #[test]
    fn an_index_of_1_bends_nothing(i in unit(), n in unit()) {
        prop_assert!(near(refract_dir(i, n, 1.0), i, 1e-7));
    }

    /// Snell's law has no solution where sin β would have to exceed 1.
    #[test]
    fn total_internal_reflection_is_the_null_vector(i in unit(), n in unit(), r in 0.3..3.0f64) {
        let ratio = if dot(i, n) > 0.0 { r } else { 1.0 / r };
        let sin_b = ratio * len(cross(i, n));
        prop_assume!((sin_b - 1.0).abs() > 1e-9);
        prop_assert_eq!(refract_dir(i, n, r) == (0.0, 0.0, 0.0), sin_b > 1.0);
    }
}

/// Straight on, Snell's law bends nothing: it would give (0, 0, 1) in both cases.
#[test]
fn leaving_a_medium_of_index_below_one_half_straight_on_the_ray_turns_back() {
    let n = (0.0, 0.0, 1.0);
    assert_eq!(refract_dir((0.0, 0.0, 1.0), n, 0.6), (0.0, 0.0, 1.0));
    assert_eq!(refract_dir((0.0, 0.0, 1.0), n, 0.4), (0.0, 0.0, -1.0));
}

/// sin α = 0.6 and r = 1.25 give sin β = 0.75 by Snell's law, and something else here.
#[test]
fn leaving_is_not_snells_law() {
    let t = refract_dir((0.6, 0.0, 0.8), (0.0, 0.0, 1.0), 1.25);
    let cos_b = (1.0f64 - 0.75 * 0.75).sqrt();
    let expected = norm((0.75, 0.0, 2.0 - cos_b));
    assert!(near(t, expected, 1e-15));
    assert!((t.0 - 0.75).abs() > 0.2);
}
