//! A scene together with the picture that is asked of it.

use crate::Scene;
use std::fmt;
use std::num::NonZeroU32;

/// The lowest recursion depth: it traces nothing and gives a black picture.
pub const MIN_DEPTH: i32 = -1;
/// The highest recursion depth.
pub const MAX_DEPTH: i32 = 10_000;
/// The largest number of pixels of a picture: 2^30.
pub const MAX_PIXELS: u64 = 1 << 30;

/// Width and height of a picture in pixels; both at least 1, their product at most [`MAX_PIXELS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    width: u32,
    height: u32,
}

impl Resolution {
    /// A resolution of `width` by `height` pixels.
    ///
    /// # Errors
    /// [`DescriptionError::Resolution`] where there would be no pixels, or more than [`MAX_PIXELS`].
    pub fn new(width: i64, height: i64) -> Result<Self, DescriptionError> {
        let error = DescriptionError::Resolution { width, height };
        match (u32::try_from(width), u32::try_from(height)) {
            (Ok(w), Ok(h)) if w > 0 && h > 0 && u64::from(w) * u64::from(h) <= MAX_PIXELS => {
                Ok(Self { width: w, height: h })
            }
            _ => Err(error),
        }
    }

    /// Pixels across.
    #[must_use]
    pub const fn width(self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub const fn height(self) -> u32 {
        self.height
    }

    /// Pixels in all.
    #[must_use]
    pub fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

impl fmt::Display for Resolution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}x{}", self.width, self.height)
    }
}

/// How light is followed: direct light with shadows, mirrored and refracted rays, to a depth. Thesis §2.3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// The thesis' integrator to the bit, its absolute constants (1e-6, 1e-9) and its quirks included. Shapes,
    /// lights, cameras and functions that the thesis did not have follow its rules: a box is not hit nearer than
    /// 1e-6, light from behind is subtracted, mirrors see black where there is nothing.
    Classic2005,
    /// The same kinds of light without absolute constants: scenes of any size look alike. Every hit has a bound of
    /// its rounding error, computed from the magnitudes involved, rays that leave it start beyond that bound, and
    /// then every hit in front of them counts. What else is different:
    ///
    /// - Mirrored and refracted rays see the background, not black or a share of it.
    /// - Light leaves glass by Snell's law as it enters it, and what cannot leave is mirrored instead of lost.
    /// - Ambient light is multiplied by the colour of the surface.
    /// - A surface has two sides: it is lit from the side it is seen from, and light from behind gives nothing.
    ///   Where no light falls there is no highlight.
    ///
    /// As in the thesis, the colour of every hit is clipped to [0, 1], that of the background is not, and what is
    /// transparent casts shadows like everything else.
    Classic,
}

/// What becomes of a colour on its way into a picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Nothing: the numbers pass through.
    Raw,
    /// Colours are linear light, and are encoded by the transfer function of sRGB (IEC 61966-2-1). Formats that
    /// hold linear light (OpenEXR) take them as they are.
    Srgb,
}

/// What a scene file says: the thesis' `RenderDescr` (appendix A.5), and what it left open.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The size of the picture.
    pub resolution: Resolution,
    /// How many times a ray may be reflected or refracted, [`MIN_DEPTH`] to [`MAX_DEPTH`].
    pub max_depth: i32,
    /// Samples a pixel, unless the render asks for another number.
    pub samples: NonZeroU32,
    /// How light is followed.
    pub integrator: Integrator,
    /// What becomes of a colour on its way into a picture file.
    pub encoding: Encoding,
    /// The scene.
    pub scene: Scene,
}

/// A number that no picture can be made with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DescriptionError {
    /// No pixels, or too many of them.
    Resolution {
        /// The width that was asked for.
        width: i64,
        /// The height that was asked for.
        height: i64,
    },
}

impl fmt::Display for DescriptionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::Resolution { width, height } = self;
        if *width < 1 || *height < 1 {
            write!(f, "a picture of {width} by {height} pixels has no pixels; both must be at least 1")
        } else {
            write!(
                f,
                "a picture of {width} by {height} pixels is too large; the limit is {MAX_PIXELS} pixels in all"
            )
        }
    }
}

impl std::error::Error for DescriptionError {}
