//! The threads that evaluate and render.

use super::film::{Film, hash_of};
use super::{Outgoing, Sink};
use crate::frame::{Frame, Pixels, Tile};
use crate::protocol::{Event, Refusal, answer, pixels_message};
use crate::scene::Work;
use hray::{Control, MeshTrees, Picture, Resolution, Tracer};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How long a picture has before the next edit stops it: so that something is seen while a number is dragged.
const GRACE: Duration = Duration::from_millis(70);
/// How often it is told how far a picture is.
const PROGRESS: Duration = Duration::from_millis(100);
/// How many files and explanations are made at the same time.
const MOST_ASIDES: usize = 4;

/// Something to evaluate, and perhaps to render.
pub(super) struct Job {
    pub(super) work: Work,
    /// Instead of the scene's.
    pub(super) size: Result<Option<Resolution>, Refusal>,
    pub(super) render: bool,
}

/// What is to be done, and what is being done.
#[derive(Default)]
pub(super) struct Desk {
    state: Mutex<State>,
    changed: Condvar,
    /// How many files and explanations are being made.
    asides: AtomicUsize,
}

#[derive(Default)]
struct State {
    /// What is to be shown next.
    next: Option<Job>,
    /// What is to be checked next, and not shown: the newest of each document.
    checks: Vec<Job>,
    running: Option<Running>,
    closed: bool,
    /// What these stop by.
    controls: Vec<(u64, Arc<Control>)>,
}

/// A job that is being worked on.
#[derive(Clone)]
struct Running {
    since: Instant,
    /// Whether it is one that is shown.
    shown: bool,
    stop: Arc<AtomicBool>,
    control: Arc<Control>,
}

impl Running {
    fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
        self.control.cancel();
    }
}

impl Desk {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What is shown is this from now on.
    pub(super) fn post(&self, job: Job) {
        self.lock().next = Some(job);
        self.changed.notify_all();
    }

    /// This is to be checked when there is nothing to show.
    pub(super) fn post_check(&self, job: Job) {
        let mut state = self.lock();
        state.checks.retain(|waiting| waiting.work.doc != job.work.doc);
        state.checks.push(job);
        self.changed.notify_all();
    }

    /// Nothing more of what is shown.
    pub(super) fn stop(&self) {
        let mut state = self.lock();
        state.next = None;
        if let Some(running) = &state.running {
            running.stop();
        }
    }

    /// Ends the threads.
    pub(super) fn close(&self) {
        let mut state = self.lock();
        state.closed = true;
        if let Some(running) = &state.running {
            running.stop();
        }
        state.controls.iter().for_each(|(_, control)| control.cancel());
        self.changed.notify_all();
    }

    /// Waits for something to do.
    fn take(&self) -> Option<(Job, Running)> {
        let mut state = self.lock();
        state.running = None;
        loop {
            if state.closed {
                return None;
            }
            let next = state.next.take();
            let next = next.or_else(|| (!state.checks.is_empty()).then(|| state.checks.remove(0)));
            if let Some(job) = next {
                let running = Running {
                    since: Instant::now(),
                    shown: job.render,
                    stop: Arc::default(),
                    control: Arc::new(Control::new()),
                };
                state.running = Some(running.clone());
                return Some((job, running));
            }
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Stops what is being done when there is something newer, and it had its time.
    pub(super) fn watch(&self) {
        let mut state = self.lock();
        while !state.closed {
            let superseded = state.next.is_some() || (!state.checks.is_empty() && !state.running_is_shown());
            let left = state.running.as_ref().filter(|_| superseded).and_then(|running| {
                let left = GRACE.checked_sub(running.since.elapsed()).filter(|left| !left.is_zero());
                if left.is_none() {
                    running.stop();
                }
                left
            });
            state = match left {
                Some(left) => {
                    self.changed.wait_timeout(state, left).unwrap_or_else(PoisonError::into_inner).0
                }
                None => self.changed.wait(state).unwrap_or_else(PoisonError::into_inner),
            };
        }
    }
}

impl State {
    fn running_is_shown(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.shown)
    }
}

/// Evaluates and renders until the desk is closed.
pub(super) fn work(desk: &Desk, renderers: usize, send: &Sink) {
    let mut meshes = MeshTrees::default();
    let mut number = 0;
    while let Some((job, running)) = desk.take() {
        let done = catch_unwind(AssertUnwindSafe(|| {
            number += 1;
            Show { frame: number, renderers, send, running: &running }.job(&job, &mut meshes)
        }));
        if done.is_err() {
            meshes = MeshTrees::default();
            let message = "the engine made a mistake with this scene".to_owned();
            send(Outgoing::Text(Event::Failed { frame: number, doc: job.work.doc, message }.message()));
        }
    }
}

/// One job on its way to the page.
struct Show<'a> {
    frame: u32,
    renderers: usize,
    send: &'a Sink,
    running: &'a Running,
}

