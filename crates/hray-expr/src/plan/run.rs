//! Running operations on registers.

use super::each::{self, Left, Power, Right, Second, Third, Three, Two, each1, each2, each3};
use super::op::{LoopOp, NoiseOp, Op, Operand, Register, Term};
use crate::kernels::cells::cells;
use crate::kernels::improved::Improved;
use crate::kernels::lanes::{Lanes, MAX_LANES, Mask, Vec3};
use crate::kernels::noise::Noise;
use crate::{Binary, Image, NoiseKind, Unary};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use std::ops::Range;

/// Numbers at eight neighbouring points, one or several vectors of any machine.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(super) struct Line(pub(super) [f64; MAX_LANES]);

impl Line {
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S, k: usize) -> Lanes<S> {
        Lanes::<S>::from_slice(simd, &self.0[k..k + Lanes::<S>::LEN])
    }

    #[inline(always)]
    pub(super) fn part<S: Simd>(&mut self, k: usize) -> &mut [f64] {
        &mut self.0[k..k + Lanes::<S>::LEN]
    }
}

/// The noise of a plan.
pub(super) struct Tables {
    pub(super) improved: Vec<Improved>,
    pub(super) classic: Noise,
}

/// Registers, and the lines of them that are computed.
struct File<'a> {
    registers: &'a mut [Vec<Line>],
    lines: Range<usize>,
}

impl File<'_> {
    #[inline(always)]
    fn get(&self, register: Register) -> &[Line] {
        &self.registers[register as usize][self.lines.clone()]
    }

    /// Takes a register out, to be written while others are read.
    #[inline(always)]
    fn take(&mut self, register: Register) -> Vec<Line> {
        std::mem::take(&mut self.registers[register as usize])
    }

    #[inline(always)]
    fn put(&mut self, register: Register, lines: Vec<Line>) {
        self.registers[register as usize] = lines;
    }
}

/// Runs operations on the first `lines` lines.
pub(super) fn run(level: Level, tables: &Tables, ops: &[Op], registers: &mut [Vec<Line>], lines: usize) {
    run_between(level, tables, ops, &mut File { registers, lines: 0..lines });
}

fn run_between(level: Level, tables: &Tables, ops: &[Op], file: &mut File<'_>) {
    dispatch!(level, simd => run_in_lanes(simd, tables, ops, file));
}

#[inline(always)]
fn run_in_lanes<S: Simd>(simd: S, tables: &Tables, ops: &[Op], file: &mut File<'_>) {
    for op in ops {
        match op {
            Op::Copy { a, out } => {
                let mut result = file.take(*out);
                let to = &mut result[file.lines.clone()];
                match a {
                    Operand::Constant(v) => to.fill(Line([*v; MAX_LANES])),
                    Operand::Register(a) => to.copy_from_slice(file.get(*a)),
                }
                file.put(*out, result);
            }
            Op::Unary { f, a, out } => {
                let mut result = file.take(*out);
                unary(simd, *f, file.get(*a), &mut result[file.lines.clone()]);
                file.put(*out, result);
            }
            Op::Binary { f, a, b, out } => {
                let mut result = file.take(*out);
                binary(simd, *f, file, [*a, *b], &mut result[file.lines.clone()]);
                file.put(*out, result);
            }
            Op::MulAdd { a, b, c, out } => {
                let mut result = file.take(*out);
                ternary(simd, each::MulAdd, file, *a, [*b, *c], &mut result[file.lines.clone()]);
                file.put(*out, result);
            }
            Op::Select { condition, a, b, out } => {
                let mut result = file.take(*out);
                ternary(simd, each::Choose, file, *condition, [*a, *b], &mut result[file.lines.clone()]);
                file.put(*out, result);
            }
            Op::Noise(noise) => {
                let mut result = file.take(noise.out);
                sum_of_noise(simd, tables, noise, file, &mut result[file.lines.clone()]);
                file.put(noise.out, result);
            }
            Op::Cells { seed, p, out } => cellular(simd, *seed, *p, out, file),
            Op::Image { image, at, out } => look_up(image, *at, out, file),
            Op::Loop(body) => repeat(simd.level(), tables, body, file),
        }
    }
}

