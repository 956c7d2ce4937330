//! A plan gives what the definition gives, to the bit, at every instruction set and for any number of points.

#![allow(clippy::unwrap_used, reason = "a test may fail loudly")]

use fearless_simd::Level;
use hray_expr::{Binary, Block, Builder, Function, Image, Input, NodeId, NoiseKind, NoiseTables};
use hray_expr::{Plan, PlanScratch, Unary};
use proptest::prelude::*;
use std::sync::Arc;

const UNARY: [Unary; 15] = [
    Unary::Neg,
    Unary::Abs,
    Unary::Floor,
    Unary::Ceil,
    Unary::Round,
    Unary::Sqrt,
    Unary::Sin,
    Unary::Cos,
    Unary::Tan,
    Unary::Asin,
    Unary::Acos,
    Unary::Atan,
    Unary::Exp,
    Unary::Ln,
    Unary::Not,
];

const BINARY: [Binary; 15] = [
    Binary::Add,
    Binary::Sub,
    Binary::Mul,
    Binary::Div,
    Binary::Modulo,
    Binary::Min,
    Binary::Max,
    Binary::Pow,
    Binary::Atan2,
    Binary::Less,
    Binary::LessEqual,
    Binary::Equal,
    Binary::And,
    Binary::Or,
    Binary::Random,
];

/// The instruction sets of this machine.
fn levels() -> Vec<Level> {
    let mut levels = vec![Level::baseline(), Level::new()];
    #[cfg(target_arch = "x86_64")]
    {
        levels.extend(Level::new().as_sse4_2().map(Level::Sse4_2));
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        levels.extend(Level::new().as_avx512().map(Level::Avx512));
    }
    levels
}

/// Evaluates at all points by a plan and one by one, and compares.
fn check(function: &Function, columns: &[Vec<f64>; Input::COUNT]) {
    let tables = NoiseTables::default();
    let len = columns[0].len();
    let plan = Plan::new(function, &tables);
    let expected: Vec<Vec<f64>> = (0..len)
        .map(|i| function.evaluate(&tables, &std::array::from_fn(|input| columns[input][i])))
        .collect();
    let mut scratch = PlanScratch::default();
    for level in levels() {
        let mut outputs = vec![vec![0.5; len]; function.outputs().len()];
        let inputs: [&[f64]; Input::COUNT] = std::array::from_fn(|i| {
            if plan.inputs().contains(&Input::ALL[i]) { columns[i].as_slice() } else { &[] }
        });
        let mut slices: Vec<&mut [f64]> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
        plan.evaluate(level, &inputs, len, &mut scratch, &mut slices);
        for i in 0..len {
            for (k, output) in outputs.iter().enumerate() {
                let (a, b) = (output[i], expected[i][k]);
                let same = a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan());
                assert!(same, "{level:?}, point {i} of {len}, output {k}: {a:e} instead of {b:e}\n{plan:?}");
            }
        }
    }
}

/// What to add to a graph; numbers choose among what is there.
#[derive(Clone, Debug)]
enum Step {
    Constant(f64),
    Input(usize),
    Unary(usize, usize),
    Binary(usize, usize, usize),
    Select(usize, usize, usize),
    Noise(bool, u64, [usize; 3]),
    /// Noise at a multiple of a point, weighed and added.
    Octave {
        classic: bool,
        absolute: bool,
        octave: i32,
        p: [usize; 3],
        sum: usize,
    },
    Cells(u64, [usize; 3]),
    Image(usize, usize),
    Loop {
        max: u32,
        initial: Vec<usize>,
        until: usize,
        body: Vec<Step>,
        step: Vec<usize>,
    },
}

fn number() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![
        6 => -4.0..4.0f64,
        2 => (-8i32..8).prop_map(|n| f64::from(n) / 2.0),
        1 => any::<u64>().prop_map(f64::from_bits),
        1 => prop_oneof![
            Just(0.0), Just(-0.0), Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY),
            Just(1e300), Just(-1e-300), Just(5e-324), Just(1e17), Just(-4503599627370497.5), Just(0.5), Just(2.0)
        ],
    ]
}

fn place() -> impl Strategy<Value = usize> + Clone {
    0..1000usize
}

fn places() -> impl Strategy<Value = [usize; 3]> + Clone {
    proptest::array::uniform3(place())
}

