//! Sine and cosine, several arguments at a time, in the bits of [`libm::sin`] and [`libm::cos`].
//!
//! As with [`power`](super::power), the lanes follow the algorithm of `libm` operation by operation: FreeBSD's
//! `s_sin.c`, `s_cos.c`, `e_rem_pio2.c`, `k_sin.c` and `k_cos.c` (Sun Microsystems, 1993). The argument is reduced by the
//! nearest multiple of pi/2, as two doubles, and a polynomial of sine or cosine taken of the rest. Arguments
//! that need more than one round of reduction, and those so close to the seam between two multiples that
//! `libm` decides by a table, are left to it.

use super::lanes::{Lanes, MAX_LANES, Mask};
use fearless_simd::prelude::*;

/// Larger arguments need a longer pi.
const LARGEST: f64 = 1e6;
/// Adding and subtracting it rounds to a whole number.
const TO_WHOLE: f64 = (3u64 << 51) as f64;
const INV_PIO2: f64 = std::f64::consts::FRAC_2_PI;
/// pi/2 as its first 33 bits and the rest.
const PIO2_1: f64 = 1.5707963267341256;
const PIO2_1T: f64 = 6.077100506506192e-11;
/// The high word of pi/4: up to here the argument is its own remainder.
const QUARTER_PI: u64 = 0x3FE9_21FB;
/// The high words from the seams at 3, 5, 7 and 9 pi/4 to where `libm` puts them.
const SEAMS: [u64; 6] = [0x4002_D97C, 0x400F_6A7A, 0x4015_FDBB, 0x4015_FDBC, 0x401C_463A, 0x401C_463B];
/// Coefficients of the sine in odd powers, from the third.
const S: [f64; 6] = [
    -0.16666666666666632,
    0.00833333333332249,
    -0.0001984126982985795,
    2.7557313707070068e-06,
    -2.5050760253406863e-08,
    1.58969099521155e-10,
];
/// Coefficients of the cosine in even powers, from the fourth.
const C: [f64; 6] = [
    0.0416666666666666,
    -0.001388888888887411,
    2.480158728947673e-05,
    -2.7557314351390663e-07,
    2.087572321298175e-09,
    -1.1359647557788195e-11,
];

/// The sine of each lane, in radians.
#[inline(always)]
pub fn sine<V: Simd>(simd: V, x: Lanes<V>) -> Lanes<V> {
    let high = x.abs().bitcast::<V::u64s>() >> 32;
    if ordinary::<V>(x, high).all_true() {
        let Reduced { y0, y1, quadrant, direct, settled } = reduced(simd, x, high);
        if settled.all_true() {
            let odd: Mask<V> = (quadrant & 1).simd_eq(1);
            let reduced = odd.select(k_cos(simd, y0, y1), k_sin(y0, y1));
            let negative: Mask<V> = quadrant.simd_ge(2);
            let reduced = negative.select(-reduced, reduced);
            let tiny = x.abs().simd_lt(1.0 / 67_108_864.0);
            let small = tiny.select(x, k_sin_alone::<V>(x));
            return direct.select(small, reduced);
        }
    }
    one_by_one(simd, x, libm::sin)
}

/// The cosine of each lane, in radians.
#[inline(always)]
pub fn cosine<V: Simd>(simd: V, x: Lanes<V>) -> Lanes<V> {
    let high = x.abs().bitcast::<V::u64s>() >> 32;
    if ordinary::<V>(x, high).all_true() {
        let Reduced { y0, y1, quadrant, direct, settled } = reduced(simd, x, high);
        if settled.all_true() {
            let zero = Lanes::<V>::splat(simd, 0.0);
            // What is its own remainder is so in quadrant 0, though it may be a little above pi/4.
            let (y0, y1) = (direct.select(x, y0), direct.select(zero, y1));
            let quadrant = direct.select(V::u64s::splat(simd, 0), quadrant);
            let odd: Mask<V> = (quadrant & 1).simd_eq(1);
            let reduced = odd.select(k_sin(y0, y1), k_cos(simd, y0, y1));
            let negative: Mask<V> = ((quadrant + 1) & 2).simd_eq(2);
            return negative.select(-reduced, reduced);
        }
    }
    one_by_one(simd, x, libm::cos)
}

/// The lanes that need no longer pi and are not at a seam.
#[inline(always)]
fn ordinary<V: Simd>(x: Lanes<V>, high: V::u64s) -> Mask<V> {
    let mut ordinary: Mask<V> = x.abs().simd_lt(LARGEST);
    for seam in SEAMS {
        ordinary &= !high.simd_eq(seam);
    }
    ordinary
}

#[inline(always)]
fn one_by_one<V: Simd>(simd: V, x: Lanes<V>, f: fn(f64) -> f64) -> Lanes<V> {
    let mut result = [0.0; MAX_LANES];
    for (result, &x) in result.iter_mut().zip(x.as_slice()) {
        *result = f(x);
    }
    Lanes::<V>::from_slice(simd, &result[..Lanes::<V>::LEN])
}

/// Angles less a whole number of right angles.
struct Reduced<V: Simd> {
    /// The rest, in [-pi/4, pi/4], and its tail.
    y0: Lanes<V>,
    y1: Lanes<V>,
    /// The number of right angles, modulo 4.
    quadrant: V::u64s,
    /// The lanes whose angles `libm` does not reduce.
    direct: Mask<V>,
    /// The lanes in which one round of reduction is enough.
    settled: Mask<V>,
}

