//! The watertight test of a ray against triangles, four at a time.
//!
//! Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*, JCGT 2(1), 2013: the triangle is moved and sheared so that
//! the ray is the positive z-axis, and the signs of three edge functions tell whether it goes through. What is done to a
//! vertex depends on the ray and the vertex alone, and an edge function changes nothing but its sign when the edge's
//! ends are exchanged, because its products are rounded alike and no operation is fused. So of two triangles that share
//! an edge at least one is hit where the ray meets it. Where a function is 0 (or was rounded to it) the edge counts as
//! inside for both.

use crate::Ray;
use fearless_simd::f32x4;
use fearless_simd::prelude::*;

/// Up to four triangles. Those that are missing have no numbers for coordinates, and are never hit.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Vertex, axis, triangle.
    pub(crate) vertices: [[[f32; 4]; 3]; 3],
    /// Their numbers in the mesh.
    pub(crate) numbers: [u32; 4],
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
    #[inline(always)]
    pub(crate) fn new(ray: &Ray) -> Self {
        let [x, y, z] = ray.direction.map(f32::abs);
        let last = if x > y {
            if x > z { 0 } else { 2 }
        } else if y > z {
            1
        } else {
            2
        };
        // No exchange where the direction is negative: both windings count, so the sign of the determinant does not matter.
        let axes = [[1, 2, 0], [2, 0, 1], [0, 1, 2]][last];
        let [dx, dy, dz] = axes.map(|axis| ray.direction[axis]);
        Self { axes, origin: axes.map(|axis| ray.origin[axis]), shear: [dx / dz, dy / dz, 1.0 / dz] }
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
    let u = cx * by - cy * bx;
    let v = ax * cy - ay * cx;
    let w = bx * ay - by * ax;
    let zero = f32x4::splat(simd, 0.0);
    let inside = (u.simd_ge(zero) & v.simd_ge(zero) & w.simd_ge(zero))
        | (u.simd_le(zero) & v.simd_le(zero) & w.simd_le(zero));
    if inside.to_bitmask() == 0 {
        return None;
    }
    let determinant = u + v + w;
    let scale = f32x4::splat(simd, 1.0) / determinant;
    let distance = (u * az + v * bz + w * cz) * sz * scale;
    // A flat triangle has a determinant of 0, and what is divided by it is no distance between the bounds.
    let mask = inside & distance.simd_ge(near) & distance.simd_le(far);
    let mask = mask.to_bitmask() as u32;
    (mask != 0).then_some(BlockHits { mask, distance, weights: [v * scale, w * scale] })
}

/// A coordinate of a block's vertices, from the ray's origin on.
#[inline(always)]
fn from<S: Simd>(simd: S, vertex: &[[f32; 4]; 3], axis: usize, origin: f32) -> f32x4<S> {
    let column: f32x4<S> = vertex[axis].simd_into(simd);
    column - origin
}
