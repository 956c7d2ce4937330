//! Meshes that look round, and meshes that look cut.

use crate::Mesh;
use glam::DVec3;

/// The most corners at a vertex that are compared with each other.
const MOST_CORNERS: usize = 256;

impl Mesh {
    /// The same triangles without normals: each is flat.
    #[must_use]
    pub fn faceted(&self) -> Self {
        Self { normals: Vec::new(), ..self.clone() }
    }

    /// The same triangles with normals made of theirs: that of a corner is the mean, by area, of the normals of the
    /// triangles around its vertex that are turned from its own triangle by less than an angle, of which the cosine is
    /// given. Where edges are sharper, vertices are doubled, and the edge stays an edge.
    ///
    /// Triangles without an area keep to the vertices that the others left, and do not count. Around a vertex with
    /// more than 256 corners there are no edges.
    #[must_use]
    pub fn smoothed(&self, cos_crease: f64) -> Self {
        let vector = |vertex: u32| DVec3::from(self.positions()[vertex as usize].map(f64::from));
        // Twice the area is the length.
        let normals: Vec<DVec3> = self
            .triangles()
            .iter()
            .map(|&[a, b, c]| (vector(b) - vector(a)).cross(vector(c) - vector(a)))
            .map(|n| if n.is_finite() { n } else { DVec3::ZERO })
            .collect();
        let around = Around::of(self);
        let mut smooth = Self { normals: Vec::with_capacity(self.positions.len()), ..self.clone() };
        smooth.normals.resize(self.positions.len(), [0.0; 3]);
        // The normals that a vertex has so far, and the vertices that stand for them.
        let mut known: Vec<([f32; 3], u32)> = Vec::new();
        for vertex in 0..self.positions.len() {
            known.clear();
            let corners = around.corners(vertex);
            if corners.len() > MOST_CORNERS {
                let sum: DVec3 = corners.iter().map(|corner| normals[*corner as usize / 3]).sum();
                if let Some(normal) = unit(sum) {
                    smooth.normals[vertex] = normal;
                }
                continue;
            }
            for &corner in corners {
                let own = normals[corner as usize / 3];
                let mut sum = DVec3::ZERO;
                for &other in corners {
                    let normal = normals[other as usize / 3];
                    let dot = own.dot(normal);
                    if other == corner || dot > cos_crease * (own.length() * normal.length()) {
                        sum += normal;
                    }
                }
                let Some(normal) = unit(sum) else { continue };
                let found = known.iter().find(|(other, _)| *other == normal).map(|(_, vertex)| *vertex);
                let place = match found {
                    Some(place) => place,
                    None if known.is_empty() => {
                        smooth.normals[vertex] = normal;
                        known.push((normal, vertex as u32));
                        vertex as u32
                    }
                    None => {
                        let Ok(place) = u32::try_from(smooth.positions.len()) else { continue };
                        smooth.positions.push(self.positions[vertex]);
                        smooth.normals.push(normal);
                        smooth.uvs.extend(self.uvs.get(vertex));
                        smooth.colors.extend(self.colors.get(vertex));
                        known.push((normal, place));
                        place
                    }
                };
                smooth.triangles.as_flattened_mut()[corner as usize] = place;
            }
        }
        smooth
    }
}

fn unit(v: DVec3) -> Option<[f32; 3]> {
    let length = v.length();
    (length > 0.0 && length.is_finite()).then(|| (v / length).to_array().map(|x| x as f32))
}

/// The corners at each vertex, in the order of the triangles.
struct Around {
    starts: Vec<u32>,
    corners: Vec<u32>,
}

impl Around {
    fn of(mesh: &Mesh) -> Self {
        let flat = mesh.triangles().as_flattened();
        let mut starts = vec![0u32; mesh.positions().len() + 1];
        for &vertex in flat {
            starts[vertex as usize] += 1;
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        // Filled from the end, so that the starts end up as such.
        let mut corners = vec![0u32; flat.len()];
        for (corner, &vertex) in flat.iter().enumerate().rev() {
            let place = &mut starts[vertex as usize];
            *place -= 1;
            corners[*place as usize] = corner as u32;
        }
        Self { starts, corners }
    }

    fn corners(&self, vertex: usize) -> &[u32] {
        &self.corners[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_edges_vanish_and_sharp_ones_stay() {
        // A roof: two triangles meet at a right angle along x; and one lies beside, in the plane of the first.
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 1.0, 0.0]];
        let mesh = Mesh::new(points, vec![[0, 1, 2], [1, 4, 2], [1, 0, 3], [4, 4, 4]]).unwrap();
        let smooth = mesh.with_uvs(vec![[0.5; 2]; 5]).unwrap().smoothed(0.8);
        assert_eq!((smooth.positions().len(), smooth.normals().len(), smooth.uvs().len()), (7, 7, 7));
        for (number, expected) in [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]].into_iter().enumerate()
        {
            for vertex in smooth.triangles()[number] {
                assert_eq!(smooth.normals()[vertex as usize], expected, "{number}");
            }
        }
        // All round: the shared edge takes the mean, by area.
        let round = smooth.faceted().smoothed(-1.0);
        assert_eq!((smooth.faceted().normals().len(), round.normals().len()), (0, 7));
        assert_eq!(Mesh::default().smoothed(0.5), Mesh::default());
    }
}
