//! That what must not matter does not, in scenes in which everything occurs.

use super::*;
use hray_core::{
    Background, Camera, Csg, CsgOperation, Cuboid, DAffine3, DMat3, DVec3, Encoding, Field, NoiseTexture,
    Plane, Primitive, Resolution, Scene, Shape, Sphere, Texture, WindowCamera,
};
use hray_expr::{Binary, Builder, Input, Unary};
use std::num::NonZeroU32;
use std::sync::Arc;

/// A scene in which every texture, reflection, refraction, shadow and total reflection occurs.
fn description() -> Description {
    let (base, added) = (Rgb::new(0.9, 0.5, 0.3), Rgb::new(0.1, 0.3, 0.2));
    let direction = DVec3::new(0.3, 0.1, 0.05);
    let (octaves, grid, power) = (7, 9.0, 6.0);
    let textures = [
        Texture::Solid(base),
        Texture::Noise(NoiseTexture::Solid { base, grid }),
        Texture::Noise(NoiseTexture::SemiTurbulence { base, octaves, grid }),
        Texture::Noise(NoiseTexture::Turbulence { base, octaves, grid }),
        Texture::Noise(NoiseTexture::Fire { added, base, octaves, grid }),
        Texture::Noise(NoiseTexture::Plasma { grid }),
        Texture::Noise(NoiseTexture::Marble { base, octaves, grid, direction, power }),
        Texture::Noise(NoiseTexture::MarbleBase { base, added, octaves, grid, direction, power }),
        Texture::Noise(NoiseTexture::Wood { base, octaves, grid, rings: 0.7, power }),
        Texture::Noise(NoiseTexture::Turbulence { base, octaves: 60, grid: 1e-9 }),
    ];
    let material = |i: usize, texture| hray_core::Material {
        reflection: [0.0, 0.3, 0.8][i % 3].into(),
        shine: [0.0, 1.0, 2.0, 3.0, 60.0, 401.0][i % 6].into(),
        transmission: [0.0, 0.7][i % 2].into(),
        refractive_index: [1.5, 0.7][i / 2 % 2].into(),
        ..hray_core::Material::matte(texture)
    };
    let sphere = |i: usize| {
        Shape::Sphere(Sphere {
            radius: 12.0 + i as f64,
            center: DVec3::new(
                25.0 * (i % 4) as f64 - 40.0,
                25.0 * (i / 4) as f64 - 30.0,
                -70.0 - 9.0 * i as f64,
            ),
        })
    };
    let floor = Shape::Plane(Plane { normal: DVec3::new(0.1, 1.0, 0.0), offset: 45.0 });
    let shapes = (0..9).map(sphere).chain([floor]);
    let primitives = shapes.zip(textures).enumerate();
    let primitive = |(i, (shape, texture))| Primitive {
        shape,
        transform: None,
        material: Arc::new(material(i, texture)),
    };
    let scene = Scene {
        camera: Camera::Window(WindowCamera { eye: DVec3::new(3.0, 0.0, 90.0), window: [80.0, 60.0] }),
        background: Background::Uniform(Rgb::new(0.2, 0.4, 1.5)),
        primitives: primitives.map(primitive).collect(),
        time: 0.0,
        lights: vec![
            Light::Point { position: DVec3::new(50.0, 80.0, 20.0), intensity: Rgb::new(0.7, 0.6, 0.5) },
            Light::Ambient { intensity: Rgb::new(0.05, 0.0, 0.1) },
            Light::Point { position: DVec3::new(-60.0, 10.0, -10.0), intensity: Rgb::new(0.2, 0.3, 0.5) },
        ],
    };
    Description {
        resolution: Resolution::new(61, 47).unwrap(),
        max_depth: 6,
        samples: NonZeroU32::MIN,
        integrator: hray_core::Integrator::Classic2005,
        encoding: Encoding::Raw,
        scene,
    }
}

fn integrator(description: &Description) -> Integrator {
    match Integrator::new(description, &NoiseTables::default()) {
        Ok(integrator) => integrator,
        Err(TooManyParts) => panic!("too many parts"),
    }
}

