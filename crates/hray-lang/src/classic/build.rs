//! From the numbers and words of a sequence to the values they stand for.
//!
//! The order in which values are taken is the order of the grammar. Numbers that no picture can be made
//! with are errors here.

use super::parser::Parser;
use super::sections::Section;
use super::spans::Spans;
use super::values::Reader;
use crate::diagnostic::{Diagnostic, Span};
use hray_core::{
    Background, Camera, Description, Encoding, Integrator, Light, MAX_DEPTH, MIN_DEPTH, Material,
    NoiseTexture, Plane, Primitive, Resolution, Rgb, Scene, Shape, Sphere, Texture, WindowCamera,
};
use std::num::NonZeroU32;
use std::sync::Arc;

/// The parts of a description that stand so far.
#[derive(Debug, Default)]
pub(crate) struct Built {
    resolution: Option<Resolution>,
    depth: Option<i32>,
    camera: Option<WindowCamera>,
    background: Option<Rgb>,
    primitives: Vec<Primitive>,
    lights: Vec<Light>,
    spans: Spans,
}

impl Built {
    /// The whole, where every part stands.
    pub(crate) fn finish(self) -> (Option<Description>, Spans) {
        let description = || {
            Some(Description {
                resolution: self.resolution?,
                max_depth: self.depth?,
                samples: NonZeroU32::MIN,
                integrator: Integrator::Classic2005,
                encoding: Encoding::Raw,
                scene: Scene {
                    camera: Camera::Window(self.camera?),
                    background: Background::Uniform(self.background?),
                    primitives: self.primitives,
                    lights: self.lights,
                    time: 0.0,
                },
            })
        };
        (description(), self.spans)
    }
}

impl Parser<'_> {
    pub(crate) fn build_header(&mut self) {
        if !self.is_clean() {
            return;
        }
        let mut reader = self.values.reader();
        let ((width, width_span), (height, height_span)) = (reader.integer(), reader.integer());
        let (depth, depth_span) = reader.integer();
        let size_span = width_span.to(height_span);
        self.built.spans.resolution = size_span;
        self.built.spans.depth = depth_span;
        match Resolution::new(width, height) {
            Ok(resolution) => self.built.resolution = Some(resolution),
            Err(error) => {
                let label = "the resolution, width and height in pixels";
                self.report(Diagnostic::error("resolution", error.to_string(), size_span, label));
            }
        }
        match i32::try_from(depth) {
            Ok(depth) if (MIN_DEPTH..=MAX_DEPTH).contains(&depth) => self.built.depth = Some(depth),
            _ => self.report(depth_error(depth, depth_span)),
        }
    }

    pub(crate) fn build_camera(&mut self) {
        let mut reader = self.values.reader();
        let eye = reader.vector();
        let ((width, _), (height, _)) = (reader.integer(), reader.integer());
        self.built.camera = Some(WindowCamera { eye, window: [width as f64, height as f64] });
        self.built.spans.camera = self.section_start.to(self.cursor.last().span);
    }

    pub(crate) fn build_background(&mut self) {
        self.built.background = Some(self.values.reader().color());
        self.built.spans.background = self.section_start.to(self.cursor.last().span);
    }

    /// Notes where a list begins.
    pub(crate) fn note_list_start(&mut self, section: Section, span: Span) {
        match section {
            Section::Lights => self.built.spans.lights = span,
            _ => self.built.spans.objects = span,
        }
    }

    /// Builds the primitive that has just been read at `span`.
    pub(crate) fn build_primitive(&mut self, span: Span) {
        let mut errors = Vec::new();
        let mut reader = self.values.reader();
        let shape = shape(&mut reader);
        let material = material(&mut reader, &mut errors);
        for error in errors {
            self.report(error);
        }
        // Of a scene with errors nothing is rendered, so nothing more of it is kept.
        if self.is_clean() {
            // Neighbours are often made of the same.
            let material = match self.built.primitives.last() {
                Some(last) if *last.material == material => last.material.clone(),
                _ => Arc::new(material),
            };
            self.built.primitives.push(Primitive { shape, transform: None, material });
            self.built.spans.primitives.push(span);
        }
    }

    /// Builds the light that has just been read at `span`.
    pub(crate) fn build_light(&mut self, span: Span) {
        let built = light(&mut self.values.reader());
        if self.is_clean() {
            self.built.lights.push(built);
            self.built.spans.light_list.push(span);
        }
    }
}

