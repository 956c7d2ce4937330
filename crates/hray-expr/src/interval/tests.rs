//! Ranges hold what they claim to: random graphs at random points of random boxes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

use super::*;
use crate::{Binary, Builder, NodeId, NoiseKind, Unary};
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

/// A graph by a list of choices, each of which makes a node of those before it.
fn graph(choices: &[(u8, u8, u8, u8, f64)]) -> Function {
    let mut b = Builder::new(10_000);
    let mut nodes: Vec<NodeId> =
        [Input::Px, Input::Py, Input::Pz].map(|input| b.input(input).unwrap()).to_vec();
    for (kind, i, j, k, v) in choices {
        let pick = |n: &u8| nodes[usize::from(*n) % nodes.len()];
        let (x, y, z) = (pick(i), pick(j), pick(k));
        let node = match kind % 40 {
            0..15 => b.unary(UNARY[usize::from(kind % 40)], x).unwrap(),
            15..30 => b.binary(BINARY[usize::from(kind % 40) - 15], x, y).unwrap(),
            30 => b.select(x, y, z).unwrap(),
            31 => b.noise(NoiseKind::Improved, u64::from(*j % 2), [x, y, z]).unwrap(),
            32 => b.noise(NoiseKind::Classic, u64::from(*j % 2), [nodes[0], nodes[1], nodes[2]]).unwrap(),
            33 => b.block(Block::Cells { seed: 1 }, &[x, y, z]).unwrap()[usize::from(*k % 6)],
            34 => {
                let exponent = b.constant((v * 5.0).round()).unwrap();
                b.binary(Binary::Pow, x, exponent).unwrap()
            }
            35 => {
                // Until the state exceeds a limit it grows.
                let state = b.begin_loop(1).unwrap();
                let limit = b.constant(*v).unwrap();
                let until = b.binary(Binary::Less, limit, state[0]).unwrap();
                let next = b.binary(Binary::Add, state[0], y).unwrap();
                b.end_loop(4, &[x], until, &[next]).unwrap()[0]
            }
            36 => {
                let pixels = (0..12).map(|i| [i as f32, (i * 5 % 7) as f32, 0.5, 1.0]).collect();
                let image = Arc::new(Image::new(4, 3, pixels).unwrap());
                b.block(Block::Image(image), &[x, y]).unwrap()[usize::from(*k % 4)]
            }
            37 => b.binary(Binary::Mul, x, x).unwrap(),
            _ => b.constant(*v).unwrap(),
        };
        nodes.push(node);
    }
    // The others follow, so that one can see whether any of them is not a number.
    nodes.reverse();
    b.finish(&nodes)
}

fn choices() -> impl Strategy<Value = Vec<(u8, u8, u8, u8, f64)>> {
    prop::collection::vec((any::<u8>(), any::<u8>(), any::<u8>(), any::<u8>(), -3.0..3.0f64), 1..12)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn every_value_is_in_its_range(
        choices in choices(), middle in [-4.0..4.0f64, -4.0..4.0f64, -4.0..4.0f64], size in -12.0..1.0f64,
        places in prop::collection::vec([0.0..1.0f64, 0.0..1.0f64, 0.0..1.0f64], 20),
    ) {
        let function = graph(&choices);
        let tables = NoiseTables::default();
        let plan = RangePlan::new(&function, &tables);
        let size = libm::exp2(size * 3.0);
        let p = middle.map(|m| Range::from_ends(m - size, m + size));
        let range = plan.values(Level::new(), &p, &mut RangeScratch::default());
        let [with_slopes, slope] = plan.slopes(
            Level::new(), &p, &[Range::from_ends(1.0, 1.0), Range::ZERO, Range::ZERO], &mut RangeScratch::default(),
        );
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits() || (a == b) || (a.is_nan() && b.is_nan());
        prop_assert!(same(range.low[0], with_slopes.low[0]) && same(range.high[0], with_slopes.high[0]));
        let [low, high] = range.lane(3);
        let at = |p: [f64; 3]| {
            let mut inputs = [0.0; Input::COUNT];
            inputs[..3].copy_from_slice(&p);
            let values = function.evaluate(&tables, &inputs);
            if values.iter().any(|v| !v.is_finite()) { f64::NAN } else { values[0] }
        };
        for place in &places {
            let p = [0, 1, 2].map(|axis: usize| {
                let (low, high) = (middle[axis] - size, middle[axis] + size);
                (low + (high - low) * place[axis]).clamp(low, high)
            });
            let value = at(p);
            if !value.is_nan() {
                prop_assert!(low <= value && value <= high, "{value} at {p:?} is not in {low} {high}");
                // What the slope says of two points.
                let q = [middle[0] + size, p[1], p[2]];
                let there = at(q);
                let [least, most] = slope.lane(2);
                let step = q[0] - p[0];
                if there.is_finite() && value.is_finite() && step > 0.0 && least.is_finite() && most.is_finite() {
                    let off = 1e-9 * (1.0 + value.abs() + there.abs() + low.abs().min(1e300) + high.abs().min(1e300));
                    prop_assert!(there - value >= least * step - off && there - value <= most * step + off,
                        "from {value} to {there} in {step}: not by {least} to {most}");
                }
            }
        }
    }
}

