//! Vectors of points: the arithmetic of the thesis on as many points at once as the machine has lanes.
//!
//! Every operation is the IEEE operation of the scalar definition, lane by lane and in the same order, so the
//! width of the vectors cannot change a result. Functions here are `inline(always)` because only code that is
//! inlined into a dispatched function is compiled for the machine's instruction set.

use fearless_simd::prelude::*;

/// As many doubles as the machine handles at once.
pub type Lanes<S> = <S as Simd>::f64s;
/// One truth value per lane.
pub type Mask<S> = <S as Simd>::mask64s;

/// The widest vector of any machine; buffers are padded to a multiple of it.
pub const MAX_LANES: usize = 8;

/// Lengths below this count as zero (appendix A.1, `norm`).
const ZERO_LENGTH: f64 = 1e-9;

/// Points, directions or colours, one per lane.
#[derive(Clone, Copy)]
pub struct Vec3<S: Simd> {
    /// The first coordinates, or the red parts.
    pub x: Lanes<S>,
    /// The second coordinates, or the green parts.
    pub y: Lanes<S>,
    /// The third coordinates, or the blue parts.
    pub z: Lanes<S>,
}

#[allow(clippy::should_implement_trait, reason = "named alike, but always inlined and for one type each")]
impl<S: Simd> Vec3<S> {
    /// The same three numbers in every lane.
    #[inline(always)]
    pub fn splat(simd: S, v: impl Into<[f64; 3]>) -> Self {
        let [x, y, z] = v.into();
        Self { x: Lanes::<S>::splat(simd, x), y: Lanes::<S>::splat(simd, y), z: Lanes::<S>::splat(simd, z) }
    }

    /// The lanes that start at `start` of three columns.
    #[inline(always)]
    pub fn load(simd: S, [x, y, z]: [&[f64]; 3], start: usize) -> Self {
        let end = start + Lanes::<S>::LEN;
        Self {
            x: Lanes::<S>::from_slice(simd, &x[start..end]),
            y: Lanes::<S>::from_slice(simd, &y[start..end]),
            z: Lanes::<S>::from_slice(simd, &z[start..end]),
        }
    }

    /// One lane from each of the given places of three columns.
    #[inline(always)]
    pub fn gather(simd: S, [x, y, z]: [&[f64]; 3], places: &[u32]) -> Self {
        Self { x: gather(simd, x, places), y: gather(simd, y, places), z: gather(simd, z, places) }
    }

    /// Puts the lanes into three columns, from `start` on.
    #[inline(always)]
    pub fn store(self, [x, y, z]: [&mut [f64]; 3], start: usize) {
        let end = start + Lanes::<S>::LEN;
        self.x.store_slice(&mut x[start..end]);
        self.y.store_slice(&mut y[start..end]);
        self.z.store_slice(&mut z[start..end]);
    }

    /// Lane by lane, coordinate by coordinate.
    #[inline(always)]
    pub fn add(self, o: Self) -> Self {
        Self { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }

    /// Lane by lane, coordinate by coordinate.
    #[inline(always)]
    pub fn sub(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }

    /// Lane by lane, coordinate by coordinate.
    #[inline(always)]
    pub fn mul(self, o: Self) -> Self {
        Self { x: self.x * o.x, y: self.y * o.y, z: self.z * o.z }
    }

    /// All three coordinates times one number.
    #[inline(always)]
    pub fn scale(self, f: Lanes<S>) -> Self {
        Self { x: self.x * f, y: self.y * f, z: self.z * f }
    }

    /// The scalar product, summed from x to z.
    #[inline(always)]
    pub fn dot(self, o: Self) -> Lanes<S> {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// The direction of `self`, and its length: `norm` and `len` of appendix A.1. A vector shorter than 1e-9
    /// has no direction and becomes zero.
    #[inline(always)]
    pub fn norm(self, simd: S) -> (Self, Lanes<S>) {
        let length = self.dot(self).sqrt();
        let one = Lanes::<S>::splat(simd, 1.0);
        let unit = self.scale(one / length);
        (unit.zero_where(simd, length.simd_lt(ZERO_LENGTH)), length)
    }

    /// `self`, with zero in the lanes of `mask`.
    #[inline(always)]
    pub fn zero_where(self, simd: S, mask: Mask<S>) -> Self {
        let zero = Lanes::<S>::splat(simd, 0.0);
        Self { x: mask.select(zero, self.x), y: mask.select(zero, self.y), z: mask.select(zero, self.z) }
    }

    /// `clip` of appendix A.1: into [0, 1] by comparisons, which makes 1 of NaN.
    #[inline(always)]
    pub fn clip(self, simd: S) -> Self {
        Self { x: clip(simd, self.x), y: clip(simd, self.y), z: clip(simd, self.z) }
    }
}

#[inline(always)]
fn clip<S: Simd>(simd: S, v: Lanes<S>) -> Lanes<S> {
    let zero = Lanes::<S>::splat(simd, 0.0);
    let one = Lanes::<S>::splat(simd, 1.0);
    let v = v.simd_le(one).select(v, one);
    v.simd_le(zero).select(zero, v)
}

/// Whether the places follow one upon the other. They ascend, but the last may be repeated to fill a vector.
#[inline(always)]
pub fn consecutive(places: &[u32]) -> bool {
    let last = places.len() - 1;
    let repeated = last > 0 && places[last] == places[last - 1];
    !repeated && (places[last] - places[0]) as usize == last
}

/// One lane from each of the given places of a column; they ascend, or the last repeats.
#[inline(always)]
pub fn gather<S: Simd>(simd: S, column: &[f64], places: &[u32]) -> Lanes<S> {
    let places = &places[..Lanes::<S>::LEN];
    if consecutive(places) {
        let first = places[0] as usize;
        return Lanes::<S>::from_slice(simd, &column[first..first + Lanes::<S>::LEN]);
    }
    let mut lanes = [0.0; MAX_LANES];
    for (lane, &place) in lanes.iter_mut().zip(places) {
        *lane = column[place as usize];
    }
    Lanes::<S>::from_slice(simd, &lanes[..Lanes::<S>::LEN])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_only_span_a_vector_are_not_consecutive() {
        assert!(consecutive(&[5, 6, 7, 8, 9, 10, 11, 12]));
        assert!(!consecutive(&[5, 6, 7, 7, 7, 7, 7, 7]));
        assert!(
            !consecutive(&[5, 6, 12, 12, 12, 12, 12, 12]),
            "filled up with a ray that happens to be 7 further"
        );
        assert!(!consecutive(&[5, 6, 7, 8, 9, 10, 11, 13]));
        assert!(consecutive(&[3, 4]));
        assert!(!consecutive(&[3, 3]));
    }
}
