//! A tracer of obvious code: one ray, every crossing with every surface, and for solids whether points are inside.

use hray_core::{CsgOperation, DAffine3, DVec3, Frustum, Implicit, Mesh, Primitive, Quadric, Shape, Torus};
use hray_expr::{Binary, Node, NodeId, Unary};

/// Where a ray meets something: distance, point, outward normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) distance: f64,
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
}

/// The nearest hit. Of two in the same place, the later.
pub(crate) fn nearest(primitives: &[Primitive], origin: DVec3, direction: DVec3) -> Option<Hit> {
    let hits = primitives.iter().filter_map(|primitive| first(primitive, origin, direction));
    hits.reduce(|best, hit| if hit.distance <= best.distance { hit } else { best })
}

fn first(primitive: &Primitive, origin: DVec3, direction: DVec3) -> Option<Hit> {
    surface(primitive, DAffine3::IDENTITY, origin, direction).first().copied()
}

/// Where a ray meets what is seen of a primitive, in ascending order.
fn surface(primitive: &Primitive, outer: DAffine3, origin: DVec3, direction: DVec3) -> Vec<Hit> {
    let to_world = to_world(primitive, outer);
    if let Shape::Clip(clip) = &primitive.shape {
        let mut all = surface(&clip.shape, to_world, origin, direction);
        all.retain(|hit| is_inside(&clip.within, to_world, hit.point));
        return all;
    }
    let mut all = crossings(primitive, outer, origin, direction);
    all.retain(|hit| hit.distance > 0.0);
    all.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    if !matches!(primitive.shape, Shape::Csg(_) | Shape::Inverse(_)) {
        return all;
    }
    // The surface of a solid is where points just before and just behind are not both inside, or both outside.
    let mut seen = Vec::new();
    for (i, hit) in all.iter().enumerate() {
        let before = if i == 0 { 0.0 } else { all[i - 1].distance };
        let after = all.get(i + 1).map_or(hit.distance + 1.0, |next| next.distance);
        let inside = |a: f64, b: f64| is_inside(primitive, outer, origin + direction * ((a + b) / 2.0));
        let (was, is) = (inside(before, hit.distance), inside(hit.distance, after));
        if was != is {
            // Outward is where one comes from, or goes to.
            let facing = if hit.normal.dot(direction) < 0.0 { hit.normal } else { -hit.normal };
            seen.push(Hit { normal: if is { facing } else { -facing }, ..*hit });
        }
    }
    seen
}

fn to_world(primitive: &Primitive, outer: DAffine3) -> DAffine3 {
    primitive.transform.as_ref().map_or(outer, |transform| outer * **transform)
}

