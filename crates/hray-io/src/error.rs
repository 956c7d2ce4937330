//! What can go wrong with a file, in words for whoever typed its name.

use crate::animation::describe_rate;
use crate::{AnimationFormat, PictureFormat, Quoted};
use std::fmt;
use std::io;
use std::path::PathBuf;

/// Why something could not be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum InputError {
    /// There is no such file.
    Missing {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The path leads to a directory.
    Directory {
        /// The path as it was given.
        path: PathBuf,
    },
    /// A folder is wanted, and the path leads to something else.
    NoDirectory {
        /// The path as it was given.
        path: PathBuf,
    },
    /// A scene does not lie in the folder that it may read from.
    OutsideRoot {
        /// The scene's path as it was given.
        path: PathBuf,
        /// The folder.
        root: PathBuf,
    },
    /// It is no image that can be read.
    Image {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// It is no file of meshes that can be read.
    Model {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong with it, and where: a line, a byte or a place in a document.
        reason: String,
    },
    /// There is more to read than is accepted.
    TooLarge {
        /// The path as it was given; `-` is the standard input.
        path: PathBuf,
        /// The most bytes that are accepted.
        limit: u64,
    },
    /// The system refused.
    Io {
        /// The path as it was given; `-` is the standard input.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

impl InputError {
    /// What an error of the system means for reading `path`.
    pub(crate) fn from_io(path: PathBuf, source: io::Error) -> Self {
        match source.kind() {
            io::ErrorKind::NotFound => Self::Missing { path },
            io::ErrorKind::IsADirectory => Self::Directory { path },
            _ => Self::Io { path, source },
        }
    }

    /// What is wrong, without the path, in words that follow "cannot be read: ".
    #[must_use]
    pub fn reason(&self) -> String {
        match self {
            Self::Missing { .. } => "there is no such file".to_owned(),
            Self::Directory { .. } => "it is a directory".to_owned(),
            Self::NoDirectory { .. } => "it is no directory".to_owned(),
            Self::OutsideRoot { .. } => "it does not lie in the root folder".to_owned(),
            Self::Image { reason, .. } | Self::Model { reason, .. } => reason.clone(),
            Self::TooLarge { limit, .. } => {
                format!("it is longer than {}, the most that is read", Bytes(*limit))
            }
            Self::Io { source, .. } => format!("{}{}", Cause(source), advice(source)),
        }
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing { path } if path.as_os_str().is_empty() => {
                f.write_str("cannot read a file without a name; give the name of a file")
            }
            Self::Missing { path } => {
                write!(
                    f,
                    "cannot read {}: there is no such file; check the spelling",
                    Named(path, "the standard input")
                )
            }
            Self::Directory { path } => {
                write!(
                    f,
                    "cannot read {}: it is a directory; give the name of a file in it",
                    Named(path, "the standard input")
                )
            }
            Self::NoDirectory { path } => {
                write!(f, "{} is no directory; give the name of one", Named(path, "the standard input"))
            }
            Self::OutsideRoot { path, root } => write!(
                f,
                "the scene {} does not lie in the root folder {}; the root is the scene's own folder or one further up",
                Quoted(path),
                Quoted(root)
            ),
            Self::Image { path, reason } | Self::Model { path, reason } => {
                write!(f, "cannot read {}: {reason}", Named(path, "the standard input"))
            }
            Self::TooLarge { path, limit } => write!(
                f,
                "cannot read {}: it is longer than {}, the most that is read; is it the right file?",
                Named(path, "the standard input"),
                Bytes(*limit)
            ),
            Self::Io { path, source } => {
                write!(
                    f,
                    "cannot read {}: {}{}",
                    Named(path, "the standard input"),
                    Cause(source),
                    advice(source)
                )
            }
        }
    }
}

impl std::error::Error for InputError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}

/// Why a picture could not be written. Where the destination was a file, it is as it was before.
#[derive(Debug)]
#[non_exhaustive]
pub enum OutputError {
    /// The path leads to a directory, or is written as one.
    Directory {
        /// The path as it was given.
        path: PathBuf,
    },
    /// The directory the file would be in does not exist, or is none.
    NoDirectory {
        /// The path as it was given.
        path: PathBuf,
        /// The directory that is missing.
        directory: PathBuf,
    },
    /// The system refused.
    Io {
        /// The path as it was given; `-` is the standard output.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The format cannot hold a picture of that size.
    Size {
        /// The format.
        format: PictureFormat,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The format cannot hold frames of that size.
    FrameSize {
        /// The format.
        format: AnimationFormat,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The most pixels in either direction.
        longest: u32,
    },
    /// The format cannot show so many frames a second.
    FrameRate {
        /// The format.
        format: AnimationFormat,
        /// Frames a second.
        fps: f64,
        /// The most it can show.
        fastest: f64,
    },
    /// There is not enough memory for a format that needs the whole picture at once.
    Memory {
        /// The format.
        format: PictureFormat,
        /// How much was asked for.
        bytes: u64,
    },
    /// The pixels that were given are not those of the picture that was announced.
    Length {
        /// Bytes that the picture has.
        expected: u64,
        /// Bytes that were given.
        given: u64,
    },
}

impl fmt::Display for OutputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Directory { path } => write!(
                f,
                "cannot write to {}: it is a directory; give the name of a file in it",
                Named(path, "the standard output")
            ),
            Self::NoDirectory { path, directory } => write!(
                f,
                "cannot write {}: there is no directory {}; create it first, or write elsewhere",
                Named(path, "the standard output"),
                Quoted(directory)
            ),
            Self::Io { path, source } => {
                write!(
                    f,
                    "cannot write {}: {}{}",
                    Named(path, "the standard output"),
                    Cause(source),
                    advice(source)
                )
            }
            Self::Size { format, width, height } => write!(
                f,
                "a picture of {width} by {height} pixels is too large for the format {format}; \
                 png and ppm hold larger ones"
            ),
            Self::FrameSize { format, width, height, longest } => write!(
                f,
                "frames of {width} by {height} pixels do not fit the format {format}; a side has 1 to {longest}"
            ),
            Self::FrameRate { format, fps, fastest } => describe_rate(f, *format, *fps, *fastest),
            Self::Memory { format, bytes } => write!(
                f,
                "the format {format} needs {} of memory for this picture, and there is less; \
                 png and ppm are written as they are rendered",
                Bytes(*bytes)
            ),
            Self::Length { expected, given } => {
                write!(f, "the picture has {expected} bytes of pixels, and {given} were given")
            }
        }
    }
}