/// The same with everything that the thesis did not have: boxes, solids, placements, functions, other lights.
fn rich(rules: hray_core::Integrator) -> Description {
    let mut description = Description { integrator: rules, ..description() };
    let scene = &mut description.scene;
    let colored = |inputs, a| {
        let mut builder = Builder::new(100);
        let a = builder.constant(a).unwrap();
        let outputs = <[Input; 3]>::map(inputs, |input| {
            let x = builder.input(input).unwrap();
            let x = builder.binary(Binary::Mul, x, a).unwrap();
            builder.unary(Unary::Abs, x).unwrap()
        });
        Arc::new(builder.finish(&outputs))
    };
    let number = |input, a| {
        let mut builder = Builder::new(100);
        let a = builder.constant(a).unwrap();
        let x = builder.input(input).unwrap();
        let x = builder.binary(Binary::Mul, x, a).unwrap();
        let x = builder.unary(Unary::Floor, x).unwrap();
        let two = builder.constant(2.0).unwrap();
        let x = builder.binary(Binary::Modulo, x, two).unwrap();
        Field::Function(Arc::new(builder.finish(&[x])))
    };
    let varying = Arc::new(hray_core::Material {
        reflection: number(Input::Px, 0.3),
        transmission: number(Input::Wy, 0.2),
        refractive_index: 1.4.into(),
        shine: number(Input::Pz, 0.1),
        highlight: Some(0.3.into()),
        glow: Some(Texture::Function(colored([Input::U, Input::V, Input::Time], 0.1))),
        bump: Some(colored([Input::Px, Input::Py, Input::Pz], 0.02)),
        ..hray_core::Material::matte(Texture::Function(colored([Input::Nx, Input::Ny, Input::Nz], 0.9)))
    });
    let noisy = scene.primitives[7].material.clone();
    let turned = DAffine3 {
        matrix3: DMat3::from_rotation_y(0.7) * DMat3::from_diagonal(DVec3::new(1.0, 1.5, 0.7)),
        translation: DVec3::new(10.0, 5.0, -60.0),
    };
    let place = |translation| Some(Arc::new(DAffine3 { translation, ..turned }));
    let part = |shape, transform, material: &Arc<hray_core::Material>| Primitive {
        shape,
        transform,
        material: material.clone(),
    };
    let cube = |half: f64| Shape::Cuboid(Cuboid { min: DVec3::splat(-half), max: DVec3::splat(half) });
    let ball = |radius| Shape::Sphere(Sphere { radius, center: DVec3::new(3.0, 2.0, 9.0) });
    let operands = [part(cube(14.0), None, &varying), part(ball(15.0), place(DVec3::ZERO), &noisy)];
    let solid = Shape::Csg(Arc::new(Csg { operation: CsgOperation::Difference, operands }));
    scene.primitives.extend([
        part(cube(9.0), place(DVec3::new(20.0, -20.0, -50.0)), &varying),
        part(ball(11.0), place(DVec3::new(-30.0, 10.0, -55.0)), &noisy),
        part(solid, place(DVec3::new(-8.0, -12.0, -40.0)), &varying),
        part(ball(12.0), None, &varying),
    ]);
    scene.lights.extend([
        Light::Directional { direction: DVec3::new(0.6, -0.8, 0.0), intensity: Rgb::new(0.2, 0.1, 0.2) },
        Light::Spot {
            position: DVec3::new(0.0, 50.0, 30.0),
            axis: DVec3::new(0.0, -0.6, -0.8),
            cos_inner: 0.95,
            cos_outer: 0.7,
            intensity: Rgb::new(0.5, 0.6, 0.4),
        },
    ]);
    scene.background = hray_core::Background::Function(colored([Input::Wx, Input::V, Input::Pz], 0.8));
    scene.time = 3.0;
    description
}

fn colors(description: &Description, level: Level, batch: usize) -> (Vec<[u64; 3]>, RayCounts) {
    let mut integrator = integrator(description);
    integrator.level = level;
    let points: Vec<[f64; 2]> =
        (0..61 * 47).map(|i| [f64::from(i % 61) * 1.3 - 40.0, f64::from(i / 61) * 1.3 - 30.0]).collect();
    let (mut scratch, mut colors) = (Scratch::new(), Vec::new());
    for points in points.chunks(batch) {
        assert!(integrator.radiance(points, 6, &mut scratch, &Control::new(), &mut colors).is_ok());
    }
    (colors.iter().map(|c| c.to_array().map(f64::to_bits)).collect(), scratch.rays())
}

#[test]
fn neither_the_width_of_vectors_nor_the_size_of_batches_changes_a_bit() {
    let rules = [hray_core::Integrator::Classic2005, hray_core::Integrator::Classic];
    for description in [description()].into_iter().chain(rules.map(rich)) {
        let expected = colors(&description, Level::baseline(), BATCH);
        assert!(expected.1.reflection > 1000 && expected.1.refraction > 1000, "{:?}", expected.1);
        let mut levels = vec![Level::new()];
        #[cfg(target_arch = "x86_64")]
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        for level in levels {
            for batch in [1, 7, 64, BATCH] {
                assert!(colors(&description, level, batch) == expected, "{level:?}, batches of {batch}");
            }
        }
    }
}

/// A million spheres that share a material, each with its place in the list or moved there.
#[test]
fn a_million_spheres_are_prepared_in_little_memory() {
    let material = Arc::new(hray_core::Material::matte(Texture::Solid(Rgb::BLACK)));
    let mut description = description();
    let primitive = |i: u32| Primitive {
        shape: Shape::Sphere(Sphere { radius: 0.3, center: DVec3::new(f64::from(i), 0.0, 0.0) }),
        transform: None,
        material: material.clone(),
    };
    description.scene.primitives = (0..1_000_000).map(primitive).collect();
    let integrator = integrator(&description);
    assert_eq!((integrator.geometry.len(), integrator.materials.len()), (1_000_000, 1));
    assert!(integrator.geometry.bytes() < 120 * 1_000_000);
}

#[test]
fn a_cancelled_render_stops() {
    let integrator = integrator(&description());
    let control = Control::new();
    control.cancel();
    let stopped = integrator.radiance(&[[0.0; 2]], 6, &mut Scratch::new(), &control, &mut Vec::new());
    assert!(stopped.is_err());
}
