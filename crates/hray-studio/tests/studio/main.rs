//! The studio as a page meets it: over real sockets.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests may fail loudly")]

mod disk;
mod files;
mod guard;
mod page;
mod pictures;
mod sturdy;
