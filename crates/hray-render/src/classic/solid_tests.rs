//! Solids: with boxes and without, of shapes and of the meshes that stand for them.

use super::bounds::of_solid;
use super::geometry::Geometry;
use super::material::Materials;
use super::mesh_trees::MeshTrees;
use super::plans::Plans;
use super::shapes::Prepared;
use super::solid::{Ray, SolidHit, Walk};
use fearless_simd::{Level, dispatch};
use hray_bvh::Stack;
use hray_core::{
    Clip, Csg, CsgOperation, Cuboid, DAffine3, DMat3, DVec3, Frustum, Integrator, Material, Mesh, Plane,
    Primitive, Quadric, Rgb, Shape, Sphere, Texture, Torus,
};
use proptest::prelude::*;
use std::sync::Arc;

fn part(shape: Shape, transform: Option<DAffine3>) -> Primitive {
    let material = Arc::new(Material::matte(Texture::Solid(Rgb::new(1.0, 1.0, 1.0))));
    Primitive { shape, transform: transform.map(Arc::new), material }
}

fn csg(operation: CsgOperation, a: Primitive, b: Primitive) -> Primitive {
    part(Shape::Csg(Arc::new(Csg { operation, operands: [a, b] })), None)
}

fn inverse(solid: Primitive) -> Primitive {
    part(Shape::Inverse(Arc::new(solid)), None)
}

/// A solid within what is not it but moved.
fn clip(solid: &Primitive) -> Primitive {
    let moved = Primitive {
        transform: Some(Arc::new(DAffine3::from_translation(DVec3::X))),
        ..inverse(solid.clone())
    };
    part(Shape::Clip(Arc::new(Clip { shape: solid.clone(), within: moved })), None)
}

fn geometry(solid: Primitive) -> Geometry {
    let mut materials = Materials::new(Plans::new(&hray_core::NoiseTables::default()));
    Geometry::new(&[solid], Integrator::Classic, &mut materials, &mut MeshTrees::default()).ok().unwrap()
}

fn hit(geometry: &Geometry, ray: &Ray) -> Option<SolidHit> {
    let mut walk = Walk::default();
    dispatch!(Level::new(), simd => geometry.solids[0].hit(simd, geometry, ray, f64::INFINITY, &mut walk))
}

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    [-size..size, -size..size, -size..size].prop_map(DVec3::from_array)
}

/// A box as twelve triangles, each with vertices of its own.
fn mesh_box(min: DVec3, max: DVec3) -> Shape {
    let corner = |i: u32| {
        let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high } as f32;
        [pick(0, min.x, max.x), pick(1, min.y, max.y), pick(2, min.z, max.z)]
    };
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let corners: Vec<u32> = quads.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect();
    let positions = corners.iter().map(|&i| corner(i)).collect();
    let triangles = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let mesh = Mesh::new(positions, triangles).unwrap();
    assert_eq!(mesh.open_edges(), 0);
    Shape::Mesh(Arc::new(mesh))
}

/// Corners that single precision has exactly.
fn exact(v: DVec3) -> DVec3 {
    (v * 64.0).round() / 64.0
}

fn cuboid(min: DVec3, max: DVec3) -> Shape {
    Shape::Cuboid(Cuboid { min, max })
}

