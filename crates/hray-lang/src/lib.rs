//! The scene languages of hray: from the bytes of a scene file to a description, or to diagnostics that say
//! what is wrong with it.
//!
//! - [`decode`]: bytes to text, or one error.
//! - [`Language`]: which language a text is in.
//! - [`classic`]: the grammar of 2005, text to a [`Description`](hray_core::Description) or errors; and back.
//! - [`hry`]: the language in which scenes are functions.
//! - [`lint`]: warnings about a description that is legal but surely meant otherwise.
//! - [`diagnostic`]: errors and warnings as plain data, and their rendering as text.
//!
//! ```
//! use hray_lang::{classic, decode::decode, diagnostic::render, lint};
//!
//! let bytes = b"renderDescr ( resolution (400,300) ) 3 [ scene { camera (0,0.0,150.0) (100,75) } ";
//! let decoded = decode(bytes);
//! let parsed = classic::parse(&decoded.text);
//! let mut diagnostics = parsed.diagnostics;
//! diagnostics.extend(decoded.error);
//! if let Some(description) = &parsed.description {
//!     let levels = lint::LintLevels::default();
//!     diagnostics.extend(lint::check(&decoded.text, description, &parsed.spans, &levels));
//! }
//! let text = render(&diagnostics, "scene.hry", &decoded.text, false);
//! assert!(text.contains("scene.hry:1:58"));
//! ```
//!
//! Nothing here touches a file, and nothing that a text contains makes it panic, recurse or take more than
//! linear time.

pub mod classic;
pub mod decode;
pub mod diagnostic;
pub mod hry;
mod language;
pub mod lint;

pub use language::Language;