impl std::error::Error for OutputError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}

/// A path in a message, and what `-` stands for there.
struct Named<'a>(&'a PathBuf, &'static str);

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.as_os_str() == "-" { f.write_str(self.1) } else { Quoted(self.0).fmt(f) }
    }
}

/// What the system said, without the number of the error.
struct Cause<'a>(&'a io::Error);

impl fmt::Display for Cause<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.0.to_string();
        let text = text.split(" (os error").next().unwrap_or(&text);
        let mut characters = text.chars();
        for c in characters.next().into_iter().flat_map(char::to_lowercase).chain(characters) {
            write!(f, "{c}")?;
        }
        Ok(())
    }
}

/// What to do about it, where that is known.
fn advice(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::PermissionDenied => "; check the permissions of the file and of its directory",
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "; free some space, or write elsewhere",
        io::ErrorKind::ReadOnlyFilesystem => "; write elsewhere",
        io::ErrorKind::NotADirectory => "; a part of the path is a file",
        io::ErrorKind::InvalidFilename => "; choose a shorter name",
        io::ErrorKind::BrokenPipe => "; the program that was reading it has ended",
        _ => "",
    }
}

/// A number of bytes, in the largest unit that it reaches.
struct Bytes(u64);

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            n if n < 1 << 10 => write!(f, "{n} bytes"),
            n if n < 1 << 20 => write!(f, "{} KiB", n >> 10),
            n if n < 1 << 30 => write!(f, "{} MiB", n >> 20),
            n => write!(f, "{:.1} GiB", n as f64 / (1u64 << 30) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_say_what_where_and_what_to_do() {
        let denied = io::Error::from_raw_os_error(13);
        let error = OutputError::Io { path: "a.png".into(), source: denied };
        assert_eq!(
            error.to_string(),
            "cannot write `a.png`: permission denied; check the permissions of the file and of its directory"
        );
        let error = InputError::TooLarge { path: "-".into(), limit: 256 << 20 };
        assert_eq!(
            error.to_string(),
            "cannot read the standard input: it is longer than 256 MiB, the most that is read; \
             is it the right file?"
        );
    }

    #[test]
    fn sizes_are_readable() {
        let text = |n| Bytes(n).to_string();
        assert_eq!([text(1000), text(1 << 20), text(3 << 29)], ["1000 bytes", "1 MiB", "1.5 GiB"]);
    }
}
