//! Lints about objects that cannot be seen, and lights that reach nothing.
//!
//! Rays start at the window. What they cannot reach, directly or by way of mirrors and glass, and what
//! casts no shadow, can be left out of the scene without changing a pixel. Where that is nearly so but for
//! rounding, nothing is said: there are margins.

use super::sink::Sink;
use crate::classic::Spans;
use crate::diagnostic::Span;
use glam::DVec3;
use hray_core::{Camera, Light, Plane, Primitive, Scene, Shape, Sphere};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

/// Objects are compared with so many of the largest opaque spheres, opaque planes and lights at most.
pub const MOST_CANDIDATES: usize = 64;

/// A normal shorter than this is that of no plane: the thesis' bound for parallel planes.
const SHORTEST_NORMAL: f64 = 1e-9;
/// Rays nearly parallel to a plane miss it (by that same bound), the more of them the shorter its normal. A
/// plane with a shorter normal than this is not taken to hide anything.
const SHORTEST_HIDING_NORMAL: f64 = 1e-2;
/// Larger coordinates and radii are not compared: their squares lose too much.
const LARGEST: f64 = 1e8;

pub(super) fn check(sink: &mut Sink<'_>, scene: &Scene, spans: &Spans) {
    let Camera::Window(camera) = scene.camera else { return };
    let lights = point_lights(scene);
    let window = Window::new(camera.window);
    check_normals(sink, scene, spans);
    check_duplicates(sink, &scene.primitives, spans);
    check_lights(sink, scene, spans, &window);
    let spheres = hiding_spheres(&scene.primitives, &window, &lights);
    let planes = hiding_planes(&scene.primitives, &window, &lights);
    for (index, primitive) in scene.primitives.iter().enumerate() {
        let Shape::Sphere(inner) = primitive.shape else { continue };
        if !is_sane(&inner) {
            continue;
        }
        if let Some((outer, _)) =
            spheres.iter().find(|(other, outer)| *other != index && holds(outer, &inner))
        {
            report_hidden(sink, "object-inside-object", spans, [index, *outer]);
        } else if let Some((plane, _)) = planes.iter().find(|(_, side)| side.is_beyond(&inner)) {
            report_hidden(sink, "object-behind-plane", spans, [index, *plane]);
        }
    }
}

fn report_hidden(sink: &mut Sink<'_>, code: &'static str, spans: &Spans, [hidden, hiding]: [usize; 2]) {
    sink.report(code, |words| {
        let place = |index| spans.primitives.get(index).map_or_else(Span::default, |span| words.shape(*span));
        let (label, other) = if code == "object-behind-plane" {
            (
                "it lies wholly behind a plane that lets no light through",
                "behind this plane, seen from the window",
            )
        } else {
            ("it lies wholly inside a sphere that lets no light through", "inside this sphere")
        };
        words.warning("this sphere cannot be seen", place(hidden), label).with_secondary(place(hiding), other)
    });
}

/// The window of the camera, a rectangle in the plane z = 0.
struct Window {
    half: [f64; 2],
}

impl Window {
    fn new([width, height]: [f64; 2]) -> Self {
        Self { half: [(width / 2.0).abs(), (height / 2.0).abs()] }
    }

    /// The distance of a point from the rectangle.
    fn distance(&self, point: DVec3) -> f64 {
        let [x, y] = self.half;
        point.distance(DVec3::new(point.x.clamp(-x, x), point.y.clamp(-y, y), 0.0))
    }

    fn corners(&self) -> [DVec3; 4] {
        let [x, y] = self.half;
        [[x, y], [-x, y], [x, -y], [-x, -y]].map(|[x, y]| DVec3::new(x, y, 0.0))
    }
}

fn point_lights(scene: &Scene) -> Vec<DVec3> {
    let position = |light: &Light| match light {
        Light::Point { position, .. } => Some(*position),
        Light::Ambient { .. } | Light::Directional { .. } | Light::Spot { .. } => None,
    };
    scene.lights.iter().filter_map(position).collect()
}

/// Whether the numbers of a sphere can be reckoned with.
fn is_sane(sphere: &Sphere) -> bool {
    let radius = sphere.radius.abs();
    radius > 0.0 && radius < LARGEST && sphere.center.abs().max_element() < LARGEST
}

