//! The integrator: `colorPt` of the thesis, over batches of rays.
//!
//! A batch is intersected with all primitives, its hits are grouped by what they lie on, so that all lanes of a
//! vector share one material, and each group is lit. The rays that are mirrored form the batch of the next level,
//! then those that are refracted; when a level is done its colours are added to the hits above. The levels are a
//! list, not the call stack: the deepest recursion allowed costs memory, not a crash.
//!
//! There are two sets of rules ([`hray_core::Integrator`]). The thesis' are its arithmetic to the bit. The exact
//! ones have no absolute constants: a hit is moved onto its surface and knows how far rounding may have left it
//! off ([`shapes::Surface::bound`]; after M. Pharr, W. Jakob and G. Humphreys, "Physically Based Rendering", 4th
//! edition, § 6.8), rays that leave it start beyond that, and whatever lies ahead of them counts.

mod accelerate;
mod bounds;
mod camera;
mod crossings;
mod evaluate;
mod explain;
mod frame;
mod geometry;
mod implicit;
mod implicit_cells;
mod implicit_roots;
mod light;
mod material;
mod mesh;
mod mesh_trees;
mod placement;
mod plans;
mod quadric;
mod round;
mod shapes;
mod solid;
mod solid_boxes;
mod steps;
mod texture;
mod torus;
mod trace;
mod uv;

use crate::{Control, RayCounts, RayKind};
use camera::View;
use fearless_simd::{Level, dispatch};
use frame::{Background, Frame, NOTHING, Phase, Uses};
use geometry::Geometry;
use hray_core::{Description, Light, NoiseTables, Resolution, Rgb};
use hray_expr::kernels::lanes::MAX_LANES;
use hray_expr::kernels::noise::Noise;
use material::{Material, Materials};
use plans::Plans;
use solid::Walk;

pub(crate) use explain::{Owners, Recorder};
pub use geometry::MAX_SOLID_PARTS;
pub(crate) use geometry::TooManyParts;
pub use mesh_trees::MeshTrees;

/// The most rays a batch is made of: enough to fill vectors after grouping, few enough to stay in cache.
const BATCH: usize = 512;
/// What the frames of one thread hold at all levels together, in rays; but at least a vector at each level.
const RAYS_IN_FLIGHT: usize = 1 << 15;
/// Bytes that a ray costs at worst, where every ray of a batch hits something else and so fills a vector of its
/// own; what each further column of its hits costs then; and what a frame costs besides.
const BYTES_PER_RAY: usize = 1000;
const BYTES_PER_COLUMN: usize = size_of::<f64>() * MAX_LANES;
const BYTES_PER_FRAME: usize = 2500;
/// What the frames of all threads together may hold at worst.
const BYTES_IN_FLIGHT: usize = 2 << 30;

/// A scene ready to be traced. Primitives and lights are in the order in which the thesis' lists hold them,
/// the reverse of the source's.
pub(crate) struct Integrator {
    geometry: Geometry,
    materials: Vec<Material>,
    plans: Plans,
    lights: Vec<Light>,
    background: Surroundings,
    view: View,
    time: f64,
    /// Whether the rules are the exact ones.
    exact: bool,
    uses: Uses,
    noise: Noise,
    level: Level,
}

/// What a ray sees that hits nothing.
enum Surroundings {
    Uniform(Rgb),
    /// The number of its plan.
    Function(u32),
}

/// What one thread needs to trace batches, kept from one to the next.
pub(crate) struct Scratch {
    frames: Vec<Frame>,
    keys: Vec<u64>,
    walk: Walk,
    functions: evaluate::Scratch,
    rays: RayCounts,
    /// What is to be kept of the rays, where a pixel is explained.
    recorder: Option<Recorder>,
}

impl Scratch {
    pub(crate) fn new() -> Self {
        Self {
            frames: Vec::new(),
            keys: Vec::new(),
            walk: Walk::default(),
            functions: evaluate::Scratch::new(),
            rays: RayCounts::default(),
            recorder: None,
        }
    }

    /// The rays traced so far.
    pub(crate) fn rays(&self) -> RayCounts {
        self.rays
    }
}

/// The render was stopped.
pub(crate) struct Stopped;

impl Integrator {
    pub(crate) fn new(description: &Description, tables: &NoiseTables) -> Result<Self, TooManyParts> {
        Self::with_meshes(description, tables, &mut MeshTrees::default())
    }

