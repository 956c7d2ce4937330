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
    stretches: Vec<Stretch>,
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

/// A stretch of a line.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    from: f64,
    to: f64,
    /// What the function is at the ends.
    values: [f64; 2],
    state: State,
}

/// What is known of a stretch.
#[derive(Clone, Copy, Debug)]
enum State {
    /// Not even the values.
    New,
    /// The values.
    Valued,
    /// It is to be cut; how fast the function may change.
    Open([f64; 2]),
    Found(Found),
}

impl Stretch {
    /// Inside is where the function is negative; where it has no value is outside.
    fn is_inside(&self) -> [bool; 2] {
        self.values.map(|v| v < 0.0)
    }
}

impl Field {
    /// The function at points, given by their coordinates.
    #[inline(always)]
    pub(super) fn at<const N: usize>(
        &self,
        [x, y, z]: &[[f64; N]; 3],
        scratch: &mut PlanScratch,
    ) -> [f64; N] {
        let mut inputs: [&[f64]; Input::COUNT] = [&[]; Input::COUNT];
        inputs[Input::Px as usize] = x;
        inputs[Input::Py as usize] = y;
        inputs[Input::Pz as usize] = z;
        let mut out = [0.0; N];
        self.values.evaluate(self.level, &inputs, N, scratch, &mut [&mut out]);
        out
    }

    /// The function at points of a line.
    #[inline(always)]
    fn along<const N: usize>(&self, line: &Line, at: &[f64; N], scratch: &mut PlanScratch) -> [f64; N] {
        let points = [0, 1, 2].map(|axis| at.map(|at| line.base[axis] + line.direction[axis] * at));
        self.at(&points, scratch)
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
        let Scratch { values, ranges, stretches: stack } = scratch;
        let new =
            |[from, to]: &[f64; 2]| Stretch { from: *from, to: *to, values: [0.0; 2], state: State::New };
        stack.clear();
        stack.extend(stretches.iter().rev().map(new));
        let mut looks = 0;
        while let Some(top) = stack.last() {
            match top.state {
                State::New | State::Valued => {
                    looks += 1;
                    self.look(line, narrow, looks > MOST_LOOKS, stack, values, ranges);
                }
                State::Open(slope) => {
                    let stretch = *top;
                    stack.pop();
                    self.cut(line, &stretch, slope, stack, values);
                }
                State::Found(found) => {
                    let stretch = *top;
                    stack.pop();
                    let is_enough = match found {
                        Found::Nothing => false,
                        Found::Touch => {
                            let [enters, _] = stretch.is_inside();
                            visit(Root { at: 0.5 * (stretch.from + stretch.to), enters, touches: true })
                        }
                        Found::Crossing => visit(self.refine(line, &stretch, exact, values)),
                    };
                    if is_enough {
                        return;
                    }
                }
            }
        }
    }

    /// Looks at the next eight stretches that have not been looked at.
    fn look(
        &self,
        line: &Line,
        narrow: f64,
        is_last: bool,
        stack: &mut [Stretch],
        scratch: &mut PlanScratch,
        ranges: &mut RangeScratch,
    ) {
        let (mut places, mut count) = ([0; LANES], 0);
        for (place, stretch) in stack.iter().enumerate().rev() {
            if matches!(stretch.state, State::New | State::Valued) {
                places[count] = place;
                count += 1;
                if count == LANES {
                    break;
                }
            }
        }
        let mut ends = [[0.0; 2]; LANES];
        for lane in 0..LANES {
            // Those missing repeat the first.
            let stretch = &stack[places[if lane < count { lane } else { 0 }]];
            ends[lane] = [stretch.from, stretch.to];
        }
        let [value, slope] = self.over(line, &ends, ranges);
        let is_open = |lane: usize| {
            let [low, high] = value.lane(lane);
            low <= 0.0 && high >= 0.0
        };
        let lacks_values = |lane: usize| is_open(lane) && matches!(stack[places[lane]].state, State::New);
        if (0..count).any(lacks_values) {
            let mut at = [0.0; 2 * LANES];
            for lane in 0..LANES {
                [at[lane], at[lane + LANES]] = ends[lane];
            }
            let at = self.along(line, &at, scratch);
            for (lane, place) in places[..count].iter().enumerate() {
                stack[*place].values = [at[lane], at[lane + LANES]];
            }
        }
        for (lane, place) in places[..count].iter().enumerate() {
            let stretch = &mut stack[*place];
            stretch.state = if is_open(lane) {
                state(stretch, value.lane(lane), slope.lane(lane), narrow, is_last)
            } else {
                State::Found(Found::Nothing)
            };
        }
    }

