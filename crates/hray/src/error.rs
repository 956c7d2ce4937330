//! What can go wrong between a scene file and its picture.

use crate::{InputError, OptionsError, OutputError, SceneFile, TablesError, UnknownFormat};
use std::fmt;

/// Why there is no picture.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The scene cannot be used.
    Load(LoadError),
    /// The noise tables cannot be used.
    Tables(TablesError),
    /// The options do not fit each other or the scene.
    Options(OptionsError),
    /// The name of the picture does not tell its format.
    Format(UnknownFormat),
    /// The picture cannot be written. The destination is as it was.
    Output(OutputError),
    /// The render was stopped by [`crate::Control::cancel`].
    Cancelled,
    /// The system refused to start the threads that render.
    Threads,
    /// The solids of the scene have more than [`crate::MAX_SOLID_PARTS`] parts together.
    Solids,
    /// The pixel is not explained.
    Explain(hray_render::ExplainError),
    /// There is not enough memory for the colours of the picture.
    Memory {
        /// Bytes that were asked for.
        bytes: u64,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Load(error) => error.fmt(f),
            Self::Tables(error) => error.fmt(f),
            Self::Options(error) => error.fmt(f),
            Self::Format(error) => error.fmt(f),
            Self::Output(error) => error.fmt(f),
            Self::Cancelled => f.write_str("the render was stopped"),
            Self::Threads => {
                f.write_str("the system refused to start the threads that render; ask for fewer of them")
            }
            Self::Solids => write!(
                f,
                "the solids of the scene (unions, intersections and differences) have more than {} parts \
                 together; a solid that is used twice counts twice",
                crate::MAX_SOLID_PARTS
            ),
            Self::Explain(error) => error.fmt(f),
            Self::Memory { bytes } => write!(
                f,
                "there is not enough memory for the colours of this picture ({} MiB); render it to a file, \
                 which takes little, or in regions",
                bytes >> 20
            ),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Load(error) => Some(error),
            Self::Tables(error) => Some(error),
            Self::Options(error) => Some(error),
            Self::Format(error) => Some(error),
            Self::Output(error) => Some(error),
            Self::Explain(error) => Some(error),
            Self::Cancelled | Self::Threads | Self::Solids | Self::Memory { .. } => None,
        }
    }
}

/// Why a scene cannot be used.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadError {
    /// It could not be read.
    Input(InputError),
    /// It has errors; the file knows them, and [`SceneFile::report`] shows them.
    Scene(Box<SceneFile>),
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => error.fmt(f),
            Self::Scene(file) => f.write_str(file.report(false).trim_end()),
        }
    }
}

impl std::error::Error for LoadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Input(error) => Some(error),
            Self::Scene(_) => None,
        }
    }
}

macro_rules! from {
    ($($source:ty => $variant:ident),* $(,)?) => {
        $(impl From<$source> for Error {
            fn from(error: $source) -> Self {
                Self::$variant(error)
            }
        })*
    };
}

from! {
    LoadError => Load,
    TablesError => Tables,
    OptionsError => Options,
    UnknownFormat => Format,
    OutputError => Output,
}

impl From<InputError> for Error {
    fn from(error: InputError) -> Self {
        Self::Load(LoadError::Input(error))
    }
}
