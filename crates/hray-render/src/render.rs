//! Runs of pixels, dealt out to threads and handed on in order.

use crate::classic::{Integrator, MAX_SOLID_PARTS, Scratch, Stopped, TooManyParts};
use crate::sampler::PixelSamples;
use crate::{Control, RayCounts, Settings, Statistics};
use hray_core::{Description, NoiseTables, Rgb};
use std::collections::BTreeMap;
use std::fmt;
use std::num::{NonZeroU32, NonZeroUsize};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Condvar, Mutex, PoisonError};

/// Camera rays of a run, about, where there are enough of them.
const RUN: u64 = 4096;
/// Runs that each thread gets at least, so that all are busy to the end; as long as a run has enough pixels to
/// fill vectors.
const RUNS_PER_THREAD: u64 = 16;
const SMALLEST_RUN: u64 = 64;
/// Runs per thread that may be finished before their turn.
const AHEAD: u64 = 8;

/// Why there is no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RenderError<E> {
    /// [`Control::cancel`] was called.
    Cancelled,
    /// The threads could not be started.
    Threads,
    /// The solids of the scene have more than [`MAX_SOLID_PARTS`] parts together.
    Solids,
    /// Whoever takes the pixels failed.
    Sink(E),
}

impl<E: fmt::Display> fmt::Display for RenderError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cancelled => f.write_str("the render was stopped"),
            Self::Threads => f.write_str("the system refused to start the threads that render"),
            Self::Solids => write!(
                f,
                "the solids of the scene have more than {MAX_SOLID_PARTS} parts, counting one that is used twice \
                 as two"
            ),
            Self::Sink(error) => error.fmt(f),
        }
    }
}

impl<E: std::error::Error + 'static> std::error::Error for RenderError<E> {}

/// Renders `settings.region` of what a description shows. Its size, depth and samples are those of `settings`.
///
/// The pixels of the region, row by row from the top and each row from the left, are cut into runs of a few
/// thousand. `encode` turns a run into whatever the caller wants to keep of it, on the thread that rendered
/// it; `consume` gets the encoded runs **in order**, on the calling thread. Only a few runs per thread are
/// ever waiting, so memory does not grow with the picture.
///
/// Colours are as the integrator leaves them: in [0, 1], except that the background is not clipped.
///
/// # Errors
/// [`RenderError::Cancelled`] after [`Control::cancel`]; [`RenderError::Sink`] with the error of `consume`;
/// [`RenderError::Solids`] and [`RenderError::Threads`].
pub fn render<T, E>(
    description: &Description,
    tables: &NoiseTables,
    settings: &Settings,
    control: &Control,
    encode: impl Fn(&[Rgb]) -> T + Sync,
    consume: impl FnMut(T) -> Result<(), E>,
) -> Result<Statistics, RenderError<E>>
where
    T: Send,
{
    let integrator = Integrator::new(description, tables).map_err(|TooManyParts| RenderError::Solids)?;
    let threads = settings.threads.or_else(|| std::thread::available_parallelism().ok());
    let threads = threads.map_or(1, NonZeroUsize::get).min(integrator.most_threads(settings.max_depth));
    let job = Job::new(integrator, settings, control, threads as u64);
    let threads = threads.min(usize::try_from(job.runs).unwrap_or(usize::MAX));
    let rays = if threads == 1 {
        job.render_here(encode, consume)?
    } else {
        job.render_with(threads, encode, consume)?
    };
    Ok(Statistics { rays, threads })
}

/// A render, cut into runs.
pub(crate) struct Job<'a> {
    pub(crate) integrator: Integrator,
    settings: &'a Settings,
    control: &'a Control,
    pixels_per_run: u64,
    runs: u64,
}

