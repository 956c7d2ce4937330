//! Bytes on their way to a file, a device or a pipe.

use std::fs::File;
use std::io::{self, BufWriter, Seek, Write};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use tempfile::TempPath;

/// Bytes gathered before the system is called.
const BUFFER: usize = 1 << 17;

/// Where the bytes go.
enum Sink {
    /// A temporary file, and the place it is moved to when all is written.
    Replacing(BufWriter<File>, TempPath, PathBuf),
    Stream(BufWriter<Box<dyn Write + Send>>),
}

/// A place for bytes that remembers whether one of them failed to arrive: the encoders of some crates write
/// their last bytes when they are dropped, where no error can be returned.
pub(crate) struct Output {
    sink: Sink,
    failed: bool,
}

impl Output {
    pub(crate) fn replacing(file: File, temporary: TempPath, target: PathBuf) -> Self {
        Self {
            sink: Sink::Replacing(BufWriter::with_capacity(BUFFER, file), temporary, target),
            failed: false,
        }
    }

    pub(crate) fn stream(writer: Box<dyn Write + Send>) -> Self {
        Self { sink: Sink::Stream(BufWriter::with_capacity(BUFFER, writer)), failed: false }
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        if self.failed {
            return Err(io::Error::other("an earlier write failed"));
        }
        let result = match &mut self.sink {
            Sink::Replacing(writer, ..) => writer.write_all(bytes),
            Sink::Stream(writer) => writer.write_all(bytes),
        };
        self.failed = result.is_err();
        result
    }

    /// The file itself, where what was written can be gone back to.
    fn seekable(&mut self) -> Option<&mut BufWriter<File>> {
        match &mut self.sink {
            Sink::Replacing(writer, ..) => Some(writer),
            Sink::Stream(_) => None,
        }
    }

    fn finish(self) -> io::Result<()> {
        if self.failed {
            return Err(io::Error::other("an earlier write failed"));
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

/// An [`Output`] that an encoder can own while the picture writer keeps hold of it.
#[derive(Clone)]
pub(crate) struct SharedOutput(Arc<Mutex<Option<Output>>>);

impl SharedOutput {
    pub(crate) fn new(output: Output) -> Self {
        Self(Arc::new(Mutex::new(Some(output))))
    }

    fn with<T>(&self, action: impl FnOnce(&mut Output) -> io::Result<T>) -> io::Result<T> {
        match self.0.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            Some(output) => action(output),
            None => Err(io::Error::other("the output is closed")),
        }
    }

    fn take(&self) -> Option<Output> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
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

    /// Lets `encode` write to something that can seek: the file itself, or memory that is written afterwards.
    pub(crate) fn write_seekable<E: From<io::Error>>(
        &mut self,
        encode: impl FnOnce(&mut dyn WriteSeek) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut guard = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match guard.as_mut().and_then(Output::seekable) {
            Some(file) => encode(file),
            None => {
                drop(guard);
                let mut memory = io::Cursor::new(Vec::new());
                encode(&mut memory)?;
                Ok(self.write_all(memory.get_ref())?)
            }
        }
    }
}

impl Write for SharedOutput {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.with(|output| output.write_all(bytes))?;
        Ok(bytes.len())
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
