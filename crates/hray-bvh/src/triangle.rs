//! The watertight test of a ray against triangles, eight at a time.
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

use crate::{Bounds, Ray};
use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout};

/// A product in an edge function that is more than so many times the determinant is taken for imprecise.
const FLAT: f32 = 8.0;

/// How many triangles are tested at once.
pub(crate) const LANES: usize = 8;

/// The number of a triangle that is missing.
pub(crate) const NO_TRIANGLE: u32 = u32::MAX;

/// Up to eight triangles, in five cache lines. Those that are missing have no numbers for coordinates, and are never hit.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, FromBytes, IntoBytes, Immutable, KnownLayout)]
pub(crate) struct Block {
    /// Vertex, axis, triangle.
    pub(crate) vertices: [[[f32; LANES]; 3]; 3],
    /// Their numbers in the mesh.
    pub(crate) numbers: [u32; LANES],
}

impl PartialEq for Block {
    /// By bits, because those that are missing have no numbers for coordinates.
    fn eq(&self, other: &Self) -> bool {
        let bits = |block: &Self| block.vertices.map(|vertex| vertex.map(|axis| axis.map(f32::to_bits)));
        self.numbers == other.numbers && bits(self) == bits(other)
    }
}

impl Block {
    pub(crate) const EMPTY: Self =
        Self { vertices: [[[f32::NAN; LANES]; 3]; 3], numbers: [NO_TRIANGLE; LANES] };

    /// Puts a triangle into a lane.
    #[inline(always)]
    pub(crate) fn set(&mut self, lane: usize, number: u32, corners: [[f32; 3]; 3]) {
        self.numbers[lane] = number;
        for (corner, place) in corners.iter().enumerate() {
            for (axis, x) in place.iter().enumerate() {
                self.vertices[corner][axis][lane] = *x;
            }
        }
    }

    /// Its triangles that can be hit.
    pub(crate) fn present(&self) -> impl Iterator<Item = u32> {
        self.numbers.iter().zip(&self.vertices[0][0]).filter(|(_, x)| !x.is_nan()).map(|(number, _)| *number)
    }

    /// The box of its triangles; comparisons leave out what is no number.
    pub(crate) fn bounds(&self) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for corner in &self.vertices {
            for (axis, column) in corner.iter().enumerate() {
                for &x in column {
                    bounds.min[axis] = if x < bounds.min[axis] { x } else { bounds.min[axis] };
                    bounds.max[axis] = if x > bounds.max[axis] { x } else { bounds.max[axis] };
                }
            }
        }
        bounds
    }
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
    pub(crate) distance: f32x8<S>,
    pub(crate) weights: [f32x8<S>; 2],
}

/// Tests a block, for distances from `near` up to `far`, both included. Nothing where no triangle is met. What is found of
/// a triangle does not depend on which others are in the block.
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
    let zero = f32x8::splat(simd, 0.0);
    let inside = (u.simd_ge(zero) & v.simd_ge(zero) & w.simd_ge(zero))
        | (u.simd_le(zero) & v.simd_le(zero) & w.simd_le(zero));
    if inside.to_bitmask() == 0 {
        return None;
    }
    let determinant = u + v + w;
    let greatest = along_u.abs().max(along_v.abs()).max(along_w.abs());
    let flat = inside & greatest.simd_gt(determinant.abs() * FLAT);
    let scale = f32x8::splat(simd, 1.0) / determinant;
    let distance = (u * az + v * bz + w * cz) * sz * scale;
    // A triangle that is a point or a line on an axis has a determinant of 0; what is divided by it is no distance between
    // the bounds.
    let mask = inside & distance.simd_ge(near) & distance.simd_le(far);
    let mask = mask.to_bitmask() as u32;
    let weights = [v * scale, w * scale];
    let flat = flat.to_bitmask() as u32;
    if flat != 0 {
        let vertices = [[ax, ay, az], [bx, by, bz], [cx, cy, cz]].map(|vertex| vertex.map(f32x8::into));
        let mut found = Exact { mask, distance: distance.into(), weights: weights.map(f32x8::into) };
        exact(&vertices, flat, sz, [near, far], &mut found);
        let Exact { mask, distance, weights } = found;
        let weights = weights.map(|weights| weights.simd_into(simd));
        return (mask != 0).then_some(BlockHits { mask, distance: distance.simd_into(simd), weights });
    }
    (mask != 0).then_some(BlockHits { mask, distance, weights })
}

/// The same without registers, which a function that is called would have to hand over in memory.
struct Exact {
    mask: u32,
    distance: [f32; LANES],
    weights: [[f32; LANES]; 2],
}

