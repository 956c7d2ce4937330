//! The tree, and the walk along a ray through it.

use crate::build::{Primitive, Store, build};
use crate::memory::Array;
use crate::prefetch::prefetch;
use crate::{Bounds, Ray};
use fearless_simd::prelude::*;
use fearless_simd::{f32x8, mask32x8};
use zerocopy::{FromBytes, Immutable, IntoBytes, KnownLayout};

/// How many children a node has.
pub(crate) const WIDTH: usize = 8;

/// What of a child's reference says that it is a leaf.
pub(crate) const LEAF: u32 = 1 << 31;
/// Below it lie the number of units in a leaf, less one, and the first of them.
pub(crate) const COUNT_SHIFT: u32 = 27;
/// The most units in a leaf.
pub(crate) const MOST_UNITS: usize = 16;
/// The most units, or nodes, in a tree.
pub(crate) const MOST: usize = 1 << COUNT_SHIFT;

/// The child where there is none: a root, which is the first of all nodes, is no child.
const NOTHING: u32 = 0;

/// Eight boxes, and what is in them. Four cache lines.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug, PartialEq, FromBytes, IntoBytes, Immutable, KnownLayout)]
pub(crate) struct Node {
    /// Least x, greatest x, least y, ...: so that a ray's direction picks the planes that it comes to first.
    pub(crate) bounds: [[f32; WIDTH]; 6],
    children: [u32; WIDTH],
    /// Fills the last line.
    _rest: [u32; WIDTH],
}

/// A child: a node, or a leaf's units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Child(pub(crate) u32);

impl Child {
    pub(crate) fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) fn leaf(first: usize, count: usize) -> Self {
        Self(LEAF | ((count as u32 - 1) << COUNT_SHIFT) | first as u32)
    }

    /// Moved, where its nodes and units are put behind others.
    fn moved(self, nodes: usize, units: usize) -> Self {
        Self(self.0 + if self.is_leaf() { units as u32 } else { nodes as u32 })
    }

    #[inline(always)]
    pub(crate) fn is_leaf(self) -> bool {
        self.0 & LEAF != 0
    }

    /// A leaf's units.
    #[inline(always)]
    pub(crate) fn units(self) -> std::ops::Range<usize> {
        let first = (self.0 & (MOST as u32 - 1)) as usize;
        first..first + ((self.0 & !LEAF) >> COUNT_SHIFT) as usize + 1
    }
}

impl Node {
    /// No children: boxes that no ray meets.
    pub(crate) const EMPTY: Self = Self {
        bounds: [
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
            [f32::INFINITY; WIDTH],
            [f32::NEG_INFINITY; WIDTH],
        ],
        children: [NOTHING; WIDTH],
        _rest: [0; WIDTH],
    };

    pub(crate) fn set(&mut self, slot: usize, bounds: &Bounds, child: Child) {
        for axis in 0..3 {
            self.bounds[2 * axis][slot] = bounds.min[axis];
            self.bounds[2 * axis + 1][slot] = bounds.max[axis];
        }
        self.children[slot] = child.0;
    }

    #[inline(always)]
    pub(crate) fn child(&self, slot: usize) -> u32 {
        self.children[slot]
    }

    /// The box of all children.
    fn all(&self) -> Bounds {
        let [min_x, max_x, min_y, max_y, min_z, max_z] = &self.bounds;
        let least = |side: &[f32; WIDTH]| side.iter().copied().fold(f32::INFINITY, f32::min);
        let greatest = |side: &[f32; WIDTH]| side.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        Bounds { min: [min_x, min_y, min_z].map(least), max: [max_x, max_y, max_z].map(greatest) }
    }

    /// With all children moved behind others.
    pub(crate) fn moved(&self, nodes: usize, units: usize) -> Self {
        let mut moved = *self;
        for child in moved.children.iter_mut().filter(|child| **child != NOTHING) {
            *child = Child(*child).moved(nodes, units).0;
        }
        moved
    }

    /// Where a ray enters each child, and which it meets between `near` and `far`.
    #[inline(always)]
    pub(crate) fn enter<S: Simd>(&self, simd: S, ray: &Ray, far: f32) -> (f32x8<S>, mask32x8<S>) {
        let [dx, dy, dz] = ray.down;
        let [first, last] = ray.offset;
        let x0 = plane(simd, &self.bounds[dx & 1], ray.inverse[0], first[0]);
        let y0 = plane(simd, &self.bounds[2 + (dy & 1)], ray.inverse[1], first[1]);
        let z0 = plane(simd, &self.bounds[4 + (dz & 1)], ray.inverse[2], first[2]);
        let x1 = plane(simd, &self.bounds[1 - (dx & 1)], ray.inverse[0], last[0]);
        let y1 = plane(simd, &self.bounds[3 - (dy & 1)], ray.inverse[1], last[1]);
        let z1 = plane(simd, &self.bounds[5 - (dz & 1)], ray.inverse[2], last[2]);
        let enter = x0.max(y0).max(z0.max(f32x8::splat(simd, ray.near)));
        let leave = x1.min(y1).min(z1.min(f32x8::splat(simd, far)));
        (enter, enter.simd_le(leave))
    }
}

