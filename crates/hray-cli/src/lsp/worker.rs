//! Scenes are evaluated on a thread of their own, after a pause in typing.

use super::Event;
use hray::ide::{Analysis, Remark};
use hray::{Limits, OpenTexts, WorkFolder};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

/// How long nothing changes before a scene is evaluated.
const PAUSE: Duration = Duration::from_millis(250);

/// How much an evaluation may take: a second or two at most, so that the next need not wait long.
const LIMITS: Limits =
    Limits { steps: 5_000_000, depth: 10_000, list: 1_000_000, memory: 512 << 20, nodes: 200_000 };

/// A scene to evaluate.
pub(crate) struct Job {
    pub(crate) uri: String,
    pub(crate) analysis: Arc<Analysis>,
    pub(crate) folder: Arc<WorkFolder>,
    pub(crate) open: Arc<OpenTexts>,
}

/// What came of it.
#[derive(Debug)]
pub(crate) struct Evaluated {
    pub(crate) uri: String,
    /// Of which text.
    pub(crate) analysis: Arc<Analysis>,
    pub(crate) remarks: Vec<Remark>,
}

/// Starts the thread. It ends when nobody can send to it any more.
pub(crate) fn start(events: Sender<Event>) -> Sender<Job> {
    let (jobs, queue) = channel();
    thread::spawn(move || work(&queue, &events));
    jobs
}

fn work(queue: &Receiver<Job>, events: &Sender<Event>) {
    let mut waiting: BTreeMap<String, Job> = BTreeMap::new();
    loop {
        let received = if waiting.is_empty() {
            queue.recv().map_err(|_| RecvTimeoutError::Disconnected)
        } else {
            queue.recv_timeout(PAUSE)
        };
        match received {
            // A newer text takes the place of an older one.
            Ok(job) => {
                waiting.insert(job.uri.clone(), job);
            }
            Err(RecvTimeoutError::Timeout) => {
                let Some((uri, job)) = waiting.pop_first() else { continue };
                let evaluate = || job.analysis.evaluated(&job.folder.with(&job.open), &LIMITS);
                let remarks = catch_unwind(AssertUnwindSafe(evaluate)).unwrap_or_default();
                let evaluated = Evaluated { uri, analysis: job.analysis, remarks };
                if events.send(Event::Evaluated(evaluated)).is_err() {
                    return;
                }
            }
            Err(RecvTimeoutError::Disconnected) => return,
        }
    }
}
