//! The concepts of §2.3.1: the sets that the model is built on, and what makes their elements.
//!
//! Chapter 2 leaves most of these sets abstract and speaks of them through helper functions only; §3.2 and
//! §3.3 make them concrete. Here they are the data types of the Haskell program, with every part public.

use crate::maths::mk_norm_vect;
use crate::perlin::NoiseF;
use std::fmt;
use std::ops::Range;

/// A point in space.
///
/// ```text
/// §2.3.1   Point3D := ℝ³
/// ```
pub type Point3D = (f64, f64, f64);

/// A direction, as the point it leads to from the origin. The thesis identifies the two sets.
///
/// ```text
/// §2.3.1   Vector := ℝ³
/// ```
pub type Vector = (f64, f64, f64);

/// A half-line: where it starts and where it goes.
///
/// ```text
/// §2.2.2   r : ℝ≥0 → ℝ³     r k = s +^ (d ·→ k)
/// A.1      data Ray = Ray Point3D Vector
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The point it starts in.
    pub start: Point3D,
    /// Its direction. The thesis wants length 1; distances along the ray are in units of this length.
    pub dir: Vector,
}

/// The ray from one point through another.
///
/// ```text
/// §2.3.1   mkRay : Point3D → Point3D → Ray
/// A.1      mkRay p1 p2 = Ray p1 (mkNormVect p1 p2)
/// ```
#[must_use]
pub fn mk_ray(p1: Point3D, p2: Point3D) -> Ray {
    Ray { start: p1, dir: mk_norm_vect(p1, p2) }
}

/// The ray from a point in a direction: `mkRay'`, whose prime no Rust name can have.
///
/// ```text
/// §2.3.1   mkRay' : Point3D → Vector → Ray
/// A.1      the constructor Ray
/// ```
#[must_use]
pub fn mk_ray_dir(start: Point3D, dir: Vector) -> Ray {
    Ray { start, dir }
}

/// A colour: red, green, blue.
///
/// ```text
/// §2.3.1   Color := [0, 1]³
/// A.2      type Color = (Double, Double, Double)
/// ```
///
/// The program cannot hold the components to [0, 1]: §3.3 says so, and a background of 2 is a colour to it.
pub type Color = (f64, f64, f64);

/// A sphere.
///
/// ```text
/// §2.2.2   Σ (.² ∘ (p -^ m)) = R²
/// A.1      Sphere Double Point3D
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Its radius. A negative one gives the same surface, inside out.
    pub rad: f64,
    /// Its centre.
    pub cen: Point3D,
}

/// A plane: the points (x, y, z) with a x + b y + c z + d = 0.
///
/// ```text
/// §2.2.2   n • p = t
/// A.1      Plane (Double, Double, Double, Double)
/// ```
///
/// With `coords` = (n, t) the two forms differ in the sign of t: the program's plane is n • p = -t.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The coefficients (a, b, c, d). The normal (a, b, c) need not have length 1.
    pub coords: (f64, f64, f64, f64),
}

/// What a ray can meet.
///
/// ```text
/// §2.3.1   Object := Sphere ∪ Plane
/// A.1      data Object = Sphere Double Point3D | Plane (Double, Double, Double, Double)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Object {
    /// A sphere.
    Sphere(Sphere),
    /// A plane.
    Plane(Plane),
}

/// The sphere around a centre with a radius; the Haskell constructor takes the two in the other order.
///
/// ```text
/// §2.3.1   mkSphere : Point3D → ℝ → Sphere
/// ```
#[must_use]
pub fn mk_sphere(cen: Point3D, rad: f64) -> Sphere {
    Sphere { rad, cen }
}

/// The plane with given coefficients.
///
/// ```text
/// §2.3.1   mkPlane : ℝ⁴ → Plane
/// ```
#[must_use]
pub fn mk_plane(coords: (f64, f64, f64, f64)) -> Plane {
    Plane { coords }
}

/// The diffuse colour of a material: one colour, or a pattern of the point. Chapter 2 has only the function
/// `colorAt`.
///
/// ```text
/// A.2      data Diff = Solid Color | Perlin (Point3D -> Color)
/// ```
///
/// Haskell stores the function of the point. Here it is named, and [`crate::perlin::perlin`] applies it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Diff {
    /// The same colour everywhere.
    Solid(Color),
    /// A noise pattern.
    Perlin(NoiseF),
}

/// A material.
///
/// ```text
/// §2.3.2   Texture, known by reflCoef, refrCoef, specCoef and refrIndex
/// A.2      data Texture = Texture Diff Double Int Double Double
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// The diffuse colour.
    pub diff: Diff,
    /// How far it reflects, nominally in [0, 1]. It also scales the highlight.
    pub refl_coef: f64,
    /// The exponent of the highlight; a natural number in chapter 2, any `Int` in the program.
    pub spec_coef: i64,
    /// How far it is transparent, nominally in [0, 1].
    pub refr_coef: f64,
    /// The index of refraction of the inside relative to the outside.
    pub refr_index: f64,
}

/// An object and what it is made of.
///
/// ```text
/// §2.3.1   TexturedObject := Object × Texture
/// ```
pub type TexturedObject = (Object, Texture);

