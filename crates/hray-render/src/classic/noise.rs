//! Perlin's gradient noise of 1985, several points at a time.
//!
//! Thesis §3.4, appendix A.3 `noise`; K. Perlin, "An Image Synthesizer", SIGGRAPH 1985. Neighbouring rays hit
//! neighbouring points, and for all but the highest octaves those lie in one cell of the lattice: then the
//! eight gradients are fetched once for all lanes. Where they do not, they are fetched lane by lane. The
//! arithmetic is the same in both cases.

use super::lanes::{Lanes, MAX_LANES, Mask, Vec3};
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

/// Whether the lanes may be scaled by up to `top` and still be taken apart by [`cell`].
#[inline(always)]
fn fits<S: Simd>(v: Lanes<S>, top: f64) -> Mask<S> {
    let size = v.abs();
    (size * top).simd_lt(EXACT_CELLS) & (size.simd_ge(TINY) | size.simd_eq(0.0))
}

/// The lattice cell of each coordinate, modulo 256.
#[inline(always)]
fn cell<S: Simd>(x: Lanes<S>) -> <Lanes<S> as SimdFloat<S>>::Bits {
    ((x + 256.0).floor() + LOW_BITS).to_bits() & 255
}

/// The gradients at the corners of the lanes' cells.
enum Corners {
    /// All lanes lie in one cell.
    One([u8; 8]),
    Each([[u8; 8]; MAX_LANES]),
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
        let (i, j) = (usize::from(permutation[x & 255]), usize::from(permutation[(x + 1) & 255]));
        let b00 = usize::from(permutation[(i + y) & 255]) + z;
        let b10 = usize::from(permutation[(j + y) & 255]) + z;
        let b01 = usize::from(permutation[(i + y + 1) & 255]) + z;
        let b11 = usize::from(permutation[(j + y + 1) & 255]) + z;
        // The low byte is the remainder modulo 256.
        [
            b00 as u8,
            b10 as u8,
            b01 as u8,
            b11 as u8,
            (b00 + 1) as u8,
            (b10 + 1) as u8,
            (b01 + 1) as u8,
            (b11 + 1) as u8,
        ]
    }

    /// Noise at points given in cells, `|coordinate| < 2^50`.
    #[inline(always)]
    fn noise_lanes<S: Simd>(&self, simd: S, table: usize, p: Vec3<S>) -> Lanes<S> {
        // A cell is floor(x + 256) mod 256, but the fraction is x - floor(x): for a tiny negative x the first
        // is 0 and the second 1.
        let r0 = Vec3::<S> { x: p.x - p.x.floor(), y: p.y - p.y.floor(), z: p.z - p.z.floor() };
        let r1 = Vec3::<S> { x: r0.x - 1.0, y: r0.y - 1.0, z: r0.z - 1.0 };
        let s = Vec3::<S> { x: s_curve(simd, r0.x), y: s_curve(simd, r0.y), z: s_curve(simd, r0.z) };
        let (cx, cy, cz) = (cell::<S>(p.x), cell::<S>(p.y), cell::<S>(p.z));
        let key = cx | (cy << 8) | (cz << 16);

        let permutation = &self.permutations[table];
        let first = key[0];
        let corners = if key.simd_eq(first).all_true() {
            let corners = Self::corners_of_key(permutation, first);
            Corners::One(corners)
        } else {
            let mut corners = [[0u8; 8]; MAX_LANES];
            for lane in 0..Lanes::<S>::LEN {
                corners[lane] = Self::corners_of_key(permutation, key[lane]);
            }
            Corners::Each(corners)
        };
        let mut low = [Lanes::<S>::splat(simd, 0.0); 2];
        for (half, (rz, low)) in [r0.z, r1.z].into_iter().zip(&mut low).enumerate() {
            let c = 4 * half;
            let at00 = self.corner(simd, &corners, c, Vec3 { x: r0.x, y: r0.y, z: rz });
            let at10 = self.corner(simd, &corners, c + 1, Vec3 { x: r1.x, y: r0.y, z: rz });
            let at01 = self.corner(simd, &corners, c + 2, Vec3 { x: r0.x, y: r1.y, z: rz });
            let at11 = self.corner(simd, &corners, c + 3, Vec3 { x: r1.x, y: r1.y, z: rz });
            *low = lerp::<S>(s.y, lerp::<S>(s.x, at00, at10), lerp::<S>(s.x, at01, at11));
        }
        lerp::<S>(s.z, low[0], low[1])
    }

    #[inline(always)]
    fn corners_of_key(permutation: &[u8; 256], key: u64) -> [u8; 8] {
        let place = [key & 255, (key >> 8) & 255, (key >> 16) & 255];
        Self::corners(permutation, place[0] as usize, place[1] as usize, place[2] as usize)
    }

    /// What corner `c` contributes: the product of its gradient with the vector `r` from it to the point.
    #[inline(always)]
    fn corner<S: Simd>(&self, simd: S, corners: &Corners, c: usize, r: Vec3<S>) -> Lanes<S> {
        let [gx, gy, gz] = &self.gradients;
        match corners {
            Corners::One(corners) => {
                let g = usize::from(corners[c]);
                r.x * gx[g] + r.y * gy[g] + r.z * gz[g]
            }
            Corners::Each(corners) => {
                let mut gradient = [[0.0; MAX_LANES]; 3];
                for lane in 0..Lanes::<S>::LEN {
                    let g = usize::from(corners[lane][c]);
                    (gradient[0][lane], gradient[1][lane], gradient[2][lane]) = (gx[g], gy[g], gz[g]);
                }
                let [x, y, z] = &gradient;
                r.dot(Vec3::load(simd, [x, y, z], 0))
            }
        }
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
        let cells = Vec3::<S> { x: p.x / grid, y: p.y / grid, z: p.z / grid };
        let top = (1u64 << octaves.min(MAX_OCTAVES)) as f64;
        let fit = fits::<S>(cells.x, top) & fits::<S>(cells.y, top) & fits::<S>(cells.z, top);
        if octaves > MAX_OCTAVES || !fit.all_true() {
            let mut total = [0.0; MAX_LANES];
            for lane in 0..Lanes::<S>::LEN {
                let p = [p.x[lane], p.y[lane], p.z[lane]];
                total[lane] = self.octaves_one(table, p, grid, octaves, sum);
            }
            return Lanes::<S>::from_slice(simd, &total[..Lanes::<S>::LEN]);
        }
        let (mut total, mut scale, mut weight) = (Lanes::<S>::splat(simd, 0.0), 1.0, 1.0);
        for octave in 0..=octaves {
            // Dividing once and scaling by powers of two rounds as scaling first and dividing each time.
            let scaled = Vec3::<S> { x: cells.x * scale, y: cells.y * scale, z: cells.z * scale };
            let n = self.noise_lanes(simd, table, scaled);
            let n = if sum == Sum::Absolute { n.abs() } else { n };
            total = if octave == 0 { n } else { n * weight + total };
            scale *= 2.0;
            weight *= 0.5;
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
