//! Rays against curved shapes, one ray at a time: truncated cones, discs, tori and quadrics.
//!
//! Distances are worked out from the point of the ray that is nearest to the middle of the shape, so that a ray from far
//! away meets a shape as exactly as its own numbers allow.

use super::quadric::PreparedQuadric;
use super::shapes::BOUND;
use super::solid::Ray;
use super::torus::PreparedTorus;
use super::uv::longitude;
use hray_core::{DVec3, Disc, Frustum, Shape};

/// The most stretches of a ray that can be inside one such shape.
pub(super) const MOST_INTERVALS: usize = 2;

/// What lies along a ray and has no inside.
pub(super) const NOWHERE: [f64; 2] = [f64::NAN; 2];

/// A point moved onto the surface, the unit normal there, and how far from the point along the normal one has to be so that
/// no rounding can tell that one is on the other side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
    pub(super) bound: f64,
}

/// For rays that there are not.
pub(super) const NO_SPOT: Spot = Spot { point: DVec3::ZERO, normal: DVec3::ZERO, bound: 0.0 };

/// A shape with what can be computed once.
#[derive(Clone, Debug)]
pub(super) enum Round {
    Frustum(PreparedFrustum),
    Disc(PreparedDisc),
    Torus(PreparedTorus),
    Quadric(PreparedQuadric),
}

impl Round {
    pub(super) fn new(shape: &Shape) -> Option<Self> {
        Some(match shape {
            Shape::Frustum(frustum) => Self::Frustum(PreparedFrustum::new(frustum)),
            Shape::Disc(disc) => Self::Disc(PreparedDisc::new(disc)),
            Shape::Torus(torus) => Self::Torus(PreparedTorus::new(torus)),
            Shape::Quadric(quadric) => Self::Quadric(PreparedQuadric::new(quadric)),
            _ => return None,
        })
    }

    /// The least distance beyond `nearest` at which a ray meets the surface.
    pub(super) fn hit(&self, ray: &Ray, nearest: f64) -> Option<f64> {
        let counts = |distance: &f64| *distance > nearest && *distance < f64::INFINITY;
        match self {
            Self::Frustum(frustum) if !frustum.is_capped => frustum.open_hits(ray).into_iter().find(counts),
            Self::Disc(disc) => disc.hit(ray).filter(counts),
            _ => self.intervals(ray).as_flattened().iter().copied().find(counts),
        }
    }

    /// All distances at which a ray meets the surface; some may be no numbers.
    pub(super) fn meet(&self, ray: &Ray, each: impl FnMut(f64)) {
        match self {
            Self::Frustum(frustum) if !frustum.is_capped => frustum.open_hits(ray).into_iter().for_each(each),
            Self::Disc(disc) => disc.hit(ray).into_iter().for_each(each),
            _ => self.intervals(ray).as_flattened().iter().copied().for_each(each),
        }
    }

    /// The distances between which a ray is inside, in ascending order; no numbers for what there is not.
    pub(super) fn intervals(&self, ray: &Ray) -> [[f64; 2]; MOST_INTERVALS] {
        match self {
            Self::Frustum(frustum) if frustum.is_capped => [frustum.interval(ray), NOWHERE],
            Self::Torus(torus) => torus.intervals(ray),
            Self::Quadric(quadric) => quadric.intervals(ray),
            Self::Frustum(_) | Self::Disc(_) => [NOWHERE; MOST_INTERVALS],
        }
    }

    /// Where a point near the surface is on it.
    pub(super) fn spot(&self, point: DVec3) -> Spot {
        match self {
            Self::Frustum(frustum) => frustum.spot(point),
            Self::Disc(disc) => disc.spot(point),
            Self::Torus(torus) => torus.spot(point),
            Self::Quadric(quadric) => quadric.spot(point),
        }
    }

