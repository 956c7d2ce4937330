//! The pixels of a finished picture, until another takes its place.

use crate::frame::{Frame, Pixels};
use hray::{Picture, PictureFormat, Rgb};
use sha2::{Digest, Sha256};

/// The most pixels whose colours are kept, 24 bytes each.
const MOST_KEPT: u64 = 1 << 22;

/// A picture that is being put together.
pub(super) struct Film {
    width: u32,
    colors: Vec<Rgb>,
}

impl Film {
    /// An empty one; none where the picture is too large to be kept.
    pub(super) fn new(frame: &Frame) -> Option<Self> {
        let resolution = frame.resolution();
        let count = u64::from(resolution.width()) * u64::from(resolution.height());
        if count > MOST_KEPT {
            return None;
        }
        let mut colors = Vec::new();
        colors.try_reserve_exact(count as usize).ok()?;
        colors.resize(count as usize, Rgb::BLACK);
        Some(Self { width: resolution.width(), colors })
    }

    /// Puts a tile of the last pass in its place.
    pub(super) fn put(&mut self, pixels: &Pixels) {
        let [x, y, width, _, _] = pixels.place;
        for (row, colors) in pixels.colors.chunks_exact(width.max(1) as usize).enumerate() {
            let start = (y as usize + row) * self.width as usize + x as usize;
            if let Some(place) = self.colors.get_mut(start..start + colors.len()) {
                place.copy_from_slice(colors);
            }
        }
    }

    /// The picture.
    pub(super) fn develop(self, frame: &Frame) -> Option<Picture> {
        let resolution = frame.resolution();
        Picture::new(resolution.width(), resolution.height(), frame.encoding(), self.colors)
    }
}

/// SHA-256 of a picture as a PPM file (P6).
pub(super) fn hash_of(picture: &Picture) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("P6\n{} {}\n255\n", picture.width(), picture.height()));
    for run in picture.pixels().chunks(4096) {
        hash.update(PictureFormat::Ppm.encode(run, picture.encoding()));
    }
    crate::files::hex(&hash.finalize())
}