/// How near two surfaces may come before rounding counts.
fn margin(sphere: &Sphere) -> f64 {
    1e-5 + 1e-6 * (sphere.radius.abs() + sphere.center.abs().max_element())
}

/// The shapes that let no light through, or those that let some through.
fn shapes(primitives: &[Primitive], opaque: bool) -> impl Iterator<Item = (usize, &Shape)> {
    let wanted = move |primitive: &Primitive| primitive.material.transmission.is_zero() == opaque;
    let numbered = primitives.iter().enumerate();
    numbered
        .filter(move |(_, primitive)| wanted(primitive))
        .map(|(index, primitive)| (index, &primitive.shape))
}

/// The largest opaque spheres that have the window outside, and no light inside. Where a transparent one lies
/// in the same place, that may be the one that is seen.
fn hiding_spheres(primitives: &[Primitive], window: &Window, lights: &[DVec3]) -> Vec<(usize, Sphere)> {
    let sphere = |(index, shape): (usize, &Shape)| match shape {
        Shape::Sphere(sphere) if is_sane(sphere) => Some((index, *sphere)),
        _ => None,
    };
    let mut largest: Vec<(usize, Sphere)> = shapes(primitives, true).filter_map(sphere).collect();
    if largest.len() > MOST_CANDIDATES {
        let by_size =
            |a: &(usize, Sphere), b: &(usize, Sphere)| b.1.radius.abs().total_cmp(&a.1.radius.abs());
        largest.select_nth_unstable_by(MOST_CANDIDATES, by_size);
        largest.truncate(MOST_CANDIDATES);
    }
    largest.retain(|(_, sphere)| {
        let reach = sphere.radius.abs() + margin(sphere);
        let outside = |light: &DVec3| light.distance(sphere.center) > reach;
        window.distance(sphere.center) > reach && lights.iter().all(outside)
    });
    for (_, other) in shapes(primitives, false).filter_map(sphere) {
        largest.retain(|(_, sphere)| {
            let apart =
                sphere.center.distance(other.center) + (sphere.radius.abs() - other.radius.abs()).abs();
            apart > margin(sphere)
        });
    }
    largest.sort_by_key(|(index, _)| *index);
    largest
}

/// Whether the inner sphere lies inside the outer one.
fn holds(outer: &Sphere, inner: &Sphere) -> bool {
    let depth = inner.center.distance(outer.center) + inner.radius.abs();
    depth + margin(outer) < outer.radius.abs()
}

/// The side of a plane that the window and all lights are on.
struct Side {
    /// Unit normal that points to that side.
    normal: DVec3,
    offset: f64,
}

impl Side {
    /// The side of an opaque plane that has the window and all lights on it, if one has.
    fn new(plane: &Plane, window: &Window, lights: &[DVec3]) -> Option<Self> {
        let length = plane.normal.length();
        if !(SHORTEST_HIDING_NORMAL..LARGEST).contains(&length) {
            return None;
        }
        let positive = Self { normal: plane.normal / length, offset: plane.offset / length };
        let negative = Self { normal: -positive.normal, offset: -positive.offset };
        [positive, negative].into_iter().find(|side| {
            let is_near = |point: &DVec3| side.distance(*point) > 1e-3;
            window.corners().iter().all(is_near) && lights.iter().all(is_near)
        })
    }

    /// How far a point is on this side.
    fn distance(&self, point: DVec3) -> f64 {
        self.normal.dot(point) + self.offset
    }

    /// Whether a sphere is wholly on the other side.
    fn is_beyond(&self, sphere: &Sphere) -> bool {
        self.distance(sphere.center) < -(sphere.radius.abs() + 1e-3 + margin(sphere))
    }
}

