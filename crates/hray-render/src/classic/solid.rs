//! Constructive solid geometry, one ray at a time.
//!
//! A ray is inside a leaf of a solid over one interval of distances, or over several where it is not convex. The ends of all
//! intervals are sorted; on the way along the ray each end changes one leaf, which is carried up the tree of operations as
//! far as something changes. Where the root changes the ray meets the solid's surface. What is cut away is known
//! for each leaf beforehand: a surface is turned inside out where an odd number of differences lie above its second
//! operand.
//!
//! A shape that is clipped is walked in the same way: its surface, or that of the solid that it is, counts where the
//! operations of what it is clipped by are inside. A clipped shape by itself needs no inside: its surface is met, and nothing
//! changes.
//!
//! Leaves whose boxes a ray does not meet are left out: a tree over the boxes tells which (`solid_boxes.rs`).
//!
//! The tree of operations is a list in which operands come before what is made of them; nothing here recurses.

use super::crossings::Crossing;
use super::geometry::Geometry;
use super::implicit;
use super::round::{MOST_INTERVALS, NOWHERE};
use super::shapes::{PARALLEL, Prepared};
use super::solid_boxes::Boxes;
use fearless_simd::Simd;
use hray_bvh::{PacketStack, Stack};
use hray_core::{CsgOperation, DVec3};

/// One ray.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    pub(super) origin: DVec3,
    pub(super) direction: DVec3,
}

/// A solid made of others, or a shape that is clipped by solids.
pub(super) struct Solid {
    /// Its leaves follow one upon the other in the scene's; this is the first.
    pub(super) first: u32,
    /// The node of each leaf.
    pub(super) leaves: Box<[u32]>,
    /// Operands before what is made of them; the last is the whole.
    pub(super) nodes: Box<[Node]>,
    /// Whether each node is inside, outside of all leaves.
    outside: Box<[bool]>,
    /// The node whose surface is seen.
    pub(super) surface: u32,
    /// Nodes of which each has to be inside where the surface is seen.
    pub(super) within: Box<[u32]>,
    /// The boxes around its leaves, where it has many.
    pub(super) boxes: Option<Boxes>,
}

/// A leaf or an operation.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub(super) made: Made,
    /// The node that this is an operand of; of the whole, itself.
    pub(super) parent: u32,
}

/// Of what a node is made.
#[derive(Clone, Copy)]
pub(super) enum Made {
    Leaf,
    Csg(CsgOperation, [u32; 2]),
    Inverse(u32),
    /// A surface, and what it is left within. It has no inside.
    Clip([u32; 2]),
}

/// What one thread needs to walk along rays.
#[derive(Default)]
pub(super) struct Walk {
    inside: Vec<bool>,
    ends: Vec<End>,
    crossings: Vec<Crossing>,
    /// Leaves of a solid that a ray may meet.
    pub(super) met: Vec<u32>,
    /// In the tree over everything.
    pub(super) packets: PacketStack,
    /// In a tree over a mesh, a solid or the cells of an implicit surface.
    pub(super) stack: Stack,
    pub(super) implicit: implicit::Scratch,
}

/// What happens to a ray at a leaf.
#[derive(Clone, Copy, PartialEq)]
enum Event {
    Enters,
    Leaves,
    /// It meets the surface of a clipped shape.
    Meets,
}

/// Where something happens to a ray.
#[derive(Clone, Copy)]
struct End {
    at: f64,
    leaf: u32,
    event: Event,
    /// Where the leaf is a mesh.
    triangle: u32,
}

/// Where a ray meets a solid.
#[derive(Clone, Copy)]
pub(super) struct SolidHit {
    pub(super) at: f64,
    /// The leaf, among all of the scene.
    pub(super) leaf: usize,
    /// Which of its triangles, where it is a mesh.
    pub(super) triangle: u32,
}

impl Solid {
    pub(super) fn new(first: u32, leaves: Vec<u32>, nodes: Vec<Node>) -> Self {
        let mut surface = nodes.len().saturating_sub(1);
        let mut within = Vec::new();
        while let Some(Made::Clip([shape, solid])) = nodes.get(surface).map(|node| node.made) {
            within.push(solid);
            surface = shape as usize;
        }
        let mut solid = Self {
            first,
            leaves: leaves.into(),
            outside: vec![false; nodes.len()].into(),
            nodes: nodes.into(),
            surface: surface as u32,
            within: within.into(),
            boxes: None,
        };
        for node in 0..solid.nodes.len() {
            solid.outside[node] = solid.value(node, &solid.outside);
        }
        solid
    }

    /// Whether a leaf is the shape that is clipped.
    fn is_clipped(&self, leaf: u32) -> bool {
        !self.within.is_empty() && self.leaves[leaf as usize] == self.surface
    }

