//! Implicit surfaces: rays look for where a function is 0, in the cells of a box where it can be.

use super::crossings::Crossing;
use super::implicit_cells::{Cells, between};
use super::implicit_roots::{Field, Line, Root};
use super::round::Spot;
use super::shapes::BOUND;
use super::solid::Ray;
use super::uv::direction_uv;
use fearless_simd::{Level, Simd};
use hray_bvh::Stack;
use hray_core::{DVec3, Implicit, NoiseTables};
use hray_expr::{LANES, Plan, Range, RangePlan, RangeScratch};
use std::sync::Arc;

/// Stretches of a ray are not cut to less than this share of the box's longest side: where nothing can be said about a shorter
/// one, the surface counts as hit.
const NARROW: f64 = 1.0 / (1u64 << 30) as f64;
/// The same as a share of the greatest coordinate, where that is much greater: there rounding blurs the function.
const NARROW_FAR: f64 = 1.0 / (1u64 << 42) as f64;
/// How far rays start from the surface, in narrowest stretches, and how much farther where that is not enough.
const CLEAR: [f64; 4] = [4.0, 32.0, 512.0, 16384.0];

/// An implicit surface with what can be computed once.
pub(super) struct PreparedImplicit {
    implicit: Arc<Implicit>,
    share: u32,
    field: Field,
    cells: Cells,
    middle: DVec3,
    /// The greatest coordinate of the box.
    reach: f64,
    /// In object-space units.
    narrow: f64,
}

/// What one thread needs.
#[derive(Default)]
pub(super) struct Scratch {
    roots: super::implicit_roots::Scratch,
    stretches: Vec<[f64; 2]>,
}

/// A ray in the box: seen from its point nearest to the middle, so that its distance from there does not blur anything.
struct Walk {
    line: Line,
    /// Which distance of the ray that point has.
    offset: f64,
    /// Where it enters the box and where it leaves it, counted from that point.
    enter: f64,
    exit: f64,
}

impl PreparedImplicit {
    /// Makes a surface ready, as one of 2 to the power of `share` of them.
    pub(super) fn new(implicit: Arc<Implicit>, share: u32, tables: &NoiseTables) -> Self {
        Self::with_level(Level::new(), implicit, share, tables)
    }

    /// The same for some of the machine's vectors.
    pub(super) fn with_level(
        level: Level,
        implicit: Arc<Implicit>,
        share: u32,
        tables: &NoiseTables,
    ) -> Self {
        let Implicit { function, min, max } = &*implicit;
        let ranges = RangePlan::new(function, tables);
        let cells = Cells::new(
            level,
            &ranges,
            [*min, *max],
            libm::exp2(-f64::from(share)),
            &mut RangeScratch::default(),
        );
        let (side, reach) = ((*max - *min).max_element(), min.abs().max(max.abs()).max_element());
        let narrow = (NARROW * side).max(NARROW_FAR * reach);
        let (middle, values) = ((*min + *max) * 0.5, Plan::new(function, tables));
        Self { field: Field { level, values, ranges }, implicit, share, cells, middle, reach, narrow }
    }

    /// What it was made of.
    pub(super) const fn implicit(&self) -> &Arc<Implicit> {
        &self.implicit
    }

    /// As one of how many it was made ready: a power of 2.
    pub(super) const fn share(&self) -> u32 {
        self.share
    }

    /// The box.
    pub(super) fn corners(&self) -> [DVec3; 2] {
        [self.implicit.min, self.implicit.max]
    }

    /// Nothing where the ray misses the box.
    fn walk(&self, ray: &Ray) -> Option<Walk> {
        let Ray { origin, direction } = *ray;
        let offset = (self.middle - origin).dot(direction) / direction.dot(direction);
        let base = origin + direction * offset;
        let [enter, exit] = between(&Ray { origin: base, direction }, self.corners());
        let is_met = enter < exit && offset.is_finite();
        is_met.then_some(Walk { line: Line { base, direction }, offset, enter, exit })
    }

