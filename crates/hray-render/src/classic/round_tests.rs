//! Round shapes against what is plainly true of them.

use super::round::Round;
use super::solid::Ray;
use hray_core::{DVec3, Disc, Frustum, Quadric, Shape, Torus};
use proptest::prelude::*;
use std::sync::Arc;

fn round(shape: &Shape) -> Round {
    Round::new(shape).unwrap()
}

fn frustum(base: DVec3, top: DVec3, radii: [f64; 2], is_capped: bool) -> Shape {
    Shape::Frustum(Arc::new(Frustum { base, top, radii, is_capped }))
}

fn torus(center: DVec3, axis: DVec3, radius: f64, tube: f64) -> Shape {
    Shape::Torus(Arc::new(Torus { center, axis: axis.normalize(), radius, tube }))
}

fn quadric(square: DVec3, product: DVec3, linear: DVec3, constant: f64) -> Shape {
    Shape::Quadric(Arc::new(Quadric { square, product, linear, constant }))
}

fn disc(center: DVec3, normal: DVec3, radius: f64, hole: f64) -> Shape {
    Shape::Disc(Arc::new(Disc { center, normal: normal.normalize(), radius, hole }))
}

/// Negative inside; by the definition alone, about as large as the distance from the surface.
fn outside(shape: &Shape, p: DVec3) -> f64 {
    match shape {
        Shape::Frustum(frustum) => {
            let axis = frustum.top - frustum.base;
            let along = (p - frustum.base).dot(axis) / axis.length_squared();
            let [a, b] = frustum.radii;
            let distance = (p - frustum.base - axis * along).length();
            let side = distance - (a + (b - a) * along);
            side.max(-along * axis.length()).max((along - 1.0) * axis.length())
        }
        Shape::Torus(torus) => {
            let height = (p - torus.center).dot(torus.axis);
            let distance = (p - torus.center - torus.axis * height).length();
            libm::hypot(distance - torus.radius, height) - torus.tube
        }
        Shape::Quadric(quadric) => {
            let Quadric { square: s, product: q, linear: l, constant } = **quadric;
            let value =
                s.dot(p * p) + q.dot(DVec3::new(p.x * p.y, p.x * p.z, p.y * p.z)) + l.dot(p) + constant;
            let slope = DVec3::new(
                2.0 * s.x * p.x + q.x * p.y + q.y * p.z,
                2.0 * s.y * p.y + q.x * p.x + q.z * p.z,
                2.0 * s.z * p.z + q.y * p.x + q.z * p.y,
            );
            value / (slope + l).length().max(1e-300)
        }
        _ => unreachable!(),
    }
}

/// The least distance at which a ray goes in or out, found by small steps and halves.
fn slowly(shape: &Shape, ray: &Ray, far: f64) -> Option<f64> {
    const STEPS: usize = 4000;
    let at = |t: f64| outside(shape, ray.origin + ray.direction * t) < 0.0;
    let step = far / STEPS as f64;
    let start = (0..STEPS).find(|i| at(*i as f64 * step) != at((i + 1) as f64 * step))?;
    let (mut low, mut high) = (start as f64 * step, (start + 1) as f64 * step);
    let before = at(low);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if at(middle) == before { low = middle } else { high = middle }
    }
    Some(high)
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from_array)
}

fn direction() -> impl Strategy<Value = DVec3> {
    let axis = prop_oneof![
        Just(DVec3::X),
        Just(DVec3::Y),
        Just(DVec3::NEG_Y),
        Just(DVec3::Z),
        Just(DVec3::new(1e-9, 1.0, 0.0)),
    ];
    prop_oneof![
        4 => vector(1.0).prop_filter("long enough", |v| v.length() > 0.1).prop_map(DVec3::normalize),
        1 => axis.prop_map(DVec3::normalize),
    ]
}

