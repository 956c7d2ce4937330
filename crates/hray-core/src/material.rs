//! What a surface does with light.

use crate::{Field, Texture};
use hray_expr::Function;
use std::sync::Arc;

/// The material of a primitive: the thesis' `Texture` (§2.3.1), of which every part may vary over the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The diffuse colour (the thesis' `Diff`).
    pub texture: Texture,
    /// Reflection coefficient (`reflCoef`), nominally in [0, 1]. It scales the mirrored light and, unless
    /// `highlight` says otherwise, the highlight; at exactly 0 no reflection ray is traced.
    pub reflection: Field,
    /// Exponent of the highlight (`specCoef`): the larger, the smaller and sharper. A whole number in the classic
    /// grammar.
    pub shine: Field,
    /// Transparency coefficient (`refrCoef`), nominally in [0, 1]. At exactly 0 no refraction ray is traced.
    pub transmission: Field,
    /// Index of refraction of the inside relative to the outside (`refrIndex`). Meaningful, and then
    /// positive, only where `transmission` is not 0.
    pub refractive_index: Field,
    /// Strength of the highlight; that of `reflection` where none is given, as in the thesis.
    pub highlight: Option<Field>,
    /// Light that the surface gives off by itself, whatever falls on it; black where none is given.
    pub glow: Option<Texture>,
    /// Bumps: the gradient, with respect to the object-space position, of the height of the surface above the
    /// shape. Three outputs. It tilts the normal used for shading and mirroring.
    pub bump: Option<Arc<Function>>,
}

impl Material {
    /// A material that only has a colour.
    #[must_use]
    pub const fn matte(texture: Texture) -> Self {
        Self {
            texture,
            reflection: Field::Constant(0.0),
            shine: Field::Constant(0.0),
            transmission: Field::Constant(0.0),
            refractive_index: Field::Constant(0.0),
            highlight: None,
            glow: None,
            bump: None,
        }
    }
}
