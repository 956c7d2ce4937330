//! What a file of meshes holds.

use crate::{Mesh, Rgb};
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// The meshes of a file, where they stand, and what they are made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// What kind of file it was.
    pub format: ModelFormat,
    /// Its parts, in the order of the file.
    pub parts: Vec<ModelPart>,
    /// What the file has that was not taken over, or not found, in sentences without a full stop.
    pub notes: Vec<String>,
}

/// A kind of file that holds meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelFormat {
    /// The Polygon File Format, also known as the Stanford Triangle Format.
    Ply,
    /// Stereolithography: triangles and nothing else; the z axis points up as a rule.
    Stl,
    /// Wavefront's OBJ.
    Obj,
    /// Khronos' glTF 2.0, as text or in its binary form.
    Gltf,
}

/// A mesh of a model in its place.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelPart {
    /// Its name in the file; may be empty.
    pub name: String,
    /// The mesh, which other parts may share.
    pub mesh: Arc<Mesh>,
    /// From the mesh's space to that of the model; the same space where there is none.
    pub transform: Option<DAffine3>,
    /// What it is made of, where the file says.
    pub material: Option<Arc<ModelMaterial>>,
}

/// What a part is made of, as far as it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelMaterial {
    /// Its name in the file; may be empty.
    pub name: String,
    /// The colour under white light, linear.
    pub base_color: Rgb,
    /// Light it gives off by itself, linear.
    pub emission: Rgb,
    /// Share of light that it stops, in [0, 1]; 1 is solid.
    pub opacity: f64,
}

impl ModelMaterial {
    /// A solid material of one colour.
    #[must_use]
    pub const fn new(name: String, base_color: Rgb) -> Self {
        Self { name, base_color, emission: Rgb::BLACK, opacity: 1.0 }
    }
}

impl ModelFormat {
    /// What the format is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ply => "PLY",
            Self::Stl => "STL",
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
        }
    }
}

impl Model {
    /// The least and the greatest coordinates of its triangles' finite vertices, placed; nothing where there are none.
    #[must_use]
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        let mut bounds: Option<[DVec3; 2]> = None;
        for part in &self.parts {
            if let Some([min, max]) = part.mesh.bounds_under(part.transform.as_ref()) {
                let [low, high] = bounds.get_or_insert([min, max]);
                (*low, *high) = (low.min(min), high.max(max));
            }
        }
        bounds
    }

    /// The bytes of its meshes, each counted once.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let mut meshes: Vec<&Arc<Mesh>> = self.parts.iter().map(|part| &part.mesh).collect();
        meshes.sort_unstable_by_key(|mesh| Arc::as_ptr(mesh));
        meshes.dedup_by_key(|mesh| Arc::as_ptr(mesh));
        meshes.iter().map(|mesh| mesh.bytes()).sum()
    }
}

impl Mesh {
    /// The least and the greatest coordinates of the triangles' finite vertices where they are placed; nothing where there
    /// are none.
    #[must_use]
    pub fn bounds_under(&self, transform: Option<&DAffine3>) -> Option<[DVec3; 2]> {
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let Some(transform) = transform else { return self.bounds().map(|bounds| bounds.map(vector)) };
        let mut bounds: Option<[DVec3; 2]> = None;
        for &vertex in self.triangles().as_flattened() {
            let p = transform.transform_point3(vector(self.positions()[vertex as usize]));
            if p.is_finite() {
                let [min, max] = bounds.get_or_insert([p, p]);
                (*min, *max) = (min.min(p), max.max(p));
            }
        }
        bounds
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_is_measured_where_its_parts_stand() {
        let mesh = Mesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![[0, 1, 2]]).unwrap();
        let mesh = Arc::new(mesh);
        let part =
            |transform| ModelPart { name: String::new(), mesh: mesh.clone(), transform, material: None };
        let moved = DAffine3::from_translation(DVec3::new(0.0, 0.0, 5.0));
        let model =
            Model { format: ModelFormat::Ply, parts: vec![part(None), part(Some(moved))], notes: Vec::new() };
        assert_eq!(model.bounds(), Some([DVec3::ZERO, DVec3::new(1.0, 2.0, 5.0)]));
        assert_eq!(model.bytes(), 4 * 12);
    }
}
