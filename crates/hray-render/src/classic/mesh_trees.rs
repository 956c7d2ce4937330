//! Trees over meshes and over the cells of implicit surfaces, kept from one scene to the next.

use super::geometry::TooManyParts;
use super::implicit::PreparedImplicit;
use super::mesh::PreparedMesh;
use super::shapes::Prepared;
use hray_bvh::MeshError;
use hray_core::{Implicit, Mesh, NoiseTables, Primitive, Shape};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// So many implicit surfaces have as many cells each as are worthwhile; more have fewer.
const FEW: usize = 8;
/// They have at least 2 to the power of this less.
const LEAST_SHARE: u32 = 7;

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
    implicit: Surfaces,
}

/// The same for implicit surfaces.
#[derive(Default)]
struct Surfaces {
    /// By the number of operations and the share of cells.
    known: BTreeMap<(usize, u32), Vec<Arc<PreparedImplicit>>>,
    used: BTreeMap<usize, Arc<PreparedImplicit>>,
    /// Of the cells each of those of the scene in preparation has one part in 2 to the power of this.
    share: u32,
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

    /// Finds out how many implicit surfaces there are, which share cells.
    pub(super) fn share(&mut self, primitives: &[Primitive]) {
        let (mut seen, mut surfaces) = (BTreeSet::new(), BTreeSet::new());
        let mut left: Vec<&Primitive> = primitives.iter().collect();
        while let Some(primitive) = left.pop() {
            if let Shape::Implicit(implicit) = &primitive.shape {
                surfaces.insert(Arc::as_ptr(implicit).addr());
            }
            for part in primitive.shape.operands().into_iter().flatten() {
                // Solids share parts.
                if seen.insert(std::ptr::from_ref(part).addr()) {
                    left.push(part);
                }
            }
        }
        self.implicit.share =
            (surfaces.len().div_ceil(FEW).max(1).next_power_of_two().ilog2()).min(LEAST_SHARE);
    }

    /// A shape that rays go through one at a time; nothing for others.
    pub(super) fn single(
        &mut self,
        shape: &Shape,
        tables: &NoiseTables,
    ) -> Result<Option<Prepared>, TooManyParts> {
        Ok(match shape {
            Shape::Mesh(mesh) => Some(Prepared::Mesh(self.of(mesh).map_err(|_| TooManyParts)?)),
            Shape::Implicit(implicit) => Some(Prepared::Implicit(self.implicit.of(implicit, tables))),
            _ => None,
        })
    }

    /// Forgets what the scene does not have that was prepared just now.
    pub(crate) fn keep_used(&mut self) {
        self.implicit.keep_used();
        let used = std::mem::take(&mut self.used);
        self.known = used.into_values().map(|tree| (Arc::as_ptr(tree.mesh()).addr(), tree)).collect();
        self.alike.clear();
        for (address, tree) in &self.known {
            let numbers = [tree.mesh().triangles().len(), tree.mesh().positions().len()];
            self.alike.entry(numbers).or_default().push(*address);
        }
    }
}

impl Surfaces {
    fn of(&mut self, implicit: &Arc<Implicit>, tables: &NoiseTables) -> Arc<PreparedImplicit> {
        let share = self.share;
        let place = match self.used.entry(Arc::as_ptr(implicit).addr()) {
            Entry::Occupied(used) => return used.get().clone(),
            Entry::Vacant(place) => place,
        };
        let alike = self.known.get(&(implicit.function.nodes().len(), share));
        let known = alike.and_then(|alike| alike.iter().find(|known| known.implicit() == implicit));
        let prepared = match known {
            Some(known) => known.clone(),
            None => Arc::new(PreparedImplicit::new(implicit.clone(), share, tables)),
        };
        place.insert(prepared).clone()
    }

    fn keep_used(&mut self) {
        self.known.clear();
        for surface in std::mem::take(&mut self.used).into_values() {
            let key = (surface.implicit().function.nodes().len(), surface.share());
            self.known.entry(key).or_default().push(surface);
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
