//! What can be hit.

use crate::{Disc, Frustum, Implicit, Mesh, Primitive, Torus};
use glam::DVec3;
use std::sync::Arc;

/// A sphere: all points at distance |radius| from the centre. Thesis §2.2.2.
///
/// Surface parameters: u is the longitude, from 0 at -z eastward over -x (1/4), +z (1/2) and +x (3/4) to just below 1;
/// v the latitude, from 0 at the south pole (-y) to 1 at the north pole (+y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Radius, in world units. A negative one gives the same surface with its normals turned inward.
    pub radius: f64,
    /// Centre, in world space.
    pub center: DVec3,
}

/// An infinite plane: all points p with normal · p + offset = 0. Thesis §2.2.2.
///
/// Surface parameters: coordinates along two unit vectors at right angles to the normal, in units of object space (T.
/// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017). For the normal +y, u is x and v is -z;
/// for +z they are x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The normal (a, b, c), of any length but 0, where nothing is ever hit; by the rules of the thesis nothing is
    /// where it is shorter than about 1e-9.
    pub normal: DVec3,
    /// The constant d of ax + by + cz + d = 0, in units of the normal's length.
    pub offset: f64,
}

/// A box with sides along the axes: all points between two corners.
///
/// Surface parameters: from 0 to 1 over each face; seen from outside, u to the right and v upward, with +y up on the
/// four sides, -z up on the top and +z up on the bottom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// The corner with the smallest coordinates, in object space.
    pub min: DVec3,
    /// The corner with the largest coordinates.
    pub max: DVec3,
}

/// A quadric: all points p = (x, y, z) of object space where a polynomial of the second degree is 0:
///
/// `square · (x², y², z²) + product · (x y, x z, y z) + linear · (x, y, z) + constant = 0`
///
/// Its inside is where that is negative; it may be endless. All numbers are finite. Where `square`, `product` and `linear`
/// are 0 there is no surface.
///
/// Surface parameters: u and v are x and z in object space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadric {
    /// What x², y² and z² are multiplied by. One over squared object-space units, in units of the polynomial.
    pub square: DVec3,
    /// What x y, x z and y z are multiplied by; likewise.
    pub product: DVec3,
    /// What x, y and z are multiplied by. One over object-space units.
    pub linear: DVec3,
    /// What is added.
    pub constant: f64,
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

/// A shape of which only the surface that lies inside a solid is left. Where the solid cuts no surface is made: one looks
/// in.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// What is cut, which need not be a solid.
    pub shape: Primitive,
    /// The solid within which it is left, boundary included. Its own surface and material are not seen.
    pub within: Primitive,
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
    /// A truncated cone or cylinder.
    Frustum(Arc<Frustum>),
    /// A disc.
    Disc(Arc<Disc>),
    /// A torus.
    Torus(Arc<Torus>),
    /// A quadric.
    Quadric(Arc<Quadric>),
    /// Where a function is 0.
    Implicit(Arc<Implicit>),
    /// A solid made of two.
    Csg(Arc<Csg>),
    /// All that is not inside a solid: the same surface, turned inside out. It keeps its own material.
    Inverse(Arc<Primitive>),
    /// What of a shape lies inside a solid.
    Clip(Arc<Clip>),
    /// Triangles, which other primitives may share.
    Mesh(Arc<Mesh>),
}

impl Shape {
    /// Whether it has an inside, so that it can be a part of solids.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        match self {
            Self::Sphere(_)
            | Self::Plane(_)
            | Self::Cuboid(_)
            | Self::Torus(_)
            | Self::Quadric(_)
            | Self::Implicit(_)
            | Self::Csg(_)
            | Self::Inverse(_) => true,
            Self::Frustum(frustum) => frustum.is_capped,
            Self::Mesh(mesh) => !mesh.triangles().is_empty() && mesh.open_edges() == 0,
            Self::Disc(_) | Self::Clip(_) => false,
        }
    }

    /// What a shape that is made of others is made of, in order; nothing for one that stands by itself.
    #[must_use]
    pub fn operands(&self) -> [Option<&Primitive>; 2] {
        match self {
            Self::Csg(csg) => csg.operands.each_ref().map(Some),
            Self::Inverse(solid) => [Some(&**solid), None],
            Self::Clip(clip) => [Some(&clip.shape), Some(&clip.within)],
            Self::Sphere(_)
            | Self::Plane(_)
            | Self::Cuboid(_)
            | Self::Frustum(_)
            | Self::Disc(_)
            | Self::Torus(_)
            | Self::Quadric(_)
            | Self::Implicit(_)
            | Self::Mesh(_) => [None; 2],
        }
    }

    /// Whether it is made of others.
    #[must_use]
    pub fn is_made_of_others(&self) -> bool {
        self.operands()[0].is_some()
    }
}