fn flat() -> impl Strategy<Value = Step> {
    prop_oneof![
        2 => number().prop_map(Step::Constant),
        3 => (0..Input::COUNT).prop_map(Step::Input),
        4 => (0..UNARY.len(), place()).prop_map(|(f, a)| Step::Unary(f, a)),
        8 => (0..BINARY.len(), place(), place()).prop_map(|(f, a, b)| Step::Binary(f, a, b)),
        4 => (0..3usize, place(), place()).prop_map(|(f, a, b)| Step::Binary(f, a, b)),
        2 => (place(), place(), place()).prop_map(|(c, a, b)| Step::Select(c, a, b)),
        1 => (any::<bool>(), 0..5u64, places()).prop_map(|(kind, seed, p)| Step::Noise(kind, seed, p)),
        2 => (any::<bool>(), any::<bool>(), -2..4i32, places(), place()).prop_map(
            |(classic, absolute, octave, p, sum)| Step::Octave { classic, absolute, octave, p, sum }
        ),
        1 => (0..3u64, places()).prop_map(|(seed, p)| Step::Cells(seed, p)),
        1 => (place(), place()).prop_map(|(u, v)| Step::Image(u, v)),
    ]
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let step = flat().prop_recursive(2, 40, 10, |inner| {
        let indices = || proptest::collection::vec(place(), 3);
        let body = proptest::collection::vec(inner, 1..8);
        (0..6u32, 1..4usize, indices(), place(), body, indices()).prop_map(
            |(max, state, mut initial, until, body, mut step)| {
                initial.truncate(state);
                step.truncate(state);
                Step::Loop { max, initial, until, body, step }
            },
        )
    });
    proptest::collection::vec(step, 1..40)
}

struct Maker {
    builder: Builder,
    image: Arc<Image>,
}

impl Maker {
    fn add(&mut self, steps: &[Step], nodes: &mut Vec<NodeId>) {
        for step in steps {
            let at = |i: &usize| nodes[i % nodes.len()];
            let b = &mut self.builder;
            match step {
                Step::Constant(v) => nodes.push(b.constant(*v).unwrap()),
                Step::Input(i) => nodes.push(b.input(Input::ALL[*i]).unwrap()),
                Step::Unary(f, a) => nodes.push(b.unary(UNARY[*f], at(a)).unwrap()),
                Step::Binary(f, x, y) => nodes.push(b.binary(BINARY[*f], at(x), at(y)).unwrap()),
                Step::Select(c, x, y) => nodes.push(b.select(at(c), at(x), at(y)).unwrap()),
                Step::Noise(classic, seed, p) => {
                    nodes.push(b.noise(kind(*classic), *seed, p.each_ref().map(at)).unwrap());
                }
                Step::Octave { classic, absolute, octave, p, sum } => {
                    let (p, sum) = (p.each_ref().map(at), at(sum));
                    let scale = b.constant(libm::exp2(f64::from(*octave))).unwrap();
                    let p = p.map(|a| b.binary(Binary::Mul, a, scale).unwrap());
                    let n = b.noise(kind(*classic), 1, p).unwrap();
                    let n = if *absolute { b.unary(Unary::Abs, n).unwrap() } else { n };
                    let n = b.binary(Binary::Div, n, scale).unwrap();
                    nodes.push(b.binary(Binary::Add, sum, n).unwrap());
                }
                Step::Cells(seed, p) => {
                    let p = p.each_ref().map(at);
                    nodes.extend(b.block(Block::Cells { seed: *seed }, &p).unwrap());
                }
                Step::Image(u, v) => {
                    let at = [at(u), at(v)];
                    nodes.extend(b.block(Block::Image(Arc::clone(&self.image)), &at).unwrap());
                }
                Step::Loop { max, initial, until, body, step } => {
                    let initial: Vec<_> = initial.iter().map(at).collect();
                    let state = b.begin_loop(initial.len()).unwrap();
                    let mut inside = nodes.clone();
                    inside.extend(&state);
                    self.add(body, &mut inside);
                    // Most of what comes last depends on the state.
                    let inside: Vec<_> = inside.into_iter().rev().collect();
                    let at = |i: &usize| inside[(i % 20) % inside.len()];
                    let (until, step) = (at(until), step.iter().map(at).collect::<Vec<_>>());
                    nodes.extend(self.builder.end_loop(*max, &initial, until, &step).unwrap());
                }
            }
        }
    }
}

fn kind(classic: bool) -> NoiseKind {
    if classic { NoiseKind::Classic } else { NoiseKind::Improved }
}

fn function(steps: &[Step], outputs: &[usize]) -> Function {
    let pixels = (0..6u8).map(|i| [f32::from(i), 0.5, 1.0 / f32::from(i + 1), 1.0]).collect();
    let image = Arc::new(Image::new(3, 2, pixels).unwrap());
    let mut maker = Maker { builder: Builder::new(100_000), image };
    let mut nodes = vec![maker.builder.input(Input::Px).unwrap()];
    maker.add(steps, &mut nodes);
    let recent: Vec<_> = nodes.iter().rev().take(12).copied().collect();
    let outputs: Vec<_> = outputs.iter().map(|i| recent[i % recent.len()]).collect();
    maker.builder.finish(&outputs)
}

/// Columns of any numbers, of which `len` count.
fn columns(numbers: &[f64], len: usize) -> [Vec<f64>; Input::COUNT] {
    std::array::from_fn(|input| (0..len).map(|i| numbers[(i * 7 + input * 5) % numbers.len()]).collect())
}