fn leaf() -> impl Strategy<Value = Primitive> {
    (0..7, vector(2.0), vector(1.0), 0.1..1.0f64, vector(3.0)).prop_map(|(kind, at, size, radius, turn)| {
        let size = size.abs() + 0.1;
        let shape = match kind {
            0 => Shape::Sphere(Sphere { radius, center: at }),
            1 => cuboid(at - size, at + size),
            2 => mesh_box(exact(at - size), exact(at + size)),
            // Without end.
            5 => Shape::Plane(Plane { normal: at, offset: radius }),
            6 => Shape::Quadric(Arc::new(Quadric {
                square: at,
                product: size,
                linear: turn,
                constant: -radius,
            })),
            3 => Shape::Frustum(Arc::new(Frustum {
                base: at,
                top: at + size,
                radii: [radius, 0.5 * radius],
                is_capped: true,
            })),
            _ => Shape::Torus(Arc::new(Torus {
                center: at,
                axis: size.normalize(),
                radius,
                tube: radius * 0.4,
            })),
        };
        let matrix3 = DMat3::from_rotation_x(turn.x) * DMat3::from_rotation_y(turn.y);
        let part = part(shape, (turn.z > 0.0).then_some(DAffine3 { matrix3, translation: DVec3::ZERO }));
        if turn.x > 2.0 { inverse(part) } else { part }
    })
}

/// A place in the box between (0, 0, 0) and (1, 1, 1): inside, on an edge, in a diagonal of a face, a corner.
fn aim(kind: usize, weight: DVec3) -> DVec3 {
    let w = weight * 0.5 + 0.5;
    match kind {
        0 => w,
        1 => DVec3::new(w.x, w.y.round(), w.z.round()),
        2 => DVec3::new(w.x, w.x, w.z.round()),
        _ => w.round(),
    }
}

