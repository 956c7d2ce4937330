//! How far the surface goes where a function is 0, and where ranges say nothing about it.

use super::range::{LANES, Range};
use super::{RangePlan, RangeScratch, Step};
use crate::Node;
use fearless_simd::Level;

/// Surfaces are looked for up to 2 to the power of this many units away.
const FARTHEST: i32 = 64;
/// How often a box about whose range nothing can be said is cut into eight, when one looks for an end.
const MOST_CUTS: u32 = 3;
/// The same, when one looks for a place where nothing is known.
const MOST_CUTS_TO_UNKNOWN: u32 = 7;

/// How far the surface goes where a function is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// There is none.
    Nothing,
    /// It lies within a cube around the centre, with half of this as its side; outside of that the function is greater
    /// than 0 or has no value.
    Within(f64),
    /// The same, but outside of that it is less than 0.
    InsideOut(f64),
    /// There is no end, or none that ranges show.
    Endless,
}

/// A place where ranges say nothing about a function: it may be 0 and infinite.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Where.
    pub place: [f64; 3],
    /// The first operation whose result is infinite there, if it is one by itself.
    pub cause: Option<Node>,
}

/// So many boxes at least, and eight times as many at most, are looked at to find the bounds of a surface.
const FINE: usize = 1 << 9;
/// Bounds are narrowed again where they have become smaller than this share, and so many times at most.
const WORTHWHILE: f64 = 0.9;
const MOST_TIMES: u32 = 16;

#[derive(Clone, Copy)]
struct Cuboid {
    from: [f64; 3],
    size: [f64; 3],
}

impl Cuboid {
    fn between([min, max]: [[f64; 3]; 2]) -> Self {
        Self { from: min, size: [0, 1, 2].map(|axis| max[axis] - min[axis]) }
    }

    fn eighths(self) -> [Self; LANES] {
        let size = self.size.map(|size| 0.5 * size);
        std::array::from_fn(|part| {
            let from =
                [0, 1, 2].map(|axis| self.from[axis] + if part >> axis & 1 == 1 { size[axis] } else { 0.0 });
            Self { from, size }
        })
    }
}

impl RangePlan {
    /// How far the surface goes where the function is 0, seen from a point; up to 2^64 units.
    #[must_use]
    pub fn extent(&self, center: [f64; 3], scratch: &mut RangeScratch) -> Extent {
        let level = Level::new();
        let mut is_negative = false;
        for power in (-FARTHEST..FARTHEST).rev() {
            let size = libm::exp2(f64::from(power));
            // From half a cube of 4 sizes to one of 2 sizes.
            let mut shell = Vec::with_capacity(56);
            for i in 0..64 {
                let place = [i & 3, i >> 2 & 3, i >> 4];
                if place.iter().any(|along| matches!(along, 0 | 3)) {
                    let from = [0, 1, 2].map(|axis| center[axis] + size * (f64::from(place[axis]) - 2.0));
                    shell.push(Cuboid { from, size: [size; 3] });
                }
            }
            match self.sign(level, &shell, MOST_CUTS, scratch) {
                Some(sign) => is_negative |= sign,
                None if power == FARTHEST - 1 => return Extent::Endless,
                None if is_negative => return Extent::InsideOut(2.0 * size),
                None => return Extent::Within(2.0 * size),
            }
        }
        Extent::Nothing
    }

    /// Whether the function is negative anywhere in boxes; nothing where it may be 0.
    fn sign(&self, level: Level, boxes: &[Cuboid], cuts: u32, scratch: &mut RangeScratch) -> Option<bool> {
        let mut is_negative = false;
        for eight in boxes.chunks(LANES) {
            let range = self.values(level, &ranges(eight), scratch);
            for (lane, cuboid) in eight.iter().enumerate() {
                let [low, high] = range.lane(lane);
                if !(low <= 0.0 && high >= 0.0) {
                    is_negative |= high < 0.0;
                } else if cuts == 0 {
                    return None;
                } else {
                    is_negative |= self.sign(level, &cuboid.eighths(), cuts - 1, scratch)?;
                }
            }
        }
        Some(is_negative)
    }

