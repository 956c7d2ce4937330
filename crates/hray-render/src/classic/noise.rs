//! Perlin's gradient noise of 1985, several points at a time.
//!
//! Thesis §3.4, appendix A.3 `noise`; K. Perlin, "An Image Synthesizer", SIGGRAPH 1985. Neighbouring rays hit
//! neighbouring points, and for all but the highest octaves those lie in one cell of the lattice: then the
//! eight gradients are fetched once for all lanes. Where they do not, they are fetched lane by lane. The
//! arithmetic is the same in both cases.

use super::lanes::{Lanes, MAX_LANES, Vec3};
use fearless_simd::prelude::*;
use hray_core::NoiseTables;

/// Below this magnitude the integer part of a coordinate can be read off the low bits of a double.
const EXACT_CELLS: f64 = (1u64 << 50) as f64;
/// Added to an integer below 2^51 in magnitude, it leaves that integer, modulo 2^51, in the low bits.
const LOW_BITS: f64 = (3u64 << 51) as f64;
/// More octaves than this are left to the definition: they cannot be seen, only waited for.
const MAX_OCTAVES: u32 = 48;
/// Below this, scaling by a power of two might not be exact.
const TINY: f64 = 1e-280;

/// Noise tables, laid out for the kernel.
pub(super) struct Noise {
    permutations: [[u8; 256]; 3],
    /// The x, y and z components of the gradients.
    gradients: [[f64; 256]; 3],
}

/// How the octaves of a sum are taken.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sum {
    /// With their sign: `semiTurbulence`.
    Signed,
    /// By their absolute value: `turbulence`.
    Absolute,
}

/// The smooth step 3t² - 2t³, as written in appendix A.3.
#[inline(always)]
fn s_curve<S: Simd>(simd: S, t: Lanes<S>) -> Lanes<S> {
    t * t * (Lanes::<S>::splat(simd, 3.0) - t * 2.0)
}

#[inline(always)]
fn lerp<S: Simd>(t: Lanes<S>, a: Lanes<S>, b: Lanes<S>) -> Lanes<S> {
    a + t * (b - a)
}

/// The remainder of `floor(t)` modulo 256 through a 64-bit integer, with the overflow of GHC's `floor`: out of
/// range becomes -2^63, from which one is taken where the argument is smaller still.
fn cell_of(t: f64) -> usize {
    let truncated = if t >= -9_223_372_036_854_775_808.0 && t < 9_223_372_036_854_775_808.0 {
        t as i64
    } else {
        i64::MIN
    };
    let floor = if t < truncated as f64 { truncated.wrapping_sub(1) } else { truncated };
    (floor & 255) as usize
}

impl Noise {
    pub(super) fn new(tables: &NoiseTables) -> Self {
        Self {
            permutations: *tables.permutations(),
            gradients: std::array::from_fn(|axis| {
                std::array::from_fn(|index| tables.gradients()[index][axis])
            }),
        }
    }

    /// The gradient indices of the eight corners of a cell, in the order 000, 100, 010, 110, 001, 101, 011,
    /// 111 (x first).
    #[inline(always)]
    fn corners(permutation: &[u8; 256], x: usize, y: usize, z: usize) -> [u8; 8] {
        let at = |i: usize| usize::from(permutation[i & 255]);
        let (i, j) = (at(x), at(x + 1));
        let (b00, b10, b01, b11) = (at(i + y), at(j + y), at(i + y + 1), at(j + y + 1));
        [b00 + z, b10 + z, b01 + z, b11 + z, b00 + z + 1, b10 + z + 1, b01 + z + 1, b11 + z + 1]
            .map(|i| (i & 255) as u8)
    }

    /// Noise at points given in cells, `|coordinate| < 2^50`.
    #[inline(always)]
    fn noise_lanes<S: Simd>(&self, simd: S, table: usize, p: Vec3<S>) -> Lanes<S> {
        let permutation = &self.permutations[table];
        // A cell is floor(x + 256) mod 256, but the fraction is x - floor(x): for a tiny negative x the first
        // is 0 and the second 1.
        let r0 = p.map(|v| v - v.floor());
        let cells = p.map(|v| (v + 256.0).floor() + LOW_BITS);
        let r1 = r0.map(|v| v - 1.0);
        let s = r0.map(|t| s_curve(simd, t));

        let mask = 255u64;
        let (cx, cy, cz) = (cells.x.to_bits() & mask, cells.y.to_bits() & mask, cells.z.to_bits() & mask);
        let key = cx | (cy << 8) | (cz << 16);
        let first = key[0];
        let [gx, gy, gz] = &self.gradients;
        let gradients: [Vec3<S>; 8] = if key.simd_eq(first).all_true() {
            let place = |shift: u32| ((first >> shift) & 255) as usize;
            Self::corners(permutation, place(0), place(8), place(16)).map(|g| {
                let g = usize::from(g);
                Vec3 {
                    x: Lanes::<S>::splat(simd, gx[g]),
                    y: Lanes::<S>::splat(simd, gy[g]),
                    z: Lanes::<S>::splat(simd, gz[g]),
                }
            })
        } else {
            let mut corners = [[0u8; 8]; MAX_LANES];
            for (lane, corner) in corners.iter_mut().enumerate().take(Lanes::<S>::LEN) {
                let place = |shift: u32| ((key[lane] >> shift) & 255) as usize;
                *corner = Self::corners(permutation, place(0), place(8), place(16));
            }
            std::array::from_fn(
                #[inline(always)]
                |c| Vec3 {
                    x: Lanes::<S>::from_fn(simd, |lane| gx[usize::from(corners[lane][c])]),
                    y: Lanes::<S>::from_fn(simd, |lane| gy[usize::from(corners[lane][c])]),
                    z: Lanes::<S>::from_fn(simd, |lane| gz[usize::from(corners[lane][c])]),
                },
            )
        };

        let at = |c: usize| {
            let r = Vec3 {
                x: if c & 1 == 0 { r0.x } else { r1.x },
                y: if c & 2 == 0 { r0.y } else { r1.y },
                z: if c & 4 == 0 { r0.z } else { r1.z },
            };
            r.dot(gradients[c])
        };
        let low = lerp::<S>(s.y, lerp::<S>(s.x, at(0), at(1)), lerp::<S>(s.x, at(2), at(3)));
        let high = lerp::<S>(s.y, lerp::<S>(s.x, at(4), at(5)), lerp::<S>(s.x, at(6), at(7)));
        lerp::<S>(s.z, low, high)
    }