    /// The nearest distance beyond `geometry.nearest`, and not beyond `far`, at which a ray meets the surface, and the leaf
    /// that it belongs to there. Of several leaves in the same place, the one that is written last.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        ray: &Ray,
        far: f64,
        walk: &mut Walk,
    ) -> Option<SolidHit> {
        match &self.boxes {
            Some(boxes) => boxes.meet(simd, ray, far, walk),
            None => {
                walk.met.clear();
                walk.met.extend(0..self.leaves.len() as u32);
            }
        }
        self.hit_of(simd, geometry, ray, walk).filter(|hit| hit.at <= far)
    }

    /// The same among the leaves in `walk.met`.
    fn hit_of<S: Simd>(&self, simd: S, geometry: &Geometry, ray: &Ray, walk: &mut Walk) -> Option<SolidHit> {
        let Walk { inside, ends, met, crossings, stack, implicit, .. } = walk;
        if met.is_empty() {
            return None;
        }
        inside.clear();
        inside.extend_from_slice(&self.outside);
        ends.clear();
        let ahead = |at: f64| at > geometry.nearest && at < f64::INFINITY;
        for &leaf in met.iter() {
            let index = self.first as usize + leaf as usize;
            if self.is_clipped(leaf) {
                let (event, ray) = (Event::Meets, geometry.own_ray(index, ray));
                if geometry.is_single(index) {
                    match geometry.shape(index) {
                        Prepared::Mesh(mesh) => mesh.meet(simd, &ray, geometry.nearest, stack, crossings),
                        Prepared::Implicit(surface) => {
                            surface.meet(simd, &ray, geometry.nearest, stack, implicit, crossings);
                        }
                        _ => {}
                    }
                    ends.extend(crossings.iter().map(|crossing| {
                        let Crossing { at, triangle, .. } = *crossing;
                        End { at, leaf, event, triangle }
                    }));
                } else {
                    meet(geometry.shape(index), &ray, |at| {
                        ends.extend(ahead(at).then_some(End { at, leaf, event, triangle: 0 }));
                    });
                }
                continue;
            }
            if geometry.is_single(index) {
                let ray = geometry.own_ray(index, ray);
                let starts_inside = match geometry.shape(index) {
                    Prepared::Mesh(mesh) => mesh.crossings(simd, &ray, geometry.nearest, stack, crossings),
                    Prepared::Implicit(surface) => {
                        surface.crossings(simd, &ray, geometry.nearest, stack, implicit, crossings)
                    }
                    _ => false,
                };
                if starts_inside {
                    self.change(leaf, true, inside);
                }
                ends.extend(crossings.iter().map(|crossing| {
                    let Crossing { at, turns, triangle } = *crossing;
                    End { at, leaf, event: if turns == 0 { Event::Leaves } else { Event::Enters }, triangle }
                }));
                continue;
            }
            for [enter, exit] in geometry.intervals(index, ray) {
                // Not where one is no number.
                if enter < exit {
                    if enter <= geometry.nearest && geometry.nearest < exit {
                        self.change(leaf, true, inside);
                    }
                    let end = |at, event| ahead(at).then_some(End { at, leaf, event, triangle: 0 });
                    ends.extend(end(enter, Event::Enters));
                    ends.extend(end(exit, Event::Leaves));
                }
            }
        }
        if ends.is_empty() {
            return None;
        }
        ends.sort_unstable_by(|a, b| {
            a.at.total_cmp(&b.at).then(a.leaf.cmp(&b.leaf)).then(a.triangle.cmp(&b.triangle))
        });
        let surface = self.surface as usize;
        for together in ends.chunk_by(|a, b| a.at == b.at) {
            let before = inside[surface];
            // A solid that something is clipped by has its own surface.
            let was_within = self.is_within(inside);
            for end in together {
                if end.event != Event::Meets {
                    self.change(end.leaf, end.event == Event::Enters, inside);
                }
            }
            let after = inside[surface];
            let met = if after != before {
                // The surface of a leaf that is turned inside out is entered where the leaf is left.
                let fits = |end: &&End| {
                    let index = self.first as usize + end.leaf as usize;
                    ((end.event == Event::Enters) != geometry.is_turned(index)) == after
                };
                together.iter().rev().find(fits).or(together.last())
            } else {
                together.iter().rev().find(|end| end.event == Event::Meets)
            };
            if let Some(end) = met
                && (was_within || self.is_within(inside))
            {
                let leaf = self.first as usize + end.leaf as usize;
                return Some(SolidHit { at: end.at, leaf, triangle: end.triangle });
            }
        }
        None
    }

    /// Whether the surface is seen here, whatever it is clipped by.
    fn is_within(&self, inside: &[bool]) -> bool {
        self.within.iter().all(|&node| inside[node as usize])
    }

    /// Whether a node is inside, from its operands.
    fn value(&self, node: usize, inside: &[bool]) -> bool {
        match self.nodes[node].made {
            Made::Leaf => inside[node],
            Made::Inverse(solid) => !inside[solid as usize],
            Made::Clip(_) => false,
            Made::Csg(operation, [first, second]) => {
                let (first, second) = (inside[first as usize], inside[second as usize]);
                match operation {
                    CsgOperation::Union => first | second,
                    CsgOperation::Intersection => first & second,
                    CsgOperation::Difference => first & !second,
                }
            }
        }
    }

    /// Enters or leaves a leaf, and what is made of it.
    fn change(&self, leaf: u32, enters: bool, inside: &mut [bool]) {
        let mut node = self.leaves[leaf as usize] as usize;
        inside[node] = enters;
        loop {
            let parent = self.nodes[node].parent as usize;
            if parent == node {
                break;
            }
            let value = self.value(parent, inside);
            if inside[parent] == value {
                break;
            }
            inside[parent] = value;
            node = parent;
        }
    }
}

