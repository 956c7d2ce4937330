//! Scenes made from a number, in which everything that a classic file can say occurs, and much that nobody
//! would say: coefficients outside [0, 1], lights inside spheres, spheres inside spheres, planes without a
//! normal, grids of size zero, numbers at which arithmetic overflows.

use hray::{
    Background, Camera, DVec3, Description, Encoding, Integrator, Light, Material, NoiseTexture, Plane,
    Primitive, Resolution, Rgb, Scene, Shape, Sphere, Texture, WindowCamera,
};
use std::num::NonZeroU32;
use std::sync::Arc;

/// A stream of numbers from a seed: `SplitMix64`.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Below `n`, which is not 0.
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// In [low, high).
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// True once in `n` times.
    fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    fn color(&mut self) -> Rgb {
        let mut component = || match self.below(8) {
            0 => 0.0,
            1 => 1.0,
            2 => self.between(-1.0, 3.0),
            _ => self.between(0.0, 1.0),
        };
        Rgb::new(component(), component(), component())
    }

    fn point(&mut self, size: f64) -> DVec3 {
        DVec3::new(self.between(-size, size), self.between(-size, size), self.between(-size, size))
    }
}

/// The scene of a seed; every seed has one. One in sixteen has numbers of extreme size.
#[must_use]
pub fn description(seed: u64) -> Option<Description> {
    let n = &mut Numbers(seed);
    let extreme = n.once_in(16);
    let scale = if extreme { n.of(&[1e-300, 1e-160, 1e-9, 1e6, 1e18, 1e80, 1e155, 1e304]) } else { 1.0 };
    let (width, height) = (n.below(23) as i64 + 1, n.below(17) as i64 + 1);
    let mut primitives: Vec<Primitive> = Vec::new();
    // Many enough for a tree over them, now and then.
    let most = if n.once_in(8) { 60 } else { 9 };
    for _ in 0..n.below(most) {
        let shape = match primitives.last() {
            // Two surfaces in the same place: the last one wins.
            Some(previous) if n.once_in(8) => previous.shape.clone(),
            _ => shape(n, scale),
        };
        let material = Arc::new(material(n, scale));
        primitives.push(Primitive { shape, transform: None, material });
    }
    let lights = (0..n.below(5)).map(|_| light(n, &primitives, scale)).collect();
    let eye =
        if n.once_in(4) { n.point(150.0) } else { DVec3::new(0.0, 0.0, n.of(&[150.0, -150.0, 40.0, 0.0])) };
    let window = [n.of(&[100.0, 100.0, 80.0, 1.0, -60.0, 0.0]), n.of(&[75.0, 75.0, 60.0, 1.0, -60.0, 0.0])];
    let max_depth = n.of(&[-1, 0, 1, 2, 3, 4, 6]);
    let camera = Camera::Window(WindowCamera { eye: eye * scale, window });
    let background = Background::Uniform(n.color());
    let scene = Scene { camera, background, primitives, lights, time: 0.0 };
    Resolution::new(width, height).ok().map(|resolution| Description {
        resolution,
        max_depth,
        samples: NonZeroU32::MIN,
        integrator: Integrator::Classic2005,
        encoding: Encoding::Raw,
        scene,
    })
}

fn shape(n: &mut Numbers, scale: f64) -> Shape {
    if n.once_in(3) {
        let normal = match n.below(8) {
            0 => DVec3::ZERO,
            1 => n.point(1e-9),
            2 => DVec3::Y,
            3 => DVec3::Z,
            _ => n.point(1.0),
        };
        Shape::Plane(Plane { normal, offset: n.between(-200.0, 300.0) * scale })
    } else {
        let radius = match n.below(12) {
            0 => 0.0,
            1 => -n.between(5.0, 60.0),
            2 => n.between(100.0, 2000.0),
            _ => n.between(5.0, 60.0),
        };
        let center = n.point(120.0) + DVec3::new(0.0, 0.0, n.of(&[-150.0, 0.0, 120.0]));
        Shape::Sphere(Sphere { radius: radius * scale, center: center * scale })
    }
}

fn material(n: &mut Numbers, scale: f64) -> Material {
    let texture = if n.once_in(3) { Texture::Solid(n.color()) } else { Texture::Noise(noise(n, scale)) };
    Material {
        reflection: n.of(&[0.0, 0.0, 0.3, 0.7, 1.0, -0.4, 1.5]).into(),
        shine: (n.of(&[0, 1, 2, 3, 20, 60, 200, 1001, -3, 3_000_000_000, i64::MAX]) as f64).into(),
        transmission: n.of(&[0.0, 0.0, 0.0, 0.4, 0.9, 1.0, -0.5]).into(),
        refractive_index: n.of(&[0.0, 0.6, 1.0, 1.12, 1.5, 2.4, -1.3]).into(),
        ..Material::matte(texture)
    }
}

fn noise(n: &mut Numbers, scale: f64) -> NoiseTexture {
    let (base, added) = (n.color(), n.color());
    let octaves = n.of(&[0, 1, 2, 5, 10, 10, 30, 49, 60, 1023, 1024, 1100]);
    let grid = match n.below(10) {
        0 => n.of(&[0.0, -0.0, 1e-300, 1e300, 1e-6]),
        1 => -n.between(1.0, 40.0),
        _ => n.between(0.5, 60.0) * scale,
    };
    let direction = n.point(0.5);
    let power = n.between(-5.0, 30.0);
    match n.below(8) {
        0 => NoiseTexture::Solid { base, grid },
        1 => NoiseTexture::SemiTurbulence { base, octaves, grid },
        2 => NoiseTexture::Turbulence { base, octaves, grid },
        3 => NoiseTexture::Fire { added, base, octaves, grid },
        4 => NoiseTexture::Plasma { grid },
        5 => NoiseTexture::Marble { base, octaves, grid, direction, power },
        6 => NoiseTexture::MarbleBase { base, added, octaves, grid, direction, power },
        _ => NoiseTexture::Wood { base, octaves, grid, rings: n.between(-1.0, 4.0), power },
    }
}

fn light(n: &mut Numbers, primitives: &[Primitive], scale: f64) -> Light {
    let intensity = n.color();
    if n.once_in(4) {
        return Light::Ambient { intensity };
    }
    let position = match primitives.first().map(|primitive| &primitive.shape) {
        // In the very centre of a sphere, or on its surface.
        Some(Shape::Sphere(sphere)) if n.once_in(6) => {
            sphere.center + DVec3::new(0.0, n.of(&[0.0, 1.0]) * sphere.radius, 0.0)
        }
        _ => n.point(300.0) * scale,
    };
    Light::Point { position, intensity }
}
