//! No ray slips through between triangles, and a tree is the same however many threads build it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

mod common;

use common::*;
use fearless_simd::{Level, Simd, dispatch};
use hray_bvh::{Stack, TriangleMesh};

/// Aims at edges and vertices and points of triangles from each origin, for `count` rays; they go on far behind, so that
/// none ends before the surface. How many meet nothing.
fn slips(mesh: &Mesh, origins: &[[f32; 3]], count: usize, random: &mut Random) -> usize {
    let rays: Vec<Plain> = (0..count)
        .map(|_| {
            let [a, b, c] = mesh.corners(random.below(mesh.triangles.len()));
            let (edge, inside) = (add(b, a, -1.0), add(c, a, -1.0));
            let target = match random.below(4) {
                0 => a,
                1 => add(add(a, edge, 0.5 * random.unit()), inside, 0.5 * random.unit()),
                _ => add(a, edge, random.unit()),
            };
            Plain::to(origins[random.below(origins.len())], target)
        })
        .collect();
    let tree = mesh.build();
    dispatch!(Level::new(), simd => misses(simd, &tree, &rays))
}

#[inline(always)]
fn misses<S: Simd>(simd: S, tree: &TriangleMesh, rays: &[Plain]) -> usize {
    let mut stack = Stack::default();
    let mut misses = 0;
    for ray in rays {
        let ray = ray.ready(simd, tree);
        misses += usize::from(tree.closest(simd, &ray, &mut stack).is_none());
        misses += usize::from(!tree.any(simd, &ray, &mut stack));
    }
    misses
}

fn aim(count: usize) {
    let random = &mut Random(count as u64);
    // From inside a closed surface there is no way out.
    for (times, bumps) in [(1, 0.0), (3, 0.1), (6, 0.0), (6, 0.01)] {
        let mesh = ball(random, times, bumps);
        let mut origins = vec![[0.0; 3], [0.25, 0.0, 0.0]];
        origins.extend([0; 30].map(|_| random.point().map(|x| 0.3 * x)));
        assert_eq!(slips(&mesh, &origins, count, random), 0, "{times} {bumps}");
        for (scale, place) in [(1e6, 2e6), (1e-5, 1e-4), (1.0, 100.0)] {
            let shift = [place, -place, 0.5 * place];
            let mesh = ball(random, times, bumps).moved(scale, shift);
            let origins: Vec<_> = origins.iter().map(|origin| add(shift, *origin, scale)).collect();
            assert_eq!(slips(&mesh, &origins, count, random), 0, "{times} {bumps} {scale} {place}");
        }
    }
    // From high above a landscape; not at its rim, where a ray may graze a summit and pass by.
    for height in [0.0, 0.02] {
        let mut mesh = terrain(random, 100, height);
        let rim: Vec<[u32; 3]> = mesh.triangles.clone();
        let inner = |triangle: &[u32; 3]| {
            triangle.iter().all(|vertex| {
                let [x, _, z] = mesh.vertices[*vertex as usize];
                x.abs() < 0.8 && z.abs() < 0.8
            })
        };
        let targets =
            Mesh { triangles: rim.iter().copied().filter(inner).collect(), vertices: mesh.vertices.clone() };
        let origins: Vec<_> = (0..30).map(|_| add([0.0, 1.5, 0.0], random.point(), 1.0)).collect();
        mesh.triangles = rim;
        let tree = mesh.build();
        let rays: Vec<Plain> = (0..count)
            .map(|_| {
                let [a, b, _] = targets.corners(random.below(targets.triangles.len()));
                let along = if random.below(3) == 0 { 0.0 } else { random.unit() };
                Plain::to(origins[random.below(origins.len())], add(a, add(b, a, -1.0), along))
            })
            .collect();
        assert_eq!(dispatch!(Level::new(), simd => misses(simd, &tree, &rays)), 0);
    }
}

#[test]
fn nothing_slips_through() {
    aim(20_000);
}

#[test]
#[ignore = "takes minutes without optimization"]
fn nothing_slips_through_of_millions() {
    aim(300_000);
}

#[test]
#[ignore = "takes minutes without optimization"]
fn trees_find_the_same_for_many_rays() {
    for seed in 0..60 {
        let random = &mut Random(1000 + seed);
        let count = 1 + random.below(300);
        let size = [1.0, 0.1, 0.01, 1e-4][random.below(4)];
        let mesh = match seed % 3 {
            0 => soup(random, count, size),
            1 => terrain(random, 12, size),
            _ => ball(random, 3, size),
        };
        let place = [0.0, 1.0, 100.0, 1e4][random.below(4)];
        let scale = [1.0, 1e-3, 1e5][random.below(3)];
        let shift = random.point().map(|x| x * place * scale);
        let mesh = mesh.moved(scale, shift);
        let rays: Vec<Plain> = (0..5_000).map(|_| ray(random, &mesh, shift, scale)).collect();
        compare(&mesh.build(), &rays).unwrap();
    }
}

#[test]
fn threads_change_nothing() {
    let random = &mut Random(17);
    for mesh in [soup(random, 60_000, 0.01), terrain(random, 150, 0.05), ball(random, 5, 0.01)] {
        let build = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| mesh.build())
        };
        let one = build(1);
        for threads in [2, 5] {
            assert!(build(threads) == one, "{threads} threads");
        }
    }
}
