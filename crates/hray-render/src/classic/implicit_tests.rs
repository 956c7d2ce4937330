//! Implicit surfaces against what is plainly true of them.

use super::crossings::Crossing;
use super::implicit::{PreparedImplicit, Scratch};
use super::round::Spot;
use super::solid::Ray;
use fearless_simd::{Level, dispatch};
use hray_bvh::Stack;
use hray_core::{DVec3, Function, Implicit, NoiseTables};
use hray_expr::{Binary, Builder, Input, NodeId, NoiseKind, Unary};
use proptest::prelude::*;
use std::sync::Arc;

/// What a function is made of, after the three coordinates.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// The distance from a sphere.
    Ball,
    /// Four sheets and more.
    Tanglecube,
    /// A torus as a polynomial of the fourth degree.
    Ring,
    /// Two balls that flow into one.
    Blob,
    /// A ball with noise.
    Rough,
    /// Sheets without end.
    Gyroid,
    /// What is in one ball and not in another, with creases.
    Bitten,
    /// A sheet that is folded together: the function is never negative.
    Double,
}

const KINDS: [Kind; 8] = [
    Kind::Ball,
    Kind::Tanglecube,
    Kind::Ring,
    Kind::Blob,
    Kind::Rough,
    Kind::Gyroid,
    Kind::Bitten,
    Kind::Double,
];

struct Maker(Builder);

impl Maker {
    fn number(&mut self, v: f64) -> NodeId {
        self.0.constant(v).unwrap()
    }

    fn two(&mut self, f: Binary, a: NodeId, b: NodeId) -> NodeId {
        self.0.binary(f, a, b).unwrap()
    }

    fn times(&mut self, a: NodeId, by: f64) -> NodeId {
        let by = self.number(by);
        self.two(Binary::Mul, a, by)
    }

    fn plus(&mut self, a: NodeId, more: f64) -> NodeId {
        let more = self.number(more);
        self.two(Binary::Add, a, more)
    }

    fn squares(&mut self, p: [NodeId; 3]) -> NodeId {
        let [x, y, z] = p.map(|v| self.two(Binary::Mul, v, v));
        let sum = self.two(Binary::Add, x, y);
        self.two(Binary::Add, sum, z)
    }

    fn length(&mut self, p: [NodeId; 3]) -> NodeId {
        let squares = self.squares(p);
        self.0.unary(Unary::Sqrt, squares).unwrap()
    }

    fn moved(&mut self, p: [NodeId; 3], by: f64) -> [NodeId; 3] {
        let x = self.plus(p[0], by);
        [x, p[1], p[2]]
    }
}

