//! Perlin's gradient noise of 1985, several points at a time.
//!
//! Thesis §3.4, appendix A.3 `noise`; K. Perlin, "An Image Synthesizer", SIGGRAPH 1985. Space is cut into
//! cells; noise at a point blends the gradients at the eight corners of its cell. Neighbouring rays hit
//! neighbouring points, and for the lower octaves those lie in one cell, or in two or three: then the
//! gradients of each are fetched once for all lanes. Where there are more, they are fetched lane by lane, two
//! at a time. The arithmetic is the same in all cases.

use super::lanes::{Lanes, MAX_LANES, Mask, Vec3};
use crate::NoiseTables;
use crate::noise::{LOW_BITS, classic_cell};
use fearless_simd::f64x8;
use fearless_simd::prelude::*;

/// Below this magnitude the integer part of a coordinate can be read off the low bits of a double.
const EXACT_CELLS: f64 = (1u64 << 50) as f64;
/// More octaves than this are left to the definition: they cannot be seen, only waited for.
const MAX_OCTAVES: u32 = 48;
/// Below this, scaling by a power of two might not be exact; and from here on it might overflow.
const TINY: f64 = 1e-280;
const HUGE: f64 = 1e300;

/// Noise tables, laid out for the kernel.
pub struct Noise {
    /// Of each permutation P, the pairs (P(i), P(i + 1)) for i to 511, all modulo 256.
    permutations: Box<[[[u8; 2]; 512]]>,
    /// Gradients one after the other, four numbers each, the last of them 0, and all of them twice: so those
    /// of neighbouring corners along z are neighbours, whatever the cell.
    gradients: Box<[f64; GRADIENTS]>,
}

const GRADIENTS: usize = 512 * 4;

/// How the octaves of a sum are taken.
#[derive(Clone, Copy, PartialEq)]
pub enum Sum {
    /// With their sign: `semiTurbulence`.
    Signed,
    /// By their absolute value: `turbulence`.
    Absolute,
}

/// Where in their cells the lanes are: the vectors from the lowest and the highest corner, and the weights.
#[derive(Clone, Copy)]
struct Place<S: Simd> {
    r0: Vec3<S>,
    r1: Vec3<S>,
    s: Vec3<S>,
}

/// The four edges of a cell along z, by the place of the gradient at their lower end; the upper end's is the
/// next. In the order 00, 10, 01, 11 of x and y.
type Edges = [u16; 4];

/// The cells of the lanes.
enum Cells {
    /// The same for all.
    One(Edges),
    Each([Edges; MAX_LANES]),
}

impl Noise {
    /// With the three permutations of `tables`, which are the tables 0, 1 and 2.
    #[must_use]
    pub fn new(tables: &NoiseTables) -> Self {
        Self::with_seeds(tables, &[0, 1, 2])
    }

    /// With the permutations of some seeds ([`NoiseTables::permutation`]): the table of each is its place in
    /// `seeds`.
    #[must_use]
    pub fn with_seeds(tables: &NoiseTables, seeds: &[u64]) -> Self {
        let mut gradients = Box::new([0.0; GRADIENTS]);
        for (i, row) in gradients.chunks_exact_mut(4).enumerate() {
            row[..3].copy_from_slice(&tables.gradients()[i & 255]);
        }
        let pairs = |seed: &u64| {
            let permutation = tables.permutation(*seed);
            std::array::from_fn(|i| [permutation[i & 255], permutation[(i + 1) & 255]])
        };
        Self { permutations: seeds.iter().map(pairs).collect(), gradients }
    }

    /// Noise at one point given in cells, in the bits of [`crate::classic_noise`].
    #[must_use]
    pub fn at(&self, table: usize, p: [f64; 3]) -> f64 {
        self.noise_one(table, p)
    }

    /// Noise at points given in cells, which must be [ordinary](Self::are_ordinary).
    #[inline(always)]
    pub fn ordinary<S: Simd>(&self, simd: S, table: usize, p: Vec3<S>) -> Lanes<S> {
        self.noise_lanes(simd, table, p)
    }