    /// The same with the trees of meshes that are known from before.
    pub(crate) fn with_meshes(
        description: &Description,
        tables: &NoiseTables,
        meshes: &mut MeshTrees,
    ) -> Result<Self, TooManyParts> {
        let scene = &description.scene;
        let exact = description.integrator == hray_core::Integrator::Classic;
        let mut materials = Materials::new(Plans::new(tables));
        let geometry = Geometry::new(&scene.primitives, description.integrator, &mut materials, meshes)?;
        let uv = materials.plans.use_uv;
        let fields = !materials.plans.is_empty();
        let meshes = geometry.has_meshes();
        let noisy = geometry.is_placed() && materials.list.iter().any(Material::uses_noise);
        let background = match &scene.background {
            hray_core::Background::Uniform(color) => Surroundings::Uniform(*color),
            hray_core::Background::Function(function) => match materials.plans.of(function, 3) {
                Some(plan) => Surroundings::Function(plan),
                None => Surroundings::Uniform(Rgb::BLACK),
            },
        };
        Ok(Self {
            geometry,
            materials: materials.list,
            plans: materials.plans,
            lights: scene.lights.iter().rev().copied().collect(),
            background,
            view: View::new(&scene.camera),
            time: scene.time,
            exact,
            uses: Uses { sides: exact, object: fields || noisy, uv, fields, smooth: meshes },
            noise: Noise::new(tables),
            level: Level::new(),
        })
    }

    /// The point of the film that stands for a point of a picture, which is counted in pixels from the lower left.
    pub(crate) fn film_point(&self, resolution: Resolution, point: [f64; 2]) -> [f64; 2] {
        self.view.film_point([resolution.width().into(), resolution.height().into()], point)
    }

    /// How many points [`Integrator::radiance`] should be given at a time.
    pub(crate) fn batch(max_depth: i32) -> usize {
        let levels = usize::try_from(max_depth).unwrap_or(0) + 1;
        (RAYS_IN_FLIGHT / levels).clamp(MAX_LANES, BATCH)
    }

    /// How many threads may trace at once before their frames could take more memory than is reasonable: few
    /// only where the recursion is thousands of levels deep.
    pub(crate) fn most_threads(&self, max_depth: i32) -> usize {
        let levels = usize::try_from(max_depth).unwrap_or(0) + 1;
        let Uses { sides, object, uv, fields, smooth } = self.uses;
        let used = [(sides, 5), (object, 3), (uv, 2), (smooth, 6), (fields, material::FIELDS)];
        let columns: usize = used.iter().filter(|(used, _)| *used).map(|(_, columns)| columns).sum();
        let per_ray = BYTES_PER_RAY + columns * BYTES_PER_COLUMN;
        let worst = levels * (Self::batch(max_depth) * per_ray + BYTES_PER_FRAME);
        (BYTES_IN_FLIGHT / worst).max(1)
    }

    fn material(&self, leaf: usize) -> &Material {
        &self.materials[self.geometry.material(leaf)]
    }

    /// Whether a function of a leaf's material asks for surface parameters.
    fn takes_uv(&self, leaf: usize) -> bool {
        self.material(leaf).varying.iter().any(|varying| self.plans.uses_uv(varying.plan))
    }

    /// The background where it is the same in every direction, which it is where this is asked.
    fn uniform_background(&self) -> [f64; 3] {
        match self.background {
            Surroundings::Uniform(color) => color.to_array(),
            Surroundings::Function(_) => [0.0; 3],
        }
    }

