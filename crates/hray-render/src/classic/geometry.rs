//! Everything that can be hit, laid out for rays.

use super::accelerate::{Accelerated, accelerate};
use super::material::Materials;
use super::mesh_trees::MeshTrees;
use super::placement::Placement;
use super::round::MOST_INTERVALS;
use super::shapes::Prepared;
use super::solid::{Made, Node, Ray, Solid, intervals};
use hray_core::{Csg, CsgOperation, DAffine3, Integrator, Primitive, Shape};
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

/// The most leaves that the solids of a scene may have together: solids that share operands can have more than any
/// memory holds.
pub const MAX_SOLID_PARTS: usize = 1 << 22;

/// A solid has too many parts.
pub(crate) struct TooManyParts;

/// What a hit is on: a primitive, or a part of a solid.
#[derive(Clone, Copy)]
struct Leaf {
    material: u32,
    /// Twice its placement, or [`NOT_PLACED`], and one more where it is turned inside out.
    place: u32,
}

const NOT_PLACED: u32 = u32::MAX >> 1;

/// What rays are intersected with, in the order in which that is done: the reverse of the source's.
pub(super) enum Root {
    /// Leaves in world space.
    Plain(Range<u32>),
    /// Leaves with a placement.
    Placed(Range<u32>),
    Solid(u32),
    /// A leaf that rays go through one at a time.
    Single(u32),
}

/// All leaves, and how they make what is hit.
pub(super) struct Geometry {
    shapes: Vec<Prepared>,
    leaves: Vec<Leaf>,
    placements: Vec<Placement>,
    pub(super) solids: Vec<Solid>,
    pub(super) roots: Vec<Root>,
    /// What is bounded, if there is enough of it: then `roots` are all others.
    pub(super) tree: Option<Accelerated>,
    /// A hit must be farther away than this.
    pub(super) nearest: f64,
}

impl Geometry {
    pub(super) fn new(
        primitives: &[Primitive],
        integrator: Integrator,
        materials: &mut Materials,
        meshes: &mut MeshTrees,
    ) -> Result<Self, TooManyParts> {
        let thesis = integrator == Integrator::Classic2005;
        let mut geometry = Self {
            shapes: Vec::with_capacity(primitives.len()),
            leaves: Vec::with_capacity(primitives.len()),
            placements: Vec::new(),
            solids: Vec::new(),
            roots: Vec::new(),
            tree: None,
            nearest: if thesis { super::shapes::NEAREST } else { 0.0 },
        };
        let mut places = Places::default();
        let mut parts = 0;
        meshes.share(primitives);
        for primitive in primitives.iter().rev() {
            let first = geometry.shapes.len() as u32;
            if let Some(shape) = meshes.single(&primitive.shape, materials.plans.tables())? {
                let place = places.of(primitive.transform.as_ref(), &mut geometry.placements);
                let leaf = Leaf { material: materials.of(&primitive.material), place: place << 1 };
                geometry.roots.push(Root::Single(first));
                geometry.add_leaf(shape, leaf);
            } else if let Some(shape) = Prepared::new(&primitive.shape, integrator) {
                let place = places.of(primitive.transform.as_ref(), &mut geometry.placements);
                let leaf = Leaf { material: materials.of(&primitive.material), place: place << 1 };
                geometry.add_leaf(shape, leaf);
                geometry.extend_roots(first, place != NOT_PLACED);
            } else {
                let solid = geometry.solid(primitive, integrator, materials, meshes, &mut places)?;
                parts += solid.leaves.len();
                if parts > MAX_SOLID_PARTS {
                    return Err(TooManyParts);
                }
                geometry.roots.push(Root::Solid(geometry.solids.len() as u32));
                geometry.solids.push(solid);
            }
        }
        accelerate(&mut geometry);
        Ok(geometry)
    }

    fn add_leaf(&mut self, shape: Prepared, leaf: Leaf) {
        self.shapes.push(shape);
        self.leaves.push(leaf);
    }

    fn extend_roots(&mut self, leaf: u32, placed: bool) {
        match self.roots.last_mut() {
            Some(Root::Plain(run)) if !placed => run.end = leaf + 1,
            Some(Root::Placed(run)) if placed => run.end = leaf + 1,
            _ if placed => self.roots.push(Root::Placed(leaf..leaf + 1)),
            _ => self.roots.push(Root::Plain(leaf..leaf + 1)),
        }
    }

