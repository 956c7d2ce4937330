//! Functions of a scene as expression graphs, evaluated many points at a time.

mod function;
mod graph;
mod image;
pub mod kernels;
mod noise_tables;

pub use function::Function;
pub use graph::{Binary, Block, Input, Loop, Node, NodeId, NoiseKind, Unary};
pub use image::Image;
pub use noise_tables::{NoiseTables, NoiseTablesError};