/// All places in which a ray meets the surface of a primitive's leaves, with the leaves' own normals.
fn crossings(primitive: &Primitive, outer: DAffine3, origin: DVec3, direction: DVec3) -> Vec<Hit> {
    let to_world = to_world(primitive, outer);
    let to_object = to_world.inverse();
    let (o, d) = (to_object.transform_point3(origin), to_object.transform_vector3(direction));
    let found: Vec<(f64, DVec3)> = match &primitive.shape {
        Shape::Csg(_) | Shape::Inverse(_) => {
            let operands = primitive.shape.operands().into_iter().flatten();
            return operands.flat_map(|operand| crossings(operand, to_world, origin, direction)).collect();
        }
        // Not a part of solids.
        Shape::Clip(_) => Vec::new(),
        Shape::Frustum(frustum) => frustum_crossings(frustum, o, d),
        // By small steps and halves in the box.
        Shape::Implicit(surface) => {
            let at = |t: f64| in_implicit(surface, o + d * t);
            let size = (surface.max - surface.min).length() / d.length();
            let start = ((surface.min + surface.max) * 0.5 - o).dot(d) / d.length_squared() - 0.51 * size;
            let step = size / 100.0;
            // The functions here change no faster than this.
            let is_near = |value: f64| value.abs() < 2.0 * step * d.length();
            let value = |t: f64| implicit_value(surface, o + d * t);
            let mut found = Vec::new();
            let (mut low, mut before) = (start, at(start));
            for i in 0..102 {
                let from = start + f64::from(i) * step;
                let parts = if is_near(value(from)) || is_near(value(from + step)) { 20 } else { 1 };
                for part in 1..=parts {
                    let to = from + step * (f64::from(part) / f64::from(parts));
                    let after = at(to);
                    if before != after {
                        let mut high = to;
                        for _ in 0..50 {
                            let middle = 0.5 * (low + high);
                            if at(middle) == before { low = middle } else { high = middle }
                        }
                        found.push((high, implicit_normal(surface, o + d * high)));
                    }
                    (low, before) = (to, after);
                }
            }
            found
        }
        // The same.
        Shape::Torus(torus) => {
            let at = |t: f64| from_torus(torus, o + d * t).0 < 0.0;
            let mut found = Vec::new();
            for step in 0..6000 {
                let (mut low, mut high) = (f64::from(step) * 0.003, f64::from(step + 1) * 0.003);
                let before = at(low);
                if before == at(high) {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if at(middle) == before { low = middle } else { high = middle }
                }
                found.push((high, from_torus(torus, o + d * high).1));
            }
            found
        }
        Shape::Quadric(quadric) => {
            // The values at three places tell the parabola.
            let at = |t: f64| quadric_value(quadric, o + d * t);
            let (c, sum, difference) = (at(0.0), at(1.0) + at(-1.0), at(1.0) - at(-1.0));
            let (a, b) = (0.5 * sum - c, 0.5 * difference);
            let discriminant = b * b - 4.0 * a * c;
            if discriminant <= 0.0 {
                return Vec::new();
            }
            // Differences are exact here, whatever the step.
            let along =
                |p: DVec3, axis: DVec3| quadric_value(quadric, p + axis) - quadric_value(quadric, p - axis);
            let slope = |p: DVec3| DVec3::from(DVec3::AXES.map(|axis| along(p, axis)));
            let roots = [-discriminant.sqrt(), discriminant.sqrt()].map(|root| (root - b) / (2.0 * a));
            roots.map(|t| (t, slope(o + d * t))).to_vec()
        }
        Shape::Disc(disc) => {
            let t = (disc.center - o).dot(disc.normal) / d.dot(disc.normal);
            let from = (o + d * t).distance(disc.center);
            if (disc.hole..=disc.radius).contains(&from) { vec![(t, disc.normal)] } else { Vec::new() }
        }
        // Each triangle by Cramer's rule.
        Shape::Mesh(mesh) => {
            let point = |vertex: u32| DVec3::from(mesh.positions()[vertex as usize].map(f64::from));
            let mut found = Vec::new();
            for triangle in mesh.triangles() {
                let [a, b, c] = triangle.map(point);
                let (across, up, normal) = (b - a, c - a, (b - a).cross(c - a));
                let by = d.dot(normal);
                let (v, w) = ((o - a).cross(d).dot(up) / -by, (o - a).cross(d).dot(across) / by);
                if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
                    found.push(((a - o).dot(normal) / by, normal));
                }
            }
            found
        }
        Shape::Sphere(sphere) => {
            let f = o - sphere.center;
            let (a, b, c) = (d.dot(d), 2.0 * f.dot(d), f.dot(f) - sphere.radius * sphere.radius);
            let discriminant = b * b - 4.0 * a * c;
            if discriminant <= 0.0 {
                return Vec::new();
            }
            let roots = [-discriminant.sqrt(), discriminant.sqrt()].map(|root| (root - b) / (2.0 * a));
            roots.map(|t| (t, (o + d * t - sphere.center) / sphere.radius)).to_vec()
        }
        Shape::Plane(plane) => {
            vec![(-(plane.normal.dot(o) + plane.offset) / plane.normal.dot(d), plane.normal)]
        }
        Shape::Cuboid(cuboid) => {
            let mut found = Vec::new();
            for axis in 0..3 {
                for (face, sign) in [(cuboid.min[axis], -1.0), (cuboid.max[axis], 1.0)] {
                    let t = (face - o[axis]) / d[axis];
                    let p = o + d * t;
                    let on_face = (0..3).all(|other| {
                        other == axis || (cuboid.min[other] <= p[other] && p[other] <= cuboid.max[other])
                    });
                    if on_face {
                        found.push((t, DVec3::AXES[axis] * sign));
                    }
                }
            }
            found
        }
    };
    let hit = |(distance, normal): (f64, DVec3)| Hit {
        distance,
        point: origin + direction * distance,
        normal: (to_object.matrix3.transpose() * normal).normalize(),
    };
    found.into_iter().map(hit).collect()
}