fn operation() -> impl Strategy<Value = CsgOperation> {
    prop_oneof![Just(CsgOperation::Union), Just(CsgOperation::Intersection), Just(CsgOperation::Difference)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn boxes_leave_out_nothing(
        first in leaf(), rest in prop::collection::vec((operation(), leaf()), 5..16),
        rays in prop::collection::vec((vector(5.0), vector(2.0)), 200), clipped in any::<bool>(),
    ) {
        let solid = rest.into_iter().fold(first, |solid, (operation, part)| csg(operation, solid, part));
        let solid = if clipped { clip(&solid) } else { solid };
        let with = geometry(solid.clone());
        prop_assume!(with.solids[0].boxes.is_some());
        let mut without = geometry(solid);
        without.solids[0].boxes = None;
        for (origin, target) in rays {
            let ray = Ray { origin, direction: target - origin };
            let [a, b] = [&with, &without].map(|geometry| hit(geometry, &ray));
            prop_assert_eq!(a.map(|hit| (hit.at.to_bits(), hit.leaf, hit.triangle)),
                b.map(|hit| (hit.at.to_bits(), hit.leaf, hit.triangle)));
        }
    }

    /// A ray from afar meets nothing outside of the box around a solid's surface, which may be small though the solid is not.
    #[test]
    fn a_surface_is_in_its_box(
        first in leaf(), rest in prop::collection::vec((operation(), leaf()), 0..4),
        rays in prop::collection::vec((vector(5.0), vector(2.0)), 100), clipped in any::<bool>(),
    ) {
        let solid = rest.into_iter().fold(inverse(first), |solid, (operation, part)| csg(operation, solid, part));
        let geometry = geometry(if clipped { clip(&solid) } else { solid });
        let [min, max] = of_solid(&geometry, &geometry.solids[0]);
        for (origin, target) in rays {
            let ray = Ray { origin: origin * 20.0, direction: target - origin * 20.0 };
            if let Some(hit) = hit(&geometry, &ray) {
                let at = ray.origin + ray.direction * hit.at;
                prop_assert!(at.cmpge(min - 1e-5).all() && at.cmple(max + 1e-5).all(), "{at} {min} {max}");
            }
        }
    }

    /// Through inner points and through the diagonals where two triangles meet, from outside and from inside. (Where edges
    /// of the box are hit, either may be missed by rounding.)
    #[test]
    fn a_mesh_in_a_solid_is_what_it_stands_for(
        min in vector(2.0), size in vector(2.0), other in vector(2.0), radius in 0.5..2.0f64, operation in operation(),
        rays in prop::collection::vec((vector(6.0), vector(1.0), 0..2usize, any::<bool>()), 100), swapped in any::<bool>(),
    ) {
        let min = exact(min);
        let max = min + exact(size.abs() + 0.1);
        let both = [cuboid(min, max), mesh_box(min, max)].map(|shape| {
            let ball = part(Shape::Sphere(Sphere { radius, center: other }), None);
            let shape = part(shape, None);
            geometry(if swapped { csg(operation, ball, shape) } else { csg(operation, shape, ball) })
        });
        for (origin, weight, kind, on_grid) in rays {
            let origin = if on_grid { exact(origin) } else { origin };
            let ray = Ray { origin, direction: min + (max - min) * aim(2 * kind, weight) - origin };
            // In the plane of a face, a ray is inside or not as one likes; one that starts on a face meets it or not, by
            // rounding. (Rays of a picture start off a surface by its bound.)
            let is_in_box = origin.cmpge(min).all() && origin.cmple(max).all();
            let starts_on_a_face = is_in_box && (origin.cmpeq(min).any() || origin.cmpeq(max).any());
            if ray.direction.z == 0.0 || starts_on_a_face {
                continue;
            }
            let [a, b] = [&both[0], &both[1]].map(|geometry| hit(geometry, &ray));
            prop_assert_eq!(a.map(|hit| hit.leaf), b.map(|hit| hit.leaf));
            if let (Some(a), Some(b)) = (a, b) {
                prop_assert!((a.at - b.at).abs() * ray.direction.length() < 1e-9, "{} {}", a.at, b.at);
            }
        }
    }

    /// However a ray meets a closed mesh: from outside it goes in as often as it comes out.
    #[test]
    fn no_ray_gets_stuck_inside(
        min in vector(2.0), size in vector(2.0), rays in prop::collection::vec((vector(6.0), vector(1.0), 0..8usize), 200),
    ) {
        let min = exact(min);
        let max = min + exact(size.abs() + 0.1);
        let ball = part(Shape::Sphere(Sphere { radius: 1.0, center: DVec3::ZERO }), None);
        let geometry = geometry(csg(CsgOperation::Union, ball, part(mesh_box(min, max), None)));
        let Prepared::Mesh(mesh) = geometry.shape(1) else { unreachable!() };
        for (origin, weight, kind) in rays {
            let target = min + (max - min) * aim(kind, weight);
            // Some go exactly through corners, along edges, diagonals and faces.
            let direction = if kind < 4 { target - exact(origin) } else { (origin / 3.0).round() };
            let mut direction = if direction == DVec3::ZERO { DVec3::X } else { direction };
            // 32 times the direction leads out of the box.
            while direction.length() < 0.25 {
                direction *= 2.0;
            }
            let mut crossings = Vec::new();
            let mut inside = |from: DVec3| {
                let (ray, mut stack) = (Ray { origin: from, direction }, Stack::default());
                dispatch!(Level::new(), simd => mesh.crossings(simd, &ray, 0.0, &mut stack, &mut crossings))
            };
            prop_assert!(!inside(target - direction * 32.0));
            prop_assert!(!inside(target + direction * 32.0));
        }
    }
}

/// Where a ray goes out at an edge of the box, to within rounding.
#[test]
fn an_edge_is_where_it_is() {
    let min = DVec3::new(0.4375, -1.078125, -1.453125);
    let max = DVec3::new(0.875, -0.078125, -0.109375);
    let ray = Ray {
        origin: DVec3::new(1.75, 1.921875, 2.578125),
        direction: DVec3::new(-1.2213946131757325, -2.7917591158302457, -2.6875),
    };
    let far = part(Shape::Sphere(Sphere { radius: 1.0, center: DVec3::splat(-9.0) }), None);
    let geometry = geometry(csg(CsgOperation::Difference, part(mesh_box(min, max), None), far));
    let at = hit(&geometry, &ray).unwrap().at;
    assert!((at - 1.0).abs() < 1e-15, "{at}");
}
