//! Evaluation: what a scene's text comes to.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

mod coincident;
mod common;
mod corpus;
mod errors;
mod implicit;
mod library;
mod limits;
mod meshes;
mod origins;
mod scenes;
mod textures;
mod values;
