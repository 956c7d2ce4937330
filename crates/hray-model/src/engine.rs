//! The core of the algorithm in §2.3.2: module `HRayEngine` of A.2.
//!
//! Two parameters come in addition to those of the thesis. The noise tables, which the program has as
//! constants, are passed down to whoever asks for a colour. And from `colorPt` up the program has a recursion
//! depth where chapter 2 recurs without end; §2.3.3 closes with that very observation.

use crate::concepts::{
    Color, Image, Intersection, Light, PointLight, Ray, Scene, TexturedObject, Vector, mk_int, mk_ray,
    mk_ray_dir,
};
use crate::helpers::{
    color_at, dim, dir, eye, int_dist, int_pt, int_text, is_empty, normal_at, refl_coef, refr_coef,
    refr_index, spec_coef,
};
use crate::maths::{
    SAME_SURFACE, add, clip, dist, dot, int_ray_with, map_to_win, mk_norm_vect, mul, norm, reflect_dir,
    refract_dir, scale,
};
use crate::perlin::NoiseTables;
use std::fmt;

/// The first positive element of a list, 0 if there is none.
///
/// ```text
/// §2.3.2   fstPos : ℝ* → ℝ
///          fstPos ε        = 0
///          fstPos (x ≻ xs) = x > 0 ? x † fstPos xs
/// A.2      fstPos []       = 0.0
///          fstPos (l:ls)   = if l > 10**(-6) then l else fstPos ls
/// ```
///
/// Positive means above [`SAME_SURFACE`] to the program.
#[must_use]
pub fn fst_pos(list: &[f64]) -> f64 {
    match list {
        [] => 0.0,
        [l, ls @ ..] => {
            if *l > SAME_SURFACE {
                *l
            } else {
                fst_pos(ls)
            }
        }
    }
}

/// The nearer of a given intersection and that of the ray with an object; the given one at equal distances.
///
/// ```text
/// §2.3.2   closestInt : Ray → Intersection → TexturedObject → Intersection
///          closestInt r i o = d > 0 ∧ (isEmpty i ∨ d < (intDist i)) ? mkInt d r o † i
///                             where d = fstPos (intRayWith r (o 0))
/// A.2      closestInt r i (o,m) = if d > 10**(-6) && ((isNothing i) || d < (intDist i))
///                                 then Just (Intersection d r (o,m)) else i
///                             where d = fstPos (intRayWith r o)
/// ```
///
/// Positive means above [`SAME_SURFACE`] to the program.
#[must_use]
pub fn closest_int(r: Ray, i: Option<Intersection>, o: TexturedObject) -> Option<Intersection> {
    let d = fst_pos(&int_ray_with(r, o.0));
    if d > SAME_SURFACE && (is_empty(i) || d < int_dist(i)) { Some(mk_int(d, r, o)) } else { i }
}

/// The nearest intersection of a ray with a list of objects in source order. Of several at the same distance
/// it is the one written last.
///
/// ```text
/// §2.3.2   intersect : Ray → TexturedObject* → Intersection
///          intersect r o = (closestInt r) ⟶[ε] o
/// A.2      intersect r o = foldl (closestInt r) Nothing o
/// ```
///
/// The program folds over the list that its parser made, which is the reverse of the source.
#[must_use]
pub fn intersect(r: Ray, objects: &[TexturedObject]) -> Option<Intersection> {
    let mut i = None;
    for &o in objects.iter().rev() {
        i = closest_int(r, i, o);
    }
    i
}

