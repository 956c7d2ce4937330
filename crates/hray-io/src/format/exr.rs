//! OpenEXR, the subset that can be written line by line: one part, scan lines, no compression, three
//! channels of single precision.
//!
//! "OpenEXR File Layout", <https://openexr.com/en/latest/OpenEXRFileLayout.html>: a header of attributes, a
//! table of the offsets of all lines (known beforehand, all lines being equally long), then for each line its
//! number, its length, and its samples channel by channel. All numbers have their low byte first.

use std::io::{self, Write};

/// Bytes of a sample; the sample types are 0 (integer), 1 (half) and 2 (single precision).
const SAMPLE: usize = 4;
const SINGLE_PRECISION: i32 = 2;
/// Bytes before the samples of a line: its number and its length.
const LINE_HEADER: u64 = 8;

/// Header and offset table.
pub(super) fn header(width: u32, height: u32) -> Vec<u8> {
    let mut out = vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0];
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        for text in [name, kind] {
            out.extend_from_slice(text.as_bytes());
            out.push(0);
        }
        out.extend_from_slice(&(value.len() as u32).to_le_bytes());
        out.extend_from_slice(value);
    };

    let mut channels = Vec::new();
    // In alphabetical order, as the format demands.
    for name in [b'B', b'G', b'R'] {
        channels.extend_from_slice(&[name, 0]);
        // The sample type, "perceptually linear" (no), and one sample a pixel across and down.
        for number in [SINGLE_PRECISION, 0, 1, 1] {
            channels.extend_from_slice(&number.to_le_bytes());
        }
    }
    channels.push(0);
    let mut window = vec![0; 8];
    window.extend_from_slice(&(width.saturating_sub(1)).to_le_bytes());
    window.extend_from_slice(&(height.saturating_sub(1)).to_le_bytes());
    let one = 1.0f32.to_le_bytes();

    attribute("channels", "chlist", &channels);
    attribute("compression", "compression", &[0]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &one);
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &one);
    out.push(0);

    let first = out.len() as u64 + 8 * u64::from(height);
    let line = LINE_HEADER + 3 * SAMPLE as u64 * u64::from(width);
    for y in 0..u64::from(height) {
        out.extend_from_slice(&(first + y * line).to_le_bytes());
    }
    out
}

/// Turns runs of pixels, each of three samples, into the lines of a file.
#[derive(Debug)]
pub(crate) struct Scanlines {
    line: Vec<u8>,
    pending: Vec<u8>,
    length: usize,
    y: u32,
}

impl Scanlines {
    /// Of a picture of that width, at its first line.
    pub(crate) fn new(width: u32) -> Self {
        Self { line: Vec::new(), pending: Vec::new(), length: 3 * SAMPLE * width as usize, y: 0 }
    }

    /// Writes the lines that these bytes complete, and keeps the rest.
    pub(crate) fn write(&mut self, mut bytes: &[u8], out: &mut impl Write) -> io::Result<()> {
        while !bytes.is_empty() {
            let (now, later) = bytes.split_at(bytes.len().min(self.length - self.pending.len()));
            self.pending.extend_from_slice(now);
            bytes = later;
            if self.pending.len() == self.length {
                self.write_line(out)?;
            }
        }
        Ok(())
    }

    fn write_line(&mut self, out: &mut impl Write) -> io::Result<()> {
        self.line.clear();
        self.line.extend_from_slice(&self.y.to_le_bytes());
        self.line.extend_from_slice(&(self.pending.len() as u32).to_le_bytes());
        for channel in [2, 1, 0] {
            for pixel in self.pending.chunks_exact(3 * SAMPLE) {
                self.line.extend_from_slice(&pixel[channel * SAMPLE..(channel + 1) * SAMPLE]);
            }
        }
        self.pending.clear();
        self.y += 1;
        out.write_all(&self.line)
    }
}
