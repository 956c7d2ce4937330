//! What is written in each format is what a decoder reads back.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

use hray_core::{Encoding, Rgb};
use hray_io::{Destination, OutputError, PictureFormat, PictureWriter};
use image::ImageReader;
use std::io::{self, Cursor, Write};
use std::path::Path;
use std::sync::{Arc, Mutex};

/// A picture of ragged size with edges, gradients and values outside [0, 1].
fn picture(width: u32, height: u32) -> Vec<Rgb> {
    (0..height)
        .flat_map(|y| (0..width).map(move |x| (f64::from(x) / f64::from(width), f64::from(y), x)))
        .map(|(u, y, x)| match x % 7 {
            0 => Rgb::new(1.5, -0.25, u),
            1 => Rgb::new(0.0, 0.0, 0.0),
            _ => Rgb::new(u, (y * 0.037) % 1.0, u * u),
        })
        .collect()
}

/// A writer into memory that others can look at.
#[derive(Clone, Default)]
struct Memory(Arc<Mutex<Vec<u8>>>);

impl Write for Memory {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

fn written(format: PictureFormat, width: u32, height: u32, pixels: &[Rgb], run: usize) -> Vec<u8> {
    let memory = Memory::default();
    let mut writer = PictureWriter::to_writer(memory.clone(), Path::new("-"), format, width, height).unwrap();
    for pixels in pixels.chunks(run) {
        writer.write(&format.encode(pixels, Encoding::Raw)).unwrap();
    }
    writer.finish().unwrap();
    let bytes = memory.0.lock().unwrap();
    bytes.clone()
}

fn decoded(bytes: &[u8], format: PictureFormat) -> image::DynamicImage {
    let mut reader = ImageReader::new(Cursor::new(bytes));
    match format {
        // Has no signature to be recognised by.
        PictureFormat::Tga => reader.set_format(image::ImageFormat::Tga),
        _ => reader = reader.with_guessed_format().unwrap(),
    }
    reader.no_limits();
    reader.decode().unwrap()
}

fn eight_bits(pixels: &[Rgb]) -> Vec<u8> {
    pixels
        .iter()
        .flat_map(|p| p.to_array())
        .map(|c| (255.0 * c).round_ties_even().clamp(0.0, 255.0) as u8)
        .collect()
}

#[test]
fn formats_of_eight_bits_are_lossless() {
    for (width, height) in [(1, 1), (37, 11), (64, 3)] {
        let pixels = picture(width, height);
        for format in PictureFormat::ALL {
            use PictureFormat::{Exr, Farbfeld, Jpeg, PpmAscii};
            if matches!(format, PpmAscii | Jpeg | Exr | Farbfeld) {
                continue;
            }
            let image = decoded(&written(format, width, height, &pixels, 13), format).to_rgb8();
            assert_eq!((image.width(), image.height()), (width, height), "{format}");
            assert_eq!(image.into_raw(), eight_bits(&pixels), "{format}");
        }
    }
}

#[test]
fn the_length_of_the_runs_changes_no_byte() {
    let (width, height) = (29, 9);
    let pixels = picture(width, height);
    for format in PictureFormat::ALL {
        let whole = written(format, width, height, &pixels, pixels.len());
        for run in [1, 7, 29, 100] {
            assert_eq!(written(format, width, height, &pixels, run), whole, "{format} in runs of {run}");
        }
    }
}

#[test]
fn farbfeld_keeps_sixteen_bits() {
    let pixels = picture(37, 11);
    let image = decoded(&written(PictureFormat::Farbfeld, 37, 11, &pixels, 50), PictureFormat::Farbfeld);
    let expected: Vec<u16> = pixels
        .iter()
        .flat_map(|p| [p.r, p.g, p.b, 1.0])
        .map(|c| (65535.0 * c).round_ties_even().clamp(0.0, 65535.0) as u16)
        .collect();
    assert_eq!(image.to_rgba16().into_raw(), expected);
}

#[test]
fn open_exr_keeps_every_colour() {
    for (width, height) in [(1, 1), (37, 11)] {
        let pixels = picture(width, height);
        let image = decoded(&written(PictureFormat::Exr, width, height, &pixels, 50), PictureFormat::Exr);
        let expected: Vec<f32> = pixels.iter().flat_map(|p| p.to_array()).map(|c| c as f32).collect();
        assert_eq!(image.to_rgb32f().into_raw(), expected);
    }
}

#[test]
fn jpeg_comes_close() {
    let pixels: Vec<Rgb> = (0..64 * 64).map(|i| Rgb::new(f64::from(i % 64) / 64.0, 0.5, 0.25)).collect();
    let image = decoded(&written(PictureFormat::Jpeg, 64, 64, &pixels, 100), PictureFormat::Jpeg).to_rgb8();
    for (got, expected) in image.into_raw().into_iter().zip(eight_bits(&pixels)) {
        assert!(got.abs_diff(expected) < 12, "{expected} became {got}");
    }
}

#[test]
fn the_text_form_is_that_of_2005() {
    let pixels = [Rgb::new(0.0, 0.5, 1.0), Rgb::new(2.0, -0.3, 0.1), Rgb::BLACK, Rgb::new(1.0, 1.0, 1.0)];
    let text = written(PictureFormat::PpmAscii, 2, 2, &pixels, 3);
    assert_eq!(text, b"P3\n2 2\n255\n0 128 255 510 -76 26 0 0 0 255 255 255 ");
    let small = picture(5, 3);
    let small: Vec<Rgb> = small.iter().filter(|p| (0.0..=1.0).contains(&p.r)).copied().collect();
    let count = small.len() as u32;
    let image = decoded(&written(PictureFormat::PpmAscii, count, 1, &small, 2), PictureFormat::PpmAscii);
    assert_eq!(image.to_rgb8().into_raw(), eight_bits(&small));
}

#[test]
fn too_few_and_too_many_pixels_are_errors() {
    let format = PictureFormat::Png;
    let make = || PictureWriter::to_writer(io::sink(), Path::new("-"), format, 4, 4).unwrap();
    let mut short = make();
    short.write(&format.encode(&[Rgb::BLACK; 15], Encoding::Raw)).unwrap();
    assert!(matches!(short.finish(), Err(OutputError::Length { expected: 48, given: 45 })));
    let mut long = make();
    assert!(matches!(
        long.write(&format.encode(&[Rgb::BLACK; 17], Encoding::Raw)),
        Err(OutputError::Length { .. })
    ));
}

#[test]
fn a_picture_larger_than_memory_is_refused_before_its_first_pixel() {
    let begin = |format, side| PictureWriter::to_writer(io::sink(), Path::new("-"), format, side, side);
    for (format, side) in [(PictureFormat::Exr, 1 << 29), (PictureFormat::Farbfeld, u32::MAX)] {
        let error = begin(format, side).unwrap_err();
        assert!(matches!(error, OutputError::Memory { .. }));
        assert!(error.to_string().contains("png and ppm are written as they are rendered"), "{error}");
    }
}

/// Fails after a number of bytes, as a full disk does.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_noticed_at_whatever_byte() {
    let pixels = picture(16, 4);
    for format in PictureFormat::ALL {
        let length = written(format, 16, 4, &pixels, 16).len();
        for room in (0..length).step_by(7).chain([length - 1]) {
            let result = PictureWriter::to_writer(Full(room), Path::new("full"), format, 16, 4).and_then(
                |mut writer| {
                    writer.write(&format.encode(&pixels, Encoding::Raw))?;
                    writer.finish()
                },
            );
            let error = result.expect_err("there was no room").to_string();
            assert_eq!(
                error, "cannot write `full`: no storage space; free some space, or write elsewhere",
                "{format} at {room}"
            );
        }
    }
}

