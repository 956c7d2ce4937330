//! Bytes on their way to a file, a device or a pipe.

use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use tempfile::TempPath;

/// Bytes gathered before the system is called.
const BUFFER: usize = 1 << 17;
/// Bytes kept in memory where an encoder wants to go back and the output cannot; more go to a temporary file.
const SPOOLED: usize = 1 << 24;

/// Where the bytes go.
enum Sink {
    /// A temporary file, and the place it is moved to when all is written.
    Replacing(BufWriter<File>, TempPath, PathBuf),
    Stream(BufWriter<Box<dyn Write + Send>>),
}

/// A place for bytes that remembers whether one of them failed to arrive: the encoders of some crates write
/// their last bytes when they are dropped, where no error can be returned, and others make a text of it.
pub(crate) struct Output {
    sink: Sink,
    failed: bool,
    /// Why it failed, until [`SharedOutput::cause`] is asked.
    cause: Option<io::Error>,
}

impl Output {
    pub(crate) fn replacing(file: File, temporary: TempPath, target: PathBuf) -> Self {
        Self {
            sink: Sink::Replacing(BufWriter::with_capacity(BUFFER, file), temporary, target),
            failed: false,
            cause: None,
        }
    }

    pub(crate) fn stream(writer: Box<dyn Write + Send>) -> Self {
        let sink = Sink::Stream(BufWriter::with_capacity(BUFFER, writer));
        Self { sink, failed: false, cause: None }
    }

    fn attempt<T>(&mut self, action: impl FnOnce(&mut Sink) -> io::Result<T>) -> io::Result<T> {
        if self.failed {
            return Err(earlier());
        }
        action(&mut self.sink).map_err(|error| {
            let kind = error.kind();
            (self.failed, self.cause) = (true, Some(error));
            kind.into()
        })
    }

    /// Writes what is buffered and moves the file to its place; where an earlier write failed, why.
    pub(crate) fn finish(self) -> io::Result<()> {
        if self.failed {
            return Err(self.cause.unwrap_or_else(earlier));
        }
        match self.sink {
            Sink::Replacing(writer, temporary, target) => {
                drop(writer.into_inner().map_err(io::IntoInnerError::into_error)?);
                temporary.persist(target).map_err(|error| error.error)
            }
            Sink::Stream(mut writer) => writer.flush(),
        }
    }

    /// Forgets what is buffered.
    fn abandon(self) {
        if let Sink::Stream(writer) = self.sink {
            // Taken apart, for a buffered writer that is merely dropped still writes.
            drop(writer.into_parts());
        }
    }
}

fn earlier() -> io::Error {
    io::Error::other("an earlier write failed")
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.attempt(|sink| match sink {
            Sink::Replacing(writer, ..) => writer.write_all(bytes),
            Sink::Stream(writer) => writer.write_all(bytes),
        })?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// For files only.
impl Seek for Output {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.attempt(|sink| match sink {
            Sink::Replacing(writer, ..) => writer.seek(position),
            Sink::Stream(_) => Err(io::ErrorKind::NotSeekable.into()),
        })
    }
}

/// An [`Output`] that an encoder can own while the picture writer keeps hold of it.
#[derive(Clone)]
pub(crate) struct SharedOutput(Arc<Mutex<Option<Output>>>);

impl SharedOutput {
    pub(crate) fn new(output: Output) -> Self {
        Self(Arc::new(Mutex::new(Some(output))))
    }

    /// Lets `action` write.
    pub(crate) fn with<T, E: From<io::Error>>(
        &self,
        action: impl FnOnce(&mut Output) -> Result<T, E>,
    ) -> Result<T, E> {
        match self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            Some(output) => action(output),
            None => Err(io::Error::other("the output is closed").into()),
        }
    }

    /// Lets `encode` write to something that can seek: the file itself, or a place from which it is copied to
    /// the output afterwards.
    pub(crate) fn with_seekable<E: From<io::Error>>(
        &self,
        encode: impl FnOnce(&mut dyn WriteSeek) -> Result<(), E>,
    ) -> Result<(), E> {
        self.with(|output| {
            if matches!(output.sink, Sink::Replacing(..)) {
                return encode(output);
            }
            let mut spooled = tempfile::spooled_tempfile(SPOOLED);
            encode(&mut spooled)?;
            spooled.rewind()?;
            io::copy(&mut spooled, output)?;
            Ok(())
        })
    }

    fn take(&self) -> Option<Output> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Why a write failed, where one did and nobody has asked.
    pub(crate) fn cause(&self) -> Option<io::Error> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut()?.cause.take()
    }

    /// Writes what is buffered and moves the file to its place.
    pub(crate) fn finish(&self) -> io::Result<()> {
        self.take().map_or_else(|| Err(io::Error::other("the output is closed")), Output::finish)
    }

    /// Gives up: a temporary file goes, and nothing more is written.
    pub(crate) fn abandon(&self) {
        if let Some(output) = self.take() {
            output.abandon();
        }
    }
}

impl Write for SharedOutput {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.with(|output| output.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl std::fmt::Debug for SharedOutput {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SharedOutput").finish_non_exhaustive()
    }
}

/// Both of what some encoders ask for.
pub(crate) trait WriteSeek: Write + Seek {}

impl<T: Write + Seek> WriteSeek for T {}
