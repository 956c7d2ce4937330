//! Triangles that share vertices.

use std::collections::HashMap;
use std::fmt;
use std::sync::OnceLock;

/// A surface made of triangles, in object space, in single precision: what mesh files hold.
///
/// Seen from outside, the vertices of a triangle go round counterclockwise. Where there are normals at vertices, they are
/// interpolated for shading; u and v are those of the vertices, or else the weights of the second and third vertex.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub(crate) positions: Vec<[f32; 3]>,
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) normals: Vec<[f32; 3]>,
    pub(crate) uvs: Vec<[f32; 2]>,
    pub(crate) colors: Vec<[f32; 3]>,
    /// Worked out where it is asked for.
    pub(crate) open_edges: OnceLock<usize>,
}

impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        let Self { positions, triangles, normals, uvs, colors, open_edges: _ } = self;
        *positions == other.positions
            && *triangles == other.triangles
            && *normals == other.normals
            && *uvs == other.uvs
            && *colors == other.colors
    }
}

/// Why parts do not make a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// A triangle names a vertex that is not there.
    NoSuchVertex {
        /// The triangle's number, from 0.
        triangle: usize,
        /// The vertex that it names, from 0.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// An attribute is not there once for each vertex.
    Uneven {
        /// `normals`, `uvs` or `colors`.
        attribute: &'static str,
        /// How many of these there are.
        count: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// There are more triangles than a mesh may have ([`Mesh::MOST_TRIANGLES`]).
    TooMany {
        /// How many.
        triangles: usize,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchVertex { triangle, vertex, vertices } => {
                write!(
                    f,
                    "triangle {triangle} names vertex {vertex}, but there are {vertices}, counted from 0"
                )
            }
            Self::Uneven { attribute, count, vertices } => {
                write!(f, "there are {count} {attribute} for {vertices} vertices")
            }
            Self::TooMany { triangles } => {
                write!(
                    f,
                    "{triangles} triangles are more than the {} that a mesh may have",
                    Mesh::MOST_TRIANGLES
                )
            }
        }
    }
}

impl std::error::Error for MeshError {}

impl Mesh {
    /// The most triangles of a mesh.
    pub const MOST_TRIANGLES: usize = (1 << 27) - 1;

