//! The colour of a surface, several points at a time: `colorAt`, and the textures of appendix A.3.

use super::lanes::{Lanes, Vec3};
use super::noise::{Noise, Sum};
use fearless_simd::prelude::*;
use hray_core::{DVec3, NoiseTexture, Rgb, Texture};

/// Diffuse colours at the points `p`.
#[inline(always)]
pub(super) fn color_at<S: Simd>(simd: S, noise: &Noise, texture: &Texture, p: Vec3<S>) -> Vec3<S> {
    let turbulence = |octaves, grid| noise.octaves(simd, 0, p, grid, octaves, Sum::Absolute);
    let half = |n: Lanes<S>| (n + 1.0) * 0.5;
    let scaled = |color: Rgb, factor: Lanes<S>| Vec3::splat_rgb(simd, color).scale(factor);
    let marble = |base: Rgb, octaves, grid, direction: DVec3, power: f64| {
        let bent = turbulence(octaves, grid) * power;
        scaled(base, half(sine(simd, p.x * direction.x + p.y * direction.y + p.z * direction.z + bent)))
    };
    match *texture {
        Texture::Solid(color) => Vec3::splat_rgb(simd, color),
        Texture::Noise(NoiseTexture::Solid { base, grid }) => {
            scaled(base, half(noise.octaves(simd, 0, p, grid, 0, Sum::Signed)))
        }
        Texture::Noise(NoiseTexture::SemiTurbulence { base, octaves, grid }) => {
            scaled(base, half(noise.octaves(simd, 0, p, grid, octaves, Sum::Signed)))
        }
        Texture::Noise(NoiseTexture::Turbulence { base, octaves, grid }) => {
            scaled(base, turbulence(octaves, grid))
        }
        Texture::Noise(NoiseTexture::Fire { added, base, octaves, grid }) => {
            Vec3::splat_rgb(simd, added).add(scaled(base, turbulence(octaves, grid))).clip(simd)
        }
        Texture::Noise(NoiseTexture::Plasma { grid }) => {
            let channel = |table| half(noise.octaves(simd, table, p, grid, 0, Sum::Signed));
            Vec3 { x: channel(0), y: channel(1), z: channel(2) }
        }
        Texture::Noise(NoiseTexture::Marble { base, octaves, grid, direction, power }) => {
            marble(base, octaves, grid, direction, power)
        }
        Texture::Noise(NoiseTexture::MarbleBase { base, added, octaves, grid, direction, power }) => {
            Vec3::splat_rgb(simd, added).add(marble(base, octaves, grid, direction, power)).clip(simd)
        }
        Texture::Noise(NoiseTexture::Wood { base, octaves, grid, rings, power }) => {
            let distance = p.dot(p).sqrt();
            let wave = sine(simd, (distance + turbulence(octaves, grid) * power) * rings).abs() * 0.25;
            let base = Vec3::splat_rgb(simd, base);
            let lightened = base.map(|c| c + wave).clip(simd);
            // The wave never exceeds 1/4; only NaN takes the other branch.
            let light = wave.simd_lt(0.5);
            Vec3 {
                x: light.select(lightened.x, base.x),
                y: light.select(lightened.y, base.y),
                z: light.select(lightened.z, base.z),
            }
        }
    }
}

/// The sine of each lane.
#[inline(always)]
fn sine<S: Simd>(simd: S, x: Lanes<S>) -> Lanes<S> {
    Lanes::<S>::from_fn(simd, |i| libm::sin(x[i]))
}