/// A function of that kind about the origin, `size` times as large.
fn function(kind: Kind, size: f64, bend: f64) -> Arc<Function> {
    let mut m = Maker(Builder::new(10_000));
    let p = [Input::Px, Input::Py, Input::Pz].map(|input| m.0.input(input).unwrap());
    let p = p.map(|v| m.times(v, 1.0 / size));
    let value = match kind {
        Kind::Ball => {
            let length = m.length(p);
            m.plus(length, -1.0)
        }
        Kind::Tanglecube => {
            let terms = p.map(|v| {
                let v = m.times(v, 2.5);
                let square = m.two(Binary::Mul, v, v);
                let fourth = m.two(Binary::Mul, square, square);
                let fives = m.times(square, 5.0);
                m.two(Binary::Sub, fourth, fives)
            });
            let sum = m.two(Binary::Add, terms[0], terms[1]);
            let sum = m.two(Binary::Add, sum, terms[2]);
            m.plus(sum, 10.0 + 2.0 * bend)
        }
        Kind::Ring => {
            let squares = m.squares(p);
            let shifted = m.plus(squares, 1.0 - 0.09 - 0.1 * bend);
            let left = m.two(Binary::Mul, shifted, shifted);
            let (x, z) = (m.two(Binary::Mul, p[0], p[0]), m.two(Binary::Mul, p[2], p[2]));
            let flat = m.two(Binary::Add, x, z);
            let right = m.times(flat, 4.0);
            m.two(Binary::Sub, left, right)
        }
        Kind::Blob => {
            let parts = [-0.5, 0.3 + bend].map(|by| {
                let moved = m.moved(p, by);
                let squares = m.squares(moved);
                let one = m.number(0.2);
                m.two(Binary::Div, one, squares)
            });
            let sum = m.two(Binary::Add, parts[0], parts[1]);
            let one = m.number(1.0);
            m.two(Binary::Sub, one, sum)
        }
        Kind::Rough => {
            let length = m.length(p);
            let q = p.map(|v| m.times(v, 3.0));
            let noise = m.0.noise(NoiseKind::Improved, 3, q).unwrap();
            let noise = m.times(noise, 0.1 + 0.3 * bend);
            let ball = m.plus(length, -1.0);
            m.two(Binary::Add, ball, noise)
        }
        Kind::Gyroid => {
            let q = p.map(|v| m.times(v, 4.0));
            let sine = q.map(|v| m.0.unary(Unary::Sin, v).unwrap());
            let cosine = q.map(|v| m.0.unary(Unary::Cos, v).unwrap());
            let terms: Vec<NodeId> =
                (0..3).map(|i| m.two(Binary::Mul, sine[i], cosine[(i + 1) % 3])).collect();
            let sum = m.two(Binary::Add, terms[0], terms[1]);
            let sum = m.two(Binary::Add, sum, terms[2]);
            m.plus(sum, bend - 0.5)
        }
        Kind::Bitten => {
            let length = m.length(p);
            let ball = m.plus(length, -1.0);
            let moved = m.moved(p, 0.4 + bend);
            let other = m.length(moved);
            let other = m.plus(other, -0.7);
            let other = m.0.unary(Unary::Neg, other).unwrap();
            m.two(Binary::Max, ball, other)
        }
        Kind::Double => {
            let length = m.length(p);
            let ball = m.plus(length, -1.0);
            m.two(Binary::Mul, ball, ball)
        }
    };
    Arc::new(m.0.finish(&[value]))
}

struct Surface {
    kind: Kind,
    size: f64,
    min: DVec3,
    max: DVec3,
    function: Arc<Function>,
    tables: NoiseTables,
    prepared: PreparedImplicit,
}

impl std::fmt::Debug for Surface {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?} of {} in {} to {}", self.kind, self.size, self.min, self.max)
    }
}

impl Surface {
    fn new(kind: Kind, size: f64, bend: f64, [min, max]: [DVec3; 2]) -> Self {
        let function = function(kind, size, bend);
        let tables = NoiseTables::default();
        let implicit = Implicit { function: function.clone(), min, max };
        // Few cells: they are made for every case.
        let prepared = PreparedImplicit::new(Arc::new(implicit), 6, &tables);
        Self { kind, size, min, max, function, tables, prepared }
    }

    fn value(&self, p: DVec3) -> f64 {
        let mut inputs = [0.0; Input::COUNT];
        inputs[..3].copy_from_slice(&p.to_array());
        self.function.evaluate(&self.tables, &inputs)[0]
    }

    fn is_in_box(&self, p: DVec3) -> bool {
        p.cmpge(self.min).all() && p.cmple(self.max).all()
    }

    fn is_inside(&self, p: DVec3) -> bool {
        self.is_in_box(p) && self.value(p) < 0.0
    }

    /// How far from the surface a point is, about: by the value and how it changes.
    fn off(&self, p: DVec3) -> f64 {
        let h = 1e-6 * self.size;
        let slope = DVec3::from(
            DVec3::AXES.map(|axis| (self.value(p + axis * h) - self.value(p - axis * h)) / (2.0 * h)),
        );
        let off = self.value(p).abs() / slope.length();
        let to_face = (p - self.min).abs().min((p - self.max).abs()).min_element();
        if off.is_nan() { to_face } else { off.min(to_face) }
    }

