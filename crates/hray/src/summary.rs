//! A scene in a few numbers.

use crate::{
    Background, Camera, DMat3, DVec3, Description, Encoding, Field, Function, Integrator, Light, Material,
    Mesh, NoiseTexture, Primitive, Scene, Shape, Texture,
};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// So many parts of solids are looked at; beyond, the summary is of these.
const MOST_PARTS: usize = 1 << 24;

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
    /// Samples a pixel.
    pub samples: u32,
    /// How light is followed: `classic2005` or `whitted`.
    pub integrator: &'static str,
    /// What becomes of colours in a file: `raw` or `srgb`.
    pub encoding: &'static str,
    /// The moment that is shown, in seconds.
    pub time: f64,
    /// Where the picture is taken from.
    pub camera: CameraSummary,
    /// What a ray sees that hits nothing: red, green, blue; none where that is a function of its direction.
    pub background: Option<[f64; 3]>,
    /// What can be hit.
    pub objects: Objects,
    /// Lights that shine from a point.
    pub point_lights: usize,
    /// Lights that are everywhere.
    pub ambient_lights: usize,
    /// Lights that shine from infinitely far away.
    pub directional_lights: usize,
    /// Lights that shine into a cone.
    pub spot_lights: usize,
    /// What the objects are made of.
    pub materials: Materials,
    /// Functions that are evaluated for every hit, or for every direction of the background.
    pub functions: usize,
    /// The meshes that the objects are made of; none where there are none.
    pub meshes: Option<Meshes>,
    /// The box around all spheres in the scene's list; none without spheres.
    pub sphere_bounds: Option<Bounds>,
    /// What a pixel can cost.
    pub worst_case: WorstCase,
}

/// The camera.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum CameraSummary {
    /// The classic camera.
    Window {
        /// The eye.
        eye: [f64; 3],
        /// Width and height of the window.
        window: [f64; 2],
    },
    /// Rays from one point.
    Perspective {
        /// The eye.
        from: [f64; 3],
        /// What is in the middle.
        to: [f64; 3],
        /// Angle from the lower to the upper edge, in radians.
        fov: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// The middle of the plane that the rays start in.
        from: [f64; 3],
        /// What is in the middle.
        to: [f64; 3],
        /// What the picture's height shows.
        height: f64,
    },
}

impl CameraSummary {
    fn of(camera: &Camera) -> Self {
        match camera {
            Camera::Window(camera) => Self::Window { eye: camera.eye.to_array(), window: camera.window },
            Camera::Perspective(camera) => {
                Self::Perspective { from: camera.from.to_array(), to: camera.to.to_array(), fov: camera.fov }
            }
            Camera::Orthographic(camera) => Self::Orthographic {
                from: camera.from.to_array(),
                to: camera.to.to_array(),
                height: camera.height,
            },
        }
    }
}

/// Objects by shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Objects {
    /// All of them.
    pub total: usize,
    /// Spheres.
    pub spheres: usize,
    /// Planes.
    pub planes: usize,
    /// Boxes.
    pub boxes: usize,
    /// Curved shapes but spheres: cylinders and cones, discs, tori, quadrics.
    pub round: usize,
    /// Implicit surfaces.
    pub implicit: usize,
    /// Those made of others: solids by constructive solid geometry, and what is clipped.
    pub csg: usize,
    /// Triangle meshes; one that is placed many times counts each time.
    pub meshes: usize,
}

impl Objects {
    fn of(primitives: &[Primitive]) -> Self {
        let mut objects = Self { total: primitives.len(), ..Self::default() };
        for primitive in primitives {
            *match primitive.shape {
                Shape::Sphere(_) => &mut objects.spheres,
                Shape::Plane(_) => &mut objects.planes,
                Shape::Cuboid(_) => &mut objects.boxes,
                Shape::Frustum(_) | Shape::Disc(_) | Shape::Torus(_) | Shape::Quadric(_) => {
                    &mut objects.round
                }
                Shape::Implicit(_) => &mut objects.implicit,
                Shape::Csg(_) | Shape::Inverse(_) | Shape::Clip(_) => &mut objects.csg,
                Shape::Mesh(_) => &mut objects.meshes,
            } += 1;
        }
        objects
    }
}