#[test]
fn a_device_takes_what_a_file_takes() {
    // These go back to earlier bytes, which a pipe does not let them: the bytes must be the same.
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a");
    // The larger one is not kept in memory on its way to a pipe.
    for (format, side) in [(PictureFormat::Tiff, 37), (PictureFormat::Exr, 37), (PictureFormat::Exr, 1400)] {
        let pixels = picture(side, side);
        let destination = Destination::file(&path).unwrap();
        let mut writer = PictureWriter::create(&destination, format, side, side).unwrap();
        writer.write(&format.encode(&pixels, Encoding::Raw)).unwrap();
        writer.finish().unwrap();
        let file = std::fs::read(&path).unwrap();
        assert!(side < 1000 || file.len() > 1 << 24, "{} bytes are kept in memory", file.len());
        assert!(file == written(format, side, side, &pixels, 4096), "{format}, {side}");
    }
}

/// What a decoder finds in a file of linear light 0.5: 188 of 255, 0.735 of 65535, and 0.5 itself.
#[test]
fn srgb_is_encoded_in_every_format_but_open_exr() {
    let pixels = [Rgb::new(0.5, 0.5, 0.5); 16 * 16];
    for format in PictureFormat::ALL {
        let memory = Memory::default();
        let mut writer = PictureWriter::to_writer(memory.clone(), Path::new("-"), format, 16, 16).unwrap();
        writer.write(&format.encode(&pixels, Encoding::Srgb)).unwrap();
        writer.finish().unwrap();
        let bytes = memory.0.lock().unwrap().clone();
        match format {
            PictureFormat::PpmAscii => assert!(bytes.ends_with(b" 188 188 ")),
            PictureFormat::Exr => {
                assert!(decoded(&bytes, format).to_rgb32f().into_raw().iter().all(|c| *c == 0.5));
            }
            PictureFormat::Farbfeld => {
                let words = decoded(&bytes, format).to_rgba16().into_raw();
                assert_eq!(words[0], (65535.0 * 0.735_356_983_052_449_9f64).round() as u16);
            }
            _ => {
                assert!(
                    decoded(&bytes, format).to_rgb8().into_raw().iter().all(|c| c.abs_diff(188) <= 1),
                    "{format}"
                );
            }
        }
    }
}
