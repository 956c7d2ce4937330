//! Where the picture is taken from.

use glam::DVec3;

/// The classic camera: an eye behind (or before) a window in the plane z = 0, centred on the origin.
///
/// A pixel (px, py) of a picture of rx by ry pixels, counted from the lower left, stands for the window
/// point ((px - rx/2) w / rx, (py - ry/2) h / ry, 0); the primary ray **starts at that point**, not at the
/// eye, and leads away from the eye. Thesis §2.3.2, `mapToWin` and `rayTracePt`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowCamera {
    /// The eye, in world space. The thesis keeps it on the z axis; any point will do.
    pub eye: DVec3,
    /// Width and height of the window, in world units. The classic grammar writes whole numbers; a negative
    /// one mirrors the picture, and zero makes every ray start on one line.
    pub window: [i64; 2],
}
