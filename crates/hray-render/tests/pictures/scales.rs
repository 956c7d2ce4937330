//! No size is special: what is a millionth or a billion times as large, seen from as much nearer or farther, looks
//! the same.

use crate::common::{
    NOTHING, ball, colors, cuboid, description, frustum, glass, gray, lump, matte, mirror, of, placed, plane,
    sphere, torus, v,
};
use hray_core::{
    Background, Camera, Clip, Csg, CsgOperation, DAffine3, DMat3, DVec3, Description, Disc, Function,
    Implicit, Light, Material, Mesh, Primitive, Quadric, Rgb, Shape, Texture,
};
use hray_expr::{Binary, Builder, Node, NodeId};
use std::sync::Arc;

const SCALES: [f64; 4] = [1e-6, 1.0, 1e6, 1e12];

fn scaled(shape: &Shape, s: f64) -> Shape {
    match shape {
        Shape::Sphere(a) => sphere(a.center * s, a.radius * s),
        Shape::Plane(a) => plane(a.normal, a.offset * s),
        Shape::Cuboid(a) => cuboid(a.min * s, a.max * s),
        Shape::Frustum(a) => frustum(a.base * s, a.top * s, a.radii.map(|radius| radius * s)),
        Shape::Torus(a) => torus(a.center * s, a.axis, a.radius * s, a.tube * s),
        Shape::Quadric(a) => {
            let (linear, constant) = (a.linear * s, a.constant * s * s);
            Shape::Quadric(Arc::new(Quadric { linear, constant, ..**a }))
        }
        Shape::Implicit(a) => {
            let function = Arc::new(scaled_function(&a.function, s));
            Shape::Implicit(Arc::new(Implicit { function, min: a.min * s, max: a.max * s }))
        }
        Shape::Disc(a) => {
            let disc =
                Disc { center: a.center * s, normal: a.normal, radius: a.radius * s, hole: a.hole * s };
            Shape::Disc(Arc::new(disc))
        }
        Shape::Mesh(mesh) => {
            let positions = mesh.positions().iter().map(|p| p.map(|x| (f64::from(x) * s) as f32)).collect();
            let scaled = Mesh::new(positions, mesh.triangles().to_vec()).unwrap();
            Shape::Mesh(Arc::new(scaled.with_normals(mesh.normals().to_vec()).unwrap()))
        }
        Shape::Inverse(solid) => Shape::Inverse(Arc::new(primitive(solid, s))),
        Shape::Clip(clip) => Shape::Clip(Arc::new(Clip {
            shape: primitive(&clip.shape, s),
            within: primitive(&clip.within, s),
        })),
        Shape::Csg(csg) => Shape::Csg(Arc::new(Csg {
            operation: csg.operation,
            operands: csg.operands.each_ref().map(|operand| primitive(operand, s)),
        })),
    }
}

/// The same values at points `s` times as far away.
fn scaled_function(function: &Function, s: f64) -> Function {
    let mut b = Builder::new(1000);
    let factor = b.constant(1.0 / s).unwrap();
    let mut made: Vec<NodeId> = Vec::new();
    for node in function.nodes() {
        let of = |id: &NodeId| made[id.0 as usize];
        let node = match node {
            Node::Constant(v) => b.constant(*v).unwrap(),
            Node::Input(input) => {
                let input = b.input(*input).unwrap();
                b.binary(Binary::Mul, input, factor).unwrap()
            }
            Node::Unary(f, x) => b.unary(*f, of(x)).unwrap(),
            Node::Binary(f, x, y) => b.binary(*f, of(x), of(y)).unwrap(),
            other => panic!("{other:?}"),
        };
        made.push(node);
    }
    b.finish(&[made[function.outputs()[0].0 as usize]])
}

fn primitive(p: &Primitive, s: f64) -> Primitive {
    let transform = p
        .transform
        .as_ref()
        .map(|t| Arc::new(DAffine3 { matrix3: t.matrix3, translation: t.translation * s }));
    Primitive { shape: scaled(&p.shape, s), transform, material: p.material.clone() }
}

fn at_scale(description: &Description, s: f64) -> Description {
    let mut scaled = description.clone();
    let Camera::Perspective(camera) = &mut scaled.scene.camera else { panic!() };
    (camera.from, camera.to) = (camera.from * s, camera.to * s);
    scaled.scene.primitives = description.scene.primitives.iter().map(|p| primitive(p, s)).collect();
    for light in &mut scaled.scene.lights {
        if let Light::Point { position, .. } | Light::Spot { position, .. } = light {
            *position *= s;
        }
    }
    scaled
}

