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

    /// The colour at (u, v): u from the left, v from the bottom, both in [0, 1] over the image and repeated beyond.
    /// Between the centres of pixels it is interpolated, first along the row. Not a number where u or v is not.
    #[must_use]
    pub fn sample(&self, u: f64, v: f64) -> [f64; 4] {
        let (left, right, across) = neighbours(u, self.width);
        let (above, below, down) = neighbours(-v, self.height);
        let pixel = |x: usize, y: usize| self.pixels[y * self.width as usize + x].map(f64::from);
        let mut color = [0.0; 4];
        let corners = [pixel(left, above), pixel(right, above), pixel(left, below), pixel(right, below)];
        for (i, value) in color.iter_mut().enumerate() {
            let upper = corners[0][i] + across * (corners[1][i] - corners[0][i]);
            let lower = corners[2][i] + across * (corners[3][i] - corners[2][i]);
            *value = upper + down * (lower - upper);
        }
        color
    }
}

/// The two of `count` pixels whose centres are around a place in [0, 1] of their row, and how far it is on the way
/// from the first to the second.
fn neighbours(place: f64, count: u32) -> (usize, usize, f64) {
    let at = (place - place.floor()) * f64::from(count) - 0.5;
    let first = at.floor();
    // From -1 to count - 1; a place that is not a number gives 0.
    let index = (first as i64).rem_euclid(count.into());
    (index as usize, ((index + 1) % i64::from(count)) as usize, at - first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quarters() -> Image {
        let gray = |v: f32| [v, v, v, 1.0];
        Image::new(2, 2, vec![gray(0.0), gray(1.0), gray(2.0), gray(3.0)]).unwrap()
    }

    #[test]
    fn pixels_are_where_they_should_be() {
        let image = quarters();
        assert_eq!(image.sample(0.25, 0.75), [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(image.sample(0.75, 0.75)[0], 1.0);
        assert_eq!(image.sample(0.25, 0.25)[0], 2.0);
        assert_eq!(image.sample(0.75, -0.75)[0], 3.0);
        assert_eq!(image.sample(0.5, 0.5)[0], 1.5);
        assert_eq!(image.sample(7.0, 0.75)[0], 0.5);
    }

    #[test]
    fn strange_places_are_defined() {
        let image = quarters();
        for v in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(image.sample(v, 0.0)[0].is_nan());
        }
        for v in [1e300, -1e300, -1e-300, f64::MAX] {
            assert!(image.sample(v, v)[0].is_finite());
        }
        assert_eq!(Image::new(1, 1, vec![[0.5; 4]]).unwrap().sample(0.3, 9.1), [0.5; 4]);
        assert!(Image::new(0, 0, vec![]).is_none());
    }
}
