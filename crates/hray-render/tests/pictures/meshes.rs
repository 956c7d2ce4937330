//! Triangle meshes, and many objects at once.

use crate::common::{
    NORMAL, NOTHING, Numbers, WORLD, ball, colors, description, gray, matte, of, placed, showing, shown,
    sphere, v,
};
use crate::shapes::{compare, random_leaf};
use hray_core::{Camera, DAffine3, DVec3, Integrator, Light, Mesh, Primitive, Rgb, Shape};
use hray_expr::Input;
use std::sync::Arc;

/// Triangles anywhere.
fn soup(n: &mut Numbers, count: usize) -> Shape {
    let mut points = Vec::new();
    for _ in 0..count {
        let middle = n.point(1.2);
        points.extend((0..3).map(|_| (middle + n.point(0.5)).to_array().map(|x| x as f32)));
    }
    let triangles = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Shape::Mesh(Arc::new(Mesh::new(points, triangles).unwrap()))
}

fn turned() -> DAffine3 {
    DAffine3::from_axis_angle(v(1.0, 2.0, 3.0).normalize(), 0.7)
}

#[test]
fn meshes_are_met_where_the_reference_has_them() {
    let scene = |seed, show| {
        let n = &mut Numbers(seed * 31);
        let mesh = of(soup(n, 30), &showing(show));
        let squeezed = DAffine3::from_scale(n.point(0.5) + 1.0) * turned();
        vec![placed(of(soup(n, 20), &showing(show)), squeezed), mesh, random_leaf(n, show, false)]
    };
    compare(scene, &[Integrator::Classic], 1e-5);
}

/// With so many objects there is a tree over them.
#[test]
fn many_objects_are_met_where_the_reference_has_them() {
    let scene = |seed, show: [Input; 3]| {
        let n = &mut Numbers(seed * 13);
        let mut primitives: Vec<Primitive> = (0..20).map(|_| random_leaf(n, show, false)).collect();
        for _ in 0..20 {
            primitives.push(of(sphere(n.point(1.5), n.between(0.05, 0.3)), &showing(show)));
        }
        let far = DAffine3::from_translation(n.point(1.0));
        primitives.push(placed(of(soup(n, 10), &showing(show)), far));
        primitives
    };
    compare(scene, &[Integrator::Classic], 1e-5);
}

/// Of two things in the same place the last one is seen, in a tree and without.
#[test]
fn the_last_of_many_in_one_place_is_seen() {
    for copies in [3, 40] {
        let light = Light::Ambient { intensity: gray(1.0) };
        let shades = (0..copies).map(|i| matte(f64::from(i) / 100.0));
        for shape in [sphere(DVec3::ZERO, 1.0), ball(DVec3::ZERO, 1.0, 3, false)] {
            let primitives = shades.clone().map(|shade| of(shape.clone(), &shade)).collect();
            let found = colors(&description(64, primitives, vec![light]));
            let expected = f64::from(copies - 1) / 100.0;
            let others = found.iter().filter(|c| **c != NOTHING && c.r != expected).count();
            assert_eq!(others, 0, "{copies}");
        }
    }
}

/// Also where a tree comes to the last one last, because something of the others is nearer to the viewer.
#[test]
fn the_last_of_many_meshes_in_one_place_is_seen() {
    let Shape::Mesh(ball) = ball(DVec3::ZERO, 1.0, 4, false) else { panic!() };
    let copies = 40;
    let copy = |i: u8| {
        let mut positions = ball.positions().to_vec();
        let mut triangles = ball.triangles().to_vec();
        let aside = [2.0, 2.0, 2.0 - f32::from(i) * 0.02];
        triangles.push([0, 1, 2].map(|corner| positions.len() as u32 + corner));
        positions.extend([aside, [2.1, 2.0, aside[2]], [2.0, 2.1, aside[2]]]);
        of(Shape::Mesh(Arc::new(Mesh::new(positions, triangles).unwrap())), &matte(f64::from(i) / 100.0))
    };
    let light = Light::Ambient { intensity: gray(1.0) };
    let found = colors(&description(64, (0..copies).map(copy).collect(), vec![light]));
    let expected = f64::from(copies - 1) / 100.0;
    assert_eq!(found.iter().filter(|c| **c != NOTHING && c.r != expected).count(), 0);
}

