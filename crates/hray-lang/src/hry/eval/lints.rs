//! Warnings about a scene as a whole that is legal but surely meant otherwise.

use super::machine::Machine;
use crate::diagnostic::{Diagnostic, Span};
use glam::DVec3;
use hray_core::{Camera, Description, Field, Light, MIN_DEPTH, Material, Primitive, Scene, Shape};

/// So many lights and objects are compared with each other at most.
const MOST_LIGHTS: usize = 64;

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
    pub(super) fn lint(&mut self, description: &Description, places: Places) {
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
        let glows = scene.primitives.iter().any(|primitive| primitive.material.glow.is_some());
        if scene.lights.is_empty() && !scene.primitives.is_empty() && !glows && !has_own_light(scene) {
            let message = "there are no lights, so all surfaces are black";
            self.warn(
                Diagnostic::warning("no-lights", message, places.lights, "expected at least one light").with_help(
                    "for example: lights = [ point { position = (3, 5, 4) }, ambient { intensity = 0.1 } ]",
                ),
            );
        }
        let eye = match scene.camera {
            Camera::Perspective(camera) => Some(camera.from),
            Camera::Window(_) | Camera::Orthographic(_) => None,
        };
        for (number, light) in scene.lights.iter().enumerate().take(MOST_LIGHTS) {
            let (Light::Point { position, .. } | Light::Spot { position, .. }) = *light else { continue };
            let shuts_in = |primitive: &Primitive| {
                holds(primitive, position) && eye.is_none_or(|eye| !holds(primitive, eye))
            };
            if scene.primitives.iter().any(shuts_in) {
                let message = format!("light {} of the scene is inside a sphere", number + 1);
                let label = "it reaches nothing outside of that sphere";
                self.warn(
                    Diagnostic::warning("light-inside-sphere", message, places.lights, label)
                        .with_secondary(places.objects, "the sphere is one of these")
                        .with_note("transparent objects cast shadows like all others")
                        .with_help("for a lamp that can be seen, put the light beside the sphere, or give the sphere `glow`"),
                );
            }
        }
        let Some(eye) = eye else { return };
        let is_lit = |primitive: &Primitive| {
            scene.lights.iter().any(|light| match light {
                Light::Point { position, .. } | Light::Spot { position, .. } => holds(primitive, *position),
                Light::Ambient { .. } => true,
                Light::Directional { .. } => false,
            })
        };
        let shuts_in = |primitive: &Primitive| {
            holds(primitive, eye)
                && primitive.material.transmission.is_zero()
                && primitive.material.glow.is_none()
                && !is_lit(primitive)
        };
        if scene.primitives.iter().any(shuts_in) {
            let message = "the camera is inside a sphere, where no light is";
            self.warn(
                Diagnostic::warning(
                    "camera-inside-sphere",
                    message,
                    places.camera,
                    "the picture will be dark",
                )
                .with_secondary(places.objects, "the sphere is one of these")
                .with_help("move the camera further away: `from` is where it is, in scene units"),
            );
        }
    }
}

/// Whether anything in the scene is not black without lights: a mirror shows the background.
fn has_own_light(scene: &Scene) -> bool {
    scene.primitives.iter().any(|primitive| {
        !primitive.material.reflection.is_zero() || !primitive.material.transmission.is_zero()
    })
}

/// Whether a point is inside a sphere.
fn holds(primitive: &Primitive, point: DVec3) -> bool {
    let Shape::Sphere(sphere) = primitive.shape else { return false };
    let inside = match &primitive.transform {
        Some(transform) => transform.inverse().transform_point3(point),
        None => point,
    };
    inside.distance_squared(sphere.center) < sphere.radius * sphere.radius
}
