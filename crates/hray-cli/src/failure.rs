//! How a command ends that does not end well.

use crate::args::Cli;
use crate::console::Console;
use clap::CommandFactory;
use hray::{Error, ExplainError, LoadError};
use std::io;
use std::process::ExitCode;

/// Why the command did not do what it was asked.
#[derive(Debug)]
pub(crate) enum Failure {
    /// What clap has to say: a wrong command line, or the help that was asked for.
    CommandLine(clap::Error),
    /// A wrong command line, in our own words.
    Usage(String),
    /// Something is wrong with the input, or could not be read or written.
    Wrong(String),
    /// The same, and it has been said already.
    Told,
    /// Ctrl-C.
    Interrupted(String),
}

impl Failure {
    /// Says what happened; the exit code.
    pub(crate) fn tell(self, console: &Console) -> ExitCode {
        match self {
            Self::CommandLine(error) => {
                // It knows which stream it belongs to; where that is gone, nobody is there to tell.
                let _ = error.print();
                ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
            }
            Self::Usage(message) => {
                console.error(message);
                ExitCode::from(2)
            }
            Self::Wrong(message) => {
                console.error(message);
                ExitCode::from(1)
            }
            Self::Told => ExitCode::from(1),
            Self::Interrupted(message) => {
                console.error(message);
                ExitCode::from(130)
            }
        }
    }

    /// A wrong command line, shown with how to use the command.
    pub(crate) fn usage(message: impl std::fmt::Display) -> Self {
        Self::CommandLine(Cli::command().error(clap::error::ErrorKind::ValueValidation, message))
    }

    /// Standard output cannot be written to.
    pub(crate) fn stdout(error: &io::Error) -> Self {
        Self::Wrong(format!("cannot write to the standard output: {error}"))
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        match error {
            Error::Options(_) | Error::Format(_) | Error::Explain(ExplainError::Outside { .. }) => {
                Self::Usage(error.to_string())
            }
            // Its diagnostics were shown when it was read.
            Error::Load(LoadError::Scene(_)) => Self::Told,
            Error::Cancelled => Self::Interrupted("interrupted".to_owned()),
            _ => Self::Wrong(error.to_string()),
        }
    }
}
