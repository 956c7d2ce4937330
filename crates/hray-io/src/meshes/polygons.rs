//! Vertices and polygons on their way to a mesh.

use super::problem::{Outcome, Problem};
use hray_core::Mesh;

/// What becomes a mesh. Attributes are there for every vertex, or not at all.
#[derive(Clone, Debug, Default)]
pub(super) struct Polygons {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) colors: Vec<[f32; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Polygons {
    /// Splits a polygon into triangles around its first corner. One of less than three corners is left out.
    pub(super) fn polygon(&mut self, corners: &[u32]) {
        if let [first, rest @ ..] = corners {
            self.triangles.extend(rest.windows(2).filter_map(|pair| match *pair {
                [b, c] => Some([*first, b, c]),
                _ => None,
            }));
        }
    }

    /// A strip: each corner makes a triangle with the two before it, turned the other way every second time.
    pub(super) fn strip(&mut self, corners: &[u32]) {
        self.triangles.extend(corners.windows(3).enumerate().filter_map(|(number, three)| match *three {
            [a, b, c] if number % 2 == 0 => Some([a, b, c]),
            [a, b, c] => Some([b, a, c]),
            _ => None,
        }));
    }

    /// Whether there are too many triangles for a mesh.
    pub(super) fn is_full(&self) -> bool {
        self.triangles.len() > Mesh::MOST_TRIANGLES
    }

    pub(super) fn mesh(self) -> Outcome<Mesh> {
        let mesh = Mesh::new(self.positions, self.triangles);
        mesh.and_then(|mesh| mesh.with_normals(self.normals))
            .and_then(|mesh| mesh.with_uvs(self.uvs))
            .and_then(|mesh| mesh.with_colors(self.colors))
            .map_err(|error| Problem::file(error.to_string()))
    }
}

/// What a mesh with too many triangles is told.
pub(super) fn too_many() -> String {
    format!("there are more than {} triangles, the most that a mesh may have", Mesh::MOST_TRIANGLES)
}

/// The linear light of a component in sRGB, both from 0 to 1: the inverse transfer function of IEC 61966-2-1.
pub(super) fn linear(encoded: f64) -> f32 {
    let value = if encoded <= 0.04045 { encoded / 12.92 } else { libm::pow((encoded + 0.055) / 1.055, 2.4) };
    value as f32
}
