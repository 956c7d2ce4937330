//! What a primitive is made of, and which points are inside.

use glam::{DAffine3, DVec3};
use hray_core::{CsgOperation, Primitive, Shape};
use std::sync::Arc;

/// A shape by itself, and where it is.
pub(super) struct Leaf<'a> {
    pub(super) primitive: &'a Primitive,
    pub(super) to_world: Option<Arc<DAffine3>>,
    pub(super) object: u32,
}

impl Leaf<'_> {
    /// Whether a point is inside; none where that is not known, or where nothing is.
    pub(super) fn contains(&self, point: DVec3) -> Option<bool> {
        let p = self.to_world.as_ref().map_or(point, |to_world| to_world.inverse().transform_point3(point));
        Some(match &self.primitive.shape {
            Shape::Sphere(sphere) => p.distance_squared(sphere.center) < sphere.radius * sphere.radius,
            Shape::Plane(plane) => plane.normal.dot(p) + plane.offset < 0.0,
            Shape::Cuboid(cuboid) => p.cmpgt(cuboid.min).all() && p.cmplt(cuboid.max).all(),
            Shape::Frustum(frustum) if frustum.is_capped => {
                let axis = frustum.top - frustum.base;
                let share = (p - frustum.base).dot(axis) / axis.length_squared();
                let [base, top] = frustum.radii;
                let distance = (p - frustum.base - axis * share).length();
                0.0 < share && share < 1.0 && distance < base + (top - base) * share
            }
            Shape::Torus(torus) => {
                let height = (p - torus.center).dot(torus.axis);
                let off = (p - torus.center - torus.axis * height).length() - torus.radius;
                off * off + height * height < torus.tube * torus.tube
            }
            Shape::Quadric(quadric) => {
                let mixed = DVec3::new(p.x * p.y, p.x * p.z, p.y * p.z);
                let square = quadric.square.dot(p * p) + quadric.product.dot(mixed);
                square + quadric.linear.dot(p) + quadric.constant < 0.0
            }
            _ => return None,
        })
    }

    /// Whether a point of the plane that a face is in is not in the face's hole.
    pub(super) fn covers(&self, point: DVec3) -> bool {
        let Shape::Disc(disc) = &self.primitive.shape else { return true };
        let p = self.to_world.as_ref().map_or(point, |to_world| to_world.inverse().transform_point3(point));
        p.distance(disc.center) > disc.hole
    }

    /// What the distance to a face of a box is worked out from.
    pub(super) fn slab(&self, side: u8) -> Option<[f64; 5]> {
        let Shape::Cuboid(cuboid) = &self.primitive.shape else { return None };
        let axis = usize::from(side / 2);
        let at = if side % 2 == 1 { cuboid.max[axis] } else { cuboid.min[axis] };
        let to_object = self.to_world.as_ref().map_or(DAffine3::IDENTITY, |to_world| to_world.inverse());
        let DAffine3 { matrix3: m, translation } = to_object;
        Some([m.x_axis[axis], m.y_axis[axis], m.z_axis[axis], translation[axis], at])
    }

    /// Whether it is a surface that can be seen from both sides.
    pub(super) fn is_open(&self) -> bool {
        match &self.primitive.shape {
            Shape::Plane(_) | Shape::Disc(_) => true,
            Shape::Frustum(frustum) => !frustum.is_capped,
            _ => false,
        }
    }
}

#[derive(Clone, Copy)]
enum Made {
    Leaf(usize),
    Csg(CsgOperation, [usize; 2]),
    Inverse(usize),
    Clip([usize; 2]),
}

/// Operations on the leaves of one primitive, in the order of [`Primitive::leaves`].
pub(super) struct Tree {
    /// Operands before what is made of them.
    nodes: Vec<Made>,
    surface: usize,
    within: Vec<usize>,
    /// How many leaves belong to what is clipped, or to the whole.
    of_surface: usize,
}