fn unary_of(points: &[f64], f: impl Fn(&mut Builder, NodeId) -> NodeId) -> [Range; 2] {
    let mut b = Builder::new(100);
    let x = b.input(Input::Px).unwrap();
    let node = f(&mut b, x);
    let plan = RangePlan::new(&b.finish(&[node]), &NoiseTables::default());
    let p = [Range::from_ends(points[0], points[1]), Range::ZERO, Range::ZERO];
    plan.slopes(
        Level::new(),
        &p,
        &[Range::from_ends(1.0, 1.0), Range::ZERO, Range::ZERO],
        &mut RangeScratch::default(),
    )
}

/// Not wider than need be.
#[test]
fn ranges_are_narrow() {
    let [value, slope] = unary_of(&[-1.0, 2.0], |b, x| b.binary(Binary::Mul, x, x).unwrap());
    assert_eq!((value.lane(0), slope.lane(0)), ([0.0, 4.0], [-2.0, 4.0]));
    let [value, slope] = unary_of(&[0.1, 0.2], |b, x| b.unary(Unary::Sin, x).unwrap());
    assert!((value.low[0] - libm::sin(0.1)).abs() < 1e-15 && (value.high[0] - libm::sin(0.2)).abs() < 1e-15);
    assert!((slope.high[7] - libm::cos(0.1)).abs() < 1e-15);
    let [value, _] = unary_of(&[1.0, 2.0], |b, x| b.unary(Unary::Sin, x).unwrap());
    assert_eq!(value.high[0], 1.0);
    let [value, slope] = unary_of(&[-3.0, -2.0], |b, x| {
        let four = b.constant(4.0).unwrap();
        b.binary(Binary::Pow, x, four).unwrap()
    });
    assert!((value.low[0] - 16.0).abs() < 1e-12 && (value.high[0] - 81.0).abs() < 1e-12);
    assert!((slope.low[0] + 108.0).abs() < 1e-12 && (slope.high[0] + 32.0).abs() < 1e-12);
    let [value, slope] = unary_of(&[0.3, 0.3], |b, x| b.noise(NoiseKind::Improved, 0, [x, x, x]).unwrap());
    assert!((value.low[0] - crate::improved_noise(0, [0.3; 3])).abs() < 1e-13);
    let step = 1e-5;
    let rise = crate::improved_noise(0, [0.3 + step; 3]) - crate::improved_noise(0, [0.3 - step; 3]);
    let mut b = Builder::new(100);
    let inputs = [Input::Px, Input::Py, Input::Pz].map(|input| b.input(input).unwrap());
    let noise = b.noise(NoiseKind::Improved, 0, inputs).unwrap();
    let plan = RangePlan::new(&b.finish(&[noise]), &NoiseTables::default());
    let p = [Range::from_ends(0.3, 0.3); 3];
    let along = [Range::from_ends(1.0, 1.0); 3];
    let [_, diagonal] = plan.slopes(Level::new(), &p, &along, &mut RangeScratch::default());
    assert!((diagonal.low[0] - rise / (2.0 * step)).abs() < 1e-8);
    assert!(diagonal.high[0] - diagonal.low[0] < 1e-12);
    assert!(slope.high[0] - slope.low[0] < 1e-12);
}
