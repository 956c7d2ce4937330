//! Scenes back to text.

use glam::DVec3;
use hray_core::{
    Background, Camera, Description, Encoding, Field, Integrator, Light, Material, NoiseTexture, Primitive,
    Rgb, Scene, Shape, Texture,
};
use std::fmt;
use std::num::NonZeroU32;

/// A description in the classic scene language, where that can say it. [`parse`](super::parse) reads it back to
/// the same bits.
///
/// The language knows spheres and planes in world space, point and ambient lights, the window camera, the noise
/// textures of 2005 and its own integrator, and it has no notation for infinity and NaN: a description with
/// anything else gives none.
#[must_use]
pub fn write(description: &Description) -> Option<String> {
    let mut text = String::new();
    // Writing to a string cannot fail, so an error means that there is no notation for something.
    write_to(&mut text, description).ok().map(|()| text)
}

/// What there is no notation for.
const CANNOT_SAY: fmt::Error = fmt::Error;

fn write_to(out: &mut impl fmt::Write, description: &Description) -> fmt::Result {
    let Description { resolution, max_depth, samples, integrator, encoding, scene } = description;
    let Scene { camera, background, primitives, lights, time } = scene;
    let as_in_2005 = (integrator, encoding) == (&Integrator::Classic2005, &Encoding::Raw);
    let (Camera::Window(camera), Background::Uniform(background)) = (camera, background) else {
        return Err(CANNOT_SAY);
    };
    if !as_in_2005 || *samples != NonZeroU32::MIN || *time != 0.0 {
        return Err(CANNOT_SAY);
    }
    writeln!(
        out,
        "renderDescr ( resolution ({},{}) ) {max_depth} [",
        resolution.width(),
        resolution.height()
    )?;
    let [width, height] = camera.window;
    let (eye, width, height) = (Vector(camera.eye), whole(width)?, whole(height)?);
    writeln!(out, "scene {{ camera {eye} ({width},{height}) }}")?;
    writeln!(out, "      {{ background {} }}", Color(*background))?;
    write!(out, "      {{ objects")?;
    for primitive in primitives {
        write_primitive(out, primitive)?;
    }
    write!(out, " }}\n      {{ lights")?;
    for light in lights {
        match light {
            Light::Point { position, intensity } => {
                write!(out, "\n        (pointLight {} {})", Vector(*position), Color(*intensity))?;
            }
            Light::Ambient { intensity } => write!(out, "\n        (ambientLight {})", Color(*intensity))?,
            Light::Directional { .. } | Light::Spot { .. } => return Err(CANNOT_SAY),
        }
    }
    writeln!(out, " }} ]")
}

/// A whole number as the grammar takes it.
fn whole(number: f64) -> Result<i64, fmt::Error> {
    const LIMIT: f64 = (1u64 << 63) as f64;
    let fits = number.fract() == 0.0 && (-LIMIT..=LIMIT).contains(&number);
    // The conversion saturates; 2^63 - 1 is read back as 2^63.
    if fits { Ok(number as i64) } else { Err(CANNOT_SAY) }
}

/// A coefficient that is the same everywhere.
fn constant(field: &Field) -> Result<f64, fmt::Error> {
    field.constant().ok_or(CANNOT_SAY)
}

fn write_primitive(out: &mut impl fmt::Write, primitive: &Primitive) -> fmt::Result {
    let Primitive { shape, transform, material } = primitive;
    let Material { texture, reflection, shine, transmission, refractive_index, highlight, glow, bump } =
        &**material;
    if transform.is_some() || highlight.is_some() || glow.is_some() || bump.is_some() {
        return Err(CANNOT_SAY);
    }
    write!(out, "\n        (object ( ")?;
    match shape {
        Shape::Sphere(sphere) => write!(out, "sphere {} {}", Real(sphere.radius), Vector(sphere.center))?,
        Shape::Plane(plane) => {
            let DVec3 { x, y, z } = plane.normal;
            write!(out, "plane ({},{},{},{})", Real(x), Real(y), Real(z), Real(plane.offset))?;
        }
        Shape::Cuboid(_)
        | Shape::Frustum(_)
        | Shape::Disc(_)
        | Shape::Torus(_)
        | Shape::Quadric(_)
        | Shape::Implicit(_)
        | Shape::Csg(_)
        | Shape::Inverse(_)
        | Shape::Clip(_)
        | Shape::Mesh(_) => return Err(CANNOT_SAY),
    }
    write!(out, " ) ( texture ( diff ")?;
    match texture {
        Texture::Solid(color) => write!(out, "solid {}", Color(*color))?,
        Texture::Noise(noise) => {
            write!(out, "perlin (")?;
            write_noise(out, noise)?;
            write!(out, ")")?;
        }
        Texture::Function(_) => return Err(CANNOT_SAY),
    }
    let (reflection, transmission) = (Real(constant(reflection)?), Real(constant(transmission)?));
    let (shine, index) = (whole(constant(shine)?)?, Real(constant(refractive_index)?));
    write!(out, " ) {reflection} {shine} {transmission} {index} ))")
}

fn write_noise(out: &mut impl fmt::Write, noise: &NoiseTexture) -> fmt::Result {
    match *noise {
        NoiseTexture::Solid { base, grid } => write!(out, "perlinSolid {} {}", Color(base), Real(grid)),
        NoiseTexture::SemiTurbulence { base, octaves, grid } => {
            write!(out, "perlinSemiTurb {} {octaves} {}", Color(base), Real(grid))
        }
        NoiseTexture::Turbulence { base, octaves, grid } => {
            write!(out, "perlinTurb {} {octaves} {}", Color(base), Real(grid))
        }
        NoiseTexture::Fire { added, base, octaves, grid } => {
            write!(out, "perlinFire {} {} {octaves} {}", Color(added), Color(base), Real(grid))
        }
        NoiseTexture::Plasma { grid } => write!(out, "perlinPlasma {}", Real(grid)),
        NoiseTexture::Marble { base, octaves, grid, direction, power } => {
            write!(out, "perlinMarble {} {octaves} {}", Color(base), Real(grid))?;
            write!(out, " {} {}", Vector(direction), Real(power))
        }
        NoiseTexture::MarbleBase { base, added, octaves, grid, direction, power } => {
            write!(out, "perlinMarbleBase {} {} {octaves} {}", Color(base), Color(added), Real(grid))?;
            write!(out, " {} {}", Vector(direction), Real(power))
        }
        NoiseTexture::Wood { base, octaves, grid, rings, power } => {
            let (grid, rings, power) = (Real(grid), Real(rings), Real(power));
            write!(out, "perlinWood {} {octaves} {grid} {rings} {power}", Color(base))
        }
    }
}

/// A real with a point and without an exponent, in the fewest digits that read back to the same bits.
struct Real(f64);

impl fmt::Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.0.is_finite() {
            return Err(CANNOT_SAY);
        }
        // `Display` never uses an exponent; it leaves out the point of a whole number.
        let point = if self.0.fract() == 0.0 { ".0" } else { "" };
        write!(f, "{}{point}", self.0)
    }
}

struct Vector(DVec3);

impl fmt::Display for Vector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({},{},{})", Real(self.0.x), Real(self.0.y), Real(self.0.z))
    }
}

struct Color(Rgb);

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({},{},{})", Real(self.0.r), Real(self.0.g), Real(self.0.b))
    }
}