    /// Visits where a ray goes in and out, or touches the surface, beyond `near` and up to `far`, in ascending order, until
    /// `visit` has enough. Returns whether it starts inside.
    #[inline(always)]
    fn events<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        [near, far]: [f64; 2],
        stack: &mut Stack,
        scratch: &mut Scratch,
        mut visit: impl FnMut(Root) -> bool,
    ) -> bool {
        let Some(Walk { line, offset, enter, exit }) = self.walk(ray) else { return false };
        let from = enter.max(near - offset);
        let to = exit.min(far - offset);
        let is_met = from < to;
        if !is_met {
            return false;
        }
        let is_in_box = enter + offset <= near;
        let mut is_inside = false;
        if self.cells.is_cut || is_in_box {
            [is_inside] = self.field.inside(&line, &[from], &mut scratch.roots);
        }
        let mut starts_inside = is_in_box && is_inside;
        if is_inside && !is_in_box {
            let root = Root { at: enter + offset, enters: true, touches: false };
            if visit(root) {
                return false;
            }
        }
        let Scratch { roots, stretches } = scratch;
        let inner = Ray { origin: line.base, direction: line.direction };
        self.cells.stretches(simd, &inner, [from, to], stack, stretches);
        let length = line.direction.length();
        let narrow = self.narrow / length;
        // No more exactly than points are.
        let exact = 2.0 * f64::EPSILON * self.reach / length;
        let mut is_enough = false;
        self.field.roots(&line, stretches, [narrow, exact], roots, |root| {
            let root = Root { at: root.at + offset, ..root };
            is_inside = root.enters;
            if root.at <= near {
                starts_inside = is_in_box && is_inside;
            } else if root.at <= far {
                is_enough = visit(root);
            }
            is_enough
        });
        if is_inside && !is_enough && self.cells.is_cut && exit + offset <= far {
            visit(Root { at: exit + offset, enters: false, touches: false });
        }
        starts_inside
    }

    /// The nearest hit between two distances.
    #[inline(always)]
    pub(super) fn hit<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        ends: [f64; 2],
        stack: &mut Stack,
        scratch: &mut Scratch,
    ) -> Option<f64> {
        let mut hit = None;
        self.events(simd, ray, ends, stack, scratch, |root| {
            hit = Some(root.at);
            true
        });
        hit
    }

    /// Where a ray goes in and out beyond a distance, and whether it is inside there.
    #[inline(always)]
    pub(super) fn crossings<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        near: f64,
        stack: &mut Stack,
        scratch: &mut Scratch,
        crossings: &mut Vec<Crossing>,
    ) -> bool {
        crossings.clear();
        self.events(simd, ray, [near, f64::INFINITY], stack, scratch, |root| {
            if !root.touches {
                crossings.push(Crossing { at: root.at, turns: i32::from(root.enters), triangle: 0 });
            }
            false
        })
    }

    /// Wherever a ray meets the surface beyond a distance.
    #[inline(always)]
    pub(super) fn meet<S: Simd>(
        &self,
        simd: S,
        ray: &Ray,
        near: f64,
        stack: &mut Stack,
        scratch: &mut Scratch,
        crossings: &mut Vec<Crossing>,
    ) {
        crossings.clear();
        self.events(simd, ray, [near, f64::INFINITY], stack, scratch, |root| {
            crossings.push(Crossing { at: root.at, turns: 0, triangle: 0 });
            false
        });
    }

    /// Where exactly a ray meets the surface.
    pub(super) fn spot(&self, ray: &Ray, distance: f64, scratch: &mut Scratch) -> Spot {
        if let Some(spot) = self.spot_on_box(ray, distance) {
            return spot;
        }
        let mut point = ray.origin + ray.direction * distance;
        let mut gradient = self.gradient(point, ray, scratch);
        // A step of Newton's takes back what rounding did to a ray from far away.
        let [before] = self.at(&[point], scratch);
        let step = gradient * (before / gradient.dot(gradient));
        if step.length() < 1e-3 * (self.implicit.max - self.implicit.min).max_element() {
            let moved = point - step;
            let [after] = self.at(&[moved], scratch);
            if after.abs() < before.abs() {
                point = moved;
                gradient = self.gradient(point, ray, scratch);
            }
        }
        let normal = gradient.normalize_or(-ray.direction.normalize_or(DVec3::Y));
        Spot { point, normal, bound: self.clear(point, normal, scratch) + BOUND * self.reach }
    }

    /// Where it is on a face of the box, which closes what is inside.
    fn spot_on_box(&self, ray: &Ray, distance: f64) -> Option<Spot> {
        let Walk { line, offset, enter, exit } = self.walk(ray).filter(|_| self.cells.is_cut)?;
        let at = if distance == enter + offset {
            enter
        } else if distance == exit + offset {
            exit
        } else {
            return None;
        };
        let [min, max] = self.corners();
        let mut point = line.base + line.direction * at;
        for axis in 0..3 {
            for (face, sign) in [(min[axis], -1.0), (max[axis], 1.0)] {
                if (face - line.base[axis]) / line.direction[axis] == at {
                    point[axis] = face;
                    let normal = DVec3::AXES[axis] * sign;
                    return Some(Spot { point, normal, bound: BOUND * self.reach });
                }
            }
        }
        None
    }

    /// The function at points.
    fn at<const N: usize>(&self, points: &[DVec3; N], scratch: &mut Scratch) -> [f64; N] {
        let columns = [0, 1, 2].map(|axis| points.map(|p| p[axis]));
        self.field.at(&columns, &mut scratch.roots.values)
    }

    /// How the function grows, by derivatives; where it has none, by differences. Of both sides of a crease, the middle.
    fn gradient(&self, p: DVec3, ray: &Ray, scratch: &mut Scratch) -> DVec3 {
        let at = p.to_array().map(|v| Range::from_ends(v, v));
        let mut along = [Range::ZERO; 3];
        for (axis, range) in along.iter_mut().enumerate() {
            (range.low[axis], range.high[axis]) = (1.0, 1.0);
        }
        let [_, slope] = self.field.ranges.slopes(self.field.level, &at, &along, &mut scratch.roots.ranges);
        let gradient = DVec3::from([0, 1, 2].map(|axis| {
            let [low, high] = slope.lane(axis);
            0.5 * low + 0.5 * high
        }));
        if gradient.is_finite() && gradient != DVec3::ZERO {
            return gradient;
        }
        // Far enough apart for rounding not to count.
        let step = 256.0 * self.narrow;
        let points: [DVec3; LANES] = std::array::from_fn(|i| {
            let sign = if i & 1 == 0 { step } else { -step };
            DVec3::AXES.get(i / 2).map_or(p, |axis| p + *axis * sign)
        });
        let values = self.at(&points, scratch);
        let gradient = DVec3::from([0, 1, 2].map(|axis| values[2 * axis] - values[2 * axis + 1]));
        if gradient.is_finite() && gradient != DVec3::ZERO { gradient } else { -ray.direction }
    }

    /// How far from a point along the normal, to either side, one has to be so that the function is not 0 there; the least
    /// that is tried, where ranges do not tell.
    fn clear(&self, point: DVec3, normal: DVec3, scratch: &mut Scratch) -> f64 {
        let blur = 4.0 * f64::EPSILON * self.reach;
        let mut p = [Range::ZERO; 3];
        for (lane, factor) in CLEAR.iter().flat_map(|factor| [*factor, -*factor]).enumerate() {
            let at = point + normal * (factor * self.narrow);
            for axis in 0..3 {
                (p[axis].low[lane], p[axis].high[lane]) = (at[axis] - blur, at[axis] + blur);
            }
        }
        let range = self.field.ranges.values(self.field.level, &p, &mut scratch.roots.ranges);
        let is_off = |lane: usize| {
            let [low, high] = range.lane(lane);
            !(low <= 0.0 && high >= 0.0)
        };
        let found = (0..CLEAR.len()).find(|&i| is_off(2 * i) && is_off(2 * i + 1));
        found.map_or(CLEAR[0], |i| CLEAR[i]) * self.narrow
    }

    /// Surface parameters.
    pub(super) fn uv(&self, point: DVec3) -> [f64; 2] {
        direction_uv(point - self.middle)
    }
}
