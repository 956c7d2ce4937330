//! Images for a scene: photographs, maps, pictures that hray made.

use crate::InputError;
use crate::source::{open, read_bounded};
use hray_core::Image;
use image::error::{ImageError, LimitErrorKind};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::Path;

/// The longest image file that is read: 1 GiB.
pub const MAX_IMAGE_BYTES: u64 = 1 << 30;
/// The most pixels of an image: 2^26, which take 1 GiB of memory.
pub const MAX_IMAGE_PIXELS: u64 = 1 << 26;
/// What a decoder may take besides: its own buffers, and the pixels as they are in the file.
const MAX_DECODER_BYTES: u64 = 2 << 30;

/// Reads an image file: PNG, JPEG, BMP, TGA, TIFF, QOI, WebP, GIF (its first frame), PNM, farbfeld, OpenEXR or Radiance
/// HDR. The format is told by the content; that of TGA, which has no mark of its own, by the extension.
///
/// # Errors
/// [`InputError`] where the file cannot be read, is no image, is damaged, or is larger than [`MAX_IMAGE_BYTES`] or
/// [`MAX_IMAGE_PIXELS`].
pub fn read_image(path: &Path) -> Result<Image, InputError> {
    let bytes = read_bounded(open(path, MAX_IMAGE_BYTES)?, path, MAX_IMAGE_BYTES)?;
    decode_image(&bytes, path)
}

/// Makes an image of the bytes of a file, which is called `name` in messages; its extension tells TGA.
///
/// Integer components (8 or 16 bits) are taken for sRGB and decoded to linear light, except alpha; floating-point ones
/// are linear light as they are. Colour profiles are not looked at; an orientation in the file is applied. The size is
/// checked before memory is taken for the pixels.
///
/// # Errors
/// As [`read_image`].
pub fn decode_image(bytes: &[u8], name: &Path) -> Result<Image, InputError> {
    let failed = |reason: String| InputError::Image { path: name.to_owned(), reason };
    let format = image::guess_format(bytes).ok().or_else(|| ImageFormat::from_path(name).ok());
    let format = format.filter(|format| *format == ImageFormat::Tga || image::guess_format(bytes).is_ok());
    let format = format.ok_or_else(|| failed(format!("it is no image; known are {KNOWN}")))?;
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits());
    let mut decoder = reader.into_decoder().map_err(|error| failed(explain(&error)))?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > MAX_IMAGE_PIXELS {
        return Err(failed(too_large()));
    }
    // Where the orientation cannot be read, the image can all the same.
    let orientation = decoder.orientation();
    let mut decoded = DynamicImage::from_decoder(decoder).map_err(|error| failed(explain(&error)))?;
    if let Ok(orientation) = orientation {
        decoded.apply_orientation(orientation);
    }
    let (width, height) = (decoded.width(), decoded.height());
    Image::new(width, height, linear(decoded)).ok_or_else(|| failed("it has no pixels".to_owned()))
}

const KNOWN: &str = "png, jpg, bmp, tga, tif, qoi, webp, gif, ppm, ff, exr and hdr";

fn limits() -> Limits {
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_DECODER_BYTES);
    limits
}

fn too_large() -> String {
    format!("it has more than {MAX_IMAGE_PIXELS} pixels, the most that are read; make it smaller")
}

/// What an error of the decoder means to whoever named the file.
fn explain(error: &ImageError) -> String {
    match error {
        ImageError::Limits(error) => match error.kind() {
            LimitErrorKind::DimensionError | LimitErrorKind::InsufficientMemory => too_large(),
            _ => error.to_string(),
        },
        ImageError::Unsupported(error) => format!("it is a kind of image that is not read ({error})"),
        ImageError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            "the file ends too early; it is damaged".to_owned()
        }
        error => format!("the file is damaged ({error})"),
    }
}

/// Red, green, blue and alpha of every pixel in linear light.
fn linear(image: DynamicImage) -> Vec<[f32; 4]> {
    match image {
        DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_) => {
            image.into_rgba32f().pixels().map(|pixel| pixel.0).collect()
        }
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => {
            let table = table(u16::MAX.into());
            let component = |value: u16| table.get(usize::from(value)).copied().unwrap_or(1.0);
            let pixels = image.into_rgba16();
            let alpha = |value: u16| f32::from(value) / 65535.0;
            pixels.pixels().map(|p| decoded(p.0, component, alpha)).collect()
        }
        image => {
            let table = table(u8::MAX.into());
            let component = |value: u8| table.get(usize::from(value)).copied().unwrap_or(1.0);
            let alpha = |value: u8| f32::from(value) / 255.0;
            image.into_rgba8().pixels().map(|p| decoded(p.0, component, alpha)).collect()
        }
    }
}

fn decoded<T: Copy>(
    [r, g, b, a]: [T; 4],
    component: impl Fn(T) -> f32,
    alpha: impl Fn(T) -> f32,
) -> [f32; 4] {
    [component(r), component(g), component(b), alpha(a)]
}

