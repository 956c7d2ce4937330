//! Animations in one file.
//!
//! | format | extensions | of a component | of time | memory |
//! |---|---|---|---|---|
//! | GIF | `gif` | 256 colours a frame | 1/100 s | streamed |
//! | APNG | `apng` | 8 bits | exact | streamed |
//! | WebP | `webp` | 8 bits, lossless | 1/1000 s | a temporary file |
//!
//! Where a format's unit of time does not divide the length of a frame, frames begin at the nearest unit, so that errors
//! do not add up. All play for ever.

mod apng;
mod gif;
mod webp;

use crate::output::SharedOutput;
use crate::{Destination, OutputError};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// The most frames a second.
pub const MAX_FPS: f64 = 1000.0;
/// The fewest frames a second: one a minute.
pub const MIN_FPS: f64 = 1.0 / 60.0;
/// Players show shorter frames of a GIF for 1/10 s.
const MAX_GIF_FPS: f64 = 50.0;

/// A format that holds an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationFormat {
    /// GIF 89a: at most 256 colours a frame.
    Gif,
    /// Animated PNG.
    Apng,
    /// Animated WebP, lossless.
    WebP,
}

impl AnimationFormat {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Gif, Self::Apng, Self::WebP];

    /// Its name, which is its extension, too.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Gif => "gif",
            Self::Apng => "apng",
            Self::WebP => "webp",
        }
    }

    /// The format that the extension of a file's name asks for; upper and lower case are the same.
    #[must_use]
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        Self::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(extension))
    }

    /// Checks that the format can hold frames of that size, so many a second.
    ///
    /// # Errors
    /// [`OutputError::FrameSize`] and [`OutputError::FrameRate`] where it cannot.
    pub fn check(self, width: u32, height: u32, fps: f64) -> Result<(), OutputError> {
        let longest = match self {
            Self::Gif => 0xffff,
            Self::Apng => i32::MAX as u32,
            Self::WebP => 0x4000,
        };
        if width == 0 || height == 0 || width.max(height) > longest {
            return Err(OutputError::FrameSize { format: self, width, height, longest });
        }
        let fastest = if self == Self::Gif { MAX_GIF_FPS } else { MAX_FPS };
        if !(MIN_FPS..=fastest).contains(&fps) {
            return Err(OutputError::FrameRate { format: self, fps, fastest });
        }
        Ok(())
    }
}

impl fmt::Display for AnimationFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// When frames begin, in a format's unit of time.
#[derive(Clone, Copy, Debug)]
struct Clock {
    /// Frames a second.
    fps: f64,
    /// Units a second.
    units: f64,
}

impl Clock {
    /// How long a frame is shown.
    fn length(self, frame: u32) -> u32 {
        let start = |frame: f64| (frame * self.units / self.fps).round();
        (start(f64::from(frame) + 1.0) - start(f64::from(frame))) as u32
    }
}

/// What turns frames into bytes.
trait Encoder: Send {
    /// Takes the next frame: 8 bits a component, row by row from the top.
    fn frame(&mut self, index: u32, pixels: &[u8]) -> io::Result<()>;

    /// Writes what comes after the last frame.
    fn finish(self: Box<Self>) -> io::Result<()>;
}

/// Takes the frames of an animation and writes them to one file.
///
/// Pixels come as [`crate::PictureFormat::Png`] encodes them, top line first, frame after frame, in runs of any length.
/// The file is in its place only after [`AnimationWriter::finish`]; a writer that is dropped before has left no trace
/// (where the destination is a pipe or a device, it has written a part).
pub struct AnimationWriter {
    name: PathBuf,
    output: SharedOutput,
    encoder: Option<Box<dyn Encoder>>,
    /// The pixels of the frame that is being given.
    pixels: Vec<u8>,
    /// Bytes of a frame.
    frame: usize,
    frames: u32,
    complete: u32,
}

impl fmt::Debug for AnimationWriter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AnimationWriter")
            .field("name", &self.name)
            .field("complete", &self.complete)
            .finish_non_exhaustive()
    }
}