/// The colour of a surface as a point light shows it: by the cosine of the angle at which the light comes in,
/// a negative one included.
///
/// ```text
/// §2.3.2   diff : Intersection → PointLight → Color
///          diff i l = ((int l) ·→ ((mkNormVect (intPt i) (pos l)) • (normalAt i))) ·^ (colorAt i)
/// A.2      diff _ (AmbientLight _) = (0.0,0.0,0.0)
///          diff i (PointLight pos int) = (int *> ((mkNormVect (intPt i) pos) *. (normalAt i))) <*> (colorAt i)
/// ```
///
/// A point light is a constructor and no type in Haskell, so the program needs a case for the other one too;
/// nothing asks for it.
#[must_use]
pub fn diff(i: Option<Intersection>, l: Light, tables: &NoiseTables) -> Color {
    match l {
        Light::AmbientLight(_) => (0.0, 0.0, 0.0),
        Light::PointLight(PointLight { pos, int }) => {
            mul(scale(int, dot(mk_norm_vect(int_pt(i), pos), normal_at(i))), color_at(i, tables))
        }
    }
}

/// The highlight of a point light, for a surface seen along d.
///
/// ```text
/// §2.3.2   spec : Intersection → Vector → PointLight → Color
///          spec i d l = (int l) ·→ ((reflCoef (intText i)) · ((normalAt i) • h) ^ (specCoef (intText i)))
///                       where h = norm ((d ·→ -1) +^ (mkNormVect (intPt i) (pos l)))
/// A.2      spec _ _ (AmbientLight _) = (0.0,0.0,0.0)
///          spec i d (PointLight pos int)
///            = int *> (reflCoef * (((normalAt i) *. h)**(fromIntegral specCoef)))
///                       where h = norm ((d *> (-1)) <+> (mkNormVect (intPt i) pos))
/// ```
///
/// The factor is the reflection coefficient; there is no separate one. The power is that of two doubles: a
/// negative base keeps its sign for an odd exponent and loses it for an even one, and 0 to the 0 is 1.
#[must_use]
pub fn spec(i: Option<Intersection>, d: Vector, l: Light) -> Color {
    match l {
        Light::AmbientLight(_) => (0.0, 0.0, 0.0),
        Light::PointLight(PointLight { pos, int }) => {
            let t = int_text(i);
            let h = norm(add(scale(d, -1.0), mk_norm_vect(int_pt(i), pos)));
            scale(int, refl_coef(t) * libm::pow(dot(normal_at(i), h), spec_coef(t) as f64))
        }
    }
}

/// What one light contributes where an object is hit, seen along d: nothing if any object, even a
/// transparent one, is met on the way to a point light or exactly at it.
///
/// ```text
/// §2.3.2   shadePt : Intersection → Vector → TexturedObject* → Light → Color
///          shadePt i d o l = clip (l ∈ AmbientLight ? int l † (s ? (0, 0, 0) † (diff i l) +^ (spec i d l)))
///                            where s  = ¬ (isEmpty i') ∧ intDist i' ≤ dist (intPt i) (pos l)
///                                  i' = intersect (mkRay (intPt i) (pos l)) o
/// A.2      shadePt i d o (AmbientLight int) = int
///          shadePt i d o l@(PointLight pos int)
///            | s         = (0.0,0.0,0.0)
///            | otherwise = (diff (Just i) l) <+> (spec (Just i) d l)
///                            where s   = not (isNothing i_s) && (intDist i_s) <= dist (intPt (Just i)) pos
///                                  i_s = intersect (mkRay (intPt (Just i)) pos) o
/// ```
///
/// The model clips the contribution of each light, the program only the sum of everything in [`color_pt`], so
/// there one light can darken what another lit. An ambient light is not multiplied by the colour of the
/// surface.
#[must_use]
pub fn shade_pt(
    i: Intersection,
    d: Vector,
    objects: &[TexturedObject],
    l: Light,
    tables: &NoiseTables,
) -> Color {
    let i = Some(i);
    match l {
        Light::AmbientLight(ambient) => ambient.int,
        Light::PointLight(PointLight { pos, .. }) => {
            let i_s = intersect(mk_ray(int_pt(i), pos), objects);
            let s = !is_empty(i_s) && int_dist(i_s) <= dist(int_pt(i), pos);
            if s { (0.0, 0.0, 0.0) } else { add(diff(i, l, tables), spec(i, d, l)) }
        }
    }
}

