//! The only crate that sees both the model and the engine.
//!
//! [`to_model`] says in the model's words what a scene of the engine is; [`random`] makes scenes in which
//! everything occurs; [`compare`] renders one by both and finds the first pixel that differs in any bit.

pub mod random;

use hray::{
    Background, Camera, Control, Description, Field, Light, LintLevels, NoiseTables, NoiseTexture, Options,
    PictureFormat, Rgb, Scene, SceneFile, Shape, Texture,
};
use hray_model as model;
use sha2::{Digest, Sha256};
use std::num::NonZeroUsize;
use std::path::Path;

fn point(v: hray::DVec3) -> model::Point3D {
    (v.x, v.y, v.z)
}

fn color(c: Rgb) -> model::Color {
    (c.r, c.g, c.b)
}

/// A scene of the engine in the words of the model; none where the model has no words for it.
#[must_use]
pub fn to_model(scene: &Scene) -> Option<model::Scene> {
    let object = |shape: &Shape| match shape {
        Shape::Sphere(s) => Some(model::Object::Sphere(model::mk_sphere(point(s.center), s.radius))),
        Shape::Plane(p) => {
            let plane = model::mk_plane((p.normal.x, p.normal.y, p.normal.z, p.offset));
            Some(model::Object::Plane(plane))
        }
        _ => None,
    };
    let objects = scene.primitives.iter().map(|primitive| {
        let material = &primitive.material;
        let plain = primitive.transform.is_none() && material.highlight.is_none() && material.glow.is_none();
        let texture = model::Texture {
            diff: diff(&material.texture).filter(|_| plain && material.bump.is_none())?,
            refl_coef: material.reflection.constant()?,
            spec_coef: whole(&material.shine)?,
            refr_coef: material.transmission.constant()?,
            refr_index: material.refractive_index.constant()?,
        };
        Some((object(&primitive.shape)?, texture))
    });
    let light = |light: &Light| match *light {
        Light::Point { position, intensity } => {
            let light = model::PointLight { pos: point(position), int: color(intensity) };
            Some(model::Light::PointLight(light))
        }
        Light::Ambient { intensity } => {
            Some(model::Light::AmbientLight(model::AmbientLight { int: color(intensity) }))
        }
        Light::Directional { .. } | Light::Spot { .. } => None,
    };
    let (Camera::Window(camera), Background::Uniform(background)) = (scene.camera, &scene.background) else {
        return None;
    };
    let [width, height] = [whole(&camera.window[0].into())?, whole(&camera.window[1].into())?];
    Some(model::Scene {
        camera: model::mk_camera(point(camera.eye), (width, height)),
        background: color(*background),
        objects: objects.collect::<Option<_>>()?,
        lights: scene.lights.iter().map(light).collect::<Option<_>>()?,
    })
}

fn whole(field: &Field) -> Option<i64> {
    field.constant().filter(|number| number.fract() == 0.0).map(|number| number as i64)
}

fn diff(texture: &Texture) -> Option<model::Diff> {
    use model::NoiseF;
    let noise = match *texture {
        Texture::Solid(c) => return Some(model::Diff::Solid(color(c))),
        Texture::Noise(noise) => noise,
        Texture::Function(_) => return None,
    };
    Some(model::Diff::Perlin(match noise {
        NoiseTexture::Solid { base, grid } => NoiseF::PerlinSolid { base: color(base), grid_s: grid },
        NoiseTexture::SemiTurbulence { base, octaves, grid } => {
            NoiseF::PerlinSemiTurbulence { base: color(base), freq: octaves.into(), grid_s: grid }
        }
        NoiseTexture::Turbulence { base, octaves, grid } => {
            NoiseF::PerlinTurbulence { base: color(base), freq: octaves.into(), grid_s: grid }
        }
        NoiseTexture::Fire { added, base, octaves, grid } => NoiseF::PerlinFire {
            add_color: color(added),
            base: color(base),
            freq: octaves.into(),
            grid_s: grid,
        },
        NoiseTexture::Plasma { grid } => NoiseF::PerlinPlasma { grid_s: grid },
        NoiseTexture::Marble { base, octaves, grid, direction, power } => NoiseF::PerlinMarble {
            base: color(base),
            freq: octaves.into(),
            grid_s: grid,
            factors: point(direction),
            pow: power,
        },
        NoiseTexture::MarbleBase { base, added, octaves, grid, direction, power } => {
            NoiseF::PerlinMarbleBase {
                base: color(base),
                add_color: color(added),
                freq: octaves.into(),
                grid_s: grid,
                factors: point(direction),
                pow: power,
            }
        }
        NoiseTexture::Wood { base, octaves, grid, rings, power } => NoiseF::PerlinWood {
            base: color(base),
            freq: octaves.into(),
            grid_s: grid,
            xy_fact: rings,
            pow: power,
        },
    }))
}

