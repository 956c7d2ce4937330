//! A scene in a few numbers.

use crate::{Description, Light, NoiseTexture, Shape, Texture};
use serde::Serialize;
use std::collections::BTreeMap;

/// What the window of the program of 2005 showed of a scene (resolution, objects, lights, depth, camera), and
/// more. It serialises to an object with these names as keys.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// How many times a ray may be reflected or refracted.
    pub max_depth: i32,
    /// Where the picture is taken from.
    pub camera: CameraSummary,
    /// What a ray sees that hits nothing: red, green, blue.
    pub background: [f64; 3],
    /// What can be hit.
    pub objects: Objects,
    /// Lights that shine from a point.
    pub point_lights: usize,
    /// Lights that are everywhere.
    pub ambient_lights: usize,
    /// What the objects are made of.
    pub materials: Materials,
    /// The box around all spheres; none without spheres. Planes have no bounds.
    pub sphere_bounds: Option<Bounds>,
    /// What a pixel can cost.
    pub worst_case: WorstCase,
}

/// The camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CameraSummary {
    /// The eye.
    pub eye: [f64; 3],
    /// Width and height of the window.
    pub window: [i64; 2],
}

/// Objects by shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Objects {
    /// All of them.
    pub total: usize,
    /// Spheres.
    pub spheres: usize,
    /// Planes.
    pub planes: usize,
}

/// Objects by material.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Materials {
    /// How many objects have each kind of texture, under the grammar's names; kinds that do not occur are
    /// left out.
    pub textures: BTreeMap<&'static str, usize>,
    /// Objects that mirror.
    pub reflective: usize,
    /// Objects that let light through.
    pub transparent: usize,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub min: [f64; 3],
    /// The corner with the largest.
    pub max: [f64; 3],
}

/// An upper bound of the work, reached where every ray hits what splits it into most.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct WorstCase {
    /// Rays that one hit can send on: 0, 1 (mirrored or refracted) or 2 (both).
    pub branches: u32,
    /// Rays a sample, shadow rays included; none where they are more than 2^64.
    pub rays_per_sample: Option<u64>,
}

impl Summary {
    /// The summary of a description.
    #[must_use]
    pub fn of(description: &Description) -> Self {
        let Description { resolution, max_depth, scene } = description;
        let spheres = scene.primitives.iter().filter(|p| matches!(p.shape, Shape::Sphere(_))).count();
        let total = scene.primitives.len();
        let point_lights = scene.lights.iter().filter(|light| matches!(light, Light::Point { .. })).count();
        let materials = || scene.primitives.iter().map(|primitive| &primitive.material);
        let mut textures = BTreeMap::new();
        for material in materials() {
            *textures.entry(texture_name(&material.texture)).or_insert(0) += 1;
        }
        let branches = materials()
            .map(|material| u32::from(material.reflection != 0.0) + u32::from(material.transmission != 0.0))
            .max()
            .unwrap_or(0);
        Self {
            width: resolution.width(),
            height: resolution.height(),
            max_depth: *max_depth,
            camera: CameraSummary { eye: scene.camera.eye.to_array(), window: scene.camera.window },
            background: scene.background.to_array(),
            objects: Objects { total, spheres, planes: total - spheres },
            point_lights,
            ambient_lights: scene.lights.len() - point_lights,
            materials: Materials {
                textures,
                reflective: materials().filter(|material| material.reflection != 0.0).count(),
                transparent: materials().filter(|material| material.transmission != 0.0).count(),
            },
            sphere_bounds: bounds(description),
            worst_case: WorstCase {
                branches,
                rays_per_sample: if total == 0 {
                    Some(u64::from(*max_depth >= 0))
                } else {
                    worst_case(branches, *max_depth, point_lights)
                },
            },
        }
    }

    /// The size of the picture.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

fn texture_name(texture: &Texture) -> &'static str {
    match texture {
        Texture::Solid(_) => "solid",
        Texture::Noise(NoiseTexture::Solid { .. }) => "perlinSolid",
        Texture::Noise(NoiseTexture::SemiTurbulence { .. }) => "perlinSemiTurb",
        Texture::Noise(NoiseTexture::Turbulence { .. }) => "perlinTurb",
        Texture::Noise(NoiseTexture::Fire { .. }) => "perlinFire",
        Texture::Noise(NoiseTexture::Plasma { .. }) => "perlinPlasma",
        Texture::Noise(NoiseTexture::Marble { .. }) => "perlinMarble",
        Texture::Noise(NoiseTexture::MarbleBase { .. }) => "perlinMarbleBase",
        Texture::Noise(NoiseTexture::Wood { .. }) => "perlinWood",
    }
}