/// Puts what double precision finds of the triangles of `lanes` in place of what single precision does: there products of
/// singles are exact, hence signs are, and weights are as good as the vertices.
#[cold]
#[inline(never)]
fn exact(
    vertices: &[[[f32; LANES]; 3]; 3],
    lanes: u32,
    scale_z: f32,
    [near, far]: [f32; 2],
    found: &mut Exact,
) {
    let mut lanes = lanes;
    while lanes != 0 {
        let lane = (lanes.trailing_zeros() & 7) as usize;
        lanes &= lanes - 1;
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] =
            vertices.map(|vertex| vertex.map(|axis| f64::from(axis[lane])));
        let u = cx * by - cy * bx;
        let v = ax * cy - ay * cx;
        let w = bx * ay - by * ax;
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let determinant = u + v + w;
        let distance = ((u * az + v * bz + w * cz) / determinant * f64::from(scale_z)) as f32;
        found.distance[lane] = distance;
        found.weights[0][lane] = (v / determinant) as f32;
        found.weights[1][lane] = (w / determinant) as f32;
        let met = inside && distance >= near && distance <= far;
        found.mask = found.mask & !(1 << lane) | u32::from(met) << lane;
    }
}

/// A coordinate of a block's vertices, from the ray's origin on.
#[inline(always)]
fn from<S: Simd>(simd: S, vertex: &[[f32; LANES]; 3], axis: usize, origin: f32) -> f32x8<S> {
    let column: f32x8<S> = vertex[axis].simd_into(simd);
    column - origin
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    /// What [`hits`] has to find of one triangle: distance and weights.
    fn scalar(corners: [[f32; 3]; 3], ray: &Ray) -> Option<[f32; 3]> {
        let Shear { axes: [kx, ky, kz], shear: [sx, sy, sz], .. } = Shear::new(ray);
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners.map(|corner| {
            let [x, y, z] = [kx, ky, kz].map(|axis| corner[axis] - ray.origin[axis]);
            [x - z * sx, y - z * sy, z]
        });
        let [u, v, w] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
        let inside = |u, v, w| (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        if !inside(f64::from(u), f64::from(v), f64::from(w)) {
            return None;
        }
        let determinant = u + v + w;
        let found = if [cx * by, ax * cy, bx * ay].iter().any(|along| along.abs() > determinant.abs() * FLAT)
        {
            let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] =
                [[ax, ay, az], [bx, by, bz], [cx, cy, cz]].map(|corner| corner.map(f64::from));
            let [u, v, w] = [cx * by - cy * bx, ax * cy - ay * cx, bx * ay - by * ax];
            if !inside(u, v, w) {
                return None;
            }
            let determinant = u + v + w;
            let distance = (u * az + v * bz + w * cz) / determinant * f64::from(sz);
            [distance as f32, (v / determinant) as f32, (w / determinant) as f32]
        } else {
            let scale = 1.0 / determinant;
            [(u * az + v * bz + w * cz) * sz * scale, v * scale, w * scale]
        };
        (found[0] >= ray.near && found[0] <= ray.far).then_some(found)
    }

    #[inline(always)]
    fn each<S: Simd>(simd: S, block: &Block, ray: &Ray) -> [Option<[u32; 3]>; LANES] {
        let mut found = [None; LANES];
        if let Some(hits) = hits(simd, block, &Shear::new(ray), ray.near, ray.far) {
            let [v, w] = hits.weights;
            for (lane, found) in found.iter_mut().enumerate() {
                let met = hits.mask >> lane & 1 != 0;
                *found = met.then(|| [hits.distance[lane], v[lane], w[lane]].map(f32::to_bits));
            }
        }
        found
    }

    #[test]
    fn eight_at_a_time_are_tested_like_one() {
        let mut state = 7u64;
        let mut next = move || {
            // Knuth's generator (The Art of Computer Programming, volume 2, section 3.3.4).
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1 << 23) as f32 - 1.0
        };
        let (mut met, mut flat) = (0, 0);
        for round in 0..40_000 {
            // On a grid often, so that edges are met and triangles are seen from the side.
            let grid = [0.0, 2.0, 4.0, 16.0][round % 4];
            let mut point = || {
                [next(), next(), next()]
                    .map(|x: f32| if grid > 0.0 { libm::roundf(x * grid) / grid } else { x })
            };
            let mut block = Block::EMPTY;
            let count = 1 + round % LANES;
            let corners: Vec<[[f32; 3]; 3]> = (0..count).map(|_| [0; 3].map(|_| point())).collect();
            for (lane, corners) in corners.iter().enumerate() {
                block.set(lane, lane as u32, *corners);
            }
            let (origin, direction) = (point(), point());
            // Along the first triangle's plane, now and then.
            let direction = if round % 7 == 0 {
                [0, 1, 2].map(|axis| corners[0][0][axis] - origin[axis])
            } else {
                direction
            };
            if direction == [0.0; 3] {
                continue;
            }
            let ray = dispatch!(Level::baseline(), simd => Ray::new(simd, origin, direction, 0.0, 3.0, 1.0));
            let expected: [Option<[u32; 3]>; LANES] = std::array::from_fn(|lane| {
                let corners = corners.get(lane)?;
                scalar(*corners, &ray).map(|found| found.map(f32::to_bits))
            });
            met += expected.iter().flatten().count();
            flat += usize::from(round % 7 == 0 && expected[0].is_some());
            for level in [Level::baseline(), Level::new()] {
                let found = dispatch!(level, simd => each(simd, &block, &ray));
                assert_eq!(found, expected, "{block:?} {ray:?}");
            }
        }
        assert!(met > 5_000 && flat > 100, "{met} {flat}");
    }
}
