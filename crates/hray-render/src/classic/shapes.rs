//! Rays against shapes, several rays at a time.
//!
//! The thesis' sphere and plane are `intRayWith`, `fstPos` and `normal` of appendix A.1 and A.2, with its
//! constants. The exact ones have none: every hit in front of the ray counts, and where a ray that leaves a surface
//! starts is kept clear of it by [`Surface::bound`].

use super::implicit::PreparedImplicit;
use super::mesh::PreparedMesh;
use super::placement::size;
use super::round::{NO_SPOT, Round, Spot};
use super::trace::ray_of;
use fearless_simd::prelude::*;
use hray_core::{DVec3, Integrator, Shape};
use hray_expr::kernels::lanes::{Lanes, MAX_LANES, Mask, Vec3};
use std::sync::Arc;

/// The thesis' least distance of a hit (`fstPos`); it keeps a ray from hitting the spot it starts at.
pub(super) const NEAREST: f64 = 1e-6;
/// In the thesis a ray whose direction makes a smaller product with a plane's normal is parallel to it.
pub(super) const PARALLEL: f64 = 1e-9;
/// Bounds how far the result of some thirty roundings can be from the truth, relative to the numbers involved:
/// gamma(32) of N. Higham, "Accuracy and Stability of Numerical Algorithms", § 3.1. The longest chain here is the
/// sphere's: point minus centre, square, sum, minus the square of the radius.
pub(super) const BOUND: f64 = 16.0 * f64::EPSILON;

/// A shape with what can be computed once.
#[derive(Clone)]
pub(super) enum Prepared {
    /// The thesis'.
    Sphere {
        center: DVec3,
        squared_radius: f64,
        inverse_radius: f64,
    },
    /// The thesis'.
    Plane {
        normal: DVec3,
        offset: f64,
        unit_normal: DVec3,
    },
    ExactSphere {
        center: DVec3,
        radius: f64,
    },
    /// `unit` is a unit vector, or zero where the plane has no normal.
    ExactPlane {
        unit: DVec3,
        offset: f64,
    },
    /// A hit must be farther away than `nearest`.
    Cuboid {
        min: DVec3,
        max: DVec3,
        nearest: f64,
    },
    /// One ray at a time, of those that meet a sphere around it. A hit must be farther away than `nearest`.
    Round {
        shape: Arc<Round>,
        nearest: f64,
        middle: DVec3,
        squared_reach: f64,
    },
    /// Rays go through its own tree, one at a time, and not by [`Prepared::hit`].
    Mesh(Arc<PreparedMesh>),
    /// The same.
    Implicit(Arc<PreparedImplicit>),
}

/// Rays, one per lane, with what every sphere needs of them.
#[derive(Clone, Copy)]
pub(super) struct Rays<S: Simd> {
    pub(super) origin: Vec3<S>,
    pub(super) direction: Vec3<S>,
    double_a: Lanes<S>,
    four_a: Lanes<S>,
}

impl<S: Simd> Rays<S> {
    #[inline(always)]
    pub(super) fn new(origin: Vec3<S>, direction: Vec3<S>) -> Self {
        let a = direction.dot(direction);
        Self { origin, direction, double_a: a * 2.0, four_a: a * 4.0 }
    }
}

/// Where rays meet a shape, in its own space.
#[derive(Clone, Copy)]
pub(super) struct Surface<S: Simd> {
    /// The point, moved onto the surface.
    pub(super) point: Vec3<S>,
    /// The unit normal, outward.
    pub(super) normal: Vec3<S>,
    /// How far from the point along the normal one has to be so that no rounding can tell that one is on the other
    /// side.
    pub(super) bound: Lanes<S>,
}

impl<S: Simd> Surface<S> {
    /// Of one place for each ray.
    #[inline(always)]
    pub(super) fn of_spots(simd: S, spots: &[Spot; MAX_LANES]) -> Self {
        let column =
            |of: fn(&Spot) -> f64| Lanes::<S>::from_slice(simd, &spots.each_ref().map(of)[..Lanes::<S>::LEN]);
        Self {
            point: Vec3 { x: column(|s| s.point.x), y: column(|s| s.point.y), z: column(|s| s.point.z) },
            normal: Vec3 { x: column(|s| s.normal.x), y: column(|s| s.normal.y), z: column(|s| s.normal.z) },
            bound: column(|s| s.bound),
        }
    }
}