    fn hit(&self, ray: &Ray, near: f64) -> Option<f64> {
        let (stack, scratch) = (&mut Stack::default(), &mut Scratch::default());
        dispatch!(Level::new(), simd => self.prepared.hit(simd, ray, [near, f64::INFINITY], stack, scratch))
    }

    fn crossings(&self, ray: &Ray) -> (bool, Vec<Crossing>) {
        let (stack, scratch) = (&mut Stack::default(), &mut Scratch::default());
        let mut all = Vec::new();
        let starts_inside = dispatch!(Level::new(), simd => self.prepared.crossings(simd, ray, 0.0, stack, scratch, &mut all));
        (starts_inside, all)
    }

    fn spot(&self, ray: &Ray, distance: f64) -> Spot {
        self.prepared.spot(ray, distance, &mut Scratch::default())
    }
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from_array)
}

fn direction() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        5 => vector(1.0).prop_filter("long enough", |v| v.length() > 0.1).prop_map(DVec3::normalize),
        1 => prop_oneof![Just(DVec3::X), Just(DVec3::NEG_Y), Just(DVec3::Z)],
    ]
}

prop_compose! {
    fn surface()(
        kind in 0..KINDS.len(), bend in 0.0..0.5f64, cut in vector(1.0), is_cut in any::<bool>(),
        size in prop_oneof![4 => Just(1.0), 1 => Just(1e-6), 1 => Just(1e9)],
    ) -> Surface {
        let far = DVec3::splat(1.7);
        let [min, max] = if is_cut { [-far + 0.4 * (cut + 1.0), far - 0.3 * (cut + 1.0)] } else { [-far, far] };
        Surface::new(KINDS[kind], size, bend, [min * size, max * size])
    }
}

