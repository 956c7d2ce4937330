//! A scene prepared once and rendered in parts, in any order: what shows a picture while it comes into being.

use crate::classic::{Integrator, MeshTrees, Scratch, TooManyParts};
use crate::sampler::PixelSamples;
use crate::{Control, RayCounts, Region, RenderError, Settings};
use hray_core::{Description, NoiseTables, Rgb};
use std::convert::Infallible;
use std::num::NonZeroU32;

/// A scene ready to be rendered.
pub struct Prepared {
    integrator: Integrator,
}

impl std::fmt::Debug for Prepared {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prepared").finish_non_exhaustive()
    }
}

/// What one thread needs to render, kept from one part to the next.
pub struct Tracer {
    scratch: Scratch,
    points: Vec<[f64; 2]>,
    colors: Vec<Rgb>,
}

impl std::fmt::Debug for Tracer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tracer").finish_non_exhaustive()
    }
}

impl Default for Tracer {
    fn default() -> Self {
        Self::new()
    }
}

impl Tracer {
    /// One that has traced nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self { scratch: Scratch::new(), points: Vec::new(), colors: Vec::new() }
    }

    /// The rays traced so far.
    #[must_use]
    pub fn rays(&self) -> RayCounts {
        self.scratch.rays()
    }
}

impl Prepared {
    /// Prepares a scene. Of `meshes` those are kept that the scene has, with the trees over them.
    ///
    /// # Errors
    /// [`RenderError::Solids`]
    pub fn new(
        description: &Description,
        tables: &NoiseTables,
        meshes: &mut MeshTrees,
    ) -> Result<Self, RenderError<Infallible>> {
        let prepared = Integrator::with_meshes(description, tables, meshes);
        meshes.keep_used();
        let integrator = prepared.map_err(|TooManyParts| RenderError::Solids)?;
        Ok(Self { integrator })
    }

    /// How many threads may trace at once, for the memory that they take: few only where the recursion is thousands of
    /// levels deep.
    #[must_use]
    pub fn most_threads(&self, max_depth: i32) -> usize {
        self.integrator.most_threads(max_depth)
    }

    /// The colours of the pixels of `region` whose coordinates from its corner are multiples of `step`, moved to the middle
    /// of the squares of `step` by `step` pixels that they stand for; row by row. With a step of 1, and the samples of
    /// `settings`, these are the pixels that [`crate::render`] gives, to the bit. The region of `settings` means nothing.
    ///
    /// # Errors
    /// [`RenderError::Cancelled`] after [`Control::cancel`].
    pub fn pixels(
        &self,
        settings: &Settings,
        region: Region,
        step: NonZeroU32,
        samples: NonZeroU32,
        tracer: &mut Tracer,
        control: &Control,
    ) -> Result<Vec<Rgb>, RenderError<Infallible>> {
        let step = step.get();
        let (columns, rows) = (region.width().div_ceil(step), region.height().div_ceil(step));
        let mut pixels = Vec::with_capacity(columns as usize * rows as usize);
        tracer.points.clear();
        tracer.colors.clear();
        let middle = |start: u32, index: u32, end: u32| (start + index * step + step / 2).min(end - 1);
        let [right, bottom] = [region.x() + region.width(), region.y() + region.height()];
        let mut tracing = Tracing { prepared: self, settings, control, tracer };
        for row in 0..rows {
            let y = middle(region.y(), row, bottom);
            for column in 0..columns {
                let x = middle(region.x(), column, right);
                if samples == NonZeroU32::MIN {
                    tracing.add(x, y, [0.0; 2])?;
                } else {
                    let of_pixel = PixelSamples::of(x, y);
                    for sample in 0..samples.get() {
                        tracing.add(x, y, of_pixel.offset(sample))?;
                    }
                    // The samples of a pixel are summed up in their order as soon as they are all there.
                    if tracing.tracer.colors.len() >= samples.get() as usize {
                        tracing.sum(samples, &mut pixels);
                    }
                }
            }
        }
        tracing.trace()?;
        if samples == NonZeroU32::MIN {
            std::mem::swap(&mut pixels, &mut tracing.tracer.colors);
        } else {
            tracing.sum(samples, &mut pixels);
        }
        control.add_pixels(pixels.len() as u64);
        Ok(pixels)
    }
}

/// The samples of some pixels on their way.
struct Tracing<'a> {
    prepared: &'a Prepared,
    settings: &'a Settings,
    control: &'a Control,
    tracer: &'a mut Tracer,
}

impl Tracing<'_> {
    fn add(&mut self, x: u32, y: u32, [dx, dy]: [f64; 2]) -> Result<(), RenderError<Infallible>> {
        let resolution = self.settings.resolution;
        let point = [f64::from(x) + dx, f64::from(resolution.height() - 1 - y) + dy];
        self.tracer.points.push(self.prepared.integrator.film_point(resolution, point));
        let full = self.tracer.points.len() >= Integrator::batch(self.settings.max_depth);
        if full { self.trace() } else { Ok(()) }
    }

    fn trace(&mut self) -> Result<(), RenderError<Infallible>> {
        let Tracer { scratch, points, colors } = &mut *self.tracer;
        let depth = self.settings.max_depth;
        let traced = self.prepared.integrator.radiance(points, depth, scratch, self.control, colors);
        points.clear();
        traced.map_err(|_| RenderError::Cancelled)
    }

    /// Makes pixels of the samples that are there of whole pixels.
    fn sum(&mut self, samples: NonZeroU32, pixels: &mut Vec<Rgb>) {
        let count = samples.get() as usize;
        let colors = &mut self.tracer.colors;
        let whole = colors.len() / count * count;
        for colors in colors.get(..whole).unwrap_or(&[]).chunks_exact(count) {
            let sum = colors.iter().fold(Rgb::BLACK, |sum, &color| sum + color);
            let n = f64::from(samples.get());
            pixels.push(Rgb::new(sum.r / n, sum.g / n, sum.b / n));
        }
        colors.drain(..whole);
    }
}