/// Of functions of few operations of few kinds: `Function::evaluate` takes memory for each.
fn implicit_value(surface: &Implicit, p: DVec3) -> f64 {
    let mut values = [0.0; 32];
    let nodes = surface.function.nodes();
    for (i, node) in nodes.iter().enumerate() {
        let of = |id: &NodeId| values[id.0 as usize];
        values[i] = match node {
            Node::Constant(v) => *v,
            Node::Input(input) => p[*input as usize],
            Node::Unary(Unary::Sqrt, x) => of(x).sqrt(),
            Node::Unary(Unary::Sin, x) => libm::sin(of(x)),
            Node::Binary(Binary::Add, x, y) => of(x) + of(y),
            Node::Binary(Binary::Sub, x, y) => of(x) - of(y),
            Node::Binary(Binary::Mul, x, y) => of(x) * of(y),
            Node::Binary(Binary::Div, x, y) => of(x) / of(y),
            other => panic!("{other:?}"),
        };
    }
    values[surface.function.outputs()[0].0 as usize]
}

fn in_implicit(surface: &Implicit, p: DVec3) -> bool {
    p.cmpge(surface.min).all() && p.cmple(surface.max).all() && implicit_value(surface, p) < 0.0
}

/// Of the face of the box that the point is on, or by differences.
fn implicit_normal(surface: &Implicit, p: DVec3) -> DVec3 {
    for axis in DVec3::AXES {
        if (p - surface.max).dot(axis).abs() < 1e-12 {
            return axis;
        }
        if (p - surface.min).dot(axis).abs() < 1e-12 {
            return -axis;
        }
    }
    let difference = |by: DVec3| implicit_value(surface, p + by) - implicit_value(surface, p - by);
    // What is left of the third derivative is taken away.
    let along = |axis: DVec3| 8.0 * difference(axis * 1e-3) - difference(axis * 2e-3);
    DVec3::from(DVec3::AXES.map(along))
}

fn quadric_value(quadric: &Quadric, p: DVec3) -> f64 {
    let mixed = DVec3::new(p.x * p.y, p.x * p.z, p.y * p.z);
    quadric.square.dot(p * p) + quadric.product.dot(mixed) + quadric.linear.dot(p) + quadric.constant
}

/// How much of what is around a point a mesh covers: all, 4 pi, from inside. A. van Oosterom and J. Strackee, "The Solid
/// Angle of a Plane Triangle", IEEE Transactions on Biomedical Engineering 30(2), 1983.
fn solid_angle(mesh: &Mesh, p: DVec3) -> f64 {
    let of = |triangle: &[u32; 3]| {
        let [a, b, c] =
            triangle.map(|vertex| DVec3::from(mesh.positions()[vertex as usize].map(f64::from)) - p);
        let [la, lb, lc] = [a, b, c].map(DVec3::length);
        2.0 * libm::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
    };
    mesh.triangles().iter().map(of).sum()
}

