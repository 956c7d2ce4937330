//! Gradient noise at one point: the definitions, plain and slow. [`crate::kernels`] has the fast ones.

use crate::NoiseTables;
use crate::apply::SplitMix64;

/// The permutation of the reference implementation of improved noise (K. Perlin, 2002).
#[rustfmt::skip]
const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99, 37,
    240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32, 57, 177,
    33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27, 166, 77, 146,
    158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25,
    63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130, 116, 188, 159, 86, 164, 100,
    109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212, 207, 206,
    59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119, 248, 152, 2, 44, 154, 163, 70, 221, 153,
    101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104, 218, 246,
    97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192,
    214, 31, 181, 199, 106, 157, 184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114,
    67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180,
];

/// The permutation of a seed: 0 is the published one, any other shuffles it as [`NoiseTables::generate`] does, by
/// words from that seed.
pub(crate) fn improved_permutation(seed: u64) -> [u8; 256] {
    let mut permutation = PERMUTATION;
    if seed != 0 {
        SplitMix64(seed).shuffle(&mut permutation);
    }
    permutation
}

/// Added to a whole number below 2^51 in magnitude, it makes a sum whose bits count as the number does. Those of
/// larger numbers are something else, but always the same.
pub(crate) const LOW_BITS: f64 = (3u64 << 51) as f64;

/// The cell of a coordinate, counted from a number whose low byte is 0.
pub(crate) fn cell(x: f64) -> u64 {
    (x.floor() + LOW_BITS).to_bits()
}

/// K. Perlin's noise of 2002 ("Improving Noise", SIGGRAPH 2002) at a point given in cells: about in [-1, 1], and 0
/// at whole coordinates. It repeats every 256 cells. Zero is always positive; where a coordinate is infinite or
/// not a number, so is the noise.
#[must_use]
pub fn improved_noise(seed: u64, [x, y, z]: [f64; 3]) -> f64 {
    let permutation = improved_permutation(seed);
    let hash = |i: u64| u64::from(permutation[(i & 255) as usize]);
    let [i, j, k] = [x, y, z].map(cell);
    let [x, y, z] = [x, y, z].map(|v| v - v.floor());
    let corner = |a: u64, b: u64, c: u64| {
        let h = hash(hash(hash(i.wrapping_add(a)) + j.wrapping_add(b)) + k.wrapping_add(c));
        gradient(h, x - a as f64, y - b as f64, z - c as f64)
    };
    let [u, v, w] = [x, y, z].map(fade);
    let low = mix(v, mix(u, corner(0, 0, 0), corner(1, 0, 0)), mix(u, corner(0, 1, 0), corner(1, 1, 0)));
    let high = mix(v, mix(u, corner(0, 0, 1), corner(1, 0, 1)), mix(u, corner(0, 1, 1), corner(1, 1, 1)));
    mix(w, low, high) + 0.0
}

/// 6t^5 - 15t^4 + 10t^3.
fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

fn mix(t: f64, a: f64, b: f64) -> f64 {
    a + t * (b - a)
}

/// The product of (x, y, z) with one of the twelve directions to the edges of a cube.
fn gradient(hash: u64, x: f64, y: f64, z: f64) -> f64 {
    let h = hash & 15;
    let u = if h < 8 { x } else { y };
    let v = match h {
        0..=3 => y,
        12 | 14 => x,
        _ => z,
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

/// K. Perlin's noise of 1985 with the gradients of `tables` and the permutation of a seed
/// ([`NoiseTables::permutation`]), at a point given in cells: about in [-1, 1], and 0 at whole coordinates.
/// Thesis §3.4, appendix A.3 `noise`.
#[must_use]
pub fn classic_noise(tables: &NoiseTables, seed: u64, [x, y, z]: [f64; 3]) -> f64 {
    let permutation = tables.permutation(seed);
    let hash = |i: u64| u64::from(permutation[(i & 255) as usize]);
    let [i, j, k] = [x, y, z].map(|v| classic_cell(v + 256.0));
    let [x, y, z] = [x, y, z].map(|v| v - v.floor());
    let corner = |a: u64, b: u64, c: u64| {
        let h = hash(hash(i + a) + j + b) + k + c;
        let g = tables.gradients()[(h & 255) as usize];
        (x - a as f64) * g[0] + (y - b as f64) * g[1] + (z - c as f64) * g[2]
    };
    let [u, v, w] = [x, y, z].map(|t| t * t * (3.0 - 2.0 * t));
    let low = mix(v, mix(u, corner(0, 0, 0), corner(1, 0, 0)), mix(u, corner(0, 1, 0), corner(1, 1, 0)));
    let high = mix(v, mix(u, corner(0, 0, 1), corner(1, 0, 1)), mix(u, corner(0, 1, 1), corner(1, 1, 1)));
    mix(w, low, high)
}

/// The remainder of `floor(t)` modulo 256 through a 64-bit integer, with the overflow of GHC's `floor`: out of
/// range becomes -2^63, from which one is taken where the argument is smaller still.
pub(crate) fn classic_cell(t: f64) -> u64 {
    const LIMIT: f64 = (1u64 << 63) as f64;
    let truncated = if (-LIMIT..LIMIT).contains(&t) { t as i64 } else { i64::MIN };
    let floor = if t < truncated as f64 { truncated.wrapping_sub(1) } else { truncated };
    (floor & 255) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permutations_hold_every_byte_once() {
        for seed in [0, 1, 7, u64::MAX] {
            let mut sorted = improved_permutation(seed);
            sorted.sort_unstable();
            assert!(sorted.iter().zip(0..=255u8).all(|(a, b)| *a == b));
        }
        assert_ne!(improved_permutation(0), improved_permutation(1));
    }

    /// What the reference implementation prints.
    #[test]
    fn improved_noise_is_the_published_one() {
        assert_eq!(improved_noise(0, [157.0 / 50.0, 42.0, 7.0]), 0.136_919_958_784_000_12);
    }

    #[test]
    fn noise_vanishes_at_whole_points_and_is_defined_everywhere() {
        let tables = NoiseTables::default();
        for p in [[0.0; 3], [1.0, -2.0, 3.0], [1e15, -1e17, 1e300]] {
            assert_eq!(improved_noise(3, p).to_bits(), 0);
            assert_eq!(classic_noise(&tables, 3, p), 0.0);
        }
        for p in [[f64::NAN, 0.0, 0.0], [0.5, f64::INFINITY, 0.0], [0.5, 0.5, f64::NEG_INFINITY]] {
            assert!(improved_noise(0, p).is_nan());
            assert!(classic_noise(&tables, 0, p).is_nan());
        }
        assert_ne!(improved_noise(0, [0.3, 0.4, 0.5]), improved_noise(1, [0.3, 0.4, 0.5]));
        assert_ne!(classic_noise(&tables, 0, [0.3, 0.4, 0.5]), classic_noise(&tables, 9, [0.3, 0.4, 0.5]));
    }
}
