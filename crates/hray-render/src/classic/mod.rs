//! The classic integrator: `colorPt` of the thesis, over batches of rays.
//!
//! A batch is intersected with all primitives, its hits are grouped by the primitive they lie on, so that all
//! lanes of a vector share one material, and each group is lit. The rays that are mirrored form the batch of
//! the next level, then those that are refracted; when a level is done its colours are added to the hits
//! above. The levels are a list, not the call stack: the deepest recursion allowed costs memory, not a crash.

mod frame;
mod material;
mod shapes;
mod steps;
mod texture;

use crate::{Control, RayCounts};
use fearless_simd::{Level, dispatch};
use frame::{Background, Frame, Phase};
use hray_core::{Camera, DVec3, Description, Light, NoiseTables, Rgb, WindowCamera};
use hray_expr::kernels::lanes::MAX_LANES;
use hray_expr::kernels::noise::Noise;
use material::Material;
use shapes::Prepared;

/// The most rays a batch is made of: enough to fill vectors after grouping, few enough to stay in cache.
const BATCH: usize = 512;
/// What the frames of one thread hold at all levels together, in rays; but at least a vector at each level.
const RAYS_IN_FLIGHT: usize = 1 << 15;
/// Bytes that a ray costs at worst, where every ray of a batch hits something else and so fills a vector of its
/// own, and that a frame costs besides.
const BYTES_PER_RAY: usize = 1000;
const BYTES_PER_FRAME: usize = 2000;
/// What the frames of all threads together may hold at worst.
const BYTES_IN_FLIGHT: usize = 2 << 30;

/// A scene ready to be traced. Primitives and lights are in the order in which the thesis' lists hold them,
/// the reverse of the source's.
pub(crate) struct Integrator {
    shapes: Vec<Prepared>,
    materials: Vec<Material>,
    lights: Vec<Light>,
    background: Rgb,
    camera: WindowCamera,
    noise: Noise,
    level: Level,
}

/// What one thread needs to trace batches, kept from one to the next.
pub(crate) struct Scratch {
    frames: Vec<Frame>,
    keys: Vec<u64>,
    rays: RayCounts,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self { frames: Vec::new(), keys: Vec::new(), rays: RayCounts::default() }
    }

    /// The rays traced so far.
    pub(crate) fn rays(&self) -> RayCounts {
        self.rays
    }
}

/// The render was stopped.
pub(crate) struct Stopped;

impl Integrator {
    pub(crate) fn new(description: &Description, tables: &NoiseTables) -> Self {
        let scene = &description.scene;
        Self {
            shapes: scene.primitives.iter().rev().map(|p| Prepared::new(&p.shape)).collect(),
            materials: scene.primitives.iter().rev().map(|p| Material::new(&p.material)).collect(),
            lights: scene.lights.iter().rev().copied().collect(),
            background: match scene.background {
                hray_core::Background::Uniform(color) => color,
                hray_core::Background::Function(_) => Rgb::BLACK,
            },
            camera: match scene.camera {
                Camera::Window(camera) => camera,
                _ => WindowCamera { eye: DVec3::Z, window: [1.0; 2] },
            },
            noise: Noise::new(tables),
            level: Level::new(),
        }
    }

    /// Width and height of the window, in world units.
    pub(crate) fn window(&self) -> [f64; 2] {
        self.camera.window
    }

    /// How many points [`Integrator::radiance`] should be given at a time.
    pub(crate) fn batch(max_depth: i32) -> usize {
        let levels = usize::try_from(max_depth).unwrap_or(0) + 1;
        (RAYS_IN_FLIGHT / levels).clamp(MAX_LANES, BATCH)
    }

    /// How many threads may trace at once before their frames could take more memory than is reasonable: few
    /// only where the recursion is thousands of levels deep.
    pub(crate) fn most_threads(max_depth: i32) -> usize {
        let levels = usize::try_from(max_depth).unwrap_or(0) + 1;
        let worst = levels * (Self::batch(max_depth) * BYTES_PER_RAY + BYTES_PER_FRAME);
        (BYTES_IN_FLIGHT / worst).max(1)
    }

