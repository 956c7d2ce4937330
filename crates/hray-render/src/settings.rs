//! How a scene is to be rendered.

use hray_core::{Description, Resolution};
use std::fmt;
use std::num::{NonZeroU32, NonZeroUsize};

/// The most samples a pixel may have.
pub const MAX_SAMPLES: u32 = 1 << 16;

/// A rectangle of pixels inside a picture. `y` counts from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Region {
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

impl Region {
    /// The whole picture.
    #[must_use]
    pub const fn whole(resolution: Resolution) -> Self {
        Self { x: 0, y: 0, width: resolution.width(), height: resolution.height() }
    }

    /// The rectangle `width` by `height` whose upper left pixel is (`x`, `y`).
    ///
    /// # Errors
    /// [`RegionError`] where it has no pixels or does not lie inside a picture of that `resolution`.
    pub fn new(x: u32, y: u32, width: u32, height: u32, resolution: Resolution) -> Result<Self, RegionError> {
        let fits = |start: u32, length: u32, limit: u32| {
            length > 0 && start.checked_add(length).is_some_and(|end| end <= limit)
        };
        if fits(x, width, resolution.width()) && fits(y, height, resolution.height()) {
            Ok(Self { x, y, width, height })
        } else {
            Err(RegionError { region: Self { x, y, width, height }, resolution })
        }
    }

    /// Left edge, in pixels from the left.
    #[must_use]
    pub const fn x(self) -> u32 {
        self.x
    }

    /// Upper edge, in pixels from the top.
    #[must_use]
    pub const fn y(self) -> u32 {
        self.y
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

/// A region without pixels, or not inside the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RegionError {
    region: Region,
    resolution: Resolution,
}

impl fmt::Display for RegionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Region { x, y, width, height } = self.region;
        if width == 0 || height == 0 {
            write!(f, "a region of {width} by {height} pixels has no pixels")
        } else {
            write!(
                f,
                "the region {width} by {height} pixels at ({x}, {y}) does not lie inside the picture of {} pixels",
                self.resolution
            )
        }
    }
}

impl std::error::Error for RegionError {}

/// How a scene is to be rendered. Only `threads` has no influence on the pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The size of the whole picture.
    pub resolution: Resolution,
    /// The part of it that is rendered; each pixel gets the colour it has in the whole.
    pub region: Region,
    /// How many times a ray may be reflected or refracted, -1 (a black picture) to 10000.
    pub max_depth: i32,
    /// Samples a pixel, at most [`MAX_SAMPLES`]. With 1 the single sample is the pixel's own point: its centre, or,
    /// with the classic camera, the thesis' lower left corner. With more, they follow an Owen-scrambled
    /// (0, 2)-sequence through a tent filter of radius one pixel centred on that same point, each sample with
    /// equal weight.
    pub samples: NonZeroU32,
    /// Threads to use, or as many as the machine runs at once.
    pub threads: Option<NonZeroUsize>,
}

impl Settings {
    /// What the scene file itself asks for: all of its picture.
    #[must_use]
    pub const fn of(description: &Description) -> Self {
        Self {
            resolution: description.resolution,
            region: Region::whole(description.resolution),
            max_depth: description.max_depth,
            samples: description.samples,
            threads: None,
        }
    }
}