/// The least distance at which a ray goes in or out, by small steps and halves.
fn slowly(surface: &Surface, ray: &Ray, far: f64) -> Option<f64> {
    const STEPS: usize = 1500;
    let at = |t: f64| surface.is_inside(ray.origin + ray.direction * t);
    let step = far / STEPS as f64;
    let mut before = at(0.0);
    let start = (0..STEPS).find(|i| {
        let after = at((i + 1) as f64 * step);
        std::mem::replace(&mut before, after) != after
    })?;
    let (mut low, mut high) = (start as f64 * step, (start + 1) as f64 * step);
    let before = at(low);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if at(middle) == before { low = middle } else { high = middle }
    }
    Some(high)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(256), ..ProptestConfig::default() })]

    #[test]
    fn the_first_hit_is_the_one_that_small_steps_find(
        surface in surface(), origin in vector(4.0), target in vector(1.7), length in 0.01..100.0f64,
    ) {
        prop_assume!(origin.distance(target) > 0.1);
        let ray = Ray { origin: origin * surface.size, direction: (target - origin).normalize() * length * surface.size };
        let found = surface.hit(&ray, 0.0);
        let slow = slowly(&surface, &ray, 12.0 / length);
        let at = |t: f64| ray.origin + ray.direction * t;
        if let Some(found) = found {
            let p = at(found);
            prop_assert!(surface.off(p) < 1e-6 * surface.size, "{found}: off by {}", surface.off(p));
            let grown = 1e-9 * surface.size;
            prop_assert!(p.cmpge(surface.min - grown).all() && p.cmple(surface.max + grown).all());
        }
        match (found, slow) {
            (None, Some(slow)) => prop_assert!(false, "missed at {slow}"),
            (Some(found), Some(slow)) => prop_assert!((found - slow) * length < 1e-7, "{found} after {slow}"),
            // What steps miss, or only touch.
            (_, None) => {}
        }
    }

    #[test]
    fn between_crossings_a_ray_stays_on_one_side(
        surface in surface(), origin in vector(4.0), target in vector(1.7), length in 0.1..10.0f64,
        places in prop::collection::vec(0.001..0.999f64, 4),
    ) {
        prop_assume!(origin.distance(target) > 0.1);
        let ray = Ray { origin: origin * surface.size, direction: (target - origin).normalize() * length * surface.size };
        let (mut is_inside, all) = surface.crossings(&ray);
        prop_assert_eq!(is_inside, surface.is_inside(ray.origin));
        let mut from = 0.0;
        for crossing in &all {
            prop_assert!(crossing.at >= from && crossing.at > 0.0, "{all:?}");
            prop_assert_eq!(crossing.turns != 0, !is_inside, "{:?}", all);
            for place in &places {
                let p = ray.origin + ray.direction * (from + (crossing.at - from) * place);
                if surface.off(p) > 1e-8 * surface.size {
                    prop_assert_eq!(surface.is_inside(p), is_inside, "at {} of {:?}", p, all);
                }
            }
            (from, is_inside) = (crossing.at, !is_inside);
        }
        for place in &places {
            let p = ray.origin + ray.direction * (from + place * 12.0 / length);
            if surface.off(p) > 1e-8 * surface.size {
                prop_assert_eq!(surface.is_inside(p), is_inside, "at {} of {:?}", p, all);
            }
        }
    }

    /// A ray that starts at a hit, at its distance from the surface, does not meet the same spot again.
    #[test]
    fn what_leaves_the_surface_does_not_meet_it_there(
        surface in surface(), origin in vector(4.0), target in vector(1.7), away in direction(), grazing in 0.0..1.0f64,
    ) {
        prop_assume!(origin.distance(target) > 0.1);
        let ray = Ray { origin: origin * surface.size, direction: (target - origin).normalize() };
        if let Some(distance) = surface.hit(&ray, 0.0) {
            let spot = surface.spot(&ray, distance);
            prop_assert!((spot.normal.length() - 1.0).abs() < 1e-12);
            prop_assert!(spot.bound < 1e-4 * surface.size, "{}", spot.bound);
            for side in [1.0, -1.0] {
                let flat = (away - spot.normal * away.dot(spot.normal)).normalize_or(DVec3::ZERO);
                let tilt = spot.normal * side * (0.02 + grazing);
                let start = spot.point + spot.normal * (side * spot.bound);
                let leaving = Ray { origin: start, direction: (flat + tilt).normalize() };
                if let Some(again) = surface.hit(&leaving, 0.0) {
                    // Near a crease, or where the surface is bent that much, it may be met soon; not from where one was.
                    let is_elsewhere = again > 1e-6 * surface.size
                        || surface.is_inside(start) != surface.is_inside(start + leaving.direction * again * 2.0);
                    prop_assert!(is_elsewhere, "again after {again}");
                }
            }
        }
    }

    /// Everything 2^k times as large: the same hit to the bit.
    #[test]
    fn powers_of_two_change_nothing(
        kind in 0..KINDS.len(), bend in 0.0..0.5f64, origin in vector(4.0), target in vector(1.7), k in -40..40,
    ) {
        prop_assume!(origin.distance(target) > 0.1);
        let factor = libm::exp2(f64::from(k));
        let hits = [1.0, factor].map(|size| {
            let surface = Surface::new(KINDS[kind], size, bend, [DVec3::splat(-1.7 * size), DVec3::splat(1.7 * size)]);
            surface.hit(&Ray { origin: origin * size, direction: (target - origin) * size }, 0.0)
        });
        prop_assert_eq!(hits[0], hits[1]);
    }
}

