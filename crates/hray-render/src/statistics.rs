//! What a render did.

use std::ops::AddAssign;

/// How many rays of each kind were intersected with the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera: one per sample.
    pub camera: u64,
    /// From a hit towards a point light.
    pub shadow: u64,
    /// Mirrored.
    pub reflection: u64,
    /// Refracted, entering or leaving.
    pub refraction: u64,
}

impl RayCounts {
    /// Rays of all kinds.
    #[must_use]
    pub const fn total(&self) -> u64 {
        self.camera + self.shadow + self.reflection + self.refraction
    }
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.camera += other.camera;
        self.shadow += other.shadow;
        self.reflection += other.reflection;
        self.refraction += other.refraction;
    }
}

/// What a finished render did. The same for every number of threads, except that number itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Rays traced.
    pub rays: RayCounts,
    /// Threads that traced them.
    pub threads: usize,
}
