//! Rays against a torus.
//!
//! Along a ray the torus is a polynomial of the fourth degree. Solved by formulas, or from its coefficients alone, it loses
//! half of all digits where a ray grazes the surface or the tube is thin, which is seen as speckles. Here the polynomial
//! only tells, by the roots of its derivative, between which distances there is at most one root; the root itself is found
//! by bisection and Newton's steps on the distance from the surface, which is well conditioned everywhere.

use super::round::{Axis, MOST_INTERVALS, NOWHERE, Spot, nearest_to};
use super::shapes::BOUND;
use super::solid::Ray;
use hray_core::{DVec3, Torus};

/// Steps of a search: bisection alone needs not more to tell neighbouring numbers apart.
const MOST_STEPS: u32 = 80;

#[derive(Clone, Debug)]
pub(super) struct PreparedTorus {
    axis: Axis,
    center: DVec3,
    radius: f64,
    tube: f64,
    bound: f64,
}

/// A ray in units of the torus' outer radius and with a direction of length 1, from the place nearest to the centre.
struct Line {
    /// Of that place: the height above the plane of the circle, and the part across the axis.
    height: f64,
    across: DVec3,
    /// How both grow.
    rise: f64,
    run: DVec3,
    radius: f64,
    tube: f64,
}

impl Line {
    /// Negative inside, zero on the surface; and how it grows.
    fn surface(&self, t: f64) -> (f64, f64) {
        let (height, across) = (self.height + self.rise * t, self.across + self.run * t);
        let distance = across.length();
        let off = distance - self.radius;
        let growth = if distance > 0.0 { across.dot(self.run) / distance } else { 0.0 };
        let value = off * off + height * height - self.tube * self.tube;
        (value, 2.0 * (off * growth + height * self.rise))
    }
}

impl PreparedTorus {
    pub(super) fn new(torus: &Torus) -> Self {
        let Torus { center, axis, radius, tube } = *torus;
        let size = center.x.abs() + center.y.abs() + center.z.abs() + radius + tube;
        Self { axis: Axis::new(axis), center, radius, tube, bound: 2.0 * BOUND * size }
    }