impl Prepared {
    /// A shape; none for one made of others, and for a mesh.
    pub(super) fn new(shape: &Shape, integrator: Integrator) -> Option<Self> {
        let thesis = integrator == Integrator::Classic2005;
        Some(match shape {
            Shape::Sphere(sphere) if thesis => Self::Sphere {
                center: sphere.center,
                squared_radius: sphere.radius * sphere.radius,
                inverse_radius: 1.0 / sphere.radius,
            },
            Shape::Sphere(sphere) => Self::ExactSphere { center: sphere.center, radius: sphere.radius },
            Shape::Plane(plane) => {
                let n = plane.normal;
                let length = (n.x * n.x + n.y * n.y + n.z * n.z).sqrt();
                if thesis {
                    let unit_normal = if length < PARALLEL { DVec3::ZERO } else { n * (1.0 / length) };
                    Self::Plane { normal: n, offset: plane.offset, unit_normal }
                } else if length > 0.0 {
                    Self::ExactPlane { unit: n / length, offset: plane.offset / length }
                } else {
                    Self::ExactPlane { unit: DVec3::ZERO, offset: 0.0 }
                }
            }
            Shape::Cuboid(cuboid) => {
                let nearest = if thesis { NEAREST } else { 0.0 };
                Self::Cuboid { min: cuboid.min, max: cuboid.max, nearest }
            }
            Shape::Frustum(_) | Shape::Disc(_) | Shape::Torus(_) | Shape::Quadric(_) => {
                let nearest = if thesis { NEAREST } else { 0.0 };
                let shape = Arc::new(Round::new(shape)?);
                let (middle, reach) = shape.sphere();
                // A little more, for the rounding of the test; infinite and odd numbers let everything through.
                Self::Round { shape, nearest, middle, squared_reach: reach * reach * (1.0 + 1e-9) }
            }
            Shape::Csg(_) | Shape::Inverse(_) | Shape::Clip(_) | Shape::Mesh(_) | Shape::Implicit(_) => {
                return None;
            }
        })
    }

