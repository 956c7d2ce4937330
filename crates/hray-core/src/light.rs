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
    /// Adds its intensity to every point that is hit, **unmultiplied** by the colour of the surface, as the
    /// thesis has it.
    Ambient {
        /// Intensity per component.
        intensity: Rgb,
    },
}
