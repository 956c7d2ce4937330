//! Lints about the numbers of one object or light, each for itself.

use super::sink::Sink;
use crate::classic::Spans;
use crate::diagnostic::Span;
use hray_core::{Background, Field, Light, Material, NoiseTexture, Primitive, Rgb, Scene, Shape, Texture};

/// More octaves than this are too many.
const MOST_OCTAVES: u32 = 30;
/// Both shapes are written as four numbers; those of the texture follow.
const SHAPE_NUMBERS: usize = 4;

pub(super) fn check(sink: &mut Sink<'_>, scene: &Scene, spans: &Spans) {
    if let Background::Uniform(background) = scene.background {
        check_color(sink, spans.background, 0, "the background colour", background);
    }
    for (primitive, span) in scene.primitives.iter().zip(&spans.primitives) {
        check_primitive(sink, primitive, *span);
    }
    for (light, span) in scene.lights.iter().zip(&spans.light_list) {
        let (first, intensity) = match light {
            Light::Point { intensity, .. } => (3, *intensity),
            Light::Ambient { intensity } => (0, *intensity),
            Light::Directional { .. } | Light::Spot { .. } => continue,
        };
        check_color(sink, *span, first, "the light's intensity", intensity);
    }
}

fn check_primitive(sink: &mut Sink<'_>, primitive: &Primitive, span: Span) {
    if let Shape::Sphere(sphere) = primitive.shape
        && sphere.radius <= 0.0
    {
        sink.report("sphere-radius", |words| {
            let place = words.numbers(span, 0, 1);
            let radius = words.text(place);
            if sphere.radius == 0.0 {
                words.warning("a sphere of radius 0 is only a point", place, "expected a radius above 0")
            } else {
                let message = format!("the sphere has the negative radius {radius}");
                let label = "its normals point inward: it is lit from inside";
                words.warning(message, place, label)
            }
        });
    }
    let first = SHAPE_NUMBERS;
    let next = match &primitive.material.texture {
        Texture::Solid(color) => {
            check_color(sink, span, first, "the solid colour", *color);
            first + 3
        }
        Texture::Noise(noise) => check_noise(sink, span, first, noise),
        Texture::Function(_) => return,
    };
    check_coefficients(sink, span, next, &primitive.material);
}

/// Checks a noise whose numbers start at `first`; gives the number after them.
fn check_noise(sink: &mut Sink<'_>, span: Span, first: usize, noise: &NoiseTexture) -> usize {
    let mut next = first;
    let mut color = |name, color| {
        check_color(sink, span, next, name, color);
        next += 3;
    };
    // The colours come first, then the octaves, then the grid, then what only some have.
    let (octaves, grid, others) = match *noise {
        NoiseTexture::Plasma { grid } => (None, grid, 0),
        NoiseTexture::Solid { base, grid } => {
            color("the base colour", base);
            (None, grid, 0)
        }
        NoiseTexture::SemiTurbulence { base, octaves, grid }
        | NoiseTexture::Turbulence { base, octaves, grid } => {
            color("the base colour", base);
            (Some(octaves), grid, 0)
        }
        NoiseTexture::Fire { added, base, octaves, grid } => {
            color("the added colour", added);
            color("the base colour", base);
            (Some(octaves), grid, 0)
        }
        NoiseTexture::Marble { base, octaves, grid, .. } => {
            color("the base colour", base);
            (Some(octaves), grid, 4)
        }
        NoiseTexture::MarbleBase { base, added, octaves, grid, .. } => {
            color("the base colour", base);
            color("the added colour", added);
            (Some(octaves), grid, 4)
        }
        NoiseTexture::Wood { base, octaves, grid, .. } => {
            color("the base colour", base);
            (Some(octaves), grid, 2)
        }
    };
    if let Some(octaves) = octaves {
        check_octaves(sink, span, next, octaves);
        next += 1;
    }
    if grid == 0.0 {
        sink.report("noise-grid", |words| {
            let label = "the size of a noise cell; expected a number above 0";
            words.warning(
                "the noise grid is 0, by which positions are divided",
                words.numbers(span, next, 1),
                label,
            )
        });
    }
    next + 1 + others
}

fn check_octaves(sink: &mut Sink<'_>, span: Span, index: usize, octaves: u32) {
    if octaves > MOST_OCTAVES {
        sink.report("many-octaves", |words| {
            let place = words.numbers(span, index, 1);
            let message = format!("{octaves} octaves of noise cost time and show no more than 10");
            let label = "each octave is half as strong as the one before";
            words.warning(message, place, label).with_suggestion(place, "10", "10 octaves look the same")
        });
    }
}

/// Checks the four numbers at the end of a texture, which start at `first`.
fn check_coefficients(sink: &mut Sink<'_>, span: Span, first: usize, material: &Material) {
    let Material { reflection, shine, transmission, refractive_index, .. } = material;
    let [Some(reflection), Some(shine), Some(transmission), Some(refractive_index)] =
        [reflection, shine, transmission, refractive_index].map(Field::constant)
    else {
        return;
    };
    check_number(sink, span, first, "the reflection coefficient", reflection);
    check_number(sink, span, first + 2, "the transparency coefficient", transmission);
    if shine < 0.0 {
        sink.report("negative-shine", |words| {
            let message = format!("the highlight exponent is {shine}");
            let label = "expected 0 or more: the larger, the smaller and sharper the highlight";
            words.warning(message, words.numbers(span, first + 1, 1), label)
        });
    }
    if transmission != 0.0 && refractive_index <= 0.0 {
        sink.report("refraction-index", |words| {
            let place = words.numbers(span, first + 3, 1);
            let index = words.text(place);
            let message = format!("the material lets light through, but its refraction index is {index}");
            words
                .warning(message, place, "expected a refraction index above 0")
                .with_secondary(words.numbers(span, first + 2, 1), "it is transparent by this much")
                .with_help("1.0 does not bend the light, water has about 1.33, glass 1.5")
        });
    }
}

fn check_color(sink: &mut Sink<'_>, element: Span, first: usize, what: &str, color: Rgb) {
    let names = ["red", "green", "blue"];
    for (offset, (component, name)) in color.to_array().into_iter().zip(names).enumerate() {
        if !(0.0..=1.0).contains(&component) {
            report_range(sink, element, first + offset, || format!("the {name} of {what}"));
        }
    }
}

fn check_number(sink: &mut Sink<'_>, element: Span, index: usize, what: &str, number: f64) {
    if !(0.0..=1.0).contains(&number) {
        report_range(sink, element, index, || what.into());
    }
}

fn report_range(sink: &mut Sink<'_>, element: Span, index: usize, what: impl FnOnce() -> String) {
    sink.report("component-range", |words| {
        let place = words.numbers(element, index, 1);
        let message = format!("{} is {}", what(), words.text(place));
        words.warning(message, place, "expected a number from 0.0 to 1.0")
    });
}
