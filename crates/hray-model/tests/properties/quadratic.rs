//! `solveq` finds the real roots, all of them, in order.

use hray_model::*;
use proptest::prelude::*;

proptest! {
    /// Whole numbers, so that every operation is exact and so are the roots.
    #[test]
    fn roots_of_a_polynomial_made_from_them_are_found_all_and_in_order(
        a in 1..100i32, r1 in -1000..1000i32, r2 in -1000..1000i32,
    ) {
        let [a, r1, r2] = [a, r1, r2].map(f64::from);
        let roots = solveq((a, -a * (r1 + r2), a * r1 * r2));
        if r1 == r2 {
            prop_assert_eq!(roots, vec![r1]);
        } else {
            prop_assert_eq!(roots, vec![r1.min(r2), r1.max(r2)]);
        }
    }

    /// a ((x - h)² + k²) is never 0.
    #[test]
    fn a_polynomial_without_real_roots_has_none(a in 1..100i32, h in -1000..1000i32, k in 1..1000i32) {
        let [a, h, k] = [a, h, k].map(f64::from);
        prop_assert_eq!(solveq((a, -2.0 * a * h, a * (h * h + k * k))), vec![]);
        prop_assert_eq!(solveq((-a, 2.0 * a * h, -a * (h * h + k * k))), vec![]);
    }

    /// The textbook formula cancels, so a small root can be relatively wrong; what remains when it is put
    /// into the polynomial is a rounding error of the discriminant over a.
    #[test]
    fn every_root_is_a_root_up_to_rounding(
        a in prop_oneof![1e-3..1e3, -1e3..-1e-3f64], b in -1e4..1e4, c in -1e4..1e4, double in any::<bool>(),
    ) {
        // Half of the cases next to a double root, where the discriminant is all rounding.
        let c: f64 = if double { b * b / (4.0 * a) } else { c };
        let bound = 16.0 * f64::EPSILON * (b * b / f64::abs(a) + 4.0 * c.abs());
        for x in solveq((a, b, c)) {
            let rest = a * x * x + b * x + c;
            prop_assert!(rest.abs() <= bound, "{} at {}, allowed {}", rest, x, bound);
        }
    }

    #[test]
    fn roots_ascend_for_positive_a_and_descend_for_negative(a in 1e-3..1e3, b in -1e4..1e4, c in -1e4..1e4) {
        if let [first, second] = solveq((a, b, c))[..] {
            prop_assert!(first <= second);
        }
        if let [first, second] = solveq((-a, b, c))[..] {
            prop_assert!(first >= second);
        }
    }
}

#[test]
fn an_undefined_discriminant_gives_the_vertex() {
    // b² and 4ac both overflow, their difference is NaN.
    assert_eq!(solveq((1e10, 1e200, 1e300)), vec![-1e200 / 2e10]);
}
