//! What can be changed about a render without touching the scene file.

use crate::{
    Description, MAX_DEPTH, MAX_SAMPLES, MIN_DEPTH, NoiseTables, Region, RegionError, Resolution, Settings,
};
use std::fmt;
use std::num::{NonZeroU32, NonZeroUsize};

/// How to render. The default is what the scene file asks for.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The size of the picture, instead of the scene's. The camera's window stays.
    pub size: Option<Resolution>,
    /// How many times a ray may be reflected or refracted, [`MIN_DEPTH`] to [`MAX_DEPTH`], instead of the
    /// scene's number.
    pub max_depth: Option<i32>,
    /// Samples a pixel, at most [`MAX_SAMPLES`], instead of the scene's number.
    pub samples: Option<NonZeroU32>,
    /// The part of the picture to render, as x, y, width and height; y counts from the top. All of it where
    /// not given.
    pub region: Option<[u32; 4]>,
    /// Threads to use, which changes no pixel; as many as the machine runs at once where not given.
    pub threads: Option<NonZeroUsize>,
    /// The tables behind the noise textures.
    pub noise_tables: NoiseTables,
}

impl Options {
    /// What these options make of what a description asks for.
    ///
    /// # Errors
    /// [`OptionsError`] where a number is out of its range, or the region not inside the picture.
    pub fn settings(&self, description: &Description) -> Result<Settings, OptionsError> {
        let resolution = self.size.unwrap_or(description.resolution);
        let max_depth = self.max_depth.unwrap_or(description.max_depth);
        if !(MIN_DEPTH..=MAX_DEPTH).contains(&max_depth) {
            return Err(OptionsError::Depth(max_depth));
        }
        let samples = self.samples.unwrap_or(description.samples);
        if samples.get() > MAX_SAMPLES {
            return Err(OptionsError::Samples(samples.get()));
        }
        let region = match self.region {
            None => Region::whole(resolution),
            Some([x, y, width, height]) => {
                Region::new(x, y, width, height, resolution).map_err(OptionsError::Region)?
            }
        };
        Ok(Settings { resolution, region, max_depth, samples, threads: self.threads })
    }

    /// Whether these options give the picture another shape than the scene's, so that it is stretched: only a camera that is
    /// a window has a shape of its own, the others see more or less. The shape is the same where a side is off by less than the pixel that rounding may cost.
    #[must_use]
    pub fn changes_aspect(&self, description: &Description) -> bool {
        let [(w, h), (scene_w, scene_h)] =
            [self.size.unwrap_or(description.resolution), description.resolution]
                .map(|size| (u64::from(size.width()), u64::from(size.height())));
        matches!(description.scene.camera, hray_core::Camera::Window(_))
            && (w * scene_h).abs_diff(h * scene_w) >= scene_w.max(scene_h)
    }
}

/// Options that do not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OptionsError {
    /// A recursion depth out of range.
    Depth(i32),
    /// Too many samples a pixel.
    Samples(u32),
    /// A region that is empty, or not inside the picture.
    Region(RegionError),
}

impl fmt::Display for OptionsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Depth(depth) => {
                write!(f, "a depth of {depth} is out of range; it goes from {MIN_DEPTH} to {MAX_DEPTH}")
            }
            Self::Samples(samples) => {
                write!(f, "{samples} samples a pixel are too many; the limit is {MAX_SAMPLES}")
            }
            Self::Region(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for OptionsError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LintLevels, SceneFile};

    fn description() -> Description {
        let text = "renderDescr ( resolution (1024,783) ) 5 [ scene { camera (0.0,0.0,150.0) (100,75) }
                    { background (0.0,0.0,0.0) } { objects } { lights } ]";
        let file = SceneFile::parse("t.hry", text.into(), &LintLevels::default());
        file.description().cloned().unwrap()
    }

    #[test]
    fn the_default_is_what_the_scene_asks_for() {
        let description = description();
        assert_eq!(Options::default().settings(&description), Ok(Settings::of(&description)));
    }

    #[test]
    fn what_is_out_of_range_is_refused() {
        let description = description();
        let refused = |options: Options| options.settings(&description).unwrap_err().to_string();
        let depth = Options { max_depth: Some(-2), ..Options::default() };
        assert_eq!(refused(depth), "a depth of -2 is out of range; it goes from -1 to 10000");
        let samples = Options { samples: NonZeroU32::new(MAX_SAMPLES + 1), ..Options::default() };
        assert_eq!(refused(samples), "65537 samples a pixel are too many; the limit is 65536");
        let region = Options { region: Some([0, 0, 1025, 1]), ..Options::default() };
        assert!(refused(region).contains("does not lie inside the picture of 1024x783"));
    }

    #[test]
    fn a_region_lies_in_the_picture_that_is_asked_for() {
        let size = Resolution::new(2000, 1000).ok();
        let options = Options { size, region: Some([1900, 900, 100, 100]), ..Options::default() };
        assert!(options.settings(&description()).is_ok());
    }

    #[test]
    fn half_a_pixel_is_no_change_of_shape() {
        let changes = |w, h| {
            let size = Resolution::new(w, h).ok();
            Options { size, ..Options::default() }.changes_aspect(&description())
        };
        assert!(!changes(1024, 783) && !changes(512, 391) && !changes(512, 392) && !changes(2048, 1566));
        assert!(changes(512, 400) && changes(800, 600));
    }
}
