//! The properties of the model: those that §2.3.3 proves or works out, and those that it takes for granted.
//!
//! One module per concept. A name states the property; where a number comes from, a comment says so.

#![allow(clippy::unwrap_used, reason = "the helpers of a test may fail as loudly as the test")]

mod common;
mod directions;
mod image;
mod intersection;
mod maths;
mod noise;
mod output;
mod patterns;
mod quadratic;
mod recursion;
mod shading;
