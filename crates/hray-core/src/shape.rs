//! What can be hit.

use crate::Primitive;
use glam::DVec3;
use std::sync::Arc;

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

/// A box with sides along the axes: all points between two corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// The corner with the smallest coordinates, in object space.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

/// How two solids make one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CsgOperation {
    /// What is inside either.
    Union,
    /// What is inside both.
    Intersection,
    /// What is inside the first and not inside the second.
    Difference,
}

/// Constructive solid geometry: a solid made of two. Each keeps its own material; where the second is cut away, its
/// surface, turned inside out, is what is seen. The inside of a plane is the half space that its normal leads away
/// from.
#[derive(Clone, Debug, PartialEq)]
pub struct Csg {
    /// How.
    pub operation: CsgOperation,
    /// Of what.
    pub operands: [Primitive; 2],
}

/// The geometry of a primitive: the thesis' `Object`.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A sphere.
    Sphere(Sphere),
    /// An infinite plane.
    Plane(Plane),
    /// A box.
    Cuboid(Cuboid),
    /// A solid made of two.
    Csg(Arc<Csg>),
}
