//! What a compiled function costs beside the same function written in Rust.
//!
//! `cargo bench -p hray-expr`

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use hray_expr::kernels::improved::Improved;
use hray_expr::kernels::lanes::{Lanes, Vec3};
use hray_expr::kernels::noise::{Noise, Sum};
use hray_expr::kernels::sine::sine;
use hray_expr::{Binary, Block, Builder, Function, GraphTooLarge, Input, NodeId, NoiseKind, NoiseTables};
use hray_expr::{Plan, PlanScratch, Unary};
use std::hint::black_box;

/// Points of a row, over 4 units.
const ACROSS: usize = 512;
const POINTS: usize = 4 * ACROSS;

/// Points on a plane, row by row.
fn rows() -> [Vec<f64>; 3] {
    let step = 4.0 / ACROSS as f64;
    let x = (0..POINTS).map(|i| (i % ACROSS) as f64 * step - 1.7);
    let z = (0..POINTS).map(|i| (i / ACROSS) as f64 * step + 0.3);
    [x.collect(), vec![0.41; POINTS], z.collect()]
}

/// The same points in random order.
fn shuffled() -> [Vec<f64>; 3] {
    let mut points = rows();
    for i in (1..POINTS).rev() {
        let j = (hray_expr::random(1.0, i as f64) * (i + 1) as f64) as usize;
        points.iter_mut().for_each(|column| column.swap(i, j));
    }
    points
}

type Made<T> = Result<T, GraphTooLarge>;

fn position(b: &mut Builder) -> Made<[NodeId; 3]> {
    Ok([b.input(Input::Px)?, b.input(Input::Py)?, b.input(Input::Pz)?])
}

/// The sum of |noise (2^k q)| / 2^k for k < n.
fn turbulence(b: &mut Builder, kind: NoiseKind, n: i32, q: [NodeId; 3]) -> Made<NodeId> {
    let mut sum = b.constant(0.0)?;
    for k in 0..n {
        let scale = b.constant(f64::from(1 << k))?;
        let mut p = q;
        for a in &mut p {
            *a = b.binary(Binary::Mul, *a, scale)?;
        }
        let noise = b.noise(kind, 0, p)?;
        let noise = b.unary(Unary::Abs, noise)?;
        let term = b.binary(Binary::Div, noise, scale)?;
        sum = b.binary(Binary::Add, sum, term)?;
    }
    Ok(sum)
}

const WHITE: [f64; 3] = [1.0, 1.0, 1.0];
const BLUE: [f64; 3] = [0.0123, 0.0467, 0.0999];
const SIZE: f64 = 0.35;

/// `mix white blue (sin (4 q.x + 6 turbulence 8 q) / 2 + 0.5)` where q is p / size.
fn veined() -> Made<Function> {
    let mut b = Builder::new(1000);
    let mut q = position(&mut b)?;
    let size = b.constant(SIZE)?;
    for a in &mut q {
        *a = b.binary(Binary::Div, *a, size)?;
    }
    let turbulence = turbulence(&mut b, NoiseKind::Improved, 8, q)?;
    let [half, two, four, six] = [b.constant(0.5)?, b.constant(2.0)?, b.constant(4.0)?, b.constant(6.0)?];
    let across = b.binary(Binary::Mul, q[0], four)?;
    let wave = b.binary(Binary::Mul, six, turbulence)?;
    let angle = b.binary(Binary::Add, across, wave)?;
    let vein = b.unary(Unary::Sin, angle)?;
    let vein = b.binary(Binary::Div, vein, two)?;
    let t = b.binary(Binary::Add, vein, half)?;
    let mut outputs = Vec::new();
    for (from, to) in WHITE.into_iter().zip(BLUE) {
        let (from, to) = (b.constant(from)?, b.constant(to)?);
        let difference = b.binary(Binary::Sub, to, from)?;
        let part = b.binary(Binary::Mul, difference, t)?;
        outputs.push(b.binary(Binary::Add, from, part)?);
    }
    Ok(b.finish(&outputs))
}