    /// Noise at one point given in cells: the definition, for coordinates that the lanes cannot take.
    fn noise_one(&self, table: usize, [x, y, z]: [f64; 3]) -> f64 {
        let curve = |t: f64| t * t * (3.0 - 2.0 * t);
        let mix = |t: f64, a: f64, b: f64| a + t * (b - a);
        let [x0, y0, z0] = [x, y, z].map(|v| v - v.floor());
        let [sx, sy, sz] = [x0, y0, z0].map(curve);
        let [cx, cy, cz] = [x, y, z].map(|v| cell_of(v + 256.0));
        let corners = Self::corners(&self.permutations[table], cx, cy, cz);
        let at = |c: usize| {
            let g = usize::from(corners[c]);
            let rx = if c & 1 == 0 { x0 } else { x0 - 1.0 };
            let ry = if c & 2 == 0 { y0 } else { y0 - 1.0 };
            let rz = if c & 4 == 0 { z0 } else { z0 - 1.0 };
            rx * self.gradients[0][g] + ry * self.gradients[1][g] + rz * self.gradients[2][g]
        };
        let low = mix(sy, mix(sx, at(0), at(1)), mix(sx, at(2), at(3)));
        let high = mix(sy, mix(sx, at(4), at(5)), mix(sx, at(6), at(7)));
        mix(sz, low, high)
    }

    /// The sum over octaves k = 0..=`octaves` of noise(2^k p / grid) / 2^k, from octave 0 upwards:
    /// `semiTurbulence` and `turbulence` of appendix A.3.
    #[inline(always)]
    pub(super) fn octaves<S: Simd>(
        &self,
        simd: S,
        table: usize,
        p: Vec3<S>,
        grid: f64,
        octaves: u32,
        sum: Sum,
    ) -> Lanes<S> {
        let cells = p.map(|v| v / grid);
        let top = (1u64 << octaves.min(MAX_OCTAVES)) as f64;
        let fits = |v: Lanes<S>| {
            let size = v.abs();
            (size * top).simd_lt(EXACT_CELLS) & (size.simd_ge(TINY) | size.simd_eq(0.0))
        };
        if octaves > MAX_OCTAVES || !(fits(cells.x) & fits(cells.y) & fits(cells.z)).all_true() {
            return Lanes::<S>::from_fn(simd, |i| {
                self.octaves_one(table, [p.x[i], p.y[i], p.z[i]], grid, octaves, sum)
            });
        }
        let value = |n: Lanes<S>| if sum == Sum::Absolute { n.abs() } else { n };
        let mut total = value(self.noise_lanes(simd, table, cells));
        let (mut scale, mut weight) = (1.0, 1.0);
        for _ in 0..octaves {
            scale *= 2.0;
            weight *= 0.5;
            // Dividing once and scaling by powers of two rounds as scaling first and dividing each time.
            let n = self.noise_lanes(simd, table, cells.map(|v| v * scale));
            total = value(n) * weight + total;
        }
        total
    }

    /// [`Noise::octaves`] at one point, as the definition has it.
    fn octaves_one(&self, table: usize, p: [f64; 3], grid: f64, octaves: u32, sum: Sum) -> f64 {
        if octaves >= 1024 {
            // 2^1024 is infinite, and noise is not a number there.
            return f64::NAN;
        }
        let value = |n: f64| if sum == Sum::Absolute { n.abs() } else { n };
        let mut total = value(self.noise_one(table, p.map(|v| v / grid)));
        let mut scale = 1.0;
        for _ in 0..octaves {
            scale *= 2.0;
            total += (1.0 / scale) * value(self.noise_one(table, p.map(|v| v * scale / grid)));
        }
        total
    }
}