    /// Whether no coordinate of the points, times a number up to `most` in magnitude, is too large to have a cell.
    #[inline(always)]
    pub fn are_ordinary<S: Simd>(p: Vec3<S>, most: f64) -> bool {
        let [x, y, z] = [p.x.abs() * most, p.y.abs() * most, p.z.abs() * most];
        (x.simd_lt(EXACT_CELLS) & y.simd_lt(EXACT_CELLS) & z.simd_lt(EXACT_CELLS)).all_true()
    }

    /// The edges of a cell, from the low bytes of `key`: x, y, z.
    #[inline(always)]
    fn edges(&self, table: usize, key: u64) -> Edges {
        let pairs = &self.permutations[table];
        let [x, y, z] = [key & 255, (key >> 8) & 255, (key >> 16) & 255].map(|i| i as usize);
        let [i, j] = pairs[x];
        let [b00, b01] = pairs[usize::from(i) + y];
        let [b10, b11] = pairs[usize::from(j) + y];
        [b00, b10, b01, b11].map(|b| u16::from(b) + z as u16)
    }

    /// Noise at points given in cells, `|coordinate| < 2^50`.
    #[inline(always)]
    fn noise_lanes<S: Simd>(&self, simd: S, table: usize, p: Vec3<S>) -> Lanes<S> {
        // A cell is floor(x + 256) mod 256, but the fraction is x - floor(x): for a tiny negative x the first
        // is 0 and the second 1.
        let r0 = Vec3::<S> { x: p.x - p.x.floor(), y: p.y - p.y.floor(), z: p.z - p.z.floor() };
        let r1 = Vec3::<S> { x: r0.x - 1.0, y: r0.y - 1.0, z: r0.z - 1.0 };
        let s = Vec3::<S> { x: s_curve(simd, r0.x), y: s_curve(simd, r0.y), z: s_curve(simd, r0.z) };
        let at = Place { r0, r1, s };
        let key = cell::<S>(p.x) | (cell::<S>(p.y) << 8) | (cell::<S>(p.z) << 16);

        // Lanes are neighbours, so the cells of the first and of the last are likely to be all there are.
        let last = Lanes::<S>::LEN - 1;
        let in_first = key.simd_eq(key[0]);
        if in_first.all_true() {
            return self.blend(simd, &self.one(table, key[0]), at);
        }
        let in_last = key.simd_eq(key[last]);
        let left = !(in_first | in_last).to_bitmask() & ((1 << Lanes::<S>::LEN) - 1);
        let between = (left.trailing_zeros() as usize).min(last);
        let in_between = key.simd_eq(key[between]);
        if (in_first | in_last | in_between).all_true() {
            let first = self.blend(simd, &self.one(table, key[0]), at);
            let outer = in_first.select(first, self.blend(simd, &self.one(table, key[last]), at));
            if left == 0 {
                return outer;
            }
            return in_between.select(self.blend(simd, &self.one(table, key[between]), at), outer);
        }
        let mut edges = [[0; 4]; MAX_LANES];
        for lane in 0..Lanes::<S>::LEN {
            edges[lane] = self.edges(table, key[lane]);
        }
        self.blend(simd, &Cells::Each(edges), at)
    }

    #[inline(always)]
    fn one(&self, table: usize, key: u64) -> Cells {
        Cells::One(self.edges(table, key))
    }

    /// Noise from the gradients at the corners of cells and the places in them.
    #[inline(always)]
    fn blend<S: Simd>(&self, simd: S, cells: &Cells, Place { r0, r1, s }: Place<S>) -> Lanes<S> {
        let (low00, high00) = self.edge(simd, cells, 0, r0.x, r0.y, [r0.z, r1.z]);
        let (low10, high10) = self.edge(simd, cells, 1, r1.x, r0.y, [r0.z, r1.z]);
        let (low01, high01) = self.edge(simd, cells, 2, r0.x, r1.y, [r0.z, r1.z]);
        let (low11, high11) = self.edge(simd, cells, 3, r1.x, r1.y, [r0.z, r1.z]);
        let low = lerp::<S>(s.y, lerp::<S>(s.x, low00, low10), lerp::<S>(s.x, low01, low11));
        let high = lerp::<S>(s.y, lerp::<S>(s.x, high00, high10), lerp::<S>(s.x, high01, high11));
        lerp::<S>(s.z, low, high)
    }

