//! From a checked program to a scene.
//!
//! Evaluation is strict and walks code in which every name is a place. Values carry their kinds, so that one evaluator
//! serves known numbers and numbers that depend on a hit: a function of a hit is called once, with a hit whose parts are
//! inputs of a graph, and every operation on what depends on them becomes a node. So textures are compiled by the same
//! evaluator that works out the rest of the scene.
//!
//! Evaluation always ends: with a scene, or with an error that says which of the [`Limits`] was used up, and where.

mod calls;
mod code;
mod color;
mod compile;
mod construct;
mod failure;
mod implicit;
mod limits;
mod lints;
mod lists;
mod machine;
mod mesh;
mod natives;
mod order;
mod origins;
mod patterns;
mod place;
mod scalar;
mod scene;
mod texture;
mod value;

pub use limits::Limits;
pub use origins::{Origin, Origins};
pub use scene::{Evaluated, Evaluator, evaluate};