fn depth_error(depth: i64, span: Span) -> Diagnostic {
    let message = format!("a recursion depth of {depth} is out of range");
    let label = format!("the depth lies between {MIN_DEPTH} and {MAX_DEPTH}");
    let error = Diagnostic::error("depth", message, span, label);
    if depth < i64::from(MIN_DEPTH) {
        error.with_note("the depth counts down to -1 at every reflection, so below -1 it would never end")
    } else {
        error.with_note("the depth says how many times a ray may be reflected or refracted")
    }
}

fn shape(reader: &mut Reader<'_>) -> Shape {
    match reader.form() {
        "sphere" => Shape::Sphere(Sphere { radius: reader.real(), center: reader.vector() }),
        _ => Shape::Plane(Plane { normal: reader.vector(), offset: reader.real() }),
    }
}

fn material(reader: &mut Reader<'_>, errors: &mut Vec<Diagnostic>) -> Material {
    let texture = match reader.form() {
        "solid" => Texture::Solid(reader.color()),
        _ => Texture::Noise(noise(reader, errors)),
    };
    Material {
        reflection: reader.real().into(),
        shine: (reader.integer().0 as f64).into(),
        transmission: reader.real().into(),
        refractive_index: reader.real().into(),
        ..Material::matte(texture)
    }
}

fn noise(reader: &mut Reader<'_>, errors: &mut Vec<Diagnostic>) -> NoiseTexture {
    match reader.form() {
        "perlinSolid" => NoiseTexture::Solid { base: reader.color(), grid: reader.real() },
        "perlinSemiTurb" => NoiseTexture::SemiTurbulence {
            base: reader.color(),
            octaves: octaves(reader, errors),
            grid: reader.real(),
        },
        "perlinTurb" => NoiseTexture::Turbulence {
            base: reader.color(),
            octaves: octaves(reader, errors),
            grid: reader.real(),
        },
        // The added colour comes first here ...
        "perlinFire" => NoiseTexture::Fire {
            added: reader.color(),
            base: reader.color(),
            octaves: octaves(reader, errors),
            grid: reader.real(),
        },
        "perlinPlasma" => NoiseTexture::Plasma { grid: reader.real() },
        "perlinMarble" => NoiseTexture::Marble {
            base: reader.color(),
            octaves: octaves(reader, errors),
            grid: reader.real(),
            direction: reader.vector(),
            power: reader.real(),
        },
        // ... and second here.
        "perlinMarbleBase" => NoiseTexture::MarbleBase {
            base: reader.color(),
            added: reader.color(),
            octaves: octaves(reader, errors),
            grid: reader.real(),
            direction: reader.vector(),
            power: reader.real(),
        },
        _ => NoiseTexture::Wood {
            base: reader.color(),
            octaves: octaves(reader, errors),
            grid: reader.real(),
            rings: reader.real(),
            power: reader.real(),
        },
    }
}

fn octaves(reader: &mut Reader<'_>, errors: &mut Vec<Diagnostic>) -> u32 {
    let (count, span) = reader.integer();
    u32::try_from(count).unwrap_or_else(|_| {
        let message = format!("{count} octaves of noise are impossible");
        let label = format!("the number of octaves lies between 0 and {}", u32::MAX);
        let error = Diagnostic::error("octaves", message, span, label);
        errors.push(if count < 0 {
            error.with_note("the octaves are counted down to 0, so below 0 it would never end")
        } else {
            error.with_note(
                "each octave is half as strong as the one before; more than thirty change no pixel",
            )
        });
        0
    })
}

fn light(reader: &mut Reader<'_>) -> Light {
    match reader.form() {
        "pointLight" => Light::Point { position: reader.vector(), intensity: reader.color() },
        _ => Light::Ambient { intensity: reader.color() },
    }
}