/// The distance from the surface, negative inside, and the normal there.
fn from_torus(torus: &Torus, p: DVec3) -> (f64, DVec3) {
    let height = (p - torus.center).dot(torus.axis);
    let across = p - torus.center - torus.axis * height;
    let ring = torus.center + across.normalize() * torus.radius;
    ((p - ring).length() - torus.tube, (p - ring).normalize())
}

/// How far along the axis from 0 to 1, how far from it, and in which direction.
fn in_frustum(frustum: &Frustum, p: DVec3) -> (f64, f64, DVec3) {
    let axis = frustum.top - frustum.base;
    let along = (p - frustum.base).dot(axis) / axis.length_squared();
    let across = p - frustum.base - axis * along;
    (along, across.length(), across.normalize())
}

fn frustum_crossings(frustum: &Frustum, o: DVec3, d: DVec3) -> Vec<(f64, DVec3)> {
    let axis = frustum.top - frustum.base;
    let [r0, r1] = frustum.radii;
    let mut found = Vec::new();
    for (center, radius, normal) in [(frustum.base, r0, -axis), (frustum.top, r1, axis)] {
        let t = (center - o).dot(axis) / d.dot(axis);
        if frustum.is_capped && (o + d * t).distance(center) < radius {
            found.push((t, normal));
        }
    }
    // |across|² = radius², both linear in t.
    let part =
        |v: DVec3| (v.dot(axis) / axis.length_squared(), v - axis * (v.dot(axis) / axis.length_squared()));
    let ((h, x), (dh, dx)) = (part(o - frustum.base), part(d));
    let (r, dr) = (r0 + (r1 - r0) * h, (r1 - r0) * dh);
    let (a, b, c) = (dx.dot(dx) - dr * dr, 2.0 * (x.dot(dx) - r * dr), x.dot(x) - r * r);
    let discriminant = b * b - 4.0 * a * c;
    if discriminant > 0.0 {
        for root in [-discriminant.sqrt(), discriminant.sqrt()] {
            let t = (root - b) / (2.0 * a);
            let (along, _, out) = in_frustum(frustum, o + d * t);
            if (0.0..=1.0).contains(&along) {
                let slope = (r1 - r0) / axis.length();
                found.push((t, out - axis.normalize() * slope));
            }
        }
    }
    found
}

fn is_inside(primitive: &Primitive, outer: DAffine3, point: DVec3) -> bool {
    let to_world = to_world(primitive, outer);
    let p = to_world.inverse().transform_point3(point);
    match &primitive.shape {
        Shape::Sphere(sphere) => p.distance(sphere.center) < sphere.radius,
        Shape::Plane(plane) => plane.normal.dot(p) + plane.offset < 0.0,
        // Not a part of solids.
        Shape::Disc(_) | Shape::Clip(_) => false,
        Shape::Inverse(solid) => !is_inside(solid, to_world, point),
        Shape::Mesh(mesh) => solid_angle(mesh, p) > 2.0 * std::f64::consts::PI,
        Shape::Quadric(quadric) => quadric_value(quadric, p) < 0.0,
        Shape::Implicit(surface) => in_implicit(surface, p),
        Shape::Torus(torus) => from_torus(torus, p).0 < 0.0,
        Shape::Frustum(frustum) => {
            let (along, distance, _) = in_frustum(frustum, p);
            let radius = frustum.radii[0] + (frustum.radii[1] - frustum.radii[0]) * along;
            (0.0..1.0).contains(&along) && distance < radius
        }
        Shape::Cuboid(cuboid) => p.cmpgt(cuboid.min).all() && p.cmplt(cuboid.max).all(),
        Shape::Csg(csg) => {
            let [a, b] = csg.operands.each_ref().map(|operand| is_inside(operand, to_world, point));
            match csg.operation {
                CsgOperation::Union => a || b,
                CsgOperation::Intersection => a && b,
                CsgOperation::Difference => a && !b,
            }
        }
    }
}
