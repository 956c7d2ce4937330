//! Gradient noise over boxes: within a cell of the lattice it is a polynomial, whose range follows from its parts.
//!
//! The noise of 1985 adds 256 before it takes the cell of a coordinate, which rounds what is less than 2^-45 below a whole
//! number into the next cell. That tear is not seen here.

#![allow(clippy::needless_range_loop, reason = "a lane is the same place in several arrays")]

use super::dual::Dual;
use super::range::{Eight, LANES, Range};
use crate::noise::{cell, classic_cell, improved_permutation};
use crate::{NoiseKind, NoiseTables};
use fearless_simd::f64x8;
use fearless_simd::prelude::*;

/// The most cells of a box that are looked at one by one.
const MOST_CELLS: f64 = 8.0;

/// Noise of one kind and seed.
pub(super) struct Lattice {
    kind: NoiseKind,
    seed: u64,
    permutation: [u8; 256],
    /// By hash modulo 256.
    gradients: Box<[[f64; 3]; 256]>,
    /// Bounds every value and every slope along an axis.
    most: [f64; 2],
}

/// Up to eight boxes, each in a cell of the lattice, whichever lanes they are of.
struct Batch {
    len: usize,
    lanes: [usize; LANES],
    /// The lower corners of the cells.
    corners: [[f64; 3]; LANES],
    /// The boxes, counted from there.
    p: [Ends; 3],
    /// How they change.
    by: [Ends; 3],
}

/// Lower and upper ends.
type Ends = [Eight; 2];