    /// A mesh of vertices and of triangles that name them, without attributes. Vertices that are no finite points are
    /// kept; the triangles that have one are not seen.
    ///
    /// # Errors
    /// Where a triangle names a vertex that is not there, and where there are too many triangles.
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        if triangles.len() > Self::MOST_TRIANGLES {
            return Err(MeshError::TooMany { triangles: triangles.len() });
        }
        let vertices = positions.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&vertex| vertex as usize >= vertices) {
                return Err(MeshError::NoSuchVertex { triangle, vertex, vertices });
            }
        }
        Ok(Self { positions, triangles, ..Self::default() })
    }

    /// With a normal for each vertex, or none at all. They need not be of length 1.
    ///
    /// # Errors
    /// Where their number is another.
    pub fn with_normals(mut self, normals: Vec<[f32; 3]>) -> Result<Self, MeshError> {
        self.check("normals", normals.len())?;
        self.normals = normals;
        Ok(self)
    }

    /// With surface parameters for each vertex, or none at all.
    ///
    /// # Errors
    /// Where their number is another.
    pub fn with_uvs(mut self, uvs: Vec<[f32; 2]>) -> Result<Self, MeshError> {
        self.check("uvs", uvs.len())?;
        self.uvs = uvs;
        Ok(self)
    }

    /// With a linear colour for each vertex, or none at all.
    ///
    /// # Errors
    /// Where their number is another.
    pub fn with_colors(mut self, colors: Vec<[f32; 3]>) -> Result<Self, MeshError> {
        self.check("colors", colors.len())?;
        self.colors = colors;
        Ok(self)
    }

    fn check(&self, attribute: &'static str, count: usize) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if count == 0 || count == vertices {
            Ok(())
        } else {
            Err(MeshError::Uneven { attribute, count, vertices })
        }
    }

    /// Where the vertices are.
    #[must_use]
    pub fn positions(&self) -> &[[f32; 3]] {
        &self.positions
    }

    /// The vertices of each triangle, all of which there are.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The normals of the vertices; none, or one for each.
    #[must_use]
    pub fn normals(&self) -> &[[f32; 3]] {
        &self.normals
    }

    /// The surface parameters of the vertices; none, or one pair for each.
    #[must_use]
    pub fn uvs(&self) -> &[[f32; 2]] {
        &self.uvs
    }

    /// The colours of the vertices; none, or one for each.
    #[must_use]
    pub fn colors(&self) -> &[[f32; 3]] {
        &self.colors
    }

    /// The least and the greatest coordinates of the triangles' finite vertices; nothing where there are none.
    #[must_use]
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let mut bounds: Option<[[f32; 3]; 2]> = None;
        for &vertex in self.triangles.as_flattened() {
            let p = self.positions[vertex as usize];
            if p.iter().all(|x| x.is_finite()) {
                let [min, max] = bounds.get_or_insert([p, p]);
                for axis in 0..3 {
                    min[axis] = min[axis].min(p[axis]);
                    max[axis] = max[axis].max(p[axis]);
                }
            }
        }
        bounds
    }

    /// How many edges have no partner, so that one could get in there: edges between the same two points that are not as often
    /// gone along in one direction as in the other. A mesh with none has an inside, and can be a part of solids: all points
    /// around which the surface goes, in whichever direction. Vertices in the same place are one here, and triangles that
    /// are not seen do not count.
    ///
    /// Worked out once: time grows as n log n with the triangles, and some 36 bytes are taken for each meanwhile.
    #[must_use]
    pub fn open_edges(&self) -> usize {
        *self.open_edges.get_or_init(|| {
            let mut points = HashMap::with_capacity(self.positions.len());
            let at: Vec<u32> = (0u32..)
                .zip(&self.positions)
                // Adding 0 makes one zero of both.
                .map(|(number, p)| *points.entry(p.map(|x| (x + 0.0).to_bits())).or_insert(number))
                .collect();
            let is_finite = |vertex: &u32| self.positions[*vertex as usize].iter().all(|x| x.is_finite());
            let mut edges = Vec::with_capacity(3 * self.triangles.len());
            for triangle in self.triangles.iter().filter(|triangle| triangle.iter().all(is_finite)) {
                let [a, b, c] = triangle.map(|vertex| at[vertex as usize]);
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    if from != to {
                        edges.push((from.min(to), from.max(to), if from < to { 1i32 } else { -1 }));
                    }
                }
            }
            edges.sort_unstable();
            let same = |a: &(u32, u32, i32), b: &(u32, u32, i32)| (a.0, a.1) == (b.0, b.1);
            edges.chunk_by(same).filter(|edge| edge.iter().map(|(.., way)| way).sum::<i32>() != 0).count()
        })
    }

    /// The bytes that it takes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&self.positions[..])
            + size_of_val(&self.triangles[..])
            + size_of_val(&self.normals[..])
            + size_of_val(&self.uvs[..])
            + size_of_val(&self.colors[..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_closed_has_no_open_edges() {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let edges = |positions: &[[f32; 3]], faces: &[[u32; 3]]| {
            Mesh::new(positions.to_vec(), faces.to_vec()).unwrap().open_edges()
        };
        assert_eq!(edges(&corners, &faces), 0);
        assert_eq!(edges(&corners, &faces[1..]), 3);
        // One face the wrong way round.
        assert_eq!(edges(&corners, &[[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]]), 3);
        // Each face with vertices of its own, one zero of them negative, and a triangle that is a line.
        let mut own: Vec<[f32; 3]> = faces.iter().flatten().map(|&vertex| corners[vertex as usize]).collect();
        own[0][0] = -0.0;
        let mut soup: Vec<[u32; 3]> = (0..4).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect();
        soup.push([0, 1, 0]);
        assert_eq!(edges(&own, &soup), 0);
        assert_eq!(edges(&[[f32::NAN; 3]], &[[0, 0, 0]]), 0);
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, f32::NAN, 0.0]];
        let mesh = Mesh::new(points.clone(), vec![[0, 1, 2]]).unwrap();
        assert_eq!(mesh.bounds(), Some([[0.0; 3], [1.0, 0.0, 0.0]]));
        assert_eq!(
            Mesh::new(points, vec![[0, 1, 2], [0, 1, 3]]),
            Err(MeshError::NoSuchVertex { triangle: 1, vertex: 3, vertices: 3 })
        );
        let uneven = mesh.clone().with_uvs(vec![[0.0; 2]; 2]);
        assert_eq!(uneven, Err(MeshError::Uneven { attribute: "uvs", count: 2, vertices: 3 }));
        assert!(mesh.with_normals(Vec::new()).is_ok());
        assert_eq!(Mesh::default().bounds(), None);
    }
}
