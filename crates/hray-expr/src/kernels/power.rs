//! The power of the specular highlight, several bases at a time, in the bits of [`libm::pow`].
//!
//! Highlights are half of the work of a shiny scene when their power is taken one by one, and the pictures of
//! 2005 are reproduced to the bit only if every power is rounded as `libm` rounds it. So the lanes follow its
//! algorithm operation by operation: FreeBSD's `e_pow.c` (Sun Microsystems, 1993), which takes
//! log2 |x| as the sum of two doubles, multiplies it by the exponent, and takes 2 to that power; the constants
//! and their names are that algorithm's. Lanes that it would treat as special cases are left to `libm`; a test
//! compares the rest with it.

use super::lanes::{Lanes, MAX_LANES, Mask};
use fearless_simd::prelude::*;

type Bits<S> = <S as Simd>::u64s;

/// Exponents below this in magnitude are taken in lanes.
const LARGEST: f64 = (1u64 << 31) as f64;

// log2(1.5) and 2 / (3 ln 2), each as a high part and a rest.
const DP_H: f64 = 0.5849624872207642;
const DP_L: f64 = 1.350039202129749e-08;
const CP: f64 = 0.9617966939259756;
const CP_H: f64 = 0.9617967009544373;
const CP_L: f64 = -7.028461650952758e-09;
/// Coefficients of (3/2) (log x - 2s - (2/3) s^3) in s^2, where s = (x - 1) / (x + 1).
const L: [f64; 6] = [
    0.5999999999999946,
    0.4285714285785502,
    0.33333332981837743,
    0.272728123808534,
    0.23066074577556175,
    0.20697501780033842,
];
// ln 2, as a high part and a rest.
const LG2: f64 = std::f64::consts::LN_2;
const LG2_H: f64 = 0.6931471824645996;
const LG2_L: f64 = -1.904654299957768e-09;
/// Coefficients of the exponential.
const P: [f64; 5] = [
    0.16666666666666602,
    -0.0027777777777015593,
    6.613756321437934e-05,
    -1.6533902205465252e-06,
    4.1381367970572385e-08,
];

/// Each lane to the power `exponent`.
#[inline(always)]
pub fn power<S: Simd>(simd: S, base: Lanes<S>, exponent: f64) -> Lanes<S> {
    if exponent == 2.0 {
        return base * base;
    }
    let size = base.abs();
    // Not zero, subnormal, infinite or not a number.
    let mut ordinary = size.simd_ge(f64::MIN_POSITIVE) & size.simd_lt(f64::INFINITY);
    // An ordinary exponent fits an integer.
    let integer = exponent as i64;
    if integer as f64 != exponent {
        ordinary &= base.simd_gt(0.0);
    }
    if is_ordinary(exponent) && ordinary.all_true() {
        let (result, settled) = ordinary_power(simd, size, exponent);
        if settled.all_true() {
            // Where the exponent is not whole all bases are positive, and so is the sign.
            return if integer & 1 == 1 { result.copysign(base) } else { result };
        }
    }
    one_by_one(simd, base, exponent)
}

/// Whether the exponent is no special case.
#[inline(always)]
fn is_ordinary(exponent: f64) -> bool {
    exponent.abs() < LARGEST && ![0.0, 0.5, 1.0, -1.0].contains(&exponent)
}

fn one_by_one_into(base: &[f64], exponent: f64, result: &mut [f64]) {
    for (result, base) in result.iter_mut().zip(base) {
        *result = libm::pow(*base, exponent);
    }
}

#[inline(always)]
fn one_by_one<S: Simd>(simd: S, base: Lanes<S>, exponent: f64) -> Lanes<S> {
    let mut result = [0.0; MAX_LANES];
    one_by_one_into(base.as_slice(), exponent, &mut result);
    Lanes::<S>::from_slice(simd, &result[..Lanes::<S>::LEN])
}

/// The power of normal positive numbers, and the lanes in which it is neither subnormal nor infinite.
#[inline(always)]
fn ordinary_power<S: Simd>(simd: S, x: Lanes<S>, y: f64) -> (Lanes<S>, Mask<S>) {
    let (t1, t2) = log2(simd, x);

    // y log2 x = p_h + p_l.
    let y1 = f64::from_bits(y.to_bits() & !0xFFFF_FFFF);
    let p_l = t1 * (y - y1) + t2 * y;
    let p_h = t1 * y1;
    let z = p_l + p_h;
    let tiny = z.simd_le(-1080.0);
    let settled = z.simd_lt(1020.0) & (z.simd_gt(-1020.0) | tiny);
    let zero = Lanes::<S>::splat(simd, 0.0);
    (tiny.select(zero, exp2(simd, z, p_h, p_l)), settled)
}

