//! What a function may be over boxes, and how fast it may change: interval arithmetic on its graph.
//!
//! R. Moore, "Interval Analysis", 1966; for ray tracing, D. Mitchell, "Robust Ray Intersection with Interval Arithmetic",
//! Graphics Interface 1990. Eight boxes are worked out together, so that what it costs to find out which operation is next
//! is shared, and the operations are vectors.

mod bounds;
mod dual;
mod lattice;
mod range;

pub use bounds::{Extent, Unknown};
pub use range::{LANES, Range};

use crate::{Block, Function, Image, Input, Loop, Node, NoiseTables, cells};
use dual::Dual;
use fearless_simd::{Level, Simd, dispatch};
use lattice::Lattice;
use std::fmt;

/// A function of a point made ready for boxes. Of its results only the first is looked at; of its inputs only the position
/// in object space, all others may be anything.
///
/// What it gives holds every value of the computed function ([`Function::evaluate`]) at points of the box, except where
/// something on the way to that is infinite or not a number.
pub struct RangePlan {
    nodes: Vec<Step>,
    output: usize,
    lattices: Vec<Lattice>,
}

/// A node of the graph, with what can be looked up once.
enum Step {
    Node(Node),
    Noise {
        lattice: usize,
        p: [usize; 3],
    },
    /// The colours of all of the image lie in `all`.
    Image {
        image: std::sync::Arc<Image>,
        all: [[f64; 2]; 4],
        at: [usize; 2],
    },
    Cells {
        seed: u64,
        p: [usize; 3],
    },
    Loop {
        body: Box<Body>,
        arguments: Vec<usize>,
    },
}

struct Body {
    steps: Vec<Step>,
    definition: Loop,
}

/// Working memory of a [`RangePlan`], kept from call to call.
#[derive(Default)]
pub struct RangeScratch {
    values: Vec<Range>,
    /// Only where they are asked for.
    slopes: Vec<Range>,
    /// Results of blocks, one after the other.
    results: Vec<Dual>,
    /// Where those of a node start.
    starts: Vec<u32>,
}

#[inline(always)]
fn pick<const SLOPE: bool>(values: &[Range], slopes: &[Range], index: usize) -> Dual {
    Dual { value: values[index], slope: if SLOPE { slopes[index] } else { Range::ZERO } }
}

/// Where no slopes are asked for.
const NO_DIRECTION: [Range; 3] = [Range::ZERO; 3];

impl RangePlan {
    /// Makes a function ready.
    #[must_use]
    pub fn new(function: &Function, tables: &NoiseTables) -> Self {
        let mut lattices = Vec::new();
        let nodes = steps(function.nodes(), tables, &mut lattices);
        let output = function.outputs().first().map_or(0, |id| id.index());
        Self { nodes, output, lattices }
    }

    /// How many operations an evaluation takes, loops not counted.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is nothing to work out.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// What the function may be in each of eight boxes, given by the ranges of x, y and z.
    #[must_use]
    pub fn values(&self, level: Level, p: &[Range; 3], scratch: &mut RangeScratch) -> Range {
        dispatch!(level, simd => {
            self.run::<_, false>(simd, p, &NO_DIRECTION, scratch);
        });
        scratch.values.get(self.output).copied().unwrap_or(Range::ENTIRE)
    }

    /// The same, and how fast it may change where x, y and z change by `direction`.
    #[must_use]
    pub fn slopes(
        &self,
        level: Level,
        p: &[Range; 3],
        direction: &[Range; 3],
        scratch: &mut RangeScratch,
    ) -> [Range; 2] {
        dispatch!(level, simd => {
            self.run::<_, true>(simd, p, direction, scratch);
        });
        match (scratch.values.get(self.output), scratch.slopes.get(self.output)) {
            (Some(value), Some(slope)) => [*value, *slope],
            _ => [Range::ENTIRE; 2],
        }
    }

