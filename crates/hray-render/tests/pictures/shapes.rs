//! Where shapes are hit.

use crate::common::{
    NORMAL, Numbers, OBJECT, WORLD, ball, camera, colors, cuboid, description, directions, frustum, lump,
    middle, of, placed, plane, showing, shown, sphere, torus, v,
};
use crate::reference::nearest;
use hray_core::{DAffine3, DMat3, DVec3, Integrator, Primitive, Quadric, Rgb, Shape};
use hray_expr::Input;
use std::sync::Arc;

const SIDE: i64 = 24;

fn random_placement(n: &mut Numbers) -> DAffine3 {
    let axis = n.point(1.0).normalize();
    let matrix = DMat3::from_axis_angle(axis, n.between(0.0, 6.0))
        * DMat3::from_diagonal(v(n.between(0.4, 1.6), n.between(0.4, 1.6), n.between(0.4, 1.6)))
        * DMat3::from_cols(DVec3::X, v(n.between(-0.5, 0.5), 1.0, 0.0), DVec3::Z);
    DAffine3 { matrix3: matrix, translation: n.point(1.0) }
}

/// `meshes` may be among them.
pub(crate) fn random_leaf(n: &mut Numbers, show: [Input; 3], meshes: bool) -> Primitive {
    let shape = match n.below(if meshes { 11 } else { 10 }) {
        0 | 1 => sphere(n.point(0.8), n.between(0.3, 1.2)),
        2 | 3 => {
            let min = n.point(0.8) - 0.4;
            cuboid(min, min + v(n.between(0.3, 1.5), n.between(0.3, 1.5), n.between(0.3, 1.5)))
        }
        4 => plane(n.point(1.0), n.between(0.2, 1.5)),
        5 => {
            let base = n.point(0.8);
            frustum(base, base + n.point(1.2), [n.between(0.2, 0.8); 2])
        }
        6 => {
            let base = n.point(0.8);
            frustum(base, base + n.point(1.2), [n.between(0.2, 1.0), n.between(0.0, 0.6)])
        }
        7 => Shape::Quadric(Arc::new(Quadric {
            square: n.point(1.0),
            product: n.point(0.6),
            linear: n.point(0.8),
            constant: n.between(-0.8, 0.4),
        })),
        8 => torus(n.point(0.8), n.point(1.0), n.between(0.6, 1.2), n.between(0.1, 0.5)),
        9 => {
            let size = v(n.between(1.0, 3.0), n.between(1.0, 3.0), n.between(1.0, 3.0));
            lump(n.point(0.8), n.between(0.4, 0.9), n.between(0.0, 0.15), size)
        }
        _ => ball(n.point(0.8), n.between(0.4, 1.2), 1, false),
    };
    let primitive = of(shape, &showing(show));
    if n.below(2) == 0 { placed(primitive, random_placement(n)) } else { primitive }
}

/// Compares what is shown with the reference: `show` tells the numbers of a hit. Hits near an edge may differ, a few
/// in thousands.
pub(crate) fn compare(
    scene: impl Fn(u64, [Input; 3]) -> Vec<Primitive>,
    integrators: &[Integrator],
    tolerance: f64,
) {
    let (mut differ, mut hits) = (0, 0);
    for seed in 0..60 {
        for &integrator in integrators {
            for (show, is_normal) in [(WORLD, false), (NORMAL, true)] {
                let primitives = scene(seed, show);
                let mut description = description(SIDE, primitives, Vec::new());
                description.integrator = integrator;
                for (color, direction) in colors(&description).into_iter().zip(directions(SIDE)) {
                    let expected = nearest(&description.scene.primitives, camera().from, direction)
                        .map(|hit| if is_normal { hit.normal } else { hit.point })
                        // What cannot be shown.
                        .map(|shown| shown.clamp(DVec3::splat(-10.0), DVec3::splat(10.0)));
                    hits += usize::from(expected.is_some());
                    let same = match (shown(color), expected) {
                        (Some(found), Some(expected)) => found.distance(expected) < tolerance,
                        (found, expected) => found.is_some() == expected.is_some(),
                    };
                    differ += usize::from(!same);
                }
            }
        }
    }
    assert!(hits > 20_000 && differ * 20_000 <= hits, "{differ} of {hits} differ");
}

