//! Warnings about a scene as a whole that is legal but surely meant otherwise.

use super::machine::Machine;
use super::origins::Origins;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::sources::STANDARD_BASE;
use crate::lint::MOST_PER_LINT;
use crate::lint::coincident::{self, Coincidence, Kind, Surface};
use glam::{DAffine3, DVec3};
use hray_core::{Camera, Description, Field, Light, MIN_DEPTH, Material, Primitive, Scene, Shape, Sphere};

/// So many lights are compared with the objects at most.
const MOST_LIGHTS: usize = 64;

/// So many parts are looked at: solids that share parts can have more than could ever be counted.
const MOST_PARTS: usize = 1 << 20;

/// Where the parts of a scene stand: its fields, or the scene where they are left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    pub(super) lights: Span,
    pub(super) camera: Span,
    pub(super) depth: Span,
    pub(super) objects: Span,
}

impl Machine<'_> {
    /// Warns of odd numbers in a material, where they matter; its shine and its index of refraction are at these places.
    pub(super) fn lint_material(&mut self, material: &Material, [shine, ior]: [Span; 2]) {
        let has_highlight = match &material.highlight {
            Some(highlight) => !highlight.is_zero(),
            None => !material.reflection.is_zero(),
        };
        if let (Field::Constant(exponent), true) = (&material.shine, has_highlight)
            && *exponent < 0.0
        {
            let message = format!("the exponent of the highlight is negative: {exponent}");
            let label = "the highlight is strongest where it should be none";
            self.warn(
                Diagnostic::warning("negative-shine", message, shine, label)
                    .with_help("10 is a broad and dull highlight, 200 a small and sharp one"),
            );
        }
        if let (Field::Constant(index), false) = (&material.refractive_index, material.transmission.is_zero())
            && *index <= 0.0
        {
            let message = format!("the material lets light through, but its index of refraction is {index}");
            self.warn(
                Diagnostic::warning("refraction-index", message, ior, "expected one above 0")
                    .with_help("1 does not bend light, water has 1.33, glass 1.5, diamond 2.42"),
            );
        }
    }

    /// Warns of what is odd about a scene.
    pub(super) fn lint(&mut self, description: &Description, origins: &Origins, places: Places) {
        let scene = &description.scene;
        if description.max_depth == MIN_DEPTH {
            let message = "the picture will be black";
            let label = "a depth of -1 traces no ray";
            self.warn(
                Diagnostic::warning("black-picture", message, places.depth, label)
                    .with_help("a depth of 0 shows all surfaces, but no reflections and refractions"),
            );
        }
        if scene.primitives.is_empty() {
            let message = "there are no objects, so only the background is seen";
            let error = Diagnostic::warning("no-objects", message, places.objects, "nothing is in the scene");
            self.warn(error.with_help("for example: objects = [ sphere {} ]"));
        }
        let glows = materials(scene).any(|material| material.glow.is_some());
        if scene.lights.is_empty() && !scene.primitives.is_empty() && !glows && !has_own_light(scene) {
            let message = "there are no lights, so all surfaces are black";
            self.warn(
                Diagnostic::warning("no-lights", message, places.lights, "expected at least one light").with_help(
                    "for example: lights = [ point { position = (3, 5, 4) }, ambient { intensity = 0.1 } ]",
                ),
            );
        }
        self.lint_what_is_shut_in(scene, places);
        self.lint_coincident_surfaces(scene, origins);
    }

    /// Warns of surfaces that lie in each other, once for the places that made them.
    fn lint_coincident_surfaces(&mut self, scene: &Scene, origins: &Origins) {
        let place = |surface: Surface| {
            let origin = match surface.part {
                Some(part) => origins.part(surface.object, part),
                None => origins.object(surface.object),
            };
            // What the library makes is made by who called it.
            origin.and_then(|origin| {
                let is_own = origin.span.start < STANDARD_BASE;
                if is_own { Some(origin.span) } else { origin.calls.first().copied() }
            })
        };
        let mut found: Vec<([Span; 2], Kind)> = Vec::new();
        coincident::check(scene, |Coincidence { surfaces, kind }| {
            if let [Some(first), Some(second)] = surfaces.map(place) {
                let both = ([first, second], kind);
                if !found.contains(&both) {
                    found.push(both);
                }
            }
            found.len() < MOST_PER_LINT
        });
        for ([first, second], kind) in found {
            let (message, label, help) = match kind {
                Kind::Objects => (
                    "two objects have surfaces in the same place, and rounding may decide which is seen",
                    "a part of its surface lies in that of another object",
                    "move one of them a little, or let one end inside the other",
                ),
                Kind::Skin => (
                    "two surfaces of a solid are in the same place, and rounding decides whether a skin is left between",
                    "a part of its surface lies in that of another part",
                    "let what is cut away reach a little beyond what it is cut from",
                ),
                Kind::Parts => (
                    "two surfaces of a solid are in the same place, and rounding may decide which is seen",
                    "a part of its surface lies in that of another part",
                    "move one of them a little, or let one end inside the other",
                ),
                Kind::Clip => (
                    "a surface lies in that of what it is clipped by, and rounding decides whether it is left",
                    "a part of its surface lies in that of the other",
                    "let the solid reach a little beyond, or end before",
                ),
            };
            let warning = Diagnostic::warning("coincident-surfaces", message, second, label).with_help(help);
            self.warn(if first == second {
                warning.with_note("both are made in this place")
            } else {
                warning.with_secondary(first, "the other")
            });
        }
    }

    /// Warns of lights and of a camera inside of spheres. A sphere around both is a room, and well meant.
    fn lint_what_is_shut_in(&mut self, scene: &Scene, places: Places) {
        let eye = match scene.camera {
            Camera::Perspective(camera) => camera.from,
            Camera::Orthographic(camera) => camera.from,
            // Rays start on the window, which is centred on the origin.
            Camera::Window(_) => DVec3::ZERO,
        };
        let lights: Vec<(usize, DVec3)> = scene
            .lights
            .iter()
            .enumerate()
            .filter_map(|(index, light)| match light {
                Light::Point { position, .. } | Light::Spot { position, .. } => Some((index, *position)),
                Light::Ambient { .. } | Light::Directional { .. } => None,
            })
            .take(MOST_LIGHTS)
            .collect();
        let is_ambient = scene.lights.iter().any(|light| matches!(light, Light::Ambient { .. }));
        let mut is_shut_in = vec![false; lights.len()];
        let mut is_dark = false;
        for primitive in &scene.primitives {
            let Some(inside) = Inside::new(primitive) else { continue };
            if !inside.holds(eye) {
                for (is_shut_in, (_, light)) in is_shut_in.iter_mut().zip(&lights) {
                    *is_shut_in |= inside.holds(*light);
                }
            } else if !is_ambient {
                let material = &primitive.material;
                let is_lit = material.glow.is_some() || lights.iter().any(|(_, light)| inside.holds(*light));
                is_dark |= material.transmission.is_zero() && !is_lit;
            }
        }
        for ((index, _), _) in lights.iter().zip(&is_shut_in).filter(|(_, is_shut_in)| **is_shut_in) {
            let message = format!("light {} of the scene is inside a sphere", index + 1);
            let label = "it reaches nothing outside of that sphere";
            self.warn(
                Diagnostic::warning("light-inside-sphere", message, places.lights, label)
                    .with_secondary(places.objects, "the sphere is one of these")
                    .with_note("transparent objects cast shadows like all others")
                    .with_help(
                        "for a lamp that can be seen, put the light beside the sphere, or give the sphere `glow`",
                    ),
            );
        }
        if is_dark && matches!(scene.camera, Camera::Perspective(_)) {
            let message = "the camera is inside a sphere, where no light is";
            let label = "the picture will be dark";
            self.warn(
                Diagnostic::warning("camera-inside-sphere", message, places.camera, label)
                    .with_secondary(places.objects, "the sphere is one of these")
                    .with_help("move the camera further away: `from` is where it is, in scene units"),
            );
        }
    }
}

/// Whether anything in the scene is not black without lights: a mirror shows the background.
fn has_own_light(scene: &Scene) -> bool {
    materials(scene).any(|material| !material.reflection.is_zero() || !material.transmission.is_zero())
}

/// The materials of objects, and of the parts of those that are made of others.
fn materials(scene: &Scene) -> impl Iterator<Item = &Material> {
    scene.primitives.iter().flat_map(Primitive::leaves).map(|leaf| &*leaf.material).take(MOST_PARTS)
}

/// The inside of a sphere, wherever it is placed.
struct Inside {
    sphere: Sphere,
    to_object: Option<DAffine3>,
}

impl Inside {
    fn new(primitive: &Primitive) -> Option<Self> {
        let Shape::Sphere(sphere) = primitive.shape else { return None };
        let to_object = primitive.transform.as_ref().map(|transform| transform.inverse());
        Some(Self { sphere, to_object })
    }

    fn holds(&self, point: DVec3) -> bool {
        let point = self.to_object.map_or(point, |to_object| to_object.transform_point3(point));
        point.distance_squared(self.sphere.center) < self.sphere.radius * self.sphere.radius
    }
}
