//! Functions of a scene as expression graphs, evaluated many points at a time.

mod apply;
mod builder;
mod derivative;
mod function;
mod graph;
mod image;
pub mod kernels;
mod noise;
mod noise_tables;
mod plan;

pub use apply::random;
pub use builder::{Builder, DerivativeError, GraphTooLarge};
pub use function::Function;
pub use graph::{Binary, Block, Input, Loop, Node, NodeId, NoiseKind, Unary};
pub use image::Image;
pub use noise::{cells, classic_noise, improved_noise};
pub use noise_tables::{NoiseTables, NoiseTablesError};
pub use plan::{Plan, PlanScratch};
