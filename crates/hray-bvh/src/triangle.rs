//! The watertight test of a ray against triangles, four at a time.
//!
//! Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013: the triangle is moved and sheared so that
//! the ray is the positive z-axis, and the signs of three edge functions tell whether it goes through. What is done to a
//! vertex depends on the ray and the vertex alone, and an edge function changes nothing but its sign when the edge's
//! ends are exchanged, because its products are rounded alike and no operation is fused. So of two triangles that share
//! an edge at least one is hit where the ray meets it. Where a function is 0 (or was rounded to it) the edge counts as
//! inside for both.
//!
//! Rounding never gives an edge function the wrong sign, but 0 for a small one; and where a triangle is seen from the side,
//! what remains of small ones is not worth much. Such triangles are tested again in double precision, where both are
//! exact. What that leaves of errors is less than what boxes are widened by ([`Ray::new`]).

use crate::Ray;
use fearless_simd::f32x4;
use fearless_simd::prelude::*;

/// A product in an edge function that is more than so many times the determinant is taken for imprecise.
const FLAT: f32 = 8.0;

/// Up to four triangles. Those that are missing have no numbers for coordinates, and are never hit.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Vertex, axis, triangle.
    pub(crate) vertices: [[[f32; 4]; 3]; 3],
    /// Their numbers in the mesh.
    pub(crate) numbers: [u32; 4],
}

impl PartialEq for Block {
    /// By bits, because those that are missing have no numbers for coordinates.
    fn eq(&self, other: &Self) -> bool {
        let bits = |block: &Self| block.vertices.map(|vertex| vertex.map(|axis| axis.map(f32::to_bits)));
        self.numbers == other.numbers && bits(self) == bits(other)
    }
}

impl Block {
    pub(crate) const EMPTY: Self = Self { vertices: [[[f32::NAN; 4]; 3]; 3], numbers: [u32::MAX; 4] };
}

/// A ray's shear to the z-axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shear {
    axes: [usize; 3],
    origin: [f32; 3],
    shear: [f32; 3],
}

impl Shear {
    /// Without branches, which a random direction would mislead, and without divisions: the ray has the reciprocals already.
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        let [x, y, z] = ray.direction.map(f32::abs);
        let of_two = usize::from(y > x);
        let last = if x.max(y) > z { of_two } else { 2 };
        // No exchange where the direction is negative: both windings count, so the sign of the determinant does not matter.
        let first = if last == 2 { 0 } else { last + 1 };
        let second = if first == 2 { 0 } else { first + 1 };
        let axes = [first, second, last];
        let scale = ray.inverse[last];
        let shear = [ray.direction[first] * scale, ray.direction[second] * scale, scale];
        Self { axes, origin: axes.map(|axis| ray.origin[axis]), shear }
    }
}

/// What a ray meets in a block: which triangles, at which distances, with which weights of the second and third vertex.
pub(crate) struct BlockHits<S: Simd> {
    pub(crate) mask: u32,
    pub(crate) distance: f32x4<S>,
    pub(crate) weights: [f32x4<S>; 2],
}

/// Tests a block, for distances from `near` up to `far`, both included. Nothing where no triangle is met.
#[inline(always)]
pub(crate) fn hits<S: Simd>(
    simd: S,
    block: &Block,
    shear: &Shear,
    near: f32,
    far: f32,
) -> Option<BlockHits<S>> {
    let [kx, ky, kz] = shear.axes;
    let [sx, sy, sz] = shear.shear;
    let [ox, oy, oz] = shear.origin;
    let [a, b, c] = &block.vertices;
    let az = from(simd, a, kz, oz);
    let bz = from(simd, b, kz, oz);
    let cz = from(simd, c, kz, oz);
    let (ax, ay) = (from(simd, a, kx, ox) - az * sx, from(simd, a, ky, oy) - az * sy);
    let (bx, by) = (from(simd, b, kx, ox) - bz * sx, from(simd, b, ky, oy) - bz * sy);
    let (cx, cy) = (from(simd, c, kx, ox) - cz * sx, from(simd, c, ky, oy) - cz * sy);
    let (along_u, along_v, along_w) = (cx * by, ax * cy, bx * ay);
    let u = along_u - cy * bx;
    let v = along_v - ay * cx;
    let w = along_w - by * ax;
    let zero = f32x4::splat(simd, 0.0);
    let inside = (u.simd_ge(zero) & v.simd_ge(zero) & w.simd_ge(zero))
        | (u.simd_le(zero) & v.simd_le(zero) & w.simd_le(zero));
    if inside.to_bitmask() == 0 {
        return None;
    }
    let determinant = u + v + w;
    let greatest = along_u.abs().max(along_v.abs()).max(along_w.abs());
    let flat = inside & greatest.simd_gt(determinant.abs() * FLAT);
    if flat.to_bitmask() != 0 {
        let vertices = [[ax, ay, az], [bx, by, bz], [cx, cy, cz]].map(|vertex| vertex.map(f32x4::into));
        let Exact { mask, distance, weights } = exact(&vertices, inside.to_bitmask() as u32, sz, near, far);
        let weights = weights.map(|weights| weights.simd_into(simd));
        return (mask != 0).then_some(BlockHits { mask, distance: distance.simd_into(simd), weights });
    }
    let scale = f32x4::splat(simd, 1.0) / determinant;
    let distance = (u * az + v * bz + w * cz) * sz * scale;
    // A triangle that is a point or a line on an axis has a determinant of 0; what is divided by it is no distance between
    // the bounds.
    let mask = inside & distance.simd_ge(near) & distance.simd_le(far);
    let mask = mask.to_bitmask() as u32;
    (mask != 0).then_some(BlockHits { mask, distance, weights: [v * scale, w * scale] })
}

/// The same without registers, which a function that is called would have to hand over in memory.
struct Exact {
    mask: u32,
    distance: [f32; 4],
    weights: [[f32; 4]; 2],
}

/// The same for the triangles of `lanes`, in double precision: there products of singles are exact, hence signs are, and
/// weights are as good as the vertices.
#[cold]
#[inline(never)]
fn exact(vertices: &[[[f32; 4]; 3]; 3], lanes: u32, scale_z: f32, near: f32, far: f32) -> Exact {
    let (mut mask, mut distance, mut weights) = (0, [0.0; 4], [[0.0; 4]; 2]);
    for lane in 0..4 {
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] =
            vertices.map(|vertex| vertex.map(|axis| f64::from(axis[lane])));
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let determinant = u + v + w;
        distance[lane] = ((u * az + v * bz + w * cz) / determinant * f64::from(scale_z)) as f32;
        weights[0][lane] = (v / determinant) as f32;
        weights[1][lane] = (w / determinant) as f32;
        let between = distance[lane] >= near && distance[lane] <= far;
        mask |= u32::from(inside && between) << lane;
    }
    mask &= lanes;
    Exact { mask, distance, weights }
}

/// A coordinate of a block's vertices, from the ray's origin on.
#[inline(always)]
fn from<S: Simd>(simd: S, vertex: &[[f32; 4]; 3], axis: usize, origin: f32) -> f32x4<S> {
    let column: f32x4<S> = vertex[axis].simd_into(simd);
    column - origin
}
