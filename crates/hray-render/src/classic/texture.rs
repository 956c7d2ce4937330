//! The colour of a surface, several points at a time: `colorAt`, and the textures of appendix A.3.

use fearless_simd::prelude::*;
use hray_core::{DVec3, NoiseTexture, Rgb, Texture};
use hray_expr::kernels::lanes::{Lanes, Vec3};
use hray_expr::kernels::noise::{Noise, Sum};
use hray_expr::kernels::sine::sine;

/// Diffuse colours at the points `p`.
#[inline(always)]
pub(super) fn color_at<S: Simd>(simd: S, noise: &Noise, texture: &Texture, p: Vec3<S>) -> Vec3<S> {
    match *texture {
        Texture::Solid(color) => Vec3::splat(simd, color),
        // Evaluated elsewhere.
        Texture::Function(_) => Vec3::splat(simd, DVec3::ZERO),
        Texture::Noise(NoiseTexture::Plasma { grid }) => Vec3 {
            x: half::<S>(noise.octaves(simd, 0, p, grid, 0, Sum::Signed)),
            y: half::<S>(noise.octaves(simd, 1, p, grid, 0, Sum::Signed)),
            z: half::<S>(noise.octaves(simd, 2, p, grid, 0, Sum::Signed)),
        },
        Texture::Noise(texture) => {
            let (grid, octaves, sum) = spectrum(&texture);
            let sum = noise.octaves(simd, 0, p, grid, octaves, sum);
            colored(simd, &texture, p, sum)
        }
    }
}

/// The cell size, the octaves and the kind of sum that a texture is made of.
fn spectrum(texture: &NoiseTexture) -> (f64, u32, Sum) {
    match *texture {
        NoiseTexture::Solid { grid, .. } | NoiseTexture::Plasma { grid } => (grid, 0, Sum::Signed),
        NoiseTexture::SemiTurbulence { grid, octaves, .. } => (grid, octaves, Sum::Signed),
        NoiseTexture::Turbulence { grid, octaves, .. }
        | NoiseTexture::Fire { grid, octaves, .. }
        | NoiseTexture::Marble { grid, octaves, .. }
        | NoiseTexture::MarbleBase { grid, octaves, .. }
        | NoiseTexture::Wood { grid, octaves, .. } => (grid, octaves, Sum::Absolute),
    }
}

/// The colour that a texture makes of its `sum` of noise.
#[inline(always)]
fn colored<S: Simd>(simd: S, texture: &NoiseTexture, p: Vec3<S>, sum: Lanes<S>) -> Vec3<S> {
    match *texture {
        NoiseTexture::Solid { base, .. } | NoiseTexture::SemiTurbulence { base, .. } => {
            Vec3::splat(simd, base).scale(half::<S>(sum))
        }
        NoiseTexture::Turbulence { base, .. } => Vec3::splat(simd, base).scale(sum),
        NoiseTexture::Fire { added, base, .. } => {
            Vec3::splat(simd, added).add(Vec3::splat(simd, base).scale(sum)).clip(simd)
        }
        NoiseTexture::Marble { base, direction, power, .. } => marble(simd, base, direction, power, p, sum),
        NoiseTexture::MarbleBase { base, added, direction, power, .. } => {
            Vec3::splat(simd, added).add(marble(simd, base, direction, power, p, sum)).clip(simd)
        }
        NoiseTexture::Wood { base, rings, power, .. } => wood(simd, base, rings, power, p, sum),
        // Made of three noises, above.
        NoiseTexture::Plasma { .. } => Vec3 { x: half::<S>(sum), y: half::<S>(sum), z: half::<S>(sum) },
    }
}

/// From [-1, 1] to [0, 1].
#[inline(always)]
fn half<S: Simd>(n: Lanes<S>) -> Lanes<S> {
    (n + 1.0) * 0.5
}

#[inline(always)]
fn marble<S: Simd>(
    simd: S,
    base: Rgb,
    direction: DVec3,
    power: f64,
    p: Vec3<S>,
    turbulence: Lanes<S>,
) -> Vec3<S> {
    let across = p.x * direction.x + p.y * direction.y + p.z * direction.z;
    Vec3::splat(simd, base).scale(half::<S>(sine(simd, across + turbulence * power)))
}

#[inline(always)]
fn wood<S: Simd>(simd: S, base: Rgb, rings: f64, power: f64, p: Vec3<S>, turbulence: Lanes<S>) -> Vec3<S> {
    let wave = sine(simd, (p.dot(p).sqrt() + turbulence * power) * rings).abs() * 0.25;
    let base = Vec3::splat(simd, base);
    let lightened = Vec3 { x: base.x + wave, y: base.y + wave, z: base.z + wave }.clip(simd);
    // The wave never exceeds 1/4; only NaN takes the other branch.
    let light = wave.simd_lt(0.5);
    Vec3 {
        x: light.select(lightened.x, base.x),
        y: light.select(lightened.y, base.y),
        z: light.select(lightened.z, base.z),
    }
}