/// The distances between which a ray is inside a shape, in its own space, in ascending order; no numbers for what there is
/// not.
pub(super) fn intervals(shape: &Prepared, ray: &Ray) -> [[f64; 2]; MOST_INTERVALS] {
    match shape {
        Prepared::Round { shape, .. } => shape.intervals(ray),
        _ => [interval(shape, ray), NOWHERE],
    }
}

/// All distances at which a ray meets the surface of a shape, in its own space, in whatever order; some may be no numbers.
fn meet(shape: &Prepared, ray: &Ray, each: impl FnMut(f64)) {
    match shape {
        Prepared::Round { shape, .. } => shape.meet(ray, each),
        _ => {
            let [enter, exit] = interval(shape, ray);
            // Also where both are the same, in a flat box.
            if enter <= exit {
                [enter, exit].into_iter().for_each(each);
            }
        }
    }
}

/// The distances between which a ray is inside what is convex; in the operations and the order of the lanes.
fn interval(shape: &Prepared, ray: &Ray) -> [f64; 2] {
    let dot = |a: DVec3, b: DVec3| a.x * b.x + a.y * b.y + a.z * b.z;
    let nowhere = NOWHERE;
    let Ray { origin, direction } = *ray;
    match *shape {
        Prepared::Sphere { center, squared_radius, .. } => {
            let from_center = origin - center;
            let a = dot(direction, direction);
            let b = dot(direction, from_center) * 2.0;
            let c = dot(from_center, from_center) - squared_radius;
            let discriminant = b * b - a * 4.0 * c;
            if discriminant > 0.0 {
                let root = discriminant.sqrt();
                [(-b - root) / (a * 2.0), (root - b) / (a * 2.0)]
            } else {
                nowhere
            }
        }
        Prepared::Plane { normal, offset, .. } => {
            let (height, slope) = (dot(normal, origin) + offset, dot(normal, direction));
            below(height, if slope.abs() < PARALLEL { 0.0 } else { slope })
        }
        Prepared::ExactPlane { unit, offset } => below(dot(unit, origin) + offset, dot(unit, direction)),
        Prepared::ExactSphere { center, radius } => {
            let a = dot(direction, direction);
            let from_center = origin - center;
            let b = -dot(from_center, direction);
            let c = dot(from_center, from_center) - radius * radius;
            let nearest = from_center + direction * (b / a);
            let discriminant = radius * radius - dot(nearest, nearest);
            if discriminant >= 0.0 {
                let q = b + (discriminant * a).sqrt().copysign(b);
                let (t0, t1) = (c / q, q / a);
                if t0 < t1 { [t0, t1] } else { [t1, t0] }
            } else {
                nowhere
            }
        }
        Prepared::Cuboid { min, max, .. } => {
            let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
            for axis in 0..3 {
                let low = (min[axis] - origin[axis]) / direction[axis];
                let high = (max[axis] - origin[axis]) / direction[axis];
                if !low.is_nan() && !high.is_nan() {
                    let (near, far) = if low < high { (low, high) } else { (high, low) };
                    enter = if near > enter { near } else { enter };
                    exit = if far < exit { far } else { exit };
                }
            }
            [enter, exit]
        }
        // Not convex.
        Prepared::Mesh(_) | Prepared::Implicit(_) | Prepared::Round { .. } => nowhere,
    }
}

/// The distances between which a ray is below a plane, from its height above it and the growth of that.
fn below(height: f64, slope: f64) -> [f64; 2] {
    let at = -(height / slope);
    if slope < 0.0 {
        [at, f64::INFINITY]
    } else if slope > 0.0 {
        [f64::NEG_INFINITY, at]
    } else if height < 0.0 {
        [f64::NEG_INFINITY, f64::INFINITY]
    } else {
        [f64::NAN; 2]
    }
}
