//! The rays: from an eye through a picture, and from what these hit in random directions and to a light.
//!
//! Everything is worked out in doubles and rounded to single precision at the end, so that another program can
//! trace the same rays.

use crate::meshes::{Mesh, MeshName};
use crate::trace::Hit;
use clap::ValueEnum;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Pixels along a side of the picture.
pub const RESOLUTION: u32 = 1024;
/// Diffuse rays from each point that a primary ray hits.
pub const DIFFUSE_RAYS: u32 = 4;

/// A ray, as it lies in memory before somebody traces it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Ray {
    /// Where it starts.
    pub origin: [f32; 3],
    /// Hits nearer than this do not count; a multiple of the direction's length.
    pub tnear: f32,
    /// Where to.
    pub direction: [f32; 3],
    /// Hits farther than this do not count; a multiple of the direction's length.
    pub tfar: f32,
}

impl Ray {
    fn new(origin: DVec3, direction: DVec3, tfar: f64) -> Self {
        Self {
            origin: origin.as_vec3().to_array(),
            tnear: 0.0,
            direction: direction.as_vec3().to_array(),
            tfar: tfar as f32,
        }
    }

    fn origin(&self) -> DVec3 {
        DVec3::from_array(self.origin.map(f64::from))
    }

    fn direction(&self) -> DVec3 {
        DVec3::from_array(self.direction.map(f64::from))
    }
}

/// Which rays, and what is asked of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    /// From the eye through each pixel, row by row: the nearest hit.
    Primary,
    /// Four from each primary hit, distributed as light falls on a matt surface: the nearest hit.
    Diffuse,
    /// The diffuse rays in random order: no ray is near the one before it.
    Shuffled,
    /// The diffuse rays: whether anything is hit.
    Ao,
    /// From each primary hit to the light: whether anything is between.
    Shadow,
}

impl Kind {
    /// All of them, in the order of the tables.
    pub const ALL: [Self; 5] = [Self::Primary, Self::Diffuse, Self::Shuffled, Self::Ao, Self::Shadow];

    /// Whether any hit will do.
    #[must_use]
    pub fn any_hit(self) -> bool {
        matches!(self, Self::Ao | Self::Shadow)
    }
}

/// Where a mesh is seen from.
#[derive(Clone, Copy, Debug)]
pub struct View {
    eye: DVec3,
    at: DVec3,
    /// Vertical, in degrees.
    field: f64,
    light: DVec3,
    /// The length of the diagonal of the mesh's bounds.
    diagonal: f64,
}

impl View {
    /// The view of a mesh that the benchmark takes.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Self {
        let (low, high) = mesh.bounds();
        let diagonal = (high - low).length();
        if mesh.name == MeshName::Terrain {
            return Self {
                eye: DVec3::new(0.0, 0.6, 1.4),
                at: DVec3::ZERO,
                field: 45.0,
                light: DVec3::new(1.5, 1.0, -0.8),
                diagonal,
            };
        }
        let centre = (low + high) * 0.5;
        Self {
            eye: centre + diagonal * DVec3::new(0.35, 0.25, 1.0),
            at: centre,
            field: 40.0,
            light: centre + diagonal * DVec3::new(-0.5, 1.0, 0.6),
            diagonal,
        }
    }
}

/// All rays against one mesh.
#[derive(Clone, Debug)]
pub struct Rays {
    primary: Vec<Ray>,
    diffuse: Vec<Ray>,
    shuffled: Vec<Ray>,
    shadow: Vec<Ray>,
}

impl Rays {
    /// The primary rays, and the rays from what these hit, which `trace` finds out: one hit for each ray.
    #[must_use]
    pub fn new(mesh: &Mesh, trace: impl FnOnce(&[Ray]) -> Vec<Hit>) -> Self {
        let view = View::of(mesh);
        let primary = primary(&view);
        let hits = trace(&primary);
        let mut diffuse = Vec::new();
        let mut shadow = Vec::new();
        for ((pixel, ray), hit) in (0u32..).zip(&primary).zip(&hits).filter(|(_, hit)| hit.is_hit()) {
            let (point, normal) = surface(mesh, &view, ray, hit);
            diffuse.extend((0..DIFFUSE_RAYS).map(|k| diffuse_ray(point, normal, pixel * DIFFUSE_RAYS + k)));
            let way = view.light - point;
            shadow.push(Ray::new(point, unit(way), way.length()));
        }
        let mut shuffled = diffuse.clone();
        shuffle(&mut shuffled);
        Self { primary, diffuse, shuffled, shadow }
    }

    /// The rays of a kind.
    #[must_use]
    pub fn of(&self, kind: Kind) -> &[Ray] {
        match kind {
            Kind::Primary => &self.primary,
            Kind::Diffuse | Kind::Ao => &self.diffuse,
            Kind::Shuffled => &self.shuffled,
            Kind::Shadow => &self.shadow,
        }
    }
}

/// A ray through the middle of each pixel, row by row from the top.
#[must_use]
pub fn primary(view: &View) -> Vec<Ray> {
    let forward = unit(view.at - view.eye);
    let side = unit(forward.cross(DVec3::Y));
    let up = side.cross(forward);
    let extent = libm::tan(view.field.to_radians() / 2.0);
    let side_at = |i: u32| 2.0 * (f64::from(i) + 0.5) / f64::from(RESOLUTION) - 1.0;
    let pixels = (0..RESOLUTION).flat_map(|y| (0..RESOLUTION).map(move |x| (x, y)));
    let directions = pixels.map(|(x, y)| forward + side * side_at(x) * extent - up * side_at(y) * extent);
    directions.map(|direction| Ray::new(view.eye, unit(direction), f64::INFINITY)).collect()
}

