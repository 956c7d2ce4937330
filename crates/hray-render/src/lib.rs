//! From a scene to the colours of its pixels.
//!
//! [`render`] is the one entry to whole pictures: a scene, noise tables and [`Settings`] in; runs of pixels out, in order,
//! each encoded by the caller on the thread that rendered it. [`Prepared`] is for who shows a picture while it comes into
//! being: parts of it in any order, coarse or fine. Nothing here touches a file. The value of a pixel
//! depends on the scene, the settings and the pixel's own coordinates; the number of threads, the order in
//! which runs are finished and the width of the machine's vectors change no bit of it.
//!
//! [`explain`] tells of a single pixel which rays and lights made its colour.
//!
//! The integrator is the thesis' (§2.3, appendix A.2). By [`hray_core::Integrator::Classic2005`] it is so in the
//! same order of operations as `hray-model`, which the `conformance` crate compares it with bit by bit. What differs
//! is only the arrangement: rays travel in batches, grouped by what they hit, and every step works on as many of
//! them as the machine has lanes. [`hray_core::Integrator::Classic`] has the same steps without absolute constants.

mod classic;
mod control;
mod explain;
mod prepared;
mod render;
mod sampler;
mod settings;
mod statistics;

pub use classic::{MAX_SOLID_PARTS, MeshTrees};
pub use control::Control;
pub use explain::{
    ExplainError, ExplainedHit, ExplainedRay, Followed, LightPart, MAX_EXPLAINED_RAYS, ObjectId,
    PixelExplanation, RayKind, Reach, Seen, explain,
};
pub use prepared::{Prepared, Tracer};
pub use render::{RenderError, render};
pub use settings::{MAX_SAMPLES, Region, RegionError, Settings};
pub use statistics::{RayCounts, Statistics};