impl AnimationWriter {
    /// Begins an animation of `frames` frames, `fps` a second: the size is checked, memory for a frame is taken, a
    /// temporary file is made and the header written to it.
    ///
    /// # Errors
    /// [`OutputError`] where any of that fails.
    pub fn create(
        destination: &Destination,
        format: AnimationFormat,
        [width, height]: [u32; 2],
        frames: u32,
        fps: f64,
    ) -> Result<Self, OutputError> {
        format.check(width, height, fps)?;
        let name = destination.name().to_owned();
        let io = |source| OutputError::Io { path: name.clone(), source };
        let bytes = 3 * u64::from(width) * u64::from(height);
        let mut pixels = Vec::new();
        // The encoders keep a frame with opacity and a compressed one at most.
        let room = usize::try_from(bytes * 5).ok().filter(|room| pixels.try_reserve_exact(*room).is_ok());
        let frame = room.ok_or_else(|| io(io::ErrorKind::OutOfMemory.into()))? / 5;
        let mut pixels: Vec<u8> = pixels;
        pixels.shrink_to(frame);
        let output = SharedOutput::new(destination.open().map_err(io)?);
        let size = [width, height];
        let encoder = match format {
            AnimationFormat::Gif => gif::begin(output.clone(), size, fps),
            AnimationFormat::Apng => apng::begin(output.clone(), size, frames, fps),
            AnimationFormat::WebP => webp::begin(output.clone(), size, fps),
        };
        let encoder = Some(encoder.map_err(|source| failed(&name, &output, source))?);
        Ok(Self { name, output, encoder, pixels, frame, frames, complete: 0 })
    }

    /// Takes the next pixels.
    ///
    /// # Errors
    /// [`OutputError::Io`] where they cannot be written, [`OutputError::Length`] where there are more than the frames
    /// have. The animation is then lost; drop the writer.
    pub fn write(&mut self, mut encoded: &[u8]) -> Result<(), OutputError> {
        while !encoded.is_empty() {
            if self.complete == self.frames {
                return Err(self.wrong_length(encoded.len()));
            }
            let (now, later) = encoded.split_at(encoded.len().min(self.frame - self.pixels.len()));
            self.pixels.extend_from_slice(now);
            encoded = later;
            if self.pixels.len() == self.frame {
                if let Some(encoder) = &mut self.encoder {
                    let result = encoder.frame(self.complete, &self.pixels);
                    result.map_err(|source| failed(&self.name, &self.output, source))?;
                }
                self.pixels.clear();
                self.complete += 1;
            }
        }
        Ok(())
    }

    /// Writes what is left and puts the file in its place.
    ///
    /// # Errors
    /// [`OutputError::Length`] where pixels are missing, [`OutputError::Io`] where the system refuses. Then the
    /// destination is as it was.
    pub fn finish(mut self) -> Result<(), OutputError> {
        if self.complete != self.frames || !self.pixels.is_empty() {
            return Err(self.wrong_length(0));
        }
        let finished = self.encoder.take().map_or(Ok(()), Encoder::finish);
        finished
            .and_then(|()| self.output.finish())
            .map_err(|source| failed(&self.name, &self.output, source))
    }

    fn wrong_length(&self, more: usize) -> OutputError {
        let bytes = |frames: u32| u64::from(frames) * self.frame as u64;
        let given = bytes(self.complete) + (self.pixels.len() + more) as u64;
        OutputError::Length { expected: bytes(self.frames), given }
    }
}

impl Drop for AnimationWriter {
    fn drop(&mut self) {
        // Before the encoder, which may have last words, is dropped.
        self.output.abandon();
    }
}

fn failed(name: &Path, output: &SharedOutput, source: io::Error) -> OutputError {
    OutputError::Io { path: name.to_owned(), source: output.cause().unwrap_or(source) }
}