    /// A box around all places of a box where the function may be 0; nothing where it is so nowhere.
    #[must_use]
    pub fn tight_bounds(&self, corners: [[f64; 3]; 2], scratch: &mut RangeScratch) -> Option<[[f64; 3]; 2]> {
        let level = Level::new();
        let mut bounds = corners;
        for _ in 0..MOST_TIMES {
            let mut boxes = vec![Cuboid::between(bounds)];
            while boxes.len() < FINE && !boxes.is_empty() {
                let mut open = Vec::new();
                for cuboid in &boxes {
                    let parts = cuboid.eighths();
                    let range = self.values(level, &ranges(&parts), scratch);
                    for (lane, part) in parts.into_iter().enumerate() {
                        let [low, high] = range.lane(lane);
                        if low <= 0.0 && high >= 0.0 {
                            open.push(part);
                        }
                    }
                }
                // What does not become narrower is a point.
                let is_small = |cuboid: &Cuboid| {
                    (0..3).any(|axis| cuboid.from[axis] + cuboid.size[axis] <= cuboid.from[axis])
                };
                let is_done = open.iter().any(is_small);
                boxes = open;
                if is_done {
                    break;
                }
            }
            let mut around: Option<[[f64; 3]; 2]> = None;
            for Cuboid { from, size } in &boxes {
                let [min, max] = around.get_or_insert([*from; 2]);
                for axis in 0..3 {
                    min[axis] = min[axis].min(from[axis]);
                    max[axis] = max[axis].max(from[axis] + size[axis]);
                }
            }
            let around = around?;
            let is_narrower = (0..3).any(|axis| {
                around[1][axis] - around[0][axis] < WORTHWHILE * (bounds[1][axis] - bounds[0][axis])
            });
            bounds = around;
            if !is_narrower {
                break;
            }
        }
        Some(bounds)
    }

    /// A place in a box where ranges say nothing about whether the function is 0, however small they are: where
    /// something is divided by what may be 0, and the like.
    #[must_use]
    pub fn unknown(&self, [min, max]: [[f64; 3]; 2], scratch: &mut RangeScratch) -> Option<Unknown> {
        let level = Level::new();
        let Cuboid { from, size } = Cuboid::between([min, max]);
        // A little off, so that what is odd in the middle is not on an edge.
        let from = [0, 1, 2].map(|axis| from[axis] - size[axis] * 0.03);
        let cuboid = Cuboid { from, size: size.map(|size| size * 1.07) };
        self.unknown_in(level, &[cuboid], MOST_CUTS_TO_UNKNOWN, &mut 4096, scratch)
    }

    fn unknown_in(
        &self,
        level: Level,
        boxes: &[Cuboid],
        cuts: u32,
        left: &mut u32,
        scratch: &mut RangeScratch,
    ) -> Option<Unknown> {
        *left = left.checked_sub(1)?;
        let range = self.values(level, &ranges(boxes), scratch);
        for (lane, cuboid) in boxes.iter().enumerate() {
            let [low, high] = range.lane(lane);
            let is_unknown = low <= 0.0 && high >= 0.0 && (low.is_infinite() || high.is_infinite());
            if is_unknown && cuts == 0 {
                let place = [0, 1, 2].map(|axis| cuboid.from[axis] + 0.5 * cuboid.size[axis]);
                return Some(Unknown { place, cause: self.cause(lane, scratch) });
            }
            if is_unknown {
                let found = self.unknown_in(level, &cuboid.eighths(), cuts - 1, left, scratch);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// The first operation with an infinite result, of what was worked out last.
    fn cause(&self, lane: usize, scratch: &RangeScratch) -> Option<Node> {
        let is_infinite = |value: &Range| value.lane(lane).iter().any(|v| v.is_infinite());
        let mut values = self.nodes.iter().zip(&scratch.values);
        // The blocks themselves have no value.
        let first = values.find(|(step, value)| {
            is_infinite(value) && !matches!(step, Step::Image { .. } | Step::Cells { .. } | Step::Loop { .. })
        });
        match first?.0 {
            Step::Node(node) => Some(node.clone()),
            _ => None,
        }
    }
}

/// Of up to eight boxes; the last one fills the rest.
fn ranges(boxes: &[Cuboid]) -> [Range; 3] {
    let mut ranges = [Range::ZERO; 3];
    for lane in 0..LANES {
        if let Some(cuboid) = boxes.get(lane).or(boxes.last()) {
            for (axis, range) in ranges.iter_mut().enumerate() {
                range.set(lane, [cuboid.from[axis], cuboid.from[axis] + cuboid.size[axis]]);
            }
        }
    }
    ranges
}