impl<'a> Job<'a> {
    pub(crate) fn new(
        integrator: Integrator,
        settings: &'a Settings,
        control: &'a Control,
        threads: u64,
    ) -> Self {
        let samples = u64::from(settings.samples.get());
        let fair = settings.region.pixels() / threads.saturating_mul(RUNS_PER_THREAD);
        let pixels_per_run = fair.clamp(SMALLEST_RUN, RUN).min(RUN / samples).max(1);
        Self {
            integrator,
            settings,
            control,
            pixels_per_run,
            runs: settings.region.pixels().div_ceil(pixels_per_run),
        }
    }

    /// All runs, one after the other, on this thread.
    fn render_here<T, E>(
        &self,
        encode: impl Fn(&[Rgb]) -> T,
        mut consume: impl FnMut(T) -> Result<(), E>,
    ) -> Result<RayCounts, RenderError<E>> {
        let mut worker = Worker::new(self);
        for run in 0..self.runs {
            let pixels = worker.render(run).map_err(|Stopped| RenderError::Cancelled)?;
            consume(encode(pixels)).map_err(RenderError::Sink)?;
        }
        Ok(worker.scratch.rays())
    }

    /// All runs, dealt out to threads; this one hands them on in order.
    fn render_with<T: Send, E>(
        &self,
        threads: usize,
        encode: impl Fn(&[Rgb]) -> T + Sync,
        mut consume: impl FnMut(T) -> Result<(), E>,
    ) -> Result<RayCounts, RenderError<E>> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.map_err(|_| RenderError::Threads)?;
        let queue = Queue::new(self.runs, AHEAD * threads as u64);
        let rays = Mutex::new(RayCounts::default());
        let (sender, receiver) = channel();
        let result = pool.in_place_scope(|scope| {
            for _ in 0..threads {
                let (queue, rays, encode, sender) = (&queue, &rays, &encode, sender.clone());
                scope.spawn(move |_| {
                    let counted = self.work(queue, encode, &sender);
                    *rays.lock().unwrap_or_else(PoisonError::into_inner) += counted;
                });
            }
            drop(sender);
            let mut waiting = BTreeMap::new();
            let mut next = 0;
            for (run, encoded) in receiver {
                waiting.insert(run, encoded);
                while let Some(encoded) = waiting.remove(&next) {
                    if let Err(error) = consume(encoded) {
                        queue.stop();
                        return Err(RenderError::Sink(error));
                    }
                    next += 1;
                    queue.consumed(next);
                }
            }
            if next == self.runs { Ok(()) } else { Err(RenderError::Cancelled) }
        });
        result?;
        Ok(rays.into_inner().unwrap_or_else(PoisonError::into_inner))
    }

    /// Takes runs from the queue until there are no more, or the render is stopped.
    fn work<T>(&self, queue: &Queue, encode: impl Fn(&[Rgb]) -> T, sender: &Sender<(u64, T)>) -> RayCounts {
        let _guard = StopWhenDropped(queue);
        let mut worker = Worker::new(self);
        while let Some(run) = queue.take() {
            let Ok(pixels) = worker.render(run) else {
                queue.stop();
                break;
            };
            if sender.send((run, encode(pixels))).is_err() {
                break;
            }
        }
        worker.scratch.rays()
    }
}

/// One thread's part of a job.
pub(crate) struct Worker<'a> {
    job: &'a Job<'a>,
    pub(crate) scratch: Scratch,
    batch: usize,
    points: Vec<[f64; 2]>,
    colors: Vec<Rgb>,
    pixels: Vec<Rgb>,
}

impl<'a> Worker<'a> {
    pub(crate) fn new(job: &'a Job<'a>) -> Self {
        Self {
            job,
            scratch: Scratch::new(),
            batch: Integrator::batch(job.settings.max_depth),
            points: Vec::new(),
            colors: Vec::new(),
            pixels: Vec::new(),
        }
    }