    /// Surface parameters: see the shapes.
    pub(super) fn uv(&self, point: DVec3) -> [f64; 2] {
        match self {
            Self::Frustum(frustum) => frustum.uv(point),
            Self::Disc(disc) => disc.uv(point),
            Self::Torus(torus) => torus.uv(point),
            Self::Quadric(_) => PreparedQuadric::uv(point),
        }
    }

    /// The centre and the radius of a sphere around it.
    pub(super) fn sphere(&self) -> (DVec3, f64) {
        match self {
            Self::Frustum(frustum) => {
                let half = 0.5 * frustum.height;
                let [(_, a), (_, b)] = frustum.circles;
                let radius = a.max(b);
                (frustum.middle, (half * half + radius * radius).sqrt())
            }
            Self::Disc(disc) => (disc.center, disc.radius),
            Self::Torus(torus) => torus.sphere(),
            Self::Quadric(quadric) => quadric.sphere(),
        }
    }

    /// The corners of a box around it.
    pub(super) fn corners(&self) -> [DVec3; 2] {
        match self {
            Self::Frustum(frustum) => {
                let [a, b] = frustum.circles.map(|(center, radius)| frustum.axis.around(center, radius));
                [a[0].min(b[0]), a[1].max(b[1])]
            }
            Self::Disc(disc) => disc.axis.around(disc.center, disc.radius),
            Self::Torus(torus) => torus.corners(),
            Self::Quadric(quadric) => quadric.corners(),
        }
    }
}

/// A direction, and two at right angles to it from which angles are measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) along: DVec3,
    x: DVec3,
    z: DVec3,
}

impl Axis {
    /// The y axis, turned to `along`, which has length 1, on the shortest way.
    pub(super) fn new(along: DVec3) -> Self {
        // Householder's reflections, two of them, make a rotation (T. Möller and J. Hughes, "Efficiently Building a
        // Matrix to Rotate One Vector to Another", JGT 4(4), 1999).
        let turn = |v: DVec3| {
            if along.y <= -1.0 + f64::EPSILON {
                return DVec3::new(v.x, -v.y, -v.z);
            }
            let half = DVec3::Y + along;
            v - half * (half.dot(v) / (1.0 + along.y)) + along * (2.0 * v.y)
        };
        Self { along, x: turn(DVec3::X), z: turn(DVec3::Z) }
    }

    /// The angle about the axis, in turns from 0 to just below 1; counted as a sphere's longitude is.
    pub(super) fn angle(&self, v: DVec3) -> f64 {
        longitude(v.dot(self.x), v.dot(self.z))
    }

    /// A direction at right angles.
    pub(super) const fn across(&self) -> DVec3 {
        self.x
    }

    /// A box around a circle with this axis.
    pub(super) fn around(&self, center: DVec3, radius: f64) -> [DVec3; 2] {
        let reach = self.reach() * radius;
        [center - reach, center + reach]
    }

    /// How far a circle of radius 1 reaches along x, y and z.
    pub(super) fn reach(&self) -> DVec3 {
        // Not from one component: where that is nearly 1, what the others reach is lost in its square.
        let DVec3 { x, y, z } = self.along;
        let of = |a: f64, b: f64| (a * a + b * b).sqrt();
        DVec3::new(of(y, z), of(x, z), of(x, y))
    }
}

/// The distance along a ray to where it is nearest to a point, and that place relative to the point.
pub(super) fn nearest_to(ray: &Ray, point: DVec3) -> (f64, DVec3) {
    let from = ray.origin - point;
    let distance = -from.dot(ray.direction) / ray.direction.dot(ray.direction);
    (distance, from + ray.direction * distance)
}

fn sum(v: DVec3) -> f64 {
    v.x.abs() + v.y.abs() + v.z.abs()
}

#[derive(Clone, Debug)]
pub(super) struct PreparedFrustum {
    axis: Axis,
    height: f64,
    /// Centre and radius, at the base and at the top.
    circles: [(DVec3, f64); 2],
    middle: DVec3,
    /// How the radius grows along the axis.
    growth: f64,
    is_capped: bool,
    bound: f64,
}