fn everything() -> Description {
    let half = Arc::new(Material {
        reflection: 0.4.into(),
        shine: 20.0.into(),
        ..Material::matte(Texture::Solid(Rgb::new(0.6, 0.3, 0.2)))
    });
    let bored = Csg {
        operation: CsgOperation::Difference,
        operands: [
            of(cuboid(v(-0.5, -0.5, -0.5), v(0.5, 0.5, 0.5)), &half),
            of(sphere(DVec3::ZERO, 0.62), &matte(0.8)),
        ],
    };
    let kept = Csg {
        operation: CsgOperation::Intersection,
        operands: [
            of(sphere(v(-0.2, 1.1, 0.6), 0.3), &half),
            of(Shape::Inverse(Arc::new(of(sphere(v(-0.2, 1.2, 0.8), 0.25), &matte(0.8)))), &half),
        ],
    };
    let shell = Clip {
        shape: of(sphere(v(-0.7, 0.9, -0.2), 0.4), &half),
        within: of(plane(v(0.5, 0.3, 1.0), -0.1), &half),
    };
    let turned = DAffine3 {
        matrix3: DMat3::from_rotation_y(0.6) * DMat3::from_rotation_x(0.3),
        translation: v(-0.9, 0.1, 0.3),
    };
    let primitives = vec![
        of(plane(v(0.0, 1.0, 0.1), 0.9), &half),
        of(sphere(v(0.8, 0.0, 0.0), 0.5), &glass(1.5)),
        of(sphere(v(0.1, -0.5, 0.9), 0.3), &mirror()),
        of(torus(v(0.6, 0.9, 0.2), v(0.2, 1.0, 0.6), 0.35, 0.1), &half),
        of(frustum(v(-0.9, -0.9, 1.0), v(-0.8, -0.1, 1.1), [0.25, 0.05]), &half),
        of(
            Shape::Quadric(Arc::new(Quadric {
                square: v(4.0, 3.0, 4.0),
                product: v(0.5, 0.2, -0.3),
                linear: v(6.0, 1.0, -5.0),
                constant: 3.5,
            })),
            &half,
        ),
        of(
            Shape::Disc(Arc::new(Disc {
                center: v(0.7, -0.7, 1.1),
                normal: DVec3::Y,
                radius: 0.3,
                hole: 0.1,
            })),
            &half,
        ),
        of(lump(v(-0.3, 0.75, 0.9), 0.25, 0.05, v(1.0, 0.4, 1.0)), &half),
        placed(of(Shape::Csg(Arc::new(bored)), &half), turned),
        of(Shape::Csg(Arc::new(kept)), &half),
        of(Shape::Clip(Arc::new(shell)), &half),
        placed(
            of(sphere(DVec3::ZERO, 0.5), &half),
            DAffine3 {
                matrix3: DMat3::from_rotation_z(0.5) * DMat3::from_diagonal(v(0.5, 1.4, 0.8)),
                translation: v(0.2, 0.6, -0.6),
            },
        ),
    ];
    let lights = vec![
        Light::Point { position: v(3.0, 5.0, 4.0), intensity: gray(0.7) },
        Light::Directional { direction: v(0.6, -0.8, 0.0), intensity: gray(0.2) },
        Light::Ambient { intensity: gray(0.1) },
    ];
    let mut description = description(48, primitives, lights);
    description.scene.background = Background::Uniform(Rgb::new(0.1, 0.2, 0.4));
    description
}

#[test]
fn a_scene_looks_the_same_at_every_scale() {
    let expected = colors(&everything());
    for s in SCALES {
        let found = colors(&at_scale(&everything(), s));
        let differs = |(a, b): (&Rgb, &Rgb)| {
            let [a, b] = [a, b].map(|c| DVec3::from_array(c.to_array()));
            (a - b).abs().max_element() > 1e-6
        };
        let different = expected.iter().zip(&found).filter(|pair| differs(*pair)).count();
        // A ray that just grazes an edge may fall on either side.
        assert!(different <= 4, "{different} pixels differ at {s}");
    }
    // By powers of two nothing rounds otherwise: it is the same to the bit.
    assert!(colors(&at_scale(&everything(), 1024.0)) == expected);
}