    /// Cuts a stretch into parts, and leaves those out in which slopes that are known for the whole do not let the function get
    /// to 0.
    fn cut(
        &self,
        line: &Line,
        stretch: &Stretch,
        slope: [f64; 2],
        stack: &mut Vec<Stretch>,
        scratch: &mut PlanScratch,
    ) {
        let Stretch { from, to, values: [first, last], .. } = *stretch;
        let mut at = [to; PARTS];
        for (i, at) in at.iter_mut().enumerate().take(PARTS - 1) {
            *at = from + (to - from) * ((i + 1) as f64 / PARTS as f64);
        }
        let values = self.along(line, &at, scratch);
        for part in (0..PARTS).rev() {
            let part = Stretch {
                from: if part == 0 { from } else { at[part - 1] },
                to: at[part],
                values: [
                    if part == 0 { first } else { values[part - 1] },
                    if part == PARTS - 1 { last } else { values[part] },
                ],
                state: State::Valued,
            };
            let [a, b] = part.is_inside();
            let is_off = a == b && slope.iter().all(|v| v.is_finite()) && stays_off(&part, slope);
            if part.from < part.to && !is_off {
                stack.push(part);
            }
        }
    }

    /// What the function may be over stretches, and how fast it may change.
    #[inline(always)]
    fn over(&self, line: &Line, stretches: &[[f64; 2]; LANES], scratch: &mut RangeScratch) -> [Range; 2] {
        let mut p = [Range::ZERO; 3];
        for (axis, range) in p.iter_mut().enumerate() {
            let (base, direction) = (line.base[axis], line.direction[axis]);
            for (lane, [from, to]) in stretches.iter().enumerate() {
                // Rounding is monotonic: all points between lie between.
                let (a, b) = (base + direction * from, base + direction * to);
                range.low[lane] = if a < b { a } else { b };
                range.high[lane] = if a < b { b } else { a };
            }
        }
        let directions = line.direction.to_array().map(|d| Range::from_ends(d, d));
        self.ranges.slopes(self.level, &p, &directions, scratch)
    }

    /// Where the surface is crossed between the ends of a stretch, one of which is inside.
    fn refine(&self, line: &Line, stretch: &Stretch, exact: f64, scratch: &mut PlanScratch) -> Root {
        let [was_inside, enters] = stretch.is_inside();
        let Stretch { mut from, mut to, values: [mut before, mut after], .. } = *stretch;
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
#[derive(Clone, Copy, Debug)]
enum Found {
    Nothing,
    Crossing,
    Touch,
}

/// What is known of a stretch over whose range 0 is.
fn state(stretch: &Stretch, value: [f64; 2], [least, most]: [f64; 2], narrow: f64, is_last: bool) -> State {
    let [a, b] = stretch.is_inside();
    // Ascending or descending throughout, without jumps.
    let is_monotonic = least.is_finite() && most.is_finite() && (least > 0.0 || most < 0.0);
    if is_monotonic {
        return State::Found(if a == b { Found::Nothing } else { Found::Crossing });
    }
    if a == b && stays_off(stretch, [least, most]) {
        return State::Found(Found::Nothing);
    }
    if !(is_last || stretch.to - stretch.from <= narrow) {
        return State::Open([least, most]);
    }
    if a != b {
        return State::Found(Found::Crossing);
    }
    // Where it may jump, and both ends are on one side, nothing says that it is 0 in between.
    let may_jump = least.is_infinite() || most.is_infinite() || value.iter().any(|v| v.is_infinite());
    State::Found(if may_jump || is_last { Found::Nothing } else { Found::Touch })
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
