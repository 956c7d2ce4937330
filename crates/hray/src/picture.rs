//! A picture in memory.

use crate::{Destination, Encoding, OutputError, PictureFormat, Rgb};
use hray_io::PictureWriter;
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// The colours of a picture as they were computed, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    encoding: Encoding,
    pixels: Vec<Rgb>,
}

impl Picture {
    /// Of colours, row by row from the top; none where their number is not width times height. `encoding` is what
    /// becomes of them when the picture is saved.
    #[must_use]
    pub fn new(width: u32, height: u32, encoding: Encoding, pixels: Vec<Rgb>) -> Option<Self> {
        let fits = u64::from(width) * u64::from(height) == pixels.len() as u64;
        fits.then_some(Self { width, height, encoding, pixels })
    }

    /// Pixels across.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// What becomes of the colours when the picture is saved.
    #[must_use]
    pub const fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// All colours, row by row from the top and each row from the left.
    #[must_use]
    pub fn pixels(&self) -> &[Rgb] {
        &self.pixels
    }

    /// The colour of one pixel, `y` counted from the top; none outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<Rgb> {
        let index = u64::from(y) * u64::from(self.width) + u64::from(x);
        let index = usize::try_from(index).ok().filter(|_| x < self.width)?;
        self.pixels.get(index).copied()
    }

    /// The bytes of the picture as a file of that format.
    ///
    /// # Errors
    /// [`OutputError`] where the format cannot hold the picture.
    pub fn encode(&self, format: PictureFormat) -> Result<Vec<u8>, OutputError> {
        let memory = Memory::default();
        let writer =
            PictureWriter::to_writer(memory.clone(), Path::new("-"), format, self.width, self.height)?;
        self.write(writer, format)?;
        Ok(memory.take())
    }

    /// Saves the picture to a file, whole or not at all, in the format that its name tells.
    ///
    /// # Errors
    /// [`crate::Error::Format`] where the name does not tell a format, [`crate::Error::Output`] where the file
    /// cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), crate::Error> {
        let path = path.as_ref();
        let format = PictureFormat::from_path(path)?;
        let destination = Destination::file(path)?;
        let writer = PictureWriter::create(&destination, format, self.width, self.height)?;
        Ok(self.write(writer, format)?)
    }

    fn write(&self, mut writer: PictureWriter, format: PictureFormat) -> Result<(), OutputError> {
        for run in self.pixels.chunks(4096) {
            writer.write(&format.encode(run, self.encoding))?;
        }
        writer.finish()
    }
}

/// A writer into memory that can be looked at when the picture is finished.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory(Arc<Mutex<Vec<u8>>>);

impl Memory {
    /// What was written.
    pub(crate) fn take(&self) -> Vec<u8> {
        std::mem::take(&mut *self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Write for Memory {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
