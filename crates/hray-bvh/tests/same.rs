//! A tree finds what a walk over all triangles finds, to the last bit, at every level of SIMD.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

mod common;

use common::*;
use hray_bvh::{MeshError, TriangleMesh};
use proptest::prelude::*;

/// Many rays of all kinds; how many hit.
fn check(mesh: &Mesh, random: &mut Random, count: usize, centre: [f32; 3], size: f32) -> usize {
    let rays: Vec<Plain> = (0..count).map(|_| ray(random, mesh, centre, size)).collect();
    compare(&mesh.build(), &rays).unwrap()
}

#[test]
fn soups() {
    for (seed, count) in (0..).zip([1, 2, 3, 4, 5, 8, 9, 31, 100, 300, 1000]) {
        for size in [1.0, 0.2, 0.01] {
            let random = &mut Random(seed);
            let mesh = soup(random, count, size);
            let hits = check(&mesh, random, 500, [0.0; 3], 1.0);
            assert!(hits > 20, "{hits} hits of {count} triangles of {size}");
        }
    }
}

#[test]
fn shared_vertices() {
    for (seed, height) in (0..).zip([0.0, 0.01, 0.3]) {
        let random = &mut Random(seed);
        let mesh = terrain(random, 16, height);
        check(&mesh, random, 2000, [0.0; 3], 1.0);
        let mesh = ball(random, 3, height);
        check(&mesh, random, 2000, [0.0; 3], 1.0);
    }
}

#[test]
fn scales_and_places() {
    for scale in [1e12, 1e6, 1e3, 1e-3, 1e-6] {
        for place in [0.0, 1.0, 30.0, 1e4] {
            let random = &mut Random(1);
            let shift = [place * scale, -place * scale, 0.5 * place * scale];
            for mesh in [soup(random, 100, 0.3), ball(random, 2, 0.1), terrain(random, 6, 0.1)] {
                let mesh = mesh.moved(scale, shift);
                check(&mesh, random, 700, shift, scale);
            }
        }
    }
}

#[test]
fn ties_go_to_the_greater_number() {
    let random = &mut Random(5);
    // Each triangle many times, in any order.
    let mut mesh = soup(random, 20, 0.5);
    let once = mesh.triangles.clone();
    for _ in 0..400 {
        mesh.triangles.push(once[random.below(once.len())]);
    }
    check(&mesh, random, 2000, [0.0; 3], 1.0);
    let tree = mesh.build();
    let level = levels()[0];
    let mut stack = hray_bvh::Stack::default();
    for _ in 0..300 {
        let [a, b, c] = mesh.corners(random.below(20));
        let target = add(add(a, b, 0.5), c, 0.25).map(|x| x / 1.75);
        let [closest, ..] = answers(level, &tree, &Plain::to(random.point(), target), &mut stack);
        let Some(hit) = closest else { continue };
        let triangle = mesh.triangles[hit.triangle as usize];
        let last = mesh.triangles.iter().rposition(|other| *other == triangle);
        assert_eq!(last, Some(hit.triangle as usize));
    }
}

#[test]
fn degenerate_meshes() {
    let random = &mut Random(9);
    let none = Mesh { vertices: vec![[0.0; 3]], triangles: vec![] };
    assert_eq!(check(&none, random, 50, [0.0; 3], 1.0), 0);
    // All boxes the same: more than fit into a leaf, and than cuts can part.
    let mut equal = soup(random, 1, 1.0);
    equal.triangles = vec![[0, 1, 2]; 3000];
    assert!(check(&equal, random, 300, [0.0; 3], 1.0) > 10);
    // Points and lines are never hit.
    let mut flat = soup(random, 200, 0.3);
    for (number, triangle) in flat.triangles.iter_mut().enumerate() {
        triangle[2] = triangle[number % 2];
        triangle[1] = triangle[if number % 3 == 0 { 0 } else { 1 }];
    }
    check(&flat, random, 1000, [0.0; 3], 1.0);
    // All in a plane.
    let plane = soup(random, 300, 0.3);
    let plane = Mesh { vertices: plane.vertices.iter().map(|[x, y, _]| [*x, *y, 0.25]).collect(), ..plane };
    assert!(check(&plane, random, 1000, [0.0; 3], 1.0) > 100);
    // Middles in a geometric row, which bins can hardly part.
    let mut row = soup(random, 120, 1e-3);
    for (number, vertex) in row.vertices.iter_mut().enumerate() {
        let scale = libm::powf(0.7, (number / 3) as f32);
        *vertex = [scale + 1e-3 * scale * vertex[0], scale * vertex[1], scale * vertex[2]];
    }
    check(&row, random, 1000, [0.0; 3], 1.0);
}