/// The opaque planes that have the window and all lights on one side, but for those in the place of which a
/// transparent one may be seen.
fn hiding_planes(primitives: &[Primitive], window: &Window, lights: &[DVec3]) -> Vec<(usize, Side)> {
    let side = |(index, shape): (usize, &Shape)| match shape {
        Shape::Plane(plane) => Some((index, Side::new(plane, window, lights)?)),
        _ => None,
    };
    let mut planes: Vec<(usize, Side)> =
        shapes(primitives, true).filter_map(side).take(MOST_CANDIDATES).collect();
    // Both turn the same side to the window, so the same plane has the same normal.
    for (_, other) in shapes(primitives, false).filter_map(side) {
        planes.retain(|(_, side)| {
            side.normal.distance(other.normal) > 1e-6 || (side.offset - other.offset).abs() > 1e-3
        });
    }
    planes
}

fn check_normals(sink: &mut Sink<'_>, scene: &Scene, spans: &Spans) {
    for (primitive, span) in scene.primitives.iter().zip(&spans.primitives) {
        if let Shape::Plane(plane) = primitive.shape
            && plane.normal.length() < SHORTEST_NORMAL
        {
            sink.report("plane-normal", |words| {
                let label = "the first three numbers are the normal; one of them must not be 0";
                words.warning("no ray can hit this plane", words.numbers(*span, 0, 3), label)
            });
        }
    }
}

/// Looks for shapes that are written again further on, bit for bit.
fn check_duplicates(sink: &mut Sink<'_>, primitives: &[Primitive], spans: &Spans) {
    let mut later: HashMap<u64, usize> = HashMap::with_capacity(primitives.len());
    let mut found = Vec::new();
    for (index, primitive) in primitives.iter().enumerate().rev() {
        let Some(bits) = shape_bits(&primitive.shape) else { continue };
        let mut hasher = DefaultHasher::new();
        bits.hash(&mut hasher);
        let other = *later.entry(hasher.finish()).or_insert(index);
        if other != index && primitives.get(other).is_some_and(|other| shape_bits(&other.shape) == Some(bits))
        {
            found.push([index, other]);
        }
    }
    for [index, other] in found.into_iter().rev() {
        sink.report("duplicate-object", |words| {
            let place = |index: usize| {
                spans.primitives.get(index).map_or_else(Span::default, |span| words.shape(*span))
            };
            words
                .warning("this object cannot be seen", place(index), "a later object has exactly this shape")
                .with_secondary(place(other), "of two in the same place this one is seen")
        });
    }
}

fn shape_bits(shape: &Shape) -> Option<(bool, [u64; 4])> {
    let (is_sphere, vector, number) = match shape {
        Shape::Sphere(sphere) => (true, sphere.center, sphere.radius),
        Shape::Plane(plane) => (false, plane.normal, plane.offset),
        _ => return None,
    };
    Some((is_sphere, [vector.x, vector.y, vector.z, number].map(f64::to_bits)))
}

/// Looks for point lights inside spheres that the window is not inside of as well.
fn check_lights(sink: &mut Sink<'_>, scene: &Scene, spans: &Spans, window: &Window) {
    let lights = scene.lights.iter().enumerate().filter_map(|(index, light)| match light {
        Light::Point { position, .. } => Some((index, *position)),
        Light::Ambient { .. } | Light::Directional { .. } | Light::Spot { .. } => None,
    });
    for (index, position) in lights.take(MOST_CANDIDATES) {
        let around = scene.primitives.iter().position(|primitive| match &primitive.shape {
            Shape::Sphere(sphere) => is_sane(sphere) && shuts_in(sphere, position, window),
            _ => false,
        });
        let Some(around) = around else { continue };
        sink.report("light-inside-sphere", |words| {
            let span =
                spans.light_list.get(index).map_or_else(Span::default, |span| words.numbers(*span, 0, 3));
            let sphere = spans.primitives.get(around).map_or_else(Span::default, |span| words.shape(*span));
            words
                .warning("this light is inside a sphere", span, "it reaches nothing outside that sphere")
                .with_secondary(sphere, "inside this sphere")
                .with_note("transparent objects cast shadows like all others")
        });
    }
}

/// Whether a sphere holds a light, but not the window as well (a room is a sphere around everything).
fn shuts_in(sphere: &Sphere, light: DVec3, window: &Window) -> bool {
    let radius = sphere.radius.abs();
    let inside = |point: DVec3| point.distance(sphere.center) < radius;
    inside(light) && !window.corners().into_iter().all(inside)
}
