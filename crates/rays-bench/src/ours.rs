//! The tracers of this project: the one place to add one.

use crate::Result;
use crate::measure::{Clock, Contestant};
use crate::meshes::Mesh;

/// Builds each of our tracers over the mesh on `threads` threads, timed by `clock`.
///
/// There is none yet. One is added here by implementing [`Tracer`](crate::trace::Tracer) for it and handing out a
/// [`Contestant`] with [`Role::Ours`](crate::measure::Role::Ours), the seconds that building took ([`Clock::time`]) and the bytes that
/// it keeps; everything else follows.
///
/// # Errors
/// Where a tracer cannot be built.
pub fn build(_mesh: &Mesh, _threads: usize, _clock: Clock) -> Result<Vec<Contestant>> {
    Ok(Vec::new())
}
