//! Functions of a scene as expression graphs, evaluated many points at a time.
//!
//! A [`Builder`] makes a graph, node by node, and [`Builder::finish`] makes a [`Function`] of it: plain data that a
//! scene can hold. [`Function::evaluate`] defines its results at one point; a [`Plan`] gives the same results, to
//! the last bit, at many points together.

mod apply;
mod builder;
mod cells;
mod derivative;
mod function;
mod graph;
mod image;
mod interval;
pub mod kernels;
mod noise;
mod noise_tables;
mod plan;

pub use apply::random;
pub use builder::{Builder, GraphTooLarge};
pub use cells::cells;
pub use derivative::DerivativeError;
pub use function::Function;
pub use graph::{Binary, Block, Input, Loop, Node, NodeId, NoiseKind, Unary};
pub use image::Image;
pub use interval::{Extent, LANES, Range, RangePlan, RangeScratch, Unknown};
pub use noise::{classic_noise, improved_noise};
pub use noise_tables::{NoiseTables, NoiseTablesError};
pub use plan::{Plan, PlanScratch};