fn bounds(description: &Description) -> Option<Bounds> {
    description
        .scene
        .primitives
        .iter()
        .filter_map(|primitive| match primitive.shape {
            Shape::Sphere(sphere) => {
                let radius = sphere.radius.abs();
                Some(((sphere.center - radius), (sphere.center + radius)))
            }
            Shape::Plane(_) => None,
        })
        .reduce(|(min, max), (other_min, other_max)| (min.min(other_min), max.max(other_max)))
        .map(|(min, max)| Bounds { min: min.to_array(), max: max.to_array() })
}

/// The rays of levels 0 to `max_depth`, each level `branches` times as many as the one before, and a shadow
/// ray to every point light for each of them.
fn worst_case(branches: u32, max_depth: i32, point_lights: usize) -> Option<u64> {
    let (mut level, mut rays) = (1u64, 0u64);
    for _ in 0..=max_depth {
        rays = rays.checked_add(level)?;
        level = level.saturating_mul(u64::from(branches));
        if level == 0 {
            break;
        }
    }
    rays.checked_mul(1 + point_lights as u64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LintLevels, SceneFile};

    fn summary(depth: i32, objects: &str, lights: &str) -> Summary {
        let text = format!(
            "renderDescr ( resolution (40,30) ) {depth} [ scene {{ camera (0.0,0.0,150.0) (100,75) }}
             {{ background (0.2,0.3,0.5) }} {{ objects {objects} }} {{ lights {lights} }} ]"
        );
        let file = SceneFile::parse("t.hry", text.into(), &LintLevels::default());
        Summary::of(file.description().unwrap_or_else(|| panic!("{}", file.report(false))))
    }

    fn sphere(center: &str, reflection: &str, transparency: &str) -> String {
        format!(
            "(object ( sphere 10.0 {center} ) ( texture ( diff solid (0.1,0.2,0.3) )
             {reflection} 20 {transparency} 1.0 ))"
        )
    }

    #[test]
    fn an_empty_scene_is_counted() {
        let summary = summary(3, "", "");
        assert_eq!((summary.width, summary.height, summary.max_depth), (40, 30, 3));
        assert_eq!(summary.camera, CameraSummary { eye: [0.0, 0.0, 150.0], window: [100, 75] });
        assert_eq!((summary.objects.total, summary.sphere_bounds), (0, None));
        assert_eq!(summary.worst_case, WorstCase { branches: 0, rays_per_sample: Some(1) });
    }

    #[test]
    fn objects_are_counted_by_kind_and_bounded() {
        let plane = "(object ( plane (0.0,1.0,0.0,50.0) )
                     ( texture ( diff perlin ( perlinPlasma 10.0 ) ) 0.0 20 0.0 0.0 ))";
        let spheres = sphere("(0.0,0.0,-50.0)", "0.5", "0.0") + &sphere("(30.0,0.0,-50.0)", "0.0", "0.5");
        let lights = "(ambientLight (0.1,0.1,0.1)) (pointLight (0.0,9.0,9.0) (1.0,1.0,1.0))";
        let summary = summary(2, &format!("{plane} {spheres}"), lights);
        assert_eq!(summary.objects, Objects { total: 3, spheres: 2, planes: 1 });
        assert_eq!((summary.point_lights, summary.ambient_lights), (1, 1));
        assert_eq!((summary.materials.reflective, summary.materials.transparent), (1, 1));
        let textures: Vec<_> = summary.materials.textures.into_iter().collect();
        assert_eq!(textures, [("perlinPlasma", 1), ("solid", 2)]);
        let bounds = Bounds { min: [-10.0, -10.0, -60.0], max: [40.0, 10.0, -40.0] };
        assert_eq!(summary.sphere_bounds, Some(bounds));
        // Three levels of one ray each, and a shadow ray for each of them.
        assert_eq!(summary.worst_case, WorstCase { branches: 1, rays_per_sample: Some(6) });
    }

    #[test]
    fn the_worst_case_doubles_with_the_depth_until_it_is_no_number() {
        let ball = sphere("(0.0,0.0,-50.0)", "0.5", "0.5");
        let rays = |depth| summary(depth, &ball, "").worst_case.rays_per_sample;
        assert_eq!([rays(-1), rays(0), rays(1), rays(9)], [Some(0), Some(1), Some(3), Some(1023)]);
        assert_eq!(rays(62), Some((1 << 63) - 1));
        assert_eq!(rays(64), None);
        assert_eq!(rays(10_000), None);
    }
}