impl Lattice {
    pub(super) fn new(kind: NoiseKind, seed: u64, tables: &NoiseTables) -> Self {
        let (permutation, gradients) = match kind {
            NoiseKind::Improved => (improved_permutation(seed), std::array::from_fn(|h| edge(h as u64))),
            NoiseKind::Classic => (tables.permutation(seed), *tables.gradients()),
        };
        let length = |g: &[f64; 3]| (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]).sqrt();
        let longest = gradients.iter().map(length).fold(0.0, f64::max);
        // The eight products of gradient and distance are weighted so that the mean of the squared distance is at most 3/4,
        // and where a slope is taken 3/2: one weight is left out.
        let steepest = if kind == NoiseKind::Improved { 1.875 } else { 1.5 };
        let most = [longest * 0.8661, longest * (1.0 + 2.0 * steepest * 1.2248)];
        Self { kind, seed, permutation, gradients: Box::new(gradients), most }
    }

    pub(super) fn is(&self, kind: NoiseKind, seed: u64) -> bool {
        self.kind == kind && self.seed == seed
    }

    #[inline(always)]
    pub(super) fn over<S: Simd, const SLOPE: bool>(&self, simd: S, p: [&Dual; 3]) -> Dual {
        let nowhere = Range::from_ends(f64::INFINITY, f64::NEG_INFINITY);
        let mut out = Dual { value: nowhere, slope: nowhere };
        let mut batch = Batch {
            len: 0,
            lanes: [0; LANES],
            corners: [[0.0; 3]; LANES],
            p: [[[0.0; LANES]; 2]; 3],
            by: [[[0.0; LANES]; 2]; 3],
        };
        for lane in 0..LANES {
            let [x, y, z] = p;
            let at = [x.value.lane(lane), y.value.lane(lane), z.value.lane(lane)];
            let (mut first, mut counts, mut total) = ([0.0; 3], [0; 3], 1.0);
            let (mut is_number, mut told_apart) = (true, true);
            for axis in 0..3 {
                let [low, high] = at[axis];
                is_number &= !low.is_nan() && !high.is_nan();
                // Beyond 2^50 the cells of a box are no longer told apart.
                told_apart &= low.abs() < 1e15 && high.abs() < 1e15;
                first[axis] = low.floor();
                let count = high.floor() - first[axis] + 1.0;
                total *= count;
                counts[axis] = count as usize;
            }
            if !is_number {
                out.value.set(lane, [f64::NAN; 2]);
                out.slope.set(lane, [f64::NAN; 2]);
                continue;
            }
            let mut by = [[0.0; 2]; 3];
            if SLOPE {
                by = [x.slope.lane(lane), y.slope.lane(lane), z.slope.lane(lane)];
            }
            if !(told_apart && total <= MOST_CELLS) {
                let [value, slope] = self.most;
                let mut along = 0.0;
                for [a, b] in by {
                    along += a.abs().max(b.abs());
                }
                out.value.set(lane, [-value, value]);
                out.slope.set(lane, [-slope * along, slope * along]);
                continue;
            }
            for i in 0..counts[0] {
                for j in 0..counts[1] {
                    for k in 0..counts[2] {
                        let corner = [first[0] + i as f64, first[1] + j as f64, first[2] + k as f64];
                        let slot = batch.len;
                        batch.lanes[slot] = lane;
                        batch.corners[slot] = corner;
                        for axis in 0..3 {
                            let [low, high] = at[axis];
                            batch.p[axis][0][slot] = (low - corner[axis]).max(0.0);
                            batch.p[axis][1][slot] = (high - corner[axis]).min(1.0);
                            batch.by[axis][0][slot] = by[axis][0];
                            batch.by[axis][1][slot] = by[axis][1];
                        }
                        batch.len += 1;
                        if batch.len == LANES {
                            self.add::<S, SLOPE>(simd, &mut batch, &mut out);
                        }
                    }
                }
            }
        }
        if batch.len > 0 {
            self.add::<S, SLOPE>(simd, &mut batch, &mut out);
        }
        if SLOPE {
            // What changes without bound does so after this, too.
            let mut endless = [false; LANES];
            for axis in p {
                for lane in 0..LANES {
                    endless[lane] |= !axis.slope.lane(lane).iter().all(|v| v.is_finite());
                }
            }
            out.slope = out.slope.replaced(endless, Range::ENTIRE);
        } else {
            out.slope = Range::ZERO;
        }
        out
    }

    /// Adds what the boxes of a batch can be to the lanes that they are of.
    #[inline(always)]
    fn add<S: Simd, const SLOPE: bool>(&self, simd: S, batch: &mut Batch, out: &mut Dual) {
        let [value, slope] = self.in_cells::<S, SLOPE>(simd, batch);
        for slot in 0..batch.len {
            let lane = batch.lanes[slot];
            let add = |range: &mut Range, [low, high]: [f64; 2]| {
                range.low[lane] = range.low[lane].min(low);
                range.high[lane] = range.high[lane].max(high);
            };
            add(&mut out.value, [value[0][slot], value[1][slot]]);
            add(&mut out.slope, [slope[0][slot], slope[1][slot]]);
        }
        batch.len = 0;
    }

    /// Over boxes in cells.
    #[inline(always)]
    fn in_cells<S: Simd, const SLOPE: bool>(&self, simd: S, batch: &Batch) -> [Ends; 2] {
        let mut gradients = [[[0.0; LANES]; 3]; 8];
        for slot in 0..batch.len {
            let corners = self.corners(batch.corners[slot]);
            for index in 0..8 {
                for axis in 0..3 {
                    gradients[index][axis][slot] = corners[index][axis];
                }
            }
        }
        let (p, by) = (&batch.p, &batch.by);
        let p = [Two::load(simd, &p[0]), Two::load(simd, &p[1]), Two::load(simd, &p[2])];
        let by = [Two::load(simd, &by[0]), Two::load(simd, &by[1]), Two::load(simd, &by[2])];
        // The products of gradient and distance at the corners, then what is between.
        let zero = Two::splat(simd, 0.0);
        let (mut values, mut slopes) = ([zero; 8], [zero; 8]);
        for index in 0..8 {
            let mut sum = zero;
            let mut size = zero.low;
            let mut slope = zero;
            for axis in 0..3 {
                let g = f64x8::from_slice(simd, &gradients[index][axis]);
                let side = f64::from(u8::from(index >> axis & 1 == 1));
                let product =
                    Two { low: g * (p[axis].low - side), high: g * (p[axis].high - side) }.in_order();
                sum = sum.plus(product);
                size += product.greatest();
                if SLOPE {
                    slope = slope.plus(Two { low: g * by[axis].low, high: g * by[axis].high }.in_order());
                }
            }
            values[index] = sum.wider(size * (8.0 * f64::EPSILON));
            slopes[index] = slope;
        }
        for axis in 0..3 {
            let [weight, growth] = self.weights::<S, SLOPE>(simd, p[axis]);
            let rise = if SLOPE { growth.times(by[axis]) } else { zero };
            for pair in 0..4 >> axis {
                let (a, b) = (values[2 * pair], values[2 * pair + 1]);
                values[pair] = blend(weight, a, b);
                if SLOPE {
                    let across = Two { low: b.low - a.high, high: b.high - a.low };
                    slopes[pair] =
                        blend(weight, slopes[2 * pair], slopes[2 * pair + 1]).plus(rise.times(across));
                }
            }
        }
        [values[0].ends(), slopes[0].ends()]
    }

    /// The weights of the farther corners along an axis, and how they grow.
    #[inline(always)]
    fn weights<S: Simd, const SLOPE: bool>(&self, simd: S, p: Two<S>) -> [Two<S>; 2] {
        const OFF: f64 = 16.0 * f64::EPSILON;
        let is_improved = self.kind == NoiseKind::Improved;
        let (zero, one) = (Two::splat(simd, 0.0), Two::splat(simd, 1.0 + OFF));
        let (from, to) = (weight(is_improved, p.low) - OFF, weight(is_improved, p.high) + OFF);
        let value = Two { low: most(from, zero.low), high: least(to, one.low) };
        if !SLOPE {
            return [value, zero];
        }
        let (a, b) = (growth(is_improved, p.low), growth(is_improved, p.high));
        // It is greatest in the middle.
        let middle = growth(is_improved, f64x8::splat(simd, 0.5));
        let holds_middle = p.low.simd_le(0.5) & p.high.simd_ge(0.5);
        let high = holds_middle.select(middle, most(a, b));
        [value, Two { low: most(least(a, b) - OFF, zero.low), high: high + OFF }]
    }

    /// The gradients at the corners of a cell: x first, then y, then z.
    #[inline(always)]
    fn corners(&self, corner: [f64; 3]) -> [[f64; 3]; 8] {
        let [x, y, z] = corner;
        let is_improved = self.kind == NoiseKind::Improved;
        let [i, j, k] = if is_improved {
            [cell(x), cell(y), cell(z)]
        } else {
            [classic_cell(x + 256.0), classic_cell(y + 256.0), classic_cell(z + 256.0)]
        };
        let mut gradients = [[0.0; 3]; 8];
        for index in 0..8u64 {
            let [a, b, c] = [index & 1, (index >> 1) & 1, index >> 2];
            let h =
                self.hash(self.hash(i.wrapping_add(a)) + j.wrapping_add(b) % 256) + k.wrapping_add(c) % 256;
            let h = if is_improved { self.hash(h) } else { h };
            gradients[index as usize] = self.gradients[(h & 255) as usize];
        }
        gradients
    }

    #[inline(always)]
    fn hash(&self, i: u64) -> u64 {
        u64::from(self.permutation[(i & 255) as usize])
    }
}

