//! Scenes back to text.

use glam::DVec3;
use hray_core::{Description, Light, Material, NoiseTexture, Primitive, Rgb, Scene, Shape, Texture};
use std::fmt;

/// A description in the classic scene language. [`parse`](super::parse) reads it back to the same bits.
///
/// Every real has to be finite: the language has no notation for infinity and NaN, and a text made with
/// them is not a scene.
#[must_use]
pub fn write(description: &Description) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = write_to(&mut text, description);
    text
}

fn write_to(out: &mut impl fmt::Write, description: &Description) -> fmt::Result {
    let Description { resolution, max_depth, scene } = description;
    let Scene { camera, background, primitives, lights } = scene;
    writeln!(
        out,
        "renderDescr ( resolution ({},{}) ) {max_depth} [",
        resolution.width(),
        resolution.height()
    )?;
    let [width, height] = camera.window;
    writeln!(out, "scene {{ camera {} ({width},{height}) }}", Vector(camera.eye))?;
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
        }
    }
    writeln!(out, " }} ]")
}

fn write_primitive(out: &mut impl fmt::Write, primitive: &Primitive) -> fmt::Result {
    let Primitive { shape, material } = primitive;
    let Material { texture, reflection, shine, transmission, refractive_index } = material;
    write!(out, "\n        (object ( ")?;
    match shape {
        Shape::Sphere(sphere) => write!(out, "sphere {} {}", Real(sphere.radius), Vector(sphere.center))?,
        Shape::Plane(plane) => {
            let DVec3 { x, y, z } = plane.normal;
            write!(out, "plane ({},{},{},{})", Real(x), Real(y), Real(z), Real(plane.offset))?;
        }
    }
    write!(out, " ) ( texture ( diff ")?;
    match texture {
        Texture::Solid(color) => write!(out, "solid {}", Color(*color))?,
        Texture::Noise(noise) => {
            write!(out, "perlin (")?;
            write_noise(out, noise)?;
            write!(out, ")")?;
        }
    }
    let (reflection, transmission) = (Real(*reflection), Real(*transmission));
    write!(out, " ) {reflection} {shine} {transmission} {} ))", Real(*refractive_index))
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
