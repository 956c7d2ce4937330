//! Tests of the scene language from outside: what a user sees.

mod common;
mod corpus;
mod errors;
mod properties;
mod render;
mod size;
mod values;
mod warnings;