/// A ray as the equation of a frustum's side sees it, from the place nearest to the middle.
struct Meeting {
    /// The distance to that place.
    from: f64,
    /// The height above the base there, and how it grows.
    height: [f64; 2],
    /// Both distances from there at which the side, drawn out without end, is met, in ascending order; no numbers where it
    /// is not.
    roots: [f64; 2],
    /// Whether what is between the roots is inside, and not what is beyond them.
    between: bool,
    /// Whether all of the ray is inside the side, where there are no roots.
    everywhere: bool,
}

impl PreparedFrustum {
    fn new(frustum: &Frustum) -> Self {
        let Frustum { base, top, radii, is_capped } = *frustum;
        let length = (top - base).length();
        let along = if length > 0.0 { (top - base) / length } else { DVec3::Y };
        Self {
            axis: Axis::new(along),
            height: length,
            circles: [(base, radii[0]), (top, radii[1])],
            middle: (base + top) * 0.5,
            growth: (radii[1] - radii[0]) / length,
            is_capped,
            bound: 2.0 * BOUND * (sum(base) + sum(top) + radii[0] + radii[1]),
        }
    }

    fn meet(&self, ray: &Ray) -> Meeting {
        let (from, near) = nearest_to(ray, self.middle);
        let (u, k) = (self.axis.along, self.growth);
        let d = ray.direction;
        // From the base, in two parts: along the axis and across.
        let across_middle = near - u * near.dot(u);
        let height = near.dot(u) + 0.5 * self.height;
        let rise = d.dot(u);
        let across = d - u * rise;
        let radius = self.circles[0].1 + k * height;
        // a t² + 2 b t + c is the square of the distance from the axis, less that of the radius there.
        let a = across.dot(across) - k * k * rise * rise;
        let b = across_middle.dot(across) - k * rise * radius;
        let c = across_middle.dot(across_middle) - radius * radius;
        let scale = across.dot(across) + k * k * rise * rise;
        let discriminant = if a.abs() > 1e-6 * scale {
            // At the vertex of the parabola nothing large is cancelled.
            let vertex = -b / a;
            let (there, wide) = (across_middle + across * vertex, radius + k * rise * vertex);
            -a * (there.dot(there) - wide * wide)
        } else {
            b * b - a * c
        };
        let (mut roots, mut everywhere) = (NOWHERE, false);
        if discriminant >= 0.0 {
            let q = -(b + discriminant.sqrt().copysign(b));
            if q == 0.0 {
                // A ray along the axis, in a cylinder or beside it; else both roots are 0.
                (roots, everywhere) = if a == 0.0 { (NOWHERE, c <= 0.0) } else { ([0.0; 2], false) };
            } else {
                let (first, second) = (c / q, q / a);
                roots = if first < second { [first, second] } else { [second, first] };
            }
        } else {
            everywhere = a < 0.0;
        }
        // With a of 0 one root is infinite, on the side where the ray stays inside.
        Meeting { from, height: [height, rise], roots, between: a >= 0.0, everywhere }
    }

    /// The distances, from the place nearest to the middle, between which a ray is between the planes of both ends.
    fn slab(&self, [height, rise]: [f64; 2]) -> [f64; 2] {
        if rise == 0.0 {
            let is_between = (0.0..=self.height).contains(&height);
            return if is_between { [f64::NEG_INFINITY, f64::INFINITY] } else { NOWHERE };
        }
        let [base, top] = [-height / rise, (self.height - height) / rise];
        if base < top { [base, top] } else { [top, base] }
    }

