//! A tree over what is bounded, for scenes with many objects.

use super::geometry::{Geometry, Root};
use super::placement::Placement;
use super::shapes::{Prepared, Rays};
use super::solid::{Ray, Solid, Walk};
use super::trace::{Nearest, mesh_hit, mesh_shadow, placed_hit, solid_hit};
use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use hray_bvh::{AnyLeaves, Bounds, ClosestLeaves, Leaves, MOST_RAYS, Packet, Tree};
use hray_core::{CsgOperation, DVec3};
use hray_expr::kernels::lanes::{Lanes, Mask, Vec3};
use std::ops::Range;

/// With fewer bounded objects trying all of them is quicker.
const WORTHWHILE: usize = 12;
/// So few leaves of a solid as well.
const WORTHWHILE_IN_SOLIDS: usize = 4;
/// More cannot be numbered.
const MOST: usize = 1 << 27;
/// Coordinates of greater magnitude, from the middle of everything, are left out of the tree: their squares, and products with
/// reciprocals of directions, could leave the range of single precision.
const FARTHEST: f64 = 1e15;
/// Trees of smaller things could as well.
const SMALLEST: f64 = 1e-15;

/// What is bounded, in a tree.
pub(super) struct Accelerated {
    tree: Tree,
    /// What the units of leaves are.
    items: Vec<Item>,
    /// The origin of the tree's coordinates, so that these are as exact far away from the world's as near it.
    center: DVec3,
}

#[derive(Clone, Copy)]
enum Item {
    Plain(u32),
    Placed(u32),
    Mesh(u32),
    Solid(u32),
}

/// Two corners; infinite ones, and ones that are no numbers, for what has no bounds.
type Corners = [DVec3; 2];

const EVERYWHERE: Corners = [DVec3::NEG_INFINITY, DVec3::INFINITY];

/// Moves what is bounded from the roots to a tree, if that is worth it.
pub(super) fn accelerate(geometry: &mut Geometry) {
    let (mut items, mut boxes, mut others) = (Vec::new(), Vec::new(), Vec::new());
    let mut sort = |item: Item, corners: Corners, other: Root| {
        if is_bounded(&corners) && items.len() < MOST {
            items.push(item);
            boxes.push(corners);
        } else {
            others.push(other);
        }
    };
    for root in &geometry.roots {
        match root {
            Root::Plain(leaves) => {
                for leaf in leaves.clone() {
                    sort(Item::Plain(leaf), of_leaf(geometry, leaf), Root::Plain(leaf..leaf + 1));
                }
            }
            Root::Placed(leaves) => {
                for leaf in leaves.clone() {
                    sort(Item::Placed(leaf), of_leaf(geometry, leaf), Root::Placed(leaf..leaf + 1));
                }
            }
            Root::Mesh(leaf) => sort(Item::Mesh(*leaf), of_leaf(geometry, *leaf), Root::Mesh(*leaf)),
            Root::Solid(solid) => {
                let corners = of_solid(geometry, geometry.solid_at(*solid));
                sort(Item::Solid(*solid), corners, Root::Solid(*solid));
            }
        }
    }
    let boxes_of_solids: Vec<_> = geometry.solids.iter().map(|solid| Boxes::new(geometry, solid)).collect();
    for (solid, boxes) in geometry.solids.iter_mut().zip(boxes_of_solids) {
        solid.boxes = boxes;
    }
    if items.len() < WORTHWHILE && geometry.solids.iter().all(|solid| solid.boxes.is_none()) {
        return;
    }
    if let Some((tree, order, center)) = tree_of(&boxes) {
        let items = order.iter().map(|&number| items[number as usize]).collect();
        geometry.roots = others;
        geometry.tree = Some(Accelerated { tree, items, center });
    }
}

/// A tree over boxes, their numbers in its order, and the origin of its coordinates; nothing where they are too great or
/// too small.
fn tree_of(boxes: &[Corners]) -> Option<(Tree, Vec<u32>, DVec3)> {
    let whole = boxes.iter().copied().reduce(union)?;
    let center = (whole[0] + whole[1]) * 0.5;
    let reach = (whole[1] - whole[0]).max_element();
    if !(SMALLEST..FARTHEST).contains(&reach) {
        return None;
    }
    let boxes: Vec<Bounds> = boxes
        .iter()
        .map(|[min, max]| Bounds::outward((*min - center).to_array(), (*max - center).to_array()))
        .collect();
    let (tree, order) = Tree::of_boxes(&boxes);
    Some((tree, order, center))
}