/// Distances of planes. Whether the machine rounds once or twice makes no difference: the ray's slack covers both, and what
/// leaves find decides.
#[expect(clippy::disallowed_methods, reason = "culls only; no bit of a result depends on it")]
#[inline(always)]
pub(crate) fn plane<S: Simd>(simd: S, planes: &[f32; WIDTH], inverse: f32, offset: f32) -> f32x8<S> {
    let planes: f32x8<S> = (*planes).simd_into(simd);
    planes.mul_add(f32x8::splat(simd, inverse), f32x8::splat(simd, offset))
}

/// Tests what is in a leaf.
pub trait Leaves {
    /// That a unit will be tested soon: it may be brought nearer.
    fn prefetch(&self, unit: usize);

    /// Tests a leaf's units for the nearest hit, takes note of it, and shortens the ray (`ray.far`) to it. What lies as far
    /// as `ray.far` counts.
    fn closest<S: Simd>(&mut self, simd: S, ray: &mut Ray, units: std::ops::Range<usize>);

    /// Whether the ray meets any of a leaf's units.
    fn any<S: Simd>(&mut self, simd: S, ray: &Ray, units: std::ops::Range<usize>) -> bool;
}

/// What a walk has still to visit; made once for many rays.
#[derive(Clone, Debug, Default)]
pub struct Stack {
    /// Distance and child, in one number that sorts by distance. Distances are not negative.
    entries: Vec<u64>,
}

impl Stack {
    /// Makes room for a tree.
    #[inline(always)]
    fn fit(&mut self, tree: &Tree) {
        if self.entries.len() < tree.stack {
            self.entries.resize(tree.stack, 0);
        }
    }
}

/// Of a distance; only a zero can have it.
const SIGN: u32 = 1 << 31;

#[inline(always)]
pub(crate) fn entry(distance: f32, child: u32) -> u64 {
    (u64::from(distance.to_bits() & !SIGN) << 32) | u64::from(child)
}

/// A tree of boxes of eight children.
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    pub(crate) nodes: Array<Node>,
    pub(crate) root: Option<Child>,
    pub(crate) bounds: Bounds,
    /// The greatest coordinate of these.
    pub(crate) reach: f32,
    /// The most entries that a walk leaves for later.
    pub(crate) stack: usize,
}

impl Tree {
    /// Sorts boxes into a tree, whose leaves are tested one thing at a time; and the numbers of the boxes, in the order in which
    /// leaves count them. Empty boxes are left out.
    #[must_use]
    pub fn of_boxes(boxes: &[Bounds]) -> (Self, Vec<u32>) {
        let number = boxes.iter().filter(|bounds| !bounds.is_empty()).count();
        let mut primitives = Array::zeroed(number);
        let all = (0u32..).zip(boxes).filter(|(_, bounds)| !bounds.is_empty());
        for (primitive, (number, bounds)) in primitives.iter_mut().zip(all) {
            *primitive = Primitive::new(bounds, number);
        }
        let (tree, numbers) = build(primitives, &Numbers);
        (tree, numbers.to_vec())
    }

