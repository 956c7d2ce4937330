//! Boxes around what can be hit, and trees over them.

use super::geometry::Geometry;
use super::placement::Placement;
use super::shapes::Prepared;
use super::solid::{Made, Solid};
use hray_bvh::{Bounds, Tree};
use hray_core::{CsgOperation, DVec3};

/// Coordinates of greater magnitude, from the middle of everything, are left out of the tree: their squares, and products with
/// reciprocals of directions, could leave the range of single precision.
pub(super) const FARTHEST: f64 = 1e15;
/// Trees of smaller things could as well.
const SMALLEST: f64 = 1e-15;

/// Two corners; infinite ones, and ones that are no numbers, for what has no bounds.
pub(super) type Corners = [DVec3; 2];

const EVERYWHERE: Corners = [DVec3::NEG_INFINITY, DVec3::INFINITY];

/// The box around a leaf in the world; all of space where it has none.
pub(super) fn of_leaf(geometry: &Geometry, leaf: u32) -> Corners {
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
        Prepared::Implicit(surface) => {
            let [min, max] = surface.corners();
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

fn common(a: Corners, b: Corners) -> Corners {
    let min = a[0].max(b[0]);
    [min, a[1].min(b[1]).max(min)]
}

/// The box around the surface of a solid. Where operands do not meet it is a point of one of them.
pub(super) fn of_solid(geometry: &Geometry, solid: &Solid) -> Corners {
    let mut leaves = 0;
    // Of each node, what is around its inside and what is around its outside. Its surface is in both.
    let mut sides: Vec<[Corners; 2]> = Vec::with_capacity(solid.nodes.len());
    for node in &solid.nodes {
        let this = match node.made {
            Made::Leaf => {
                leaves += 1;
                [of_leaf(geometry, solid.first + leaves - 1), EVERYWHERE]
            }
            Made::Inverse(solid) => {
                let [inside, outside] = sides[solid as usize];
                [outside, inside]
            }
            Made::Clip([shape, within]) => {
                [common(sides[shape as usize][0], sides[within as usize][0]), EVERYWHERE]
            }
            Made::Csg(operation, [a, b]) => {
                let ([a, not_a], [b, not_b]) = (sides[a as usize], sides[b as usize]);
                match operation {
                    CsgOperation::Union => [union(a, b), common(not_a, not_b)],
                    CsgOperation::Intersection => [common(a, b), union(not_a, not_b)],
                    CsgOperation::Difference => [common(a, not_b), union(not_a, b)],
                }
            }
        };
        sides.push(this);
    }
    let Some([inside, outside]) = sides.get(solid.surface as usize) else { return EVERYWHERE };
    let surface = common(*inside, *outside);
    solid.within.iter().fold(surface, |surface, &solid| common(surface, sides[solid as usize][0]))
}

/// A tree over boxes, their numbers in its order, and the origin of its coordinates; nothing where they are too great or
/// too small.
pub(super) fn tree_of(boxes: &[Corners]) -> Option<(Tree, Vec<u32>, DVec3)> {
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

pub(super) fn is_bounded(corners: &Corners) -> bool {
    corners.iter().all(|corner| corner.abs().cmplt(DVec3::splat(FARTHEST)).all())
}