/// What of a shape is above a plane that the camera is above of.
fn cap(shape: Primitive) -> Primitive {
    let within = of(plane(v(0.1, 0.2, -1.0), 0.1), &matte(0.0));
    of(Shape::Clip(Arc::new(Clip { shape, within })), &matte(0.0))
}

/// A convex mirror alone in the world sees only the background, and not itself.
#[test]
fn a_mirror_does_not_see_itself() {
    let turned = DAffine3::from_axis_angle(v(1.0, 2.0, 3.0).normalize(), 0.7);
    let shapes = [
        of(sphere(v(0.1, 0.2, 0.0), 1.2), &mirror()),
        of(lump(v(0.1, 0.2, 0.0), 1.2, 0.0, v(2.0, 3.0, 3.0)), &mirror()),
        of(sphere(v(-0.1, 0.0, -100.0), 99.0), &mirror()),
        of(cuboid(v(-1.0, 0.0, -1.0), v(0.7, 0.9, 1.0)), &mirror()),
        of(ball(v(0.1, 0.2, 0.0), 1.2, 2, false), &mirror()),
        of(ball(v(0.1, 0.2, 0.0), 1.2, 2, true), &mirror()),
        placed(of(ball(v(5.0, 0.0, 0.0), 2.0, 3, true), &mirror()), DAffine3::from_scale(v(0.4, 0.7, 0.2))),
        of(plane(v(0.2, 0.9, 0.3), 0.4), &mirror()),
        placed(of(cuboid(v(-1.0, 0.0, -1.0), v(0.7, 0.9, 1.0)), &mirror()), turned),
        placed(of(sphere(v(5.0, 0.0, 0.0), 2.0), &mirror()), DAffine3::from_scale(v(0.4, 0.7, 0.2))),
        placed(of(plane(v(0.2, 0.9, 0.3), 0.4), &mirror()), turned),
        cap(of(sphere(v(0.1, 0.2, 0.0), 1.2), &mirror())),
        cap(of(ball(v(0.1, 0.2, 0.0), 1.2, 2, false), &mirror())),
        placed(cap(of(plane(v(0.2, 0.9, 0.3), 0.4), &mirror())), turned),
    ];
    for (i, shape) in shapes.iter().enumerate() {
        for s in SCALES {
            let mut description = at_scale(&description(64, vec![shape.clone()], Vec::new()), s);
            description.scene.background = Background::Uniform(gray(0.5));
            let found = colors(&description);
            assert!(found.iter().all(|c| (c.r - 0.5).abs() < 1e-12), "shape {i} at {s}");
        }
    }
}

/// Glass that does not bend the light is invisible, and takes exactly two surfaces of depth.
#[test]
fn clear_glass_is_invisible() {
    let turned = DAffine3::from_axis_angle(v(1.0, 2.0, 3.0).normalize(), 0.7);
    let shapes = [
        of(sphere(v(0.1, 0.2, 0.0), 1.2), &glass(1.0)),
        of(lump(v(0.1, 0.2, 0.0), 1.2, 0.0, v(2.0, 3.0, 3.0)), &glass(1.0)),
        of(ball(v(0.1, 0.2, 0.0), 1.2, 3, false), &glass(1.0)),
        of(cuboid(v(-1.0, -0.3, -1.0), v(0.7, 0.9, 1.0)), &glass(1.0)),
        placed(of(cuboid(v(-1.0, 0.0, -1.0), v(0.7, 0.9, 1.0)), &glass(1.0)), turned),
        placed(of(sphere(v(5.0, 0.0, 0.0), 2.0), &glass(1.0)), DAffine3::from_scale(v(0.4, 0.7, 0.2))),
        // Light leaves the glass and enters it again.
        of(Shape::Inverse(Arc::new(of(sphere(v(0.1, 0.2, 0.0), 1.2), &glass(1.0)))), &matte(0.0)),
    ];
    for (i, shape) in shapes.iter().enumerate() {
        for s in SCALES {
            let mut description = at_scale(&description(64, vec![shape.clone()], Vec::new()), s);
            description.max_depth = 2;
            description.scene.background = Background::Uniform(gray(0.5));
            let found = colors(&description);
            let wrong = found.iter().filter(|c| (c.r - 0.5).abs() > 1e-12).count();
            assert!(wrong <= 1, "{wrong} pixels: shape {i} at {s}");
        }
    }
}

