//! The triangle meshes that rays are traced against.

use crate::Result;
use clap::ValueEnum;
use glam::DVec3;
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

/// Cells along a side of [`terrain`]: with them it has 4 004 450 triangles.
pub const TERRAIN_CELLS: u32 = 1415;

/// Which mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MeshName {
    /// The Stanford bunny, 69 451 triangles.
    Bunny,
    /// The bunny, each triangle split into four, twice: 1 111 216 triangles.
    Split,
    /// A landscape of sines, 4 004 450 triangles.
    Terrain,
}

/// Triangles over shared vertices.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// What it is.
    pub name: MeshName,
    /// Positions.
    pub vertices: Vec<[f32; 3]>,
    /// Three indices into [`Mesh::vertices`] each.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|index| widen(self.vertices[index as usize]))
    }

    /// The least and the greatest coordinates of those vertices that a triangle refers to.
    #[must_use]
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let mut bounds = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for index in self.triangles.iter().flatten() {
            let vertex = widen(self.vertices[*index as usize]);
            bounds = (bounds.0.min(vertex), bounds.1.max(vertex));
        }
        bounds
    }

    /// Each triangle as four: three at its corners and the one between their midpoints, in this order.
    #[must_use]
    pub fn split(&self) -> Self {
        let mut vertices = self.vertices.clone();
        let mut midpoints = HashMap::new();
        let mut midpoint = |p: u32, q: u32| {
            *midpoints.entry((p.min(q), p.max(q))).or_insert_with(|| {
                let (p, q) = (vertices[p as usize], vertices[q as usize]);
                vertices.push([0, 1, 2].map(|axis| (p[axis] + q[axis]) * 0.5));
                index(vertices.len() - 1)
            })
        };
        let triangles = self.triangles.iter().flat_map(|&[a, b, c]| {
            let (ab, bc, ca) = (midpoint(a, b), midpoint(b, c), midpoint(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        let triangles = triangles.collect();
        Self { name: MeshName::Split, vertices, triangles }
    }
}

/// The bunny out of an OBJ file, which may be packed with gzip; polygons become fans.
///
/// # Errors
/// Where the file cannot be read or is not an OBJ file.
pub fn bunny(path: &Path) -> Result<Mesh> {
    let file = File::open(path).map_err(|e| format!("cannot open {}: {e}", path.display()))?;
    let mut file: Box<dyn BufRead> = if path.extension().is_some_and(|extension| extension == "gz") {
        Box::new(BufReader::new(flate2::bufread::GzDecoder::new(BufReader::new(file))))
    } else {
        Box::new(BufReader::new(file))
    };
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let (models, _) = tobj::load_obj_buf(&mut file, &options, |_| Ok(Default::default()))
        .map_err(|e| format!("cannot read {}: {e}", path.display()))?;
    let mut mesh = Mesh { name: MeshName::Bunny, vertices: Vec::new(), triangles: Vec::new() };
    for model in models {
        let first = index(mesh.vertices.len());
        mesh.vertices.extend_from_slice(model.mesh.positions.as_chunks().0);
        let triangles = model.mesh.indices.as_chunks().0;
        mesh.triangles
            .extend(triangles.iter().map(|corners: &[u32; 3]| corners.map(|corner| first + corner)));
    }
    Ok(mesh)
}

/// A landscape over the square from -1 to 1 in x and z, of `cells` by `cells` cells of two triangles.
#[must_use]
pub fn terrain(cells: u32) -> Mesh {
    let coordinate = |i: u32| -1.0 + 2.0 * f64::from(i) / f64::from(cells);
    let row = cells + 1;
    let mut vertices = Vec::new();
    for (j, i) in (0..row).flat_map(|j| (0..row).map(move |i| (j, i))) {
        let (x, z) = (coordinate(i), coordinate(j));
        vertices.push(DVec3::new(x, height(x, z), z).as_vec3().to_array());
    }
    let mut triangles = Vec::new();
    for (j, i) in (0..cells).flat_map(|j| (0..cells).map(move |i| (j, i))) {
        let a = j * row + i;
        let (b, c, d) = (a + 1, a + row, a + row + 1);
        triangles.extend([[a, c, b], [b, c, d]]);
    }
    Mesh { name: MeshName::Terrain, vertices, triangles }
}

fn height(x: f64, z: f64) -> f64 {
    use libm::{cos, sin};
    0.10 * sin(3.1 * x + 0.5) * cos(2.7 * z + 1.1)
        + 0.05 * sin(7.3 * x + 1.7 * z)
        + 0.025 * sin(17.1 * z - 9.2 * x + 0.3)
        + 0.0125 * sin(37.0 * x + 1.0) * sin(41.0 * z + 2.0)
        + 0.005 * sin(97.0 * x + 53.0 * z)
        + 0.002 * sin(211.0 * x) * sin(223.0 * z)
}

fn widen(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// Meshes have fewer than 2^32 vertices; what does not fit would be no index of one.
fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_terrain_has_the_vertices_and_triangles_of_its_cells() {
        let mesh = terrain(3);
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (16, 18));
        assert_eq!(mesh.triangles[..4], [[0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 6]]);
        assert_eq!(mesh.triangles[17], [11, 14, 15]);
        assert_eq!(2 * TERRAIN_CELLS * TERRAIN_CELLS, 4_004_450);
        let (low, high) = mesh.bounds();
        assert_eq!((low.x, low.z, high.x, high.z), (-1.0, -1.0, 1.0, 1.0));
    }

    #[test]
    fn splitting_shares_midpoints() {
        let mesh = terrain(1).split();
        assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (4 + 5, 8));
        assert_eq!(mesh.triangles[..4], [[0, 4, 6], [4, 2, 5], [6, 5, 1], [4, 5, 6]]);
        assert_eq!(mesh.vertices[4][0], -1.0);
        assert_eq!(mesh.vertices[4][2], 0.0);
    }

    #[test]
    fn bounds_ignore_vertices_without_triangles() {
        let mut mesh = terrain(1);
        mesh.vertices.push([9.0; 3]);
        assert_eq!(mesh.bounds().1.x, 1.0);
    }

    #[test]
    fn polygons_become_fans() {
        let path = std::env::temp_dir().join(format!("rays-bench-{}.obj", std::process::id()));
        std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\nf 1 2 3 4\n").unwrap();
        let mesh = bunny(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.vertices[2], [1.0, 1.0, 0.1]);
        assert!(bunny(&path).unwrap_err().contains("cannot open"));
    }
}
