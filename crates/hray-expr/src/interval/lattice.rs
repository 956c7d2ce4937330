//! Gradient noise over boxes: within a cell of the lattice it is a polynomial, whose range follows from its parts.
//!
//! The noise of 1985 adds 256 before it takes the cell of a coordinate, which rounds what is less than 2^-45 below a whole
//! number into the next cell. That tear is not seen here.

use super::dual::Dual;
use super::range::LANES;
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

/// The range in one lane, and that of the slope.
type One = [[f64; 2]; 2];

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

    pub(super) fn over<const SLOPE: bool>(&self, p: [&Dual; 3]) -> Dual {
        let mut out = Dual::ENTIRE;
        for lane in 0..LANES {
            let at = p.map(|axis| axis.value.lane(lane));
            let by = if SLOPE { p.map(|axis| axis.slope.lane(lane)) } else { [[0.0; 2]; 3] };
            // What changes without bound does so after this, too.
            let bounded = by.as_flattened().iter().all(|v| v.is_finite());
            let [value, slope] = self.over_box::<SLOPE>(at, if bounded { by } else { [[0.0; 2]; 3] });
            let slope = if bounded { slope } else { [f64::NEG_INFINITY, f64::INFINITY] };
            out.value.set(lane, value);
            out.slope.set(lane, slope);
        }
        out
    }

    fn over_box<const SLOPE: bool>(&self, at: [[f64; 2]; 3], by: [[f64; 2]; 3]) -> One {
        if at.as_flattened().iter().any(|v| v.is_nan()) {
            return [[f64::NAN; 2]; 2];
        }
        let first = at.map(|[low, _]| low.floor());
        let last = at.map(|[_, high]| high.floor());
        let counts = [0, 1, 2].map(|axis| last[axis] - first[axis] + 1.0);
        // Beyond 2^50 the cells of a box are no longer told apart.
        let told_apart = first.iter().chain(&last).all(|v| v.abs() < 1e15);
        if !(told_apart && counts.into_iter().product::<f64>() <= MOST_CELLS) {
            let [value, slope] = self.most;
            let along: f64 = by.iter().map(|[a, b]| most(a.abs(), b.abs())).sum();
            return [[-value, value], [-slope * along, slope * along]];
        }
        let mut out: Option<One> = None;
        let counts = counts.map(|count| count as usize);
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                for k in 0..counts[2] {
                    let corner = [first[0] + i as f64, first[1] + j as f64, first[2] + k as f64];
                    let inside = [0, 1, 2].map(|axis| {
                        let [low, high] = at[axis];
                        [most(low - corner[axis], 0.0), least(high - corner[axis], 1.0)]
                    });
                    let one = self.in_cell::<SLOPE>(corner, inside, by);
                    out = Some(out.map_or(one, |all| {
                        [0, 1]
                            .map(|part| [least(all[part][0], one[part][0]), most(all[part][1], one[part][1])])
                    }));
                }
            }
        }
        out.unwrap_or([[f64::NAN; 2]; 2])
    }

    /// Over a box in a cell, given by its lower corner; `p` counts from there.
    fn in_cell<const SLOPE: bool>(&self, corner: [f64; 3], p: [[f64; 2]; 3], by: [[f64; 2]; 3]) -> One {
        let gradients = self.corners(corner);
        let weights = p.map(|at| self.weight(at, SLOPE));
        let product = |index: usize| -> One {
            let from = [index & 1, (index >> 1) & 1, index >> 2].map(|side| side as f64);
            let (mut low, mut high, mut size) = (0.0, 0.0, 0.0);
            let mut slope = [0.0; 2];
            for axis in 0..3 {
                let g = gradients[index][axis];
                let (a, b) = (g * (p[axis][0] - from[axis]), g * (p[axis][1] - from[axis]));
                low += least(a, b);
                high += most(a, b);
                size += most(a.abs(), b.abs());
                if SLOPE {
                    let [c, d] = by[axis].map(|v| g * v);
                    slope = [slope[0] + least(c, d), slope[1] + most(c, d)];
                }
            }
            let off = 8.0 * f64::EPSILON * size;
            [[low - off, high + off], slope]
        };
        let along = |axis: usize, a: One, b: One| -> One {
            let [weight, growth] = weights[axis];
            let value = blend(weight, a[0], b[0]);
            if !SLOPE {
                return [value, [0.0; 2]];
            }
            let [c, d] = blend(weight, a[1], b[1]);
            let rise = times(times(growth, by[axis]), [b[0][0] - a[0][1], b[0][1] - a[0][0]]);
            [value, [c + rise[0], d + rise[1]]]
        };
        let low = along(1, along(0, product(0), product(1)), along(0, product(2), product(3)));
        let high = along(1, along(0, product(4), product(5)), along(0, product(6), product(7)));
        along(2, low, high)
    }

    /// The gradients at the corners of a cell: x first, then y, then z.
    fn corners(&self, corner: [f64; 3]) -> [[f64; 3]; 8] {
        let [i, j, k] = match self.kind {
            NoiseKind::Improved => corner.map(cell),
            NoiseKind::Classic => corner.map(|v| classic_cell(v + 256.0)),
        };
        let hash = |i: u64| u64::from(self.permutation[(i & 255) as usize]);
        std::array::from_fn(|index| {
            let [a, b, c] = [index & 1, (index >> 1) & 1, index >> 2].map(|side| side as u64);
            let h = hash(hash(i.wrapping_add(a)) + j.wrapping_add(b) % 256) + k.wrapping_add(c) % 256;
            let h = if self.kind == NoiseKind::Improved { hash(h) } else { h };
            self.gradients[(h & 255) as usize]
        })
    }

    /// The weight of the farther corner along an axis, and how it grows.
    fn weight(&self, [a, b]: [f64; 2], slope: bool) -> One {
        const OFF: f64 = 16.0 * f64::EPSILON;
        let improved = self.kind == NoiseKind::Improved;
        let at = |t: f64| {
            if improved { t * t * t * (t * (t * 6.0 - 15.0) + 10.0) } else { t * t * (3.0 - 2.0 * t) }
        };
        let value = [most(at(a) - OFF, 0.0), least(at(b) + OFF, 1.0 + OFF)];
        if !slope {
            return [value, [0.0; 2]];
        }
        let growth =
            |t: f64| if improved { 30.0 * t * t * (t - 1.0) * (t - 1.0) } else { 6.0 * t * (1.0 - t) };
        let (p, q) = (growth(a), growth(b));
        let high = if a <= 0.5 && b >= 0.5 { growth(0.5) } else { most(p, q) };
        [value, [most(least(p, q) - OFF, 0.0), high + OFF]]
    }
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
fn blend(weight: [f64; 2], a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let at = |t: f64, side: usize| a[side] + t * (b[side] - a[side]);
    let low = least(at(weight[0], 0), at(weight[1], 0));
    let high = most(at(weight[0], 1), at(weight[1], 1));
    let off = 4.0 * f64::EPSILON * most(most(a[0].abs(), a[1].abs()), most(b[0].abs(), b[1].abs()));
    [low - off, high + off]
}

fn times([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    let product = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
    let (p, q, r, s) = (product(a, c), product(a, d), product(b, c), product(b, d));
    [least(least(p, q), least(r, s)), most(most(p, q), most(r, s))]
}

fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