/// The same in Rust, in lanes.
#[inline(always)]
fn veined_in_lanes<S: Simd>(simd: S, noise: &Improved, p: [&[f64]; 3], out: &mut [Vec<f64>; 3]) {
    for start in (0..POINTS).step_by(Lanes::<S>::LEN) {
        let p = Vec3::<S>::load(simd, p, start);
        let q = Vec3::<S> { x: p.x / SIZE, y: p.y / SIZE, z: p.z / SIZE };
        let mut sum = Lanes::<S>::splat(simd, 0.0);
        let (mut scale, mut weight) = (1.0, 1.0);
        for _ in 0..8 {
            sum += noise.noise(simd, q.scale(Lanes::<S>::splat(simd, scale))).abs() * weight;
            scale *= 2.0;
            weight *= 0.5;
        }
        let t = sine(simd, q.x * 4.0 + sum * 6.0) * 0.5 + 0.5;
        for (out, (from, to)) in out.iter_mut().zip(WHITE.into_iter().zip(BLUE)) {
            (t * (to - from) + from).store_slice(&mut out[start..start + Lanes::<S>::LEN]);
        }
    }
}

/// The same in Rust, one point at a time.
fn veined_one_by_one(permutation: &[u8; 512], p: &[Vec<f64>; 3], out: &mut [Vec<f64>; 3]) {
    for i in 0..POINTS {
        let q = [p[0][i] / SIZE, p[1][i] / SIZE, p[2][i] / SIZE];
        let mut sum = 0.0;
        let mut scale = 1.0;
        for _ in 0..8 {
            sum += perlin(permutation, [q[0] * scale, q[1] * scale, q[2] * scale]).abs() / scale;
            scale *= 2.0;
        }
        let t = libm::sin(q[0] * 4.0 + 6.0 * sum) / 2.0 + 0.5;
        for (out, (from, to)) in out.iter_mut().zip(WHITE.into_iter().zip(BLUE)) {
            out[i] = from + (to - from) * t;
        }
    }
}

/// Improved noise as one writes it for one point: the permutation twice, one after the other.
fn perlin(p: &[u8; 512], [x, y, z]: [f64; 3]) -> f64 {
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let lerp = |t: f64, a: f64, b: f64| a + t * (b - a);
    let (fx, fy, fz) = (x.floor(), y.floor(), z.floor());
    let [i, j, k] = [fx, fy, fz].map(|v| (v as i64 & 255) as usize);
    let (x, y, z) = (x - fx, y - fy, z - fz);
    let (u, v, w) = (fade(x), fade(y), fade(z));
    let at = |i: usize| usize::from(p[i & 511]);
    let (a, b) = (at(i) + j, at(i + 1) + j);
    let (aa, ab, ba, bb) = (at(a) + k, at(a + 1) + k, at(b) + k, at(b + 1) + k);
    let low = lerp(
        v,
        lerp(u, gradient(at(aa), x, y, z), gradient(at(ba), x - 1.0, y, z)),
        lerp(u, gradient(at(ab), x, y - 1.0, z), gradient(at(bb), x - 1.0, y - 1.0, z)),
    );
    let high = lerp(
        v,
        lerp(u, gradient(at(aa + 1), x, y, z - 1.0), gradient(at(ba + 1), x - 1.0, y, z - 1.0)),
        lerp(u, gradient(at(ab + 1), x, y - 1.0, z - 1.0), gradient(at(bb + 1), x - 1.0, y - 1.0, z - 1.0)),
    );
    lerp(w, low, high)
}

