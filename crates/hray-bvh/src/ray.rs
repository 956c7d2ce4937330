//! A ray, made ready for boxes.

use fearless_simd::f32x4;
use fearless_simd::prelude::*;

/// How far, in units of the greatest coordinate involved, rounding may move the result of a leaf's test or of a box's. A leaf
/// test rounds a dozen times (2^-24 each); the rest is margin for a ray that was rounded from doubles.
pub(crate) const SLACK: f32 = 1.0 / (1u32 << 20) as f32;

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
    /// One that meets nothing.
    pub const NOWHERE: Self = Self {
        origin: [0.0; 3],
        direction: [0.0; 3],
        near: 1.0,
        far: 0.0,
        inverse: [0.0; 3],
        offset: [[0.0; 3]; 2],
        down: [0; 3],
    };

    /// Makes a ray ready for boxes.
    ///
    /// Each axis' slab is widened by `SLACK` times the greatest coordinate in play: the reciprocal, the product and the sum
    /// that give the distance of a plane together move it by no more than a few units in the last place of that, and
    /// so does the test in a leaf, which takes coordinates relative to the ray's origin. Along the axis in which the ray goes
    /// farthest, the widening is at least the error of a distance that a leaf finds; so a box is never left out though a hit
    /// in it would count (compare Ize, Robust BVH Ray Traversal, JCGT 2013, who widens by units in the last place of the
    /// distance, for exact leaves).
    ///
    /// Where the numbers leave the range of single precision, the ray meets nothing ([`Ray::is_sane`]).
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
        let from: f32x4<S> = [origin[0], origin[1], origin[2], 0.0].simd_into(simd);
        let along: f32x4<S> = along.simd_into(simd);
        let inverse = f32x4::splat(simd, 1.0) / along;
        let centre = from * inverse;
        let widen = inverse.abs() * slack;
        let first = -(centre + widen);
        let last = widen - centre;
        // What is no number would meet even the boxes of nothing.
        let sane = (first.abs() + last.abs()).simd_lt(f32::INFINITY).all_true();
        let down = along.simd_lt(0.0).to_bitmask() as usize;
        Self {
            origin,
            direction,
            near,
            // An endless distance would let that of a flat triangle pass.
            far: if sane { far.min(f32::MAX) } else { f32::NEG_INFINITY },
            inverse: three(inverse),
            offset: [three(first), three(last)],
            down: [down & 1, (down >> 1) & 1, (down >> 2) & 1],
        }
    }
}

impl Ray {
    /// Whether the ray is one that can meet anything: its numbers are in the range of single precision.
    #[inline(always)]
    #[must_use]
    pub fn is_sane(&self) -> bool {
        self.far > f32::NEG_INFINITY
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