    pub(super) fn intervals(&self, ray: &Ray) -> [[f64; 2]; MOST_INTERVALS] {
        let mut found = [NOWHERE; MOST_INTERVALS];
        let (from, near) = nearest_to(ray, self.center);
        let (outer, length) = (self.radius + self.tube, ray.direction.length());
        let (near, direction) = (near / outer, ray.direction / length);
        // Outside of the sphere around it. (Also where one is no number.)
        let reach = 1.0 - near.dot(near);
        if reach.is_nan() || reach <= 0.0 {
            return found;
        }
        let u = self.axis.along;
        let (height, rise) = (near.dot(u), direction.dot(u));
        let line = Line {
            height,
            across: near - u * height,
            rise,
            run: direction - u * rise,
            radius: self.radius / outer,
            tube: self.tube / outer,
        };
        // Between the planes that it lies between.
        let reach = reach.sqrt();
        let (mut low, mut high) = (-reach, reach);
        if rise == 0.0 {
            if height.abs() > line.tube {
                return found;
            }
        } else {
            let [a, b] = [(-line.tube - height) / rise, (line.tube - height) / rise];
            (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
        }
        if low.is_nan() || high.is_nan() || low >= high {
            return found;
        }
        let mut pieces = Pieces::new(&line, near.dot(near), [low, high]);
        let mut roots = [f64::NAN; 2 * MOST_INTERVALS];
        let mut count = 0;
        let mut start = low;
        // Both ends are outside, so what rounding says of them is not asked.
        let mut is_inside = false;
        loop {
            let end = pieces.next().unwrap_or(high);
            let ends_inside = end < high && line.surface(end).0 < 0.0;
            if ends_inside != is_inside && count < roots.len() {
                roots[count] = root(|t| line.surface(t), [start, end], ends_inside);
                count += 1;
            }
            is_inside = ends_inside;
            start = end;
            if end >= high {
                break;
            }
        }
        for (interval, ends) in found.iter_mut().zip(roots.chunks_exact(2)) {
            if ends[0] < ends[1] {
                *interval = [from + ends[0] * outer / length, from + ends[1] * outer / length];
            }
        }
        found
    }

    /// The height above the plane of the circle, and the nearest point of the circle; both from the centre.
    fn parts(&self, point: DVec3) -> (f64, DVec3, DVec3) {
        let from = point - self.center;
        let height = from.dot(self.axis.along);
        let across = from - self.axis.along * height;
        let distance = across.length();
        let out = if distance > 0.0 { across / distance } else { self.axis.across() };
        (height, from, out)
    }

    pub(super) fn spot(&self, point: DVec3) -> Spot {
        let (_, from, out) = self.parts(point);
        let ring = out * self.radius;
        let away = from - ring;
        let distance = away.length();
        let normal = if distance > 0.0 { away / distance } else { out };
        Spot { point: self.center + (ring + normal * self.tube), normal, bound: self.bound }
    }

    pub(super) fn uv(&self, point: DVec3) -> [f64; 2] {
        let (height, from, out) = self.parts(point);
        let off = from.dot(out) - self.radius;
        let turns = libm::atan2(height, off) / std::f64::consts::TAU;
        let v = if turns < 0.0 { turns + 1.0 } else { turns };
        [self.axis.angle(out), if v < 1.0 { v } else { 0.0 }]
    }

    pub(super) fn sphere(&self) -> (DVec3, f64) {
        (self.center, self.radius + self.tube)
    }

    pub(super) fn corners(&self) -> [DVec3; 2] {
        let reach = self.axis.reach() * self.radius + self.tube;
        [self.center - reach, self.center + reach]
    }
}

/// The places between two ends where the polynomial t⁴ + p t² + q t + s turns, in ascending order.
struct Pieces {
    turns: [f64; 3],
    next: usize,
}

impl Pieces {
    fn new(line: &Line, squared: f64, [low, high]: [f64; 2]) -> Self {
        let (radius, tube) = (line.radius, line.tube);
        // (|x|² + R² - r²)² - 4 R² (|x|² - y²), where |x|² = t² + squared and y = height + rise t.
        let gamma = squared + radius * radius - tube * tube;
        let four = 4.0 * radius * radius;
        let p = 2.0 * gamma - four * (1.0 - line.rise * line.rise);
        let q = 2.0 * four * line.height * line.rise;
        // The derivative, a quarter of it, and its own.
        let cubic = |t: f64| ((t * t + 0.5 * p) * t + 0.25 * q, 3.0 * t * t + 0.5 * p);
        let mut ends = [low, low, high, high];
        if p < 0.0 {
            let turn = (-p / 6.0).sqrt();
            (ends[1], ends[2]) = ((-turn).clamp(low, high), turn.clamp(low, high));
        }
        let mut pieces = Self { turns: [f64::INFINITY; 3], next: 0 };
        let mut count = 0;
        let mut before = f64::NEG_INFINITY;
        for pair in ends.windows(2) {
            let [start, end] = [pair[0], pair[1]];
            if start >= end {
                continue;
            }
            let signs = [cubic(start).0 < 0.0, cubic(end).0 < 0.0];
            if signs[0] != signs[1] {
                let turn = root(cubic, [start, end], signs[1]);
                if turn > before {
                    pieces.turns[count] = turn;
                    count += 1;
                    before = turn;
                }
            }
        }
        pieces
    }

    fn next(&mut self) -> Option<f64> {
        let turn = self.turns.get(self.next).copied().filter(|turn| *turn < f64::INFINITY)?;
        self.next += 1;
        Some(turn)
    }
}

/// Where a function, which gives its value and its growth, changes its sign between two places; `falls` where it becomes
/// negative. Newton's steps, and halves where they leave what is known (W. Press et al., "Numerical Recipes", § 9.4).
fn root(function: impl Fn(f64) -> (f64, f64), [mut low, mut high]: [f64; 2], falls: bool) -> f64 {
    let mut t = 0.5 * (low + high);
    for _ in 0..MOST_STEPS {
        let (value, growth) = function(t);
        if value == 0.0 {
            return t;
        }
        if (value < 0.0) == falls {
            high = t;
        } else {
            low = t;
        }
        let step = t - value / growth;
        let is_within = low < step && step < high;
        let next = if is_within { step } else { 0.5 * (low + high) };
        // Nothing lies between, or nothing changes.
        if !(low < next && next < high) || (is_within && (next - t).abs() <= f64::EPSILON * t.abs()) {
            return if is_within { next } else { t };
        }
        t = next;
    }
    t
}
