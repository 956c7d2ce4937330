//! Perlin's improved noise of 2002, several points at a time, in the bits of [`crate::improved_noise`].
//!
//! The gradients are the twelve directions to the edges of a cube, so the product with one is the sum of two
//! coordinates, each perhaps negated: four bits say which and how. The 32 bits for the eight corners of a cell take
//! seven look-ups in small tables, made lane by lane; what follows is arithmetic in lanes alone. Neighbouring points
//! often share a cell: then the gradients are the same for all lanes, and plain products are shorter.

use super::lanes::{Lanes, MAX_LANES, Vec3};
use crate::noise::{LOW_BITS, improved_permutation};
use fearless_simd::prelude::*;

const SIGN: u64 = 1 << 63;

/// The permutation of one seed, laid out for the kernel.
pub struct Improved {
    /// Of the permutation P, the pairs (P(i), P(i + 1)) for i to 511, all modulo 256.
    pairs: [[u8; 2]; 512],
    /// The codes of the gradients of such pairs, the second in the high bits.
    codes: [u8; 512],
}

/// A gradient by its code.
///
/// Bit 0 negates the first coordinate, bit 1 the second; the first is x or, with bit 2, y; the second is y or, with
/// bit 3, z.
const GRADIENTS: [[f64; 4]; 16] = gradients();

/// The codes of the hashes modulo 16: as in the reference implementation, where four of the directions come twice.
const CODES: [u8; 16] = [
    0b0000, 0b0001, 0b0010, 0b0011, // x and y
    0b1000, 0b1001, 0b1010, 0b1011, // x and z
    0b1100, 0b1101, 0b1110, 0b1111, // y and z
    0b0000, 0b1101, 0b0001, 0b1111, // y + x, z - y, y - x, -y - z
];

const fn gradients() -> [[f64; 4]; 16] {
    let mut gradients = [[0.0; 4]; 16];
    let mut code = 0;
    while code < 16 {
        let first = (code >> 2) & 1;
        let second = 1 + ((code >> 3) & 1);
        gradients[code][second] = if code & 2 == 0 { 1.0 } else { -1.0 };
        gradients[code][first] = if code & 1 == 0 { 1.0 } else { -1.0 };
        code += 1;
    }
    gradients
}

/// The coordinates of the lanes from the lowest and from the highest corner of their cells, and the weights.
#[derive(Clone, Copy)]
struct Place<S: Simd> {
    r0: Vec3<S>,
    r1: Vec3<S>,
    s: Vec3<S>,
}

impl Improved {
    /// For a seed; 0 is the published permutation.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        let permutation = improved_permutation(seed);
        let (mut pairs, mut codes) = ([[0; 2]; 512], [0; 512]);
        for (i, (pair, code)) in pairs.iter_mut().zip(&mut codes).enumerate() {
            *pair = [permutation[i & 255], permutation[(i + 1) & 255]];
            let [low, high] = pair.map(|hash| CODES[usize::from(hash & 15)]);
            *code = low | high << 4;
        }
        Self { pairs, codes }
    }

    /// The codes of the corners of a cell, from the low bytes of `key`: x, y, z. Four bits each from the lowest, in
    /// the order of z, then x, then y.
    #[inline(always)]
    fn word(&self, key: u64) -> u64 {
        let [x, y, z] = [key & 255, (key >> 8) & 255, (key >> 16) & 255].map(|i| i as usize);
        let [i, j] = self.pairs[x];
        let [b00, b01] = self.pairs[usize::from(i) + y];
        let [b10, b11] = self.pairs[usize::from(j) + y];
        let [c00, c10, c01, c11] = [b00, b10, b01, b11].map(|b| u64::from(self.codes[usize::from(b) + z]));
        c00 | c10 << 8 | c01 << 16 | c11 << 24
    }

    /// Noise at points given in cells.
    #[inline(always)]
    pub fn noise<S: Simd>(&self, simd: S, p: Vec3<S>) -> Lanes<S> {
        let floor = Vec3::<S> { x: p.x.floor(), y: p.y.floor(), z: p.z.floor() };
        let r0 = Vec3::<S> { x: p.x - floor.x, y: p.y - floor.y, z: p.z - floor.z };
        let r1 = Vec3::<S> { x: r0.x - 1.0, y: r0.y - 1.0, z: r0.z - 1.0 };
        let s = Vec3::<S> { x: fade::<S>(r0.x), y: fade::<S>(r0.y), z: fade::<S>(r0.z) };
        let key = byte::<S>(floor.x) | (byte::<S>(floor.y) << 8) | (byte::<S>(floor.z) << 16);
        let at = Place { r0, r1, s };

        let first = key[0];
        // Zero is made positive, so that all ways to it agree.
        if key.simd_eq(first).all_true() {
            return same_cell(simd, self.word(first), at) + 0.0;
        }
        let mut words = [0; MAX_LANES];
        for lane in 0..Lanes::<S>::LEN {
            words[lane] = self.word(key[lane]);
        }
        each_cell(simd, S::u64s::from_slice(simd, &words[..Lanes::<S>::LEN]), at) + 0.0
    }
}