/// What is seen mirrored where an object is hit along d. The background is not mirrored: behind a mirror it
/// is black.
///
/// ```text
/// §2.3.2   reflectPt : Intersection → Vector → TexturedObject* → Light* → Color
///          reflectPt i d = colorPt (mkRay' (intPt i) (reflectDir d (normalAt i))) (0, 0, 0)
/// A.2      reflectPt depth i d = colorPt depth (Ray (intPt (Just i)) (reflectDir d (normalAt (Just i))))
///                                                                    (0.0,0.0,0.0)
/// ```
///
/// The program adds the depth.
#[must_use]
pub fn reflect_pt(
    depth: Depth,
    i: Intersection,
    d: Vector,
    objects: &[TexturedObject],
    lights: &[Light],
    tables: &NoiseTables,
) -> Color {
    let i = Some(i);
    let ray = mk_ray_dir(int_pt(i), reflect_dir(d, normal_at(i)));
    color_pt(depth, ray, (0.0, 0.0, 0.0), objects, lights, tables)
}

/// What is seen through an object that is hit along d, black at total internal reflection. The background b
/// is dimmed by the coefficient of refraction here, and with everything else once more in [`color_pt`].
///
/// ```text
/// §2.3.2   refractPt : Intersection → Vector → Color → TexturedObject* → Light* → Color
///          refractPt i d b = (d' = (0, 0, 0)) ? (0, 0, 0)
///                                             † colorPt (mkRay' (intPt i) d') (b ·→ (refrCoef (intText i)))
///                            where d' = refractDir d (normalAt i) (refrIndex (intText i))
/// A.2      refractPt depth i d b = if refractedDir == (0.0,0.0,0.0) then (\x y -> (0.0,0.0,0.0))
///                                  else colorPt depth (Ray (intPt (Just i)) refractedDir) (b *> refrCoef)
/// ```
///
/// The program adds the depth.
#[must_use]
pub fn refract_pt(
    depth: Depth,
    i: Intersection,
    d: Vector,
    b: Color,
    objects: &[TexturedObject],
    lights: &[Light],
    tables: &NoiseTables,
) -> Color {
    let i = Some(i);
    let t = int_text(i);
    let refracted_dir = refract_dir(d, normal_at(i), refr_index(t));
    if refracted_dir == (0.0, 0.0, 0.0) {
        (0.0, 0.0, 0.0)
    } else {
        color_pt(depth, mk_ray_dir(int_pt(i), refracted_dir), scale(b, refr_coef(t)), objects, lights, tables)
    }
}

/// The colour that a ray sees, before a background b, among objects and lights in source order.
///
/// ```text
/// §2.3.2   colorPt : Ray → Color → TexturedObject* → Light* → Color
///          colorPt r b o l = isEmpty i ? b † clip (    ((+^) ⟶[(0, 0, 0)] ((shadePt i (dir r) o) ∘ l))
///                                                   +^ (reflectPt i (dir r) o l)   ·→ (reflCoef (intText i))
///                                                   +^ (refractPt i (dir r) b o l) ·→ (refrCoef (intText i)))
///                            where i = intersect r o
/// A.2      colorPt (-1) _ _ _ = (0.0, 0.0, 0.0)
///          colorPt d r@(Ray _ dir) b o l
///            = if (isNothing i) then b else clip $ shadeColor <+> reflectColor <+> refractColor
///              where shadeColor   = foldl (<+>) (0.0,0.0,0.0) (map (shadePt (fromJust i) dir o) l)
///                    reflectColor = if (reflCoef == 0.0) then (0.0, 0.0, 0.0)
///                                   else (reflectPt (d-1) (fromJust i) dir o l) *> reflCoef
///                    refractColor = if (refrCoef == 0.0) then (0.0, 0.0, 0.0)
///                                   else (refractPt (d-1) (fromJust i) dir b o l) *> refrCoef
///                    i = intersect r o
/// ```
///
/// The program ends the recursion in black at depth -1 and does not enter it for a coefficient of exactly 0.
/// The background is returned as it is, not clipped. The program's list of lights is the reverse of the
/// source, so the contribution of the light written last is added first. §3.3 says that `closestInt` watches
/// the depth; it is this function that does.
#[must_use]
pub fn color_pt(
    depth: Depth,
    r: Ray,
    b: Color,
    objects: &[TexturedObject],
    lights: &[Light],
    tables: &NoiseTables,
) -> Color {
    let Some(less) = depth.less() else { return (0.0, 0.0, 0.0) };
    let Some(i) = intersect(r, objects) else { return b };
    let t = int_text(Some(i));
    let mut shade_color = (0.0, 0.0, 0.0);
    for &l in lights.iter().rev() {
        shade_color = add(shade_color, shade_pt(i, dir(r), objects, l, tables));
    }
    let reflect_color = if refl_coef(t) == 0.0 {
        (0.0, 0.0, 0.0)
    } else {
        scale(reflect_pt(less, i, dir(r), objects, lights, tables), refl_coef(t))
    };
    let refract_color = if refr_coef(t) == 0.0 {
        (0.0, 0.0, 0.0)
    } else {
        scale(refract_pt(less, i, dir(r), b, objects, lights, tables), refr_coef(t))
    };
    clip(add(add(shade_color, reflect_color), refract_color))
}

