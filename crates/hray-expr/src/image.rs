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

impl Image {
    /// The colour and opacity at (u, v): u from the left, v from the bottom, 0 to 1 over the image and repeated beyond;
    /// bilinear between the centres of pixels. 0 where u or v is not finite.
    #[must_use]
    pub fn sample(&self, u: f64, v: f64) -> [f64; 4] {
        if !(u.is_finite() && v.is_finite()) {
            return [0.0; 4];
        }
        let place = |t: f64, size: u32| {
            let size = f64::from(size);
            let x = (t - t.floor()) * size - 0.5;
            let low = x.floor();
            let wrap = |i: f64| {
                if i < 0.0 {
                    i + size
                } else if i >= size {
                    i - size
                } else {
                    i
                }
            };
            (wrap(low) as usize, wrap(low + 1.0) as usize, x - low)
        };
        let (x0, x1, fx) = place(u, self.width);
        let (y0, y1, fy) = place(1.0 - v, self.height);
        let pixel = |x: usize, y: usize| self.pixels[y * self.width as usize + x];
        let corners = [pixel(x0, y0), pixel(x1, y0), pixel(x0, y1), pixel(x1, y1)];
        std::array::from_fn(|i| {
            let [a, b, c, d] = corners.map(|corner| f64::from(corner[i]));
            let (low, high) = (a + fx * (b - a), c + fx * (d - c));
            low + fy * (high - low)
        })
    }
}
