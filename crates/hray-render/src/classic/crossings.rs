//! Where rays go into closed meshes and out of them.
//!
//! How often a triangle goes around the ray is counted by its edges, which are seen along the ray: an edge counts where it
//! crosses a half-line from the ray. Whether it does is told by the sides that its ends are on, and by the sign of one
//! function, which the same edge of the next triangle has the other way round, to the bit. So all triangles of a closed
//! mesh together go around a ray 0 times, however its edges and vertices are hit. (The sum over edges is the winding number;
//! that it needs nothing but consistent signs is why no ray slips through.)

use super::mesh::PreparedMesh;
use super::solid::Ray;
use fearless_simd::Simd;
use hray_bvh::Stack;
use hray_core::DVec3;

impl PreparedMesh {
    /// Where a ray goes into the mesh and out of it, beyond a distance and in ascending order, and whether it is inside there.
    /// Sensible for meshes without open edges alone; inside is around what the surface goes.
    #[inline(always)]
    pub(super) fn crossings<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        nearest: f64,
        stack: &mut Stack,
        crossings: &mut Vec<Crossing>,
    ) -> bool {
        self.meet(simd, ray, nearest, stack, crossings);
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

    /// Where a ray goes through triangles of whatever mesh, beyond a distance and in whatever order.
    #[inline(always)]
    pub(super) fn meet<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        nearest: f64,
        stack: &mut Stack,
        crossings: &mut Vec<Crossing>,
    ) {
        crossings.clear();
        let seen = Seen::new(ray);
        let narrowed = self.narrowed(simd, ray, [0.0, f64::INFINITY]);
        self.tree().candidates(simd, &narrowed, stack, |triangle| {
            if let Some((at, turns)) = seen.around(self.corners(triangle))
                && at > nearest
            {
                crossings.push(Crossing { at, turns, triangle });
            }
        });
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
        // Rounding may lead out of the triangle: a little at its edges, anywhere where it is seen from the side.
        let depth = depth.max(near).min(far);
        Some((depth * self.scale, if self.scale > 0.0 { -turns } else { turns }))
    }
}