/// Noise tables of the engine in the words of the model.
#[must_use]
pub fn tables_to_model(tables: &NoiseTables) -> model::NoiseTables {
    let [p_list, p_list2, p_list3] = *tables.permutations();
    let g_list = tables.gradients().map(|[x, y, z]| (x, y, z));
    model::NoiseTables { p_list, p_list2, p_list3, g_list }
}

/// The engine's colours of all pixels, row by row from the top.
///
/// # Errors
/// Where the render does not end with a picture.
pub fn engine_colors(
    description: &Description,
    tables: &NoiseTables,
    threads: usize,
) -> Result<Vec<Rgb>, String> {
    let threads = NonZeroUsize::new(threads);
    let options = Options { threads, noise_tables: tables.clone(), ..Options::default() };
    let rendered = hray::render_to_memory(description, &options, &Control::new());
    let (picture, _) = rendered.map_err(|error| error.to_string())?;
    Ok(picture.pixels().to_vec())
}

/// The scenes of a folder with the hashes of their P3 files, as its file `SHA256SUMS` records them.
///
/// # Errors
/// Where that file cannot be read, or a line of it is not `HASH  NAME.ppm`.
pub fn recorded(folder: &Path) -> Result<Vec<(String, String)>, String> {
    let path = folder.join("SHA256SUMS");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let parse = |line: &str| {
        let (hash, file) = line.split_once("  ")?;
        Some((file.strip_suffix(".ppm")?.to_owned(), hash.to_owned()))
    };
    text.lines().map(|line| parse(line).ok_or_else(|| format!("{}: {line}", path.display()))).collect()
}

/// The SHA-256 hash of the P3 file that the engine writes for a scene file.
///
/// # Errors
/// Where the scene does not load or render.
pub fn p3_hash(scene: &Path, tables: &NoiseTables) -> Result<String, String> {
    let say = |error: hray::Error| format!("{}: {error}", scene.display());
    p3_hash_of(&hray::load(scene).map_err(say)?, tables).map_err(say)
}

/// The same for a scene in memory.
///
/// # Errors
/// Where it does not render.
pub fn p3_hash_of(description: &Description, tables: &NoiseTables) -> Result<String, hray::Error> {
    let options = Options { noise_tables: tables.clone(), ..Options::default() };
    let format = PictureFormat::PpmAscii;
    let (bytes, _) = hray::render_to_bytes(description, &options, format, &Control::new())?;
    Ok(format!("{:x}", Sha256::digest(&bytes)))
}

/// The same for what a classic scene file becomes in hry; none where hry cannot say it.
///
/// # Errors
/// Where the scene does not load or render, in either language, or is not the same scene in hry.
pub fn converted_p3_hash(scene: &Path, tables: &NoiseTables) -> Result<Option<String>, String> {
    let say = |error: hray::Error| format!("{}: {error}", scene.display());
    let description = hray::load(scene).map_err(say)?;
    let Some(text) = hray::convert(&description) else { return Ok(None) };
    let file = SceneFile::parse("converted.hry", text.into_bytes(), &LintLevels::default());
    let Some(converted) = file.description() else { return Err(file.report(false)) };
    if *converted != description {
        return Err(format!("{} is another scene in hry", scene.display()));
    }
    p3_hash_of(converted, tables).map(Some).map_err(say)
}

/// Renders a scene by both and compares every component of every pixel, bit by bit.
///
/// # Errors
/// With the first pixel that differs, or the reason why there is nothing to compare.
pub fn compare(description: &Description, tables: &NoiseTables, threads: usize) -> Result<(), String> {
    let (width, height) = (description.resolution.width(), description.resolution.height());
    let scene = to_model(&description.scene).ok_or("the model has no words for this scene")?;
    let model_tables = tables_to_model(tables);
    let size = (i64::from(width), i64::from(height));
    let expected = model::get_image(i64::from(description.max_depth), size, &scene, &model_tables)
        .map_err(|error| format!("the model: {error:?}"))?;
    let found = engine_colors(description, tables, threads)?;
    if expected.len() != found.len() {
        return Err(format!("{} pixels instead of {}", found.len(), expected.len()));
    }
    for (i, (expected, found)) in expected.iter().zip(&found).enumerate() {
        let bits = |c: [f64; 3]| c.map(f64::to_bits);
        if bits([expected.0, expected.1, expected.2]) != bits(found.to_array()) {
            let (x, y) = (i % width as usize, i / width as usize);
            return Err(format!("pixel ({x}, {y}): {found:?} instead of {expected:?}"));
        }
    }
    Ok(())
}
