//! What a surface does with light.

use crate::Texture;

/// The material of a primitive: the thesis' `Texture` (§2.3.1).
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The diffuse colour, which may vary over the surface (the thesis' `Diff`).
    pub texture: Texture,
    /// Reflection coefficient (`reflCoef`), nominally in [0, 1]. It scales the mirrored light and also the
    /// highlight; at exactly 0 no reflection ray is traced.
    pub reflection: f64,
    /// Exponent of the highlight (`specCoef`): the larger, the smaller and sharper.
    pub shine: i64,
    /// Transparency coefficient (`refrCoef`), nominally in [0, 1]. At exactly 0 no refraction ray is traced.
    pub transmission: f64,
    /// Index of refraction of the inside relative to the outside (`refrIndex`). Meaningful, and then
    /// positive, only where `transmission` is not 0.
    pub refractive_index: f64,
}
