//! The operations, on one number at a time: what constant folding, the language and the reference evaluator share.

use crate::{Binary, Unary};

impl Unary {
    /// Its value.
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
    /// Its value.
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

fn truth(value: bool) -> f64 {
    if value { 1.0 } else { 0.0 }
}

/// A number in [0, 1) that depends on the bits of a seed and an index: two rounds of the finalizer of `SplitMix64` (Steele, Lea
/// and Flood, OOPSLA 2014). -0 counts as 0.
#[must_use]
pub fn random(seed: f64, index: f64) -> f64 {
    let bits = |v: f64| (v + 0.0).to_bits();
    let word = mix(mix(bits(seed).wrapping_add(0x9E37_79B9_7F4A_7C15)) ^ bits(index));
    (word >> 11) as f64 / (1u64 << 53) as f64
}

/// The finalizer of `SplitMix64`.
pub(crate) fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
