//! Rays against shapes, several rays at a time: `intRayWith`, `fstPos` and `normal` of appendix A.1 and A.2.

use fearless_simd::prelude::*;
use hray_core::{DVec3, Shape};
use hray_expr::kernels::lanes::{Lanes, Mask, Vec3};

/// A hit must be farther away than this (`fstPos`); it keeps a ray from hitting the spot it starts at.
const NEAREST: f64 = 1e-6;
/// A ray whose direction makes a smaller product with a plane's normal is parallel to it.
const PARALLEL: f64 = 1e-9;

/// A shape with what can be computed once.
#[derive(Clone, Copy)]
pub(super) enum Prepared {
    Sphere { center: DVec3, squared_radius: f64, inverse_radius: f64 },
    Plane { normal: DVec3, offset: f64, unit_normal: DVec3 },
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

impl Prepared {
    pub(super) fn new(shape: &Shape) -> Self {
        match *shape {
            Shape::Sphere(sphere) => Self::Sphere {
                center: sphere.center,
                squared_radius: sphere.radius * sphere.radius,
                inverse_radius: 1.0 / sphere.radius,
            },
            Shape::Plane(plane) => {
                let n = plane.normal;
                let length = (n.x * n.x + n.y * n.y + n.z * n.z).sqrt();
                let unit_normal = if length < PARALLEL { DVec3::ZERO } else { n * (1.0 / length) };
                Self::Plane { normal: n, offset: plane.offset, unit_normal }
            }
            Shape::Cuboid(_) | Shape::Csg(_) => {
                Self::Plane { normal: DVec3::ZERO, offset: 0.0, unit_normal: DVec3::ZERO }
            }
        }
    }

    /// The nearest distance beyond 1e-6 at which each ray meets the shape, and which rays do.
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
        }
    }

    /// Normals at points of the surface.
    #[inline(always)]
    pub(super) fn normal<S: Simd>(&self, simd: S, p: Vec3<S>) -> Vec3<S> {
        match *self {
            Self::Sphere { center, inverse_radius, .. } => {
                let inverse_radius = Lanes::<S>::splat(simd, inverse_radius);
                p.sub(Vec3::splat(simd, center)).scale(inverse_radius).norm(simd).0
            }
            Self::Plane { unit_normal, .. } => Vec3::splat(simd, unit_normal),
        }
    }
}
