//! Names and types: what every name means, what every expression is, and what is wrong with either, before
//! anything runs.
//!
//! Types are inferred (Hindley 1969, Milner 1978): no annotation is needed, and what is accepted does not go
//! wrong by its type. Three things go beyond the textbook. Variables can stand for a kind of types
//! (`numeric`, `vector`, ...). What is demanded of a type that is not known yet - arithmetic, a field, a
//! record for a constructor - waits until it is, and belongs to the type of the definition where it never is.
//! And a field that may vary takes a value or a function of a hit.

mod check;
mod checked;
mod graph;
mod infer;
mod kind;
mod lints;
mod names;
mod print;
mod report;
mod scheme;
mod store;
mod unknown;
mod unused;

pub use check::check;
pub use checked::{Checked, Completion, Target};
pub use lints::LINTS;