/// Neighbouring points on a plane.
fn row(len: usize) -> [Vec<f64>; Input::COUNT] {
    std::array::from_fn(|input| {
        (0..len).map(|i| i as f64 * 0.013 * (1.0 + input as f64 * 0.1) - 2.0).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn as_the_definition(
        steps in steps(),
        outputs in proptest::collection::vec(place(), 1..4),
        numbers in proptest::collection::vec(number(), 61),
        len in prop_oneof![0..20usize, 120..140usize],
    ) {
        let function = function(&steps, &outputs);
        check(&function, &columns(&numbers, len));
        check(&function, &row(len));
    }
}

/// The texture whose speed is measured, on whole chunks and what is left over.
#[test]
fn turbulence_is_fused_to_the_bit() {
    for kind in [NoiseKind::Improved, NoiseKind::Classic] {
        let mut b = Builder::new(1000);
        let [half, four, six, mut sum] = [0.5, 4.0, 6.0, 0.0].map(|v| b.constant(v).unwrap());
        let p = [Input::Px, Input::Py, Input::Pz].map(|input| b.input(input).unwrap());
        let q = p.map(|a| b.binary(Binary::Div, a, half).unwrap());
        for k in 0..8 {
            let scale = b.constant(f64::from(1 << k)).unwrap();
            let p = q.map(|a| b.binary(Binary::Mul, a, scale).unwrap());
            let n = b.noise(kind, 0, p).unwrap();
            let n = b.unary(Unary::Abs, n).unwrap();
            let n = b.binary(Binary::Div, n, scale).unwrap();
            sum = b.binary(Binary::Add, sum, n).unwrap();
        }
        let wave = b.binary(Binary::Mul, six, sum).unwrap();
        let across = b.binary(Binary::Mul, q[0], four).unwrap();
        let angle = b.binary(Binary::Add, across, wave).unwrap();
        let vein = b.unary(Unary::Sin, angle).unwrap();
        let function = b.finish(&[vein, sum]);
        let plan = format!("{:?}", Plan::new(&function, &NoiseTables::default()));
        assert_eq!(plan.matches("NoiseOp").count(), 1, "{plan}");
        assert_eq!(plan.matches("scale:").count(), 8, "{plan}");
        for len in [1, 7, 8, 128, 300] {
            check(&function, &row(len));
        }
    }
}

/// So many registers that chunks become short.
#[test]
fn wide_graphs_take_short_chunks() {
    let mut b = Builder::new(100_000);
    let x = b.input(Input::Px).unwrap();
    let waves: Vec<_> = (0..6000)
        .map(|k| {
            let scale = b.constant(f64::from(k)).unwrap();
            b.binary(Binary::Max, x, scale).unwrap()
        })
        .collect();
    let sum = waves.into_iter().rev().reduce(|sum, w| b.binary(Binary::Add, w, sum).unwrap()).unwrap();
    check(&b.finish(&[sum]), &row(150));
}

/// The steps to leave a disc, of which every point takes its own number.
#[test]
fn points_leave_a_loop_one_by_one() {
    let mut b = Builder::new(1000);
    let x = b.input(Input::Px).unwrap();
    let y = b.input(Input::Py).unwrap();
    let [zero, one, four] = [0.0, 1.0, 4.0].map(|v| b.constant(v).unwrap());
    let state = b.begin_loop(3).unwrap();
    let xx = b.binary(Binary::Mul, state[0], state[0]).unwrap();
    let yy = b.binary(Binary::Mul, state[1], state[1]).unwrap();
    let size = b.binary(Binary::Add, xx, yy).unwrap();
    let gone = b.binary(Binary::Less, four, size).unwrap();
    let real = b.binary(Binary::Sub, xx, yy).unwrap();
    let real = b.binary(Binary::Add, real, x).unwrap();
    let xy = b.binary(Binary::Mul, state[0], state[1]).unwrap();
    let twice = b.binary(Binary::Add, xy, xy).unwrap();
    let imaginary = b.binary(Binary::Add, twice, y).unwrap();
    let count = b.binary(Binary::Add, state[2], one).unwrap();
    let result = b.end_loop(50, &[zero, zero, zero], gone, &[real, imaginary, count]).unwrap();
    let function = b.finish(&[result[2], result[0]]);
    check(&function, &row(300));
    let counts: Vec<_> = (0..20)
        .map(|i| {
            let mut inputs = [0.0; Input::COUNT];
            inputs[Input::Px as usize] = f64::from(i) * 0.1 - 1.0;
            function.evaluate(&NoiseTables::default(), &inputs)[0]
        })
        .collect();
    assert!(counts.contains(&50.0) && counts.iter().any(|n| *n < 6.0), "{counts:?}");
}
