//! Triangle meshes: rays go down a tree in single precision, and what they hit is worked out in double precision from the
//! triangle's own vertices.

use super::solid::Ray;
use fearless_simd::prelude::*;
use hray_bvh::{MeshError, SLACK, Stack, TriangleMesh};
use hray_core::{DVec3, Mesh};
use std::sync::Arc;

/// How far off a surface a ray has to start so that it does not meet the same spot again, relative to the greatest coordinate
/// of the mesh: the rounding of the start to single precision, and of the test of a triangle, each a few times 2^-24.
const CLEAR: f64 = 1.0 / (1 << 18) as f64;

/// A mesh and the tree over its triangles.
pub(super) struct PreparedMesh {
    mesh: Arc<Mesh>,
    tree: TriangleMesh,
}

/// What there is to know of a hit, in the mesh's own space.
#[derive(Clone, Copy)]
pub(super) struct Located {
    /// The point, in the plane of the triangle.
    pub(super) point: DVec3,
    /// The triangle's unit normal, to the side that the vertices' normals lead to.
    pub(super) normal: DVec3,
    /// The unit normal to shade with.
    pub(super) shading: DVec3,
    /// From the point to where the smooth surface would be, along which shadow rays start.
    pub(super) lift: DVec3,
    /// Surface parameters.
    pub(super) uv: [f64; 2],
    /// How far along the normal a ray has to start.
    pub(super) bound: f64,
}

impl PreparedMesh {
    pub(super) fn new(mesh: Arc<Mesh>) -> Result<Self, MeshError> {
        let tree = TriangleMesh::build(mesh.positions(), mesh.triangles())?;
        Ok(Self { mesh, tree })
    }

    /// The mesh that it was made of.
    pub(super) const fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    pub(super) const fn tree(&self) -> &TriangleMesh {
        &self.tree
    }

    /// The corners of the box around it, if there is anything.
    pub(super) fn bounds(&self) -> Option<[DVec3; 2]> {
        let bounds = self.tree.bounds();
        (!bounds.is_empty())
            .then(|| [bounds.min, bounds.max].map(|corner| DVec3::from(corner.map(f64::from))))
    }

    /// Whether it has normals of its own to shade with.
    pub(super) fn is_smooth(&self) -> bool {
        !self.mesh.normals().is_empty()
    }

    /// The nearest hit between two distances: how far it is, and which triangle. It may also be a little farther.
    ///
    /// Whether a hit counts is decided by its distance in double precision. So that the same hits are compared in
    /// whatever order things are looked at, none may be left out because in single precision it is beyond `far`.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        ends: [f64; 2],
        stack: &mut Stack,
    ) -> Option<(f64, u32)> {
        let [near, far] = ends;
        let greatest = f64::from(self.tree.reach()) + ray.origin.abs().max_element();
        let far = far + f64::from(SLACK) * greatest / ray.direction.abs().max_element();
        let hit = self.tree.closest(simd, &self.narrowed(simd, ray, [near, far]), stack)?;
        let [a, b, c] = self.corners(hit.triangle);
        let [v, w] = hit.weights.map(f64::from);
        // The same point in double precision: distances to other things are compared with this.
        let point = a + (b - a) * v + (c - a) * w;
        let distance = (point - ray.origin).dot(ray.direction) / ray.direction.dot(ray.direction);
        Some((if distance > 0.0 { distance } else { f64::from(hit.distance) }, hit.triangle))
    }

    /// Whether there is any hit between two distances.
    #[inline(always)]
    pub(super) fn is_hit<S: Simd>(&self, simd: S, ray: &Ray, ends: [f64; 2], stack: &mut Stack) -> bool {
        self.tree.any(simd, &self.narrowed(simd, ray, ends), stack)
    }

    #[inline(always)]
    pub(super) fn narrowed<S: Simd>(&self, simd: S, ray: &Ray, [near, far]: [f64; 2]) -> hray_bvh::Ray {
        let [o, d] = [ray.origin, ray.direction].map(|v| v.to_array().map(|x| x as f32));
        // Distance 0 is where the ray comes from.
        let near = f32::MIN_POSITIVE.max(near as f32);
        hray_bvh::Ray::new(simd, o, d, near, far as f32, self.tree.reach())
    }

    pub(super) fn corners(&self, triangle: u32) -> [DVec3; 3] {
        let positions = self.mesh.positions();
        self.mesh.triangles()[triangle as usize]
            .map(|vertex| DVec3::from(positions[vertex as usize].map(f64::from)))
    }

    /// Where exactly a ray meets a triangle.
    pub(super) fn locate(&self, ray: &Ray, triangle: u32) -> Located {
        let corners @ [a, b, c] = self.corners(triangle);
        let weights @ [u, v, w] = weights(ray, corners);
        let point = a * u + b * v + c * w;
        let vertices = self.mesh.triangles()[triangle as usize];
        let uv = match self.mesh.uvs() {
            [] => [v, w],
            uvs => {
                let [a, b, c] = vertices.map(|vertex| uvs[vertex as usize].map(f64::from));
                [0, 1].map(|i| a[i] * u + b[i] * v + c[i] * w)
            }
        };
        let across = (b - a).cross(c - a);
        let mut normal = across / across.length();
        let bound = CLEAR * f64::from(self.tree.reach());
        let (mut shading, mut lift) = (normal, DVec3::ZERO);
        if self.is_smooth() {
            let normals = vertices.map(|vertex| {
                DVec3::from(self.mesh.normals()[vertex as usize].map(f64::from)).normalize_or_zero()
            });
            let sum = normals[0] * u + normals[1] * v + normals[2] * w;
            let length = sum.length();
            if length > 0.0 {
                shading = sum / length;
                if shading.dot(normal) < 0.0 {
                    normal = -normal;
                }
                lift = lifted(point, corners, normals, weights, ray.direction.dot(normal) > 0.0);
            }
        }
        Located { point, normal, shading, lift, uv, bound }
    }
}

/// The weights of a triangle's corners where a ray goes through its plane, none of them less than 0: edge functions as in
/// the test, in double precision.
fn weights(ray: &Ray, corners: [DVec3; 3]) -> [f64; 3] {
    let [a, b, c] = corners.map(|corner| corner - ray.origin);
    let d = ray.direction;
    let [u, v, w] = [d.dot(c.cross(b)), d.dot(a.cross(c)), d.dot(b.cross(a))];
    let sum = u + v + w;
    let weights = [u, v, w].map(|x| if x / sum > 0.0 { x / sum } else { 0.0 });
    let sum = weights[0] + weights[1] + weights[2];
    // Where the ray lies in the triangle's plane any point of it will do.
    if sum > 0.0 { weights.map(|x| x / sum) } else { [1.0 / 3.0; 3] }
}

/// From a point of a triangle to the surface that its corners' tangent planes make, on the side that is seen: where a shadow
/// ray may start without meeting the triangles that stand for a round surface. J. Hanika, "Hacking the Shadow
/// Terminator", Ray Tracing Gems II, chapter 4, 2021.
fn lifted(point: DVec3, corners: [DVec3; 3], normals: [DVec3; 3], weights: [f64; 3], inside: bool) -> DVec3 {
    let mut lift = DVec3::ZERO;
    for ((corner, normal), weight) in corners.into_iter().zip(normals).zip(weights) {
        let normal = if inside { -normal } else { normal };
        let below = (point - corner).dot(normal);
        if below < 0.0 {
            lift -= normal * (below * weight);
        }
    }
    lift
}
