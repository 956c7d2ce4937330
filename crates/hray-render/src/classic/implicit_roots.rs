//! Where along a line a function is 0.
//!
//! What the function may be over a stretch, and how fast it may change there, is known by interval arithmetic. A stretch over
//! which it cannot be 0 is left out; over one where it only rises or only falls there is a root if its ends differ;
//! all others are cut up, until they are so narrow that the surface counts as being there. D. Mitchell, "Robust Ray
//! Intersection with Interval Arithmetic", Graphics Interface 1990; J. Snyder, "Interval Analysis for Computer
//! Graphics", SIGGRAPH 1992.

use fearless_simd::Level;
use hray_core::DVec3;
use hray_expr::{Input, LANES, Plan, PlanScratch, Range, RangePlan, RangeScratch};

/// Into how many parts a stretch is cut.
const PARTS: usize = 8;
/// After so many looks at eight stretches those left count as narrow.
const MOST_LOOKS: u32 = 1 << 12;

/// A function, made ready.
pub(super) struct Field {
    pub(super) level: Level,
    pub(super) values: Plan,
    pub(super) ranges: RangePlan,
}

/// What one thread needs.
#[derive(Default)]
pub(super) struct Scratch {
    pub(super) values: PlanScratch,
    pub(super) ranges: RangeScratch,
    /// The next ones last.
    stretches: Vec<[f64; 2]>,
}

/// A line through space: the point at 0, and what is added to it at 1.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub(super) base: DVec3,
    pub(super) direction: DVec3,
}

/// Where a line meets the surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) at: f64,
    /// Whether it is inside beyond.
    pub(super) enters: bool,
    /// Whether it was so before, too: it only touches the surface.
    pub(super) touches: bool,
}

/// Ends of stretches with what the function is there.
#[derive(Clone, Copy)]
struct Stretch {
    from: f64,
    to: f64,
    values: [f64; 2],
}

impl Stretch {
    /// Inside is where the function is negative; where it has no value is outside.
    fn is_inside(&self) -> [bool; 2] {
        self.values.map(|v| v < 0.0)
    }
}

impl Field {
    /// The function at points of a line.
    #[inline(always)]
    pub(super) fn along<const N: usize>(
        &self,
        line: &Line,
        at: &[f64; N],
        scratch: &mut PlanScratch,
    ) -> [f64; N] {
        let [x, y, z] = [0, 1, 2].map(|axis| at.map(|at| line.base[axis] + line.direction[axis] * at));
        let mut inputs: [&[f64]; Input::COUNT] = [&[]; Input::COUNT];
        inputs[Input::Px as usize] = &x;
        inputs[Input::Py as usize] = &y;
        inputs[Input::Pz as usize] = &z;
        let mut out = [0.0; N];
        self.values.evaluate(self.level, &inputs, N, scratch, &mut [&mut out]);
        out
    }

    /// Whether points of a line are inside.
    pub(super) fn inside<const N: usize>(
        &self,
        line: &Line,
        at: &[f64; N],
        scratch: &mut Scratch,
    ) -> [bool; N] {
        self.along(line, at, &mut scratch.values).map(|v| v < 0.0)
    }

    /// Visits the roots in stretches of a line in ascending order, until `visit` has enough. Stretches are not empty and do not
    /// overlap. `narrow` is how long a stretch is that needs no cutting, `exact` how exactly roots are found.
    pub(super) fn roots(
        &self,
        line: &Line,
        stretches: &[[f64; 2]],
        [narrow, exact]: [f64; 2],
        scratch: &mut Scratch,
        mut visit: impl FnMut(Root) -> bool,
    ) {
        scratch.stretches.clear();
        scratch.stretches.extend(stretches.iter().rev());
        let mut looks = 0;
        while let Some(first) = scratch.stretches.len().checked_sub(1) {
            looks += 1;
            let start = (first + 1).saturating_sub(LANES);
            let count = first + 1 - start;
            let mut eight = [[0.0; 2]; LANES];
            for (lane, stretch) in eight.iter_mut().enumerate() {
                // Those missing repeat the last.
                *stretch = scratch.stretches[first - lane.min(count - 1)];
            }
            let [value, slope] = self.over(line, &eight, &mut scratch.ranges);
            // Roots may be in these.
            let mut open = 0u32;
            for lane in 0..count {
                let [low, high] = value.lane(lane);
                open |= u32::from(low <= 0.0 && high >= 0.0) << lane;
            }
            let mut ends = [[0.0; 2]; LANES];
            if open != 0 {
                let at: [f64; 2 * LANES] = std::array::from_fn(|i| eight[i % LANES][i / LANES]);
                let values = self.along(line, &at, &mut scratch.values);
                ends = std::array::from_fn(|lane| [values[lane], values[lane + LANES]]);
            }
            let mut done = count;
            for lane in 0..count {
                if open >> lane & 1 == 0 {
                    continue;
                }
                let [from, to] = eight[lane];
                let stretch = Stretch { from, to, values: ends[lane] };
                let slope = slope.lane(lane);
                match look(&stretch, value.lane(lane), slope, narrow, looks > MOST_LOOKS) {
                    Found::Nothing => {}
                    Found::Touch => {
                        let [enters, _] = stretch.is_inside();
                        if visit(Root { at: 0.5 * (from + to), enters, touches: true }) {
                            return;
                        }
                    }
                    Found::Crossing => {
                        let root = self.refine(line, &stretch, exact, &mut scratch.values);
                        if visit(root) {
                            return;
                        }
                    }
                    Found::Unknown => {
                        // What follows is looked at again, after its parts.
                        done = lane;
                        break;
                    }
                }
            }
            scratch.stretches.truncate(first + 1 - done);
            if done < count
                && let Some([from, to]) = scratch.stretches.pop()
            {
                let width = to - from;
                let cut = |part: usize| match part {
                    0 => from,
                    PARTS => to,
                    _ => from + width * (part as f64 / PARTS as f64),
                };
                scratch.stretches.extend((0..PARTS).rev().map(|part| [cut(part), cut(part + 1)]));
            }
        }
    }