/// Moved away by a million of its sizes together with the camera, a scene is the same but for the rounding of
/// where things are.
#[test]
fn far_away_is_as_good_as_near() {
    let scene = |offset: DVec3| {
        let n = &mut Numbers(5);
        let mut primitives: Vec<Primitive> =
            (0..30).map(|_| of(sphere(n.point(1.5) + offset, n.between(0.1, 0.4)), &matte(0.8))).collect();
        let there = DAffine3::from_translation(offset);
        primitives.push(placed(of(ball(DVec3::ZERO, 0.7, 3, true), &matte(0.5)), there));
        let light = Light::Point { position: v(3.0, 5.0, 4.0) + offset, intensity: gray(1.0) };
        let mut description = description(64, primitives, vec![light]);
        if let Camera::Perspective(camera) = &mut description.scene.camera {
            (camera.from, camera.to) = (camera.from + offset, camera.to + offset);
        }
        colors(&description)
    };
    let (near, far) = (scene(DVec3::ZERO), scene(v(1e6, -1e6, 1e6)));
    let different = near.iter().zip(&far).filter(|(a, b)| (a.r - b.r).abs() > 1e-3).count();
    assert!(different <= 12, "{different} of {} pixels", near.len());
}

/// A smooth ball of few triangles, lit from the side: the light falls off to nothing towards the edge of its shadow, and no
/// triangle of the lit half is dark.
#[test]
fn no_triangle_shows_at_the_edge_of_the_shadow() {
    let light = Light::Directional { direction: DVec3::NEG_X, intensity: gray(1.0) };
    let shape = of(ball(DVec3::ZERO, 1.5, 3, true), &matte(1.0));
    let mut description = description(128, vec![shape], vec![light]);
    let lit = colors(&description);
    description.scene.primitives = vec![of(sphere(DVec3::ZERO, 1.5), &matte(1.0))];
    let round = colors(&description);
    // Where the round ball is clearly lit, so is the other, and as much.
    let mut compared = 0;
    for (found, expected) in lit.iter().zip(&round) {
        if *found != NOTHING && *expected != NOTHING && expected.r > 0.02 {
            compared += 1;
            assert!((found.r - expected.r).abs() < 0.12, "{found:?} instead of {expected:?}");
        }
    }
    assert!(compared > 2000, "{compared}");
}

/// Smooth normals are those of the ball.
#[test]
fn normals_are_interpolated() {
    let flat = of(ball(DVec3::ZERO, 1.0, 4, false), &showing(NORMAL));
    let [world, normal] = [WORLD, NORMAL].map(|show| {
        let primitive = Primitive { material: showing(show), ..flat.clone() };
        colors(&description(64, vec![primitive], Vec::new()))
    });
    let mut seen = 0;
    for (world, normal) in world.iter().zip(&normal) {
        if let (Some(point), Some(normal)) = (shown(*world), shown(*normal)) {
            seen += 1;
            assert!(point.normalize().distance(normal) < 0.1, "outward");
            assert!((normal.length() - 1.0).abs() < 1e-9);
        }
    }
    assert!(seen > 400, "{seen}");
}

#[test]
fn empty_and_flat_meshes_are_not_seen() {
    let point = vec![[0.0f32; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [f32::NAN; 3]];
    let meshes = [
        Mesh::default(),
        Mesh::new(point.clone(), vec![[0, 0, 0], [0, 1, 2]]).unwrap(),
        Mesh::new(point, vec![[0, 1, 3]]).unwrap(),
    ];
    for mesh in meshes {
        let many = (0..20).map(|_| of(Shape::Mesh(Arc::new(mesh.clone())), &matte(1.0))).collect();
        let found = colors(&description(16, many, Vec::new()));
        assert!(found.iter().all(|c| *c == NOTHING || *c == Rgb::BLACK));
        assert!(found.iter().filter(|c| **c != NOTHING).count() < 10);
    }
}
