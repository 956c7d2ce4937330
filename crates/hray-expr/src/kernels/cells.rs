//! Worley's cellular texture, several points at a time, in the bits of [`crate::cells()`].
//!
//! The cells around a point are visited from near to far, and those are passed over that are too far, for every
//! lane, to hold anything nearer than the second nearest so far. The bounds are computed with the operations of the
//! distances, so rounding cannot make a bound exceed a distance.

use super::lanes::{Lanes, MAX_LANES, Mask, Vec3};
use crate::apply::{mix, unit};
use crate::cells::{AROUND, IDENTITY, NEAR, STRIDES};
use crate::noise::LOW_BITS;
use fearless_simd::prelude::*;

/// The nearest feature points so far.
#[derive(Clone, Copy)]
struct Nearest<S: Simd> {
    /// The squared distance of the nearest and of the second.
    first: Lanes<S>,
    second: Lanes<S>,
    /// Of the nearest.
    hash: S::u64s,
    vector: Vec3<S>,
}

/// The distances to the nearest and the second nearest feature point, the number of the nearest, and the vector to
/// it.
#[inline(always)]
pub fn cells<S: Simd>(simd: S, seed: u64, p: Vec3<S>) -> [Lanes<S>; 6] {
    let infinite = Lanes::<S>::splat(simd, f64::INFINITY);
    let zero = Lanes::<S>::splat(simd, 0.0);
    let floor = Vec3::<S> { x: p.x.floor(), y: p.y.floor(), z: p.z.floor() };
    let fraction = p.sub(floor);
    let own = number::<S>(floor.x) * STRIDES[0]
        + number::<S>(floor.y) * STRIDES[1]
        + number::<S>(floor.z) * STRIDES[2]
        + S::u64s::splat(simd, mix(seed));
    let (low_x, low_y, low_z) =
        (bounds(simd, fraction.x), bounds(simd, fraction.y), bounds(simd, fraction.z));
    let mut nearest = Nearest::<S> {
        first: infinite,
        second: infinite,
        hash: S::u64s::splat(simd, 0),
        vector: Vec3 { x: zero, y: zero, z: zero },
    };
    for (visited, offset) in AROUND.iter().enumerate() {
        // What lies beyond is at least 1 away.
        if visited == NEAR && !nearest.second.simd_gt(1.0).any_true() {
            break;
        }
        let [x, y, z] = *offset;
        let bound = low_x[place(x)] + low_y[place(y)] + low_z[place(z)];
        if bound.simd_lt(nearest.second).any_true() {
            visit(simd, own, fraction, *offset, &mut nearest);
        }
    }
    let found: Mask<S> = nearest.first.simd_lt(infinite);
    [
        nearest.first.sqrt(),
        nearest.second.sqrt(),
        found.select(identity(simd, nearest.hash), zero),
        nearest.vector.x,
        nearest.vector.y,
        nearest.vector.z,
    ]
}

/// The place of an offset in a table from -2 to 2.
#[inline(always)]
fn place(offset: i8) -> usize {
    ((offset + 2) as usize).min(4)
}

/// Takes the feature point of one of the cells around into account.
#[inline(always)]
fn visit<S: Simd>(simd: S, own: S::u64s, fraction: Vec3<S>, offset: [i8; 3], nearest: &mut Nearest<S>) {
    let mut step = 0u64;
    for (offset, stride) in offset.iter().zip(STRIDES) {
        step = step.wrapping_add(stride.wrapping_mul(i64::from(*offset) as u64));
    }
    let hash = mixed::<S>(own + step);
    let d = Vec3::<S> {
        x: coordinate(simd, hash << 31, offset[0]) - fraction.x,
        y: coordinate(simd, hash << 10, offset[1]) - fraction.y,
        z: coordinate(simd, hash >> 11, offset[2]) - fraction.z,
    };
    let squared = d.dot(d);
    let nearer: Mask<S> = squared.simd_lt(nearest.first);
    let between: Mask<S> = squared.simd_lt(nearest.second);
    nearest.second = nearer.select(nearest.first, between.select(squared, nearest.second));
    nearest.first = nearer.select(squared, nearest.first);
    nearest.hash = nearer.select(hash, nearest.hash);
    nearest.vector = Vec3 {
        x: nearer.select(d.x, nearest.vector.x),
        y: nearer.select(d.y, nearest.vector.y),
        z: nearer.select(d.z, nearest.vector.z),
    };
}

/// The cell's offset and the feature point's place in it, from 21 bits below the exponent.
#[inline(always)]
fn coordinate<S: Simd>(simd: S, bits: S::u64s, offset: i8) -> Lanes<S> {
    let bits = (bits & (0x1F_FFFF << 31)) | S::u64s::splat(simd, 0x3FF0_0000_0000_0000);
    bits.bitcast::<Lanes<S>>() - (1.0 - f64::from(offset))
}

/// The squares of the least distances along an axis to the cells at -2 to 2.
#[inline(always)]
fn bounds<S: Simd>(simd: S, fraction: Lanes<S>) -> [Lanes<S>; 5] {
    let one = Lanes::<S>::splat(simd, 1.0);
    let (below, above) = (fraction + 1.0, one - fraction);
    let beyond = Lanes::<S>::splat(simd, 2.0) - fraction;
    [below * below, fraction * fraction, Lanes::<S>::splat(simd, 0.0), above * above, beyond * beyond]
}

/// The cell's count along an axis, as in [`crate::noise::cell`].
#[inline(always)]
fn number<S: Simd>(floor: Lanes<S>) -> S::u64s {
    (floor + LOW_BITS).bitcast()
}

/// [`mix`] in lanes.
#[inline(always)]
fn mixed<S: Simd>(z: S::u64s) -> S::u64s {
    let z = (z ^ (z >> 30)) * 0xBF58_476D_1CE4_E5B9;
    let z = (z ^ (z >> 27)) * 0x94D0_49BB_1331_11EB;
    z ^ (z >> 31)
}

#[inline(always)]
fn identity<S: Simd>(simd: S, hash: S::u64s) -> Lanes<S> {
    let mut result = [0.0; MAX_LANES];
    for lane in 0..Lanes::<S>::LEN {
        result[lane] = unit(mix(hash[lane] ^ IDENTITY));
    }
    Lanes::<S>::from_slice(simd, &result[..Lanes::<S>::LEN])
}
