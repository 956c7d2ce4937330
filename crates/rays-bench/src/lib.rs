//! How fast single rays are traced against large triangle meshes, beside Embree.
//!
//! [`meshes`] are the Stanford bunny, the same split into sixteen times as many triangles, and a terrain of four
//! million. [`rays`] generates what is traced against them, so exactly defined that another program can trace the
//! same ones. A [`trace::Tracer`] answers rays; [`ours`] builds those of this project,
//! [`embree`] those of the rival. [`measure`] times them in interleaved runs, and [`report`] prints what came out,
//! with the counts of hits beside those that are expected.

pub mod embree;
pub mod measure;
pub mod meshes;
pub mod ours;
pub mod rays;
pub mod report;
pub mod trace;

/// What went wrong, for the person who runs the benchmark.
pub type Result<T> = std::result::Result<T, String>;
