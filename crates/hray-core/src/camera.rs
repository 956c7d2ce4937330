//! Where the picture is taken from.

use glam::DVec3;

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Camera {
    /// The classic camera.
    Window(WindowCamera),
    /// Rays from one point.
    Perspective(PerspectiveCamera),
    /// Parallel rays.
    Orthographic(OrthographicCamera),
}

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
    pub window: [f64; 2],
}

/// A pinhole camera: every ray starts at `from`. Pixels are square, and a pixel stands for its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PerspectiveCamera {
    /// The eye, in world space.
    pub from: DVec3,
    /// What is in the middle of the picture, in world space; not equal to `from`.
    pub to: DVec3,
    /// A direction that points up in the picture; not parallel to the line of sight.
    pub up: DVec3,
    /// Angle from the lower to the upper edge of the picture, in radians, in (0, π).
    pub fov: f64,
}

/// Parallel rays that start in the plane through `from` at right angles to the line of sight. A pixel stands for
/// its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthographicCamera {
    /// The middle of the plane in which rays start, in world space.
    pub from: DVec3,
    /// What is in the middle of the picture, in world space; not equal to `from`.
    pub to: DVec3,
    /// A direction that points up in the picture; not parallel to the line of sight.
    pub up: DVec3,
    /// What the picture's height shows, in world units; positive.
    pub height: f64,
}
