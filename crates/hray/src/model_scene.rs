//! A scene around a file of meshes, as hry text: something to look at it with, and to go on from.

use crate::{DVec3, Formatted, Model, ModelFormat};
use std::fmt::Write;

/// Angle from the lower to the upper edge of the picture, in degrees.
const FOV: f64 = 35.0;
/// The tangent of half of it.
const TANGENT: f64 = 0.315_298_788_878_984;
/// Width of the picture divided by its height: that of a scene which says nothing.
const ASPECT: f64 = 4.0 / 3.0;
/// How much of the picture the model may take.
const FILLED: f64 = 0.86;

/// The text of a scene that shows a model, which is in the file `file`, as hry writes paths: a camera that sees all of it from
/// the front, from the right and from above, lights, a floor that it stands on, and a plain material for what has none.
///
/// What is in an STL file is stood up: there z is up as a rule. Surfaces without normals are made to look round in formats
/// that could have told them.
#[must_use]
pub fn scene_of_model(file: &str, model: &Model) -> String {
    let is_stl = model.format == ModelFormat::Stl;
    let [min, max] = model.bounds().unwrap_or([DVec3::splat(-1.0), DVec3::splat(1.0)]);
    // (x, y, z) becomes (x, z, -y).
    let (min, max) = if is_stl {
        (DVec3::new(min.x, min.z, -max.y), DVec3::new(max.x, max.z, -min.y))
    } else {
        (min, max)
    };
    let view = View::of(min, max);
    let has_normals = model.parts.iter().all(|part| !part.mesh.normals().is_empty());
    let smooth = if has_normals || is_stl { "" } else { ", smooth = true" };
    let mesh = format!("mesh {{ file = {}{smooth} }}", quoted(file));
    let placed = if is_stl { format!("{mesh} |> rotate (1, 0, 0) -90deg") } else { mesh };
    let mut text = String::new();
    let triangles: usize = model.parts.iter().map(|part| part.mesh.triangles().len()).sum();
    // Writing to a text does not fail.
    let _ = write!(
        text,
        "-- {} triangles, from {} to {}\n\
         model = {placed}\n\n\
         -- What has no colour of its own in the file.\n\
         neutral = classic {{ color = rgb 0.72 0.7 0.66, highlight = 0.15, shine = 40 }}\n\n\
         floor = plane {{ normal = up, offset = {}, material = classic {{ color = rgb 0.8 0.82 0.85 }} }}\n\n\
         scene = {{\n  \
           camera = perspective {{ from = {}, to = {}, fov = {FOV}deg }},\n  \
           background = rgb 0.75 0.82 0.9,\n  \
           lights = [\n    \
             directional {{ direction = (-0.5, -1, -0.7), intensity = 0.75 }},\n    \
             ambient {{ intensity = 0.3 }}\n  \
           ],\n  \
           objects = [floor, paint neutral model]\n\
         }}\n",
        triangles,
        vector(min, 4),
        vector(max, 4),
        // Just below, so that what is flat on the floor is seen.
        number(min.y - 1e-4 * view.size, 6),
        vector(view.from, 5),
        vector(view.to, 5),
    );
    match crate::format_scene("model.hry", text.as_bytes()) {
        Formatted::Text(text) => text,
        _ => text,
    }
}

/// Where a model is seen from.
struct View {
    from: DVec3,
    to: DVec3,
    /// The diagonal of the box around it.
    size: f64,
}

impl View {
    /// A view of everything between two corners.
    fn of(min: DVec3, max: DVec3) -> Self {
        let to = min + (max - min) / 2.0;
        let diagonal = (max - min).length();
        // A single point is looked at as if it were as large as it is far from the origin.
        let size = if diagonal > 0.0 { diagonal } else { to.length().max(1.0) };
        let back = DVec3::new(0.55, 0.4, 1.0).normalize();
        let right = DVec3::Y.cross(back).normalize();
        let above = back.cross(right);
        let tangent = TANGENT * FILLED;
        let corners = (0..8).map(|corner: u32| {
            let side = |axis: u32| if corner >> axis & 1 == 0 { -0.5 } else { 0.5 };
            (max - min) * DVec3::new(side(0), side(1), side(2))
        });
        let distance = corners.map(|corner| {
            let (across, up) = (corner.dot(right).abs() / ASPECT, corner.dot(above).abs());
            corner.dot(back) + across.max(up) / tangent
        });
        let distance = distance.fold(0.0f64, f64::max).max(size * 0.5);
        Self { from: to + back * distance, to, size }
    }
}