#[test]
fn plain_cases() {
    let cube = [DVec3::splat(-2.0), DVec3::splat(2.0)];
    let ray =
        |origin: [f64; 3], direction: [f64; 3]| Ray { origin: origin.into(), direction: direction.into() };
    let close = |found: Option<f64>, expected: f64| {
        assert!(found.is_some_and(|found| (found - expected).abs() < 1e-12), "{found:?} for {expected}");
    };
    let ball = Surface::new(Kind::Ball, 1.0, 0.0, cube);
    close(ball.hit(&ray([0.0, 0.0, 5.0], [0.0, 0.0, -1.0]), 0.0), 4.0);
    close(ball.hit(&ray([0.0, 0.0, 5.0], [0.0, 0.0, -0.5]), 8.0), 12.0);
    close(ball.hit(&ray([0.0, 0.0, 0.0], [0.0, 1.0, 0.0]), 0.0), 1.0);
    assert_eq!(ball.hit(&ray([0.0, 1.0 + 1e-9, 5.0], [0.0, 0.0, -1.0]), 0.0), None);
    let spot = ball.spot(&ray([0.6, 0.0, 5.0], [0.0, 0.0, -1.0]), 4.2);
    assert!((spot.normal - DVec3::new(0.6, 0.0, 0.8)).length() < 1e-14);
    // From so far away that the distance is known to some ten thousandths only.
    let far = ray([0.0, 0.0, 1e12], [0.0, 0.0, -1.0]);
    let spot = ball.spot(&far, ball.hit(&far, 0.0).unwrap());
    assert!((spot.point - DVec3::Z).length() < 1e-14, "{spot:?}");
    // A box that cuts it in half closes it.
    let half = Surface::new(Kind::Ball, 1.0, 0.0, [DVec3::splat(-2.0), DVec3::new(2.0, 0.0, 2.0)]);
    let down = ray([0.25, 5.0, 0.0], [0.0, -1.0, 0.0]);
    assert_eq!(half.hit(&down, 0.0), Some(5.0));
    let spot = half.spot(&down, 5.0);
    assert_eq!((spot.point, spot.normal), (DVec3::new(0.25, 0.0, 0.0), DVec3::Y));
    assert_eq!(half.hit(&ray([0.25, -0.5, 0.0], [0.0, 1.0, 0.0]), 0.0), Some(0.5));
    let (starts_inside, all) = half.crossings(&ray([0.0, -5.0, 0.0], [0.0, 1.0, 0.0]));
    assert!(!starts_inside && all.len() == 2 && all[1].at == 5.0, "{all:?}");
    // What is never negative is seen nevertheless.
    let double = Surface::new(Kind::Double, 1.0, 0.0, cube);
    let found = double.hit(&ray([0.0, 0.0, 5.0], [0.0, 0.0, -1.0]), 0.0).unwrap();
    assert!((found - 4.0).abs() < 1e-8, "{found}");
}

/// Whatever vectors the machine has, the same hits to the bit.
#[test]
fn vectors_of_any_width_find_the_same() {
    let levels = [Some(Level::new()), Level::new().as_avx2().map(Level::Avx2), Some(Level::baseline())];
    for kind in KINDS {
        let implicit = Arc::new(Implicit {
            function: function(kind, 1.0, 0.2),
            min: DVec3::splat(-1.7),
            max: DVec3::splat(1.7),
        });
        let mut hits: Vec<Vec<Option<f64>>> = Vec::new();
        for level in levels.iter().flatten() {
            let prepared = PreparedImplicit::with_level(*level, implicit.clone(), 2, &NoiseTables::default());
            let (stack, scratch) = (&mut Stack::default(), &mut Scratch::default());
            let mut hit = |i: i32| {
                let (x, y) = (f64::from(i % 32) / 16.0 - 1.0, f64::from(i / 32) / 16.0 - 1.0);
                let ray = Ray { origin: DVec3::new(x, y, 5.0), direction: DVec3::new(x * 0.1, 0.01, -1.0) };
                dispatch!(*level, simd => prepared.hit(simd, &ray, [0.0, f64::INFINITY], stack, scratch))
            };
            hits.push((0..1024).map(&mut hit).collect());
        }
        assert!(hits[0].iter().flatten().count() > 200, "{kind:?}");
        for other in &hits[1..] {
            let different = hits[0].iter().zip(other).filter(|(a, b)| a != b).count();
            assert_eq!(different, 0, "{kind:?}");
        }
    }
}