    /// The colours seen through points of the film.
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
        let Scratch { frames, keys, walk, functions, rays, recorder } = scratch;
        if frames.is_empty() {
            frames.push(Frame::new());
        }
        self.start(&mut frames[0], points, functions);
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
                self.intersect(frame, walk, control);
                if control.is_cancelled() {
                    return Err(Stopped);
                }
                frame.group_hits(self.geometry.len(), self.uses, keys);
                self.fill_background(frame, functions);
                dispatch!(self.level, simd => steps::locate(simd, self, frame, walk));
                if self.uses.fields {
                    self.evaluate_fields(frame, functions);
                }
                rays.shadow += dispatch!(self.level, simd => light::shade(simd, self, frame, walk, control));
                if let Some(recorder) = recorder {
                    recorder.lit(self, frame, [top, depth_left], walk, control);
                    recorder.next_is(RayKind::Reflection);
                }
                frame.phase = Phase::AfterReflection;
                if depth_left > 0 {
                    dispatch!(self.level, simd => steps::reflect(simd, self, frame, next));
                    if next.len > 0 {
                        rays.reflection += next.len as u64;
                        (top, depth_left) = (top + 1, depth_left - 1);
                        continue;
                    }
                }
            }
            if frame.phase == Phase::AfterReflection {
                frame.phase = Phase::AfterRefraction;
                if let Some(recorder) = recorder {
                    recorder.next_is(RayKind::Transmission);
                }
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
            if let Some(recorder) = recorder {
                recorder.finished(frame);
            }
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

    /// The nearest hit of each ray of a frame.
    fn intersect(&self, frame: &mut Frame, walk: &mut Walk, control: &Control) {
        dispatch!(self.level, simd => steps::intersect(simd, &self.geometry, frame, walk, control));
    }

    /// Rays from the camera: `rayTracePt` of appendix A.2.
    fn start(&self, frame: &mut Frame, points: &[[f64; 2]], functions: &mut evaluate::Scratch) {
        frame.begin(Background::Scene, points.len());
        frame.len = points.len();
        self.view.start(points, frame);
        if let View::Window(camera) = &self.view {
            dispatch!(self.level, simd => steps::away_from_eye(simd, camera.eye, self.exact, frame));
        }
        if let (Surroundings::Function(plan), false) = (&self.background, self.exact) {
            // By the thesis' rules what is refracted has the background of the ray from the camera.
            frame.background = Background::PerRay;
            frame.behind.reserve(points.len());
            let mut behind = std::mem::replace(&mut frame.behind, frame::Columns::new());
            self.evaluate_background(
                *plan,
                frame,
                functions,
                |_| true,
                |ray, color| {
                    behind.get_mut().into_iter().zip(color).for_each(|(column, v)| column[ray] = v);
                },
            );
            frame.behind = behind;
        }
    }

    /// Gives every ray what it sees where it hits nothing.
    fn fill_background(&self, frame: &mut Frame, functions: &mut evaluate::Scratch) {
        let len = frame.len;
        frame.color.reserve(len);
        let uniform = match (frame.background, &self.background) {
            (Background::PerRay, _) => {
                for (to, from) in frame.color.get_mut().into_iter().zip(frame.behind.get()) {
                    to[..len].copy_from_slice(&from[..len]);
                }
                return;
            }
            (Background::Scene, Surroundings::Function(plan)) => {
                let mut color = std::mem::replace(&mut frame.color, frame::Columns::new());
                let missed = |ray: usize| frame.nearest.get()[1][ray].to_bits() == NOTHING.to_bits();
                self.evaluate_background(*plan, frame, functions, missed, |ray, seen| {
                    color.get_mut().into_iter().zip(seen).for_each(|(column, v)| column[ray] = v);
                });
                frame.color = color;
                return;
            }
            (Background::Scene, Surroundings::Uniform(color)) => color.to_array(),
            (Background::Black, _) => [0.0; 3],
        };
        for (to, value) in frame.color.get_mut().into_iter().zip(uniform) {
            to[..len].fill(value);
        }
    }

    /// Adds the colours of a finished frame to the hits of the one above, each times the coefficient that
    /// its ray was owed to.
    fn give_back(&self, above: &mut Frame, done: &Frame) {
        let mirrored = above.phase == Phase::AfterReflection;
        let fields = above.fields.get();
        let mut to = above.hit_color.get_mut();
        let from = done.color.get();
        let mut next = 0;
        for group in &above.groups {
            let material = self.material(group.leaf);
            let factor = if mirrored { material.reflection } else { material.transmission };
            let end = (group.start + group.len) as u32;
            let count = done.parent[next..].iter().take_while(|&&place| place < end).count();
            for (to, from) in to.iter_mut().zip(from) {
                for (i, &place) in (next..).zip(&done.parent[next..next + count]) {
                    let hit = place as usize;
                    to[hit] += from[i] * factor.of(&fields, hit);
                }
            }
            next += count;
        }
    }
}

#[cfg(test)]
mod implicit_tests;
#[cfg(test)]
mod round_tests;
#[cfg(test)]
mod solid_tests;
#[cfg(test)]
mod tests;
