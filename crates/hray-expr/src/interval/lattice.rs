//! Gradient noise over boxes: within a cell of the lattice it is a polynomial, whose range follows from its parts.
//!
//! The noise of 1985 adds 256 before it takes the cell of a coordinate, which rounds what is less than 2^-45 below a whole
//! number into the next cell. That tear is not seen here.

#![allow(clippy::needless_range_loop, reason = "a lane is the same place in several arrays")]

use super::dual::Dual;
use super::range::{Eight, LANES, Range};
use crate::noise::{cell, classic_cell, improved_permutation};
use crate::{NoiseKind, NoiseTables};

/// The most cells of a box that are looked at one by one.
const MOST_CELLS: f64 = 27.0;

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
    pub(super) fn over<const SLOPE: bool>(&self, p: [&Dual; 3]) -> Dual {
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
                is_number &= low == low && high == high;
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
                    along += most(a.abs(), b.abs());
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
                            batch.p[axis][0][slot] = most(low - corner[axis], 0.0);
                            batch.p[axis][1][slot] = least(high - corner[axis], 1.0);
                            batch.by[axis][0][slot] = by[axis][0];
                            batch.by[axis][1][slot] = by[axis][1];
                        }
                        batch.len += 1;
                        if batch.len == LANES {
                            self.add::<SLOPE>(&mut batch, &mut out);
                        }
                    }
                }
            }
        }
        if batch.len > 0 {
            self.add::<SLOPE>(&mut batch, &mut out);
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
    fn add<const SLOPE: bool>(&self, batch: &mut Batch, out: &mut Dual) {
        let [value, slope] = self.in_cells::<SLOPE>(batch);
        for slot in 0..batch.len {
            let lane = batch.lanes[slot];
            let add = |range: &mut Range, [low, high]: [f64; 2]| {
                range.low[lane] = least(low, range.low[lane]);
                range.high[lane] = most(high, range.high[lane]);
            };
            add(&mut out.value, [value[0][slot], value[1][slot]]);
            add(&mut out.slope, [slope[0][slot], slope[1][slot]]);
        }
        batch.len = 0;
    }

    /// Over boxes in cells.
    #[inline(always)]
    fn in_cells<const SLOPE: bool>(&self, batch: &Batch) -> [Ends; 2] {
        let mut gradients = [[[0.0; LANES]; 3]; 8];
        for slot in 0..batch.len {
            let corners = self.corners(batch.corners[slot]);
            for index in 0..8 {
                for axis in 0..3 {
                    gradients[index][axis][slot] = corners[index][axis];
                }
            }
        }
        let mut weights = [[[[0.0; LANES]; 2]; 2]; 3];
        for axis in 0..3 {
            for lane in 0..LANES {
                let ends = [batch.p[axis][0][lane], batch.p[axis][1][lane]];
                let [value, growth] = self.weight(ends, SLOPE);
                for end in 0..2 {
                    weights[axis][0][end][lane] = value[end];
                    weights[axis][1][end][lane] = growth[end];
                }
            }
        }
        // The products of gradient and distance at the corners, then what is between.
        let mut values = [[[0.0; LANES]; 2]; 8];
        let mut slopes = [[[0.0; LANES]; 2]; 8];
        for index in 0..8 {
            let from = [index & 1, (index >> 1) & 1, index >> 2].map(|side| side as f64);
            for lane in 0..LANES {
                let (mut low, mut high, mut size) = (0.0, 0.0, 0.0);
                let mut slope = [0.0; 2];
                for axis in 0..3 {
                    let g = gradients[index][axis][lane];
                    let (a, b) = (
                        g * (batch.p[axis][0][lane] - from[axis]),
                        g * (batch.p[axis][1][lane] - from[axis]),
                    );
                    low += least(a, b);
                    high += most(a, b);
                    size += most(a.abs(), b.abs());
                    if SLOPE {
                        let (c, d) = (g * batch.by[axis][0][lane], g * batch.by[axis][1][lane]);
                        slope = [slope[0] + least(c, d), slope[1] + most(c, d)];
                    }
                }
                let off = 8.0 * f64::EPSILON * size;
                (values[index][0][lane], values[index][1][lane]) = (low - off, high + off);
                (slopes[index][0][lane], slopes[index][1][lane]) = (slope[0], slope[1]);
            }
        }
        for axis in 0..3 {
            for pair in 0..4 >> axis {
                for lane in 0..LANES {
                    let ends = |of: &[Ends; 8], index: usize| [of[index][0][lane], of[index][1][lane]];
                    let weight = |part: usize| [weights[axis][part][0][lane], weights[axis][part][1][lane]];
                    let (a, b) = (ends(&values, 2 * pair), ends(&values, 2 * pair + 1));
                    let value = blend(weight(0), a, b);
                    if SLOPE {
                        let [c, d] = blend(weight(0), ends(&slopes, 2 * pair), ends(&slopes, 2 * pair + 1));
                        let by = [batch.by[axis][0][lane], batch.by[axis][1][lane]];
                        let rise = times(times(weight(1), by), [b[0] - a[1], b[1] - a[0]]);
                        (slopes[pair][0][lane], slopes[pair][1][lane]) = (c + rise[0], d + rise[1]);
                    }
                    (values[pair][0][lane], values[pair][1][lane]) = (value[0], value[1]);
                }
            }
        }
        [values[0], slopes[0]]
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

    /// The weight of the farther corner along an axis, and how it grows.
    #[inline(always)]
    fn weight(&self, [a, b]: [f64; 2], slope: bool) -> [[f64; 2]; 2] {
        const OFF: f64 = 16.0 * f64::EPSILON;
        let is_improved = self.kind == NoiseKind::Improved;
        let (from, to) = (weight(is_improved, a), weight(is_improved, b));
        let value = [most(from - OFF, 0.0), least(to + OFF, 1.0 + OFF)];
        if !slope {
            return [value, [0.0; 2]];
        }
        let (p, q) = (growth(is_improved, a), growth(is_improved, b));
        let high = if a <= 0.5 && b >= 0.5 { growth(is_improved, 0.5) } else { most(p, q) };
        [value, [most(least(p, q) - OFF, 0.0), high + OFF]]
    }
}

/// The weight of the farther corner of a unit cell.
#[inline(always)]
fn weight(is_improved: bool, t: f64) -> f64 {
    if is_improved { t * t * t * (t * (t * 6.0 - 15.0) + 10.0) } else { t * t * (3.0 - 2.0 * t) }
}

/// How it grows.
#[inline(always)]
fn growth(is_improved: bool, t: f64) -> f64 {
    if is_improved { 30.0 * t * t * (t - 1.0) * (t - 1.0) } else { 6.0 * t * (1.0 - t) }
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
fn blend(weight: [f64; 2], a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let (rise, rise_high) = (b[0] - a[0], b[1] - a[1]);
    let low = least(a[0] + weight[0] * rise, a[0] + weight[1] * rise);
    let high = most(a[1] + weight[0] * rise_high, a[1] + weight[1] * rise_high);
    let off = 4.0 * f64::EPSILON * most(most(a[0].abs(), a[1].abs()), most(b[0].abs(), b[1].abs()));
    [low - off, high + off]
}

/// The product of two ranges with finite ends.
#[inline(always)]
fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    let (p, q, r, s) = (a * c, a * d, b * c, b * d);
    [least(least(p, q), least(r, s)), most(most(p, q), most(r, s))]
}

#[inline(always)]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
