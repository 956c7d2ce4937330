//! Where light comes from.

use crate::Rgb;
use glam::DVec3;

/// A light of the classic renderer. Thesis §2.3.1, `Light`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Shines from one point in all directions, with no loss over distance.
    Point {
        /// World-space position.
        position: DVec3,
        /// Intensity per component.
        intensity: Rgb,
    },
    /// Adds its intensity, times the colour of the surface, to every point that is hit; by the rules of the thesis
    /// ([`crate::Integrator::Classic2005`]) **not** times that colour.
    Ambient {
        /// Intensity per component.
        intensity: Rgb,
    },
    /// Shines from infinitely far away.
    Directional {
        /// The direction in which its light travels, in world space; a unit vector.
        direction: DVec3,
        /// Intensity per component.
        intensity: Rgb,
    },
    /// Shines from one point into a cone, with no loss over distance.
    Spot {
        /// World-space position.
        position: DVec3,
        /// The axis of the cone, away from the light; a unit vector.
        axis: DVec3,
        /// Cosine of the angle from the axis up to which the light is full.
        cos_inner: f64,
        /// Cosine of the angle from the axis beyond which there is none; at most `cos_inner`. Between the two the
        /// light falls off smoothly (3t² - 2t³ in the cosine).
        cos_outer: f64,
        /// Intensity per component on the axis.
        intensity: Rgb,
    },
}
