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

    /// Where a ray goes into the mesh and out of it, beyond a distance and in ascending order, and whether it is inside there.
    /// Sensible for meshes without open edges alone; inside is around what the surface goes.
    ///
    /// How often a triangle goes around the ray is counted by its edges, which are seen along the ray: an edge counts where it
    /// crosses a half-line from the ray. Whether it does is told by the sides that its ends are on, and by the sign of one
    /// function, which the same edge of the next triangle has the other way round, to the bit. So all triangles of a closed
    /// mesh together go around a ray 0 times, however its edges and vertices are hit.
    #[inline(always)]
    pub(super) fn crossings<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        nearest: f64,
        stack: &mut Stack,
        crossings: &mut Vec<Crossing>,
    ) -> bool {
        crossings.clear();
        let seen = Seen::new(ray);
        let narrowed = self.narrowed(simd, ray, [0.0, f64::INFINITY]);
        self.tree.candidates(simd, &narrowed, stack, |triangle| {
            if let Some((at, turns)) = seen.around(self.corners(triangle))
                && at > nearest
            {
                crossings.push(Crossing { at, turns, triangle });
            }
        });
        // In whatever order they were found.
        crossings.sort_unstable_by(|a, b| a.at.total_cmp(&b.at).then(a.triangle.cmp(&b.triangle)));
        let mut around = -crossings.iter().map(|crossing| crossing.turns).sum::<i32>();
        let starts_inside = around != 0;
        let (mut from, mut kept) = (0, 0);
        while let Some(&first) = crossings.get(from) {
            let together = crossings[from..].partition_point(|crossing| crossing.at <= first.at);
            let before = around;
            around += crossings[from..from + together].iter().map(|crossing| crossing.turns).sum::<i32>();
            if (before == 0) != (around == 0) {
                crossings[kept] = Crossing { turns: i32::from(around != 0), ..first };
                kept += 1;
            }
            from += together;
        }
        crossings.truncate(kept);
        starts_inside
    }

    #[inline(always)]
    fn narrowed<S: Simd>(&self, simd: S, ray: &Ray, [near, far]: [f64; 2]) -> hray_bvh::Ray {
        let [o, d] = [ray.origin, ray.direction].map(|v| v.to_array().map(|x| x as f32));
        // Distance 0 is where the ray comes from.
        let near = f32::MIN_POSITIVE.max(near as f32);
        hray_bvh::Ray::new(simd, o, d, near, far as f32, self.tree.reach())
    }

    fn corners(&self, triangle: u32) -> [DVec3; 3] {
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

/// Where a ray goes through a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) at: f64,
    /// How much more often the surface goes around the ray from here on; in the end, 1 where the ray goes in and 0 where it
    /// goes out.
    pub(super) turns: i32,
    pub(super) triangle: u32,
}

/// A ray as what it looks along: Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013, in double
/// precision.
struct Seen {
    origin: DVec3,
    axes: [usize; 3],
    shear: [f64; 2],
    scale: f64,
}

impl Seen {
    fn new(ray: &Ray) -> Self {
        let Ray { origin, direction: d } = *ray;
        let last = if d.z.abs() >= d.x.abs() && d.z.abs() >= d.y.abs() {
            2
        } else {
            usize::from(d.y.abs() > d.x.abs())
        };
        let axes = [(last + 1) % 3, (last + 2) % 3, last];
        let scale = 1.0 / d[last];
        Self { origin, axes, shear: [d[axes[0]] * scale, d[axes[1]] * scale], scale }
    }

    /// At which distance a triangle is gone through, and how often it goes around the ray, less for a front.
    fn around(&self, corners: [DVec3; 3]) -> Option<(f64, i32)> {
        let [a, b, c] = corners.map(|corner| {
            let p = corner - self.origin;
            let [x, y, z] = self.axes.map(|axis| p[axis]);
            [x - self.shear[0] * z, y - self.shear[1] * z, z]
        });
        let side = |[px, py, _]: [f64; 3], [qx, qy, _]: [f64; 3]| px * qy - py * qx;
        let crosses = |p: [f64; 3], q: [f64; 3], side: f64| match (p[1] < 0.0, q[1] < 0.0) {
            (true, false) if side > 0.0 => 1,
            (false, true) if side < 0.0 => -1,
            _ => 0,
        };
        let [u, v, w] = [side(b, c), side(c, a), side(a, b)];
        let turns = crosses(b, c, u) + crosses(c, a, v) + crosses(a, b, w);
        if turns == 0 {
            return None;
        }
        let [near, far] = [a[2].min(b[2]).min(c[2]), a[2].max(b[2]).max(c[2])];
        let depth = (u * a[2] + v * b[2] + w * c[2]) / (u + v + w);
        // Where a triangle is seen from the side, rounding may lead out of it.
        let depth = if depth >= near && depth <= far { depth } else { 0.5 * (near + far) };
        Some((depth * self.scale, if self.scale > 0.0 { -turns } else { turns }))
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