impl Tree {
    /// Adds the leaves of a primitive that is made of others.
    pub(super) fn new<'a>(primitive: &'a Primitive, object: u32, leaves: &mut Vec<Leaf<'a>>) -> Self {
        enum Task<'a> {
            Visit(&'a Primitive, Option<Arc<DAffine3>>),
            Csg(CsgOperation),
            Inverse,
            Clip,
        }
        let first = leaves.len();
        let (mut nodes, mut made): (Vec<Made>, Vec<usize>) = (Vec::new(), Vec::new());
        // Leaves of the surface are there before those that it is clipped by.
        let mut counts: Vec<usize> = Vec::new();
        let mut tasks = vec![Task::Visit(primitive, None)];
        while let Some(task) = tasks.pop() {
            let node = match task {
                Task::Visit(part, outer) => {
                    let to_world = match (outer, &part.transform) {
                        (Some(outer), Some(inner)) => Some(Arc::new(*outer * **inner)),
                        (outer, inner) => outer.or_else(|| inner.clone()),
                    };
                    let then = match &part.shape {
                        Shape::Csg(csg) => Task::Csg(csg.operation),
                        Shape::Inverse(_) => Task::Inverse,
                        Shape::Clip(_) => Task::Clip,
                        _ => {
                            let leaf = leaves.len() - first;
                            leaves.push(Leaf { primitive: part, to_world, object });
                            nodes.push(Made::Leaf(leaf));
                            counts.push(leaf + 1);
                            made.push(nodes.len() - 1);
                            continue;
                        }
                    };
                    tasks.push(then);
                    let operands = part.shape.operands().into_iter().flatten().rev();
                    tasks.extend(operands.map(|operand| Task::Visit(operand, to_world.clone())));
                    continue;
                }
                Task::Inverse => {
                    let Some(solid) = made.pop() else { continue };
                    Made::Inverse(solid)
                }
                Task::Csg(_) | Task::Clip => {
                    let [Some(b), Some(a)] = [made.pop(), made.pop()] else { continue };
                    if let Task::Csg(operation) = task {
                        Made::Csg(operation, [a, b])
                    } else {
                        Made::Clip([a, b])
                    }
                }
            };
            nodes.push(node);
            counts.push(leaves.len() - first);
            made.push(nodes.len() - 1);
        }
        let mut surface = nodes.len().saturating_sub(1);
        let mut within = Vec::new();
        while let Some(Made::Clip([shape, solid])) = nodes.get(surface) {
            within.push(*solid);
            surface = *shape;
        }
        let of_surface = counts.get(surface).copied().unwrap_or(0);
        Self { nodes, surface, within, of_surface }
    }

    /// How much work it is to look at a point.
    pub(super) fn work(&self) -> usize {
        self.nodes.len()
    }

    /// Whether a leaf's surface is seen, and not only that of what lies in it.
    pub(super) fn is_of_surface(&self, leaf: usize) -> bool {
        leaf < self.of_surface
    }

    /// Whether it is a single shape that is clipped, which needs no inside.
    pub(super) fn is_clipped_leaf(&self) -> bool {
        self.is_clipped()
            && self.of_surface == 1
            && matches!(self.nodes.get(self.surface), Some(Made::Leaf(_)))
    }

    pub(super) fn is_clipped(&self) -> bool {
        !self.within.is_empty()
    }

    /// Whether a point is inside, from the leaves that it is in, and whether its surface would be seen there.
    pub(super) fn values(&self, inside: &[bool]) -> [bool; 2] {
        let mut values: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let value = match *node {
                Made::Leaf(leaf) => inside[leaf],
                Made::Inverse(solid) => !values[solid],
                Made::Clip(_) => false,
                Made::Csg(operation, [a, b]) => {
                    let (a, b) = (values[a], values[b]);
                    match operation {
                        CsgOperation::Union => a | b,
                        CsgOperation::Intersection => a & b,
                        CsgOperation::Difference => a & !b,
                    }
                }
            };
            values.push(value);
        }
        [values.get(self.surface).copied().unwrap_or(false), self.within.iter().all(|&solid| values[solid])]
    }
}
