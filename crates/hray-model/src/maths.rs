//! The mathematical basis of §2.3.2, with the operators on triples from §2.2.2: module `HRayMath` of A.1.

use crate::concepts::{Color, Object, Point3D, Ray, Vector};
use crate::helpers::{cen, coords, dir, rad, start};

/// `10**(-9)`: a vector shorter than this has no direction, and a ray this close to parallel misses a plane.
pub const NO_LENGTH: f64 = 1e-9;

/// `10**(-6)`: a hit this close to the start of a ray is the surface that the ray starts from.
pub const SAME_SURFACE: f64 = 1e-6;

/// The sum of two triples.
///
/// ```text
/// §2.2.2   v +^ w
/// A.1      (x1,y1,z1) <+> (x2,y2,z2) = (x1+x2, y1+y2, z1+z2)
/// ```
#[must_use]
pub fn add((x1, y1, z1): Vector, (x2, y2, z2): Vector) -> Vector {
    (x1 + x2, y1 + y2, z1 + z2)
}

/// The difference of two triples.
///
/// ```text
/// §2.2.2   v -^ w
/// A.1      (x1,y1,z1) <-> (x2,y2,z2) = (x1-x2,y1-y2,z1-z2)
/// ```
#[must_use]
pub fn sub((x1, y1, z1): Vector, (x2, y2, z2): Vector) -> Vector {
    (x1 - x2, y1 - y2, z1 - z2)
}

/// The product of two triples, component by component.
///
/// ```text
/// §2.2.2   v ·^ w
/// A.1      (x1,y1,z1) <*> (x2,y2,z2) = (x1*x2,y1*y2,z1*z2)
/// ```
#[must_use]
pub fn mul((x1, y1, z1): Color, (x2, y2, z2): Color) -> Color {
    (x1 * x2, y1 * y2, z1 * z2)
}

/// A triple times a number.
///
/// ```text
/// §2.2.2   v ·→ a
/// A.1      (x,y,z) *> f = (x*f,y*f,z*f)
/// ```
#[must_use]
pub fn scale((x, y, z): Vector, f: f64) -> Vector {
    (x * f, y * f, z * f)
}

/// The larger of each component and a number.
///
/// ```text
/// §2.3.2   v ∨→ f
/// A.1      maxF f (x,y,z) = (max x f, max y f, max z f)
/// ```
///
/// Haskell's `max a b` is `if a <= b then b else a`.
#[must_use]
pub fn max_f(f: f64, (x, y, z): Vector) -> Vector {
    let max = |a: f64, b: f64| if a <= b { b } else { a };
    (max(x, f), max(y, f), max(z, f))
}

/// The smaller of each component and a number.
///
/// ```text
/// §2.3.2   v ∧→ f
/// A.1      minF f (x,y,z) = (min x f, min y f, min z f)
/// ```
///
/// Haskell's `min a b` is `if a <= b then a else b`, so the number wins over a NaN.
#[must_use]
pub fn min_f(f: f64, (x, y, z): Vector) -> Vector {
    let min = |a: f64, b: f64| if a <= b { a } else { b };
    (min(x, f), min(y, f), min(z, f))
}

/// The scalar product of two vectors.
///
/// ```text
/// §2.2.2   v • w = Σ (v ·^ w)
/// A.1      (x1,y1,z1) *. (x2,y2,z2) = x1*x2 + y1*y2 + z1*z2
/// ```
///
/// The scan has a plus under the hat of §2.2.2, which would sum where it must multiply.
#[must_use]
pub fn dot((x1, y1, z1): Vector, (x2, y2, z2): Vector) -> f64 {
    x1 * x2 + y1 * y2 + z1 * z2
}

