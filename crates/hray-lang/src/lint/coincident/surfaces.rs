//! Pieces of surfaces in the world, told apart by numbers that are the same where two lie in each other.

use glam::{DAffine3, DMat3, DVec2, DVec3};
use hray_core::{Frustum, Shape};
use std::f64::consts::TAU;

/// Numbers that differ by less than this share of what they are made of are the same.
const SAME: f64 = 1e-9;
/// Corners of the polygon that stands for a circle.
const CORNERS: usize = 24;
/// A square of this many units, and more where a plane is far away, stands for a plane without end.
const ENDLESS: f64 = 10.0;

/// What a piece lies in, however much of that it takes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sheet {
    /// normal · p = offset; of both normals, that whose first number is positive.
    Plane {
        normal: DVec3,
        offset: f64,
    },
    /// The image of a sphere, by its centre and the square of the matrix that makes it of the unit sphere.
    Ellipsoid {
        center: DVec3,
        matrix: DMat3,
        square: DMat3,
    },
    /// All points whose distance from the axis is `radius` + `slope` s, where s is counted along the axis from its point that
    /// is nearest to the origin.
    Cone {
        axis: DVec3,
        foot: DVec3,
        slope: f64,
        radius: f64,
        ends: [f64; 2],
    },
    Torus {
        center: DVec3,
        axis: DVec3,
        radius: f64,
        tube: f64,
    },
}

/// A piece of a leaf's surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) leaf: u32,
    pub(super) side: u8,
    pub(super) sheet: Sheet,
    /// In a plane: whether the normal leads out of the leaf.
    pub(super) is_along: bool,
    /// The greatest coordinates in play.
    size: f64,
}

/// A point of a surface and a direction at right angles to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
}

/// Where a leaf is.
struct Placed<'a> {
    to_world: Option<&'a DAffine3>,
    normals: DMat3,
    /// By how much it is larger than in its own space, where it has the same form.
    growth: Option<f64>,
}

impl<'a> Placed<'a> {
    fn new(to_world: Option<&'a DAffine3>) -> Self {
        let Some(matrix) = to_world.map(|to| to.matrix3) else {
            return Self { to_world, normals: DMat3::IDENTITY, growth: Some(1.0) };
        };
        let lengths = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length);
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let skew = x.dot(y).abs() + y.dot(z).abs() + z.dot(x).abs();
        let growth = lengths[0];
        let is_similar = (lengths[1] - growth).abs() + (lengths[2] - growth).abs() <= SAME * growth
            && skew <= SAME * growth * growth;
        Self { to_world, normals: matrix.inverse().transpose(), growth: is_similar.then_some(growth) }
    }

    fn point(&self, p: DVec3) -> DVec3 {
        self.to_world.map_or(p, |to| to.transform_point3(p))
    }

    fn vector(&self, v: DVec3) -> DVec3 {
        self.to_world.map_or(v, |to| to.transform_vector3(v))
    }

    fn normal(&self, n: DVec3) -> DVec3 {
        (self.normals * n).normalize_or_zero()
    }
}

/// The pieces of a leaf's surface. Of what is not listed, such as meshes, there are none.
pub(super) fn faces(shape: &Shape, to_world: Option<&DAffine3>, leaf: u32, into: &mut Vec<Face>) {
    let placed = Placed::new(to_world);
    let mut add = |side: u8, sheet: Option<(Sheet, bool)>, size: f64| {
        if let Some((sheet, is_along)) = sheet.filter(|_| size.is_finite()) {
            into.push(Face { leaf, side, sheet, is_along, size });
        }
    };
    match shape {
        Shape::Cuboid(cuboid) => {
            for side in 0..6 {
                let (axis, is_max) = (usize::from(side / 2), side % 2 == 1);
                let normal = if is_max { DVec3::AXES[axis] } else { -DVec3::AXES[axis] };
                let corner = if is_max { cuboid.max } else { cuboid.min };
                let size = [cuboid.min, cuboid.max].map(|p| placed.point(p).abs().max_element());
                add(side, plane(&placed, normal, corner), size[0].max(size[1]));
            }
        }
        Shape::Plane(it) => {
            let length = it.normal.length();
            let foot = it.normal * (-it.offset / (length * length));
            add(0, plane(&placed, it.normal, foot), placed.point(foot).abs().max_element());
        }
        Shape::Disc(disc) => {
            let size = placed.point(disc.center).abs().max_element()
                + placed.vector(DVec3::splat(disc.radius)).length();
            add(0, plane(&placed, disc.normal, disc.center), size);
        }
        Shape::Sphere(sphere) => {
            let matrix = placed.to_world.map_or(DMat3::IDENTITY, |to| to.matrix3) * sphere.radius.abs();
            let (center, square) = (placed.point(sphere.center), matrix * matrix.transpose());
            let size = center.abs().max_element() + matrix.x_axis.length();
            add(0, Some((Sheet::Ellipsoid { center, matrix, square }, true)), size);
        }
        Shape::Torus(torus) => {
            let Some(growth) = placed.growth else { return };
            let (center, axis) = (placed.point(torus.center), upward(placed.normal(torus.axis)).0);
            let [radius, tube] = [torus.radius, torus.tube].map(|length| length * growth);
            let size = center.abs().max_element() + radius + tube;
            add(0, Some((Sheet::Torus { center, axis, radius, tube }, true)), size);
        }
        Shape::Frustum(frustum) => {
            let axis = frustum.top - frustum.base;
            let reach = placed.vector(DVec3::splat(frustum.radii[0].max(frustum.radii[1]))).length();
            let size = [frustum.base, frustum.top].map(|p| placed.point(p).abs().max_element());
            let size = size[0].max(size[1]) + reach;
            for (side, normal, center) in [(0, -axis, frustum.base), (1, axis, frustum.top)] {
                if frustum.is_capped && frustum.radii[usize::from(side)] > 0.0 {
                    add(side, plane(&placed, normal, center), size);
                }
            }
            add(2, cone(&placed, frustum), size);
        }
        _ => {}
    }
}