/// A number of a few digits, as hry writes it.
fn number(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return "0".to_owned();
    }
    let rounded: f64 = format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value);
    let magnitude = rounded.abs();
    if (1e-4..1e9).contains(&magnitude) { format!("{rounded}") } else { format!("{rounded:e}") }
}

/// A point. Its parts are rounded together, so that small ones do not show digits that do not count.
fn vector(v: DVec3, digits: usize) -> String {
    let most = v.abs().max_element();
    let part = |x: f64| {
        if x.abs() * 1e5 < most { "0".to_owned() } else { number(x, digits) }
    };
    format!("({}, {}, {})", part(v.x), part(v.y), part(v.z))
}

/// A text as hry writes it.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        if matches!(c, '"' | '\\') {
            quoted.push('\\');
        }
        quoted.push(c);
    }
    quoted.push('"');
    quoted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Input, LoadOptions, SceneFile, Shape};

    const CUBE: &str = "v 1 1 1\nv 3 1 1\nv 3 2 1\nv 1 2 1\nv 1 1 2\nv 3 1 2\nv 3 2 2\nv 1 2 2\n\
        f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

    #[test]
    fn a_model_is_a_scene_that_shows_all_of_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a \"cube\".obj");
        std::fs::write(&path, CUBE).unwrap();
        let file = SceneFile::read(&Input::File(path), &LoadOptions::default()).unwrap();
        assert_eq!(file.report(false), "");
        let scene = &file.description().unwrap().scene;
        let Camera::Perspective(camera) = scene.camera else { panic!("{:?}", scene.camera) };
        assert_eq!(camera.to, DVec3::new(2.0, 1.5, 1.5));
        let Shape::Mesh(mesh) = &scene.primitives[1].shape else { panic!("{:?}", scene.primitives) };
        assert_eq!((mesh.triangles().len(), scene.primitives.len(), scene.lights.len()), (12, 2, 2));
        // Edges of a right angle stay sharp.
        assert_eq!((mesh.positions().len(), mesh.normals().len()), (24, 24));
        let forward = (camera.to - camera.from).normalize();
        let right = forward.cross(DVec3::Y).normalize();
        let tangent = libm::tan(camera.fov / 2.0);
        let mut most = 0.0f64;
        for position in mesh.positions() {
            let p = DVec3::from(position.map(f64::from)) - camera.from;
            let depth = p.dot(forward);
            let (x, y) =
                (p.dot(right) / depth / tangent / ASPECT, p.dot(right.cross(forward)) / depth / tangent);
            most = most.max(x.abs()).max(y.abs());
        }
        assert!((0.8..0.9).contains(&most), "{most}");
    }

    #[test]
    fn an_stl_file_stands_up() {
        let solid = "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 5\nendloop\nendfacet\nendsolid\n";
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tower.STL");
        std::fs::write(&path, solid).unwrap();
        let file = SceneFile::read(&Input::File(path), &LoadOptions::default()).unwrap();
        let scene = &file.description().unwrap().scene;
        let top = scene.primitives[1].transform.as_ref().unwrap().transform_point3(DVec3::new(0.0, 0.0, 5.0));
        assert!((top - DVec3::new(0.0, 5.0, 0.0)).length() < 1e-12, "{top}");
    }

    #[test]
    fn numbers_are_short_and_read_back() {
        let shown = [0.0, 1.0, 0.123_456_78, -1234.5678, 1e-7, 3e12].map(|x| number(x, 4));
        assert_eq!(shown, ["0", "1", "0.1235", "-1235", "1e-7", "3e12"]);
        assert_eq!(vector(DVec3::new(100.0, 1e-9, 0.5), 3), "(100, 0, 0.5)");
    }
}
