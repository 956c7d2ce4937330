//! Surfaces given by a function.

use crate::Function;
use glam::DVec3;
use std::sync::Arc;

/// An implicit surface: all points of a box, in object space, where a function is 0. Inside is where it is negative; where the
/// box cuts that, it closes it.
///
/// Surface parameters: those of a sphere ([`crate::Sphere`]), of the direction from the middle of the box.
#[derive(Clone, Debug, PartialEq)]
pub struct Implicit {
    /// A function of the position in object space; of its results only the first counts. Any unit.
    pub function: Arc<Function>,
    /// The corner of the box with the smallest coordinates, in object space; finite.
    pub min: DVec3,
    /// The corner with the largest coordinates; each is larger.
    pub max: DVec3,
}
