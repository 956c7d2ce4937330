//! A scene: everything that determines the picture except its size.

use crate::{Camera, Light, Material, Rgb, Shape};
use glam::DAffine3;
use hray_expr::Function;
use std::sync::Arc;

/// A shape with the material it is made of: the thesis' `TexturedObject`.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// The geometry, in object space.
    pub shape: Shape,
    /// From object space to world space (for an operand of [`crate::Csg`]: to the space of the whole); invertible.
    /// Object space is world space where there is none.
    pub transform: Option<Arc<DAffine3>>,
    /// The material. Where the shape is a [`Shape::Csg`] it is not used: its operands have theirs.
    pub material: Arc<Material>,
}

/// What a ray sees that hits nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// The same in every direction.
    Uniform(Rgb),
    /// A function of the direction in which one looks: a unit vector, given as the world-space and the object-space
    /// position. Three outputs.
    Function(Arc<Function>),
}

/// A scene as plain data, primitives and lights in the order of the source.
///
/// Order matters to the bit: of two primitives hit at the same distance the one written **last** is seen,
/// and the contributions of lights are summed from the last to the first. (The classic grammar builds its
/// lists reversed; the reversal is done where the lists are consumed.)
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// What a ray sees that hits nothing.
    pub background: Background,
    /// What can be hit, in source order.
    pub primitives: Vec<Primitive>,
    /// The lights, in source order.
    pub lights: Vec<Light>,
    /// The moment that is shown, in seconds; 0 for a still.
    pub time: f64,
}