    /// The colours of one run of pixels.
    pub(crate) fn render(&mut self, run: u64) -> Result<&[Rgb], Stopped> {
        let Settings { region, samples, .. } = *self.job.settings;
        let first = run * self.job.pixels_per_run;
        let last = (first + self.job.pixels_per_run).min(region.pixels());
        let width = u64::from(region.width());
        self.pixels.clear();
        self.points.clear();
        self.colors.clear();
        // Both fit: they are coordinates of a pixel of the region.
        let (mut column, mut row) = ((first % width) as u32, (first / width) as u32);
        for _ in first..last {
            let (x, y) = (region.x() + column, region.y() + row);
            if samples == NonZeroU32::MIN {
                self.add(self.film_point(x, y, [0.0; 2]))?;
            } else {
                let pixel_samples = PixelSamples::of(x, y);
                for sample in 0..samples.get() {
                    self.add(self.film_point(x, y, pixel_samples.offset(sample)))?;
                }
            }
            column += 1;
            if column == region.width() {
                (column, row) = (0, row + 1);
            }
        }
        self.trace()?;
        let count = samples.get() as usize;
        if count == 1 {
            std::mem::swap(&mut self.pixels, &mut self.colors);
        } else {
            let mean = |colors: &[Rgb]| {
                let sum = colors.iter().fold(Rgb::BLACK, |sum, &color| sum + color);
                let n = f64::from(samples.get());
                Rgb::new(sum.r / n, sum.g / n, sum.b / n)
            };
            self.pixels.extend(self.colors.chunks_exact(count).map(mean));
        }
        self.job.control.add_pixels(last - first);
        Ok(&self.pixels)
    }

    fn add(&mut self, point: [f64; 2]) -> Result<(), Stopped> {
        self.points.push(point);
        if self.points.len() == self.batch { self.trace() } else { Ok(()) }
    }

    fn trace(&mut self) -> Result<(), Stopped> {
        let Job { integrator, settings, control, .. } = self.job;
        let (points, colors) = (&self.points, &mut self.colors);
        integrator.radiance(points, settings.max_depth, &mut self.scratch, control, colors)?;
        self.points.clear();
        Ok(())
    }

    /// The point of the film that a sample of a pixel stands for, with `y` from the top.
    fn film_point(&self, x: u32, y: u32, [dx, dy]: [f64; 2]) -> [f64; 2] {
        let resolution = self.job.settings.resolution;
        let px = f64::from(x) + dx;
        let py = f64::from(resolution.height() - 1 - y) + dy;
        self.job.integrator.film_point(resolution, [px, py])
    }
}

/// Deals out the numbers of runs, and holds back who is too far ahead of the consumer.
struct Queue {
    next: AtomicU64,
    runs: u64,
    ahead: u64,
    /// Runs consumed; all of them once the render is stopped.
    consumed: Mutex<Consumed>,
    changed: Condvar,
}

#[derive(Clone, Copy)]
struct Consumed {
    runs: u64,
    stopped: bool,
}

impl Queue {
    fn new(runs: u64, ahead: u64) -> Self {
        let consumed = Mutex::new(Consumed { runs: 0, stopped: false });
        Self { next: AtomicU64::new(0), runs, ahead, consumed, changed: Condvar::new() }
    }

    /// The next run to render, once its turn is near.
    fn take(&self) -> Option<u64> {
        let run = self.next.fetch_add(1, Ordering::Relaxed);
        if run >= self.runs {
            return None;
        }
        let consumed = self.consumed.lock().unwrap_or_else(PoisonError::into_inner);
        let too_early = |c: &mut Consumed| !c.stopped && run >= c.runs + self.ahead;
        let consumed = self.changed.wait_while(consumed, too_early).unwrap_or_else(PoisonError::into_inner);
        if consumed.stopped { None } else { Some(run) }
    }

    fn consumed(&self, runs: u64) {
        self.consumed.lock().unwrap_or_else(PoisonError::into_inner).runs = runs;
        self.changed.notify_all();
    }

    fn stop(&self) {
        self.consumed.lock().unwrap_or_else(PoisonError::into_inner).stopped = true;
        self.changed.notify_all();
    }
}

/// Frees the other threads if this one ends early: its run would never be consumed.
struct StopWhenDropped<'a>(&'a Queue);