/// The point that a ray hits, moved off the surface a little, and the normal there on the side of the ray.
fn surface(mesh: &Mesh, view: &View, ray: &Ray, hit: &Hit) -> (DVec3, DVec3) {
    let [a, b, c] = mesh.corners(hit.triangle);
    let normal = unit((b - a).cross(c - a));
    let normal = if normal.dot(ray.direction()) > 0.0 { -normal } else { normal };
    let offset = f64::from((1e-4 * view.diagonal) as f32);
    (ray.origin() + ray.direction() * f64::from(hit.t) + normal * offset, normal)
}

/// A direction around the normal, more often near it by the cosine of their angle.
fn diffuse_ray(point: DVec3, normal: DVec3, number: u32) -> Ray {
    let first = pcg(number);
    let second = pcg(first ^ 0x9e37_79b9);
    let [r1, r2] = [first, second].map(|hash| f64::from(hash >> 8) / 16_777_216.0);
    let (radius, angle) = (r1.sqrt(), 2.0 * PI * r2);
    let local = DVec2::new(libm::cos(angle), libm::sin(angle)) * radius;
    let (tangent, bitangent) = frame(normal);
    Ray::new(point, tangent * local.x + bitangent * local.y + normal * (1.0 - r1).sqrt(), f64::INFINITY)
}

/// A vector divided by its length. (`glam` multiplies by the reciprocal, which is not the same double.)
fn unit(v: DVec3) -> DVec3 {
    v / v.length()
}

/// Two unit vectors at right angles to a unit vector and to each other.
///
/// T. Duff et al., *Building an Orthonormal Basis, Revisited*, Journal of Computer Graphics Techniques 6(1), 2017.
#[must_use]
pub fn frame(n: DVec3) -> (DVec3, DVec3) {
    let sign = 1f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    (DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), DVec3::new(b, sign + n.y * n.y * a, -n.y))
}

/// A hash of 32 bits: one step of a PCG generator with its output function.
///
/// M. Jarzynski and M. Olano, *Hash Functions for GPU Rendering*, Journal of Computer Graphics Techniques 9(3), 2020.
#[must_use]
pub fn pcg(v: u32) -> u32 {
    let state = v.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Puts things into an order that looks random and is the same each time (Fisher and Yates).
pub fn shuffle<T>(things: &mut [T]) {
    let count = u32::try_from(things.len()).unwrap_or(u32::MAX);
    for i in (1..count).rev() {
        things.swap(i as usize, (pcg(i) % (i + 1)) as usize);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::terrain;

    #[test]
    fn the_hash_is_that_of_the_literature() {
        let hashes = [0, 1, 2, 4_194_303, u32::MAX].map(pcg);
        assert_eq!(hashes, [129_708_002, 2_831_084_092, 2_055_130_248, 3_663_605_101, 3_861_530_882]);
    }

    #[test]
    fn a_frame_is_orthonormal_and_right_handed() {
        for number in 0..1000 {
            let [x, y, z] =
                [0, 1, 2].map(|axis| f64::from(pcg(3 * number + axis)) / f64::from(u32::MAX) - 0.5);
            let normal = DVec3::new(x, y, z).normalize();
            let (tangent, bitangent) = frame(normal);
            assert!((tangent.cross(bitangent) - normal).length() < 1e-14);
            assert!((tangent.length() - 1.0).abs() < 1e-14 && (bitangent.length() - 1.0).abs() < 1e-14);
        }
        assert_eq!(frame(DVec3::NEG_Z).0, DVec3::X);
    }

    #[test]
    fn shuffling_permutes() {
        let mut things: Vec<u32> = (0..10_000).collect();
        shuffle(&mut things);
        let moved = (0u32..).zip(&things).filter(|(i, thing)| i != *thing).count();
        assert!(moved > 9_900, "{moved}");
        things.sort_unstable();
        assert!(things.into_iter().eq(0..10_000));
        shuffle::<u32>(&mut []);
    }

    #[test]
    fn each_hit_has_its_rays() {
        let mesh = terrain(4);
        let rays = Rays::new(&mesh, |primary| {
            let hit = |i| if i % 1000 == 0 { Hit { t: 1.0, triangle: 3 } } else { Hit::MISS };
            (0..primary.len()).map(hit).collect()
        });
        let counts = Kind::ALL.map(|kind| rays.of(kind).len());
        assert_eq!(counts, [1_048_576, 4196, 4196, 4196, 1049]);
        for ray in Kind::ALL.into_iter().flat_map(|kind| rays.of(kind)) {
            assert!((ray.direction().length() - 1.0).abs() < 1e-6);
        }
        assert_eq!(size_of::<Ray>(), 32);
    }

    #[test]
    fn the_middle_of_the_picture_is_ahead() {
        let rays = primary(&View::of(&terrain(4)));
        let middle = [511 * 1024 + 511, 511 * 1024 + 512, 512 * 1024 + 511, 512 * 1024 + 512];
        let sum: DVec3 = middle.map(|i: usize| rays[i].direction()).into_iter().sum();
        assert!((sum.normalize() - DVec3::new(0.0, -0.6, -1.4).normalize()).length() < 1e-6);
        assert!(rays[0].direction[0] < 0.0 && rays[0].direction[1] > rays[1_048_575].direction[1]);
    }
}
