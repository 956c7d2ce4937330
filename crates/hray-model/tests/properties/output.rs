//! The text of a picture.

use crate::common::*;
use hray_model::*;
use proptest::prelude::*;

/// The text of a picture of one pixel whose red is c.
fn red(c: f64) -> String {
    let text = create_ppm((1, 1), &[(c, 0.0, 0.0)]);
    let body = text.strip_prefix("P3\n1 1\n255\n").unwrap();
    body.strip_suffix(" 0 0 ").unwrap().to_owned()
}

/// mantissa · 2^exponent in decimal, by doubling it digit by digit.
fn decimal(mantissa: u64, exponent: u32) -> String {
    let mut digits: Vec<u8> = mantissa.to_string().bytes().rev().map(|b| b - b'0').collect();
    for _ in 0..exponent {
        let mut carry = 0;
        for digit in &mut digits {
            let twice = 2 * *digit + carry;
            (*digit, carry) = (twice % 10, twice / 10);
        }
        if carry > 0 {
            digits.push(carry);
        }
    }
    digits.iter().rev().map(|d| char::from(b'0' + d)).collect()
}

proptest! {
    /// For moderate sizes whole arithmetic can check: the distance to the number written is at most 1/2, and
    /// where it is 1/2 the number is even.
    #[test]
    fn a_component_is_255_times_the_colour_rounded_half_to_even(
        c in prop_oneof![-3.0..3.0, (-600..600i32).prop_map(|n| f64::from(n) / 510.0)],
    ) {
        let written: i64 = red(c).parse().unwrap();
        let off = (c * 255.0 - written as f64).abs();
        prop_assert!(off < 0.5 || (off == 0.5 && written % 2 == 0), "{} off by {}", written, off);
        prop_assert_eq!(written.to_string(), red(c));
    }

    /// 255 times a power of two is exact.
    #[test]
    fn huge_components_are_written_in_full(exponent in 0..1016u32) {
        let c = libm::scalbn(1.0, exponent as i32);
        prop_assert_eq!(red(c), decimal(255, exponent));
        prop_assert_eq!(red(-c), format!("-{}", decimal(255, exponent)));
    }

    #[test]
    fn every_component_is_followed_by_one_space(colors in proptest::collection::vec(color(), 0..20)) {
        let text = create_ppm((colors.len() as i64, 1), &colors);
        let header = format!("P3\n{} 1\n255\n", colors.len());
        let body = text.strip_prefix(&header).unwrap();
        let fields: Vec<&str> = body.split(' ').collect();
        // What follows the last space is the end.
        prop_assert_eq!(fields.len(), 3 * colors.len() + 1);
        prop_assert_eq!(fields[3 * colors.len()], "");
        for field in &fields[..3 * colors.len()] {
            prop_assert!(field.parse::<u8>().is_ok(), "{:?}", field);
        }
    }
}

#[test]
fn a_picture_is_written_like_this() {
    let colors = [(0.0, 0.5, 1.0), (2.0, -1.0, 0.2)];
    assert_eq!(create_ppm((2, 1), &colors), "P3\n2 1\n255\n0 128 255 510 -255 51 ");
    assert_eq!(create_ppm((0, -3), &[]), "P3\n0 -3\n255\n");
}

#[test]
fn halves_go_to_the_even_neighbour_and_there_is_no_negative_zero() {
    for (c, written) in
        [(0.5, "0"), (1.5, "2"), (2.5, "2"), (-0.5, "0"), (-0.001, "0"), (-0.0, "0"), (-1.5, "-2")]
    {
        assert_eq!(c / 255.0 * 255.0, c, "the test needs the product to be exact");
        assert_eq!(red(c / 255.0), written, "{c}");
    }
}

/// What GHC makes of the bits: infinity is 2^1024, the NaN of x86-64 is -1.5 times that.
#[test]
fn infinity_and_nan_are_written_as_ghc_rounds_them() {
    assert_eq!(red(f64::INFINITY), decimal(1, 1024));
    assert_eq!(red(1e306), decimal(1, 1024));
    assert_eq!(red(f64::NEG_INFINITY), format!("-{}", decimal(1, 1024)));
    assert_eq!(red(f64::NAN), format!("-{}", decimal(3, 1023)));
}
