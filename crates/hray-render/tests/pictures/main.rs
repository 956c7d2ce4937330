//! What the engine shows, against what is known.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

mod common;
mod functions;
mod lights;
mod meshes;
mod reference;
mod scales;
mod shapes;
mod solids;