    /// What the function may be over stretches, and how fast it may change.
    #[inline(always)]
    fn over(&self, line: &Line, stretches: &[[f64; 2]; LANES], scratch: &mut RangeScratch) -> [Range; 2] {
        let mut p = [Range::ZERO; 3];
        for axis in 0..3 {
            let (base, direction) = (line.base[axis], line.direction[axis]);
            for (lane, [from, to]) in stretches.iter().enumerate() {
                // Rounding is monotonic: all points between lie between.
                let (a, b) = (base + direction * from, base + direction * to);
                p[axis].low[lane] = if a < b { a } else { b };
                p[axis].high[lane] = if a < b { b } else { a };
            }
        }
        let directions = line.direction.to_array().map(|d| Range::from_ends(d, d));
        self.ranges.slopes(self.level, &p, &directions, scratch)
    }

    /// Where the surface is crossed between the ends of a stretch, one of which is inside.
    fn refine(&self, line: &Line, stretch: &Stretch, exact: f64, scratch: &mut PlanScratch) -> Root {
        let [was_inside, enters] = stretch.is_inside();
        let Stretch { mut from, mut to, values: [mut before, mut after] } = *stretch;
        let mut evenly = false;
        while to - from > exact {
            let width = to - from;
            // Around where the chord is 0, closer and closer; or evenly, where that has not helped.
            let chord = from + width * (before / (before - after));
            let near = |share: f64| chord + width * share;
            let at: [f64; LANES] = if evenly || !(chord > from && chord < to) {
                std::array::from_fn(|i| from + width * ((i + 1) as f64 / 9.0))
            } else {
                [-0.125, -0.0078125, -1e-4, -1e-7, 1e-7, 1e-4, 0.0078125, 0.125].map(near)
            };
            let at = at.map(|at| at.clamp(from, to));
            let values = self.along(line, &at, scratch);
            let all_at: [f64; LANES + 1] = std::array::from_fn(|i| at.get(i).copied().unwrap_or(to));
            let all_values: [f64; LANES + 1] =
                std::array::from_fn(|i| values.get(i).copied().unwrap_or(after));
            // The last has crossed.
            let crossed = all_values.iter().position(|v| (*v < 0.0) != was_inside).unwrap_or(LANES);
            if crossed > 0 {
                (from, before) = (all_at[crossed - 1], all_values[crossed - 1]);
            }
            (to, after) = (all_at[crossed], all_values[crossed]);
            if to - from >= width {
                // Neighbouring numbers.
                break;
            }
            evenly = !evenly && to - from > 0.25 * width;
        }
        Root { at: 0.5 * (from + to), enters, touches: false }
    }
}

/// What is in a stretch.
enum Found {
    Nothing,
    Crossing,
    Touch,
    Unknown,
}

/// What is in a stretch over whose range 0 is.
fn look(stretch: &Stretch, value: [f64; 2], [least, most]: [f64; 2], narrow: f64, enough: bool) -> Found {
    let [a, b] = stretch.is_inside();
    // Ascending or descending throughout, without jumps.
    let is_monotonic = least.is_finite() && most.is_finite() && (least > 0.0 || most < 0.0);
    if is_monotonic {
        return if a == b { Found::Nothing } else { Found::Crossing };
    }
    let width = stretch.to - stretch.from;
    if a == b && stays_off(stretch, [least, most]) {
        return Found::Nothing;
    }
    if !(enough || width <= narrow) {
        return Found::Unknown;
    }
    if a != b {
        return Found::Crossing;
    }
    // Where it may jump, and both ends are on one side, nothing says that it is 0 in between.
    let may_jump = least.is_infinite() || most.is_infinite() || value.iter().any(|v| v.is_infinite());
    if may_jump || enough { Found::Nothing } else { Found::Touch }
}

/// Whether slopes are so small that a function does not get from its values at both ends to 0.
fn stays_off(stretch: &Stretch, [least, most]: [f64; 2]) -> bool {
    let [a, b] = stretch.values;
    // As for values above 0: what goes down from the start meets what goes down from the end.
    let (a, b, least, most) = if a < 0.0 { (-a, -b, -most, -least) } else { (a, b, least, most) };
    let width = stretch.to - stretch.from;
    let lowest = (a * most - b * least + least * most * width) / (most - least);
    // Rounding of the values is far below that; not of those that come out of great numbers, which are cut up.
    let slack = (a + b + (most - least) * width) * 1e-9;
    lowest > slack
}
