//! A scene to break, and random ones.

use hray_core::{
    Background, Camera, DVec3, Description, Encoding, Integrator, Light, Material, NoiseTexture, Plane,
    Primitive, Resolution, Rgb, Scene, Shape, Sphere, Texture, WindowCamera,
};
use hray_lang::diagnostic::{Diagnostic, render};
use hray_lang::lint::{self, LintLevels};
use hray_lang::{classic, decode::decode};
use proptest::prelude::*;
use std::num::NonZeroU32;
use std::ops::Range;
use std::sync::Arc;

/// A scene with nothing wrong.
pub(crate) const SCENE: &str = "\
renderDescr ( resolution (400,300) ) 3 [
scene { camera (0.0,0.0,150.0) (100,75) }
      { background (0.8,0.8,0.8) }
      { objects
        (object ( sphere 40.0 (0.0,0.0,-150.0) )
          ( texture ( diff solid (0.8,0.2,0.2) ) 0.3 60 0.0 0.0 ))
        (object ( plane (0.0,1.0,0.0,50.0) )
          ( texture ( diff perlin (perlinFire (0.2,0.2,0.2) (0.4,0.4,0.4) 10 64.0) )
            0.0 0 0.0 0.0 )) }
      { lights
        (pointLight (90.0,80.0,70.0) (0.7,0.7,0.7))
        (ambientLight (0.1,0.1,0.1)) } ]
";

/// The scene with one piece of text replaced. The piece has to be there once.
pub(crate) fn broken(from: &str, to: &str) -> String {
    assert_eq!(SCENE.matches(from).count(), 1, "{from:?} is not unique in the scene");
    SCENE.replacen(from, to, 1)
}

/// All that there is to say about a file.
pub(crate) fn diagnose(bytes: &[u8], levels: &LintLevels) -> (Vec<Diagnostic>, String) {
    let decoded = decode(bytes);
    if let Some(error) = decoded.error {
        return (vec![error], decoded.text.into());
    }
    let parsed = classic::parse(&decoded.text);
    let mut diagnostics = parsed.diagnostics;
    if let Some(description) = &parsed.description {
        assert!(diagnostics.is_empty(), "a description in spite of errors");
        diagnostics = lint::check(&decoded.text, description, &parsed.spans, levels);
    } else {
        assert!(!diagnostics.is_empty(), "neither a description nor an error");
    }
    (diagnostics, decoded.text.into())
}

/// What a user sees of a file.
pub(crate) fn shown(bytes: &[u8]) -> String {
    let (diagnostics, text) = diagnose(bytes, &LintLevels::default());
    render(&diagnostics, "scene.hry", &text, false)
}

/// Every span of every diagnostic lies in the source, on character boundaries.
pub(crate) fn check_spans(diagnostics: &[Diagnostic], source: &str) {
    for span in diagnostics.iter().flat_map(Diagnostic::spans) {
        assert!(source.get(span.start..span.end).is_some(), "{span:?} does not fit\n{diagnostics:?}");
    }
}

/// The places of the tokens of a valid scene.
pub(crate) fn tokens(source: &str) -> Vec<Range<usize>> {
    let mut tokens = Vec::new();
    let mut rest = 0;
    while let Some(first) = source[rest..].chars().next() {
        let start = rest;
        rest += first.len_utf8();
        let mut take = |belongs: fn(char) -> bool| {
            let length = source[rest..].find(|c| !belongs(c)).unwrap_or(source.len() - rest);
            rest += length;
        };
        match first {
            'a'..='z' | 'A'..='Z' => take(|c| c.is_ascii_alphabetic()),
            '0'..='9' | '-' => take(|c| c.is_ascii_digit() || c == '.'),
            _ if first.is_whitespace() => continue,
            _ => {}
        }
        tokens.push(start..rest);
    }
    tokens
}

fn real() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -1000.0..1000.0,
        2 => 0.0..=1.0,
        2 => proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO,
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, 0.1, 1e-9, f64::MAX, f64::MIN_POSITIVE, 1e300]),
    ]
}

