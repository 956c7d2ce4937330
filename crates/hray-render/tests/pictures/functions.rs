//! Materials and backgrounds that are functions.

use crate::common::{
    NORMAL, OBJECT, affine, camera, colors, description, directions, function, gray, matte, middle, mirror,
    of, placed, plane, showing, shown, sphere, v,
};
use hray_core::{
    Background, DAffine3, DVec3, Field, Integrator, Light, Material, NoiseTexture, Rgb, Texture,
};
use hray_expr::{Binary, Input};
use std::sync::Arc;

/// A field that is a function of the hit: the same number everywhere, but not as a constant.
fn field(value: f64) -> Field {
    Field::Function(function(|builder| {
        let zero = builder.constant(0.0).unwrap();
        let x = builder.input(Input::Px).unwrap();
        let x = builder.binary(Binary::Mul, x, zero).unwrap();
        let value = builder.constant(value).unwrap();
        vec![builder.binary(Binary::Add, x, value).unwrap()]
    }))
}

fn color(color: Rgb) -> Texture {
    let [r, g, b] = color.to_array();
    Texture::Function(function(|builder| {
        let zero = builder.constant(0.0).unwrap();
        let x = builder.input(Input::Px).unwrap();
        let x = builder.binary(Binary::Mul, x, zero).unwrap();
        [r, g, b]
            .map(|c| {
                let c = builder.constant(c).unwrap();
                builder.binary(Binary::Add, x, c).unwrap()
            })
            .to_vec()
    }))
}

/// Functions that always give the same give the same picture as constants, to the bit, by either rules.
#[test]
fn a_constant_function_is_a_constant() {
    let base = Rgb::new(0.3, 0.6, 0.2);
    let constant = Material {
        reflection: 0.3.into(),
        shine: 30.0.into(),
        transmission: 0.4.into(),
        refractive_index: 1.3.into(),
        highlight: Some(0.6.into()),
        glow: Some(Texture::Solid(Rgb::new(0.01, 0.02, 0.03))),
        bump: None,
        texture: Texture::Solid(base),
    };
    let varying = Material {
        reflection: field(0.3),
        shine: field(30.0),
        transmission: field(0.4),
        refractive_index: field(1.3),
        highlight: Some(field(0.6)),
        glow: Some(color(Rgb::new(0.01, 0.02, 0.03))),
        bump: None,
        texture: color(base),
    };
    let light = Light::Point { position: v(2.0, 3.0, 4.0), intensity: gray(0.7) };
    for integrator in [Integrator::Classic, Integrator::Classic2005] {
        let picture = |material: &Material| {
            let material = Arc::new(material.clone());
            let stretched = DAffine3::from_scale(v(1.2, 0.6, 0.9));
            let primitives = vec![
                of(sphere(v(-0.6, 0.0, 0.0), 0.7), &material),
                placed(of(sphere(v(0.7, 0.2, 0.0), 0.6), &material), stretched),
                of(plane(DVec3::Y, 0.8), &material),
            ];
            let mut description = description(40, primitives, vec![light]);
            description.scene.background = Background::Uniform(Rgb::new(0.2, 0.3, 0.4));
            description.integrator = integrator;
            colors(&description)
        };
        assert!(picture(&constant) == picture(&varying), "{integrator:?}");
    }
}

/// Textures stick to what is moved.
#[test]
fn textures_are_in_object_space() {
    let moved = DAffine3::from_translation(v(0.0, 0.0, -3.0));
    let show = |transform: Option<DAffine3>| {
        let ball = of(sphere(DVec3::ZERO, 1.0), &showing(OBJECT));
        let ball = match transform {
            Some(transform) => placed(ball, transform),
            None => ball,
        };
        shown(middle(vec![ball], Vec::new())).unwrap()
    };
    assert!(show(None).distance(DVec3::Z) < 1e-14 && show(Some(moved)).distance(DVec3::Z) < 1e-14);
    let noise = Texture::Noise(NoiseTexture::Turbulence { base: gray(1.0), octaves: 4, grid: 0.3 });
    let noisy = Arc::new(Material { glow: Some(noise), ..Material::matte(Texture::Solid(Rgb::BLACK)) });
    for integrator in [Integrator::Classic, Integrator::Classic2005] {
        let seen = |shift: DVec3| {
            let ball = placed(of(sphere(v(0.3, 0.1, 0.2), 1.0), &noisy), DAffine3::from_translation(shift));
            let mut description = description(16, vec![ball], Vec::new());
            let hray_core::Camera::Perspective(camera) = &mut description.scene.camera else { panic!() };
            (camera.from, camera.to) = (camera.from + shift, camera.to + shift);
            description.integrator = integrator;
            colors(&description)
        };
        let (here, there) = (seen(DVec3::ZERO), seen(v(8.0, 16.0, -32.0)));
        let near = |(a, b): (&Rgb, &Rgb)| (a.r - b.r).abs() < 1e-6;
        assert!(here.iter().zip(&there).all(near), "{integrator:?}");
    }
}