/// Ranges in vectors.
#[derive(Clone, Copy)]
struct Two<S: Simd> {
    low: f64x8<S>,
    high: f64x8<S>,
}

impl<S: Simd> Two<S> {
    #[inline(always)]
    fn splat(simd: S, v: f64) -> Self {
        Self { low: f64x8::splat(simd, v), high: f64x8::splat(simd, v) }
    }

    #[inline(always)]
    fn load(simd: S, ends: &Ends) -> Self {
        Self { low: f64x8::from_slice(simd, &ends[0]), high: f64x8::from_slice(simd, &ends[1]) }
    }

    #[inline(always)]
    fn ends(self) -> Ends {
        [self.low.into(), self.high.into()]
    }

    #[inline(always)]
    fn in_order(self) -> Self {
        Self { low: least(self.low, self.high), high: most(self.low, self.high) }
    }

    #[inline(always)]
    fn greatest(self) -> f64x8<S> {
        most(self.low.abs(), self.high.abs())
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self { low: self.low + other.low, high: self.high + other.high }
    }

    #[inline(always)]
    fn wider(self, off: f64x8<S>) -> Self {
        Self { low: self.low - off, high: self.high + off }
    }

    /// The product, of ranges with finite ends.
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        let (p, q) = (self.low * other.low, self.low * other.high);
        let (r, s) = (self.high * other.low, self.high * other.high);
        Self { low: least(least(p, q), least(r, s)), high: most(most(p, q), most(r, s)) }
    }
}

/// The weight of the farther corner of a unit cell.
#[inline(always)]
fn weight<S: Simd>(is_improved: bool, t: f64x8<S>) -> f64x8<S> {
    if is_improved { t * t * t * (t * (t * 6.0 - 15.0) + 10.0) } else { t * t * (t * -2.0 + 3.0) }
}

/// How it grows.
#[inline(always)]
fn growth<S: Simd>(is_improved: bool, t: f64x8<S>) -> f64x8<S> {
    if is_improved { t * t * 30.0 * (t - 1.0) * (t - 1.0) } else { t * 6.0 * (t * -1.0 + 1.0) }
}

/// One of the twelve directions to the edges of a cube.
fn edge(hash: u64) -> [f64; 3] {
    let h = hash & 15;
    let mut g = [0.0; 3];
    let first = usize::from(h >= 8);
    let second = match h {
        0..=3 => 1,
        12 | 14 => 0,
        _ => 2,
    };
    g[first] += if h & 1 == 0 { 1.0 } else { -1.0 };
    g[second] += if h & 2 == 0 { 1.0 } else { -1.0 };
    g
}

/// Between two ranges, by a weight from 0 to 1. What is between rises with both.
#[inline(always)]
fn blend<S: Simd>(weight: Two<S>, a: Two<S>, b: Two<S>) -> Two<S> {
    let (rise, rise_high) = (b.low - a.low, b.high - a.high);
    let low = least(a.low + weight.low * rise, a.low + weight.high * rise);
    let high = most(a.high + weight.low * rise_high, a.high + weight.high * rise_high);
    Two { low, high }.wider(most(a.greatest(), b.greatest()) * (4.0 * f64::EPSILON))
}

#[inline(always)]
fn least<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_lt(b).select(a, b)
}

#[inline(always)]
fn most<S: Simd>(a: f64x8<S>, b: f64x8<S>) -> f64x8<S> {
    a.simd_gt(b).select(a, b)
}
