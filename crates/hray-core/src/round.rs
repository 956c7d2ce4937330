//! Shapes round about an axis: what is between two circles, discs, and rings.

use glam::DVec3;

/// A truncated cone: what lies between two circles with one axis. With equal radii it is a cylinder, with one of 0 a cone.
///
/// Surface parameters: on the side, u is the angle about the axis in turns, v goes from 0 at the base to 1 at the top; on the
/// caps, v goes from 0 in the middle to 1 at the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// The centre of the circle at the base, in object space.
    pub base: DVec3,
    /// The centre of the circle at the top; another point than `base`.
    pub top: DVec3,
    /// The radii at the base and at the top, in object-space units; not negative, and one of them positive.
    pub radii: [f64; 2],
    /// Whether both ends are closed by discs. Where they are not, there is only the side, and no inside.
    pub is_capped: bool,
}

/// A flat disc, or a ring where it has a hole. It has two sides and no inside.
///
/// Surface parameters: u is the angle about the axis in turns, v the distance from the centre, from 0 to 1 at the rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// The centre, in object space.
    pub center: DVec3,
    /// A direction at right angles to it, of length 1.
    pub normal: DVec3,
    /// The radius, in object-space units; positive.
    pub radius: f64,
    /// The radius of the hole; from 0 to `radius`.
    pub hole: f64,
}

/// A torus: all points at one distance from a circle.
///
/// Surface parameters: u is the angle about the axis in turns; v the angle about the circle, from 0 at the outermost
/// points over the side that the axis points to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// The centre of the circle, in object space.
    pub center: DVec3,
    /// The axis, of length 1.
    pub axis: DVec3,
    /// The radius of the circle, in object-space units; positive.
    pub radius: f64,
    /// The distance of the surface from the circle; positive, and less than `radius`.
    pub tube: f64,
}