impl Drop for StopWhenDropped<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.stop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hray_core::{
        Background, Camera, DVec3, Encoding, Light, Material, Primitive, Resolution, Scene, Shape, Sphere,
        Texture, WindowCamera,
    };
    use std::sync::Arc;
    use std::time::{Duration, Instant};

    fn spheres(count: usize, lights: usize) -> Description {
        let material = Arc::new(Material {
            reflection: 0.5.into(),
            shine: 20.0.into(),
            ..Material::matte(Texture::Solid(Rgb::new(0.5, 0.5, 0.5)))
        });
        let shape = |i: usize| {
            let center = DVec3::new((i % 300) as f64 - 150.0, (i / 300) as f64 - 150.0, -300.0);
            Shape::Sphere(Sphere { radius: 2.0, center })
        };
        let light = |i: usize| Light::Point {
            position: DVec3::new(i as f64, 500.0, 100.0),
            intensity: Rgb::new(0.1, 0.1, 0.1),
        };
        let camera = WindowCamera { eye: DVec3::new(0.0, 0.0, 150.0), window: [100.0, 100.0] };
        let primitive = |i| Primitive { shape: shape(i), transform: None, material: material.clone() };
        Description {
            resolution: Resolution::new(64, 64).unwrap(),
            max_depth: 3,
            samples: NonZeroU32::MIN,
            integrator: hray_core::Integrator::Classic2005,
            encoding: Encoding::Raw,
            scene: Scene {
                camera: Camera::Window(camera),
                background: Background::Uniform(Rgb::BLACK),
                primitives: (0..count).map(primitive).collect(),
                lights: (0..lights).map(light).collect(),
                time: 0.0,
            },
        }
    }

    fn settings(side: i64, threads: usize) -> Settings {
        let resolution = Resolution::new(side, side).unwrap();
        Settings {
            resolution,
            region: crate::Region::whole(resolution),
            max_depth: 3,
            samples: NonZeroU32::MIN,
            threads: NonZeroUsize::new(threads),
        }
    }

    /// One step over a batch takes minutes here; it must not have to end first.
    #[test]
    fn a_stopped_render_ends_in_the_middle_of_a_batch() {
        let (scene, tables, control) = (spheres(90_000, 3000), NoiseTables::default(), Control::new());
        let start = Instant::now();
        let result = std::thread::scope(|scope| {
            scope.spawn(|| {
                std::thread::sleep(Duration::from_millis(300));
                control.cancel();
            });
            render(&scene, &tables, &settings(64, 2), &control, <[Rgb]>::len, |_| Ok::<(), ()>(()))
        });
        assert_eq!(result, Err(RenderError::Cancelled));
        assert!(start.elapsed() < Duration::from_secs(30));
    }

    #[test]
    fn a_small_picture_keeps_all_threads_busy() {
        let (scene, tables, control) = (spheres(10, 1), NoiseTables::default(), Control::new());
        let of = |threads| {
            let mut pixels = Vec::new();
            let take = |run: Vec<Rgb>| {
                pixels.extend(run);
                Ok::<(), ()>(())
            };
            let statistics =
                render(&scene, &tables, &settings(64, threads), &control, <[Rgb]>::to_vec, take).unwrap();
            assert_eq!(statistics.threads, threads);
            (pixels, statistics.rays)
        };
        let expected = of(1);
        assert_eq!(expected.0.len(), 64 * 64);
        assert!([2, 7, 16].map(of).iter().all(|found| *found == expected));
    }

    #[test]
    fn the_memory_of_deep_recursion_limits_the_threads() {
        let most = |integrator, depth| {
            let description = Description { integrator, ..spheres(1, 1) };
            let Ok(integrator) = Integrator::new(&description, &NoiseTables::default()) else { panic!() };
            integrator.most_threads(depth)
        };
        for integrator in [hray_core::Integrator::Classic2005, hray_core::Integrator::Classic] {
            assert!(most(integrator, 10) >= 64);
            assert!((1..=32).contains(&most(integrator, 10_000)));
        }
    }
}