fn is_bounded(corners: &Corners) -> bool {
    corners.iter().all(|corner| corner.abs().cmplt(DVec3::splat(FARTHEST)).all())
}

/// The leaves of a solid, by where they are.
pub(super) struct Boxes {
    tree: Tree,
    /// What the units of the tree's leaves are.
    leaves: Box<[u32]>,
    /// Leaves without bounds.
    others: Box<[u32]>,
    center: DVec3,
}

impl Boxes {
    /// Nothing where trying all leaves is as quick.
    fn new(geometry: &Geometry, solid: &Solid) -> Option<Self> {
        let (mut leaves, mut boxes, mut others) = (Vec::new(), Vec::new(), Vec::new());
        for leaf in 0..solid.leaves.len() as u32 {
            let corners = of_leaf(geometry, solid.first + leaf);
            if is_bounded(&corners) {
                leaves.push(leaf);
                boxes.push(corners);
            } else {
                others.push(leaf);
            }
        }
        if leaves.len() < WORTHWHILE_IN_SOLIDS {
            return None;
        }
        let (tree, order, center) = tree_of(&boxes)?;
        let leaves = order.iter().map(|&number| leaves[number as usize]).collect();
        Some(Self { tree, leaves, others: others.into(), center })
    }

    /// Puts the leaves that a ray may meet between its start and `far` into `walk.met`.
    #[inline(always)]
    pub(super) fn meet<S: Simd>(&self, simd: S, ray: &Ray, far: f64, walk: &mut Walk) {
        let Walk { met, stack, .. } = walk;
        met.clear();
        met.extend_from_slice(&self.others);
        let from = ray.origin - self.center;
        let [origin, direction] = [from, ray.direction].map(|v| v.to_array().map(|x| x as f32));
        let far = (far * (1.0 + f64::from(f32::EPSILON))) as f32;
        let mut ray = hray_bvh::Ray::new(simd, origin, direction, 0.0, far, self.tree.reach());
        // No box can be tested against such a ray.
        if !(from.abs().max_element() < FARTHEST && ray.far >= 0.0) {
            met.extend_from_slice(&self.leaves);
            return;
        }
        self.tree.closest(simd, &mut ray, stack, &mut Meet { leaves: &self.leaves, met });
    }
}

/// Notes all leaves that are come to.
struct Meet<'a> {
    leaves: &'a [u32],
    met: &'a mut Vec<u32>,
}

impl Leaves for Meet<'_> {
    #[inline(always)]
    fn prefetch(&self, _unit: usize) {}

    #[inline(always)]
    fn closest<S: Simd>(&mut self, _simd: S, _ray: &mut hray_bvh::Ray, units: Range<usize>) {
        self.met.extend_from_slice(&self.leaves[units]);
    }

    #[inline(always)]
    fn any<S: Simd>(&mut self, _simd: S, _ray: &hray_bvh::Ray, _units: Range<usize>) -> bool {
        false
    }
}

/// The box around a leaf in the world; all of space where it has none.
fn of_leaf(geometry: &Geometry, leaf: u32) -> Corners {
    let corners = corners(geometry, leaf as usize);
    // An infinite box that was turned has corners that are no numbers, and what is joined with those would forget them.
    if corners.iter().all(|corner| corner.is_finite()) { corners } else { EVERYWHERE }
}

fn corners(geometry: &Geometry, leaf: usize) -> Corners {
    let placement = geometry.placement(leaf);
    match geometry.shape(leaf) {
        Prepared::Sphere { center, squared_radius, .. } => {
            of_sphere(placement, *center, squared_radius.sqrt())
        }
        Prepared::ExactSphere { center, radius } => of_sphere(placement, *center, radius.abs()),
        Prepared::Cuboid { min, max, .. } => placement.map_or([*min, *max], |to| to.box_to_world(*min, *max)),
        Prepared::Plane { .. } | Prepared::ExactPlane { .. } => EVERYWHERE,
        Prepared::Round { shape, .. } => {
            let [min, max] = shape.corners();
            placement.map_or([min, max], |to| to.box_to_world(min, max))
        }
        Prepared::Mesh(mesh) => match (mesh.bounds(), placement) {
            (Some([min, max]), Some(placement)) => placement.box_to_world(min, max),
            (Some(corners), None) => corners,
            (None, _) => [DVec3::ZERO; 2],
        },
    }
}

