//! How a running render is watched and stopped.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Shared between a render and whoever waits for it: a way to stop it, and how far it is.
#[derive(Debug, Default)]
pub struct Control {
    cancelled: AtomicBool,
    pixels_done: AtomicU64,
}

impl Control {
    /// A control of a render not yet started.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the render to stop. It does so within a batch of rays, from any depth of recursion.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether [`Control::cancel`] was called.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }

    /// Pixels whose colour is known.
    #[must_use]
    pub fn pixels_done(&self) -> u64 {
        self.pixels_done.load(Ordering::Relaxed)
    }

    pub(crate) fn add_pixels(&self, count: u64) {
        self.pixels_done.fetch_add(count, Ordering::Relaxed);
    }
}