    /// The nearest distance at which each ray meets the shape, and which rays do.
    ///
    /// Returns `None` where it is plain that no ray does.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(&self, simd: S, rays: &Rays<S>) -> Option<(Lanes<S>, Mask<S>)> {
        match *self {
            Self::Sphere { center, squared_radius, .. } => {
                let from_center = rays.origin.sub(Vec3::splat(simd, center));
                let b = rays.direction.dot(from_center) * 2.0;
                let c = from_center.dot(from_center) - squared_radius;
                let discriminant = b * b - rays.four_a * c;
                let missed = discriminant.simd_lt(0.0);
                if missed.all_true() {
                    return None;
                }
                // Both roots are behind: with b and c positive, the root of the discriminant is at most b
                // (unless the square of b overflows).
                let behind = b.simd_gt(0.0) & c.simd_gt(0.0) & discriminant.simd_lt(f64::INFINITY);
                let missed = missed | behind;
                if missed.all_true() {
                    return None;
                }
                // A discriminant that is not a number counts as zero: one root, -b / 2a.
                let zero = Lanes::<S>::splat(simd, 0.0);
                let root = discriminant.simd_gt(0.0).select(discriminant.sqrt(), zero);
                let near = (-b - root) / rays.double_a;
                let near_counts = near.simd_gt(NEAREST);
                if (near_counts | missed).all_true() {
                    return Some((near, near_counts & !missed));
                }
                let far = (root - b) / rays.double_a;
                let distance = near_counts.select(near, far);
                Some((distance, distance.simd_gt(NEAREST) & !missed))
            }
            Self::Plane { normal, offset, .. } => {
                let normal = Vec3::splat(simd, normal);
                let slope = normal.dot(rays.direction);
                let height = normal.dot(rays.origin) + offset;
                // On the plane, or leading away from it. (Where the product vanishes though neither factor
                // does, the distance is far below 1e-6.)
                if (height * slope).simd_ge(0.0).all_true() {
                    return None;
                }
                let distance = -(height / slope);
                Some((distance, distance.simd_gt(NEAREST) & !slope.abs().simd_lt(PARALLEL)))
            }
            // Called, not inlined, so that the loop over the thesis' shapes stays small.
            _ => simd.vectorize(
                #[inline(always)]
                || self.exact_hit(simd, rays),
            ),
        }
    }

    #[inline(always)]
    fn exact_hit<S: Simd>(&self, simd: S, rays: &Rays<S>) -> Option<(Lanes<S>, Mask<S>)> {
        match *self {
            Self::ExactSphere { center, radius } => exact_sphere(simd, center, radius, rays),
            Self::ExactPlane { unit, offset } => {
                let unit = Vec3::splat(simd, unit);
                let slope = unit.dot(rays.direction);
                let height = unit.dot(rays.origin) + offset;
                let distance = -(height / slope);
                Some((distance, distance.simd_gt(0.0) & distance.simd_lt(f64::INFINITY)))
            }
            Self::Cuboid { min, max, nearest } => {
                let [enter, exit] = slabs(simd, min, max, rays).through;
                let outside = enter.simd_gt(nearest);
                let distance = outside.select(enter, exit);
                let met = enter.simd_le(exit) & distance.simd_gt(nearest);
                Some((distance, met & distance.simd_lt(f64::INFINITY)))
            }
            Self::Round { ref shape, nearest, middle, squared_reach } => {
                let from = rays.origin.sub(Vec3::splat(simd, middle));
                let b = from.dot(rays.direction);
                let close = from.sub(rays.direction.scale(b / (rays.double_a * 0.5)));
                let behind = b.simd_gt(0.0) & from.dot(from).simd_gt(squared_reach);
                let away = behind | close.dot(close).simd_gt(squared_reach);
                let mut lanes = !(away.to_bitmask() as u32) & ((1 << Lanes::<S>::LEN) - 1);
                if lanes == 0 {
                    return None;
                }
                let mut distances = [f64::NAN; MAX_LANES];
                while lanes != 0 {
                    let lane = lanes.trailing_zeros() as usize;
                    if let Some(found) = shape.hit(&ray_of(rays, lane), nearest) {
                        distances[lane] = found;
                    }
                    lanes &= lanes - 1;
                }
                let distance = Lanes::<S>::from_slice(simd, &distances[..Lanes::<S>::LEN]);
                Some((distance, distance.simd_eq(distance)))
            }
            Self::Sphere { .. } | Self::Plane { .. } | Self::Mesh(_) | Self::Implicit(_) => None,
        }
    }

    /// The thesis' normals at points of the surface.
    #[inline(always)]
    pub(super) fn thesis_normal<S: Simd>(
        &self,
        simd: S,
        p: Vec3<S>,
        rays: &Rays<S>,
        distance: Lanes<S>,
    ) -> Vec3<S> {
        match *self {
            Self::Sphere { center, inverse_radius, .. } => {
                let inverse_radius = Lanes::<S>::splat(simd, inverse_radius);
                p.sub(Vec3::splat(simd, center)).scale(inverse_radius).norm(simd).0
            }
            Self::Plane { unit_normal, .. } => Vec3::splat(simd, unit_normal),
            _ => self.surface(simd, rays, distance).normal,
        }
    }

    /// Where the rays meet the surface at those distances.
    #[inline(always)]
    pub(super) fn surface<S: Simd>(&self, simd: S, rays: &Rays<S>, distance: Lanes<S>) -> Surface<S> {
        let point = rays.origin.add(rays.direction.scale(distance));
        let bound = |sum: Lanes<S>| sum * BOUND;
        match *self {
            Self::ExactSphere { center, radius } => {
                let from_center = point.sub(Vec3::splat(simd, center));
                let length = from_center.dot(from_center).sqrt();
                let outward = from_center.scale(Lanes::<S>::splat(simd, 1.0) / length);
                let point =
                    outward.scale(Lanes::<S>::splat(simd, radius.abs())).add(Vec3::splat(simd, center));
                let normal = outward.scale(Lanes::<S>::splat(simd, 1.0f64.copysign(radius)));
                let sum = center.x.abs() + center.y.abs() + center.z.abs() + radius.abs();
                Surface { point, normal, bound: bound(Lanes::<S>::splat(simd, sum)) }
            }
            Self::ExactPlane { unit, offset } => {
                let normal = Vec3::splat(simd, unit);
                let point = point.sub(normal.scale(normal.dot(point) + offset));
                Surface { point, normal, bound: bound(size(normal).dot(size(point)) + offset.abs()) }
            }
            Self::Cuboid { min, max, .. } => cuboid_surface(simd, min, max, rays, distance, point),
            Self::Round { ref shape, .. } => {
                let mut spots = [NO_SPOT; MAX_LANES];
                for (lane, spot) in spots.iter_mut().enumerate().take(Lanes::<S>::LEN) {
                    *spot = shape.spot(DVec3::new(point.x[lane], point.y[lane], point.z[lane]));
                }
                Surface::of_spots(simd, &spots)
            }
            // The thesis' have no use for it, and some locate hits by themselves.
            Self::Sphere { .. } | Self::Plane { .. } | Self::Mesh(_) | Self::Implicit(_) => {
                Surface { point, normal: point, bound: Lanes::<S>::splat(simd, 0.0) }
            }
        }
    }
}