#[inline(always)]
fn reduced<V: Simd>(_: V, x: Lanes<V>, high: V::u64s) -> Reduced<V> {
    let whole = x * INV_PIO2 + TO_WHOLE;
    let quadrant = whole.bitcast::<V::u64s>() & 3;
    let n = whole - TO_WHOLE;
    let r = x - n * PIO2_1;
    let w = n * PIO2_1T;
    let y0 = r - w;
    let y1 = (r - y0) - w;
    // Where more than 16 bits cancel, the rest of pi/2 is too short.
    let rest = (y0.abs().bitcast::<V::u64s>() >> 52) + 16;
    let direct: Mask<V> = high.simd_le(QUARTER_PI);
    let settled = direct | (high >> 20).simd_le(rest);
    Reduced { y0, y1, quadrant, direct, settled }
}

/// The sine of x + y in [-pi/4, pi/4], where y is the tail of x.
#[inline(always)]
fn k_sin<L: SimdFloat<V, Element = f64>, V: Simd>(x: L, y: L) -> L {
    let z = x * x;
    let v = z * x;
    let r = sine_tail(z);
    x - ((z * (y * 0.5 - v * r) - y) - v * S[0])
}

/// The sine of x in [-pi/4, pi/4].
#[inline(always)]
fn k_sin_alone<V: Simd>(x: Lanes<V>) -> Lanes<V> {
    let z = x * x;
    let v = z * x;
    x + v * (z * sine_tail(z) + S[0])
}

#[inline(always)]
fn sine_tail<L: SimdFloat<V, Element = f64>, V: Simd>(z: L) -> L {
    let w = z * z;
    z * (z * S[3] + S[2]) + S[1] + z * w * (z * S[5] + S[4])
}

/// The cosine of x + y in [-pi/4, pi/4], where y is the tail of x.
#[inline(always)]
fn k_cos<V: Simd>(simd: V, x: Lanes<V>, y: Lanes<V>) -> Lanes<V> {
    let one = Lanes::<V>::splat(simd, 1.0);
    let z = x * x;
    let w = z * z;
    let r = z * (z * (z * C[2] + C[1]) + C[0]) + w * w * (z * (z * C[5] + C[4]) + C[3]);
    let half = z * 0.5;
    let w = one - half;
    w + (((one - w) - half) + (z * r - x * y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;
    use std::f64::consts::FRAC_PI_4;

    #[inline(always)]
    fn both_of_all<V: Simd>(simd: V, x: &[f64; MAX_LANES]) -> [[f64; MAX_LANES]; 2] {
        let mut result = [[0.0; MAX_LANES]; 2];
        for start in (0..MAX_LANES).step_by(Lanes::<V>::LEN) {
            let x = Lanes::<V>::from_slice(simd, &x[start..start + Lanes::<V>::LEN]);
            sine(simd, x).store_slice(&mut result[0][start..start + Lanes::<V>::LEN]);
            cosine(simd, x).store_slice(&mut result[1][start..start + Lanes::<V>::LEN]);
        }
        result
    }

    fn check(x: [f64; MAX_LANES]) {
        for level in [Level::new(), Level::baseline()] {
            let [sines, cosines] = dispatch!(level, simd => both_of_all(simd, &x));
            for (x, (sine, cosine)) in x.iter().zip(sines.into_iter().zip(cosines)) {
                for (name, result, expected) in [("sin", sine, libm::sin(*x)), ("cos", cosine, libm::cos(*x))]
                {
                    assert!(
                        result.to_bits() == expected.to_bits() || (result.is_nan() && expected.is_nan()),
                        "{name} {x:e}: {result:e} instead of {expected:e}"
                    );
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// A few turns, where the reduction has a branch for each multiple of pi/2.
        #[test]
        fn as_libm_in_the_first_turns(x in proptest::array::uniform8(-12.0..12.0f64)) {
            check(x);
        }

        /// The arguments of marble and wood.
        #[test]
        fn as_libm_on_moderate_numbers(x in proptest::array::uniform8(-2e3..2e3f64)) {
            check(x);
        }

        /// Anything at all.
        #[test]
        fn as_libm_on_all_bits(x in proptest::array::uniform8(any::<u64>().prop_map(f64::from_bits))) {
            check(x);
        }

        /// Close to multiples of pi/4, where the reduction cancels or changes its mind.
        #[test]
        fn as_libm_at_the_seams(k in -40i32..40, ulps in proptest::array::uniform8(-1i64 << 34..1i64 << 34)) {
            let near = f64::from(k) * FRAC_PI_4;
            check(ulps.map(|d| f64::from_bits(near.to_bits().wrapping_add_signed(d))));
        }
    }

    #[test]
    fn as_libm_at_special_numbers() {
        check([0.0, -0.0, f64::NAN, f64::INFINITY, 1e-9, -1e-300, 5e-324, 1e22]);
        check([1e6, -1e6, 999_999.9, FRAC_PI_4.next_up(), -FRAC_PI_4, 0.785, 1e5, 3e-8]);
        check([0.0, -0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    }
}