impl Show<'_> {
    fn tell(&self, event: &Event) {
        // Where the page is gone, the desk will be closed.
        if !(self.send)(Outgoing::Text(event.message())) {
            self.running.stop();
        }
    }

    fn job(&self, job: &Job, meshes: &mut MeshTrees) {
        let Some(evaluated) = job.work.evaluate(&self.running.stop) else { return };
        self.tell(&evaluated.problems);
        self.tell(&evaluated.scene);
        let (Some(description), true) = (&evaluated.description, job.render) else { return };
        let made = job.size.clone().and_then(|size| Frame::new(description, size, meshes));
        let frame = match made {
            Ok(frame) => frame,
            Err(refusal) => {
                let message = match refusal.help {
                    Some(help) => format!("{}; {help}", refusal.message),
                    None => refusal.message,
                };
                self.tell(&Event::Failed { frame: self.frame, doc: job.work.doc.clone(), message });
                return;
            }
        };
        self.tell(&frame.event(self.frame, &job.work));
        self.render(&frame);
    }

    fn render(&self, frame: &Frame) {
        let start = self.running.since;
        let all = frame.samples();
        let (done, rays) = (AtomicU64::new(0), AtomicU64::new(0));
        let film = Mutex::new(None);
        let last = frame.passes().len() - 1;
        for pass in 0..=last {
            if pass == last {
                *film.lock().unwrap_or_else(PoisonError::into_inner) = Film::new(frame);
            }
            let samples = frame.passes().get(pass).map_or(1, |pass| u64::from(pass.samples.get()));
            let put = |pixels: Pixels| {
                if pass == last
                    && let Some(film) = &mut *film.lock().unwrap_or_else(PoisonError::into_inner)
                {
                    film.put(&pixels);
                }
                done.fetch_add(pixels.colors.len() as u64 * samples, Ordering::Relaxed);
                (self.send)(Outgoing::Binary(pixels_message(self.frame, pixels.place, &pixels.rgba)))
            };
            let progress = || {
                let done = done.load(Ordering::Relaxed) as f64 / all.max(1) as f64;
                let seconds = start.elapsed().as_secs_f64();
                self.tell(&Event::Progress { frame: self.frame, pass, done, seconds });
            };
            self.pass(frame, pass, &rays, &put, &progress);
            if self.running.control.is_cancelled() {
                return;
            }
        }
        let film = film.into_inner().unwrap_or_else(PoisonError::into_inner);
        let seconds = start.elapsed().as_secs_f64();
        let picture: Option<Picture> = film.and_then(|film| film.develop(frame));
        let hash = picture.as_ref().map(hash_of);
        self.tell(&Event::Done { frame: self.frame, seconds, rays: rays.into_inner(), hash });
    }

    /// Deals the tiles of a pass out to threads.
    fn pass(
        &self,
        frame: &Frame,
        pass: usize,
        rays: &AtomicU64,
        put: &(dyn Fn(Pixels) -> bool + Sync),
        progress: &dyn Fn(),
    ) {
        let tiles: Vec<Tile> = frame.tiles(pass);
        let threads = self.renderers.min(frame.most_threads()).min(tiles.len()).max(1);
        let (next, finished) = (AtomicUsize::new(0), (Mutex::new(0), Condvar::new()));
        let control = &*self.running.control;
        thread::scope(|scope| {
            for _ in 0..threads {
                scope.spawn(|| {
                    let _guard = CountWhenDropped(&finished);
                    let mut tracer = Tracer::new();
                    while let Some(tile) = tiles.get(next.fetch_add(1, Ordering::Relaxed)) {
                        let Ok(pixels) = frame.render(tile, &mut tracer, control) else { break };
                        if !put(pixels) {
                            control.cancel();
                        }
                    }
                    rays.fetch_add(tracer.rays().total(), Ordering::Relaxed);
                });
            }
            let (count, changed) = &finished;
            let mut count = count.lock().unwrap_or_else(PoisonError::into_inner);
            while *count < threads {
                let waited = changed.wait_timeout(count, PROGRESS).unwrap_or_else(PoisonError::into_inner);
                count = waited.0;
                if waited.1.timed_out() {
                    drop(count);
                    progress();
                    count = finished.0.lock().unwrap_or_else(PoisonError::into_inner);
                }
            }
        });
    }
}

/// Counts a thread that ends, in whatever way.
struct CountWhenDropped<'a>(&'a (Mutex<usize>, Condvar));

impl Drop for CountWhenDropped<'_> {
    fn drop(&mut self) {
        *self.0.0.lock().unwrap_or_else(PoisonError::into_inner) += 1;
        self.0.1.notify_all();
    }
}

/// What is answered with: a value, and perhaps a binary message after it.
pub(super) type Made = Result<(Value, Option<Vec<u8>>), Refusal>;

/// Works on an answer on a thread of its own, until it is there or the page is closed.
pub(super) fn aside(
    id: u64,
    desk: Arc<Desk>,
    send: Sink,
    make: impl FnOnce(&Control) -> Made + Send + 'static,
) -> Result<(), Refusal> {
    if desk.asides.fetch_add(1, Ordering::Relaxed) >= MOST_ASIDES {
        desk.asides.fetch_sub(1, Ordering::Relaxed);
        let help = "wait until one of them is done";
        return Err(Refusal::new("other pictures are being made already").with_help(help));
    }
    let control = Arc::new(Control::new());
    desk.lock().controls.push((id, control.clone()));
    thread::spawn(move || {
        let made = catch_unwind(AssertUnwindSafe(|| make(&control)));
        let made = made.unwrap_or_else(|_| Err(Refusal::new("the engine made a mistake with this scene")));
        desk.lock().controls.retain(|(other, _)| *other != id);
        desk.asides.fetch_sub(1, Ordering::Relaxed);
        let (answered, binary) = match made {
            Ok((value, binary)) => (Ok(value), binary),
            Err(refusal) => (Err(refusal), None),
        };
        if send(Outgoing::Text(answer(id, &answered))) {
            binary.into_iter().for_each(|bytes| drop(send(Outgoing::Binary(bytes))));
        }
    });
    Ok(())
}
