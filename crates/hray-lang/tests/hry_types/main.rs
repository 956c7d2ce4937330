//! Names and types of hry programs: what is inferred, what is refused, and in which words.

mod common;
mod errors;
mod limits;
mod places;
mod soundness;
mod types;
mod warnings;
