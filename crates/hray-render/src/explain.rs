//! How a pixel came by its colour: the rays that were followed for it, what they met, and what each light gave.

use crate::classic::{Integrator, Owners, Recorder, TooManyParts};
use crate::render::{Job, Worker};
use crate::{Control, MAX_SOLID_PARTS, Region, Settings};
use hray_core::{DVec3, Description, NoiseTables, Resolution, Rgb};
use std::fmt;
use std::num::NonZeroU32;

/// So many rays of a pixel are told of; the others are followed, and counted.
pub const MAX_EXPLAINED_RAYS: usize = 4096;

/// How a pixel came by its colour.
#[derive(Clone, Debug, PartialEq)]
pub struct PixelExplanation {
    /// The pixel's colour, to the bit as [`crate::render`] gives it: the mean over its samples.
    pub color: Rgb,
    /// How many samples that is the mean of.
    pub samples: u32,
    /// What the samples see, what most of them see first.
    pub seen: Vec<Seen>,
    /// The rays that are followed for the pixel's own point, each before those that it leads to: first the ray from the
    /// camera, then all of its mirrored ray, then all of its refracted ray. None where the depth is -1. With one sample the
    /// first one's colour is the pixel's; with more the pixel's own point (mostly its centre) need not be one of the samples.
    pub rays: Vec<ExplainedRay>,
    /// How many rays were followed beyond the [`MAX_EXPLAINED_RAYS`] that are listed.
    pub omitted: u64,
}

/// What some of the samples of a pixel see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Seen {
    /// The object; none for the background.
    pub object: Option<ObjectId>,
    /// How many samples see it.
    pub samples: u32,
}

/// An object of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ObjectId {
    /// Its place in [`hray_core::Scene::primitives`].
    pub primitive: usize,
    /// Where it is a solid: the part whose surface is meant, by its place in [`hray_core::Primitive::leaves`].
    pub part: Option<usize>,
}

/// Why a ray is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the camera through the pixel.
    Camera,
    /// Mirrored by a surface.
    Reflection,
    /// Let through by a surface.
    Transmission,
    /// Mirrored inside something transparent, because it cannot leave at this angle.
    InnerReflection,
}

/// A ray, and what it brings back.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplainedRay {
    /// Why it is followed.
    pub kind: RayKind,
    /// The ray that leads to it, by its place in [`PixelExplanation::rays`]; none for the first.
    pub parent: Option<usize>,
    /// How many times it was mirrored or refracted so far.
    pub level: u32,
    /// Where it starts, in world space.
    pub origin: DVec3,
    /// Where it leads; a unit vector.
    pub direction: DVec3,
    /// What the parent multiplies its colour with before adding it; 1 for the first.
    pub weight: f64,
    /// The colour that it brings back: that of the background, or the clipped sum of what its hit gives off.
    pub color: Rgb,
    /// The nearest thing that it meets; none where it sees the background.
    pub hit: Option<ExplainedHit>,
}

/// What a ray meets, and the light that comes from there.
#[derive(Clone, Debug, PartialEq)]
pub struct ExplainedHit {
    /// The object.
    pub object: ObjectId,
    /// Where that is a mesh, the triangle, by its place in the mesh.
    pub triangle: Option<u32>,
    /// How far along the ray.
    pub distance: f64,
    /// The point, in world space.
    pub point: DVec3,
    /// The normal that is shaded with. By the exact rules it faces the viewer, by the thesis' it leads outward.
    pub normal: DVec3,
    /// Whether the surface is seen from inside the object.
    pub inside: bool,
    /// The surface's own colour here.
    pub base: Rgb,
    /// The share of mirrored light.
    pub reflection: f64,
    /// The share of light let through.
    pub transmission: f64,
    /// The index of refraction.
    pub refractive_index: f64,
    /// The strength of the highlight.
    pub highlight: f64,
    /// The exponent of the highlight.
    pub shine: f64,
    /// What each light gives, in the order of [`hray_core::Scene::lights`].
    pub lights: Vec<LightPart>,
    /// The light that the surface gives off by itself.
    pub glow: Rgb,
    /// What became of the mirrored light.
    pub mirrored: Followed,
    /// What became of the light let through.
    pub refracted: Followed,
    /// The sum of all of this, before it is clipped to [0, 1].
    pub sum: Rgb,
}

/// What became of the mirrored or refracted ray of a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Followed {
    /// The surface does not ask for it.
    NotAsked,
    /// It is among the rays (unless those are too many).
    Yes,
    /// It would go deeper than the picture's depth allows, and counts as black.
    TooDeep,
    /// It cannot leave the object at this angle, and by the thesis' rules is lost.
    Lost,
}

