//! An open folder and its open documents: what every interface of hray is a thin layer over.
//!
//! [`Session`] answers a page's requests, one after the other: it has no threads, no sockets and no clock, so that it runs in a
//! browser as well. [`Work::evaluate`] makes a scene of a document, [`Frame`] a picture of the scene, tile by tile. `Studio` puts
//! the two together where there are threads: it evaluates and renders beside the messages, and stops at once what is no
//! longer wanted.
//!
//! [`protocol`] has the messages.

mod examples;
mod explain;
mod files;
mod folder;
mod frame;
mod picture;
pub mod protocol;
mod scene;
mod session;
#[cfg(not(target_family = "wasm"))]
mod studio;
mod units;
mod uses;

pub use examples::{companions, examples};
pub use files::{Files, MOST_FILES, MOST_TEXT, MemoryFiles, hash, is_inside};
pub use folder::FolderFiles;
pub use frame::{Frame, MOST_PIXELS, Pass, Pixels, Tile};
pub use hray::{Control, Description, Limits, MeshTrees, Tracer};
pub use picture::PictureFile;
pub use scene::{Evaluated, Work};
pub use session::{About, MOST_DOCUMENTS, Session};
#[cfg(not(target_family = "wasm"))]
pub use studio::{Outgoing, Studio};
pub use units::Units;
pub use uses::{MOST_NEIGHBOURS, difference, users};
