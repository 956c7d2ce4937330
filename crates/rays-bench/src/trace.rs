//! Asking a tracer for many rays on several threads.

use crate::rays::Ray;
use cpu_time::ThreadTime;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Rays that a thread takes at once.
const CHUNK: usize = 4096;
/// Rays whose answers are kept before they are added up.
const BLOCK: usize = 256;

/// What a ray hits first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Where along the ray, as a multiple of its direction's length.
    pub t: f32,
    /// Which triangle of the mesh.
    pub triangle: u32,
}

impl Hit {
    /// Nothing.
    pub const MISS: Self = Self { t: f32::INFINITY, triangle: u32::MAX };

    /// Whether it is anything.
    #[must_use]
    pub fn is_hit(&self) -> bool {
        self.triangle != u32::MAX
    }
}

/// Something that answers single rays against one mesh.
pub trait Tracer: Sync {
    /// Puts the thread into another state for as long as it is alive.
    type State;

    /// What the thread needs while it asks; between [`Tracer::enter`] and the end of the state nobody does
    /// arithmetic with floats but the tracer.
    fn enter(&self) -> Self::State;

    /// The nearest hit between the ray's ends.
    fn intersect(&self, ray: &Ray) -> Hit;

    /// Whether there is any hit between the ray's ends.
    fn occluded(&self, ray: &Ray) -> bool;

    /// The nearest hits of rays, one by one.
    fn intersect_each(&self, rays: &[Ray], answers: &mut [Hit]) {
        for (answer, ray) in answers.iter_mut().zip(rays) {
            *answer = self.intersect(ray);
        }
    }

    /// How many rays hit anything, one by one.
    fn occluded_count(&self, rays: &[Ray]) -> u64 {
        rays.iter().map(|ray| u64::from(self.occluded(ray))).sum()
    }
}

/// What came of many rays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tally {
    /// Rays that hit anything.
    pub hits: u64,
    /// The sum of [`Hit::t`] over them, in an order that does not depend on threads; 0 if any hit would do.
    pub sum: f64,
}

/// Many rays for one tracer: the loop over them is compiled for each tracer, so that a ray costs no call through
/// a table.
pub trait Trace: Sync {
    /// Traces all rays on `threads` threads, the caller's included; adds up what they hit, and how long the threads
    /// were on a processor.
    fn tally(&self, rays: &[Ray], any_hit: bool, threads: usize) -> (Tally, Duration);

    /// What each ray hits.
    fn hits(&self, rays: &[Ray]) -> Vec<Hit>;
}

impl<T: Tracer> Trace for T {
    fn tally(&self, rays: &[Ray], any_hit: bool, threads: usize) -> (Tally, Duration) {
        let next = AtomicUsize::new(0);
        let work = || {
            let clock = ThreadTime::now();
            let mut done = Vec::new();
            loop {
                let start = next.fetch_add(CHUNK, Ordering::Relaxed);
                let Some(rest) = rays.get(start..).filter(|rest| !rest.is_empty()) else {
                    return (done, clock.elapsed());
                };
                let chunk = &rest[..rest.len().min(CHUNK)];
                done.push((start, if any_hit { any(self, chunk) } else { nearest(self, chunk) }));
            }
        };
        let (mut chunks, busy) = thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
            let (mut chunks, mut busy) = work();
            for other in others {
                let (more, also) = other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
                chunks.extend(more);
                busy += also;
            }
            (chunks, busy)
        });
        chunks.sort_unstable_by_key(|(start, _)| *start);
        let add = |a: Tally, b: Tally| Tally { hits: a.hits + b.hits, sum: a.sum + b.sum };
        (chunks.into_iter().map(|(_, tally)| tally).fold(Tally::default(), add), busy)
    }

    fn hits(&self, rays: &[Ray]) -> Vec<Hit> {
        let _state = self.enter();
        rays.iter().map(|ray| self.intersect(ray)).collect()
    }
}

fn nearest<T: Tracer>(tracer: &T, rays: &[Ray]) -> Tally {
    let mut tally = Tally::default();
    let mut answers = [Hit::MISS; BLOCK];
    for rays in rays.chunks(BLOCK) {
        let answers = &mut answers[..rays.len()];
        let state = tracer.enter();
        tracer.intersect_each(rays, answers);
        drop(state);
        for hit in answers.iter().filter(|hit| hit.is_hit()) {
            tally.hits += 1;
            tally.sum += f64::from(hit.t);
        }
    }
    tally
}

fn any<T: Tracer>(tracer: &T, rays: &[Ray]) -> Tally {
    let _state = tracer.enter();
    Tally { hits: tracer.occluded_count(rays), sum: 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hits what starts at an x that is no multiple of 3, as far away as x.
    struct Thirds;

    impl Tracer for Thirds {
        type State = ();

        fn enter(&self) {}

        fn intersect(&self, ray: &Ray) -> Hit {
            let t = ray.origin[0];
            if t % 3.0 == 0.0 { Hit::MISS } else { Hit { t, triangle: 7 } }
        }

        fn occluded(&self, ray: &Ray) -> bool {
            self.intersect(ray).is_hit()
        }
    }

    #[test]
    fn threads_change_nothing() {
        let ray = |i: u16| Ray {
            origin: [f32::from(i) / 7.0, 0.0, 0.0],
            tnear: 0.0,
            direction: [1.0, 0.0, 0.0],
            tfar: f32::INFINITY,
        };
        let rays: Vec<Ray> = (0..50_000).map(ray).collect();
        let expected = Thirds.tally(&rays, false, 1).0;
        let hits = Thirds.hits(&rays);
        assert_eq!(expected.hits, hits.iter().filter(|hit| hit.is_hit()).count() as u64);
        for threads in 2..5 {
            assert_eq!(Thirds.tally(&rays, false, threads).0, expected);
            assert_eq!(Thirds.tally(&rays, true, threads).0, Tally { sum: 0.0, ..expected });
        }
        assert_eq!(Thirds.tally(&[], false, 2).0, Tally::default());
    }
}