    fn interval(&self, ray: &Ray) -> [f64; 2] {
        let meeting = self.meet(ray);
        let slab = self.slab(meeting.height);
        if slab[0].is_nan() {
            return NOWHERE;
        }
        let [near, far] = meeting.roots;
        let common = |[a, b]: [f64; 2]| [a.max(slab[0]), b.min(slab[1])];
        let inside = if near.is_nan() {
            if meeting.everywhere { slab } else { NOWHERE }
        } else if meeting.between {
            common([near, far])
        } else {
            // Between the planes there is one half of the double cone only, so one of the two is empty but for rounding.
            let [a, b] = [common([f64::NEG_INFINITY, near]), common([far, f64::INFINITY])];
            if a[1] - a[0] > b[1] - b[0] { a } else { b }
        };
        if inside[0] < inside[1] { inside.map(|distance| meeting.from + distance) } else { NOWHERE }
    }

    /// The distances at which the side is met, in ascending order.
    fn open_hits(&self, ray: &Ray) -> [f64; 2] {
        let meeting = self.meet(ray);
        let [height, rise] = meeting.height;
        meeting.roots.map(|distance| {
            let at = height + rise * distance;
            if (0.0..=self.height).contains(&at) { meeting.from + distance } else { f64::NAN }
        })
    }

    /// The height above the base, and the part across the axis.
    fn parts(&self, point: DVec3) -> (f64, DVec3) {
        let from_base = point - self.circles[0].0;
        let height = from_base.dot(self.axis.along);
        (height, from_base - self.axis.along * height)
    }

    fn spot(&self, point: DVec3) -> Spot {
        let (height, across) = self.parts(point);
        let (distance, slope) = (across.length(), (1.0 + self.growth * self.growth).sqrt());
        let outside = (distance - (self.circles[0].1 + self.growth * height)) / slope;
        let is_top = height > 0.5 * self.height;
        let above = if is_top { height - self.height } else { height };
        if self.is_capped && above.abs() < outside.abs() {
            let normal = if is_top { self.axis.along } else { -self.axis.along };
            return Spot { point: point - self.axis.along * above, normal, bound: self.bound };
        }
        let out = if distance > 0.0 { across / distance } else { self.axis.across() };
        let normal = (out - self.axis.along * self.growth) / slope;
        Spot { point: point - normal * outside, normal, bound: self.bound }
    }

    fn uv(&self, point: DVec3) -> [f64; 2] {
        let (height, across) = self.parts(point);
        let distance = across.length();
        let outside = distance - (self.circles[0].1 + self.growth * height);
        let is_top = height > 0.5 * self.height;
        let above = if is_top { height - self.height } else { height };
        let v = if self.is_capped && above.abs() < outside.abs() {
            let radius = self.circles[usize::from(is_top)].1;
            if radius > 0.0 { distance / radius } else { 0.0 }
        } else {
            height / self.height
        };
        [self.axis.angle(across), v]
    }
}

#[derive(Clone, Debug)]
pub(super) struct PreparedDisc {
    axis: Axis,
    center: DVec3,
    radius: f64,
    hole: f64,
    bound: f64,
}

impl PreparedDisc {
    fn new(disc: &Disc) -> Self {
        let Disc { center, normal, radius, hole } = *disc;
        Self { axis: Axis::new(normal), center, radius, hole, bound: 2.0 * BOUND * (sum(center) + radius) }
    }

    fn hit(&self, ray: &Ray) -> Option<f64> {
        let (from, near) = nearest_to(ray, self.center);
        let distance = -near.dot(self.axis.along) / ray.direction.dot(self.axis.along);
        let there = near + ray.direction * distance;
        let squared = there.dot(there);
        let is_on = squared <= self.radius * self.radius && squared >= self.hole * self.hole;
        is_on.then_some(from + distance)
    }

    fn spot(&self, point: DVec3) -> Spot {
        let normal = self.axis.along;
        let above = (point - self.center).dot(normal);
        Spot { point: point - normal * above, normal, bound: self.bound }
    }

    fn uv(&self, point: DVec3) -> [f64; 2] {
        let from = point - self.center;
        [self.axis.angle(from), from.length() / self.radius]
    }
}
