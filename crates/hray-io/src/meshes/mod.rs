//! Meshes for a scene: files that modellers and scanners write.

mod gltf;
mod mtl;
mod obj;
mod ply;
mod polygons;
mod problem;
mod stl;
mod words;

use crate::InputError;
use crate::source::{open, read_bounded};
use hray_core::{Model, ModelFormat, ModelPart};
use std::path::{Component, Path};
use std::sync::Arc;

/// The longest file of meshes that is read: 2 GiB. What it names besides, such as the buffers of a glTF file, may have as
/// much together.
pub const MAX_MODEL_BYTES: u64 = 2 << 30;

/// What reads the files that a file of meshes names, by their paths from its folder; in words that follow "cannot be read: "
/// where they are not to be had.
pub type Companions<'a> = dyn Fn(&str) -> Result<Vec<u8>, String> + 'a;

/// The format that an extension tells: `ply`, `stl`, `obj`, `gltf` or `glb`, in whatever case.
#[must_use]
pub fn model_format(path: &Path) -> Option<ModelFormat> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    match &extension[..] {
        "ply" => Some(ModelFormat::Ply),
        "stl" => Some(ModelFormat::Stl),
        "obj" => Some(ModelFormat::Obj),
        "gltf" | "glb" => Some(ModelFormat::Gltf),
        _ => None,
    }
}

/// Reads a file of meshes, see [`decode_model`], and what it names in its own folder and below.
///
/// # Errors
/// [`InputError`] where the file cannot be read, is none that is known, or is damaged.
pub fn read_model(path: &Path) -> Result<Model, InputError> {
    let bytes = read_bounded(open(path, MAX_MODEL_BYTES)?, path, MAX_MODEL_BYTES)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let companion = |name: &str| {
        let relative = Path::new(name);
        if !relative.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
            return Err("it does not lie in the folder of the model".to_owned());
        }
        let path = folder.join(relative);
        let file = open(&path, MAX_MODEL_BYTES).map_err(|error| error.reason())?;
        read_bounded(file, &path, MAX_MODEL_BYTES).map_err(|error| error.reason())
    };
    decode_model(&bytes, path, &companion)
}

/// Makes meshes of the bytes of a file, which is called `name` in messages: PLY, STL, OBJ, glTF 2.0 or GLB. The format is told
/// by the content, and, where that can be OBJ or STL, by the extension.
///
/// Polygons of more than three corners are split around their first one. Nothing is moved or scaled. Positions that are
/// no finite numbers are an error in text, and kept in binary files.
///
/// # Errors
/// [`InputError::Model`], with the line or the byte, where the file is none of these, is damaged, has more than
/// [`hray_core::Mesh::MOST_TRIANGLES`] triangles in a mesh, or needs a file that `files` does not give.
pub fn decode_model(bytes: &[u8], name: &Path, files: &Companions<'_>) -> Result<Model, InputError> {
    let mut notes = Vec::new();
    let parts = parts(bytes, name, files, &mut notes);
    let failed = |reason| InputError::Model { path: name.to_owned(), reason };
    let (format, parts) = parts.map_err(|problem| failed(problem.to_string()))?;
    Ok(Model { format, parts, notes })
}

fn parts(
    bytes: &[u8],
    name: &Path,
    files: &Companions<'_>,
    notes: &mut Vec<String>,
) -> problem::Outcome<(ModelFormat, Vec<ModelPart>)> {
    let single = |mesh| {
        let mesh = Arc::new(mesh);
        vec![ModelPart { name: String::new(), mesh, transform: None, material: None }]
    };
    let told = model_format(name);
    let format = match told {
        _ if ply::is_one(bytes) => ModelFormat::Ply,
        _ if gltf::is_one(bytes) => ModelFormat::Gltf,
        Some(format) => format,
        None => {
            let what = "it is no model; known are ply, stl, obj, gltf and glb, by their extensions";
            return Err(problem::Problem::file(what));
        }
    };
    let parts = match format {
        ModelFormat::Ply => {
            let ply = ply::read(bytes)?;
            notes.extend(ply.notes);
            single(ply.mesh)
        }
        ModelFormat::Stl => single(stl::read(bytes, notes)?),
        ModelFormat::Obj => obj::read(bytes, files, notes)?,
        ModelFormat::Gltf => gltf::read(bytes, files, notes)?,
    };
    Ok((format, parts))
}