/// Both roots without cancellation: the discriminant is taken from the distance of the centre to the ray, and the
/// root that would be a difference of near numbers from the product of both. E. Haines, J. Günther, T. Akenine-
/// Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019, after D. Hearn and
/// M. P. Baker.
#[inline(always)]
fn exact_sphere<S: Simd>(simd: S, center: DVec3, radius: f64, rays: &Rays<S>) -> Option<(Lanes<S>, Mask<S>)> {
    let a = rays.double_a * 0.5;
    let from_center = rays.origin.sub(Vec3::splat(simd, center));
    let b = -from_center.dot(rays.direction);
    let c = from_center.dot(from_center) - radius * radius;
    let ahead = b.simd_ge(0.0) | c.simd_le(0.0);
    let nearest = from_center.add(rays.direction.scale(b / a));
    let discriminant = Lanes::<S>::splat(simd, radius * radius) - nearest.dot(nearest);
    let met = discriminant.simd_ge(0.0) & ahead;
    if met.all_false() {
        return None;
    }
    let q = b + (discriminant * a).sqrt().copysign(b);
    let (t0, t1) = (c / q, q / a);
    let in_order = t0.simd_lt(t1);
    let (near, far) = (in_order.select(t0, t1), in_order.select(t1, t0));
    let distance = near.simd_gt(0.0).select(near, far);
    Some((distance, met & distance.simd_gt(0.0) & distance.simd_lt(f64::INFINITY)))
}

/// Where rays cross the planes of a box's faces.
struct Slabs<S: Simd> {
    /// Of each axis, the distance to the face with the lower and with the higher coordinate.
    faces: [[Lanes<S>; 2]; 3],
    /// The distances at which the rays enter and leave what lies between all of them.
    through: [Lanes<S>; 2],
}

/// A ray in the plane of a face divides zero by zero there, and counts as between the two faces.
#[inline(always)]
fn slabs<S: Simd>(simd: S, min: DVec3, max: DVec3, rays: &Rays<S>) -> Slabs<S> {
    let Rays { origin: o, direction: d, .. } = rays;
    let face = |bound: f64, o: Lanes<S>, d: Lanes<S>| (Lanes::<S>::splat(simd, bound) - o) / d;
    let faces = [
        [face(min.x, o.x, d.x), face(max.x, o.x, d.x)],
        [face(min.y, o.y, d.y), face(max.y, o.y, d.y)],
        [face(min.z, o.z, d.z), face(max.z, o.z, d.z)],
    ];
    let mut enter = Lanes::<S>::splat(simd, f64::NEG_INFINITY);
    let mut exit = Lanes::<S>::splat(simd, f64::INFINITY);
    for [low, high] in faces {
        let in_order = low.simd_lt(high);
        let (near, far) = (in_order.select(low, high), in_order.select(high, low));
        let crosses = low.simd_eq(low) & high.simd_eq(high);
        enter = (crosses & near.simd_gt(enter)).select(near, enter);
        exit = (crosses & far.simd_lt(exit)).select(far, exit);
    }
    Slabs { faces, through: [enter, exit] }
}

#[inline(always)]
fn cuboid_surface<S: Simd>(
    simd: S,
    min: DVec3,
    max: DVec3,
    rays: &Rays<S>,
    distance: Lanes<S>,
    point: Vec3<S>,
) -> Surface<S> {
    let faces = slabs(simd, min, max, rays).faces;
    let zero = Lanes::<S>::splat(simd, 0.0);
    let mut found = distance.simd_lt(f64::NEG_INFINITY);
    let (mut on, mut out) = ([point.x, point.y, point.z], [zero; 3]);
    let mut sum = zero;
    for axis in 0..3 {
        let largest = min[axis].abs().max(max[axis].abs());
        for (side, coordinate, sign) in [(0, min[axis], -1.0), (1, max[axis], 1.0)] {
            let this = faces[axis][side].simd_eq(distance) & !found;
            on[axis] = this.select(Lanes::<S>::splat(simd, coordinate), on[axis]);
            out[axis] = this.select(Lanes::<S>::splat(simd, sign), out[axis]);
            sum = this.select(Lanes::<S>::splat(simd, largest), sum);
            found |= this;
        }
    }
    let [x, y, z] = on;
    let point = Vec3 { x, y, z };
    let [x, y, z] = out;
    Surface { point, normal: Vec3 { x, y, z }, bound: sum * BOUND }
}
