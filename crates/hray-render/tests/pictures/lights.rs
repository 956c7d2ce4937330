//! How much light arrives.

use crate::common::{colors, cuboid, description, gray, matte, middle, mirror, of, plane, sphere, v};
use hray_core::{DVec3, Field, Integrator, Light, Material, Rgb, Shape, Texture};
use std::f64::consts::PI;
use std::sync::Arc;

/// A wall at z = 0 that faces the camera.
fn wall() -> Shape {
    plane(DVec3::Z, 0.0)
}

fn close(color: Rgb, level: f64) {
    let [r, g, b] = color.to_array();
    assert!([r, g, b].iter().all(|c| (c - level).abs() < 1e-12), "{color:?} instead of {level}");
}

/// cos 60° of the light arrives on a wall that it strikes at 60° from the normal.
#[test]
fn a_directional_light_shines_by_the_cosine() {
    for degrees in [0.0, 30.0f64, 60.0, 89.0] {
        let angle = degrees.to_radians();
        let direction = v(libm::sin(angle), 0.0, -libm::cos(angle));
        let light = Light::Directional { direction, intensity: gray(0.8) };
        close(middle(vec![of(wall(), &matte(0.5))], vec![light]), 0.4 * libm::cos(angle));
    }
    let behind = Light::Directional { direction: DVec3::Z, intensity: gray(0.8) };
    close(middle(vec![of(wall(), &matte(0.5))], vec![behind]), 0.0);
}

/// Nothing is too far away to cast a shadow from infinity.
#[test]
fn a_directional_light_has_unbounded_shadows() {
    let light = Light::Directional { direction: v(-0.6, 0.0, -0.8), intensity: gray(1.0) };
    let away = |distance: f64| of(sphere(v(0.6, 0.0, 0.8) * distance, 1.0), &matte(1.0));
    for distance in [10.0, 1e3, 1e9] {
        close(middle(vec![of(wall(), &matte(1.0)), away(distance)], vec![light]), 0.0);
    }
    close(middle(vec![of(wall(), &matte(1.0)), away(-10.0)], vec![light]), 0.8);
}

#[test]
fn a_point_light_shines_by_the_cosine_without_loss() {
    for distance in [1.0, 100.0, 1e6] {
        let light = Light::Point { position: v(0.6, 0.0, 0.8) * distance, intensity: gray(1.0) };
        close(middle(vec![of(wall(), &matte(0.5))], vec![light]), 0.4);
    }
}

/// Full inside the inner cone, none outside the outer one, and half where the cosine is halfway.
#[test]
fn a_spot_light_falls_off_between_its_cones() {
    let seen = |off: f64| {
        let (cos_inner, cos_outer) = (libm::cos(PI / 12.0), libm::cos(PI / 6.0));
        let axis = v(libm::sin(off), 0.0, -libm::cos(off));
        let spot =
            Light::Spot { position: v(0.0, 0.0, 3.0), axis, cos_inner, cos_outer, intensity: gray(1.0) };
        middle(vec![of(wall(), &matte(1.0))], vec![spot])
    };
    close(seen(0.0), 1.0);
    close(seen(PI / 12.0 - 0.001), 1.0);
    close(seen(PI / 6.0 + 0.001), 0.0);
    let halfway = libm::acos((libm::cos(PI / 12.0) + libm::cos(PI / 6.0)) / 2.0);
    close(seen(halfway), 0.5);
}

#[test]
fn a_spot_light_may_have_a_sharp_edge() {
    let seen = |off: f64| {
        let axis = v(libm::sin(off), 0.0, -libm::cos(off));
        let cosine = libm::cos(0.3);
        let position = v(0.0, 0.0, 3.0);
        let spot = Light::Spot { position, axis, cos_inner: cosine, cos_outer: cosine, intensity: gray(1.0) };
        middle(vec![of(wall(), &matte(1.0))], vec![spot])
    };
    close(seen(0.299), 1.0);
    close(seen(0.301), 0.0);
}

/// Ambient light is coloured by the surface, but in 2005 it was not.
#[test]
fn ambient_light() {
    let mut description =
        description(1, vec![of(wall(), &matte(0.5))], vec![Light::Ambient { intensity: gray(0.3) }]);
    close(colors(&description)[0], 0.15);
    description.integrator = Integrator::Classic2005;
    close(colors(&description)[0], 0.3);
}

/// In a white box that is lit by ambient light alone every point is as bright as the light.
#[test]
fn a_furnace() {
    let room = of(cuboid(v(-5.0, -5.0, -5.0), v(5.0, 5.0, 5.0)), &matte(1.0));
    let ball = of(sphere(DVec3::ZERO, 1.0), &mirror());
    // The mirror adds what it sees to what it is: here black, but for the ambient light of its own colour.
    let description = description(16, vec![room, ball], vec![Light::Ambient { intensity: gray(0.7) }]);
    for color in colors(&description) {
        close(color, 0.7);
    }
}

/// A surface is lit from the side it is seen from.
#[test]
fn surfaces_have_two_sides() {
    let light = |z| Light::Point { position: v(0.0, 0.0, z), intensity: gray(1.0) };
    for normal in [DVec3::Z, DVec3::NEG_Z] {
        close(middle(vec![of(plane(normal, 0.0), &matte(0.5))], vec![light(3.0)]), 0.5);
        close(middle(vec![of(plane(normal, 0.0), &matte(0.5))], vec![light(-3.0)]), 0.0);
    }
}

/// The highlight is as strong as asked for, or else as the reflection; where no light falls there is none.
#[test]
fn highlights() {
    let shiny = |reflection: f64, highlight: Option<f64>| {
        Arc::new(Material {
            reflection: reflection.into(),
            highlight: highlight.map(Field::Constant),
            shine: 12.5.into(),
            ..Material::matte(Texture::Solid(Rgb::BLACK))
        })
    };
    let seen = |material: &Arc<Material>, direction: DVec3| {
        let light = Light::Directional { direction, intensity: gray(0.5) };
        let mut description = description(1, vec![of(wall(), material)], vec![light]);
        description.max_depth = 0;
        colors(&description)[0]
    };
    close(seen(&shiny(0.4, None), DVec3::NEG_Z), 0.2);
    close(seen(&shiny(0.4, Some(0.1)), DVec3::NEG_Z), 0.05);
    close(seen(&shiny(0.0, Some(0.1)), DVec3::NEG_Z), 0.05);
    let angle = PI / 6.0;
    let aslant = v(libm::sin(angle), 0.0, -libm::cos(angle));
    close(seen(&shiny(1.0, None), aslant), 0.5 * libm::pow(libm::cos(angle / 2.0), 12.5));
    close(seen(&shiny(1.0, None), DVec3::Z), 0.0);
}

#[test]
fn what_glows_does_so_in_the_dark() {
    let glow = Some(Texture::Solid(Rgb::new(0.25, 0.5, 0.75)));
    let lamp = Arc::new(Material { glow, ..Material::matte(Texture::Solid(Rgb::BLACK)) });
    for integrator in [Integrator::Classic, Integrator::Classic2005] {
        let mut description = description(1, vec![of(wall(), &lamp)], Vec::new());
        description.integrator = integrator;
        assert_eq!(colors(&description)[0], Rgb::new(0.25, 0.5, 0.75));
    }
}