/// Where a ray meets an object. The empty intersection ε, an element of the thesis' set, is `None` of an
/// `Option<Intersection>`, as it is `Nothing` of a `Maybe Intersection` in the program.
///
/// ```text
/// A.2      data Intersection = Intersection Double Ray TexturedObject
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intersection {
    /// How far along the ray.
    pub dist: f64,
    /// The ray.
    pub ray: Ray,
    /// What it meets.
    pub object: TexturedObject,
}

/// The intersection at a distance along a ray with an object. It records the three and checks nothing.
///
/// ```text
/// §2.3.1   mkInt : ℝ → Ray → TexturedObject → Intersection
/// ```
///
/// The derivation in §2.3.3 leaves out the distance and writes `mkInt r (o 0)`.
#[must_use]
pub fn mk_int(dist: f64, ray: Ray, object: TexturedObject) -> Intersection {
    Intersection { dist, ray, object }
}

/// How strong a light is, per colour component.
///
/// ```text
/// §2.3.1   Intensity := [0, 1]
/// A.2      type Intensity = (Double, Double, Double)
/// ```
///
/// One number in chapter 2, three in the program: already §2.3.2 multiplies an intensity as a triple.
pub type Intensity = (f64, f64, f64);

/// Light from everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmbientLight {
    /// Its intensity.
    pub int: Intensity,
}

/// Light from one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where it is.
    pub pos: Point3D,
    /// Its intensity.
    pub int: Intensity,
}

/// A source of light.
///
/// ```text
/// §2.3.1   Light := AmbientLight ∪ PointLight
/// A.2      data Light = PointLight Point3D Intensity | AmbientLight Intensity
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Light {
    /// Light from everywhere.
    AmbientLight(AmbientLight),
    /// Light from one point.
    PointLight(PointLight),
}

/// Where we look from, and how large the window is that we look through. The window lies around the origin
/// in the plane z = 0 (§2.2.3).
///
/// ```text
/// A.2      data Camera = Camera Point3D Dimension
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye. §2.2.3 puts it on the z axis; nothing depends on that.
    pub eye: Point3D,
    /// Width and height of the window.
    pub dim: (i64, i64),
}

/// The camera with a given eye and window.
///
/// ```text
/// §2.3.1   mkCamera : Point3D → ℕ² → Camera
/// ```
#[must_use]
pub fn mk_camera(eye: Point3D, dim: (i64, i64)) -> Camera {
    Camera { eye, dim }
}

/// A world to make a picture of, its lists in the order in which they are written.
///
/// ```text
/// §2.3.1   Scene := Camera × Color × TexturedObject* × Light*
/// A.2      data Scene = Scene Camera Color [TexturedObject] [Light]
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// What is seen where nothing is hit.
    pub background: Color,
    /// The objects; the program's list is this one reversed.
    pub objects: Vec<TexturedObject>,
    /// The lights; the program's list is this one reversed.
    pub lights: Vec<Light>,
}

/// A picture: a function from the pixels of a resolution to colours, and from nothing else.
///
/// ```text
/// §2.3.1   Image := ⋃ (r : ℕ² . (□ (r 0) × □ (r 1)) → Color)
/// A.2      type Image = Point2D -> Color
/// ```
///
/// The Haskell type forgets the domain (§3.3 says so); here it is kept, and outside it there is an error value.
/// Where a component of the resolution is not positive the domain is empty.
pub struct Image<'a> {
    resolution: (i64, i64),
    pub(crate) color: Box<dyn Fn((i64, i64)) -> Color + 'a>,
}

impl<'a> Image<'a> {
    /// The restriction of a function of the pixel (px, py) to the pixels of a resolution (rx, ry).
    #[must_use]
    pub fn new(resolution: (i64, i64), color: impl Fn((i64, i64)) -> Color + 'a) -> Self {
        Self { resolution, color: Box::new(color) }
    }

    /// The colour of the pixel in column px, counted from the left, and row py, counted from the bottom.
    ///
    /// # Errors
    /// [`OutsideDomain`] where the pixel is not one of the [`domain`](Self::domain).
    pub fn at(&self, px: i64, py: i64) -> Result<Color, OutsideDomain> {
        let (columns, rows) = self.domain();
        if columns.contains(&px) && rows.contains(&py) {
            Ok((self.color)((px, py)))
        } else {
            Err(OutsideDomain { pixel: (px, py), resolution: self.resolution })
        }
    }

    /// The domain □ (r 0) × □ (r 1), as its columns and its rows.
    #[must_use]
    pub fn domain(&self) -> (Range<i64>, Range<i64>) {
        (0..self.resolution.0, 0..self.resolution.1)
    }

    /// The resolution: columns and rows.
    #[must_use]
    pub fn resolution(&self) -> (i64, i64) {
        self.resolution
    }
}

impl fmt::Debug for Image<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Image").field("resolution", &self.resolution).finish_non_exhaustive()
    }
}

/// An image was asked for a pixel that it does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutsideDomain {
    /// The pixel (px, py).
    pub pixel: (i64, i64),
    /// The resolution (rx, ry) of the image.
    pub resolution: (i64, i64),
}

impl fmt::Display for OutsideDomain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ((px, py), (rx, ry)) = (self.pixel, self.resolution);
        write!(f, "an image of {rx} by {ry} pixels has no pixel ({px}, {py})")
    }
}

impl std::error::Error for OutsideDomain {}
