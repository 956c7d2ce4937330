//! Rays against a quadric, one at a time.
//!
//! Along a ray the polynomial is one of the second degree. Where the terms of its discriminant may cancel, that is taken from
//! the polynomial's value at the vertex of the parabola, as for a sphere (E. Haines, J. Günther, T. Akenine-Möller, "Precision
//! Improvements for Ray/Sphere Intersection", Ray Tracing Gems, 2019).

use super::round::{MOST_INTERVALS, NOWHERE, Spot, nearest_to};
use super::shapes::BOUND;
use super::solid::Ray;
use hray_core::{DMat3, DVec3, Quadric};

const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// f(p) = p · Q p + l · p + k, with what can be computed once.
#[derive(Clone, Debug)]
pub(super) struct PreparedQuadric {
    form: Form,
    /// The middle of an ellipsoid, and how far it reaches along each axis.
    ellipsoid: Option<(DVec3, DVec3)>,
}

#[derive(Clone, Copy, Debug)]
struct Form {
    square: DMat3,
    linear: DVec3,
    constant: f64,
}

impl Form {
    fn value(&self, p: DVec3) -> f64 {
        p.dot(self.square * p + self.linear) + self.constant
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        (self.square * p) * 2.0 + self.linear
    }

    /// The sum of the magnitudes of all terms: rounding moves the value by a few parts in 2^53 of it.
    fn size(&self, p: DVec3) -> f64 {
        let DMat3 { x_axis, y_axis, z_axis } = self.square;
        let square = DMat3::from_cols(x_axis.abs(), y_axis.abs(), z_axis.abs());
        p.abs().dot(square * p.abs() + self.linear.abs()) + self.constant.abs()
    }
}

impl PreparedQuadric {
    pub(super) fn new(quadric: &Quadric) -> Self {
        let Quadric { square, product, linear, constant } = *quadric;
        let [xy, xz, yz] = (product * 0.5).to_array();
        let square = DMat3::from_cols(
            DVec3::new(square.x, xy, xz),
            DVec3::new(xy, square.y, yz),
            DVec3::new(xz, yz, square.z),
        );
        let form = Form { square, linear, constant };
        Self { form, ellipsoid: ellipsoid(&form) }
    }

    /// The distances between which the function is negative along a ray, in ascending order.
    pub(super) fn intervals(&self, ray: &Ray) -> [[f64; 2]; MOST_INTERVALS] {
        let middle = self.ellipsoid.map_or(DVec3::ZERO, |(middle, _)| middle);
        let (from, near) = nearest_to(ray, middle);
        let p = middle + near;
        let d = ray.direction;
        // a t² + 2 b t + c, counted from there.
        let square_d = self.form.square * d;
        let (a, b, c) =
            (d.dot(square_d), square_d.dot(p) + 0.5 * d.dot(self.form.linear), self.form.value(p));
        if a == 0.0 {
            // At most one root: the function falls or rises for ever, or does not change.
            let root = self.refined(ray, from - 0.5 * c / b, 2.0 * b);
            let inside = if b > 0.0 {
                [f64::NEG_INFINITY, root]
            } else if b < 0.0 {
                [root, f64::INFINITY]
            } else if c < 0.0 {
                EVERYWHERE
            } else {
                NOWHERE
            };
            return [inside, NOWHERE];
        }
        // Where b² and a c cancel, from the value at the vertex of the parabola, which is then as near as the roots. Elsewhere
        // the vertex may be so far (a ray almost along a line on the surface) that nothing of its value is right.
        let plain = b * b - a * c;
        let discriminant = if plain > 0.5 * b * b { plain } else { -a * self.form.value(p - d * (b / a)) };
        if discriminant > 0.0 {
            let root = discriminant.sqrt();
            let q = -(b + root.copysign(b));
            let slope = -(2.0 * root).copysign(b);
            let (first, second) =
                (self.refined(ray, from + c / q, -slope), self.refined(ray, from + q / a, slope));
            let [low, high] = if first < second { [first, second] } else { [second, first] };
            return if a > 0.0 {
                [[low, high], NOWHERE]
            } else {
                [[f64::NEG_INFINITY, low], [high, f64::INFINITY]]
            };
        }
        // The parabola stays on one side, which is that to which it opens.
        [if a < 0.0 { EVERYWHERE } else { NOWHERE }, NOWHERE]
    }

    /// One step of Newton's method from a root at which the function rises by `slope`: the root was counted from a point that may
    /// be far from it, where the terms are larger than here and so is what rounding makes of them.
    fn refined(&self, ray: &Ray, root: f64, slope: f64) -> f64 {
        let step = self.form.value(ray.origin + ray.direction * root) / slope;
        if step.is_finite() { root - step } else { root }
    }

    pub(super) fn spot(&self, point: DVec3) -> Spot {
        let gradient = self.form.gradient(point);
        let steepness = gradient.length();
        let rounding = BOUND * self.form.size(point);
        // How far rounding may move the surface: near the tip of a cone the function is not steep, but curved.
        let DMat3 { x_axis, y_axis, z_axis } = self.form.square;
        let curvature = x_axis.abs().max(y_axis.abs()).max(z_axis.abs()).max_element();
        let (by_slope, by_curve) = (rounding / steepness, (rounding / curvature).sqrt());
        let (normal, off) = if steepness > 0.0 {
            (gradient / steepness, self.form.value(point) / steepness)
        } else {
            (DVec3::Y, 0.0)
        };
        let point = point - normal * off;
        let size = point.x.abs() + point.y.abs() + point.z.abs();
        Spot { point, normal, bound: 2.0 * by_slope.min(by_curve) + BOUND * size }
    }

    pub(super) fn uv(point: DVec3) -> [f64; 2] {
        [point.x, point.z]
    }

    pub(super) fn sphere(&self) -> (DVec3, f64) {
        self.ellipsoid.map_or((DVec3::ZERO, f64::INFINITY), |(middle, reach)| (middle, reach.length()))
    }

    pub(super) fn corners(&self) -> [DVec3; 2] {
        self.ellipsoid.map_or([DVec3::NEG_INFINITY, DVec3::INFINITY], |(middle, reach)| {
            // A little more, for what rounding makes of both.
            let reach = reach * (1.0 + 1e-6) + middle.abs() * 1e-9;
            [middle - reach, middle + reach]
        })
    }
}

/// Where the function is negative in an ellipsoid alone: its middle and its reach.
fn ellipsoid(form: &Form) -> Option<(DVec3, DVec3)> {
    let q = form.square;
    let minor = q.x_axis.x * q.y_axis.y - q.x_axis.y * q.x_axis.y;
    // Sylvester's criterion, and nothing so flat that its inverse is worth nothing.
    let trace = q.x_axis.x + q.y_axis.y + q.z_axis.z;
    let determinant = q.determinant();
    if !(q.x_axis.x > 0.0 && minor > 0.0 && determinant > 1e-9 * trace * trace * trace) {
        return None;
    }
    let inverse = q.inverse();
    let middle = -(inverse * form.linear) * 0.5;
    let depth = -form.value(middle);
    if depth <= 0.0 {
        // Nothing, or a point.
        return Some((middle, DVec3::ZERO));
    }
    let reach = |variance: f64| (depth * variance).sqrt();
    let reach = DVec3::new(reach(inverse.x_axis.x), reach(inverse.y_axis.y), reach(inverse.z_axis.z));
    (middle.is_finite() && reach.is_finite()).then_some((middle, reach))
}
