//! The scene language of hray.
pub mod decode;
pub mod diagnostic;
pub mod classic;
