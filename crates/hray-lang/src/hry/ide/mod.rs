//! What an editor asks about a text: what is wrong, what a name is, what may be written here.
//!
//! Everything is a function of the texts alone, in offsets; nothing here knows a protocol or an editor. A language server
//! is a thin layer over it.
//!
//! - [`Analysis`]: a text with its imports, read and checked.
//! - [`Remark`]: what is wrong, ready to be shown in one file.
//! - [`Hover`], [`Suggestion`], [`Symbol`], [`ColorPlace`]: what is shown at a place.
//! - [`rename()`]: new names, refused where they would change what a text means.

mod analysis;
mod colors;
mod complete;
mod context;
mod describe;
mod hover;
mod navigate;
mod numbers;
mod outline;
mod remarks;
mod rename;
mod symbols;

pub use analysis::{Analysis, FileId, Place};
pub use colors::{ColorPlace, Presentation};
pub use complete::{Suggestion, SuggestionKind};
pub use hover::Hover;
pub use numbers::NumberPlace;
pub use outline::{OUTLINE, library_text};
pub use remarks::{Fix, Remark};
pub use rename::{Edit, Renaming, rename};
pub use symbols::{Symbol, SymbolKind};
