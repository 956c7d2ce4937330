//! Colours over a surface.

use crate::Rgb;
use glam::DVec3;
use hray_expr::Function;
use std::sync::Arc;

/// The diffuse colour of a material: the thesis' `Diff` (§3.3).
#[derive(Clone, Debug, PartialEq)]
pub enum Texture {
    /// The same everywhere.
    Solid(Rgb),
    /// One of the eight textures of 2005, made of Perlin's noise of 1985, at the object-space position.
    Noise(NoiseTexture),
    /// Any function of the hit. Three outputs: red, green, blue.
    Function(Arc<Function>),
}

/// The eight noise textures of thesis §3.4 and appendix A.3.
///
/// `grid` is the edge of a noise cell in world units. `octaves` is the thesis' `freq`: n octaves above the
/// first, so n + 1 evaluations of noise a point; never negative. "noise" is Perlin's gradient noise,
/// "turbulence" the sum over octaves k = 0..=n of |noise(2^k p)| / 2^k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoiseTexture {
    /// `perlinSolid`: base (noise + 1) / 2.
    Solid {
        /// The colour that is scaled.
        base: Rgb,
        /// Cell size.
        grid: f64,
    },
    /// `perlinSemiTurb`: base (s + 1) / 2, where s sums noise (with its sign) over the octaves.
    SemiTurbulence {
        /// The colour that is scaled.
        base: Rgb,
        /// Octaves above the first.
        octaves: u32,
        /// Cell size.
        grid: f64,
    },
    /// `perlinTurb`: base turbulence.
    Turbulence {
        /// The colour that is scaled.
        base: Rgb,
        /// Octaves above the first.
        octaves: u32,
        /// Cell size.
        grid: f64,
    },
    /// `perlinFire`: clip(added + base turbulence). The grammar writes the added colour first.
    Fire {
        /// The colour that is added.
        added: Rgb,
        /// The colour that is scaled.
        base: Rgb,
        /// Octaves above the first.
        octaves: u32,
        /// Cell size.
        grid: f64,
    },
    /// `perlinPlasma`: (noise + 1) / 2 of one permutation table per component.
    Plasma {
        /// Cell size.
        grid: f64,
    },
    /// `perlinMarble`: base (sin(p · direction + power turbulence) + 1) / 2.
    Marble {
        /// The colour that is scaled.
        base: Rgb,
        /// Octaves above the first.
        octaves: u32,
        /// Cell size.
        grid: f64,
        /// Direction across the veins; its length is their frequency, in radians per unit.
        direction: DVec3,
        /// How strongly turbulence bends the veins.
        power: f64,
    },
    /// `perlinMarbleBase`: clip(added + marble). The grammar writes the base colour first.
    MarbleBase {
        /// The colour that is scaled.
        base: Rgb,
        /// The colour that is added.
        added: Rgb,
        /// Octaves above the first.
        octaves: u32,
        /// Cell size.
        grid: f64,
        /// Direction across the veins; its length is their frequency, in radians per unit.
        direction: DVec3,
        /// How strongly turbulence bends the veins.
        power: f64,
    },
    /// `perlinWood`: with v = |sin(rings (|p| + power turbulence))| / 4, clip(base + v) where v < 1/2 (which
    /// is everywhere, but for NaN) and base itself elsewhere. Rings are measured from the origin.
    Wood {
        /// The colour that is lightened.
        base: Rgb,
        /// Octaves above the first.
        octaves: u32,
        /// Cell size.
        grid: f64,
        /// Rings per unit of distance, in radians.
        rings: f64,
        /// How strongly turbulence bends the rings.
        power: f64,
    },
}