#[inline(always)]
fn unary<S: Simd>(simd: S, f: Unary, a: &[Line], out: &mut [Line]) {
    match f {
        Unary::Neg => each1(simd, each::Neg, a, out),
        Unary::Abs => each1(simd, each::Abs, a, out),
        Unary::Floor => each1(simd, each::Floor, a, out),
        Unary::Ceil => each1(simd, each::Ceil, a, out),
        Unary::Round => each1(simd, each::Round, a, out),
        Unary::Sqrt => each1(simd, each::Sqrt, a, out),
        Unary::Sin => each1(simd, each::Sin, a, out),
        Unary::Cos => each1(simd, each::Cos, a, out),
        Unary::Not => each1(simd, each::Not, a, out),
        Unary::Tan => one_by_one(libm::tan, a, out),
        Unary::Asin => one_by_one(libm::asin, a, out),
        Unary::Acos => one_by_one(libm::acos, a, out),
        Unary::Atan => one_by_one(libm::atan, a, out),
        Unary::Exp => one_by_one(libm::exp, a, out),
        Unary::Ln => one_by_one(libm::log, a, out),
    }
}

#[inline(always)]
fn binary<S: Simd>(simd: S, f: Binary, file: &File<'_>, of: [Operand; 2], out: &mut [Line]) {
    match f {
        Binary::Add => two(simd, each::Add, file, of, out),
        Binary::Sub => two(simd, each::Sub, file, of, out),
        Binary::Mul => two(simd, each::Mul, file, of, out),
        Binary::Div => two(simd, each::Div, file, of, out),
        Binary::Modulo => two(simd, each::Modulo, file, of, out),
        Binary::Min => two(simd, each::Min, file, of, out),
        Binary::Max => two(simd, each::Max, file, of, out),
        Binary::Less => two(simd, each::Less, file, of, out),
        Binary::LessEqual => two(simd, each::LessEqual, file, of, out),
        Binary::Equal => two(simd, each::Equal, file, of, out),
        Binary::And => two(simd, each::And, file, of, out),
        Binary::Or => two(simd, each::Or, file, of, out),
        Binary::Pow => match of {
            [Operand::Register(a), Operand::Constant(exponent)] => {
                each1(simd, Power(exponent), file.get(a), out);
            }
            _ => pair_by_pair(f, file, of, out),
        },
        Binary::Atan2 | Binary::Random => pair_by_pair(f, file, of, out),
    }
}

#[inline(always)]
fn two<S: Simd, F: Two>(simd: S, f: F, file: &File<'_>, [a, b]: [Operand; 2], out: &mut [Line]) {
    match (a, b) {
        (Operand::Register(a), Operand::Register(b)) => each2(simd, f, file.get(a), file.get(b), out),
        (Operand::Register(a), Operand::Constant(b)) => each1(simd, Right(f, b), file.get(a), out),
        (Operand::Constant(a), Operand::Register(b)) => each1(simd, Left(f, a), file.get(b), out),
        // Lowering folds it.
        (Operand::Constant(_), Operand::Constant(_)) => {}
    }
}

#[inline(always)]
fn ternary<S: Simd, F: Three>(
    simd: S,
    f: F,
    file: &File<'_>,
    a: Register,
    [b, c]: [Operand; 2],
    out: &mut [Line],
) {
    let a = file.get(a);
    match (b, c) {
        (Operand::Register(b), Operand::Register(c)) => each3(simd, f, a, file.get(b), file.get(c), out),
        (Operand::Register(b), Operand::Constant(c)) => each2(simd, Third(f, c), a, file.get(b), out),
        (Operand::Constant(b), Operand::Register(c)) => each2(simd, Second(f, b), a, file.get(c), out),
        (Operand::Constant(b), Operand::Constant(c)) => each1(simd, Right(Third(f, c), b), a, out),
    }
}

/// A function of `libm`, point by point.
fn one_by_one(f: fn(f64) -> f64, a: &[Line], out: &mut [Line]) {
    for (a, out) in a.iter().zip(out) {
        for (a, out) in a.0.iter().zip(&mut out.0) {
            *out = f(*a);
        }
    }
}

/// A function of two numbers, point by point.
fn pair_by_pair(f: Binary, file: &File<'_>, [a, b]: [Operand; 2], out: &mut [Line]) {
    let at = |operand: Operand, line: usize| match operand {
        Operand::Register(register) => file.get(register)[line],
        Operand::Constant(v) => Line([v; MAX_LANES]),
    };
    for (line, out) in out.iter_mut().enumerate() {
        let (a, b) = (at(a, line), at(b, line));
        for (out, (a, b)) in out.0.iter_mut().zip(a.0.iter().zip(&b.0)) {
            *out = f.apply(*a, *b);
        }
    }
}

