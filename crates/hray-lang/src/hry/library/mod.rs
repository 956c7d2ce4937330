//! What the language knows without being told: constructors, native functions, and the standard library written in
//! hry itself.
//!
//! These tables are the one place where each is described. Type inference, evaluation, completion, hover and the
//! reference all read them, so that none can drift.

mod constructors;
mod fields;
mod natives;
mod standard;

pub use constructors::{CONSTRUCTORS, Constructor, Makes};
pub use fields::{FieldSpec, FieldType, Range};
pub use natives::{NATIVES, Native, NativeSpec};
pub use standard::{STANDARD, StandardModule};

/// The constructor of that name.
#[must_use]
pub fn constructor(name: &str) -> Option<&'static Constructor> {
    CONSTRUCTORS.iter().find(|constructor| constructor.name == name)
}

/// The native function or value of that name.
#[must_use]
pub fn native(name: &str) -> Option<&'static NativeSpec> {
    NATIVES.iter().find(|native| native.name == name)
}