    #[inline(always)]
    fn run<S: Simd, const SLOPE: bool>(
        &self,
        simd: S,
        p: &[Range; 3],
        direction: &[Range; 3],
        scratch: &mut RangeScratch,
    ) {
        self.steps::<S, SLOPE>(simd, &self.nodes, p, direction, &[], scratch);
    }

    #[inline(always)]
    fn steps<S: Simd, const SLOPE: bool>(
        &self,
        simd: S,
        steps: &[Step],
        p: &[Range; 3],
        direction: &[Range; 3],
        arguments: &[Dual],
        scratch: &mut RangeScratch,
    ) {
        let RangeScratch { values, slopes, results, starts } = scratch;
        values.clear();
        slopes.clear();
        results.clear();
        starts.clear();
        for step in steps {
            let dual = match step {
                Step::Node(node) => match node {
                    Node::Constant(v) => Dual::constant(*v),
                    Node::Input(Input::Px) => Dual { value: p[0], slope: direction[0] },
                    Node::Input(Input::Py) => Dual { value: p[1], slope: direction[1] },
                    Node::Input(Input::Pz) => Dual { value: p[2], slope: direction[2] },
                    Node::Input(_) => Dual::ENTIRE,
                    Node::Argument(i) => arguments[*i as usize],
                    Node::Unary(f, a) => Dual::unary::<SLOPE>(*f, &pick::<SLOPE>(values, slopes, a.index())),
                    Node::Binary(f, a, b) => Dual::binary::<SLOPE>(
                        *f,
                        &pick::<SLOPE>(values, slopes, a.index()),
                        &pick::<SLOPE>(values, slopes, b.index()),
                        a == b,
                    ),
                    Node::Select(condition, a, b) => Dual::select::<SLOPE>(
                        &pick::<SLOPE>(values, slopes, condition.index()),
                        &pick::<SLOPE>(values, slopes, a.index()),
                        &pick::<SLOPE>(values, slopes, b.index()),
                    ),
                    Node::Result(block, i) => results[starts[block.index()] as usize + usize::from(*i)],
                    Node::Noise(..) | Node::Block(..) => Dual::ENTIRE,
                },
                Step::Noise { lattice, p } => self.lattices[*lattice].over::<S, SLOPE>(
                    simd,
                    [
                        &pick::<SLOPE>(values, slopes, p[0]),
                        &pick::<SLOPE>(values, slopes, p[1]),
                        &pick::<SLOPE>(values, slopes, p[2]),
                    ],
                ),
                Step::Image { image, all, at } => {
                    starts.resize(values.len() + 1, results.len() as u32);
                    results.extend(image_range::<SLOPE>(
                        image,
                        all,
                        [&pick::<SLOPE>(values, slopes, at[0]), &pick::<SLOPE>(values, slopes, at[1])],
                    ));
                    Dual::ENTIRE
                }
                Step::Cells { seed, p } => {
                    starts.resize(values.len() + 1, results.len() as u32);
                    results.extend(cell_ranges::<SLOPE>(
                        *seed,
                        [
                            &pick::<SLOPE>(values, slopes, p[0]),
                            &pick::<SLOPE>(values, slopes, p[1]),
                            &pick::<SLOPE>(values, slopes, p[2]),
                        ],
                    ));
                    Dual::ENTIRE
                }
                Step::Loop { body, arguments } => {
                    starts.resize(values.len() + 1, results.len() as u32);
                    let initial = arguments.iter().map(|i| pick::<SLOPE>(values, slopes, *i)).collect();
                    results.extend(self.repeat::<S, SLOPE>(simd, body, p, direction, initial));
                    Dual::ENTIRE
                }
            };
            values.push(dual.value);
            if SLOPE {
                slopes.push(dual.slope);
            }
        }
    }

