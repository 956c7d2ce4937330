//! The cells of an implicit surface's box in which the surface may be, and which of them a ray goes through.

use super::solid::Ray;
use fearless_simd::{Level, Simd};
use hray_bvh::{Bounds, Stack, Tree};
use hray_core::DVec3;
use hray_expr::{LANES, Range, RangePlan, RangeScratch};

/// Cells are cut into eight as long as so many can be expected at most.
const MOST_CELLS: usize = 1 << 15;
/// How often, at most.
const MOST_CUTS: u32 = 10;
/// Cells are looked at together with so much around them, as a share of the box: rounding does not take a point of a ray farther
/// out of its cell, unless the box is smaller than the rounding of its coordinates.
const AROUND: f64 = 1.0 / (1u64 << 40) as f64;

/// The cells in which the surface may be, in a tree.
pub(super) struct Cells {
    /// Nothing where there are none.
    tree: Option<Tree>,
    /// By the numbers of their places along the axes, in the order of the tree.
    cells: Vec<[u16; 3]>,
    /// The box, and how many cells it has along each axis.
    min: DVec3,
    max: DVec3,
    count: u16,
    center: DVec3,
    /// Half of its longest side.
    reach: f64,
    /// Whether the inside may come up to the box.
    pub(super) is_cut: bool,
}

impl Cells {
    /// Cuts a box up. With a share of less than 1 fewer cells are made.
    pub(super) fn new(
        level: Level,
        plan: &RangePlan,
        [min, max]: [DVec3; 2],
        share: f64,
        scratch: &mut RangeScratch,
    ) -> Self {
        let size = max - min;
        let around = size * AROUND + (min.abs().max(max.abs())) * (4.0 * f64::EPSILON);
        let most = (MOST_CELLS as f64 * share) as usize;
        let (mut cells, mut count, mut is_cut) = (vec![[0u16; 3]], 1u16, false);
        for _ in 0..MOST_CUTS {
            // A surface is in four parts of eight.
            if cells.is_empty() || 4 * cells.len() > most {
                break;
            }
            let mut finer = Vec::with_capacity(4 * cells.len());
            count *= 2;
            for cell in &cells {
                let parts: [[u16; 3]; LANES] = std::array::from_fn(|part| {
                    [0, 1, 2].map(|axis| 2 * cell[axis] + (part >> axis & 1) as u16)
                });
                let mut p = [Range::ZERO; 3];
                for (lane, part) in parts.iter().enumerate() {
                    for axis in 0..3 {
                        let face = |number| face(min[axis], max[axis], count, number);
                        p[axis].low[lane] = face(part[axis]) - around[axis];
                        p[axis].high[lane] = face(part[axis] + 1) + around[axis];
                    }
                }
                let range = plan.values(level, &p, scratch);
                for (lane, part) in parts.into_iter().enumerate() {
                    let [low, high] = range.lane(lane);
                    let is_at_the_end = part.iter().any(|&number| number == 0 || number == count - 1);
                    if low <= 0.0 && high >= 0.0 {
                        finer.push(part);
                    } else {
                        // Where there is no value it is outside.
                        is_cut |= high < 0.0 && is_at_the_end;
                    }
                }
            }
            cells = finer;
        }
        is_cut |= cells.iter().flatten().any(|&number| number == 0 || number == count - 1);
        let (center, reach) = ((min + max) * 0.5, size.max_element() * 0.5);
        let boxes: Vec<Bounds> = cells
            .iter()
            .map(|cell| {
                let corner = |side: u16| {
                    let at = [0, 1, 2].map(|axis| face(min[axis], max[axis], count, cell[axis] + side));
                    ((DVec3::from(at) - center) / reach).to_array()
                };
                Bounds::outward(corner(0), corner(1))
            })
            .collect();
        let tree = (!boxes.is_empty()).then(|| Tree::of_boxes(&boxes));
        let order = tree.as_ref().map_or(&[][..], |(_, order)| order);
        let cells = order.iter().map(|&number| cells[number as usize]).collect();
        Self { tree: tree.map(|(tree, _)| tree), cells, min, max, count, center, reach, is_cut }
    }

    /// The stretches of a ray that lie in cells, between two distances of which the first is in the box or on it; in
    /// ascending order, and none of them overlap.
    #[inline(always)]
    pub(super) fn stretches<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        [near, far]: [f64; 2],
        stack: &mut Stack,
        stretches: &mut Vec<[f64; 2]>,
    ) {
        stretches.clear();
        let Some(tree) = &self.tree else { return };
        let start = (ray.origin + ray.direction * near - self.center) / self.reach;
        // As a unit along its longest axis; nothing has to be left out by distance.
        let direction = ray.direction / ray.direction.abs().max_element();
        let [o, d] = [start, direction].map(|v| v.to_array().map(|x| x as f32));
        let narrowed = hray_bvh::Ray::new(simd, o, d, 0.0, f32::MAX, tree.reach());
        tree.visit(simd, &narrowed, stack, |units| {
            for &cell in &self.cells[units] {
                let [enter, exit] = self.through(ray, cell);
                let (from, to) = (enter.max(near), exit.min(far));
                if from < to {
                    stretches.push([from, to]);
                }
            }
        });
        stretches.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let mut end = near;
        stretches.retain_mut(|stretch| {
            stretch[0] = stretch[0].max(end);
            end = end.max(stretch[1]);
            stretch[0] < stretch[1]
        });
    }

    #[inline(always)]
    fn corner(&self, x: u16, y: u16, z: u16) -> DVec3 {
        DVec3::new(
            face(self.min.x, self.max.x, self.count, x),
            face(self.min.y, self.max.y, self.count, y),
            face(self.min.z, self.max.z, self.count, z),
        )
    }

    /// The distances at which a ray enters a cell and leaves it. Cells that share a face have the same distance there.
    #[inline(always)]
    fn through(&self, ray: &Ray, [x, y, z]: [u16; 3]) -> [f64; 2] {
        between(ray, [self.corner(x, y, z), self.corner(x + 1, y + 1, z + 1)])
    }
}

/// The distances at which a ray enters a box and leaves it; the first is not less than the second where it misses. A ray in the
/// plane of a face counts as inside.
#[inline(always)]
pub(super) fn between(ray: &Ray, [min, max]: [DVec3; 2]) -> [f64; 2] {
    let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (low, high) = (
            (min[axis] - ray.origin[axis]) / ray.direction[axis],
            (max[axis] - ray.origin[axis]) / ray.direction[axis],
        );
        if !low.is_nan() && !high.is_nan() {
            enter = enter.max(low.min(high));
            exit = exit.min(low.max(high));
        }
    }
    [enter, exit]
}

/// The coordinate of a face between cells.
#[inline(always)]
fn face(min: f64, max: f64, count: u16, number: u16) -> f64 {
    // The number of cells is a power of 2, so the reciprocal is exact, and loops take it out.
    if number == count { max } else { min + (max - min) * (f64::from(number) * (1.0 / f64::from(count))) }
}
