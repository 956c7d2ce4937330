//! The picture formats: their names, their limits, and what becomes of a colour in each.

mod ppm_text;
mod quantize;
mod srgb;

use crate::{OutputError, Quoted};
use hray_core::{Encoding, Rgb};
use image::ExtendedColorType;
use std::fmt;
use std::path::{Path, PathBuf};

/// A picture format that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum PictureFormat {
    /// P3, portable pixmap as text, in the form of the program of 2005: components neither clipped nor
    /// broken into lines.
    PpmAscii,
    /// P6, portable pixmap.
    Ppm,
    /// Portable network graphics, the default where nothing is said.
    Png,
    /// Windows bitmap.
    Bmp,
    /// Tagged image file format, uncompressed.
    Tiff,
    /// Truevision TGA, uncompressed.
    Tga,
    /// The "quite OK image" format.
    Qoi,
    /// JPEG: lossy, for looking at, not for comparing.
    Jpeg,
    /// WebP, lossless.
    WebP,
    /// OpenEXR: single precision, unclipped, losslessly compressed.
    Exr,
    /// farbfeld: sixteen bits a component.
    Farbfeld,
}

impl PictureFormat {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Png,
        Self::Ppm,
        Self::PpmAscii,
        Self::Bmp,
        Self::Tiff,
        Self::Tga,
        Self::Qoi,
        Self::Jpeg,
        Self::WebP,
        Self::Exr,
        Self::Farbfeld,
    ];

    /// The name by which the format is asked for.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::PpmAscii => "ppm-ascii",
            Self::Ppm => "ppm",
            Self::Png => "png",
            Self::Bmp => "bmp",
            Self::Tiff => "tiff",
            Self::Tga => "tga",
            Self::Qoi => "qoi",
            Self::Jpeg => "jpeg",
            Self::WebP => "webp",
            Self::Exr => "exr",
            Self::Farbfeld => "farbfeld",
        }
    }

    /// The format in a few words.
    #[must_use]
    pub const fn description(self) -> &'static str {
        match self {
            Self::PpmAscii => "portable pixmap as text (P3), as in 2005",
            Self::Ppm => "portable pixmap (P6)",
            Self::Png => "portable network graphics",
            Self::Bmp => "Windows bitmap",
            Self::Tiff => "TIFF, uncompressed",
            Self::Tga => "Truevision TGA",
            Self::Qoi => "quite OK image",
            Self::Jpeg => "JPEG (lossy)",
            Self::WebP => "WebP, lossless",
            Self::Exr => "OpenEXR, 32-bit floating point, unclipped",
            Self::Farbfeld => "farbfeld, 16 bits a component",
        }
    }

    /// The file extensions that mean this format, in lower case. None for the text form of PPM, which
    /// shares its extension with the binary one and has to be asked for.
    #[must_use]
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::PpmAscii => &[],
            Self::Ppm => &["ppm", "pnm"],
            Self::Png => &["png"],
            Self::Bmp => &["bmp"],
            Self::Tiff => &["tiff", "tif"],
            Self::Tga => &["tga"],
            Self::Qoi => &["qoi"],
            Self::Jpeg => &["jpg", "jpeg"],
            Self::WebP => &["webp"],
            Self::Exr => &["exr"],
            Self::Farbfeld => &["ff"],
        }
    }

    /// The format with that name; upper and lower case are the same.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// The format that the extension of a file's name asks for; upper and lower case are the same.
    ///
    /// # Errors
    /// [`UnknownFormat`] where there is no extension or no format with it.
    pub fn from_path(path: &Path) -> Result<Self, UnknownFormat> {
        path.extension()
            .and_then(|extension| extension.to_str())
            .and_then(Self::from_extension)
            .ok_or_else(|| UnknownFormat { path: path.to_owned() })
    }

    fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|format| format.extensions().iter().any(|known| known.eq_ignore_ascii_case(extension)))
    }

    /// A run of pixels as a [`crate::PictureWriter`] of this format takes it. Pure and independent of where
    /// the run begins, so that every thread encodes what it rendered.
    ///
    /// `encoding` says what becomes of a component before it is rounded. OpenEXR holds linear light and takes
    /// every component as it is.
    #[must_use]
    pub fn encode(self, pixels: &[Rgb], encoding: Encoding) -> Vec<u8> {
        match (self.color_type(), encoding) {
            (None, Encoding::Raw) => ppm_text::ppm_text(pixels),
            (None, Encoding::Srgb) => ppm_text::ppm_text(&srgb::encoded(pixels)),
            (Some(ExtendedColorType::Rgb32F), _) => quantize::rgb32(pixels),
            (Some(ExtendedColorType::Rgba16), Encoding::Raw) => quantize::rgba16(pixels),
            (Some(ExtendedColorType::Rgba16), Encoding::Srgb) => quantize::rgba16(&srgb::encoded(pixels)),
            (Some(_), Encoding::Raw) => quantize::rgb8(pixels),
            (Some(_), Encoding::Srgb) => srgb::rgb8(pixels),
        }
    }

    /// What [`PictureFormat::encode`] makes of the pixels; none for text.
    pub(crate) const fn color_type(self) -> Option<ExtendedColorType> {
        match self {
            Self::PpmAscii => None,
            Self::Exr => Some(ExtendedColorType::Rgb32F),
            Self::Farbfeld => Some(ExtendedColorType::Rgba16),
            Self::Ppm
            | Self::Png
            | Self::Bmp
            | Self::Tiff
            | Self::Tga
            | Self::Qoi
            | Self::Jpeg
            | Self::WebP => Some(ExtendedColorType::Rgb8),
        }
    }

    /// Bytes a pixel, about, that the encoder of the whole picture takes besides the pixels it is given.
    pub(crate) const fn encoder_memory(self) -> u64 {
        match self {
            // The pixels with red and blue exchanged.
            Self::Tga => 3,
            // The file, at its largest.
            Self::Qoi => 4,
            // The pixels with opacity, and the file.
            Self::WebP => 8,
            _ => 0,
        }
    }

    /// Checks that the format can hold a picture of that size.
    ///
    /// # Errors
    /// [`OutputError::Size`] where it cannot.
    pub fn check_size(self, width: u32, height: u32) -> Result<(), OutputError> {
        let longest = width.max(height);
        let pixels = u64::from(width) * u64::from(height);
        let holds = match self {
            Self::Ppm | Self::PpmAscii | Self::Farbfeld => true,
            Self::Png => longest <= i32::MAX as u32,
            // Half of the coordinates, so that sums of two do not overflow in other programs.
            Self::Exr => longest < i32::MAX as u32 / 2,
            Self::Jpeg | Self::Tga => longest <= 0xffff,
            Self::WebP => longest <= 0x4000,
            // Offsets and lengths of 32 bits; BMP fills up each line to four bytes.
            Self::Bmp => longest <= i32::MAX as u32 && (pixels + u64::from(height)) * 3 < (1 << 32) - 1024,
            Self::Tiff => pixels * 3 < (1 << 32) - 1024,
            // The limit that the format's own specification recommends.
            Self::Qoi => pixels <= 400_000_000,
        };
        if holds && width > 0 && height > 0 {
            Ok(())
        } else {
            Err(OutputError::Size { format: self, width, height })
        }
    }
}

