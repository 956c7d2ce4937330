//! The hry language: a scene as a pure function.

pub mod ast;
