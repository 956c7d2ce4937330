//! A picture on its way to a file.

use crate::format::Scanlines;
use crate::output::{Output, SharedOutput};
use crate::{Destination, OutputError, PictureFormat};
use image::codecs::{
    bmp::BmpEncoder, jpeg::JpegEncoder, qoi::QoiEncoder, tiff::TiffEncoder, webp::WebPEncoder,
};
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// JPEG's quality, 1 to 100: no artefact of compression is to be taken for one of rendering.
const JPEG_QUALITY: u8 = 95;
/// Bytes of compressed data in a chunk of a PNG file.
const PNG_CHUNK: usize = 1 << 16;

/// Takes the pixels of a picture, top line first and each from the left, and writes them to their place.
///
/// Pixels come as [`PictureFormat::encode`] made them, in runs of any length. The picture is in its place only
/// after [`PictureWriter::finish`]; a writer that is dropped before has left no trace (where the destination is
/// a pipe or a device, it has written a part).
#[derive(Debug)]
pub struct PictureWriter {
    name: PathBuf,
    format: PictureFormat,
    width: u32,
    height: u32,
    output: SharedOutput,
    encoder: Encoder,
    /// Bytes of pixels that are still to come, where their number is fixed.
    missing: Option<u64>,
}

enum Encoder {
    /// The pixels go to the output as they are.
    Plain,
    Lines(Scanlines),
    Png(Box<png::StreamWriter<'static, SharedOutput>>),
    /// The whole picture is wanted at once.
    Collected(Vec<u8>),
}

impl std::fmt::Debug for Encoder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Plain => "Plain",
            Self::Lines(_) => "Lines",
            Self::Png(_) => "Png",
            Self::Collected(_) => "Collected",
        })
    }
}

impl PictureWriter {
    /// Begins a picture: the size is checked, memory for formats that need it is taken, a temporary file is
    /// made and the header written to it.
    ///
    /// # Errors
    /// [`OutputError`] where any of that fails.
    pub fn create(
        destination: &Destination,
        format: PictureFormat,
        width: u32,
        height: u32,
    ) -> Result<Self, OutputError> {
        let name = destination.name();
        format.check_size(width, height)?;
        let output =
            destination.open().map_err(|source| OutputError::Io { path: name.to_owned(), source })?;
        Self::begin(name, output, format, width, height)
    }

    /// Begins a picture that goes to any writer, which is called `name` in messages.
    ///
    /// # Errors
    /// [`OutputError`] as in [`PictureWriter::create`].
    pub fn to_writer(
        writer: impl Write + Send + 'static,
        name: &Path,
        format: PictureFormat,
        width: u32,
        height: u32,
    ) -> Result<Self, OutputError> {
        format.check_size(width, height)?;
        Self::begin(name, Output::stream(Box::new(writer)), format, width, height)
    }

    fn begin(
        name: &Path,
        output: Output,
        format: PictureFormat,
        width: u32,
        height: u32,
    ) -> Result<Self, OutputError> {
        let output = SharedOutput::new(output);
        let missing = format.bytes_per_pixel().map(|n| n * u64::from(width) * u64::from(height));
        let mut writer =
            Self { name: name.to_owned(), format, width, height, output, encoder: Encoder::Plain, missing };
        let header = format.header(width, height);
        writer.output.write_all(&header).map_err(|source| writer.io(source))?;
        writer.encoder = match format {
            PictureFormat::Png => writer.png().map_err(|source| writer.io(source))?,
            PictureFormat::Exr => Encoder::Lines(Scanlines::new(width)),
            _ if format.streams() => Encoder::Plain,
            _ => {
                let bytes = missing.unwrap_or(0);
                let mut pixels = Vec::new();
                usize::try_from(bytes)
                    .ok()
                    .and_then(|n| pixels.try_reserve_exact(n).ok())
                    .ok_or(OutputError::Memory { format, bytes })?;
                Encoder::Collected(pixels)
            }
        };
        Ok(writer)
    }

    fn png(&self) -> io::Result<Encoder> {
        let mut encoder = png::Encoder::new(self.output.clone(), self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        let stream = encoder.write_header()?.into_stream_writer_with_size(PNG_CHUNK)?;
        Ok(Encoder::Png(Box::new(stream)))
    }

    /// Takes the next pixels.
    ///
    /// # Errors
    /// [`OutputError::Io`] where they cannot be written, [`OutputError::Length`] where there are more than the
    /// picture has. The picture is then lost; drop the writer.
    pub fn write(&mut self, encoded: &[u8]) -> Result<(), OutputError> {
        if let Some(missing) = &mut self.missing {
            let given = encoded.len() as u64;
            *missing = missing.checked_sub(given).ok_or(OutputError::Length { expected: *missing, given })?;
        }
        let result = match &mut self.encoder {
            Encoder::Plain => self.output.write_all(encoded),
            Encoder::Lines(lines) => lines.write(encoded, &mut self.output),
            Encoder::Png(stream) => stream.write_all(encoded),
            Encoder::Collected(pixels) => {
                pixels.extend_from_slice(encoded);
                Ok(())
            }
        };
        result.map_err(|source| self.io(source))
    }

    /// Writes what is left and puts the picture in its place.
    ///
    /// # Errors
    /// [`OutputError::Length`] where pixels are missing, [`OutputError::Io`] where the system refuses. Then the
    /// destination is as it was.
    pub fn finish(mut self) -> Result<(), OutputError> {
        if let Some(missing @ 1..) = self.missing {
            let pixels = u64::from(self.width) * u64::from(self.height);
            let expected = self.format.bytes_per_pixel().unwrap_or(0) * pixels;
            return Err(OutputError::Length { expected, given: expected - missing });
        }
        let result = match std::mem::replace(&mut self.encoder, Encoder::Plain) {
            Encoder::Plain | Encoder::Lines(_) => Ok(()),
            Encoder::Png(stream) => stream.finish().map_err(io::Error::from),
            Encoder::Collected(pixels) => self.encode_collected(&pixels).map_err(into_io),
        };
        result.and_then(|()| self.output.finish()).map_err(|source| self.io(source))
    }

    fn encode_collected(&mut self, pixels: &[u8]) -> Result<(), ImageError> {
        let (width, height, color) = (self.width, self.height, ExtendedColorType::Rgb8);
        let output = &mut self.output;
        match self.format {
            PictureFormat::Bmp => BmpEncoder::new(output).write_image(pixels, width, height, color),
            PictureFormat::Jpeg => {
                JpegEncoder::new_with_quality(output, JPEG_QUALITY).write_image(pixels, width, height, color)
            }
            PictureFormat::Qoi => QoiEncoder::new(output).write_image(pixels, width, height, color),
            PictureFormat::WebP => {
                WebPEncoder::new_lossless(output).write_image(pixels, width, height, color)
            }
            PictureFormat::Tiff => {
                output.write_seekable(|file| TiffEncoder::new(file).write_image(pixels, width, height, color))
            }
            _ => Ok(()),
        }
    }

    fn io(&self, source: io::Error) -> OutputError {
        OutputError::Io { path: self.name.clone(), source }
    }
}

impl Drop for PictureWriter {
    fn drop(&mut self) {
        // Before the encoder, which may have last words, is dropped.
        self.output.abandon();
    }
}

fn into_io(error: ImageError) -> io::Error {
    match error {
        ImageError::IoError(error) => error,
        other => io::Error::other(other),
    }
}