fn of_sphere(placement: Option<&Placement>, center: DVec3, radius: f64) -> Corners {
    match placement {
        None => [center - radius, center + radius],
        Some(placement) => placement.box_to_world(center - radius, center + radius),
    }
}

fn union(a: Corners, b: Corners) -> Corners {
    [a[0].min(b[0]), a[1].max(b[1])]
}

/// The box around a solid. Where operands do not meet it is a point of one of them.
fn of_solid(geometry: &Geometry, solid: &Solid) -> Corners {
    let mut leaves = 0;
    let mut corners: Vec<Corners> = Vec::with_capacity(solid.nodes.len());
    for node in &solid.nodes {
        let this = match node.made {
            None => {
                leaves += 1;
                of_leaf(geometry, solid.first + leaves - 1)
            }
            Some((operation, [a, b])) => {
                let (a, b) = (corners[a as usize], corners[b as usize]);
                match operation {
                    CsgOperation::Union => union(a, b),
                    CsgOperation::Difference => a,
                    CsgOperation::Intersection => {
                        let min = a[0].max(b[0]);
                        [min, a[1].min(b[1]).max(min)]
                    }
                }
            }
        };
        corners.push(this);
    }
    corners.last().copied().unwrap_or(EVERYWHERE)
}

impl Accelerated {
    /// The rays as the tree takes them; nothing where it cannot take one.
    #[inline(always)]
    fn narrowed<S: Simd>(&self, simd: S, rays: &Rays<S>, far: Lanes<S>) -> Option<Packet> {
        let from = rays.origin.sub(Vec3::splat(simd, self.center));
        let origin = [narrow::<S>(from.x), narrow::<S>(from.y), narrow::<S>(from.z)];
        let direction = rays.direction;
        let direction = [narrow::<S>(direction.x), narrow::<S>(direction.y), narrow::<S>(direction.z)];
        let packet = Packet::new(simd, &origin, &direction, &up_to(simd, far), self.tree.reach());
        let inside = from.x.abs().max(from.y.abs()).max(from.z.abs()).simd_lt(FARTHEST).all_true();
        (inside && packet.is_sane(Lanes::<S>::LEN)).then_some(packet)
    }

    /// Looks for nearer hits than there are.
    #[inline(always)]
    pub(super) fn nearest<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        rays: &Rays<S>,
        nothing: f64,
        walk: &mut Walk,
        nearest: &mut Nearest<S>,
    ) {
        let mut stack = std::mem::take(&mut walk.packets);
        let narrowed = self.narrowed(simd, rays, nearest.distance);
        let mut leaves = Search { items: &self.items, geometry, rays, nothing, walk, nearest: *nearest };
        match narrowed {
            Some(mut narrowed) => {
                let all = (1 << Lanes::<S>::LEN) - 1;
                self.tree.closest_packet(simd, &mut narrowed, all, &mut stack, &mut leaves);
            }
            None => leaves.test(simd, 0..self.items.len()),
        }
        *nearest = leaves.nearest;
        walk.packets = stack;
    }

    /// Which rays of `lanes` meet something that is not farther than `distance`; others may be among them.
    #[inline(always)]
    pub(super) fn shadowed<S: Simd>(
        &self,
        simd: S,
        geometry: &Geometry,
        rays: &Rays<S>,
        distance: Lanes<S>,
        lanes: u32,
        walk: &mut Walk,
    ) -> Mask<S> {
        let mut stack = std::mem::take(&mut walk.packets);
        let narrowed = self.narrowed(simd, rays, distance);
        let dark = Mask::<S>::splat(simd, false);
        let mut leaves = Shadows { items: &self.items, geometry, rays, distance, walk, dark };
        match narrowed {
            Some(mut narrowed) => {
                let _ = self.tree.any_packet(simd, &mut narrowed, lanes, &mut stack, &mut leaves);
            }
            None => {
                let _ = leaves.any(simd, lanes, 0..self.items.len());
            }
        }
        let dark = leaves.dark;
        walk.packets = stack;
        dark
    }
}

/// As singles; what is missing of a full packet is 0.
#[inline(always)]
fn narrow<S: Simd>(column: Lanes<S>) -> [f32; MOST_RAYS] {
    let mut narrow = [0.0; MOST_RAYS];
    for lane in 0..Lanes::<S>::LEN {
        narrow[lane] = column[lane] as f32;
    }
    narrow
}