/// Meshes, each counted once however often it is placed, but for their box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Meshes {
    /// How many different ones.
    pub count: usize,
    /// Their triangles.
    pub triangles: usize,
    /// The triangles that can be hit: those of a mesh that is placed many times count each time.
    pub placed_triangles: usize,
    /// Their vertices.
    pub vertices: usize,
    /// The memory that they take, in bytes.
    pub bytes: usize,
    /// The box around all of them where they are placed; none where no triangle has finite coordinates.
    pub bounds: Option<Bounds>,
}

impl Meshes {
    fn of(primitives: &[Primitive]) -> Option<Self> {
        let placed = primitives.iter().filter_map(|primitive| match &primitive.shape {
            Shape::Mesh(mesh) => Some((mesh, primitive.transform.as_deref())),
            _ => None,
        });
        let mut meshes: Vec<&Arc<Mesh>> = placed.clone().map(|(mesh, _)| mesh).collect();
        let placed_triangles = meshes.iter().map(|mesh| mesh.triangles().len()).sum();
        meshes.sort_unstable_by_key(|mesh| Arc::as_ptr(mesh));
        meshes.dedup_by_key(|mesh| Arc::as_ptr(mesh));
        let bounds = placed.filter_map(|(mesh, transform)| mesh.bounds_under(transform));
        let bounds = bounds.reduce(|[min, max], [low, high]| [min.min(low), max.max(high)]);
        let sum = |part: fn(&Mesh) -> usize| meshes.iter().map(|mesh| part(mesh)).sum();
        (!meshes.is_empty()).then(|| Self {
            count: meshes.len(),
            triangles: sum(|mesh| mesh.triangles().len()),
            placed_triangles,
            vertices: sum(|mesh| mesh.positions().len()),
            bytes: sum(Mesh::bytes),
            bounds: bounds.map(|[min, max]| Bounds { min: min.to_array(), max: max.to_array() }),
        })
    }
}