    /// What the two corners of an edge contribute: the products of their gradients with the vectors from them
    /// to the points.
    #[inline(always)]
    fn edge<S: Simd>(
        &self,
        simd: S,
        cells: &Cells,
        edge: usize,
        x: Lanes<S>,
        y: Lanes<S>,
        [z0, z1]: [Lanes<S>; 2],
    ) -> (Lanes<S>, Lanes<S>) {
        match cells {
            Cells::One(edges) => {
                let g = self.pair(edges[edge]);
                (x * g[0] + y * g[1] + z0 * g[2], x * g[4] + y * g[5] + z1 * g[6])
            }
            Cells::Each(edges) => {
                let g = self.pairs(simd, edges, edge);
                (x * g[0] + y * g[1] + z0 * g[2], x * g[3] + y * g[4] + z1 * g[5])
            }
        }
    }

    /// The gradients at both ends of an edge.
    #[inline(always)]
    fn pair(&self, edge: u16) -> &[f64] {
        // An edge is the sum of two bytes, so the place is below 511.
        let start = 4 * usize::from(edge & 511).min(510);
        &self.gradients[start..start + 8]
    }

    /// Of the gradients at both ends of one edge of each lane's cell, the components.
    #[inline(always)]
    fn pairs<S: Simd>(&self, simd: S, edges: &[Edges; MAX_LANES], edge: usize) -> [Lanes<S>; 6] {
        if Lanes::<S>::LEN != 8 {
            let mut g = [[0.0; MAX_LANES]; 6];
            for lane in 0..Lanes::<S>::LEN {
                let pair = self.pair(edges[lane][edge]);
                (g[0][lane], g[1][lane], g[2][lane]) = (pair[0], pair[1], pair[2]);
                (g[3][lane], g[4][lane], g[5][lane]) = (pair[4], pair[5], pair[6]);
            }
            let len = Lanes::<S>::LEN;
            return [
                Lanes::<S>::from_slice(simd, &g[0][..len]),
                Lanes::<S>::from_slice(simd, &g[1][..len]),
                Lanes::<S>::from_slice(simd, &g[2][..len]),
                Lanes::<S>::from_slice(simd, &g[3][..len]),
                Lanes::<S>::from_slice(simd, &g[4][..len]),
                Lanes::<S>::from_slice(simd, &g[5][..len]),
            ];
        }
        let rows = [
            self.row(simd, edges[0][edge]),
            self.row(simd, edges[1][edge]),
            self.row(simd, edges[2][edge]),
            self.row(simd, edges[3][edge]),
            self.row(simd, edges[4][edge]),
            self.row(simd, edges[5][edge]),
            self.row(simd, edges[6][edge]),
            self.row(simd, edges[7][edge]),
        ];
        let [x0, y0, z0, x1, y1, z1] = transposed(rows);
        [
            native(simd, x0),
            native(simd, y0),
            native(simd, z0),
            native(simd, x1),
            native(simd, y1),
            native(simd, z1),
        ]
    }

    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, edge: u16) -> f64x8<S> {
        f64x8::from_slice(simd, self.pair(edge))
    }

    /// Noise at one point given in cells: the definition, for coordinates that the lanes cannot take.
    #[cold]
    #[inline(never)]
    fn noise_one(&self, table: usize, [x, y, z]: [f64; 3]) -> f64 {
        let curve = |t: f64| t * t * (3.0 - 2.0 * t);
        let mix = |t: f64, a: f64, b: f64| a + t * (b - a);
        let [x0, y0, z0] = [x, y, z].map(|v| v - v.floor());
        let [sx, sy, sz] = [x0, y0, z0].map(curve);
        let [cx, cy, cz] = [x, y, z].map(|v| classic_cell(v + 256.0));
        let edges = self.edges(table, cx | cy << 8 | cz << 16);
        let at = |edge: usize, rz: f64, g: &[f64]| {
            let rx = if edge & 1 == 0 { x0 } else { x0 - 1.0 };
            let ry = if edge & 2 == 0 { y0 } else { y0 - 1.0 };
            rx * g[0] + ry * g[1] + rz * g[2]
        };
        let low = |edge: usize| at(edge, z0, &self.pair(edges[edge])[..4]);
        let high = |edge: usize| at(edge, z0 - 1.0, &self.pair(edges[edge])[4..]);
        let low = mix(sy, mix(sx, low(0), low(1)), mix(sx, low(2), low(3)));
        let high = mix(sy, mix(sx, high(0), high(1)), mix(sx, high(2), high(3)));
        mix(sz, low, high)
    }

    /// The sum over octaves k = 0..=`octaves` of noise(2^k p / grid) / 2^k, from octave 0 upwards:
    /// `semiTurbulence` and `turbulence` of appendix A.3.
    #[inline(always)]
    pub fn octaves<S: Simd>(
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
        let size = p.x.abs() + p.y.abs() + p.z.abs();
        if octaves > MAX_OCTAVES || !(fit & (size * top).simd_lt(HUGE)).all_true() {
            let mut total = [0.0; MAX_LANES];
            for (lane, total) in total.iter_mut().enumerate().take(Lanes::<S>::LEN) {
                *total = self.octaves_one(table, [p.x[lane], p.y[lane], p.z[lane]], grid, octaves, sum);
            }
            return Lanes::<S>::from_slice(simd, &total[..Lanes::<S>::LEN]);
        }
        let (mut total, mut scale, mut weight) = (Lanes::<S>::splat(simd, 0.0), 1.0, 1.0);
        for octave in 0..=octaves {
            // Dividing once and scaling by powers of two rounds as scaling first and dividing each time,
            // where nothing overflows or vanishes.
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
    #[cold]
    #[inline(never)]
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

/// The first three and the fifth to seventh column of eight rows of eight numbers, by interleaving three times.
#[inline(always)]
fn transposed<S: Simd>(rows: [f64x8<S>; 8]) -> [f64x8<S>; 6] {
    let [r0, r1, r2, r3, r4, r5, r6, r7] = rows;
    let (even0, odd0) = (r0.zip_low(r4), r1.zip_low(r5));
    let (even1, odd1) = (r2.zip_low(r6), r3.zip_low(r7));
    let (xy_even, xy_odd) = (even0.zip_low(even1), odd0.zip_low(odd1));
    let (zw_even, zw_odd) = (even0.zip_high(even1), odd0.zip_high(odd1));
    let (even2, odd2) = (r0.zip_high(r4), r1.zip_high(r5));
    let (even3, odd3) = (r2.zip_high(r6), r3.zip_high(r7));
    let (xy_even1, xy_odd1) = (even2.zip_low(even3), odd2.zip_low(odd3));
    let (zw_even1, zw_odd1) = (even2.zip_high(even3), odd2.zip_high(odd3));
    [
        xy_even.zip_low(xy_odd),
        xy_even.zip_high(xy_odd),
        zw_even.zip_low(zw_odd),
        xy_even1.zip_low(xy_odd1),
        xy_even1.zip_high(xy_odd1),
        zw_even1.zip_low(zw_odd1),
    ]
}

/// Eight lanes as a native vector, which is that wide wherever this is called.
#[inline(always)]
fn native<S: Simd>(simd: S, v: f64x8<S>) -> Lanes<S> {
    Lanes::<S>::from_slice(simd, &v.as_slice()[..Lanes::<S>::LEN])
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

/// The cell of each coordinate, modulo 256.
#[inline(always)]
fn cell<S: Simd>(x: Lanes<S>) -> S::u64s {
    ((x + 256.0).floor() + LOW_BITS).bitcast::<S::u64s>() & 255
}
