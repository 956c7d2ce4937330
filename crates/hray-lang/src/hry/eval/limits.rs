//! How much an evaluation may take.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Budgets of an evaluation. Whatever a scene says, it ends within them: with a picture or with an error that says which
/// was used up, and where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Steps: calls of functions, elements of lists, branches.
    pub steps: u64,
    /// Calls inside calls.
    pub depth: u32,
    /// Elements of one list.
    pub list: usize,
    /// Bytes of lists and texts alive at one time, about.
    pub memory: u64,
    /// Nodes of one compiled function.
    pub nodes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { steps: 200_000_000, depth: 10_000, list: 10_000_000, memory: 4 << 30, nodes: 1_000_000 }
    }
}

/// Bytes in use.
#[derive(Clone, Debug, Default)]
pub(super) struct Meter(Arc<AtomicU64>);

impl Meter {
    /// Counts `bytes` as used until the charge is dropped.
    pub(super) fn charge(&self, bytes: u64) -> Charge {
        self.0.fetch_add(bytes, Ordering::Relaxed);
        Charge { meter: self.clone(), bytes }
    }

    pub(super) fn used(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

/// Bytes that are in use while this lives.
#[derive(Debug)]
pub(super) struct Charge {
    meter: Meter,
    bytes: u64,
}

impl Drop for Charge {
    fn drop(&mut self) {
        self.meter.0.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}
