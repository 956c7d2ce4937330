//! Text files, whole or not at all.

use crate::{Destination, OutputError};
use std::io::Write;

/// Writes a text to its place. A file appears when it is complete; an older one of that name is untouched until then.
///
/// # Errors
/// [`OutputError::Io`] where the system refuses. Then the destination is as it was.
pub fn write_text(destination: &Destination, text: &str) -> Result<(), OutputError> {
    let io = |source| OutputError::Io { path: destination.name().to_owned(), source };
    let mut output = destination.open().map_err(io)?;
    // A failed write is remembered, and its cause told when the output is finished.
    let _ = output.write_all(text.as_bytes());
    output.finish().map_err(io)
}
