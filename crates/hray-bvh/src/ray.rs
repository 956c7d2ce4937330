//! A ray, made ready for boxes.

use fearless_simd::f32x4;
use fearless_simd::prelude::*;

/// How far, as a share of the greatest coordinates involved, rounding may move what a leaf's test finds, or a box.
///
/// Let e be 2^-24, and A the greatest coordinate of the origin plus that of the things. The test of triangles moves a vertex by
/// up to 7 e A, sheared. A product in an edge function is at most 9 times the determinant (`FLAT`, and the determinant itself), so
/// the weights move the point that a ray meets by 6 e times 9 times the sheared triangle's size, up to 4 A: 216 e A. The
/// distance of that is rounded a few times, 10 e A, and the distance of a box's face as well, 5 e A. Together that is less than
/// 256 e A.
pub const SLACK: f32 = 1.0 / (1u32 << 16) as f32;

/// Components of a direction are not taken to be less than this share of the greatest one: their reciprocals stay finite.
pub(crate) const FLATTEST: f32 = 1e-18;

/// A ray in single precision, with what the test of boxes needs.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Where it goes; of any length but 0.
    pub direction: [f32; 3],
    /// Distances count from here, in units of the direction's length.
    pub near: f32,
    /// Up to here.
    pub far: f32,
    /// Reciprocals of the direction.
    pub(crate) inverse: [f32; 3],
    /// What is added to `plane * inverse` for the planes that a ray comes to first, and for those it comes to last.
    pub(crate) offset: [[f32; 3]; 2],
    /// 1 for axes along which the ray goes down.
    pub(crate) down: [usize; 3],
}

impl Ray {
    /// Makes a ray ready for boxes.
    ///
    /// Each axis' slab is widened by `SLACK` times the greatest coordinates in play: by more than rounding moves a hit that a
    /// leaf's test finds out of the hit thing's box, plus what it moves the box's faces. So a box is never left out though a
    /// hit in it would count (compare Ize, Robust BVH Ray Traversal, JCGT 2013, who widens by units in the last place of
    /// the distance, for exact leaves).
    ///
    /// Rays that no box can be tested against meet nothing: those with an origin or a direction that is no number, or with a
    /// direction that is 0 or less than about 1e-20 times the coordinates.
    ///
    /// `reach` is the greatest coordinate of the things ([`Bounds::reach`](crate::Bounds::reach)).
    #[inline(always)]
    #[must_use]
    pub fn new<S: Simd>(
        simd: S,
        origin: [f32; 3],
        direction: [f32; 3],
        near: f32,
        far: f32,
        reach: f32,
    ) -> Self {
        let slack = SLACK * (reach + greatest(origin));
        let flattest = FLATTEST * greatest(direction);
        let along = [direction[0], direction[1], direction[2], 1.0].map(
            #[inline(always)]
            |d| if d.abs() < flattest { flattest.copysign(d) } else { d },
        );
        let from: f32x4<S> = [origin[0], origin[1], origin[2], near].simd_into(simd);
        let along: f32x4<S> = along.simd_into(simd);
        let inverse = f32x4::splat(simd, 1.0) / along;
        let centre = from * inverse;
        let widen = inverse.abs() * slack;
        let first = -(centre + widen);
        let last = widen - centre;
        let down = along.simd_lt(0.0).to_bitmask() as usize;
        // Where something is no number or too great, the ray meets nothing; it could meet boxes that are not there.
        let finite = ((centre.abs() + widen + along.abs()) * 0.0).simd_eq(0.0).to_bitmask() == 0b1111;
        Self {
            origin,
            direction,
            near,
            // An endless distance would let that of a flat triangle pass.
            far: if finite { far.min(f32::MAX) } else { -1.0 },
            inverse: three(inverse),
            offset: [three(first), three(last)],
            down: [down & 1, (down >> 1) & 1, (down >> 2) & 1],
        }
    }
}

#[inline(always)]
fn three<S: Simd>(lanes: f32x4<S>) -> [f32; 3] {
    let [x, y, z, _]: [f32; 4] = lanes.into();
    [x, y, z]
}

/// The greatest magnitude of a component.
#[inline(always)]
fn greatest([x, y, z]: [f32; 3]) -> f32 {
    let larger = if x.abs() > y.abs() { x.abs() } else { y.abs() };
    if larger > z.abs() { larger } else { z.abs() }
}
