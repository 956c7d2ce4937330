//! A ray, made ready for boxes.

use crate::Bounds;

/// How far, in units of the greatest coordinate involved, rounding may move the result of a leaf's test or of a box's. A leaf
/// test rounds a dozen times (2^-24 each); the rest is margin for a ray that was rounded from doubles.
const SLACK: f32 = 1.0 / (1u32 << 20) as f32;

/// Components of a direction are not taken to be less than this share of the greatest one: their reciprocals stay finite.
const FLATTEST: f32 = 1e-18;

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
    /// Makes a ray ready for things in `bounds`.
    ///
    /// Each axis' slab is widened by `SLACK` times the greatest coordinate in play: the reciprocal, the product and the sum
    /// that give the distance of a plane together move it by no more than a few units in the last place of that, and
    /// so does the test in a leaf, which takes coordinates relative to the ray's origin. Along the axis in which the ray goes
    /// farthest, the widening is at least the error of a distance that a leaf finds; so a box is never left out though a hit
    /// in it would count (compare Ize, Robust BVH Ray Traversal, JCGT 2013, who widens by units in the last place of the
    /// distance, for exact leaves).
    #[inline(always)]
    #[must_use]
    pub fn new(origin: [f32; 3], direction: [f32; 3], near: f32, far: f32, bounds: &Bounds) -> Self {
        let greatest = |v: [f32; 3]| v[0].abs().max(v[1].abs()).max(v[2].abs());
        let slack = SLACK * (bounds.reach() + greatest(origin));
        let flattest = FLATTEST * greatest(direction);
        let (mut inverse, mut offset, mut down) = ([0.0; 3], [[0.0; 3]; 2], [0; 3]);
        for axis in 0..3 {
            let d = direction[axis];
            let d = if d.abs() < flattest { flattest.copysign(d) } else { d };
            let inv = 1.0 / d;
            let widen = (slack * inv).abs();
            let centre = -origin[axis] * inv;
            inverse[axis] = inv;
            offset[0][axis] = centre - widen;
            offset[1][axis] = centre + widen;
            down[axis] = usize::from(inv < 0.0);
        }
        // An endless distance would let that of a flat triangle pass.
        Self { origin, direction, near, far: far.min(f32::MAX), inverse, offset, down }
    }
}