/// Objects, and parts of solids, by material.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Materials {
    /// How many have each kind of texture, under the classic grammar's names; kinds that do not occur are left
    /// out.
    pub textures: BTreeMap<&'static str, usize>,
    /// How many mirror.
    pub reflective: usize,
    /// How many let light through.
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
        let Description { resolution, max_depth, samples, integrator, encoding, scene } = description;
        let lights = |kind: fn(&Light) -> bool| scene.lights.iter().filter(|light| kind(light)).count();
        let ambient_lights = lights(|light| matches!(light, Light::Ambient { .. }));
        let objects = Objects::of(&scene.primitives);
        let mut materials = Materials { textures: BTreeMap::new(), reflective: 0, transparent: 0 };
        let mut branches = 0;
        for material in parts(scene) {
            let [reflects, transmits] =
                [&material.reflection, &material.transmission].map(|field| usize::from(!field.is_zero()));
            *materials.textures.entry(texture_name(&material.texture)).or_insert(0) += 1;
            materials.reflective += reflects;
            materials.transparent += transmits;
            branches = branches.max((reflects + transmits) as u32);
        }
        Self {
            width: resolution.width(),
            height: resolution.height(),
            max_depth: *max_depth,
            samples: samples.get(),
            integrator: match integrator {
                Integrator::Classic2005 => "classic2005",
                Integrator::Classic => "whitted",
            },
            encoding: match encoding {
                Encoding::Raw => "raw",
                Encoding::Srgb => "srgb",
            },
            time: scene.time,
            camera: CameraSummary::of(&scene.camera),
            background: match scene.background {
                Background::Uniform(color) => Some(color.to_array()),
                Background::Function(_) => None,
            },
            objects,
            point_lights: lights(|light| matches!(light, Light::Point { .. })),
            ambient_lights,
            directional_lights: lights(|light| matches!(light, Light::Directional { .. })),
            spot_lights: lights(|light| matches!(light, Light::Spot { .. })),
            materials,
            functions: functions(scene),
            meshes: Meshes::of(&scene.primitives),
            sphere_bounds: bounds(description),
            worst_case: WorstCase {
                branches,
                rays_per_sample: if objects.total == 0 {
                    Some(u64::from(*max_depth >= 0))
                } else {
                    worst_case(branches, *max_depth, scene.lights.len() - ambient_lights)
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

/// The materials of all objects and parts of solids.
fn parts(scene: &Scene) -> impl Iterator<Item = &Arc<Material>> {
    scene.primitives.iter().flat_map(Primitive::leaves).map(|leaf| &leaf.material).take(MOST_PARTS)
}

/// How many different functions there are.
fn functions(scene: &Scene) -> usize {
    let mut materials: Vec<&Arc<Material>> = parts(scene).collect();
    materials.sort_unstable_by_key(|material| Arc::as_ptr(material));
    materials.dedup_by_key(|material| Arc::as_ptr(material));
    let mut found = BTreeSet::new();
    let mut note = |function: Option<&Arc<Function>>| {
        found.extend(function.map(Arc::as_ptr));
    };
    for material in materials {
        let Material { reflection, shine, transmission, refractive_index, highlight, .. } = &**material;
        for field in [reflection, shine, transmission, refractive_index].into_iter().chain(highlight) {
            if let Field::Function(function) = field {
                note(Some(function));
            }
        }
        for texture in [&material.texture].into_iter().chain(&material.glow) {
            if let Texture::Function(function) = texture {
                note(Some(function));
            }
        }
        note(material.bump.as_ref());
    }
    if let Background::Function(function) = &scene.background {
        note(Some(function));
    }
    found.len()
}

fn texture_name(texture: &Texture) -> &'static str {
    match texture {
        Texture::Solid(_) => "solid",
        Texture::Function(_) => "function",
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
                let radius = DVec3::splat(sphere.radius.abs());
                let Some(transform) = &primitive.transform else {
                    return Some((sphere.center - radius, sphere.center + radius));
                };
                let DMat3 { x_axis, y_axis, z_axis } = transform.matrix3;
                // The image of a sphere reaches as far along an axis as that row of the matrix is long.
                let rows = x_axis * x_axis + y_axis * y_axis + z_axis * z_axis;
                let reach = radius * DVec3::new(rows.x.sqrt(), rows.y.sqrt(), rows.z.sqrt());
                let center = transform.transform_point3(sphere.center);
                Some((center - reach, center + reach))
            }
            _ => None,
        })
        .reduce(|(min, max), (other_min, other_max)| (min.min(other_min), max.max(other_max)))
        .map(|(min, max)| Bounds { min: min.to_array(), max: max.to_array() })
}

/// The rays of levels 0 to `max_depth`, each level `branches` times as many as the one before, and a shadow
/// ray to every light but the ambient ones for each of them.
fn worst_case(branches: u32, max_depth: i32, shadow_lights: usize) -> Option<u64> {
    let (mut level, mut rays) = (1u64, 0u64);
    for _ in 0..=max_depth {
        rays = rays.checked_add(level)?;
        level = level.saturating_mul(u64::from(branches));
        if level == 0 {
            break;
        }
    }
    rays.checked_mul(1 + shadow_lights as u64)
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
        assert_eq!(summary.camera, CameraSummary::Window { eye: [0.0, 0.0, 150.0], window: [100.0, 75.0] });
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
        assert_eq!(
            summary.objects,
            Objects { total: 3, spheres: 2, planes: 1, boxes: 0, round: 0, implicit: 0, csg: 0, meshes: 0 }
        );
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
