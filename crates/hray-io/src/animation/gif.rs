//! GIF 89a, <https://www.w3.org/Graphics/GIF/spec-gif89a.txt>.

use super::{Clock, Encoder};
use crate::output::SharedOutput;
use std::io;

/// How many pixels the search for colours passes over, 1 to 30: what the `gif` crate recommends.
const SPEED: i32 = 10;

struct Gif {
    encoder: gif::Encoder<SharedOutput>,
    width: u16,
    height: u16,
    clock: Clock,
    /// The pixels of a frame with opacity.
    opaque: Vec<u8>,
}

pub(super) fn begin(
    output: SharedOutput,
    [width, height]: [u32; 2],
    fps: f64,
) -> io::Result<Box<dyn Encoder>> {
    let side = |side: u32| u16::try_from(side).map_err(|_| io::Error::from(io::ErrorKind::InvalidInput));
    let (width, height) = (side(width)?, side(height)?);
    let mut encoder = gif::Encoder::new(output, width, height, &[]).map_err(into_io)?;
    encoder.set_repeat(gif::Repeat::Infinite).map_err(into_io)?;
    let clock = Clock { fps, units: 100.0 };
    Ok(Box::new(Gif { encoder, width, height, clock, opaque: Vec::new() }))
}

impl Encoder for Gif {
    /// The colours of each frame are chosen for it alone: those it has where they are at most 256, else the ones that
    /// NeuQuant (Dekker, 1994) learns from it, which is deterministic.
    fn frame(&mut self, index: u32, pixels: &[u8]) -> io::Result<()> {
        self.opaque.clear();
        self.opaque.extend(pixels.chunks_exact(3).flat_map(|pixel| match pixel {
            [r, g, b] => [*r, *g, *b, 255],
            _ => [0; 4],
        }));
        let mut frame = gif::Frame::from_rgba_speed(self.width, self.height, &mut self.opaque, SPEED);
        frame.delay = u16::try_from(self.clock.length(index)).unwrap_or(u16::MAX);
        self.encoder.write_frame(&frame).map_err(into_io)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.encoder.into_inner().map(drop).map_err(into_io)
    }
}

fn into_io(error: gif::EncodingError) -> io::Error {
    match error {
        gif::EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}
