//! Reading the text of a scene, within bounds.

use crate::InputError;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The longest scene that is read: 256 MiB.
pub const MAX_SOURCE_BYTES: u64 = 256 << 20;

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// The standard input.
    Stdin,
    /// A file.
    File(PathBuf),
}

impl Input {
    /// `-` is the standard input, everything else a file.
    #[must_use]
    pub fn from_argument(argument: PathBuf) -> Self {
        if argument.as_os_str() == "-" { Self::Stdin } else { Self::File(argument) }
    }

    /// What to call it in messages.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Stdin => "<standard input>".to_owned(),
            Self::File(path) => path.to_string_lossy().into_owned(),
        }
    }

    /// The path that leads to it, as far as the system has one: for asking whether it is the same file as
    /// another.
    #[must_use]
    pub fn path(&self) -> &Path {
        match self {
            Self::Stdin => Path::new("/dev/stdin"),
            Self::File(path) => path,
        }
    }
}

/// Reads all of a scene, [`MAX_SOURCE_BYTES`] at most.
///
/// # Errors
/// [`InputError`] where it is missing, a directory, longer than that (a pipe or a device that never ends is),
/// or the system refuses.
pub fn read_source(input: &Input) -> Result<Vec<u8>, InputError> {
    match input {
        Input::Stdin => read_source_from(io::stdin().lock(), Path::new("-")),
        Input::File(path) => read_source_from(open(path, MAX_SOURCE_BYTES)?, path),
    }
}

/// Reads all of a scene from any reader, which is called `name` in messages (`-` for the standard input).
///
/// # Errors
/// As [`read_source`].
pub fn read_source_from(reader: impl Read, name: &Path) -> Result<Vec<u8>, InputError> {
    read_bounded(reader, name, MAX_SOURCE_BYTES)
}

/// Opens a file for reading unless it is clear already that it will not do.
pub(crate) fn open(path: &Path, limit: u64) -> Result<File, InputError> {
    let failed = |source| InputError::from_io(path.to_owned(), source);
    // Asked before opening, which waits for a writer where the file is a named pipe.
    let metadata = fs::metadata(path).map_err(failed)?;
    if metadata.is_dir() {
        return Err(InputError::Directory { path: path.to_owned() });
    }
    if metadata.is_file() && metadata.len() > limit {
        return Err(InputError::TooLarge { path: path.to_owned(), limit });
    }
    File::open(path).map_err(failed)
}

/// Reads to the end, or to where there is too much.
pub(crate) fn read_bounded(reader: impl Read, name: &Path, limit: u64) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    match reader.take(limit + 1).read_to_end(&mut bytes) {
        Err(source) => Err(InputError::from_io(name.to_owned(), source)),
        Ok(_) if bytes.len() as u64 > limit => Err(InputError::TooLarge { path: name.to_owned(), limit }),
        Ok(_) => Ok(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reading_stops_at_the_limit() {
        let name = Path::new("x");
        assert_eq!(read_bounded(&b"12345"[..], name, 5).unwrap(), b"12345");
        assert!(matches!(read_bounded(&b"123456"[..], name, 5), Err(InputError::TooLarge { limit: 5, .. })));
        assert!(matches!(read_bounded(io::repeat(b'('), name, 70_000), Err(InputError::TooLarge { .. })));
    }

    #[test]
    fn a_directory_a_missing_file_and_a_large_one_are_told_apart() {
        let directory = tempfile::tempdir().unwrap();
        let large = directory.path().join("large.hry");
        File::create(&large).unwrap().set_len(MAX_SOURCE_BYTES + 1).unwrap();
        let read = |path: &Path| read_source(&Input::File(path.to_owned()));
        assert!(matches!(read(directory.path()), Err(InputError::Directory { .. })));
        assert!(matches!(read(&directory.path().join("none")), Err(InputError::Missing { .. })));
        assert!(matches!(read(&large), Err(InputError::TooLarge { .. })));
        assert!(matches!(read(&large.join("below")), Err(InputError::Io { .. })));
    }
}