/// What a frame rate that a format cannot keep means, for [`OutputError`].
pub(crate) fn describe_rate(
    f: &mut fmt::Formatter<'_>,
    format: AnimationFormat,
    fps: f64,
    fastest: f64,
) -> fmt::Result {
    write!(
        f,
        "{fps} frames a second are not possible in the format {format}; give a number from 1/60 to {fastest}"
    )?;
    if format == AnimationFormat::Gif && fps <= MAX_FPS {
        f.write_str(" (players slow down a GIF that is faster), or write .apng or .webp")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::AnimationDecoder;
    use std::io::Cursor;

    /// Frames of flat colours, the first two of which have more than 256.
    fn pixels(frame: u32, [width, height]: [u32; 2]) -> Vec<u8> {
        let pixel = |i: u32| match frame {
            0 | 1 => [(i % 251) as u8, (i / 7 % 256) as u8, frame as u8],
            n => [n as u8 * 20, 255, 0],
        };
        (0..width * height).flat_map(pixel).collect()
    }

    fn write(format: AnimationFormat, size: [u32; 2], frames: u32, fps: f64) -> Vec<u8> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let destination = Destination::file(&path).unwrap();
        let mut writer = AnimationWriter::create(&destination, format, size, frames, fps).unwrap();
        let all: Vec<u8> = (0..frames).flat_map(|frame| pixels(frame, size)).collect();
        for run in all.chunks(1000) {
            writer.write(run).unwrap();
            assert!(!path.exists());
        }
        writer.finish().unwrap();
        std::fs::read(path).unwrap()
    }

    fn read(format: AnimationFormat, bytes: Vec<u8>) -> Vec<image::Frame> {
        let bytes = Cursor::new(bytes);
        let frames = match format {
            AnimationFormat::Gif => image::codecs::gif::GifDecoder::new(bytes).unwrap().into_frames(),
            AnimationFormat::Apng => {
                image::codecs::png::PngDecoder::new(bytes).unwrap().apng().unwrap().into_frames()
            }
            AnimationFormat::WebP => image::codecs::webp::WebPDecoder::new(bytes).unwrap().into_frames(),
        };
        frames.collect_frames().unwrap()
    }

    #[test]
    fn what_is_written_is_read_back() {
        for format in AnimationFormat::ALL {
            for size in [[40, 30], [1, 1], [33, 1]] {
                let frames = read(format, write(format, size, 5, 24.0));
                assert_eq!(frames.len(), 5, "{format}");
                let mut total = 0.0;
                for (index, frame) in (0..).zip(&frames) {
                    let (numerator, denominator) = frame.delay().numer_denom_ms();
                    total += f64::from(numerator) / f64::from(denominator);
                    let expected: Vec<u8> =
                        pixels(index, size).chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
                    let found = frame.buffer().as_raw();
                    if format == AnimationFormat::Gif && index < 2 {
                        // Of too many colours the nearest are taken.
                        let error =
                            expected.iter().zip(found).map(|(a, b)| u64::from(a.abs_diff(*b))).sum::<u64>();
                        assert!(error < 12 * expected.len() as u64, "{error}");
                    } else {
                        assert_eq!(*found, expected, "{format}, frame {index}");
                    }
                }
                let off = total - 5.0 * 1000.0 / 24.0;
                assert!(off.abs() <= 5.0, "{format}: {total} ms");
            }
            assert_eq!(write(format, [40, 30], 3, 12.5), write(format, [40, 30], 3, 12.5), "{format}");
        }
    }

    #[test]
    fn frame_lengths_do_not_drift() {
        let clock = Clock { fps: 24.0, units: 100.0 };
        assert_eq!((0..6).map(|frame| clock.length(frame)).collect::<Vec<_>>(), [4, 4, 5, 4, 4, 4]);
        assert_eq!((0..240).map(|frame| clock.length(frame)).sum::<u32>(), 1000);
    }

    #[test]
    fn a_writer_that_is_dropped_or_given_too_little_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let destination = Destination::file(&folder.path().join("a.gif")).unwrap();
        for format in AnimationFormat::ALL {
            let begin = || AnimationWriter::create(&destination, format, [2, 2], 2, 24.0).unwrap();
            let mut writer = begin();
            writer.write(&[0; 12]).unwrap();
            drop(writer);
            let mut writer = begin();
            writer.write(&[0; 13]).unwrap();
            assert!(matches!(writer.finish(), Err(OutputError::Length { expected: 24, given: 13 })));
            let mut writer = begin();
            assert!(matches!(writer.write(&[0; 25]), Err(OutputError::Length { expected: 24, given: 25 })));
            drop(writer);
            assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "{format}");
        }
    }

    #[test]
    fn what_a_format_cannot_hold_is_refused() {
        let check = |format: AnimationFormat, width, fps| {
            format.check(width, 1, fps).map_err(|error| error.to_string()).err().unwrap_or_default()
        };
        assert_eq!(check(AnimationFormat::Gif, 65_535, 50.0), "");
        assert!(check(AnimationFormat::Gif, 65_536, 24.0).contains("65535"));
        assert!(check(AnimationFormat::WebP, 16_385, 24.0).contains("16384"));
        assert!(check(AnimationFormat::Gif, 1, 60.0).contains("write .apng or .webp"));
        assert_eq!(check(AnimationFormat::Apng, 1, 60.0), "");
        for fps in [0.0, -1.0, f64::NAN, 1001.0, f64::INFINITY] {
            assert!(check(AnimationFormat::Apng, 1, fps).contains("from 1/60 to 1000"), "{fps}");
        }
        assert_eq!(AnimationFormat::from_path(Path::new("a/b.GIF")), Some(AnimationFormat::Gif));
        assert_eq!(AnimationFormat::from_path(Path::new("a.png")), None);
    }
}