/// Singles that are not less than distances; for what is no number, before the first hit, no limit.
#[inline(always)]
fn up_to<S: Simd>(simd: S, distances: Lanes<S>) -> [f32; MOST_RAYS] {
    let known = distances.simd_eq(distances);
    // Twice what rounding to the nearest can take away.
    let widened = distances * (1.0 + f64::from(f32::EPSILON));
    narrow::<S>(known.select(widened, Lanes::<S>::splat(simd, f64::INFINITY)))
}

struct Search<'a, S: Simd> {
    items: &'a [Item],
    geometry: &'a Geometry,
    rays: &'a Rays<S>,
    nothing: f64,
    walk: &'a mut Walk,
    nearest: Nearest<S>,
}

impl<S: Simd> ClosestLeaves<S> for Search<'_, S> {
    #[inline(always)]
    fn closest(&mut self, simd: S, rays: &mut Packet, _lanes: u32, units: Range<usize>) {
        self.test(simd, units);
        let far: f32x8<S> = up_to(simd, self.nearest.distance).simd_into(simd);
        rays.far = far.simd_lt(f32::MAX).select(far, f32x8::splat(simd, f32::MAX)).into();
    }
}

impl<S: Simd> Search<'_, S> {
    #[inline(always)]
    fn test(&mut self, simd: S, units: Range<usize>) {
        for &item in &self.items[units] {
            let first = self.nothing + 1.0;
            match item {
                Item::Plain(leaf) => {
                    if let Some((distance, hit)) = self.geometry.shape(leaf as usize).hit(simd, self.rays) {
                        self.nearest.take_any(
                            distance,
                            hit,
                            Lanes::<S>::splat(simd, first + f64::from(leaf)),
                        );
                    }
                }
                Item::Placed(leaf) => {
                    if let Some((distance, hit)) = placed_hit(simd, self.geometry, leaf as usize, self.rays) {
                        self.nearest.take_any(
                            distance,
                            hit,
                            Lanes::<S>::splat(simd, first + f64::from(leaf)),
                        );
                    }
                }
                Item::Mesh(leaf) => {
                    let far = self.nearest.distance;
                    let (distance, triangle) =
                        mesh_hit(simd, self.geometry, leaf as usize, self.rays, far, self.walk);
                    let met = distance.simd_eq(distance);
                    let leaf = Lanes::<S>::splat(simd, first + f64::from(leaf));
                    let taken = self.nearest.take_any(distance, met, leaf);
                    self.nearest.triangle = taken.select(triangle, self.nearest.triangle);
                }
                Item::Solid(solid) => {
                    let (solid, far) = (self.geometry.solid_at(solid), self.nearest.distance);
                    let [distance, leaf, triangle] =
                        solid_hit(simd, self.geometry, solid, self.rays, far, first, self.walk);
                    let taken = self.nearest.take_any(distance, distance.simd_eq(distance), leaf);
                    self.nearest.triangle = taken.select(triangle, self.nearest.triangle);
                }
            }
        }
    }
}

struct Shadows<'a, S: Simd> {
    items: &'a [Item],
    geometry: &'a Geometry,
    rays: &'a Rays<S>,
    distance: Lanes<S>,
    walk: &'a mut Walk,
    dark: Mask<S>,
}

impl<S: Simd> AnyLeaves<S> for Shadows<'_, S> {
    #[inline(always)]
    fn any(&mut self, simd: S, _lanes: u32, units: Range<usize>) -> u32 {
        for &item in &self.items[units] {
            let met = match item {
                Item::Plain(leaf) => self.geometry.shape(leaf as usize).hit(simd, self.rays),
                Item::Placed(leaf) => placed_hit(simd, self.geometry, leaf as usize, self.rays),
                Item::Mesh(leaf) => {
                    self.dark |=
                        mesh_shadow(simd, self.geometry, leaf as usize, self.rays, self.distance, self.walk);
                    None
                }
                Item::Solid(solid) => {
                    let solid = self.geometry.solid_at(solid);
                    let [at, ..] =
                        solid_hit(simd, self.geometry, solid, self.rays, self.distance, 0.0, self.walk);
                    Some((at, at.simd_eq(at)))
                }
            };
            if let Some((at, hit)) = met {
                self.dark |= hit & at.simd_le(self.distance);
            }
        }
        self.dark.to_bitmask() as u32
    }
}