    /// Adds the leaves of a solid in the order of the source.
    fn solid(
        &mut self,
        primitive: &Primitive,
        integrator: Integrator,
        materials: &mut Materials,
        meshes: &mut MeshTrees,
        places: &mut Places,
    ) -> Result<Solid, TooManyParts> {
        enum Task<'a> {
            Visit { part: &'a Primitive, outer: Option<Arc<DAffine3>>, turned: bool },
            Make(CsgOperation),
            Invert,
            Clip,
        }
        let first = self.shapes.len() as u32;
        let (mut nodes, mut leaves, mut made) = (Vec::<Node>::new(), Vec::new(), Vec::<u32>::new());
        let mut tasks = vec![Task::Visit { part: primitive, outer: None, turned: false }];
        while let Some(task) = tasks.pop() {
            let node = nodes.len() as u32;
            let this = match task {
                Task::Visit { part, outer, turned } => {
                    let transform = compose(outer, part.transform.as_ref());
                    let visit = |part, turned| Task::Visit { part, outer: transform.clone(), turned };
                    let shape = match &part.shape {
                        Shape::Csg(csg) => {
                            let Csg { operation, operands: [a, b] } = &**csg;
                            let turned_b = turned != (*operation == CsgOperation::Difference);
                            tasks.extend([Task::Make(*operation), visit(b, turned_b), visit(a, turned)]);
                            continue;
                        }
                        Shape::Inverse(solid) => {
                            tasks.extend([Task::Invert, visit(solid, !turned)]);
                            continue;
                        }
                        Shape::Clip(clip) => {
                            tasks.extend([
                                Task::Clip,
                                visit(&clip.within, false),
                                visit(&clip.shape, turned),
                            ]);
                            continue;
                        }
                        shape => match meshes.single(shape, materials.plans.tables())? {
                            None => Prepared::new(shape, integrator),
                            single => single,
                        },
                    };
                    if leaves.len() == MAX_SOLID_PARTS {
                        return Err(TooManyParts);
                    }
                    if let Some(shape) = shape {
                        let place = places.of(transform.as_ref(), &mut self.placements);
                        let place = place << 1 | u32::from(turned);
                        self.add_leaf(shape, Leaf { material: materials.of(&part.material), place });
                    }
                    leaves.push(node);
                    Made::Leaf
                }
                Task::Invert => {
                    let Some(solid) = made.pop() else { continue };
                    nodes[solid as usize].parent = node;
                    Made::Inverse(solid)
                }
                Task::Make(_) | Task::Clip => {
                    let [Some(b), Some(a)] = [made.pop(), made.pop()] else { continue };
                    nodes[a as usize].parent = node;
                    nodes[b as usize].parent = node;
                    if let Task::Make(operation) = task {
                        Made::Csg(operation, [a, b])
                    } else {
                        Made::Clip([a, b])
                    }
                }
            };
            nodes.push(Node { made: this, parent: node });
            made.push(node);
        }
        Ok(Solid::new(first, leaves, nodes))
    }

    /// Whether any leaf is a mesh.
    pub(super) fn has_meshes(&self) -> bool {
        self.shapes.iter().any(|shape| matches!(shape, Prepared::Mesh(_)))
    }

    /// Whether rays go through a leaf one at a time.
    pub(super) fn is_single(&self, leaf: usize) -> bool {
        matches!(&self.shapes[leaf], Prepared::Mesh(_) | Prepared::Implicit(_))
    }

    /// Whether a leaf is a mesh.
    pub(super) fn is_mesh(&self, leaf: usize) -> bool {
        matches!(&self.shapes[leaf], Prepared::Mesh(_))
    }

    /// Whether a leaf is a mesh with normals to shade with.
    pub(super) fn is_smooth(&self, leaf: usize) -> bool {
        matches!(&self.shapes[leaf], Prepared::Mesh(mesh) if mesh.is_smooth())
    }

    /// What the leaves take.
    #[cfg(test)]
    pub(super) fn bytes(&self) -> usize {
        let Self { shapes, leaves, placements, .. } = self;
        size_of_val(&shapes[..]) + size_of_val(&leaves[..]) + size_of_val(&placements[..])
    }

    /// How many leaves there are.
    pub(super) fn len(&self) -> usize {
        self.leaves.len()
    }

    /// Whether any of them is not in world space.
    pub(super) fn is_placed(&self) -> bool {
        !self.placements.is_empty()
    }

    pub(super) fn shape(&self, leaf: usize) -> &Prepared {
        &self.shapes[leaf]
    }

    /// The shapes of a run of leaves.
    pub(super) fn run(&self, leaves: &Range<u32>) -> &[Prepared] {
        &self.shapes[leaves.start as usize..leaves.end as usize]
    }

    pub(super) fn solid_at(&self, solid: u32) -> &Solid {
        &self.solids[solid as usize]
    }

    pub(super) fn material(&self, leaf: usize) -> usize {
        self.leaves[leaf].material as usize
    }

    pub(super) fn placement(&self, leaf: usize) -> Option<&Placement> {
        self.placements.get((self.leaves[leaf].place >> 1) as usize)
    }

    /// Whether the surface is that of something cut away.
    pub(super) fn is_turned(&self, leaf: usize) -> bool {
        self.leaves[leaf].place & 1 == 1
    }

    /// A ray in a leaf's own space.
    #[inline(always)]
    pub(super) fn own_ray(&self, leaf: usize, ray: &Ray) -> Ray {
        self.placement(leaf).map_or(*ray, |placement| placement.ray(ray))
    }

    /// The distances between which a ray is inside a leaf.
    pub(super) fn intervals(&self, leaf: usize, ray: &Ray) -> [[f64; 2]; MOST_INTERVALS] {
        match self.placement(leaf) {
            None => intervals(&self.shapes[leaf], ray),
            Some(placement) => intervals(&self.shapes[leaf], &placement.ray(ray)),
        }
    }
}

/// Placements already there, by where their transform is kept: primitives share them.
#[derive(Default)]
struct Places {
    known: HashMap<usize, u32>,
}

impl Places {
    fn of(&mut self, transform: Option<&Arc<DAffine3>>, placements: &mut Vec<Placement>) -> u32 {
        let Some(transform) = transform else { return NOT_PLACED };
        // A placement keeps its transform, so the address stays that transform's.
        *self.known.entry(Arc::as_ptr(transform).addr()).or_insert_with(|| {
            placements.push(Placement::new(transform.clone()));
            placements.len() as u32 - 1
        })
    }
}

fn compose(outer: Option<Arc<DAffine3>>, inner: Option<&Arc<DAffine3>>) -> Option<Arc<DAffine3>> {
    match (outer, inner) {
        (Some(outer), Some(inner)) => Some(Arc::new(*outer * **inner)),
        (outer, None) => outer,
        (None, Some(inner)) => Some(inner.clone()),
    }
}
