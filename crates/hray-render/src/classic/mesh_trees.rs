//! Trees over meshes, kept from one scene to the next.

use super::mesh::PreparedMesh;
use hray_bvh::MeshError;
use hray_core::Mesh;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

/// The trees over the meshes of the scene that was prepared last: where the next one has the same meshes, as after an edit
/// that did not concern them, they need not be built again.
#[derive(Default)]
pub struct MeshTrees {
    /// By the addresses of the meshes, which the trees keep alive.
    known: BTreeMap<usize, Arc<PreparedMesh>>,
    /// The same by the numbers of their triangles and vertices: another mesh may hold the same.
    alike: BTreeMap<[usize; 2], Vec<usize>>,
    /// Those that the scene in preparation has.
    used: BTreeMap<usize, Arc<PreparedMesh>>,
}

impl std::fmt::Debug for MeshTrees {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MeshTrees").field("known", &self.known.len()).finish_non_exhaustive()
    }
}

impl MeshTrees {
    /// How many trees are kept.
    #[must_use]
    pub fn len(&self) -> usize {
        self.known.len()
    }

    /// Whether none is kept.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.known.is_empty()
    }

    /// The tree over a mesh, built where it is not known.
    pub(super) fn of(&mut self, mesh: &Arc<Mesh>) -> Result<Arc<PreparedMesh>, MeshError> {
        let place = match self.used.entry(Arc::as_ptr(mesh).addr()) {
            Entry::Occupied(used) => return Ok(used.get().clone()),
            Entry::Vacant(place) => place,
        };
        let numbers = [mesh.triangles().len(), mesh.positions().len()];
        let known = self.known.get(place.key()).or_else(|| {
            let alike = self.alike.get(&numbers)?.iter().filter_map(|address| self.known.get(address));
            alike.into_iter().find(|known| same(known.mesh(), mesh))
        });
        let prepared = match known {
            Some(known) => known.clone(),
            None => Arc::new(PreparedMesh::new(mesh.clone())?),
        };
        Ok(place.insert(prepared).clone())
    }

    /// Forgets what the scene does not have that was prepared just now.
    pub(crate) fn keep_used(&mut self) {
        let used = std::mem::take(&mut self.used);
        self.known = used.into_values().map(|tree| (Arc::as_ptr(tree.mesh()).addr(), tree)).collect();
        self.alike.clear();
        for (address, tree) in &self.known {
            let numbers = [tree.mesh().triangles().len(), tree.mesh().positions().len()];
            self.alike.entry(numbers).or_default().push(*address);
        }
    }
}

/// Whether two meshes are the same to the bit.
fn same(a: &Mesh, b: &Mesh) -> bool {
    fn bits<const N: usize>(a: &[[f32; N]], b: &[[f32; N]]) -> bool {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.map(f32::to_bits) == b.map(f32::to_bits))
    }
    a.triangles() == b.triangles()
        && bits(a.positions(), b.positions())
        && bits(a.normals(), b.normals())
        && bits(a.uvs(), b.uvs())
        && bits(a.colors(), b.colors())
}
