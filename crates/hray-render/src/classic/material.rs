//! Materials, prepared.

use super::plans::Plans;
use fearless_simd::prelude::*;
use hray_core::{Field, Function, Texture};
use hray_expr::kernels::lanes::Lanes;
use std::collections::HashMap;
use std::sync::Arc;

/// Columns of what varies over the hits of a frame.
pub(super) const FIELDS: usize = 14;
/// Where the components of colours begin in them, and the numbers are.
pub(super) const COLOR: usize = 0;
const REFLECTION: usize = 3;
const SHINE: usize = 4;
const TRANSMISSION: usize = 5;
const INDEX: usize = 6;
const HIGHLIGHT: usize = 7;
pub(super) const GLOW: usize = 8;
pub(super) const BUMP: usize = 11;

/// A number of a material.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Number {
    Constant(f64),
    /// One for each hit, in that column.
    Column(u8),
}

impl Number {
    /// Whether it is 0 whatever is hit.
    pub(super) fn vanishes(self) -> bool {
        self == Self::Constant(0.0)
    }

    /// Of one hit.
    pub(super) fn of(self, fields: &[&[f64]; FIELDS], hit: usize) -> f64 {
        match self {
            Self::Constant(value) => value,
            Self::Column(column) => fields[usize::from(column)][hit],
        }
    }

    /// Of the hits from `start`.
    #[inline(always)]
    pub(super) fn load<S: Simd>(self, simd: S, fields: &[&[f64]; FIELDS], start: usize) -> Lanes<S> {
        match self {
            Self::Constant(value) => Lanes::<S>::splat(simd, value),
            Self::Column(column) => {
                Lanes::<S>::from_slice(simd, &fields[usize::from(column)][start..start + Lanes::<S>::LEN])
            }
        }
    }
}

/// A function to evaluate for every hit.
#[derive(Clone, Copy)]
pub(super) struct Varying {
    pub(super) plan: u32,
    /// The columns its outputs go to.
    pub(super) first: u8,
    pub(super) count: u8,
}

/// A material with its numbers at hand.
pub(super) struct Material {
    source: Arc<hray_core::Material>,
    pub(super) reflection: Number,
    pub(super) shine: Number,
    pub(super) transmission: Number,
    pub(super) refractive_index: Number,
    pub(super) highlight: Number,
    pub(super) varying: Box<[Varying]>,
    pub(super) has_bumps: bool,
}

impl Material {
    fn new(source: &Arc<hray_core::Material>, plans: &mut Plans) -> Self {
        let mut varying = Vec::new();
        let mut vary = |function: &Arc<Function>, first: usize, count: u8| {
            let plan = plans.of(function, count.into())?;
            varying.push(Varying { plan, first: first as u8, count });
            Some(())
        };
        let mut number = |field: &Field, column: usize| match field {
            Field::Constant(value) => Number::Constant(*value),
            // A function with another number of outputs is none of a number.
            Field::Function(function) => {
                vary(function, column, 1).map_or(Number::Constant(0.0), |()| Number::Column(column as u8))
            }
        };
        let reflection = number(&source.reflection, REFLECTION);
        let shine = number(&source.shine, SHINE);
        let transmission = number(&source.transmission, TRANSMISSION);
        let refractive_index = number(&source.refractive_index, INDEX);
        let highlight = source.highlight.as_ref().map_or(reflection, |field| number(field, HIGHLIGHT));
        for (texture, first) in [(Some(&source.texture), COLOR), (source.glow.as_ref(), GLOW)] {
            if let Some(Texture::Function(function)) = texture {
                vary(function, first, 3);
            }
        }
        let has_bumps = source.bump.as_ref().is_some_and(|bump| vary(bump, BUMP, 3).is_some());
        Self {
            source: source.clone(),
            reflection,
            shine,
            transmission,
            refractive_index,
            highlight,
            varying: varying.into(),
            has_bumps,
        }
    }

    /// Whether a function is evaluated whose outputs begin at that column.
    pub(super) fn varies(&self, first: usize) -> bool {
        self.varying.iter().any(|varying| usize::from(varying.first) == first)
    }

    pub(super) fn texture(&self) -> &Texture {
        &self.source.texture
    }

    pub(super) fn glow(&self) -> Option<&Texture> {
        self.source.glow.as_ref()
    }

    /// Whether shading takes the point in object space.
    pub(super) fn uses_noise(&self) -> bool {
        let noisy = |texture: &Texture| matches!(texture, Texture::Noise(_));
        noisy(&self.source.texture) || self.source.glow.as_ref().is_some_and(noisy)
    }
}

/// The materials of a scene; primitives that share one share it here.
pub(super) struct Materials {
    known: HashMap<usize, u32>,
    last: Option<(usize, u32)>,
    pub(super) list: Vec<Material>,
    pub(super) plans: Plans,
}

impl Materials {
    pub(super) fn new(plans: Plans) -> Self {
        Self { known: HashMap::new(), last: None, list: Vec::new(), plans }
    }

    /// The number of a material.
    pub(super) fn of(&mut self, source: &Arc<hray_core::Material>) -> u32 {
        // What is in the list keeps its source, so the address stays that source's.
        let address = Arc::as_ptr(source).addr();
        if let Some((last, number)) = self.last
            && last == address
        {
            return number;
        }
        let number = *self.known.entry(address).or_insert_with(|| {
            self.list.push(Material::new(source, &mut self.plans));
            self.list.len() as u32 - 1
        });
        self.last = Some((address, number));
        number
    }
}
