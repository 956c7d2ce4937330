//! The engine against the model, bit by bit.

use conformance::{compare, random};
use hray::{Background, NoiseTables};

/// Seeds 0 to 599; another range can be given as `HRAY_SEEDS=FROM..TO`.
#[test]
fn random_scenes_are_the_models_to_the_bit() {
    let seeds = std::env::var("HRAY_SEEDS").ok().and_then(|range| {
        let (from, to) = range.split_once("..")?;
        Some(from.parse().ok()?..to.parse().ok()?)
    });
    let tables = NoiseTables::default();
    let mut failures = Vec::new();
    for seed in seeds.unwrap_or(0..600) {
        let threads = 1 + (seed % 3) as usize;
        let description = random::description(seed).unwrap();
        if let Err(difference) = compare(&description, &tables, threads) {
            failures.push(format!("seed {seed}: {difference}"));
        }
    }
    assert!(failures.is_empty(), "{} scenes differ:\n{}", failures.len(), failures.join("\n"));
}

/// A comparison that could not fail would be worth nothing.
#[test]
fn a_difference_is_found() {
    let tables = NoiseTables::default();
    let mut differences = 0;
    for seed in 0..40 {
        let description = random::description(seed).unwrap();
        let mut other = description.clone();
        let Background::Uniform(background) = &mut other.scene.background else { panic!() };
        background.r += 1e-16 + background.r.abs() * 1e-15;
        let of = |d| conformance::engine_colors(d, &tables, 1);
        let (Ok(a), Ok(b)) = (of(&description), of(&other)) else { panic!("seed {seed} does not render") };
        differences += usize::from(a != b);
    }
    assert!(differences > 10, "only {differences} of 40 scenes show a change in the last place");
}

/// Where p 2^k overflows though p / grid is of ordinary size, noise is not a number and the surface white.
#[test]
fn noise_of_points_that_overflow_between_octaves() {
    use hray::{Camera, DVec3, NoiseTexture, Plane, Rgb, Shape, Texture, WindowCamera};
    use std::sync::Arc;
    let mut description = (0..).find_map(random::description).unwrap();
    description.max_depth = 0;
    let camera = WindowCamera { eye: DVec3::new(0.0, 0.0, 150.0), window: [100.0, 75.0] };
    description.scene.camera = Camera::Window(camera);
    description.scene.lights =
        vec![hray::Light::Point { position: DVec3::new(0.0, 0.0, 9.0), intensity: Rgb::new(1.0, 1.0, 1.0) }];
    let base = Rgb::new(1.0, 1.0, 1.0);
    let texture = Texture::Noise(NoiseTexture::Turbulence { base, octaves: 3, grid: 1e308 });
    let material = Arc::new(hray::Material::matte(texture));
    let shape = Shape::Plane(Plane { normal: DVec3::Z, offset: 1e308 });
    description.scene.primitives = vec![hray::Primitive { shape, transform: None, material }];
    let tables = NoiseTables::default();
    compare(&description, &tables, 1).unwrap();
    assert!(conformance::engine_colors(&description, &tables, 1).unwrap().contains(&base));
}