/// Of a direction and its opposite that whose first number is positive, and whether that is the first.
fn upward(v: DVec3) -> (DVec3, bool) {
    let first = v.to_array().into_iter().find(|x| x.abs() > SAME).unwrap_or(1.0);
    if first > 0.0 { (v, true) } else { (-v, false) }
}

fn plane(placed: &Placed<'_>, outward: DVec3, point: DVec3) -> Option<(Sheet, bool)> {
    let (normal, is_along) = upward(placed.normal(outward));
    let offset = normal.dot(placed.point(point));
    (normal != DVec3::ZERO && offset.is_finite()).then_some((Sheet::Plane { normal, offset }, is_along))
}

fn cone(placed: &Placed<'_>, frustum: &Frustum) -> Option<(Sheet, bool)> {
    let growth = placed.growth?;
    let [base, top] = [frustum.base, frustum.top].map(|p| placed.point(p));
    let [first, second] = frustum.radii.map(|radius| radius * growth);
    let height = (top - base).length();
    let (axis, is_up) = upward((top - base) / height);
    let foot = base - axis * base.dot(axis);
    let slope = (second - first) / if is_up { height } else { -height };
    let ends = if is_up { [base.dot(axis), top.dot(axis)] } else { [top.dot(axis), base.dot(axis)] };
    let radius = first - slope * base.dot(axis);
    Some((Sheet::Cone { axis, foot, slope, radius, ends }, true))
}

impl Face {
    /// The numbers that tell sheets apart, each with the magnitude of what it is made of.
    fn numbers(&self) -> (u8, Vec<(f64, f64)>) {
        let directions = |v: DVec3| v.to_array().map(|x| (x, 1.0));
        let lengths = |v: DVec3| v.to_array().map(|x| (x, self.size));
        match self.sheet {
            Sheet::Plane { normal, offset } => {
                (0, [&directions(normal)[..], &[(offset, self.size)]].concat())
            }
            Sheet::Ellipsoid { center, square, .. } => {
                let size = self.size * self.size;
                let [x, y, z] = [square.x_axis, square.y_axis, square.z_axis];
                let square = [x.x, x.y, x.z, y.y, y.z, z.z].map(|value| (value, size));
                (1, [&lengths(center)[..], &square[..]].concat())
            }
            Sheet::Cone { axis, foot, slope, radius, .. } => (
                2,
                [&directions(axis)[..], &lengths(foot)[..], &[(slope, 1.0), (radius, self.size)]].concat(),
            ),
            Sheet::Torus { center, axis, radius, tube } => {
                let both = [(radius, self.size), (tube, self.size)];
                (3, [&directions(axis)[..], &lengths(center)[..], &both[..]].concat())
            }
        }
    }

    /// A number that is the same for faces in the same sheet, but for a few where rounding falls on the edge.
    pub(super) fn key(&self) -> u64 {
        let (kind, numbers) = self.numbers();
        // FNV-1a, by whole numbers.
        numbers.into_iter().fold(u64::from(kind), |hash, (value, size)| {
            // Twenty binary digits.
            let coarse =
                if value.abs() <= SAME * size { 0 } else { value.to_bits().wrapping_add(1 << 31) >> 32 };
            (hash ^ coarse).wrapping_mul(0x0000_0100_0000_01B3).rotate_left(29)
        })
    }

    /// Whether both lie in the same sheet.
    pub(super) fn is_in_sheet_of(&self, other: &Self) -> bool {
        let ((kind, numbers), (other_kind, others)) = (self.numbers(), other.numbers());
        let same = |((a, size), (b, other_size)): (&(f64, f64), &(f64, f64))| {
            (a - b).abs() <= SAME * size.max(*other_size)
        };
        kind == other_kind && numbers.iter().zip(&others).all(same)
    }
}

