//! Evaluation: what a scene's text comes to.

mod common;
mod corpus;
mod errors;
mod library;
mod limits;
mod scenes;
mod textures;
mod values;
