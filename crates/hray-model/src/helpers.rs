//! The helper functions of §2.3.2: what can be asked of a ray, an object, a material, an intersection.
//!
//! Chapter 2 gives only their types, so that the sets stay abstract. The program matches patterns instead and
//! keeps those of `Intersection`, with a value for the empty intersection too: §3.3 prefers a fitting value to
//! a program that stops, though no definition ever asks for one.

use crate::concepts::{
    AmbientLight, Camera, Color, Diff, Intensity, Intersection, Light, Plane, Point3D, PointLight, Ray,
    Sphere, Texture, Vector,
};
use crate::maths::{add, normal, scale};
use crate::perlin::{NoiseTables, perlin};

/// Where a ray starts.
///
/// ```text
/// §2.3.2   start : Ray → Point3D
/// ```
#[must_use]
pub fn start(r: Ray) -> Point3D {
    r.start
}

/// Where a ray goes.
///
/// ```text
/// §2.3.2   dir : Ray → Vector
/// ```
#[must_use]
pub fn dir(r: Ray) -> Vector {
    r.dir
}

/// The radius of a sphere.
///
/// ```text
/// §2.3.2   rad : Sphere → ℝ
/// ```
#[must_use]
pub fn rad(s: Sphere) -> f64 {
    s.rad
}

/// The centre of a sphere.
///
/// ```text
/// §2.3.2   cen : Sphere → Point3D
/// ```
#[must_use]
pub fn cen(s: Sphere) -> Point3D {
    s.cen
}

/// The four coefficients of a plane.
///
/// ```text
/// §2.3.2   coords : Plane → ℝ⁴
/// ```
#[must_use]
pub fn coords(p: Plane) -> (f64, f64, f64, f64) {
    p.coords
}

/// How far a material reflects.
///
/// ```text
/// §2.3.2   reflCoef : Texture → [0, 1]
/// ```
#[must_use]
pub fn refl_coef(t: Texture) -> f64 {
    t.refl_coef
}

/// How far a material is transparent.
///
/// ```text
/// §2.3.2   refrCoef : Texture → [0, 1]
/// ```
#[must_use]
pub fn refr_coef(t: Texture) -> f64 {
    t.refr_coef
}

/// The exponent of a material's highlight.
///
/// ```text
/// §2.3.2   specCoef : Texture → ℕ
/// ```
#[must_use]
pub fn spec_coef(t: Texture) -> i64 {
    t.spec_coef
}

/// A material's index of refraction.
///
/// ```text
/// §2.3.2   refrIndex : Texture → ℝ
/// ```
#[must_use]
pub fn refr_index(t: Texture) -> f64 {
    t.refr_index
}

/// The diffuse colour where an object is hit; black for the empty intersection.
///
/// ```text
/// §2.3.2   colorAt : Intersection → Color
/// A.2      colorAt Nothing                                              = (0.0,0.0,0.0)
///          colorAt (Just (Intersection _ _ (_,Texture (Solid c) ...)))  = c
///          colorAt i@(Just (Intersection _ _ (_,Texture (Perlin f) ...))) = f (intPt i)
/// ```
#[must_use]
pub fn color_at(i: Option<Intersection>, tables: &NoiseTables) -> Color {
    match i {
        None => (0.0, 0.0, 0.0),
        Some(Intersection { object: (_, texture), .. }) => match texture.diff {
            Diff::Solid(color) => color,
            Diff::Perlin(f) => perlin(f, int_pt(i), tables),
        },
    }
}

/// The normal where an object is hit; the null vector for the empty intersection.
///
/// ```text
/// §2.3.2   normalAt : Intersection → Vector
/// A.2      normalAt Nothing                           = (0.0,0.0,0.0)
///          normalAt i@(Just (Intersection _ _ (o,_))) = normal (intPt i) o
/// ```
#[must_use]
pub fn normal_at(i: Option<Intersection>) -> Vector {
    match i {
        None => (0.0, 0.0, 0.0),
        Some(Intersection { object: (o, _), .. }) => normal(int_pt(i), o),
    }
}

/// How far along its ray an intersection is; 0 for the empty one.
///
/// ```text
/// §2.3.2   intDist : Intersection → ℝ
/// ```
#[must_use]
pub fn int_dist(i: Option<Intersection>) -> f64 {
    match i {
        None => 0.0,
        Some(Intersection { dist, .. }) => dist,
    }
}

/// The point of an intersection; the origin for the empty one.
///
/// ```text
/// §2.3.2   intPt : Intersection → Point3D
/// A.2      intPt Nothing                                   = (0.0,0.0,0.0)
///          intPt (Just (Intersection d (Ray start dir) _)) = start <+> (dir *> d)
/// ```
#[must_use]
pub fn int_pt(i: Option<Intersection>) -> Point3D {
    match i {
        None => (0.0, 0.0, 0.0),
        Some(Intersection { dist, ray, .. }) => add(start(ray), scale(dir(ray), dist)),
    }
}

/// The material that is hit; one that is black and dull for the empty intersection.
///
/// ```text
/// §2.3.2   intText : Intersection → Texture
/// A.2      intText Nothing = Texture (Solid (0.0,0.0,0.0)) 0.0 0 0.0 0.0
/// ```
#[must_use]
pub fn int_text(i: Option<Intersection>) -> Texture {
    match i {
        None => Texture {
            diff: Diff::Solid((0.0, 0.0, 0.0)),
            refl_coef: 0.0,
            spec_coef: 0,
            refr_coef: 0.0,
            refr_index: 0.0,
        },
        Some(Intersection { object: (_, texture), .. }) => texture,
    }
}

/// Whether there is no intersection: the program's `isNothing`.
///
/// ```text
/// §2.3.2   isEmpty : Intersection → 𝔹
/// ```
#[must_use]
pub fn is_empty(i: Option<Intersection>) -> bool {
    i.is_none()
}

/// The intensity of a light.
///
/// ```text
/// §2.3.2   int : Light → Intensity
/// ```
#[must_use]
pub fn int(l: Light) -> Intensity {
    match l {
        Light::AmbientLight(AmbientLight { int }) | Light::PointLight(PointLight { int, .. }) => int,
    }
}

/// Where a point light is.
///
/// ```text
/// §2.3.2   pos : PointLight → Point3D
/// ```
#[must_use]
pub fn pos(l: PointLight) -> Point3D {
    l.pos
}

/// The eye of a camera.
///
/// ```text
/// §2.3.2   eye : Camera → Point3D
/// ```
#[must_use]
pub fn eye(c: Camera) -> Point3D {
    c.eye
}

/// The window of a camera: width and height.
///
/// ```text
/// §2.3.2   dim : Camera → ℕ²
/// ```
#[must_use]
pub fn dim(c: Camera) -> (i64, i64) {
    c.dim
}