/// A lit ball has a dark and a lit half, and no speckles: with the light at the camera all of it is lit.
#[test]
fn no_shadow_falls_on_what_is_seen_from_the_light() {
    let turned = DAffine3::from_axis_angle(v(1.0, 2.0, 3.0).normalize(), 0.7);
    let shapes = [
        of(sphere(v(0.1, 0.2, 0.0), 1.2), &matte(1.0)),
        of(lump(v(0.1, 0.2, 0.0), 1.2, 0.2, v(2.0, 3.0, 3.0)), &matte(1.0)),
        of(ball(v(0.1, 0.2, 0.0), 1.2, 3, false), &matte(1.0)),
        of(ball(v(0.1, 0.2, 0.0), 1.2, 3, true), &matte(1.0)),
        placed(of(ball(v(5.0, 0.0, 0.0), 2.0, 3, true), &matte(1.0)), DAffine3::from_scale(v(0.4, 0.7, 0.2))),
        of(sphere(v(-0.1, 0.0, -1000.0), 999.0), &matte(1.0)),
        of(cuboid(v(-1.0, 0.0, -1.0), v(0.7, 0.9, 1.0)), &matte(1.0)),
        of(plane(v(0.2, 0.9, 0.3), 0.4), &matte(1.0)),
        placed(of(cuboid(v(-1.0, 0.0, -1.0), v(0.7, 0.9, 1.0)), &matte(1.0)), turned),
        placed(of(sphere(v(5.0, 0.0, 0.0), 2.0), &matte(1.0)), DAffine3::from_scale(v(0.4, 0.7, 0.2))),
    ];
    for (i, shape) in shapes.iter().enumerate() {
        for s in SCALES {
            let light = Light::Point { position: v(0.0, 0.0, 4.0), intensity: gray(1.0) };
            let description = at_scale(&description(64, vec![shape.clone()], vec![light]), s);
            let dark = colors(&description).iter().filter(|c| **c != NOTHING && c.r <= 0.0).count();
            // At the very edge of a mesh an interpolated normal may point away from the viewer.
            let allowed = if matches!(shape.shape, Shape::Mesh(_)) { 4 } else { 0 };
            assert!(dark <= allowed, "{dark} pixels: shape {i} at {s}");
        }
    }
}

/// Light that strikes a pane of glass from within at more than the critical angle stays inside.
#[test]
fn total_reflection_mirrors() {
    // From inside a block of glass, at 60° to its side: sin 60° > 1 / 1.5.
    let block = of(cuboid(v(-1.0, -9.0, -9.0), v(9.0, 9.0, 9.0)), &glass(1.5));
    let glow = Some(Texture::Solid(gray(0.75)));
    let lamp = Arc::new(Material { glow, ..Material::matte(Texture::Solid(Rgb::BLACK)) });
    let inside = of(sphere(v(1.0, 0.0, -2.0 * 3.0f64.sqrt()), 0.5), &lamp);
    let mut description = description(1, vec![block, inside], Vec::new());
    let Camera::Perspective(camera) = &mut description.scene.camera else { panic!() };
    // The ray leads from (1, 0, 2√3) to the side at x = -1 and is mirrored there to (1, 0, -2√3).
    (camera.from, camera.to) = (v(1.0, 0.0, 2.0 * 3.0f64.sqrt()), v(-1.0, 0.0, 0.0));
    assert!((colors(&description)[0].r - 0.75).abs() < 1e-12);
}

/// Snell: at 45° into glass of index √2 light goes on at 30°, and leaves a pane as it came.
#[test]
fn glass_bends_light_both_ways() {
    let pane = of(cuboid(v(-9.0, -9.0, -1.0), v(9.0, 9.0, 0.0)), &glass(2.0f64.sqrt()));
    let screen = of(plane(DVec3::Z, 2.0), &crate::common::showing(crate::common::WORLD));
    let mut description = description(1, vec![pane, screen], Vec::new());
    let Camera::Perspective(camera) = &mut description.scene.camera else { panic!() };
    (camera.from, camera.to) = (v(-1.0, 0.0, 1.0), DVec3::ZERO);
    let found = crate::common::shown(colors(&description)[0]).unwrap();
    // Across the pane by tan 30°, then by 1 to the screen.
    let expected = v(libm::tan(std::f64::consts::FRAC_PI_6) + 1.0, 0.0, -2.0);
    assert!(found.distance(expected) < 1e-12, "{found} instead of {expected}");
}