/// The corners of a face in a plane, convex and in order; none where it has no end.
pub(super) fn corners(shape: &Shape, to_world: Option<&DAffine3>, side: u8) -> Option<Vec<DVec3>> {
    let placed = Placed::new(to_world);
    let circle = |center: DVec3, axis: DVec3, radius: f64| {
        let [x, y] = across(axis.normalize());
        let corner = |i: usize| {
            let (sine, cosine) = libm::sincos(i as f64 / CORNERS as f64 * TAU);
            placed.point(center + (x * cosine + y * sine) * radius)
        };
        (0..CORNERS).map(corner).collect()
    };
    match shape {
        Shape::Cuboid(cuboid) => {
            let axis = usize::from(side / 2);
            let [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
            let corner = |[u, v]: [bool; 2]| {
                let pick = |k: usize, is_max: bool| if is_max { cuboid.max[k] } else { cuboid.min[k] };
                let mut p = DVec3::ZERO;
                (p[axis], p[i], p[j]) = (pick(axis, side % 2 == 1), pick(i, u), pick(j, v));
                placed.point(p)
            };
            Some([[false, false], [true, false], [true, true], [false, true]].map(corner).to_vec())
        }
        Shape::Disc(disc) => Some(circle(disc.center, disc.normal, disc.radius)),
        Shape::Frustum(frustum) => {
            let center = if side == 0 { frustum.base } else { frustum.top };
            Some(circle(center, frustum.top - frustum.base, frustum.radii[usize::from(side & 1)]))
        }
        _ => None,
    }
}

/// Two unit vectors at right angles to a unit vector and to each other.
pub(super) fn across(n: DVec3) -> [DVec3; 2] {
    let other = if n.x.abs() < 0.6 { DVec3::X } else { DVec3::Y };
    let first = n.cross(other).normalize();
    [first, n.cross(first)]
}

/// The same for a plane without end: a square around the point that is nearest to the origin.
pub(super) fn square(offset: f64) -> Vec<DVec2> {
    let half = ENDLESS + offset.abs();
    [[-half, -half], [half, -half], [half, half], [-half, half]].map(DVec2::from).to_vec()
}

/// Points of a curved sheet where both faces are, and the normals there, outward.
pub(super) fn samples(a: &Face, b: &Face) -> Vec<Sample> {
    match (a.sheet, b.sheet) {
        (Sheet::Ellipsoid { center, matrix, .. }, _) => {
            let normals = matrix.inverse().transpose();
            let signs = [-1.0, 0.0, 1.0];
            let directions = signs
                .iter()
                .flat_map(|x| signs.iter().flat_map(move |y| signs.map(|z| DVec3::new(*x, *y, z))));
            let directions = directions.filter(|direction| *direction != DVec3::ZERO).map(DVec3::normalize);
            directions
                .map(|d| Sample { point: center + matrix * d, normal: (normals * d).normalize_or_zero() })
                .collect()
        }
        (Sheet::Cone { axis, foot, slope, radius, ends }, Sheet::Cone { ends: others, .. }) => {
            let [low, high] = [ends[0].max(others[0]), ends[1].min(others[1])];
            let length = (ends[1] - ends[0]).min(others[1] - others[0]);
            if high - low <= 1e-6 * length {
                return Vec::new();
            }
            let ring = |share: f64| {
                let at = low + (high - low) * share;
                around(axis, 12).map(move |out| Sample {
                    point: foot + axis * at + out * (radius + slope * at),
                    normal: (out - axis * slope).normalize(),
                })
            };
            [0.1, 0.5, 0.9].into_iter().flat_map(ring).collect()
        }
        (Sheet::Torus { center, axis, radius, tube }, _) => around(axis, 8)
            .flat_map(|out| {
                [out, axis, -out, -axis]
                    .map(|normal| Sample { point: center + out * radius + normal * tube, normal })
            })
            .collect(),
        _ => Vec::new(),
    }
}

/// So many directions at right angles to an axis.
fn around(axis: DVec3, count: usize) -> impl Iterator<Item = DVec3> {
    let [x, y] = across(axis);
    (0..count).map(move |i| {
        let (sine, cosine) = libm::sincos((i as f64 + 0.5) / count as f64 * TAU);
        x * cosine + y * sine
    })
}

/// What two convex polygons, both counter-clockwise, have in common. I. Sutherland and G. Hodgman, "Reentrant Polygon
/// Clipping", Communications of the ACM 17(1), 1974.
pub(super) fn common(a: &[DVec2], b: &[DVec2]) -> Vec<DVec2> {
    let mut left = a.to_vec();
    for (i, from) in b.iter().enumerate() {
        let edge = b[(i + 1) % b.len()] - *from;
        let side = |p: DVec2| edge.perp_dot(p - *from);
        let mut kept = Vec::with_capacity(left.len() + 1);
        for (k, &p) in left.iter().enumerate() {
            let q = left[(k + 1) % left.len()];
            let (before, after) = (side(p), side(q));
            if before >= 0.0 {
                kept.push(p);
            }
            if (before < 0.0) != (after < 0.0) {
                kept.push(p + (q - p) * (before / (before - after)));
            }
        }
        left = kept;
    }
    left
}

/// Twice the area of a polygon; negative where it goes clockwise.
pub(super) fn area(polygon: &[DVec2]) -> f64 {
    let Some(first) = polygon.first() else { return 0.0 };
    polygon.windows(2).map(|pair| (pair[0] - *first).perp_dot(pair[1] - *first)).sum()
}