    /// What the state may be after a loop: the hull of what it is wherever it may end.
    #[inline(never)]
    fn repeat<S: Simd, const SLOPE: bool>(
        &self,
        simd: S,
        body: &Body,
        p: &[Range; 3],
        direction: &[Range; 3],
        mut arguments: Vec<Dual>,
    ) -> Vec<Dual> {
        let Loop { state, max, until, step, .. } = &body.definition;
        let mut scratch = RangeScratch::default();
        let (mut running, mut jumps) = ([true; LANES], [false; LANES]);
        let mut ended = vec![Dual::EMPTY; *state];
        let collect = |ended: &mut [Dual], arguments: &[Dual], lanes| {
            for (ended, argument) in ended.iter_mut().zip(arguments) {
                *ended = ended.replaced(lanes, &ended.hull(argument));
            }
        };
        for _ in 0..*max {
            simd.vectorize(
                #[inline(always)]
                || self.steps::<S, SLOPE>(simd, &body.steps, p, direction, &arguments, &mut scratch),
            );
            let [surely, surely_not] = scratch.values[until.index()].certain();
            let may_end: [bool; LANES] = std::array::from_fn(|lane| running[lane] && !surely_not[lane]);
            if may_end.contains(&true) {
                collect(&mut ended, &arguments, may_end);
            }
            for lane in 0..LANES {
                running[lane] &= !surely[lane];
                // Two points of the box may take different numbers of steps.
                jumps[lane] |= may_end[lane] && running[lane];
            }
            if !running.contains(&true) {
                break;
            }
            let next: Vec<Dual> =
                step.iter().map(|id| pick::<SLOPE>(&scratch.values, &scratch.slopes, id.index())).collect();
            arguments.iter_mut().zip(next).for_each(|(argument, next)| *argument = next);
        }
        if running.contains(&true) {
            collect(&mut ended, &arguments, running);
        }
        for dual in &mut ended {
            dual.slope = dual.slope.replaced(jumps, Range::ENTIRE);
        }
        ended
    }
}

impl fmt::Debug for RangePlan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RangePlan").field("operations", &self.nodes.len()).finish_non_exhaustive()
    }
}

/// Looks up what can be looked up once.
fn steps(nodes: &[Node], tables: &NoiseTables, lattices: &mut Vec<Lattice>) -> Vec<Step> {
    let step = |node: &Node| match node {
        Node::Noise(kind, seed, p) => {
            let known = lattices.iter().position(|lattice| lattice.is(*kind, *seed));
            let lattice = known.unwrap_or_else(|| {
                lattices.push(Lattice::new(*kind, *seed, tables));
                lattices.len() - 1
            });
            Step::Noise { lattice, p: p.map(|id| id.index()) }
        }
        Node::Block(Block::Image(image), at) => {
            let mut all = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
            for pixel in image.pixels() {
                for (range, v) in all.iter_mut().zip(pixel.map(f64::from)) {
                    *range = [range[0].min(v), range[1].max(v)];
                }
            }
            let image = std::sync::Arc::clone(image);
            Step::Image { image, all, at: [at[0].index(), at[1].index()] }
        }
        Node::Block(Block::Cells { seed }, p) => {
            Step::Cells { seed: *seed, p: [p[0].index(), p[1].index(), p[2].index()] }
        }
        Node::Block(Block::Loop(definition), arguments) => {
            let body = Body {
                steps: steps(&definition.nodes, tables, lattices),
                definition: Loop { nodes: Vec::new(), ..(**definition).clone() },
            };
            Step::Loop { body: Box::new(body), arguments: arguments.iter().map(|id| id.index()).collect() }
        }
        node => Step::Node(node.clone()),
    };
    nodes.iter().map(step).collect()
}

/// The colours of an image: of one place, or of all that may be looked up.
#[inline(never)]
fn image_range<const SLOPE: bool>(image: &Image, all: &[[f64; 2]; 4], at: [&Dual; 2]) -> [Dual; 4] {
    let mut out = [Range::ZERO; 4];
    for lane in 0..LANES {
        let [u, v] = at.map(|at| at.value.lane(lane));
        let colors = colors(image, all, u, v);
        for (range, color) in out.iter_mut().zip(colors) {
            range.set(lane, color);
        }
    }
    out.map(|value| Dual::jumping::<SLOPE>(value, &at))
}