/// What a light gives to a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightPart {
    /// Whether it reaches the hit.
    pub reach: Reach,
    /// How far away the light is; infinite for a directional one, 0 for an ambient one.
    pub distance: f64,
    /// What is scattered to all sides; of an ambient light, all.
    pub diffuse: Rgb,
    /// The highlight.
    pub highlight: Rgb,
    /// Both together, which is what it adds to the hit.
    pub contribution: Rgb,
}

/// Whether a light reaches a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// It is ambient: everywhere.
    Everywhere,
    /// Nothing is in the way.
    Lit,
    /// The surface faces away from it.
    Behind,
    /// The point is outside the cone of a spotlight.
    OutsideCone,
    /// Something is in the way.
    Shadowed {
        /// The nearest such thing.
        by: ObjectId,
        /// How far it is from the hit.
        distance: f64,
    },
}

/// Why a pixel is not explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExplainError {
    /// There is no such pixel.
    Outside {
        /// The pixel that was asked for.
        pixel: [u32; 2],
        /// The size of the picture.
        resolution: Resolution,
    },
    /// [`Control::cancel`] was called.
    Cancelled,
    /// The solids of the scene have more than [`MAX_SOLID_PARTS`] parts together.
    Solids,
    /// The parts do not add up to the colour, which is a fault of hray's.
    Sum,
}

impl fmt::Display for ExplainError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Outside { pixel: [x, y], resolution } => write!(
                f,
                "there is no pixel ({x}, {y}): the picture has {resolution} pixels, so x goes from 0 at the left to {}, and \
                 y from 0 at the top to {}",
                resolution.width() - 1,
                resolution.height() - 1
            ),
            Self::Cancelled => f.write_str("the explanation was stopped"),
            Self::Solids => write!(f, "the solids of the scene have more than {MAX_SOLID_PARTS} parts"),
            Self::Sum => f.write_str(
                "the parts of this pixel's light do not add up to its colour; this is a fault of hray's, please report it",
            ),
        }
    }
}

impl std::error::Error for ExplainError {}

/// Explains the pixel `x` from the left and `y` from the top, both counted from 0, of the picture that [`crate::render`]
/// makes with these settings; their region and threads do not matter. That all parts add up to the colour, to the bit, is
/// checked.
///
/// # Errors
/// [`ExplainError`].
pub fn explain(
    description: &Description,
    tables: &NoiseTables,
    settings: &Settings,
    [x, y]: [u32; 2],
    control: &Control,
) -> Result<PixelExplanation, ExplainError> {
    let outside = ExplainError::Outside { pixel: [x, y], resolution: settings.resolution };
    let region = Region::new(x, y, 1, 1, settings.resolution).map_err(|_| outside)?;
    let settings = Settings { region, ..*settings };
    let owners = Owners::of(&description.scene.primitives);
    let integrator = Integrator::new(description, tables).map_err(|TooManyParts| ExplainError::Solids)?;
    let pixel = |integrator: Integrator, settings: &Settings, recorder: Recorder| {
        let job = Job::new(integrator, settings, control, 1);
        let mut worker = Worker::new(&job);
        worker.scratch.record(recorder);
        let color = worker.render(0).map_err(|_| ExplainError::Cancelled)?.first().copied();
        let recorder = worker.scratch.recorded().ok_or(ExplainError::Sum)?;
        drop(worker);
        Ok((job.integrator, color.unwrap_or(Rgb::BLACK), recorder))
    };
    let samples = settings.samples;
    let own = Settings { samples: NonZeroU32::MIN, ..settings };
    let (integrator, sampled) = if samples == NonZeroU32::MIN {
        (integrator, None)
    } else {
        let (integrator, color, recorder) = pixel(integrator, &settings, Recorder::of_samples())?;
        (integrator, Some((color, recorder)))
    };
    let (_, own_color, recorder) = pixel(integrator, &own, Recorder::of_rays(owners.clone()))?;
    let (rays, omitted) = recorder.rays().ok_or(ExplainError::Sum)?;
    if rays.first().is_some_and(|ray| !same(ray.color, own_color)) {
        return Err(ExplainError::Sum);
    }
    let (color, seen) = match sampled {
        Some((color, recorder)) => (color, recorder.seen(&owners)),
        None => {
            let seen =
                |ray: &ExplainedRay| Seen { object: ray.hit.as_ref().map(|hit| hit.object), samples: 1 };
            (own_color, rays.first().map(seen).into_iter().collect())
        }
    };
    Ok(PixelExplanation { color, samples: samples.get(), seen, rays, omitted })
}

/// Whether two colours are the same to the bit; what is no number is like any other such.
pub(crate) fn same(a: Rgb, b: Rgb) -> bool {
    let both = a.to_array().into_iter().zip(b.to_array());
    both.into_iter().all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
}