#[test]
fn the_moment_is_an_input() {
    let time = Texture::Function(affine([Input::Time; 3], 0.25, 0.0));
    let clock = Arc::new(Material { glow: Some(time), ..Material::matte(Texture::Solid(Rgb::BLACK)) });
    let mut description = description(1, vec![of(plane(DVec3::Z, 0.0), &clock)], Vec::new());
    description.scene.time = 2.0;
    assert_eq!(colors(&description)[0], gray(0.5));
}

/// The background is a function of the direction, in mirrors and through glass as well.
#[test]
fn a_background_may_vary() {
    let sky = |inputs| Background::Function(affine(inputs, 0.05, 0.5));
    let side = 24;
    for inputs in [OBJECT, crate::common::WORLD] {
        let mut description = description(side, Vec::new(), Vec::new());
        description.scene.background = sky(inputs);
        for integrator in [Integrator::Classic, Integrator::Classic2005] {
            description.integrator = integrator;
            for (color, direction) in colors(&description).into_iter().zip(directions(side)) {
                assert!(shown(color).unwrap().distance(direction) < 1e-13);
            }
        }
    }
    let ball = of(sphere(DVec3::ZERO, 1.0), &mirror());
    let mut description = description(side, vec![ball], Vec::new());
    description.scene.background = sky(OBJECT);
    let mut mirrored = 0;
    for (color, direction) in colors(&description).into_iter().zip(directions(side)) {
        let expected = crate::reference::nearest(&description.scene.primitives, camera().from, direction)
            .map_or(direction, |hit| {
                mirrored += 1;
                direction - 2.0 * hit.normal.dot(direction) * hit.normal
            });
        assert!(shown(color).unwrap().distance(expected) < 1e-12);
    }
    assert!(mirrored > 50);
}

/// On a wall, a height of x / 2 everywhere tilts the normal (0, 0, 1) to (-1/2, 0, 1).
#[test]
fn bumps_tilt_the_normal() {
    let bump = Some(function(|builder| {
        let (half, zero) = (builder.constant(0.5).unwrap(), builder.constant(0.0).unwrap());
        vec![half, zero, zero]
    }));
    let bumpy = Arc::new(Material { bump, ..Material::matte(Texture::Solid(gray(1.0))) });
    let normal = v(-0.5, 0.0, 1.0).normalize();
    for integrator in [Integrator::Classic, Integrator::Classic2005] {
        for direction in [DVec3::NEG_Z, -normal] {
            let light = Light::Directional { direction, intensity: gray(0.5) };
            let mut description = description(1, vec![of(plane(DVec3::Z, 0.0), &bumpy)], vec![light]);
            description.integrator = integrator;
            let found = colors(&description)[0].r;
            assert!((found + 0.5 * normal.dot(direction)).abs() < 1e-12, "{integrator:?}: {found}");
        }
        // Stretched to twice the width, the same height is half as steep.
        let light = Light::Directional { direction: DVec3::NEG_Z, intensity: gray(0.5) };
        let wide = placed(of(plane(DVec3::Z, 0.0), &bumpy), DAffine3::from_scale(v(2.0, 1.0, 1.0)));
        let mut description = description(1, vec![wide], vec![light]);
        description.integrator = integrator;
        let found = colors(&description)[0].r;
        assert!((found - 0.5 / (1.0f64 + 1.0 / 16.0).sqrt()).abs() < 1e-12, "{integrator:?}: {found}");
    }
}

/// The geometric normal is what functions see, whatever the bumps.
#[test]
fn steep_bumps_neither_panic_nor_let_light_through() {
    let bump = Some(affine(OBJECT, 1e9, 3.0));
    let rough = Arc::new(Material {
        bump,
        reflection: 0.5.into(),
        transmission: 0.3.into(),
        refractive_index: 1.5.into(),
        ..Material::matte(Texture::Function(affine(NORMAL, 0.05, 0.5)))
    });
    let light = Light::Point { position: v(2.0, 2.0, 3.0), intensity: gray(0.5) };
    let primitives = vec![of(sphere(DVec3::ZERO, 1.2), &rough), of(plane(DVec3::Y, 1.0), &matte(0.5))];
    let found = colors(&description(40, primitives, vec![light]));
    assert!(found.iter().all(|c| c.to_array().iter().all(|v| v.is_finite())));
}