/// log2 x as t1 + t2, where t1 has a low word of zero.
#[inline(always)]
fn log2<S: Simd>(simd: S, x: Lanes<S>) -> (Lanes<S>, Lanes<S>) {
    let zero = Lanes::<S>::splat(simd, 0.0);
    let one = Lanes::<S>::splat(simd, 1.0);
    let bits: Bits<S> = x.bitcast();
    // The significand in [1, 2), and which of the intervals around 1, 1.5 and 2 it lies in.
    let fraction = bits & 0x000F_FFFF_FFFF_FFFF;
    let high = fraction >> 32;
    let around_one_and_half = high.simd_gt(0x3988E) & high.simd_lt(0xBB67A);
    let around_two = high.simd_ge(0xBB67A);
    let exponent_of_one = Bits::<S>::splat(simd, 0x3FF0_0000_0000_0000);
    let exponent_of_half = Bits::<S>::splat(simd, 0x3FE0_0000_0000_0000);
    let ax_bits = fraction | around_two.select(exponent_of_half, exponent_of_one);
    let ax = ax_bits.bitcast::<Lanes<S>>();
    // The exponent, unbiased: biased bits in the mantissa of 2^52 make the number 2^52 + exponent.
    let exponent =
        ((bits >> 52) | 0x4330_0000_0000_0000).bitcast::<Lanes<S>>() - 4_503_599_627_370_496.0 - 1023.0;
    let n = around_two.select(exponent + 1.0, exponent);
    let bp = around_one_and_half.select(Lanes::<S>::splat(simd, 1.5), one);
    let dp_h = around_one_and_half.select(Lanes::<S>::splat(simd, DP_H), zero);
    let dp_l = around_one_and_half.select(Lanes::<S>::splat(simd, DP_L), zero);

    // ss = s_h + s_l = (ax - bp) / (ax + bp).
    let u = ax - bp;
    let v = one / (ax + bp);
    let ss = u * v;
    let s_h = high_word::<S>(ss);
    let k = around_one_and_half.select(Bits::<S>::splat(simd, 1 << 18), Bits::<S>::splat(simd, 0));
    let t_h = ((((ax_bits >> 33) | 0x2000_0000) + 0x0008_0000 + k) << 32).bitcast::<Lanes<S>>();
    let t_l = ax - (t_h - bp);
    let s_l = v * ((u - s_h * t_h) - s_h * t_l);
    // log ax.
    let s2 = ss * ss;
    let r = s2 * s2 * (s2 * (s2 * (s2 * (s2 * (s2 * L[5] + L[4]) + L[3]) + L[2]) + L[1]) + L[0]);
    let r = r + s_l * (s_h + ss);
    let s2 = s_h * s_h;
    let t_h = high_word::<S>(s2 + 3.0 + r);
    let t_l = r - ((t_h - 3.0) - s2);
    let u = s_h * t_h;
    let v = s_l * t_h + t_l * ss;
    // 2 / (3 log 2) (ss + ...).
    let p_h = high_word::<S>(u + v);
    let p_l = v - (p_h - u);
    let z_h = p_h * CP_H;
    let z_l = p_h * CP_L + p_l * CP + dp_l;
    let t1 = high_word::<S>(((z_h + z_l) + dp_h) + n);
    (t1, z_l - (((t1 - n) - dp_h) - z_h))
}

