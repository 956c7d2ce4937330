//! A tree over what is bounded, for scenes with many objects.

use super::bounds::{Corners, FARTHEST, is_bounded, of_leaf, of_solid, tree_of};
use super::geometry::{Geometry, Root};
use super::shapes::Rays;
use super::solid::Walk;
use super::solid_boxes::Boxes;
use super::trace::{Nearest, only, placed_hit, single_hit, single_shadow, solid_hit};
use fearless_simd::f32x8;
use fearless_simd::prelude::*;
use hray_bvh::{AnyLeaves, ClosestLeaves, MOST_RAYS, Packet, Tree};
use hray_core::DVec3;
use hray_expr::kernels::lanes::{Lanes, Mask, Vec3};
use std::ops::Range;

/// With fewer bounded objects trying all of them is quicker.
const WORTHWHILE: usize = 12;
/// More cannot be numbered.
const MOST: usize = 1 << 27;
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
    Single(u32),
    Solid(u32),
}

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
            Root::Single(leaf) => sort(Item::Single(*leaf), of_leaf(geometry, *leaf), Root::Single(*leaf)),
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
            None => leaves.test(simd, u32::MAX, 0..self.items.len()),
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
    fn closest(&mut self, simd: S, rays: &mut Packet, lanes: u32, units: Range<usize>) {
        self.test(simd, lanes, units);
        let far: f32x8<S> = up_to(simd, self.nearest.distance).simd_into(simd);
        rays.far = far.simd_lt(f32::MAX).select(far, f32x8::splat(simd, f32::MAX)).into();
    }
}

impl<S: Simd> Search<'_, S> {
    #[inline(always)]
    fn test(&mut self, simd: S, lanes: u32, units: Range<usize>) {
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
                Item::Single(leaf) => {
                    let far = only(simd, self.nearest.distance, lanes);
                    let (distance, triangle) =
                        single_hit(simd, self.geometry, leaf as usize, self.rays, far, self.walk);
                    let met = distance.simd_eq(distance);
                    let leaf = Lanes::<S>::splat(simd, first + f64::from(leaf));
                    let taken = self.nearest.take_any(distance, met, leaf);
                    self.nearest.triangle = taken.select(triangle, self.nearest.triangle);
                }
                Item::Solid(solid) => {
                    let solid = self.geometry.solid_at(solid);
                    let far = only(simd, self.nearest.distance, lanes);
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
    fn any(&mut self, simd: S, lanes: u32, units: Range<usize>) -> u32 {
        for &item in &self.items[units] {
            let left = lanes & !(self.dark.to_bitmask() as u32);
            let met = match item {
                Item::Plain(leaf) => self.geometry.shape(leaf as usize).hit(simd, self.rays),
                Item::Placed(leaf) => placed_hit(simd, self.geometry, leaf as usize, self.rays),
                Item::Single(leaf) => {
                    let far = only(simd, self.distance, left);
                    self.dark |= single_shadow(simd, self.geometry, leaf as usize, self.rays, far, self.walk);
                    None
                }
                Item::Solid(solid) => {
                    let solid = self.geometry.solid_at(solid);
                    let [at, ..] = solid_hit(
                        simd,
                        self.geometry,
                        solid,
                        self.rays,
                        only(simd, self.distance, left),
                        0.0,
                        self.walk,
                    );
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
