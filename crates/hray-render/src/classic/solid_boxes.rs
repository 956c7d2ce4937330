//! Which leaves of a solid a ray may meet.

use super::bounds::{FARTHEST, is_bounded, of_leaf, tree_of};
use super::geometry::Geometry;
use super::solid::{Ray, Solid, Walk};
use fearless_simd::Simd;
use hray_bvh::Tree;
use hray_core::DVec3;

/// With fewer bounded leaves trying all of them is as quick.
const WORTHWHILE: usize = 4;

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
    pub(super) fn new(geometry: &Geometry, solid: &Solid) -> Option<Self> {
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
        if leaves.len() < WORTHWHILE {
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
        let ray = hray_bvh::Ray::new(simd, origin, direction, 0.0, far, self.tree.reach());
        // No box can be tested against such a ray.
        if !(from.abs().max_element() < FARTHEST && ray.far >= 0.0) {
            met.extend_from_slice(&self.leaves);
            return;
        }
        self.tree.visit(simd, &ray, stack, |units| met.extend_from_slice(&self.leaves[units]));
    }
}
