//! Objects that are placed in the world by an affine transform.
//!
//! Rays are taken to object space, where their direction is not made a unit vector: so a distance along the ray is
//! the same number in both spaces. The scalar forms do the operations of the lanes in the same order.

use super::shapes::Rays;
use super::solid::Ray;
use fearless_simd::prelude::*;
use hray_core::{DAffine3, DMat3, DVec3};
use hray_expr::kernels::lanes::{Lanes, Vec3};
use std::sync::Arc;

/// An invertible affine transform, and its inverse.
pub(super) struct Placement {
    to_world: Arc<DAffine3>,
    to_object: DAffine3,
}

impl Placement {
    pub(super) fn new(to_world: Arc<DAffine3>) -> Self {
        let to_object = to_world.inverse();
        Self { to_world, to_object }
    }

    /// Rays in object space.
    #[inline(always)]
    pub(super) fn rays<S: Simd>(&self, simd: S, rays: &Rays<S>) -> Rays<S> {
        Rays::new(
            point(simd, &self.to_object, rays.origin),
            vector::<S>(&self.to_object.matrix3, rays.direction),
        )
    }

    /// One ray in object space.
    pub(super) fn ray(&self, ray: &Ray) -> Ray {
        let DAffine3 { matrix3: m, translation: t } = self.to_object;
        let turn = |v: DVec3| m.x_axis * v.x + m.y_axis * v.y + m.z_axis * v.z;
        Ray { origin: turn(ray.origin) + t, direction: turn(ray.direction) }
    }

    /// The corners of a box with sides along the world's axes around the image of one with sides along the object's.
    pub(super) fn box_to_world(&self, min: DVec3, max: DVec3) -> [DVec3; 2] {
        let (center, half) = ((min + max) * 0.5, (max - min) * 0.5);
        let DMat3 { x_axis, y_axis, z_axis } = self.to_world.matrix3;
        let half = x_axis.abs() * half.x + y_axis.abs() * half.y + z_axis.abs() * half.z;
        let center = self.to_world.transform_point3(center);
        [center - half, center + half]
    }

    /// A direction or a difference of points of object space in the world.
    pub(super) fn vector_to_world(&self, v: DVec3) -> DVec3 {
        self.to_world.transform_vector3(v)
    }

    /// A point of object space in the world.
    #[inline(always)]
    pub(super) fn to_world<S: Simd>(&self, simd: S, p: Vec3<S>) -> Vec3<S> {
        point(simd, &self.to_world, p)
    }

    /// A normal or a gradient of object space in the world: by the transpose of the inverse. Its length says how
    /// far one gets in object space, along the unit normal, by a unit step along the normal in the world.
    #[inline(always)]
    pub(super) fn normal_to_world<S: Simd>(&self, n: Vec3<S>) -> Vec3<S> {
        let m = &self.to_object.matrix3;
        Vec3 {
            x: n.x * m.x_axis.x + n.y * m.x_axis.y + n.z * m.x_axis.z,
            y: n.x * m.y_axis.x + n.y * m.y_axis.y + n.z * m.y_axis.z,
            z: n.x * m.z_axis.x + n.y * m.z_axis.y + n.z * m.z_axis.z,
        }
    }

    /// How far, in object space and along `normal`, a point may get on its way to the world and back: what it is
    /// seen to get, and a bound of what the rounding of other points nearby may add. `p` is the point in object
    /// space, `world` what [`Placement::to_world`] made of it.
    #[inline(always)]
    pub(super) fn round_trip<S: Simd>(
        &self,
        simd: S,
        p: Vec3<S>,
        world: Vec3<S>,
        normal: Vec3<S>,
    ) -> Lanes<S> {
        let back = point(simd, &self.to_object, world);
        let DAffine3 { matrix3: m, translation: t } = self.to_object;
        let sizes = DMat3::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs());
        let sums = vector::<S>(&sizes, size(world)).add(Vec3::splat(simd, t.abs()));
        let away = size(back.sub(p));
        let bound = sums.scale(Lanes::<S>::splat(simd, super::shapes::BOUND)).add(away).add(away);
        size(normal).dot(bound)
    }
}

#[inline(always)]
fn point<S: Simd>(simd: S, m: &DAffine3, p: Vec3<S>) -> Vec3<S> {
    vector::<S>(&m.matrix3, p).add(Vec3::splat(simd, m.translation))
}

#[inline(always)]
fn vector<S: Simd>(m: &DMat3, v: Vec3<S>) -> Vec3<S> {
    Vec3 {
        x: v.x * m.x_axis.x + v.y * m.y_axis.x + v.z * m.z_axis.x,
        y: v.x * m.x_axis.y + v.y * m.y_axis.y + v.z * m.z_axis.y,
        z: v.x * m.x_axis.z + v.y * m.y_axis.z + v.z * m.z_axis.z,
    }
}

/// The absolute value of each component.
#[inline(always)]
pub(super) fn size<S: Simd>(v: Vec3<S>) -> Vec3<S> {
    Vec3 { x: v.x.abs(), y: v.y.abs(), z: v.z.abs() }
}