#[test]
fn what_is_no_number_is_never_hit() {
    let random = &mut Random(11);
    let mut mesh = soup(random, 300, 0.4);
    for (index, vertex) in mesh.vertices.iter_mut().enumerate() {
        match index % 21 {
            0 => vertex[index % 3] = f32::NAN,
            7 => vertex[index % 3] = f32::INFINITY,
            14 => vertex[index % 3] = f32::NEG_INFINITY,
            _ => {}
        }
    }
    let finite = |triangle: &[u32; 3]| {
        triangle.iter().all(|vertex| mesh.vertices[*vertex as usize].iter().all(|x| x.is_finite()))
    };
    let tree = mesh.build();
    assert!(tree.bounds().reach() < 2.0);
    let rays: Vec<Plain> = (0..2000).map(|_| Plain::to(random.point(), random.point())).collect();
    assert!(compare(&tree, &rays).unwrap() > 100);
    let mut stack = hray_bvh::Stack::default();
    for ray in &rays {
        if let [Some(hit), ..] = answers(levels()[0], &tree, ray, &mut stack) {
            assert!(finite(&mesh.triangles[hit.triangle as usize]));
        }
    }
    let nothing = Mesh { vertices: vec![[f32::NAN; 3]], triangles: vec![[0, 0, 0]; 9] };
    assert_eq!(compare(&nothing.build(), &rays[..10]), Ok(0));
}

#[test]
fn rays_start_in_boxes_and_on_their_faces() {
    let random = &mut Random(13);
    // Coordinates are multiples of 1/4, so that rays lie in the planes of many faces and of triangles.
    let mut mesh = soup(random, 400, 0.5);
    for x in mesh.vertices.as_flattened_mut() {
        *x = (*x * 4.0).round() / 4.0;
    }
    let mut grid = |_| {
        let origin = random.point().map(|x| (x * 8.0).round() / 4.0);
        let mut direction = random.point().map(|x| (x * 2.0).round() / 2.0);
        if direction == [0.0; 3] {
            direction[2] = -1.0;
        }
        if random.below(3) == 0 {
            direction = direction.map(|x| -x);
        }
        Plain::new(origin, direction)
    };
    let rays: Vec<Plain> = (0..6000).map(&mut grid).collect();
    assert!(compare(&mesh.build(), &rays).unwrap() > 300);
}

#[test]
fn rays_without_a_direction_or_a_place_meet_nothing() {
    let mesh = soup(&mut Random(3), 500, 0.5).build();
    let values = [0.0, -0.0, 1e-42, -1e-30, 1e-20, 1.0, 1e30, f32::INFINITY, f32::NEG_INFINITY, f32::NAN];
    let mut rays = Vec::new();
    for (a, b) in values.into_iter().flat_map(|a| values.map(|b| (a, b))) {
        for (c, d) in values.into_iter().flat_map(|c| values.map(|d| (c, d))) {
            rays.push(Plain { origin: [0.0, c, d], direction: [0.0, a, b], near: 0.0, far: f32::INFINITY });
        }
        rays.push(Plain { origin: [0.1; 3], direction: [1.0, 0.5, 0.2], near: a, far: b });
    }
    let mut stack = hray_bvh::Stack::default();
    for ray in rays.into_iter().filter(|ray| ray.near >= 0.0) {
        for level in levels() {
            let [closest, any, _] = answers(level, &mesh, &ray, &mut stack);
            assert_eq!(closest, any);
            let strange = ray.origin.iter().chain(&ray.direction).any(|x| !x.is_finite());
            if strange || ray.direction == [0.0; 3] {
                assert_eq!(closest, None, "{ray:?}");
            }
        }
    }
}

#[test]
fn missing_vertices_are_errors() {
    let build = |triangles: &[[u32; 3]]| TriangleMesh::build(&[[0.0; 3]; 3], triangles);
    let error = build(&[[0, 1, 2], [0, 3, 1]]).unwrap_err();
    assert_eq!(error, MeshError::NoSuchVertex { triangle: 1, vertex: 3 });
    assert!(error.to_string().contains("triangle 1 has vertex 3"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn any_triangles(
        points in proptest::collection::vec(proptest::array::uniform3(-8i32..8), 3..40),
        corners in proptest::collection::vec(proptest::array::uniform3(0usize..1000), 1..60),
        scale in prop::sample::select(vec![1e12f32, 1.0, 0.1, 1e-6]),
        seed: u64,
    ) {
        let vertices: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32 * 0.1 * scale)).collect();
        let triangles = corners.iter().map(|c| c.map(|x| (x % vertices.len()) as u32)).collect();
        let mesh = Mesh { vertices, triangles };
        let random = &mut Random(seed);
        let rays: Vec<Plain> = (0..100).map(|_| ray(random, &mesh, [0.0; 3], scale)).collect();
        let compared = compare(&mesh.build(), &rays);
        prop_assert!(compared.is_ok(), "{compared:?}");
    }
}
