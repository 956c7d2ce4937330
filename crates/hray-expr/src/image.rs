//! Images that functions look things up in.

use std::sync::Arc;

/// An image in linear light: red, green, blue and alpha, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Arc<[[f32; 4]]>,
}

impl Image {
    /// Of pixels row by row from the top; none where there are none, or their number is not width times height.
    #[must_use]
    pub fn new(width: u32, height: u32, pixels: Vec<[f32; 4]>) -> Option<Self> {
        let fits = u64::from(width) * u64::from(height) == pixels.len() as u64 && !pixels.is_empty();
        fits.then(|| Self { width, height, pixels: pixels.into() })
    }

    /// Pixels across.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[[f32; 4]] {
        &self.pixels
    }
}
