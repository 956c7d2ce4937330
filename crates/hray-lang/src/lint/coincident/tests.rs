//! Against every pair of faces, one by one.

use super::{Coincidence, Kind, check};
use glam::{DAffine3, DVec3};
use hray_core::{
    Background, Camera, Csg, CsgOperation, Cuboid, Material, PerspectiveCamera, Primitive, Rgb, Scene, Shape,
    Texture,
};
use proptest::prelude::*;
use std::sync::Arc;

const EYE: DVec3 = DVec3::new(7.3, 20.1, 31.7);

fn material(i: usize) -> Arc<Material> {
    Arc::new(Material::matte(Texture::Solid(Rgb::new(i as f64, 0.0, 0.0))))
}

fn found(primitives: Vec<Primitive>, turn: &DAffine3) -> Vec<Coincidence> {
    let [from, to, up] = [turn.transform_point3(EYE), turn.translation, turn.transform_vector3(DVec3::Y)];
    let scene = Scene {
        camera: Camera::Perspective(PerspectiveCamera { from, to, up, fov: 1.0 }),
        background: Background::Uniform(Rgb::BLACK),
        primitives,
        lights: Vec::new(),
        time: 0.0,
    };
    let mut all = Vec::new();
    check(&scene, |coincidence| {
        all.push(coincidence);
        true
    });
    all
}

fn cuboid([min, size]: [[i32; 3]; 2]) -> Cuboid {
    let corner = |at: [i32; 3]| DVec3::from(at.map(f64::from));
    Cuboid { min: corner(min), max: corner(min) + corner(size) }
}

fn boxes(most: usize) -> impl Strategy<Value = Vec<Cuboid>> {
    let side = || [-4..4, -4..4, -4..4i32];
    prop::collection::vec([side(), [1..4, 1..4, 1..4i32]].prop_map(cuboid), 2..most)
}

fn turn() -> impl Strategy<Value = DAffine3> {
    let turned = ([-1.0..1.0f64, -1.0..1.0f64, 0.1..1.0f64], 0.0..6.0f64, 0.1..20.0f64).prop_map(
        |(axis, angle, size)| {
            DAffine3::from_axis_angle(DVec3::from(axis).normalize(), angle)
                * DAffine3::from_scale(DVec3::splat(size))
        },
    );
    prop_oneof![Just(DAffine3::IDENTITY), turned]
}

/// The sides of two boxes that lie in each other and are seen from the eye.
fn shared(a: &Cuboid, b: &Cuboid) -> usize {
    let side =
        |cuboid: &Cuboid, axis: usize, is_max: bool| if is_max { cuboid.max[axis] } else { cuboid.min[axis] };
    let overlap = |axis: usize| a.min[axis].max(b.min[axis]) < a.max[axis].min(b.max[axis]);
    let sides = (0..3).flat_map(|axis| [(axis, false), (axis, true)]);
    sides
        .filter(|&(axis, is_max)| {
            let at = side(a, axis, is_max);
            let is_seen = if is_max { EYE[axis] > at } else { EYE[axis] < at };
            at == side(b, axis, is_max) && is_seen && (0..3).all(|other| other == axis || overlap(other))
        })
        .count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn boxes_are_compared_with_all_others(boxes in boxes(12), turn in turn()) {
        let transform = Arc::new(turn);
        let primitives = boxes.iter().enumerate().map(|(i, &cuboid)| Primitive {
            shape: Shape::Cuboid(cuboid), transform: Some(transform.clone()), material: material(i),
        });
        let mut pairs: Vec<[usize; 2]> = found(primitives.collect(), &turn)
            .into_iter()
            .map(|coincidence| coincidence.surfaces.map(|surface| surface.object))
            .collect();
        pairs.sort_unstable();
        let mut expected = Vec::new();
        for (i, a) in boxes.iter().enumerate() {
            for (j, b) in boxes.iter().enumerate().skip(i + 1) {
                expected.extend(vec![[i, j]; shared(a, b)]);
            }
        }
        prop_assert_eq!(pairs, expected);
    }

    /// A box cut out of another: a skin is left where they are flush, unless to the bit.
    #[test]
    fn what_is_cut_out_flush_leaves_a_skin(boxes in boxes(3), angle in 0.1..6.0f64, is_turned in any::<bool>()) {
        let &[a, b, ..] = &boxes[..] else { unreachable!() };
        let part = |cuboid, turn: Option<DAffine3>| Primitive {
            shape: Shape::Cuboid(cuboid), transform: turn.map(Arc::new), material: material(0),
        };
        let turn = DAffine3::from_rotation_x(angle);
        // The same box, in other words.
        let back = DAffine3::from_scale(DVec3::splat(3.0));
        let third = |p: DVec3| turn.inverse().transform_point3(turn.transform_point3(p / 3.0));
        let other = if is_turned { part(Cuboid { min: third(b.min), max: third(b.max) }, Some(back)) } else { part(b, None) };
        let csg = Csg { operation: CsgOperation::Difference, operands: [part(a, None), other] };
        let solid = Primitive { shape: Shape::Csg(Arc::new(csg)), transform: None, material: material(0) };
        let skins = found(vec![solid], &DAffine3::IDENTITY);
        prop_assert!(skins.iter().all(|skin| skin.kind == Kind::Skin));
        let overlap = |axis: usize| a.min[axis].max(b.min[axis]) < a.max[axis].min(b.max[axis]);
        let flush = (0..3).filter(|&axis| (0..3).all(|other| other == axis || overlap(other)));
        let flush: usize = flush.map(|axis| {
            usize::from(a.min[axis] == b.min[axis]) + usize::from(a.max[axis] == b.max[axis])
        }).sum();
        if is_turned {
            // By rounding some are the same to the bit.
            prop_assert!(skins.len() <= flush);
        } else {
            prop_assert!(skins.is_empty());
        }
    }
}
