//! Axis-aligned boxes.

/// An axis-aligned box in single precision, rounded outwards from what it holds. An empty one has its corners exchanged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The least coordinates.
    pub min: [f32; 3],
    /// The greatest.
    pub max: [f32; 3],
}

impl Bounds {
    /// The box of nothing.
    pub const EMPTY: Self = Self { min: [f32::INFINITY; 3], max: [f32::NEG_INFINITY; 3] };

    /// The box of points. Coordinates that are no numbers are left out.
    #[must_use]
    pub fn of_points<'a>(points: impl IntoIterator<Item = &'a [f32; 3]>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, point| bounds.union(&Self { min: *point, max: *point }))
    }

    /// The smallest box that holds one in double precision.
    #[must_use]
    pub fn outward(min: [f64; 3], max: [f64; 3]) -> Self {
        Self { min: min.map(below), max: max.map(above) }
    }

    /// The box of both.
    #[inline]
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let mut union = *self;
        for axis in 0..3 {
            union.min[axis] = self.min[axis].min(other.min[axis]);
            union.max[axis] = self.max[axis].max(other.max[axis]);
        }
        union
    }

    /// Whether it holds nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        !(0..3).all(|axis| self.min[axis] <= self.max[axis])
    }

    /// Half its surface; 0 for nothing.
    #[inline]
    #[must_use]
    pub fn half_area(&self) -> f32 {
        let [x, y, z] = self.extent();
        x * (y + z) + y * z
    }

    /// Its edges; 0 for nothing.
    #[inline]
    #[must_use]
    pub fn extent(&self) -> [f32; 3] {
        [0, 1, 2].map(|axis| (self.max[axis] - self.min[axis]).max(0.0))
    }

    /// The greatest magnitude of a coordinate in it.
    #[must_use]
    pub fn reach(&self) -> f32 {
        (0..3).map(|axis| self.min[axis].abs().max(self.max[axis].abs())).fold(0.0, f32::max)
    }
}

/// The greatest single that is not above a double.
fn below(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) > x { rounded.next_down() } else { rounded }
}

/// The least single that is not below a double.
fn above(x: f64) -> f32 {
    let rounded = x as f32;
    if f64::from(rounded) < x { rounded.next_up() } else { rounded }
}
