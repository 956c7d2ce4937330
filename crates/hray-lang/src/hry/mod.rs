//! The hry language: a scene as a pure function.

pub mod assets;
pub mod ast;
mod convert;
pub mod eval;
pub mod format;
pub mod ide;
pub mod library;
pub mod program;
pub mod reference;
mod sources;
pub mod syntax;
pub mod types;

pub use convert::convert;
pub use program::Program;
pub use sources::{STANDARD_BASE, SourceFile, Sources};