#[test]
fn hits_are_where_the_reference_has_them() {
    let scene = |seed, show| {
        let n = &mut Numbers(seed);
        (0..1 + n.below(5)).map(|_| random_leaf(n, show, false)).collect()
    };
    compare(scene, &[Integrator::Classic, Integrator::Classic2005], 1e-9);
}

/// A sphere that is stretched is an ellipsoid: (x/2)² + y² + (z/0.5)² = 1.
#[test]
fn a_stretched_sphere_is_an_ellipsoid() {
    let stretch = DAffine3::from_scale(v(2.0, 1.0, 0.5));
    let show = |inputs| {
        let primitive = placed(of(sphere(DVec3::ZERO, 1.0), &showing(inputs)), stretch);
        colors(&description(SIDE, vec![primitive], Vec::new()))
    };
    let [points, objects, normals] = [WORLD, OBJECT, NORMAL].map(show);
    let mut hits = 0;
    for ((point, object), normal) in points.into_iter().zip(objects).zip(normals) {
        let Some(p) = shown(point) else { continue };
        let object = shown(object).unwrap();
        let scaled = p / v(2.0, 1.0, 0.5);
        assert!((scaled.length() - 1.0).abs() < 1e-13 && scaled.distance(object) < 1e-13);
        let gradient = v(p.x / 4.0, p.y, p.z * 4.0).normalize();
        assert!(gradient.distance(shown(normal).unwrap()) < 1e-12);
        hits += 1;
    }
    assert!(hits > 100);
}

#[test]
fn a_box_is_hit_on_the_face_that_is_seen() {
    let cube = cuboid(v(-0.5, -0.5, -1.0), v(0.5, 0.5, 1.25));
    let show = |inputs| shown(middle(vec![of(cube.clone(), &showing(inputs))], Vec::new())).unwrap();
    assert!(show(WORLD).distance(v(0.0, 0.0, 1.25)) < 1e-14);
    assert!(show(NORMAL).distance(DVec3::Z) < 1e-14);
    // In the middle of the face.
    assert!(show([Input::U, Input::V, Input::U]).distance(DVec3::splat(0.5)) < 1e-14);
}

/// Of two in the same place the one that is written last is seen.
#[test]
fn the_last_of_two_is_seen() {
    for integrator in [Integrator::Classic, Integrator::Classic2005] {
        let same = |shape: hray_core::Shape| {
            let [a, b] = [WORLD, NORMAL].map(|show| of(shape.clone(), &showing(show)));
            let mut description = description(1, vec![a, b], Vec::new());
            description.integrator = integrator;
            shown(colors(&description)[0]).unwrap()
        };
        assert!(same(sphere(DVec3::ZERO, 2.0)).distance(DVec3::Z) < 1e-9);
        assert!(same(cuboid(v(-2.0, -2.0, -2.0), v(2.0, 2.0, 2.0))).distance(DVec3::Z) < 1e-9);
        assert!(same(plane(DVec3::Z, 3.0)).distance(DVec3::Z) < 1e-9);
    }
}

/// However many threads, vectors of whatever group: one picture.
#[test]
fn a_picture_of_everything_is_the_same_with_any_number_of_threads() {
    use hray_core::NoiseTables;
    use hray_render::{Control, Settings, render};
    let n = &mut Numbers(5);
    let primitives = (0..30).map(|_| random_leaf(n, WORLD, false)).collect();
    let description = description(80, primitives, Vec::new());
    let of = |threads| {
        let settings =
            Settings { threads: std::num::NonZeroUsize::new(threads), ..Settings::of(&description) };
        let mut pixels = Vec::new();
        let take = |run: Vec<Rgb>| {
            pixels.extend(run);
            Ok::<(), ()>(())
        };
        let tables = NoiseTables::default();
        render(&description, &tables, &settings, &Control::new(), <[Rgb]>::to_vec, take).unwrap();
        pixels
    };
    let one = of(1);
    assert!([2, 5].map(of).iter().all(|other| *other == one));
}
