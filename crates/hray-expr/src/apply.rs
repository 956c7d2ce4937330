//! What each function of numbers gives: the one definition that folding, the reference and the lanes share.
//!
//! Which NaN a result is (its sign and payload) is not defined, and nothing here depends on it.

use crate::{Binary, Unary};

/// The increment of `SplitMix64`.
const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

impl Unary {
    /// The value at a.
    #[must_use]
    pub fn apply(self, a: f64) -> f64 {
        match self {
            Self::Neg => -a,
            Self::Abs => a.abs(),
            Self::Floor => a.floor(),
            Self::Ceil => a.ceil(),
            Self::Round => a.round(),
            Self::Sqrt => a.sqrt(),
            Self::Sin => libm::sin(a),
            Self::Cos => libm::cos(a),
            Self::Tan => libm::tan(a),
            Self::Asin => libm::asin(a),
            Self::Acos => libm::acos(a),
            Self::Atan => libm::atan(a),
            Self::Exp => libm::exp(a),
            Self::Ln => libm::log(a),
            Self::Not => truth(a == 0.0),
        }
    }
}

impl Binary {
    /// The value at a and b.
    #[must_use]
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Sub => a - b,
            Self::Mul => a * b,
            Self::Div => a / b,
            Self::Modulo => a - b * (a / b).floor(),
            Self::Min => {
                if a < b {
                    a
                } else {
                    b
                }
            }
            Self::Max => {
                if a > b {
                    a
                } else {
                    b
                }
            }
            Self::Pow => libm::pow(a, b),
            Self::Atan2 => libm::atan2(a, b),
            Self::Less => truth(a < b),
            Self::LessEqual => truth(a <= b),
            Self::Equal => truth(a == b),
            Self::And => truth(a != 0.0 && b != 0.0),
            Self::Or => truth(a != 0.0 || b != 0.0),
            Self::Random => random(a, b),
        }
    }
}

const fn truth(value: bool) -> f64 {
    if value { 1.0 } else { 0.0 }
}

/// A number in [0, 1), a multiple of 2^-53, that looks random and depends on `seed` and `index` alone. Numbers
/// that are equal count as one (0 and -0), and so do all that are not a number.
///
/// It hashes the bits of the seed, then those with the bits of the index, by the finaliser of `SplitMix64`
/// (Steele, Lea and Flood, OOPSLA 2014).
#[must_use]
pub fn random(seed: f64, index: f64) -> f64 {
    unit(mix(mix(bits(seed).wrapping_add(GOLDEN)).wrapping_add(bits(index)).wrapping_add(GOLDEN)))
}

/// The bits of a number, of one representative where several count as one.
const fn bits(v: f64) -> u64 {
    if v.is_nan() { f64::NAN.to_bits() } else { (v + 0.0).to_bits() }
}

/// The finaliser of `SplitMix64`: every bit of the result depends on every bit of the argument.
pub(crate) const fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The top 53 bits as a number in [0, 1).
pub(crate) const fn unit(hash: u64) -> f64 {
    (hash >> 11) as f64 / (1u64 << 53) as f64
}

/// The sequence of `SplitMix64`.
pub(crate) struct SplitMix64(pub(crate) u64);

impl SplitMix64 {
    pub(crate) const fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        mix(self.0)
    }

    /// The shuffle of Fisher and Yates from the top: for i = 255 down to 1, entry i changes places with entry
    /// (w >> 32) (i + 1) >> 32 of the next word w.
    pub(crate) fn shuffle(&mut self, permutation: &mut [u8; 256]) {
        for i in (1..256usize).rev() {
            let j = ((self.next() >> 32) * (i as u64 + 1)) >> 32;
            permutation.swap(i, j as usize);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_goes_away_from_zero_and_keeps_the_sign() {
        assert_eq!(Unary::Round.apply(2.5), 3.0);
        assert_eq!(Unary::Round.apply(-2.5), -3.0);
        assert!(Unary::Round.apply(-0.25).is_sign_negative());
    }

    #[test]
    fn modulo_has_the_sign_of_the_divisor() {
        assert_eq!(Binary::Modulo.apply(-1.0, 3.0), 2.0);
        assert_eq!(Binary::Modulo.apply(1.0, -3.0), -2.0);
        assert_eq!(Binary::Modulo.apply(7.0, 2.0), 1.0);
        assert!(Binary::Modulo.apply(7.0, 0.0).is_nan());
    }

    #[test]
    fn minimum_and_maximum_take_the_second_when_unordered() {
        assert_eq!(Binary::Min.apply(f64::NAN, 1.0), 1.0);
        assert!(Binary::Min.apply(1.0, f64::NAN).is_nan());
        assert_eq!(Binary::Max.apply(f64::NAN, 1.0), 1.0);
        assert!(Binary::Min.apply(0.0, -0.0).is_sign_negative());
    }

    #[test]
    fn only_zero_is_false() {
        assert_eq!(Unary::Not.apply(-0.0), 1.0);
        assert_eq!(Unary::Not.apply(f64::NAN), 0.0);
        assert_eq!(Binary::And.apply(f64::NAN, 0.5), 1.0);
        assert_eq!(Binary::Or.apply(0.0, -0.0), 0.0);
    }

    #[test]
    fn random_numbers_are_spread_evenly() {
        let mut bins = [0u32; 16];
        for i in 0..16_000 {
            let v = random(3.0, f64::from(i));
            assert!((0.0..1.0).contains(&v));
            bins[(v * 16.0) as usize] += 1;
        }
        assert!(bins.iter().all(|n| (850..1150).contains(n)), "{bins:?}");
        assert_ne!(random(1.0, 2.0), random(2.0, 1.0));
        assert_eq!(random(0.0, -0.0), random(-0.0, 0.0));
        assert_eq!(random(f64::NAN, 1.0), random(-f64::NAN, 1.0));
    }
}