/// The linear light of each component from 0 to `max`: the inverse transfer function of sRGB (IEC 61966-2-1).
fn table(max: u32) -> Vec<f32> {
    let linear = |value: u32| {
        let encoded = f64::from(value) / f64::from(max);
        if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) }
    };
    (0..=max).map(|value| linear(value) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PictureFormat;
    use hray_core::{Encoding, Rgb};

    fn encode(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    fn eight_bits() -> DynamicImage {
        DynamicImage::ImageRgb8(image::RgbImage::from_fn(3, 2, |x, y| {
            image::Rgb([x as u8 * 90, 128, y as u8 * 255])
        }))
    }

    #[test]
    fn integers_are_decoded_from_srgb_and_what_hray_writes_is_read_back() {
        let image = decode_image(&encode(&eight_bits(), ImageFormat::Png), Path::new("a.png")).unwrap();
        assert_eq!((image.width(), image.height()), (3, 2));
        let [r, g, b, a] = image.pixels()[5];
        assert_eq!((b, a), (1.0, 1.0));
        assert!((g - 0.215_860_5).abs() < 1e-6, "{g}");
        // The very bytes come back.
        let color = Rgb::new(r.into(), g.into(), b.into());
        assert_eq!(PictureFormat::Png.encode(&[color], Encoding::Srgb), [180, 128, 255]);
    }

    #[test]
    fn every_format_is_known_by_its_content_and_tga_by_its_name() {
        for format in [
            ImageFormat::Png,
            ImageFormat::Bmp,
            ImageFormat::Tiff,
            ImageFormat::Qoi,
            ImageFormat::WebP,
            ImageFormat::Gif,
            ImageFormat::Pnm,
        ] {
            let image = decode_image(&encode(&eight_bits(), format), Path::new("no-extension")).unwrap();
            let first = decode_image(&encode(&eight_bits(), ImageFormat::Png), Path::new("-")).unwrap();
            assert_eq!(image, first, "{format:?}");
        }
        let tga = encode(&eight_bits(), ImageFormat::Tga);
        assert!(decode_image(&tga, Path::new("a.TGA")).is_ok());
        let jpeg = encode(&eight_bits(), ImageFormat::Jpeg);
        assert_eq!(decode_image(&jpeg, Path::new("wrong.png")).unwrap().width(), 3);
    }

    #[test]
    fn sixteen_bits_and_floats_keep_their_precision() {
        let mut sixteen = image::ImageBuffer::<image::Rgb<u16>, Vec<u16>>::new(1, 1);
        sixteen.put_pixel(0, 0, image::Rgb([1, 32768, 65535]));
        let sixteen = encode(&DynamicImage::ImageRgb16(sixteen), ImageFormat::Png);
        let [r, g, b, _] = decode_image(&sixteen, Path::new("-")).unwrap().pixels()[0];
        assert!(r > 0.0 && (f64::from(g) - 0.214_048_8).abs() < 1e-6 && b == 1.0, "{r} {g} {b}");
        let mut floats = image::Rgb32FImage::new(1, 1);
        floats.put_pixel(0, 0, image::Rgb([0.5, 12.25, 0.0]));
        for format in [ImageFormat::OpenExr, ImageFormat::Hdr] {
            let bytes = encode(&DynamicImage::ImageRgb32F(floats.clone()), format);
            assert_eq!(
                decode_image(&bytes, Path::new("-")).unwrap().pixels(),
                [[0.5, 12.25, 0.0, 1.0]],
                "{format:?}"
            );
        }
    }

    #[test]
    fn alpha_is_no_light() {
        let mut pixel = image::RgbaImage::new(1, 1);
        pixel.put_pixel(0, 0, image::Rgba([255, 0, 0, 128]));
        let bytes = encode(&DynamicImage::ImageRgba8(pixel), ImageFormat::Png);
        let [_, _, _, a] = decode_image(&bytes, Path::new("-")).unwrap().pixels()[0];
        assert!((a - 128.0 / 255.0).abs() < 1e-6, "{a}");
    }

    #[test]
    fn what_is_wrong_is_said() {
        let error = |bytes: &[u8], name: &str| decode_image(bytes, Path::new(name)).unwrap_err().to_string();
        assert!(
            error(b"renderDescr", "a.png").contains("cannot read `a.png`: it is no image; known are png")
        );
        assert!(error(b"", "-").contains("no image"));
        let png = encode(&eight_bits(), ImageFormat::Png);
        assert!(error(&png[..40], "a.png").contains("damaged"), "{}", error(&png[..40], "a.png"));
        // A header of 4,000,000,000 pixels and nothing after it.
        let mut huge = b"P6\n65536 65536\n255\n".to_vec();
        huge.extend([0; 64]);
        assert!(error(&huge, "a.ppm").contains("more than 67108864 pixels"), "{}", error(&huge, "a.ppm"));
        let mut bomb = png;
        bomb[16..24].copy_from_slice(&[0, 1, 0, 0, 0, 1, 0, 0]);
        assert!(!error(&bomb, "a.png").is_empty());
    }
}
