//! Everything that touches a file: scenes, images, meshes and noise tables in, pictures and animations out.
//!
//! Reading is bounded: [`read_source`], [`read_image`], [`read_model`] and
//! [`read_noise_tables`] stop at a stated size whatever the file,
//! the pipe or the device behind it goes on to deliver. A [`Folder`] gives files inside of it and no others.
//!
//! Writing is split so that it can keep up with a parallel renderer. [`PictureFormat::encode`] is a pure
//! function from a run of pixels to bytes and is called on the threads that rendered them; a
//! [`PictureWriter`] takes the encoded runs in order on one thread and streams them out. The formats, and what
//! each keeps of a colour:
//!
//! | format | extensions | of a component | memory, in bytes a pixel |
//! |---|---|---|---|
//! | P3 (`ppm-ascii`) | by request | round(255 c), unbounded, as in 2005 | streamed |
//! | P6 (`ppm`) | `ppm`, `pnm` | 8 bits | streamed |
//! | PNG | `png` | 8 bits | streamed |
//! | BMP | `bmp` | 8 bits | 3 |
//! | TIFF | `tif`, `tiff` | 8 bits | 3 |
//! | TGA | `tga` | 8 bits | 6 |
//! | QOI | `qoi` | 8 bits | 3, and the file |
//! | JPEG | `jpg`, `jpeg` | 8 bits, lossy (quality 95) | 3 |
//! | WebP | `webp` | 8 bits, lossless | 7, and the file |
//! | farbfeld | `ff` | 16 bits | 8 |
//! | OpenEXR | `exr` | f32, unclipped | 12 |
//!
//! A component is what the renderer left, or, where the scene asks for sRGB, what the transfer function of
//! IEC 61966-2-1 makes of it ([`hray_core::Encoding`]); OpenEXR always holds linear light.
//!
//! Invariant: a file appears whole or not at all. It is written under a temporary name beside its place and
//! renamed when the last byte is in; until then an older file of that name is untouched, and a
//! [`PictureWriter`] that is dropped takes its temporary file with it. (A crash of the whole machine is not
//! guarded against: nothing waits for the disk.)

mod animation;
mod destination;
mod error;
mod folder;
mod format;
mod meshes;
mod noise_tables;
mod output;
mod picture_writer;
mod quoted;
mod read_image;
mod same_file;
mod source;
mod text;

pub use animation::{AnimationFormat, AnimationWriter, MAX_FPS, MIN_FPS};
pub use destination::{Destination, create_folder};
pub use error::{InputError, OutputError};
pub use folder::{FileStamp, Folder, FolderError};
pub use format::{PictureFormat, UnknownFormat};
pub use meshes::{Companions, MAX_MODEL_BYTES, decode_model, model_format, read_model};
pub use noise_tables::{MAX_NOISE_TABLES_BYTES, TablesError, parse_noise_tables, read_noise_tables};
pub use picture_writer::PictureWriter;
pub use quoted::Quoted;
pub use read_image::{MAX_IMAGE_BYTES, MAX_IMAGE_PIXELS, decode_image, read_image};
pub use same_file::same_file;
pub use source::{Input, MAX_SOURCE_BYTES, read_source, read_source_from};
pub use text::write_text;
