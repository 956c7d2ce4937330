//! A scene: everything that determines the picture except its size.

use crate::{Light, Material, Rgb, Shape, WindowCamera};

/// A shape with the material it is made of: the thesis' `TexturedObject`.
#[derive(Clone, Debug, PartialEq)]
pub struct Primitive {
    /// The geometry.
    pub shape: Shape,
    /// The material.
    pub material: Material,
}

/// A scene as plain data, primitives and lights in the order of the source.
///
/// Order matters to the bit: of two primitives hit at the same distance the one written **last** is seen,
/// and the contributions of lights are summed from the last to the first. (The classic grammar builds its
/// lists reversed; the reversal is done where the lists are consumed.)
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The camera.
    pub camera: WindowCamera,
    /// What a ray sees that hits nothing.
    pub background: Rgb,
    /// What can be hit, in source order.
    pub primitives: Vec<Primitive>,
    /// The lights, in source order.
    pub lights: Vec<Light>,
}