#[inline(always)]
fn point<S: Simd>(simd: S, [x, y, z]: [&[Line]; 3], line: usize, k: usize) -> Vec3<S> {
    Vec3 { x: x[line].load(simd, k), y: y[line].load(simd, k), z: z[line].load(simd, k) }
}

#[inline(always)]
fn sum_of_noise<S: Simd>(simd: S, tables: &Tables, noise: &NoiseOp, file: &File<'_>, out: &mut [Line]) {
    let p = [file.get(noise.p[0]), file.get(noise.p[1]), file.get(noise.p[2])];
    let improved = tables.improved.get(noise.table);
    for (line, out) in out.iter_mut().enumerate() {
        let mut k = 0;
        while k < MAX_LANES {
            let at = point(simd, p, line, k);
            let sum = match noise.sum {
                None => None,
                Some(Operand::Constant(v)) => Some(Lanes::<S>::splat(simd, v)),
                Some(Operand::Register(register)) => Some(file.get(register)[line].load(simd, k)),
            };
            let total = match (noise.kind, improved) {
                (NoiseKind::Improved, Some(table)) => sum_of_improved(simd, table, noise, at, sum),
                _ => sum_of_classic(simd, &tables.classic, noise, at, sum),
            };
            total.store_slice(out.part::<S>(k));
            k += Lanes::<S>::LEN;
        }
    }
}

#[inline(always)]
fn sum_of_improved<S: Simd>(
    simd: S,
    table: &Improved,
    noise: &NoiseOp,
    p: Vec3<S>,
    mut sum: Option<Lanes<S>>,
) -> Lanes<S> {
    for term in &noise.terms {
        let n = table.noise(simd, p.scale(Lanes::<S>::splat(simd, term.scale)));
        sum = Some(plus::<S>(sum, n, noise.absolute, term.weight));
    }
    sum.unwrap_or(Lanes::<S>::splat(simd, 0.0))
}

#[inline(always)]
fn sum_of_classic<S: Simd>(
    simd: S,
    table: &Noise,
    noise: &NoiseOp,
    p: Vec3<S>,
    mut sum: Option<Lanes<S>>,
) -> Lanes<S> {
    if !Noise::are_ordinary::<S>(p, noise.largest) {
        return one_by_one_classic(simd, table, noise, p, sum);
    }
    for term in &noise.terms {
        let n = table.ordinary(simd, noise.table, p.scale(Lanes::<S>::splat(simd, term.scale)));
        sum = Some(plus::<S>(sum, n, noise.absolute, term.weight));
    }
    sum.unwrap_or(Lanes::<S>::splat(simd, 0.0))
}

/// One more term of a sum, which may be the first.
#[inline(always)]
fn plus<S: Simd>(sum: Option<Lanes<S>>, n: Lanes<S>, absolute: bool, weight: f64) -> Lanes<S> {
    let term = (if absolute { n.abs() } else { n }) * weight;
    match sum {
        None => term,
        Some(sum) => sum + term,
    }
}

#[inline(always)]
fn one_by_one_classic<S: Simd>(
    simd: S,
    table: &Noise,
    noise: &NoiseOp,
    p: Vec3<S>,
    sum: Option<Lanes<S>>,
) -> Lanes<S> {
    let mut result = [0.0; MAX_LANES];
    for lane in 0..Lanes::<S>::LEN {
        let sum = sum.map(|sum| sum[lane]);
        result[lane] = one_sum_of_classic(table, noise, [p.x[lane], p.y[lane], p.z[lane]], sum);
    }
    Lanes::<S>::from_slice(simd, &result[..Lanes::<S>::LEN])
}

/// The sum at one point, whose coordinates lanes cannot take.
#[cold]
#[inline(never)]
fn one_sum_of_classic(table: &Noise, noise: &NoiseOp, p: [f64; 3], mut sum: Option<f64>) -> f64 {
    for Term { scale, weight } in &noise.terms {
        let n = table.at(noise.table, p.map(|v| v * scale));
        let term = (if noise.absolute { n.abs() } else { n }) * weight;
        sum = Some(sum.map_or(term, |sum| sum + term));
    }
    sum.unwrap_or(0.0)
}