impl fmt::Display for PictureFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A file name that does not tell the format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownFormat {
    /// The name.
    pub path: PathBuf,
}

impl fmt::Display for UnknownFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.path.extension() {
            Some(extension) => write!(
                f,
                "cannot tell the format of {}: no picture format has the extension {}",
                Quoted(&self.path),
                Quoted(Path::new(extension))
            )?,
            None => {
                write!(f, "cannot tell the format of {}: it has no extension", Quoted(&self.path))?;
            }
        }
        f.write_str("; known are ")?;
        let mut known = PictureFormat::ALL.iter().flat_map(|format| format.extensions()).peekable();
        while let Some(extension) = known.next() {
            write!(f, "{extension}{}", if known.peek().is_some() { ", " } else { "" })?;
        }
        Ok(())
    }
}

impl std::error::Error for UnknownFormat {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_tell_the_format_whatever_their_case() {
        let of = |name: &str| PictureFormat::from_path(Path::new(name)).ok();
        assert_eq!(of("a.png"), Some(PictureFormat::Png));
        assert_eq!(of("dir.x/A.B.TiF"), Some(PictureFormat::Tiff));
        assert_eq!(of("a.ppm"), Some(PictureFormat::Ppm));
        assert_eq!((of("a.hry"), of("png"), of(".png"), of("")), (None, None, None, None));
    }

    #[test]
    fn names_are_unique_and_found_again() {
        for format in PictureFormat::ALL {
            assert_eq!(PictureFormat::from_name(&format.name().to_uppercase()), Some(format));
            for extension in format.extensions() {
                assert_eq!(PictureFormat::from_extension(extension), Some(format));
            }
        }
        assert_eq!(PictureFormat::from_name("gif"), None);
    }

    #[test]
    fn an_unknown_extension_is_answered_with_the_known_ones() {
        let error = PictureFormat::from_path(Path::new("a.gif")).unwrap_err().to_string();
        assert_eq!(
            error,
            "cannot tell the format of `a.gif`: no picture format has the extension `gif`; known are png, \
             ppm, pnm, bmp, tiff, tif, tga, qoi, jpg, jpeg, webp, exr, ff"
        );
    }

    #[test]
    fn sizes_beyond_a_format_are_refused() {
        assert!(PictureFormat::Jpeg.check_size(65_535, 1).is_ok());
        assert!(PictureFormat::Jpeg.check_size(65_536, 1).is_err());
        assert!(PictureFormat::WebP.check_size(1, 16_385).is_err());
        assert!(PictureFormat::Png.check_size(1 << 15, 1 << 15).is_ok());
        assert!(PictureFormat::Bmp.check_size(1 << 15, 1 << 15).is_ok());
        assert!(PictureFormat::Tga.check_size(1, 65_536).is_err());
        assert!(PictureFormat::Exr.check_size((1 << 30) - 2, 1).is_ok());
        assert!(PictureFormat::Exr.check_size((1 << 30) - 1, 1).is_err());
        assert!(PictureFormat::Ppm.check_size(0, 1).is_err());
    }
}
