//! What can be hit.

use glam::DVec3;

/// A sphere: all points at distance |radius| from the centre. Thesis §2.2.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Radius, in world units. A negative one gives the same surface with its normals turned inward.
    pub radius: f64,
    /// Centre, in world space.
    pub center: DVec3,
}

/// An infinite plane: all points p with normal · p + offset = 0. Thesis §2.2.2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The normal (a, b, c), of any length; where it is shorter than about 1e-9 nothing is ever hit.
    pub normal: DVec3,
    /// The constant d of ax + by + cz + d = 0, in units of the normal's length.
    pub offset: f64,
}

/// The geometry of a primitive: the thesis' `Object`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A sphere.
    Sphere(Sphere),
    /// An infinite plane.
    Plane(Plane),
}