    /// The greatest coordinate, which rays want to know.
    #[must_use]
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// The box of everything.
    #[must_use]
    pub fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.nodes.bytes()
    }

    /// How many nodes there are.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.nodes.len()
    }

    /// Works out all boxes anew, from the bottom up. `leaf` is the box of what is in units.
    pub(crate) fn refit(&mut self, leaf: impl Fn(std::ops::Range<usize>) -> Bounds) {
        let nodes = &mut self.nodes[..];
        let mut bounds = Bounds::EMPTY;
        // A child comes after its parent.
        for index in (0..nodes.len()).rev() {
            let mut node = nodes[index];
            bounds = Bounds::EMPTY;
            for slot in 0..WIDTH {
                let child = Child(node.children[slot]);
                if child.0 == NOTHING {
                    continue;
                }
                let of_child =
                    if child.is_leaf() { leaf(child.units()) } else { nodes[child.0 as usize].all() };
                node.set(slot, &of_child, child);
                bounds = bounds.union(&of_child);
            }
            nodes[index] = node;
        }
        (self.bounds, self.reach) = (bounds, bounds.reach());
    }

    /// Visits leaves from the nearest on, until what remains is farther than `ray.far`. `ray.near` is not negative.
    #[inline(always)]
    pub fn closest<S: Simd>(&self, simd: S, ray: &mut Ray, stack: &mut Stack, leaves: &mut impl Leaves) {
        self.walk(
            simd,
            ray,
            stack,
            leaves,
            #[inline(always)]
            |simd, leaves, ray, units| {
                leaves.closest(simd, ray, units);
                false
            },
        );
    }

    /// Whether a leaf says that the ray meets something of it.
    #[inline(always)]
    pub fn any<S: Simd>(&self, simd: S, ray: &Ray, stack: &mut Stack, leaves: &mut impl Leaves) -> bool {
        let mut ray = *ray;
        self.walk(
            simd,
            &mut ray,
            stack,
            leaves,
            #[inline(always)]
            |simd, leaves, ray, units| leaves.any(simd, ray, units),
        )
    }

    /// Visits every leaf that the ray comes to between its ends, whatever is in it.
    #[inline(always)]
    pub fn visit<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        stack: &mut Stack,
        visit: impl FnMut(std::ops::Range<usize>),
    ) {
        self.closest(simd, &mut ray.clone(), stack, &mut Visit(visit));
    }

    #[inline(always)]
    fn prefetch(nodes: &[Node], child: u32, leaves: &impl Leaves) {
        if child & LEAF != 0 {
            leaves.prefetch((child & (MOST as u32 - 1)) as usize);
        } else if let Some(node) = nodes.get(child as usize) {
            prefetch(node);
        }
    }

    /// The walk; `visit` says whether it is enough.
    #[inline(always)]
    fn walk<S: Simd, L: Leaves>(
        &self,
        simd: S,
        ray: &mut Ray,
        stack: &mut Stack,
        leaves: &mut L,
        visit: impl Fn(S, &mut L, &mut Ray, std::ops::Range<usize>) -> bool,
    ) -> bool {
        let Some(root) = self.root else { return false };
        let nodes = &self.nodes[..];
        stack.fit(self);
        let entries = &mut stack.entries[..];
        let mut top = 0;
        let mut child = root.0;
        loop {
            if child & LEAF == 0 {
                let node = &nodes[child as usize];
                let (enter, met) = node.enter(simd, ray, ray.far);
                let mut met = met.to_bitmask() as u32;
                if met != 0 {
                    let slot = (met.trailing_zeros() & 7) as usize;
                    met &= met - 1;
                    child = node.children[slot];
                    if met == 0 {
                        continue;
                    }
                    Self::prefetch(nodes, child, leaves);
                    let distances: [f32; WIDTH] = enter.into();
                    let mut nearest = entry(distances[slot], child);
                    if met & (met - 1) == 0 {
                        // Two, most often: no loop.
                        let slot = (met.trailing_zeros() & 7) as usize;
                        Self::prefetch(nodes, node.children[slot], leaves);
                        let new = entry(distances[slot], node.children[slot]);
                        entries[top] = nearest.max(new);
                        top += 1;
                        child = nearest.min(new) as u32;
                        continue;
                    }
                    let bottom = top;
                    // Keeps those left for later in order, the nearest last: few are met, so insertion is quickest.
                    while met != 0 {
                        let slot = (met.trailing_zeros() & 7) as usize;
                        met &= met - 1;
                        Self::prefetch(nodes, node.children[slot], leaves);
                        let new = entry(distances[slot], node.children[slot]);
                        let farther = nearest.max(new);
                        nearest = nearest.min(new);
                        let mut at = top;
                        while at > bottom && entries[at - 1] < farther {
                            entries[at] = entries[at - 1];
                            at -= 1;
                        }
                        entries[at] = farther;
                        top += 1;
                    }
                    child = nearest as u32;
                    continue;
                }
            } else {
                if visit(simd, leaves, ray, Child(child).units()) {
                    return true;
                }
            }
            loop {
                if top == 0 {
                    return false;
                }
                top -= 1;
                let next = entries[top];
                if (next >> 32) as u32 <= ray.far.to_bits() {
                    child = next as u32;
                    break;
                }
            }
        }
    }
}

/// Shortens no ray, and finds nothing.
struct Visit<F>(F);

impl<F: FnMut(std::ops::Range<usize>)> Leaves for Visit<F> {
    #[inline(always)]
    fn prefetch(&self, _unit: usize) {}

    #[inline(always)]
    fn closest<S: Simd>(&mut self, _simd: S, _ray: &mut Ray, units: std::ops::Range<usize>) {
        (self.0)(units);
    }

    #[inline(always)]
    fn any<S: Simd>(&mut self, _simd: S, _ray: &Ray, units: std::ops::Range<usize>) -> bool {
        (self.0)(units);
        false
    }
}

/// Leaves of a tree of boxes hold their numbers.
struct Numbers;

impl Store for Numbers {
    type Unit = u32;
    const UNIT: usize = 1;
    const NODE_COST: f32 = 4.0;

    fn unit(&self, primitives: &[Primitive]) -> u32 {
        primitives.first().map_or(u32::MAX, Primitive::number)
    }
}