fn colors(image: &Image, all: &[[f64; 2]; 4], u: [f64; 2], v: [f64; 2]) -> [[f64; 2]; 4] {
    // Between the centres of pixels it is linear along either axis, so what bounds it are the corners and the pixels inside.
    const MOST_PIXELS: f64 = 64.0;
    let pixels = |range: [f64; 2], count: u32, sign: f64| {
        let ends = range.map(|v| sign * v * f64::from(count) - 0.5);
        let (a, b) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        [(a - 1e-6).floor(), (b + 1e-6).floor() + 1.0]
    };
    let across = pixels(u, image.width(), 1.0);
    let down = pixels(v, image.height(), -1.0);
    let count = (across[1] - across[0] + 1.0) * (down[1] - down[0] + 1.0);
    if !(count <= MOST_PIXELS && across[0].abs() < 1e15 && down[0].abs() < 1e15) {
        return *all;
    }
    let mut out = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
    let wrap = |i: f64, count: u32| (i as i64).rem_euclid(i64::from(count)) as usize;
    for y in 0..=(down[1] - down[0]) as usize {
        for x in 0..=(across[1] - across[0]) as usize {
            let row = wrap(down[0] + y as f64, image.height());
            let column = wrap(across[0] + x as f64, image.width());
            let pixel = image.pixels()[row * image.width() as usize + column];
            for (range, v) in out.iter_mut().zip(pixel.map(f64::from)) {
                *range = [range[0].min(v), range[1].max(v)];
            }
        }
    }
    out.map(|[low, high]| [low - low.abs() * 1e-15, high + high.abs() * 1e-15])
}

/// The results of Worley's texture: distances change no faster than the point moves.
#[inline(never)]
fn cell_ranges<const SLOPE: bool>(seed: u64, p: [&Dual; 3]) -> [Dual; 6] {
    let mut values = [Range::ENTIRE; 6];
    let mut slopes = [Range::ENTIRE; 6];
    for lane in 0..LANES {
        let at = p.map(|axis| axis.value.lane(lane));
        let middle = at.map(|[low, high]| low + 0.5 * (high - low));
        let half = at.map(|[low, high]| high - low).into_iter().fold(0.0, |sum, w| sum + 0.25 * w * w).sqrt();
        let results = cells(seed, middle);
        let is_point = half == 0.0;
        let off = half * (1.0 + 1e-12) + if is_point { 0.0 } else { 1e-12 };
        for (i, v) in results.into_iter().enumerate() {
            let range = match i {
                0 | 1 if !half.is_finite() => [0.0, f64::INFINITY],
                3.. if !half.is_finite() => [f64::NEG_INFINITY, f64::INFINITY],
                _ if is_point => [v, v],
                0 | 1 => [if v > off { v - off } else { 0.0 }, v + off],
                2 => [0.0, 1.0],
                _ => [-results[0] - off, results[0] + off],
            };
            values[i].set(lane, range);
        }
        if SLOPE {
            let by = p.map(|axis| axis.slope.lane(lane));
            let speed =
                by.map(|[a, b]| a.abs().max(b.abs())).into_iter().fold(0.0, |sum, v| sum + v * v).sqrt();
            slopes[0].set(lane, [-speed, speed]);
            slopes[1].set(lane, [-speed, speed]);
            if is_point && results[0] > 0.0 {
                // Away from the nearest point.
                let toward: f64 = (0..3).map(|axis| results[3 + axis] * by[axis][0]).sum();
                let exact = by.iter().all(|[a, b]| a == b);
                if exact {
                    slopes[0].set(lane, [-toward / results[0]; 2]);
                }
            }
        }
    }
    let mut out = values.map(|value| Dual::jumping::<SLOPE>(value, &p));
    if SLOPE {
        (out[0].slope, out[1].slope) = (slopes[0], slopes[1]);
    }
    out
}

#[cfg(test)]
mod tests;