prop_compose! {
    fn solid()(
        center in vector(3.0), axis in direction(), length in 0.05..4.0f64, a in 0.0..2.0f64, b in 0.0..2.0f64,
        kind in 0..6, thin in 0.01..0.99f64, product in vector(1.0),
    ) -> Shape {
        match kind {
            // Whatever comes, and an ellipsoid.
            4 => quadric(center / 3.0, product, axis, thin - 0.5),
            5 => quadric(center.abs() + 0.1, product * 0.1, axis, -length),
            0 => torus(center, axis, length, length * thin),
            1 => frustum(center, center + axis * length, [a.max(0.01); 2], true),
            2 => frustum(center, center + axis * length, [0.0, b.max(0.01)], true),
            _ => frustum(center, center + axis * length, [a, b.max(0.01)], true),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn the_first_hit_is_the_one_that_small_steps_find(
        shape in solid(), origin in vector(9.0), target in vector(3.0), length in 0.01..100.0f64,
    ) {
        let (from, to) = (origin, target);
        prop_assume!(from.distance(to) > 0.1);
        let ray = Ray { origin: from, direction: (to - from).normalize() * length };
        let found = round(&shape).hit(&ray, 0.0);
        let slow = slowly(&shape, &ray, 30.0 / length);
        match (found, slow) {
            (Some(found), Some(slow)) => {
                // What the steps missed is thinner than one of them.
                let skipped = found < slow && (found - slow).abs() * length > 1e-6;
                if skipped {
                    let inside = outside(&shape, ray.origin + ray.direction * found).abs();
                    prop_assert!(inside < 1e-6, "{found} {slow} {inside}");
                } else {
                    prop_assert!((found - slow).abs() * length < 1e-6, "{found} {slow}");
                }
            }
            (None, Some(slow)) => prop_assert!(false, "missed at {slow}"),
            (Some(found), None) => {
                let at = outside(&shape, ray.origin + ray.direction * found).abs();
                prop_assert!(at < 1e-7, "{at}");
            }
            (None, None) => {}
        }
    }

    #[test]
    fn all_stretches_inside_are_inside(shape in solid(), origin in vector(9.0), target in vector(3.0)) {
        prop_assume!(origin.distance(target) > 0.1);
        let ray = Ray { origin, direction: (target - origin).normalize() };
        let mut before = f64::NEG_INFINITY;
        for [enter, exit] in round(&shape).intervals(&ray) {
            if enter < exit {
                prop_assert!(before == f64::NEG_INFINITY || before < enter);
                let at = match (enter.is_finite(), exit.is_finite()) {
                    (true, true) => 0.5 * (enter + exit),
                    (true, false) => enter + 1.0,
                    (false, true) => exit - 1.0,
                    (false, false) => 0.0,
                };
                let middle = outside(&shape, ray.origin + ray.direction * at);
                prop_assert!(middle < 1e-9, "{middle}");
                before = exit;
            }
        }
    }

    /// A ray that starts at a hit, at its distance from the surface, does not meet the same spot again.
    #[test]
    fn what_leaves_the_surface_does_not_meet_it_there(
        shape in solid(), origin in vector(9.0), target in vector(3.0), away in direction(), grazing in 0.0..1.0f64,
        far in prop_oneof![Just(1.0), Just(1e-6), Just(1e6), Just(1e12)],
    ) {
        prop_assume!(origin.distance(target) > 0.1);
        let shape = scaled(&shape, far);
        let ray = Ray { origin: origin * far, direction: (target - origin).normalize() };
        let prepared = round(&shape);
        if let Some(distance) = prepared.hit(&ray, 0.0) {
            let spot = prepared.spot(ray.origin + ray.direction * distance);
            prop_assert!((spot.normal.length() - 1.0).abs() < 1e-12);
            let there = outside(&shape, spot.point).abs();
            prop_assert!(there <= spot.bound, "{there} {}", spot.bound);
            let size = (spot.point.abs().max_element()).max(far);
            for side in [1.0, -1.0] {
                let flat = (away - spot.normal * away.dot(spot.normal)).normalize();
                let tilt = spot.normal * side * (0.02 + grazing);
                let leaving = Ray { origin: spot.point + spot.normal * (side * spot.bound), direction: (flat + tilt).normalize() };
                if let Some(again) = prepared.hit(&leaving, 0.0) {
                    prop_assert!(again > 1e-9 * size, "again after {again}");
                }
            }
        }
    }

    #[test]
    fn nothing_reaches_out_of_the_box(shape in solid(), origin in vector(9.0), target in vector(3.0)) {
        prop_assume!(origin.distance(target) > 0.1);
        let ray = Ray { origin, direction: (target - origin).normalize() };
        let prepared = round(&shape);
        let [min, max] = prepared.corners();
        if let Some(distance) = prepared.hit(&ray, 0.0) {
            let p = ray.origin + ray.direction * distance;
            prop_assert!(p.cmpge(min - 1e-9).all() && p.cmple(max + 1e-9).all(), "{p} {min} {max}");
        }
    }

    /// Everything 2^k times as large, and moved by what can be added exactly: the same hit to the bit.
    #[test]
    fn powers_of_two_change_nothing(shape in solid(), origin in vector(9.0), target in vector(3.0), k in -40..40) {
        prop_assume!(origin.distance(target) > 0.1);
        let factor = libm::exp2(f64::from(k));
        let ray = Ray { origin, direction: target - origin };
        let large = Ray { origin: ray.origin * factor, direction: ray.direction * factor };
        let (small, scaled) = (round(&shape), round(&scaled(&shape, factor)));
        prop_assert_eq!(small.hit(&ray, 0.0), scaled.hit(&large, 0.0));
    }
}

fn scaled(shape: &Shape, by: f64) -> Shape {
    match shape {
        Shape::Frustum(f) => frustum(f.base * by, f.top * by, f.radii.map(|r| r * by), f.is_capped),
        Shape::Torus(t) => {
            let torus =
                Torus { center: t.center * by, axis: t.axis, radius: t.radius * by, tube: t.tube * by };
            Shape::Torus(Arc::new(torus))
        }
        Shape::Quadric(q) => quadric(q.square, q.product, q.linear * by, q.constant * by * by),
        _ => unreachable!(),
    }
}

#[test]
fn plain_cases() {
    let ray =
        |origin: [f64; 3], direction: [f64; 3]| Ray { origin: origin.into(), direction: direction.into() };
    let cylinder = round(&frustum(DVec3::ZERO, DVec3::Y * 2.0, [1.0; 2], true));
    assert_eq!(cylinder.hit(&ray([0.0, 1.0, 5.0], [0.0, 0.0, -1.0]), 0.0), Some(4.0));
    assert_eq!(cylinder.hit(&ray([0.5, 9.0, 0.0], [0.0, -1.0, 0.0]), 0.0), Some(7.0), "along the axis");
    assert_eq!(cylinder.hit(&ray([1.5, 9.0, 0.0], [0.0, -1.0, 0.0]), 0.0), None);
    assert_eq!(cylinder.hit(&ray([0.0, 1.0, 0.0], [0.0, 0.5, 0.0]), 0.0), Some(2.0), "from inside");
    let tube = round(&frustum(DVec3::ZERO, DVec3::Y * 2.0, [1.0; 2], false));
    assert_eq!(tube.hit(&ray([0.5, 9.0, 0.0], [0.0, -1.0, 0.0]), 0.0), None, "open");
    assert_eq!(tube.hit(&ray([0.0, 4.0, 5.0], [0.0, -0.6, -1.0]), 0.0), Some(4.0));
    let cone = round(&frustum(DVec3::ZERO, DVec3::Y, [1.0, 0.0], true));
    assert_eq!(cone.hit(&ray([0.0, 0.5, 5.0], [0.0, 0.0, -1.0]), 0.0), Some(4.5));
    assert_eq!(cone.hit(&ray([0.0, 5.0, 0.0], [0.0, -1.0, 0.0]), 0.0), Some(4.0), "onto the tip");
    assert_eq!(
        cone.hit(&ray([3.0, 1.5, 0.0], [-1.0, 0.0, 0.0]), 0.0),
        None,
        "the other half of a double cone"
    );
    // Tilted by so little that its cosine is 1.
    let tilted = round(&disc(DVec3::ZERO, DVec3::new(1e-9, 1.0, 0.0), 2.0, 0.0));
    assert!((tilted.corners()[1].y - 2e-9).abs() < 1e-15);
    let ring = round(&torus(DVec3::ZERO, DVec3::Y, 2.0, 0.5));
    assert_eq!(ring.intervals(&ray([9.0, 0.0, 0.0], [-1.0, 0.0, 0.0])), [[6.5, 7.5], [10.5, 11.5]]);
    assert_eq!(ring.hit(&ray([0.0, 9.0, 0.0], [0.0, -1.0, 0.0]), 0.0), None, "through the hole");
    let bowl = round(&quadric(DVec3::new(1.0, 0.0, 1.0), DVec3::ZERO, DVec3::NEG_Y, 0.0));
    let saddle = round(&quadric(DVec3::ZERO, DVec3::X, DVec3::ZERO, -1.0));
    assert_eq!(bowl.hit(&ray([0.5, -3.0, 0.0], [0.0, 1.0, 0.0]), 0.0), Some(3.25), "along the axis");
    assert_eq!(bowl.intervals(&ray([0.5, 9.0, 0.0], [0.0, -1.0, 0.0]))[0], [f64::NEG_INFINITY, 8.75]);
    assert_eq!(bowl.hit(&ray([-4.0, 4.0, 0.0], [1.0, 0.0, 0.0]), 0.0), Some(2.0));
    assert_eq!(bowl.hit(&ray([-4.0, -1.0, 0.0], [1.0, 0.0, 0.0]), 0.0), None);
    assert_eq!(saddle.hit(&ray([0.5, 0.0, 0.0], [0.0, 1.0, 0.0]), 0.0), Some(2.0), "x y = 1");
    let both = saddle.intervals(&ray([-4.0, -4.0, 0.0], [1.0, 1.0, 0.0]));
    assert_eq!(both[0], [3.0, 5.0]);
    let hollow = round(&quadric(DVec3::NEG_ONE, DVec3::ZERO, DVec3::ZERO, 1.0));
    assert_eq!(
        hollow.intervals(&ray([-4.0, 0.0, 0.0], [1.0, 0.0, 0.0])),
        [[f64::NEG_INFINITY, 3.0], [5.0, f64::INFINITY]]
    );
    let plate = round(&disc(DVec3::ZERO, DVec3::Y, 1.0, 0.5));
    assert_eq!(plate.hit(&ray([0.75, 2.0, 0.0], [0.0, -1.0, 0.0]), 0.0), Some(2.0));
    assert_eq!(plate.hit(&ray([0.25, 2.0, 0.0], [0.0, -1.0, 0.0]), 0.0), None);
}

/// Rays along the outermost line of a torus, a little to both sides: no speckles.
#[test]
fn grazing_rays_are_told_apart() {
    for (radius, tube) in [(1.0, 0.5), (1.0, 1e-3), (1.0, 0.999)] {
        let ring = round(&torus(DVec3::ZERO, DVec3::Y, radius, tube));
        for step in 0..2000 {
            let angle = f64::from(step) * 0.003;
            let (side, ahead) = (
                DVec3::new(libm::cos(angle), 0.0, libm::sin(angle)),
                DVec3::new(-libm::sin(angle), 0.0, libm::cos(angle)),
            );
            for direction in [ahead, DVec3::Y, (ahead + DVec3::Y).normalize()] {
                for (off, met) in [(-1e-11, true), (1e-11, false)] {
                    let ray = Ray { origin: side * (radius + tube + off) - direction * 7.0, direction };
                    assert_eq!(
                        ring.hit(&ray, 0.0).is_some(),
                        met,
                        "{radius} {tube} {angle} {off} {direction}"
                    );
                }
            }
        }
    }
}

#[test]
fn parameters_go_round_and_up() {
    let close = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 1e-12 && (a[1] - b[1]).abs() < 1e-12;
    let cylinder = round(&frustum(DVec3::ZERO, DVec3::Y * 2.0, [1.0; 2], true));
    assert!(close(cylinder.uv(DVec3::new(0.0, 0.5, 1.0)), [0.5, 0.25]));
    assert!(close(cylinder.uv(DVec3::new(0.5, 2.0, 0.0)), [0.75, 0.5]), "the cap");
    let ring = round(&torus(DVec3::ZERO, DVec3::Y, 2.0, 0.5));
    assert!(close(ring.uv(DVec3::new(0.0, 0.0, 2.5)), [0.5, 0.0]));
    assert!(close(ring.uv(DVec3::new(0.0, 0.5, 2.0)), [0.5, 0.25]));
    assert!(close(ring.uv(DVec3::new(1.5, 0.0, 0.0)), [0.75, 0.5]));
}

/// A ray almost along a line on the surface: the vertex of the parabola is thousands of times as far as its first root, and
/// what is computed there is of no use for that root. Found at random.
#[test]
fn a_far_vertex_does_not_blur_the_near_root() {
    let shape = quadric(
        DVec3::new(0.11165295744715603, 0.6176811256587962, 0.5808093360429715),
        DVec3::new(-0.03184869979081636, -0.6429957893939227, -0.09252996100208469),
        DVec3::new(0.7142331959667955, 0.11803855654820747, 0.6898824834325573),
        0.23436108331647776,
    );
    let origin = DVec3::new(-2.631351767259258, -0.6234036742787162, 0.2905133720344193);
    let direction = DVec3::new(0.7799845875973042, -0.13114405205005678, 0.6119029994390905);
    for far in [1.0, 1e6, 1e12] {
        let prepared = round(&scaled(&shape, far));
        let [[_, near], [second, _]] = prepared.intervals(&Ray { origin: origin * far, direction });
        assert!(second > 1000.0 * far, "{second}");
        let left = outside(&scaled(&shape, far), origin * far + direction * near).abs();
        assert!(left <= 1e-15 * far, "{left}");
    }
}