#[inline(always)]
fn cellular<S: Simd>(simd: S, seed: u64, p: [Register; 3], out: &[Option<Register>], file: &mut File<'_>) {
    for line in file.lines.clone() {
        let mut k = 0;
        while k < MAX_LANES {
            let at = Vec3::<S> {
                x: file.registers[p[0] as usize][line].load(simd, k),
                y: file.registers[p[1] as usize][line].load(simd, k),
                z: file.registers[p[2] as usize][line].load(simd, k),
            };
            let results = cells(simd, seed, at);
            for (register, result) in out.iter().zip(results) {
                if let Some(register) = register {
                    result.store_slice(file.registers[*register as usize][line].part::<S>(k));
                }
            }
            k += Lanes::<S>::LEN;
        }
    }
}

fn look_up(image: &Image, [u, v]: [Register; 2], out: &[Option<Register>], file: &mut File<'_>) {
    for line in file.lines.clone() {
        let (u, v) = (file.registers[u as usize][line], file.registers[v as usize][line]);
        for lane in 0..MAX_LANES {
            let color = image.sample(u.0[lane], v.0[lane]);
            for (register, value) in out.iter().zip(color) {
                if let Some(register) = register {
                    file.registers[*register as usize][line].0[lane] = value;
                }
            }
        }
    }
}

/// Repeats the body while any point goes on. The lines computed shrink to those between the first and the last that
/// do.
fn repeat(level: Level, tables: &Tables, body: &LoopOp, file: &mut File<'_>) {
    let all = file.lines.clone();
    for (state, initial) in body.state.iter().zip(&body.initial) {
        let mut to = file.take(*state);
        match initial {
            Operand::Constant(v) => to[all.clone()].fill(Line([*v; MAX_LANES])),
            Operand::Register(from) => to[all.clone()].copy_from_slice(file.get(*from)),
        }
        file.put(*state, to);
    }
    file.registers[body.active as usize][all.clone()].fill(Line([1.0; MAX_LANES]));
    for _ in 0..body.max {
        run_between(level, tables, &body.check, file);
        dispatch!(level, simd => stop(simd, body, file));
        if file.lines.is_empty() {
            break;
        }
        run_between(level, tables, &body.body, file);
        dispatch!(level, simd => step(simd, body, file));
    }
    file.lines = all;
}

/// Marks the points that are done.
#[inline(always)]
fn stop<S: Simd>(simd: S, body: &LoopOp, file: &mut File<'_>) {
    let zero = Lanes::<S>::splat(simd, 0.0);
    let mut active = file.take(body.active);
    let (mut first, mut end) = (file.lines.end, file.lines.start);
    for line in file.lines.clone() {
        let mut k = 0;
        let mut any = false;
        while k < MAX_LANES {
            let until = match body.until {
                Operand::Constant(v) => Lanes::<S>::splat(simd, v),
                Operand::Register(register) => file.registers[register as usize][line].load(simd, k),
            };
            let on: Lanes<S> = until.simd_eq(0.0).select(active[line].load(simd, k), zero);
            let on_mask: Mask<S> = on.simd_eq(1.0);
            any |= on_mask.any_true();
            on.store_slice(active[line].part::<S>(k));
            k += Lanes::<S>::LEN;
        }
        if any {
            first = first.min(line);
            end = line + 1;
        }
    }
    file.lines = first..end.max(first);
    file.put(body.active, active);
}

/// Replaces the state of the points that go on.
#[inline(always)]
fn step<S: Simd>(simd: S, body: &LoopOp, file: &mut File<'_>) {
    for (state, step) in body.state.iter().zip(&body.step) {
        if *step == Operand::Register(*state) {
            continue;
        }
        let mut to = file.take(*state);
        for line in file.lines.clone() {
            let mut k = 0;
            while k < MAX_LANES {
                let new = match step {
                    Operand::Constant(v) => Lanes::<S>::splat(simd, *v),
                    Operand::Register(register) => file.registers[*register as usize][line].load(simd, k),
                };
                let active = file.registers[body.active as usize][line].load(simd, k);
                let old = to[line].load(simd, k);
                active.simd_eq(1.0).select(new, old).store_slice(to[line].part::<S>(k));
                k += Lanes::<S>::LEN;
            }
        }
        file.put(*state, to);
    }
}
