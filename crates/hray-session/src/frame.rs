//! A picture while it comes into being: gone over a few times, finer each time, in tiles that can be rendered in any order, on
//! any thread, or in any worker of a page.

use crate::protocol::{Event, Refusal, View};
use crate::scene::Work;
use hray::{
    Control, Description, Encoding, MeshTrees, NoiseTables, Options, PictureFormat, Prepared, Region,
    RenderError, Resolution, Rgb, Settings, Tracer,
};
use std::num::NonZeroU32;

/// The most pixels of a picture that is shown: what fits a page's memory.
pub const MOST_PIXELS: u64 = 1 << 26;
/// The steps of the passes before the last, in pixels.
const STEPS: [u32; 2] = [16, 4];
/// The edge of a tile in samples: of a coarse pass, so that all threads have work; and of a fine one.
const COARSE_TILE: u32 = 24;
const FINE_TILE: u32 = 64;

/// A picture that is ready to be rendered.
#[derive(Debug)]
pub struct Frame {
    prepared: Prepared,
    settings: Settings,
    encoding: Encoding,
    passes: Vec<Pass>,
}

/// The picture gone over once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// Each sample stands for a square of so many pixels.
    pub step: NonZeroU32,
    /// Samples of each of these.
    pub samples: NonZeroU32,
}

/// A part of a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tile {
    /// The pass, from 0.
    pub pass: usize,
    /// The pixels that it stands for.
    pub region: Region,
}

/// A tile's pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// In picture pixels: left and upper edge; then samples across and down, and the step.
    pub place: [u32; 5],
    /// As they are displayed: red, green, blue and full opacity.
    pub rgba: Vec<u8>,
    /// As they were computed.
    pub colors: Vec<Rgb>,
}

/// Refuses pictures that a page has no memory for.
pub(crate) fn check_size(size: Resolution) -> Result<(), Refusal> {
    if u64::from(size.width()) * u64::from(size.height()) <= MOST_PIXELS {
        return Ok(());
    }
    let message = format!(
        "a picture of {size} pixels is too large to be shown here; at most {MOST_PIXELS} pixels can be"
    );
    let help = "make the scene's size smaller while you work on it, and render it with `hray render --size`";
    Err(Refusal::new(message).with_help(help))
}

impl View {
    /// The size that is asked for, where it is not the scene's.
    ///
    /// # Errors
    /// Where there are no pictures of that size.
    pub fn size(&self) -> Result<Option<Resolution>, Refusal> {
        let (Some(width), Some(height)) = (self.width, self.height) else { return Ok(None) };
        let size = Resolution::new(width.into(), height.into());
        size.map(Some).map_err(|error| Refusal::new(error.to_string()))
    }
}

impl Frame {
    /// Prepares the picture of a scene, in the scene's own size where none is given. The trees over meshes are taken from
    /// `meshes` where they are there, and left there.
    ///
    /// # Errors
    /// Where it is too large, or cannot be rendered at all.
    pub fn new(
        description: &Description,
        size: Option<Resolution>,
        meshes: &mut MeshTrees,
    ) -> Result<Self, Refusal> {
        let options = Options { size, ..Options::default() };
        let settings = options.settings(description).map_err(|error| Refusal::new(error.to_string()))?;
        check_size(settings.resolution)?;
        let prepared = Prepared::new(description, &NoiseTables::default(), meshes);
        let prepared = prepared.map_err(|error| Refusal::new(error.to_string()))?;
        let one = NonZeroU32::MIN;
        let coarse = STEPS.iter().filter_map(|&step| NonZeroU32::new(step));
        let mut passes: Vec<Pass> = coarse.map(|step| Pass { step, samples: one }).collect();
        if settings.samples > one {
            passes.push(Pass { step: one, samples: one });
        }
        passes.push(Pass { step: one, samples: settings.samples });
        Ok(Self { prepared, settings, encoding: description.encoding, passes })
    }

    /// The size of the picture.
    #[must_use]
    pub const fn resolution(&self) -> Resolution {
        self.settings.resolution
    }

    /// What becomes of colours when they are displayed.
    #[must_use]
    pub const fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The passes, coarse to fine; the last gives the picture.
    #[must_use]
    pub fn passes(&self) -> &[Pass] {
        &self.passes
    }

    /// That it begins, under a number.
    #[must_use]
    pub fn event(&self, number: u32, work: &Work) -> Event {
        Event::Frame {
            frame: number,
            doc: work.doc.clone(),
            version: work.version,
            time: work.time,
            width: self.settings.resolution.width(),
            height: self.settings.resolution.height(),
            passes: self.passes.len(),
        }
    }

    /// How many threads may render at once.
    #[must_use]
    pub fn most_threads(&self) -> usize {
        self.prepared.most_threads(self.settings.max_depth)
    }

    /// How many samples all passes take.
    #[must_use]
    pub fn samples(&self) -> u64 {
        let count = |pass: &Pass| self.tiles_of(*pass).0 * u64::from(pass.samples.get());
        self.passes.iter().map(count).sum()
    }

    /// The pixels that a pass renders, and the edge of its tiles in picture pixels.
    fn tiles_of(&self, pass: Pass) -> (u64, u32) {
        let step = pass.step.get();
        let [width, height] = [self.settings.resolution.width(), self.settings.resolution.height()];
        let pixels = u64::from(width.div_ceil(step)) * u64::from(height.div_ceil(step));
        (pixels, step * if step > 1 { COARSE_TILE } else { FINE_TILE })
    }

    /// The tiles of a pass, from the middle of the picture outward.
    #[must_use]
    pub fn tiles(&self, pass: usize) -> Vec<Tile> {
        let Some(of) = self.passes.get(pass) else { return Vec::new() };
        let (_, edge) = self.tiles_of(*of);
        let resolution = self.settings.resolution;
        let [width, height] = [resolution.width(), resolution.height()];
        let mut tiles = Vec::new();
        for y in (0..height).step_by(edge as usize) {
            for x in (0..width).step_by(edge as usize) {
                let region = Region::new(x, y, edge.min(width - x), edge.min(height - y), resolution);
                tiles.extend(region.ok().map(|region| Tile { pass, region }));
            }
        }
        let from_middle = |tile: &Tile| {
            let off = |start: u32, length: u32, whole: u32| {
                (i64::from(start) * 2 + i64::from(length) - i64::from(whole)).pow(2)
            };
            off(tile.region.x(), tile.region.width(), width)
                + off(tile.region.y(), tile.region.height(), height)
        };
        tiles.sort_by_key(from_middle);
        tiles
    }

    /// The pixels of a tile; a function of the picture and the tile alone.
    ///
    /// # Errors
    /// [`RenderError::Cancelled`] after [`Control::cancel`].
    pub fn render(
        &self,
        tile: &Tile,
        tracer: &mut Tracer,
        control: &Control,
    ) -> Result<Pixels, RenderError<std::convert::Infallible>> {
        let Some(Pass { step, samples }) = self.passes.get(tile.pass).copied() else {
            return Ok(Pixels { place: [0; 5], rgba: Vec::new(), colors: Vec::new() });
        };
        let region = tile.region;
        let colors = self.prepared.pixels(&self.settings, region, step, samples, tracer, control)?;
        let (width, height) = (region.width().div_ceil(step.get()), region.height().div_ceil(step.get()));
        // A PNG has eight bits a component, and so has a screen.
        let rgb = PictureFormat::Png.encode(&colors, self.encoding);
        let rgba = rgb.as_chunks::<3>().0.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
        Ok(Pixels { place: [region.x(), region.y(), width, height, step.get()], rgba, colors })
    }
}