/// 2 to the power p_h + p_l, which is about z.
#[inline(always)]
fn exp2<S: Simd>(simd: S, z: Lanes<S>, p_h: Lanes<S>, p_l: Lanes<S>) -> Lanes<S> {
    // The nearest whole number, where |z| is above 1/2 (by the high word of z, whose last bit is 2^-21 there).
    let size = z.abs();
    let whole = (size + 0.5).floor();
    let rounds = size.simd_ge(0.5 + 1.0 / 2_097_152.0);
    let whole = rounds.select(whole, Lanes::<S>::splat(simd, 0.0)).copysign(z);
    let p_h = p_h - whole;
    let t = high_word::<S>(p_l + p_h);
    let u = t * LG2_H;
    let v = (p_l - (t - p_h)) * LG2 + t * LG2_L;
    let z = u + v;
    let w = v - (z - u);
    let t = z * z;
    let t1 = z - t * (t * (t * (t * (t * P[4] + P[3]) + P[2]) + P[1]) + P[0]);
    let r = (z * t1) / (t1 - 2.0) - (w + z * w);
    let one = Lanes::<S>::splat(simd, 1.0);
    let mantissa = one - (r - z);
    // Adding the whole part to the exponent: as 2^52 + 2^51 + whole its low bits are a two's complement.
    let steps = (whole + 6_755_399_441_055_744.0).to_bits() << 52;
    Lanes::<S>::from_bits(mantissa.to_bits() + steps)
}

/// The number without the low half of its bits.
#[inline(always)]
fn high_word<S: Simd>(x: Lanes<S>) -> Lanes<S> {
    Lanes::<S>::from_bits(x.to_bits() & !0xFFFF_FFFF)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    #[inline(always)]
    fn power_of_all<S: Simd>(simd: S, bases: &[f64; MAX_LANES], exponent: f64) -> [f64; MAX_LANES] {
        let mut result = [0.0; MAX_LANES];
        for (from, to) in bases.chunks(Lanes::<S>::LEN).zip(result.chunks_mut(Lanes::<S>::LEN)) {
            power(simd, Lanes::<S>::from_slice(simd, from), exponent).store_slice(to);
        }
        result
    }

    fn check(bases: [f64; MAX_LANES], exponent: f64) {
        for level in [Level::new(), Level::baseline()] {
            let result = dispatch!(level, simd => power_of_all(simd, &bases, exponent));
            for (base, result) in bases.iter().zip(result) {
                let expected = libm::pow(*base, exponent);
                assert!(
                    result.to_bits() == expected.to_bits() || (result.is_nan() && expected.is_nan()),
                    "{base:e} ^ {exponent}: {result:e} instead of {expected:e}"
                );
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// Cosines and the exponents people write.
        #[test]
        fn as_libm_on_cosines(bases in proptest::array::uniform8(-1.0..1.0f64), exponent in 0..300i32) {
            check(bases, f64::from(exponent));
        }

        /// Exponents that are not whole.
        #[test]
        fn as_libm_on_fractions(
            bases in proptest::array::uniform8(0.0..4.0f64),
            sign in proptest::bool::ANY,
            exponent in prop_oneof![-8.0..8.0f64, (-40i32..40).prop_map(|n| f64::from(n) / 4.0)],
        ) {
            check(bases.map(|base| if sign { -base } else { base }), exponent);
        }

        /// Near 1, where the logarithm cancels, and large exponents.
        #[test]
        fn as_libm_near_one(
            bases in proptest::array::uniform8((-1i64 << 40..1i64 << 40).prop_map(|d| 1.0 + d as f64 * 1e-16)),
            exponent in 0..3_000_000i64,
        ) {
            check(bases, exponent as f64);
        }

        /// Anything at all.
        #[test]
        fn as_libm_on_all_bits(bases in proptest::array::uniform8(any::<u64>().prop_map(f64::from_bits)), exponent in any::<i16>()) {
            check(bases, f64::from(exponent));
        }

        /// Numbers of moderate size, so that few results leave the range.
        #[test]
        fn as_libm_on_moderate_numbers(bases in proptest::array::uniform8(-8.0..8.0f64), exponent in -400..400i32) {
            check(bases, f64::from(exponent));
        }
    }

    #[test]
    fn as_libm_at_the_seams() {
        let seams = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, f64::NAN, f64::INFINITY];
        let intervals = [1.5f64, 1.224744871391589, 1.7320508075688772, 0.75, 1e-300, 5e-324, 1e300, -1.5];
        for exponent in (-5..70).chain([1 << 20, i64::from(i32::MAX), 1 << 31, 1 << 40, i64::MAX, i64::MIN]) {
            check(seams, exponent as f64);
            check(intervals, exponent as f64);
            check(intervals.map(f64::next_up), exponent as f64);
            check(intervals.map(f64::next_down), exponent as f64);
        }
    }
}