prop_compose! {
    fn vector()(x in real(), y in real(), z in real()) -> DVec3 { DVec3::new(x, y, z) }
}

prop_compose! {
    fn color()(r in real(), g in real(), b in real()) -> Rgb { Rgb::new(r, g, b) }
}

fn noise() -> impl Strategy<Value = NoiseTexture> {
    let octaves = || prop_oneof![0..40u32, any::<u32>()];
    prop_oneof![
        (color(), real()).prop_map(|(base, grid)| NoiseTexture::Solid { base, grid }),
        (color(), octaves(), real()).prop_map(|(base, octaves, grid)| NoiseTexture::SemiTurbulence {
            base,
            octaves,
            grid
        }),
        (color(), octaves(), real()).prop_map(|(base, octaves, grid)| NoiseTexture::Turbulence {
            base,
            octaves,
            grid
        }),
        (color(), color(), octaves(), real()).prop_map(|(added, base, octaves, grid)| NoiseTexture::Fire {
            added,
            base,
            octaves,
            grid
        }),
        real().prop_map(|grid| NoiseTexture::Plasma { grid }),
        (color(), octaves(), real(), vector(), real()).prop_map(|(base, octaves, grid, direction, power)| {
            NoiseTexture::Marble { base, octaves, grid, direction, power }
        }),
        (color(), color(), octaves(), real(), vector(), real()).prop_map(
            |(base, added, octaves, grid, direction, power)| NoiseTexture::MarbleBase {
                base,
                added,
                octaves,
                grid,
                direction,
                power
            }
        ),
        (color(), octaves(), real(), real(), real()).prop_map(|(base, octaves, grid, rings, power)| {
            NoiseTexture::Wood { base, octaves, grid, rings, power }
        }),
    ]
}

fn primitive() -> impl Strategy<Value = Primitive> {
    let shape = prop_oneof![
        (real(), vector()).prop_map(|(radius, center)| Shape::Sphere(Sphere { radius, center })),
        (vector(), real()).prop_map(|(normal, offset)| Shape::Plane(Plane { normal, offset })),
    ];
    let texture = prop_oneof![color().prop_map(Texture::Solid), noise().prop_map(Texture::Noise)];
    (shape, texture, real(), any::<i64>(), real(), real()).prop_map(
        |(shape, texture, reflection, shine, transmission, refractive_index)| Primitive {
            shape,
            transform: None,
            material: Arc::new(Material {
                reflection: reflection.into(),
                shine: (shine as f64).into(),
                transmission: transmission.into(),
                refractive_index: refractive_index.into(),
                ..Material::matte(texture)
            }),
        },
    )
}

fn light() -> impl Strategy<Value = Light> {
    prop_oneof![
        (vector(), color()).prop_map(|(position, intensity)| Light::Point { position, intensity }),
        color().prop_map(|intensity| Light::Ambient { intensity }),
    ]
}

prop_compose! {
    fn scene()(
        eye in vector(),
        window in any::<[i64; 2]>(),
        background in color(),
        primitives in prop::collection::vec(primitive(), 0..6),
        lights in prop::collection::vec(light(), 0..4),
    ) -> Scene {
        let camera = Camera::Window(WindowCamera { eye, window: window.map(|side| side as f64) });
        Scene { camera, background: Background::Uniform(background), primitives, lights, time: 0.0 }
    }
}

prop_compose! {
    /// Any description that can be written down.
    pub(crate) fn description()(
        resolution in (1..=32_768i64, 1..=32_768i64).prop_filter_map("a resolution", |(width, height)| {
            Resolution::new(width, height).ok()
        }),
        max_depth in -1..=10_000i32,
        scene in scene(),
    ) -> Description {
        Description {
            resolution,
            max_depth,
            samples: NonZeroU32::MIN,
            integrator: Integrator::Classic2005,
            encoding: Encoding::Raw,
            scene,
        }
    }
}