/// Noise in one cell.
#[inline(always)]
fn same_cell<S: Simd>(simd: S, word: u64, Place { r0, r1, s }: Place<S>) -> Lanes<S> {
    let low00 = product(simd, word, r0.x, r0.y, r0.z);
    let low10 = product(simd, word >> 8, r1.x, r0.y, r0.z);
    let low01 = product(simd, word >> 16, r0.x, r1.y, r0.z);
    let low11 = product(simd, word >> 24, r1.x, r1.y, r0.z);
    let low = lerp::<S>(s.y, lerp::<S>(s.x, low00, low10), lerp::<S>(s.x, low01, low11));
    let high00 = product(simd, word >> 4, r0.x, r0.y, r1.z);
    let high10 = product(simd, word >> 12, r1.x, r0.y, r1.z);
    let high01 = product(simd, word >> 20, r0.x, r1.y, r1.z);
    let high11 = product(simd, word >> 28, r1.x, r1.y, r1.z);
    let high = lerp::<S>(s.y, lerp::<S>(s.x, high00, high10), lerp::<S>(s.x, high01, high11));
    lerp::<S>(s.z, low, high)
}

/// The product with the gradient whose code is in the low bits of `word`.
#[inline(always)]
fn product<S: Simd>(_: S, word: u64, x: Lanes<S>, y: Lanes<S>, z: Lanes<S>) -> Lanes<S> {
    let g = &GRADIENTS[(word & 15) as usize];
    x * g[0] + y * g[1] + z * g[2]
}

/// Noise where each lane has its own cell.
#[inline(always)]
fn each_cell<S: Simd>(simd: S, word: S::u64s, Place { r0, r1, s }: Place<S>) -> Lanes<S> {
    let low00 = signed_sum(simd, word << 60, r0.x, r0.y, r0.z);
    let low10 = signed_sum(simd, word << 52, r1.x, r0.y, r0.z);
    let low01 = signed_sum(simd, word << 44, r0.x, r1.y, r0.z);
    let low11 = signed_sum(simd, word << 36, r1.x, r1.y, r0.z);
    let low = lerp::<S>(s.y, lerp::<S>(s.x, low00, low10), lerp::<S>(s.x, low01, low11));
    let high00 = signed_sum(simd, word << 56, r0.x, r0.y, r1.z);
    let high10 = signed_sum(simd, word << 48, r1.x, r0.y, r1.z);
    let high01 = signed_sum(simd, word << 40, r0.x, r1.y, r1.z);
    let high11 = signed_sum(simd, word << 32, r1.x, r1.y, r1.z);
    let high = lerp::<S>(s.y, lerp::<S>(s.x, high00, high10), lerp::<S>(s.x, high01, high11));
    lerp::<S>(s.z, low, high)
}

/// The same with the gradients whose codes are in the top bits of `word`.
#[inline(always)]
fn signed_sum<S: Simd>(simd: S, word: S::u64s, x: Lanes<S>, y: Lanes<S>, z: Lanes<S>) -> Lanes<S> {
    let zero = S::i64s::splat(simd, 0);
    let second = word.bitcast::<S::i64s>().simd_lt(zero).select(z, y);
    let first = (word << 1).bitcast::<S::i64s>().simd_lt(zero).select(y, x);
    flip::<S>(first, word << 3) + flip::<S>(second, word << 2)
}

/// Negates where the top bit is set.
#[inline(always)]
fn flip<S: Simd>(v: Lanes<S>, word: S::u64s) -> Lanes<S> {
    (v.bitcast::<S::u64s>() ^ (word & SIGN)).bitcast()
}

/// 6t^5 - 15t^4 + 10t^3.
#[inline(always)]
fn fade<S: Simd>(t: Lanes<S>) -> Lanes<S> {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[inline(always)]
fn lerp<S: Simd>(t: Lanes<S>, a: Lanes<S>, b: Lanes<S>) -> Lanes<S> {
    a + t * (b - a)
}

/// The low byte of a whole number.
#[inline(always)]
fn byte<S: Simd>(whole: Lanes<S>) -> S::u64s {
    (whole + LOW_BITS).bitcast::<S::u64s>() & 255
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::improved_noise;
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;

    #[inline(always)]
    fn noise_of_all<S: Simd>(simd: S, noise: &Improved, p: &[[f64; MAX_LANES]; 3]) -> [f64; MAX_LANES] {
        let mut result = [0.0; MAX_LANES];
        for (i, to) in result.chunks_mut(Lanes::<S>::LEN).enumerate() {
            let at = Vec3::load(simd, [&p[0], &p[1], &p[2]], i * Lanes::<S>::LEN);
            noise.noise(simd, at).store_slice(to);
        }
        result
    }

    fn check(seed: u64, p: [[f64; MAX_LANES]; 3]) {
        let noise = Improved::new(seed);
        for level in [Level::new(), Level::baseline()] {
            let result = dispatch!(level, simd => noise_of_all(simd, &noise, &p));
            for (lane, result) in result.into_iter().enumerate() {
                let expected = improved_noise(seed, [p[0][lane], p[1][lane], p[2][lane]]);
                assert!(
                    result.to_bits() == expected.to_bits() || (result.is_nan() && expected.is_nan()),
                    "{p:?}, lane {lane}: {result:e} instead of {expected:e}"
                );
            }
        }
    }

    fn lanes(v: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = [[f64; MAX_LANES]; 3]> {
        proptest::array::uniform3(proptest::array::uniform8(v))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2_000))]

        #[test]
        fn as_the_definition_in_many_cells(seed in 0..3u64, p in lanes(-300.0..300.0f64)) {
            check(seed, p);
        }

        #[test]
        fn as_the_definition_in_one_cell(seed in 0..3u64, p in lanes(0.0..1.0f64)) {
            check(seed, p);
        }

        #[test]
        fn as_the_definition_on_all_bits(p in lanes(any::<u64>().prop_map(f64::from_bits))) {
            check(0, p);
        }

        #[test]
        fn as_the_definition_near_whole_points(p in lanes((-3i32..3, -2i32..3).prop_map(|(whole, ulps)| {
            f64::from(whole) + f64::from(ulps) * 1e-17
        }))) {
            check(0, p);
        }
    }
}
