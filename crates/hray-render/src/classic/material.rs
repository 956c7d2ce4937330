//! Materials, prepared.

use hray_core::{Field, Texture};

/// A material with its coefficients at hand.
pub(super) struct Material {
    pub(super) texture: Texture,
    pub(super) reflection: f64,
    pub(super) shine: f64,
    pub(super) transmission: f64,
    pub(super) refractive_index: f64,
}

impl Material {
    pub(super) fn new(material: &hray_core::Material) -> Self {
        let number = |field: &Field| field.constant().unwrap_or(0.0);
        Self {
            texture: material.texture.clone(),
            reflection: number(&material.reflection),
            shine: number(&material.shine),
            transmission: number(&material.transmission),
            refractive_index: number(&material.refractive_index),
        }
    }
}