    /// The colours seen through points of the window (in world space, z = 0).
    pub(crate) fn radiance(
        &self,
        points: &[[f64; 2]],
        max_depth: i32,
        scratch: &mut Scratch,
        control: &Control,
        colors: &mut Vec<Rgb>,
    ) -> Result<(), Stopped> {
        let Ok(mut depth_left) = usize::try_from(max_depth) else {
            colors.extend(points.iter().map(|_| Rgb::BLACK));
            return Ok(());
        };
        if points.is_empty() {
            return Ok(());
        }
        let Scratch { frames, keys, rays } = scratch;
        if frames.is_empty() {
            frames.push(Frame::new());
        }
        self.start(&mut frames[0], points);
        rays.camera += points.len() as u64;
        let mut top = 0;
        loop {
            if control.is_cancelled() {
                return Err(Stopped);
            }
            if frames.len() == top + 1 {
                frames.push(Frame::new());
            }
            let (upper, lower) = frames.split_at_mut(top + 1);
            let (frame, next) = (&mut upper[top], &mut lower[0]);
            if frame.phase == Phase::Trace {
                dispatch!(self.level, simd => steps::intersect(simd, &self.shapes, frame, control));
                if control.is_cancelled() {
                    return Err(Stopped);
                }
                frame.group_hits(self.shapes.len(), keys);
                self.fill_background(frame);
                rays.shadow += dispatch!(self.level, simd => steps::shade(simd, self, frame, control));
                frame.phase = Phase::AfterReflection;
                if depth_left > 0 {
                    dispatch!(self.level, simd => steps::reflect(simd, &self.materials, frame, next));
                    if next.len > 0 {
                        rays.reflection += next.len as u64;
                        (top, depth_left) = (top + 1, depth_left - 1);
                        continue;
                    }
                }
            }
            if frame.phase == Phase::AfterReflection {
                frame.phase = Phase::AfterRefraction;
                if depth_left > 0 {
                    dispatch!(self.level, simd => steps::refract(simd, self, frame, next));
                    if next.len > 0 {
                        rays.refraction += next.len as u64;
                        (top, depth_left) = (top + 1, depth_left - 1);
                        continue;
                    }
                }
            }
            dispatch!(self.level, simd => steps::finish(simd, frame));
            if top == 0 {
                break;
            }
            (top, depth_left) = (top - 1, depth_left + 1);
            let (upper, lower) = frames.split_at_mut(top + 1);
            self.give_back(&mut upper[top], &lower[0]);
        }
        let [r, g, b] = frames[0].color.get();
        let components = r.iter().zip(g).zip(b).take(points.len());
        colors.extend(components.map(|((&r, &g), &b)| Rgb::new(r, g, b)));
        Ok(())
    }

    /// Rays from the camera: `rayTracePt` of appendix A.2.
    fn start(&self, frame: &mut Frame, points: &[[f64; 2]]) {
        frame.begin(Background::Scene, points.len());
        frame.len = points.len();
        let [x, y, z] = frame.origin.get_mut();
        for (i, &[px, py]) in points.iter().enumerate() {
            (x[i], y[i], z[i]) = (px, py, 0.0);
        }
        frame.origin.pad(points.len());
        dispatch!(self.level, simd => steps::away_from_eye(simd, self.camera.eye, frame));
    }

    /// Gives every ray what it sees where it hits nothing.
    fn fill_background(&self, frame: &mut Frame) {
        let len = frame.len;
        frame.color.reserve(len);
        match frame.background {
            Background::PerRay => {
                for (to, from) in frame.color.get_mut().into_iter().zip(frame.behind.get()) {
                    to[..len].copy_from_slice(&from[..len]);
                }
            }
            uniform => {
                let color = if uniform == Background::Scene { self.background } else { Rgb::BLACK };
                for (to, value) in frame.color.get_mut().into_iter().zip(color.to_array()) {
                    to[..len].fill(value);
                }
            }
        }
    }

    /// Adds the colours of a finished frame to the hits of the one above, each times the coefficient that
    /// its ray was owed to.
    fn give_back(&self, above: &mut Frame, done: &Frame) {
        let coefficient = |material: &Material| {
            if above.phase == Phase::AfterReflection { material.reflection } else { material.transmission }
        };
        let mut to = above.hit_color.get_mut();
        let from = done.color.get();
        let mut next = 0;
        for group in &above.groups {
            let factor = coefficient(&self.materials[group.primitive]);
            let end = (group.start + group.len) as u32;
            let count = done.parent[next..].iter().take_while(|&&place| place < end).count();
            for (to, from) in to.iter_mut().zip(from) {
                for (i, &place) in (next..).zip(&done.parent[next..next + count]) {
                    to[place as usize] += from[i] * factor;
                }
            }
            next += count;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hray_core::{
        Background, Encoding, NoiseTexture, Plane, Primitive, Resolution, Scene, Shape, Sphere, Texture,
    };
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

    fn colors(level: Level, batch: usize) -> (Vec<[u64; 3]>, RayCounts) {
        let mut integrator = Integrator::new(&description(), &NoiseTables::default());
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
        let expected = colors(Level::baseline(), BATCH);
        assert!(expected.1.reflection > 1000 && expected.1.refraction > 1000, "{:?}", expected.1);
        let mut levels = vec![Level::new()];
        #[cfg(target_arch = "x86_64")]
        levels.extend(Level::new().as_avx2().map(Level::Avx2));
        for level in levels {
            for batch in [1, 7, 64, BATCH] {
                assert!(colors(level, batch) == expected, "{level:?}, batches of {batch}");
            }
        }
    }

    #[test]
    fn a_cancelled_render_stops() {
        let integrator = Integrator::new(&description(), &NoiseTables::default());
        let control = Control::new();
        control.cancel();
        let stopped = integrator.radiance(&[[0.0; 2]], 6, &mut Scratch::new(), &control, &mut Vec::new());
        assert!(stopped.is_err());
    }
}
