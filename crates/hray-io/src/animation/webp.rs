//! Animated WebP, <https://developers.google.com/speed/webp/docs/riff_container>.
//!
//! The `image` crate compresses a picture and writes no animations. An animation is a file of chunks, each with four
//! letters and a length, and among them the same bytes for every frame that are in the file of a picture.

use super::{Clock, Encoder};
use crate::output::SharedOutput;
use image::codecs::webp::WebPEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::io::{self, Seek, Write};
use tempfile::SpooledTempFile;

/// Bytes of frames kept in memory; more go to a temporary file. The length of all stands before the first.
const SPOOLED: usize = 1 << 24;
/// The longest file: a length of 32 bits, which does not count itself and the four letters before it.
const LONGEST: u64 = u32::MAX as u64 - 8;
/// "Animation" among the flags of the whole.
const ANIMATED: u8 = 0b10;
/// "Do not blend" among the flags of a frame.
const REPLACES: u8 = 0b10;

struct WebP {
    output: SharedOutput,
    size: [u32; 2],
    clock: Clock,
    /// All chunks.
    chunks: SpooledTempFile,
    length: u64,
}

pub(super) fn begin(output: SharedOutput, size: [u32; 2], fps: f64) -> io::Result<Box<dyn Encoder>> {
    let clock = Clock { fps, units: 1000.0 };
    let mut webp = WebP { output, size, clock, chunks: tempfile::spooled_tempfile(SPOOLED), length: 0 };
    let mut head = vec![ANIMATED, 0, 0, 0];
    head.extend(size.map(|side| three_bytes(side - 1)).as_flattened());
    webp.chunk(b"VP8X", &[&head])?;
    // A black background, and no end of repetitions.
    webp.chunk(b"ANIM", &[&[0, 0, 0, 255, 0, 0]])?;
    Ok(Box::new(webp))
}

impl WebP {
    fn chunk(&mut self, name: &[u8; 4], parts: &[&[u8]]) -> io::Result<()> {
        let length: usize = parts.iter().map(|part| part.len()).sum();
        self.length += 8 + length as u64 + (length % 2) as u64;
        let short = u32::try_from(length).ok().filter(|_| self.length <= LONGEST);
        let short = short.ok_or_else(|| io::Error::other("a WebP file can be no longer than 4 GiB"))?;
        self.chunks.write_all(name)?;
        self.chunks.write_all(&short.to_le_bytes())?;
        for part in parts {
            self.chunks.write_all(part)?;
        }
        // Chunks begin at even places.
        self.chunks.write_all(&[0][..length % 2])
    }
}

impl Encoder for WebP {
    fn frame(&mut self, index: u32, pixels: &[u8]) -> io::Result<()> {
        let [width, height] = self.size;
        let mut file = Vec::new();
        let encoder = WebPEncoder::new_lossless(&mut file);
        encoder.write_image(pixels, width, height, ExtendedColorType::Rgb8).map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other),
        })?;
        // After the head of the file comes its one chunk, which is the picture.
        let picture = file.get(12..).filter(|picture| picture.starts_with(b"VP8L"));
        let picture = picture.ok_or_else(|| io::Error::other("a frame of another kind than expected"))?;
        let mut head = vec![0; 6];
        head.extend(self.size.map(|side| three_bytes(side - 1)).as_flattened());
        head.extend(three_bytes(self.clock.length(index)));
        head.push(REPLACES);
        self.chunk(b"ANMF", &[&head, picture])
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        let length = u32::try_from(self.length + 4).map_err(io::Error::other)?;
        self.output.write_all(b"RIFF")?;
        self.output.write_all(&length.to_le_bytes())?;
        self.output.write_all(b"WEBP")?;
        self.chunks.rewind()?;
        io::copy(&mut self.chunks, &mut self.output).map(drop)
    }
}

fn three_bytes(number: u32) -> [u8; 3] {
    let [a, b, c, _] = number.to_le_bytes();
    [a, b, c]
}
