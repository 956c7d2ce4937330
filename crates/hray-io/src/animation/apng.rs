//! Animated PNG, part of <https://www.w3.org/TR/png-3/>.

use super::{Clock, Encoder};
use crate::output::SharedOutput;
use std::io;

struct Apng {
    writer: png::Writer<SharedOutput>,
    clock: Clock,
}

pub(super) fn begin(
    output: SharedOutput,
    [width, height]: [u32; 2],
    frames: u32,
    fps: f64,
) -> io::Result<Box<dyn Encoder>> {
    let mut encoder = png::Encoder::new(output, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Fast);
    encoder.set_animated(frames, 0)?;
    // A length is a fraction: exact where frames a second are a whole number.
    let whole = fps.fract() == 0.0;
    let clock = Clock { fps, units: if whole { fps } else { 1000.0 } };
    encoder.set_frame_delay(1, clock.units as u16)?;
    Ok(Box::new(Apng { writer: encoder.write_header()?, clock }))
}

impl Encoder for Apng {
    fn frame(&mut self, index: u32, pixels: &[u8]) -> io::Result<()> {
        let length = u16::try_from(self.clock.length(index)).unwrap_or(u16::MAX);
        self.writer.set_frame_delay(length, self.clock.units as u16)?;
        Ok(self.writer.write_image_data(pixels)?)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }
}
