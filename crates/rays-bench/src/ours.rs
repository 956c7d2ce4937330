//! The tracers of this project: the one place to add one.

use crate::Result;
use crate::measure::{Clock, Contestant, Role};
use crate::meshes::Mesh;
use crate::rays::Ray;
use crate::trace::{Hit, Tracer};
use fearless_simd::{Level, dispatch, prelude::*};
use hray_bvh::{Stack, TriangleMesh};

/// Builds each of our tracers over the mesh on `threads` threads, timed by `clock`.
///
/// # Errors
/// Where a tracer cannot be built.
pub fn build(mesh: &Mesh, threads: usize, clock: Clock) -> Result<Vec<Contestant>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| format!("no threads to build with: {error}"))?;
    let (tree, time) =
        clock.time(threads, || pool.install(|| TriangleMesh::build(&mesh.vertices, &mesh.triangles)));
    let tree = tree.map_err(|error| error.to_string())?;
    let bytes = tree.bytes() as u64;
    Ok(vec![Contestant {
        name: "hray".into(),
        role: Role::Ours,
        build: time,
        kept: Some(bytes),
        peak: None,
        tracer: Box::new(Ours { tree, level: Level::new() }),
    }])
}

struct Ours {
    tree: TriangleMesh,
    level: Level,
}

impl Tracer for Ours {
    type State = ();

    fn enter(&self) {}

    fn intersect(&self, ray: &Ray) -> Hit {
        let mut answer = [Hit::MISS];
        self.intersect_each(std::slice::from_ref(ray), &mut answer);
        answer[0]
    }

    fn occluded(&self, ray: &Ray) -> bool {
        self.occluded_count(std::slice::from_ref(ray)) > 0
    }

    fn intersect_each(&self, rays: &[Ray], answers: &mut [Hit]) {
        dispatch!(self.level, simd => closest(simd, &self.tree, rays, answers));
    }

    fn occluded_count(&self, rays: &[Ray]) -> u64 {
        dispatch!(self.level, simd => occluded(simd, &self.tree, rays))
    }
}

#[inline(always)]
fn closest<S: Simd>(simd: S, tree: &TriangleMesh, rays: &[Ray], answers: &mut [Hit]) {
    let mut stack = Stack::default();
    for (answer, ray) in answers.iter_mut().zip(rays) {
        let hit = tree.closest(simd, &ready(simd, tree, ray), &mut stack);
        *answer = hit.map_or(Hit::MISS, |hit| Hit { t: hit.distance, triangle: hit.triangle });
    }
}

#[inline(always)]
fn occluded<S: Simd>(simd: S, tree: &TriangleMesh, rays: &[Ray]) -> u64 {
    let mut stack = Stack::default();
    let mut count = 0;
    for ray in rays {
        count += u64::from(tree.any(simd, &ready(simd, tree, ray), &mut stack));
    }
    count
}

#[inline(always)]
fn ready<S: Simd>(simd: S, tree: &TriangleMesh, ray: &Ray) -> hray_bvh::Ray {
    hray_bvh::Ray::new(simd, ray.origin, ray.direction, ray.tnear, ray.tfar, tree.reach())
}