/// The colour that a scene shows in a point of the window. The ray starts in that point, not in the eye, so
/// nothing between the two is seen.
///
/// ```text
/// §2.3.2   rayTracePt : Scene → Point3D → Color
///          rayTracePt s p = colorPt (mkRay' p (mkNormVect (eye (s 0)) p)) (s 1) (s 2) (s 3)
/// A.2      rayTracePt d (Scene (Camera eye _) b o l) p = colorPt d (Ray p (mkNormVect eye p)) b o l
/// ```
///
/// The program adds the depth.
#[must_use]
pub fn ray_trace_pt(depth: Depth, scene: &Scene, p: Vector, tables: &NoiseTables) -> Color {
    let ray = mk_ray_dir(p, mk_norm_vect(eye(scene.camera), p));
    color_pt(depth, ray, scene.background, &scene.objects, &scene.lights, tables)
}

/// The picture of a scene at a resolution.
///
/// ```text
/// §2.3.2   rayTrace : ℕ² → Scene → Image
///          rayTrace r sc = (rayTracePt sc) ∘ (mapToWin r (dim (sc 0)))
/// A.2      rayTrace d r s@(Scene (Camera _ dim) _ _ _) = (rayTracePt d s) . (mapToWin r dim)
/// ```
///
/// The program adds the depth.
///
/// # Errors
/// [`EndlessRecursion`] where the depth is below -1.
pub fn ray_trace<'a>(
    depth: i64,
    resolution: (i64, i64),
    scene: &'a Scene,
    tables: &'a NoiseTables,
) -> Result<Image<'a>, EndlessRecursion> {
    let depth = Depth::new(depth)?;
    Ok(Image::new(resolution, move |p| {
        ray_trace_pt(depth, scene, map_to_win(resolution, dim(scene.camera), p), tables)
    }))
}

/// How many more times a ray may be reflected or refracted, from -1, where it sees only black.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Depth(i64);

impl Depth {
    /// A depth of -1 or more.
    ///
    /// # Errors
    /// [`EndlessRecursion`] below -1: counting down, the program never met its base case again.
    pub fn new(depth: i64) -> Result<Self, EndlessRecursion> {
        if depth < -1 { Err(EndlessRecursion { depth }) } else { Ok(Self(depth)) }
    }

    /// The depth one level down; none below -1.
    fn less(self) -> Option<Self> {
        if self.0 == -1 { None } else { Some(Self(self.0 - 1)) }
    }
}

/// A recursion depth from which the program of 2005 never came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EndlessRecursion {
    /// The depth that was asked for.
    pub depth: i64,
}

impl fmt::Display for EndlessRecursion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "recursion depth {} is below -1 and would never end", self.depth)
    }
}

impl std::error::Error for EndlessRecursion {}