fn gradient(hash: usize, x: f64, y: f64, z: f64) -> f64 {
    let h = hash & 15;
    let u = if h < 8 { x } else { y };
    let v = if h < 4 {
        y
    } else if h == 12 || h == 14 {
        x
    } else {
        z
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

/// The permutation of improved noise: what the noise is made of matters little to its speed.
fn permutation() -> [u8; 512] {
    let table = NoiseTables::default().permutation(0);
    std::array::from_fn(|i| table[i & 255])
}

#[inline(always)]
fn octaves_of_all<S: Simd>(simd: S, noise: &Noise, octaves: u32, p: [&[f64]; 3], out: &mut [f64]) {
    for start in (0..POINTS).step_by(Lanes::<S>::LEN) {
        let p = Vec3::<S>::load(simd, p, start);
        let sum = noise.octaves(simd, 0, p, 1.0, octaves - 1, Sum::Absolute);
        sum.store_slice(&mut out[start..start + Lanes::<S>::LEN]);
    }
}

/// Runs a plan on points, again and again.
fn bench_plan(
    group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>,
    name: &str,
    function: &Function,
    points: &[Vec<f64>; 3],
) {
    let plan = Plan::new(function, &NoiseTables::default());
    let mut inputs: [&[f64]; Input::COUNT] = [&[]; Input::COUNT];
    for (input, column) in inputs.iter_mut().zip(points) {
        *input = column;
    }
    let mut outputs = vec![vec![0.0; POINTS]; function.outputs().len()];
    let mut scratch = PlanScratch::default();
    let level = Level::new();
    group.bench_function(name, |b| {
        b.iter(|| {
            let mut outputs: Vec<_> = outputs.iter_mut().map(Vec::as_mut_slice).collect();
            plan.evaluate(level, black_box(&inputs), POINTS, &mut scratch, &mut outputs);
        });
    });
}

fn bench_veined(c: &mut Criterion) {
    let Ok(function) = veined() else { return };
    let (noise, permutation) = (Improved::new(0), permutation());
    for (order, points) in [("rows", rows()), ("random order", shuffled())] {
        let mut group = c.benchmark_group(format!("veined, {order}"));
        group.throughput(Throughput::Elements(POINTS as u64));
        bench_plan(&mut group, "graph", &function, &points);
        let mut out = [vec![0.0; POINTS], vec![0.0; POINTS], vec![0.0; POINTS]];
        group.bench_function("Rust, in lanes", |b| {
            let level = Level::new();
            b.iter(|| {
                let p = black_box(&points).each_ref().map(Vec::as_slice);
                dispatch!(level, simd => veined_in_lanes(simd, &noise, p, &mut out));
            });
        });
        group.bench_function("Rust, one by one", |b| {
            b.iter(|| veined_one_by_one(&permutation, black_box(&points), &mut out));
        });
        group.finish();
    }
}

fn bench_turbulence(c: &mut Criterion) {
    let classic = Noise::new(&NoiseTables::default());
    for (order, points) in [("rows", rows()), ("random order", shuffled())] {
        let mut group = c.benchmark_group(format!("turbulence of 10 octaves, {order}"));
        group.throughput(Throughput::Elements(10 * POINTS as u64));
        for (name, kind) in [("graph, 2002", NoiseKind::Improved), ("graph, 1985", NoiseKind::Classic)] {
            let mut b = Builder::new(1000);
            let Ok(p) = position(&mut b) else { return };
            let Ok(sum) = turbulence(&mut b, kind, 10, p) else { return };
            bench_plan(&mut group, name, &b.finish(&[sum]), &points);
        }
        let mut out = vec![0.0; POINTS];
        group.bench_function("classic engine, 1985", |b| {
            let level = Level::new();
            b.iter(|| {
                let p = black_box(&points).each_ref().map(Vec::as_slice);
                dispatch!(level, simd => octaves_of_all(simd, &classic, 10, p, &mut out));
            });
        });
        group.finish();
    }
}

fn bench_cells(c: &mut Criterion) {
    let points = rows();
    let mut group = c.benchmark_group("cells");
    group.throughput(Throughput::Elements(POINTS as u64));
    let mut b = Builder::new(1000);
    let Ok(p) = position(&mut b) else { return };
    let Ok(results) = b.block(Block::Cells { seed: 0 }, &p) else { return };
    bench_plan(&mut group, "graph", &b.finish(&results[..2]), &points);
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(30);
    targets = bench_veined, bench_turbulence, bench_cells
}
criterion_main!(benches);
