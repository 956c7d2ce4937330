//! A mesh whose vertices have moved finds what one built anew finds, to the last bit.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

mod common;

use common::*;
use hray_bvh::{MeshError, Stack, TriangleMesh};
use proptest::prelude::*;

/// The tree against a walk over all its triangles, and against one built anew; how many rays hit.
fn check(tree: &TriangleMesh, mesh: &Mesh, rays: &[Plain]) -> Result<usize, String> {
    let hits = compare(tree, rays)?;
    let (anew, mut stack) = (mesh.build(), Stack::default());
    assert_eq!((tree.bounds(), tree.reach()), (anew.bounds(), anew.reach()));
    for ray in rays {
        let [found, ..] = answers(levels()[0], tree, ray, &mut stack);
        let [expected, ..] = answers(levels()[0], &anew, ray, &mut stack);
        if bits(found) != bits(expected) {
            return Err(format!("{ray:?}: {found:?}, anew {expected:?}"));
        }
    }
    Ok(hits)
}

fn shaken(random: &mut Random, mesh: &Mesh, size: f32) -> Mesh {
    let vertices = mesh.vertices.iter().map(|vertex| add(*vertex, random.point(), size)).collect();
    Mesh { vertices, triangles: mesh.triangles.clone() }
}

#[test]
fn vertices_that_move() {
    let random = &mut Random(21);
    let meshes =
        [soup(random, 1000, 0.1), terrain(random, 24, 0.1), ball(random, 4, 0.1), soup(random, 3, 1.0)];
    for mesh in meshes {
        let mut tree = mesh.build();
        let mut now = mesh;
        for size in [0.0, 0.01, 0.3, 2.0] {
            now = shaken(random, &now, size);
            tree.refit(&now.vertices, &now.triangles).unwrap();
            let rays: Vec<Plain> = (0..1500).map(|_| ray(random, &now, [0.0; 3], 1.0 + size)).collect();
            assert!(check(&tree, &now, &rays).unwrap() > 100);
        }
    }
}

#[test]
fn large_meshes_on_any_threads() {
    let random = &mut Random(22);
    let mesh = terrain(random, 150, 0.05);
    let now = shaken(random, &mesh, 0.05);
    let refit = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut tree = mesh.build();
        pool.install(|| tree.refit(&now.vertices, &now.triangles)).unwrap();
        tree
    };
    let tree = refit(1);
    assert!(tree == refit(3) && tree != mesh.build());
    let rays: Vec<Plain> = (0..300).map(|_| ray(random, &now, [0.0; 3], 1.0)).collect();
    assert!(check(&tree, &now, &rays).unwrap() > 30);
}

#[test]
fn vertices_that_are_moved_back_give_the_same_mesh() {
    let random = &mut Random(23);
    let mesh = soup(random, 2000, 0.1);
    let built = mesh.build();
    let mut tree = built.clone();
    let mut now = shaken(random, &mesh, 0.5);
    tree.refit(&now.vertices, &now.triangles).unwrap();
    assert!(tree != built);
    // Some triangles, then all, are no triangles for a while.
    for every in [7, 1] {
        for vertex in now.vertices.iter_mut().step_by(every) {
            vertex[1] = f32::INFINITY;
        }
        tree.refit(&now.vertices, &now.triangles).unwrap();
        let rays: Vec<Plain> = (0..500).map(|_| ray(random, &mesh, [0.0; 3], 1.0)).collect();
        assert_eq!(check(&tree, &now, &rays).unwrap() > 20, every > 1);
    }
    tree.refit(&mesh.vertices, &mesh.triangles).unwrap();
    assert!(tree == built);
}

#[test]
fn what_does_not_belong_to_the_mesh_changes_nothing() {
    let random = &mut Random(24);
    let mut mesh = soup(random, 50, 0.3);
    mesh.vertices[30][2] = f32::NAN;
    let mut tree = mesh.build();
    let before = tree.clone();
    let now = shaken(random, &mesh, 0.1);
    let fewer = tree.refit(&now.vertices, &now.triangles[1..]).unwrap_err();
    assert_eq!(fewer, MeshError::OtherTriangles { built: 50, triangles: 49 });
    assert!(fewer.to_string().contains("49 triangles"));
    let missing = tree.refit(&now.vertices[..149], &now.triangles);
    assert_eq!(missing, Err(MeshError::NoSuchVertex { triangle: 49, vertex: 149 }));
    let mut whole = now.vertices.clone();
    whole[30] = [0.0; 3];
    let left_out = tree.refit(&whole, &now.triangles).unwrap_err();
    assert_eq!(left_out, MeshError::LeftOut { triangle: 10 });
    assert!(left_out.to_string().contains("triangle 10 was left out"));
    assert!(tree == before);
    tree.refit(&now.vertices, &now.triangles).unwrap();
    let rays: Vec<Plain> = (0..500).map(|_| Plain::to(random.point(), random.point())).collect();
    assert!(check(&tree, &now, &rays).unwrap() > 20);
    let nothing = Mesh { vertices: vec![], triangles: vec![] };
    assert_eq!(nothing.build().refit(&[], &[]), Ok(()));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]

    #[test]
    fn any_vertices(
        points in proptest::collection::vec(proptest::array::uniform3(-8i32..8), 3..40),
        corners in proptest::collection::vec(proptest::array::uniform3(0usize..1000), 1..120),
        seed: u64,
        size in prop::sample::select(vec![0.1f32, 1.0, 30.0]),
    ) {
        let vertices: Vec<[f32; 3]> = points.iter().map(|p| p.map(|x| x as f32 * 0.1)).collect();
        let triangles = corners.iter().map(|c| c.map(|x| (x % vertices.len()) as u32)).collect();
        let mesh = Mesh { vertices, triangles };
        let random = &mut Random(seed);
        let now = shaken(random, &mesh, size);
        let mut tree = mesh.build();
        prop_assert_eq!(tree.refit(&now.vertices, &now.triangles), Ok(()));
        let rays: Vec<Plain> = (0..50).map(|_| ray(random, &now, [0.0; 3], size)).collect();
        let checked = check(&tree, &now, &rays);
        prop_assert!(checked.is_ok(), "{checked:?}");
    }
}
