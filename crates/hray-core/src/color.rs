//! Colours and light intensities.

use std::ops::{Add, Mul};

/// A colour, or the intensity of a light, as three components: red, green, blue.
///
/// 0 is none and 1 is full; classic scenes pass their numbers to the picture untouched, so no colour space
/// is implied. Values outside [0, 1] are representable: the integrator says where it clips.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Rgb {
    /// No light at all.
    pub const BLACK: Self = Self { r: 0.0, g: 0.0, b: 0.0 };

    /// A colour from its components.
    #[must_use]
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self { r, g, b }
    }

    /// The components in order: red, green, blue.
    #[must_use]
    pub const fn to_array(self) -> [f64; 3] {
        [self.r, self.g, self.b]
    }
}

impl From<[f64; 3]> for Rgb {
    fn from([r, g, b]: [f64; 3]) -> Self {
        Self { r, g, b }
    }
}

impl Add for Rgb {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { r: self.r + other.r, g: self.g + other.g, b: self.b + other.b }
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { r: self.r * factor, g: self.g * factor, b: self.b * factor }
    }
}

impl From<Rgb> for [f64; 3] {
    fn from(color: Rgb) -> Self {
        color.to_array()
    }
}