/// The length of a vector.
///
/// ```text
/// §2.3.2   len : Vector → ℝ
///          len v = √(v • v)
/// ```
#[must_use]
pub fn len(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

/// A vector of length 1 in the direction of another, or the null vector where there is none.
///
/// ```text
/// §2.3.2   norm : Vector → Vector
///          norm v = (len v = 0) ? (0, 0, 0) † v ·→ 1 / len v
/// A.1      norm v | len v < 10**(-9) = (0.0,0.0,0.0)
///                 | otherwise        = v *> (1/(len v))
/// ```
///
/// The model asks for a length of exactly 0, the program for one below [`NO_LENGTH`]. §2.3.2 forgets the
/// argument v on the left.
#[must_use]
pub fn norm(v: Vector) -> Vector {
    if len(v) < NO_LENGTH { (0.0, 0.0, 0.0) } else { scale(v, 1.0 / len(v)) }
}

/// The direction from one point to another, of length 1.
///
/// ```text
/// §2.3.2   mkNormVect : Point3D → Point3D → Vector
///          mkNormVect v w = norm (w -^ v)
/// ```
#[must_use]
pub fn mk_norm_vect(v: Point3D, w: Point3D) -> Vector {
    norm(sub(w, v))
}

/// The distance between two points.
///
/// ```text
/// §2.3.2   dist : Point3D → Point3D → ℝ
///          dist p q = √((q -^ p) • (q -^ p))
/// ```
#[must_use]
pub fn dist(p: Point3D, q: Point3D) -> f64 {
    dot(sub(q, p), sub(q, p)).sqrt()
}

/// The nearest colour in [0, 1]³.
///
/// ```text
/// §2.3.2   clip : ℝ³ → Color
///          clip = 0 ∨→ ∘ 1 ∧→
/// A.1      clip = (maxF 0.0) . (minF 1.0)
/// ```
///
/// A NaN becomes 1, and a negative zero 0, by the comparisons in [`min_f`] and [`max_f`].
#[must_use]
pub fn clip(c: (f64, f64, f64)) -> Color {
    max_f(0.0, min_f(1.0, c))
}

/// The real roots of a x² + b x + c, none, one or two of them; in ascending order where a > 0.
///
/// ```text
/// §2.3.2   solveq : ℝ³ → ℝ*
///          solveq p = d < 0 ? ε † (d > 0 ? ((-(p 1) - √d) / (2 · (p 0)), (-(p 1) + √d) / (2 · (p 0)))
///                                        † -(p 1) / (2 · (p 0)))
///                     where d = (p 1) · (p 1) - 4 · (p 0) · (p 2)
/// A.1      solveq (a,b,c) | (d < 0)   = []
///                         | (d > 0)   = [(- b - sqrt d)/(2*a), (- b + sqrt d)/(2*a)]
///                         | otherwise = [-b/(2*a)]
///                         where d = b*b - 4*a*c
/// ```
///
/// §2.3.2 prints the two roots without the parentheses around their numerators, and the scan ℝ*² for the
/// result. §2.2.2 has
/// k = (-B ± √(B² - 4 * C)) / 2, which is right for A = 1; the program divides by 2 A with A as computed. An
/// undefined discriminant (NaN) falls to the last case, so one "root" comes back that may be any number.
#[must_use]
pub fn solveq((a, b, c): (f64, f64, f64)) -> Vec<f64> {
    let d = b * b - 4.0 * a * c;
    if d < 0.0 {
        vec![]
    } else if d > 0.0 {
        vec![(-b - d.sqrt()) / (2.0 * a), (-b + d.sqrt()) / (2.0 * a)]
    } else {
        vec![-b / (2.0 * a)]
    }
}

/// The distances along a ray at which it meets an object, before its start too, in ascending order.
///
/// ```text
/// §2.3.2   intRayWith : Ray → Object → ℝ*
///          intRayWith r o = o ∈ Sphere ? solveq ((dir r) • (dir r), 2 · ((dir r) • d), d • d - (rad o)²)
///                                      † -((c 3) + (c 0, c 1, c 2) • (start r)) / ((c 0, c 1, c 2) • (dir r))
///                           where d = (start r) -^ (cen o)
///                                 c = coords o
/// A.1      intRayWith (Ray start dir) (Sphere rad cen)
///            = solveq (dir *. dir, 2*(dir *. d), (d *. d) - rad^2)   where d = start <-> cen
///          intRayWith (Ray start dir) (Plane (a,b,c,d))
///            = if (abs(part) < 10**(-9)) then [] else [- (d + ((a,b,c) *. start) ) / part]
///                                                                    where part = (a,b,c) *. dir
/// ```
///
/// The model divides by 0 for a plane parallel to the ray, though §2.2.2 asks for a guard; the program has
/// one, [`NO_LENGTH`]. §2.2.2 prints C = Σ (.² ∘ (s -^ m)) + R², where the square must be subtracted, and
/// k = -(n • s + t) / (n • d) beside n • p = t, which fits n • p = -t only. The scan of §2.3.2 flattens the
/// plane's fraction, garbles the minus under the hat, says `rad r` for `rad o`, and gives `solveq` three
/// arguments for the one triple.
#[must_use]
pub fn int_ray_with(r: Ray, o: Object) -> Vec<f64> {
    match o {
        Object::Sphere(s) => {
            let d = sub(start(r), cen(s));
            solveq((dot(dir(r), dir(r)), 2.0 * dot(dir(r), d), dot(d, d) - rad(s) * rad(s)))
        }
        Object::Plane(p) => {
            let (a, b, c, d) = coords(p);
            let part = dot((a, b, c), dir(r));
            if part.abs() < NO_LENGTH { vec![] } else { vec![-(d + dot((a, b, c), start(r))) / part] }
        }
    }
}

/// The direction perpendicular to an object in a point of its surface, of length 1.
///
/// ```text
/// §2.3.2   normal : Point3D → Object → Vector
///          normal p o = norm (o ∈ Sphere ? (p -^ (cen o)) ·→ 1 / (rad o) † (c 0, c 1, c 2))
///                       where c = coords o
/// A.1      normal p (Sphere rad cen)    = norm ((p <-> cen) *> (1/rad))
///          normal _ (Plane (a,b,c,d))   = norm (a,b,c)
/// ```
///
/// The scan of §2.3.2 has the centre before the point, which would turn the normals of spheres inward, and a
/// plus for the dagger.
#[must_use]
pub fn normal(p: Point3D, o: Object) -> Vector {
    match o {
        Object::Sphere(s) => norm(scale(sub(p, cen(s)), 1.0 / rad(s))),
        Object::Plane(plane) => {
            let (a, b, c, _) = coords(plane);
            norm((a, b, c))
        }
    }
}

/// The direction i mirrored in the surface with normal n (of length 1).
///
/// ```text
/// §2.3.2   reflectDir : Vector → Vector → Vector
///          reflectDir i n = i -^ (n ·→ (2 · (i • n)))
/// A.1      reflectDir i n = i <-> (n *> (2*(n *. i)))
/// ```
#[must_use]
pub fn reflect_dir(i: Vector, n: Vector) -> Vector {
    sub(i, scale(n, 2.0 * dot(n, i)))
}

/// The direction i broken at a surface with normal n and index of refraction r; the null vector stands for
/// total internal reflection.
///
/// ```text
/// §2.3.2   refractDir : Vector → Vector → ℝ → Vector
///          refractDir i n r = v < 0 ? (0, 0, 0) † norm ((i ·→ r') +^ (n ·→ (r' · (abs c) - √v)))
///                             where c  = n • (i ·→ -1)
///                                   r' = (c < 0) ? r † 1 / r
///                                   v  = 1 + r'² · (c² - 1)
/// A.1      refractDir i n r = if (v < 0) then (0.0, 0.0, 0.0)
///                             else norm $ (i *> r_c) <+> (n *> (r_c*(abs c) - sqrt v))
///                             where c   = n *. (i *> (-1))
///                                   r_c = if (c < 0) then r else 1/r
///                                   v   = 1 + (r_c^2) * (c^2 - 1)
/// ```
///
/// The ray enters where it runs against the normal (c ≥ 0). Then this is Snell's law: for i and n of length 1
/// the sum has length 1 and the component -√v along n.
///
/// **Leaving, it is not.** The formula wants the normal on the side that the ray comes from; the thesis takes
/// the absolute value of c for that, but leaves n as it is. With cos α = -c and cos β = √v the component along
/// n is then 2 r cos α - cos β instead of cos β, and `norm` hides that the sum has the wrong length. Only
/// where r cos α = cos β, as for r = 1, is the direction Snell's. Where total internal reflection begins is
/// right. Model and program agree in this and the pictures of 2005 show it, so it stands.
#[must_use]
pub fn refract_dir(i: Vector, n: Vector, r: f64) -> Vector {
    let c = dot(n, scale(i, -1.0));
    let r_c = if c < 0.0 { r } else { 1.0 / r };
    let v = 1.0 + (r_c * r_c) * (c * c - 1.0);
    if v < 0.0 { (0.0, 0.0, 0.0) } else { norm(add(scale(i, r_c), scale(n, r_c * c.abs() - v.sqrt()))) }
}

/// The point of the window that a pixel stands for, for a resolution r and a window of dimensions d.
///
/// ```text
/// §2.3.2   mapToWin : ℕ² ∋ r → ℕ² → (□ (r 0)) × (□ (r 1)) → Point3D
///          mapToWin r d p = ((t 0) / (r 0), (t 1) / (r 1), 0.0)
///                           where t = (p -^ (r ·→ 1/2)) ·^ d
/// A.1      mapToWin (rx,ry) (w,h) (px,py) = (x/rxD,y/ryD,0.0)
///                           where (x,y) = ( (pxD-rxD/2)*wD, (pyD-ryD/2)*hD )
/// ```
///
/// The D marks a number converted to `Double`; ℕ ⊂ ℝ needs no such thing. The dependent type keeps the pixel
/// inside the resolution. Haskell has none, so there and here that is left to the caller
/// ([`Image`](crate::Image) is the one who cares).
#[must_use]
pub fn map_to_win((rx, ry): (i64, i64), (w, h): (i64, i64), (px, py): (i64, i64)) -> Point3D {
    let (rx, ry, w, h, px, py) = (rx as f64, ry as f64, w as f64, h as f64, px as f64, py as f64);
    let (x, y) = ((px - rx / 2.0) * w, (py - ry / 2.0) * h);
    (x / rx, y / ry, 0.0)
}
