//! Classic scenes in hry.

use glam::DVec3;
use hray_core::{
    Background, Camera, Description, Encoding, Field, Integrator, Light, Material, NoiseTexture, Primitive,
    Rgb, Shape, Texture,
};
use std::collections::BTreeMap;
use std::fmt::{self, Write as _};

/// What is longer than this is broken into lines.
const WIDTH: usize = 100;

/// A description that the classic language can say, in hry. Loading the text gives an equal description, all numbers to
/// the bit (but for the sign of an offset of 0), so that the picture is the same.
///
/// Materials that several objects share are definitions of their own. What only hry can say (transforms, solids,
/// functions of a hit, other cameras, lights and integrators) and numbers that are not finite give none.
#[must_use]
pub fn convert(description: &Description) -> Option<String> {
    let scene = &description.scene;
    let as_in_2005 =
        (description.integrator, description.encoding) == (Integrator::Classic2005, Encoding::Raw);
    if !as_in_2005 || scene.time != 0.0 {
        return None;
    }
    let (Camera::Window(camera), Background::Uniform(background)) = (scene.camera, &scene.background) else {
        return None;
    };
    let mut materials = Materials::default();
    for primitive in &scene.primitives {
        materials.count(material(&primitive.material)?);
    }
    let mut text = String::new();
    materials.define(&mut text);
    let objects: Option<Vec<Node>> =
        scene.primitives.iter().map(|primitive| object(primitive, &materials)).collect();
    let lights: Option<Vec<Node>> = scene.lights.iter().map(light).collect();
    let (width, height) = (description.resolution.width(), description.resolution.height());
    let window = Node::call(
        "window",
        [
            ("eye", vector(camera.eye)?),
            ("size", Node::Text(format!("({}, {})", number(camera.window[0])?, number(camera.window[1])?))),
        ],
    );
    let scene = Node::call(
        "",
        [
            ("size", Node::Text(format!("({width}, {height})"))),
            ("depth", Node::Text(description.max_depth.to_string())),
            ("samples", Node::Text(description.samples.to_string())),
            ("integrator", Node::Text("classic2005".into())),
            ("encoding", Node::Text("raw".into())),
            ("camera", window),
            ("background", grey_or_color(*background)?),
            ("lights", Node::List(lights?)),
            ("objects", Node::List(objects?)),
        ],
    );
    text.push_str("scene = ");
    // The scene itself is never on one line.
    scene.write_broken(&mut text, 0);
    text.push('\n');
    Some(text)
}

/// A piece of text that can be broken into lines where it has brackets.
enum Node {
    Text(String),
    /// A constructor or function, and the fields of its record.
    Call(&'static str, Vec<(&'static str, Node)>),
    List(Vec<Node>),
}

impl Node {
    fn call<const N: usize>(name: &'static str, fields: [(&'static str, Self); N]) -> Self {
        Self::Call(name, fields.into())
    }

    /// Writes it after `column` characters of a line, whose first word is `indent` from the left; `after` characters
    /// follow it.
    fn write(&self, out: &mut String, indent: usize, column: usize, after: usize) {
        let start = out.len();
        if self.write_line(out, start + WIDTH.saturating_sub(column + after)) {
            return;
        }
        out.truncate(start);
        self.write_broken(out, indent);
    }

    /// Writes it on one line; whether that ends before `limit`.
    fn write_line(&self, out: &mut String, limit: usize) -> bool {
        match self {
            Self::Text(text) => out.push_str(text),
            Self::List(items) => {
                out.push('[');
                for (i, item) in items.iter().enumerate() {
                    out.push_str(if i == 0 { "" } else { ", " });
                    if !item.write_line(out, limit) {
                        return false;
                    }
                }
                out.push(']');
            }
            Self::Call(name, fields) => {
                out.push_str(name);
                out.push_str(if name.is_empty() { "{ " } else { " { " });
                for (i, (field, value)) in fields.iter().enumerate() {
                    out.push_str(if i == 0 { "" } else { ", " });
                    out.push_str(field);
                    out.push_str(" = ");
                    if !value.write_line(out, limit) {
                        return false;
                    }
                }
                out.push_str(" }");
            }
        }
        out.len() <= limit || matches!(self, Self::Text(_))
    }

    /// Writes it with a line for every part.
    fn write_broken(&self, out: &mut String, indent: usize) {
        let inner = indent + 2;
        match self {
            Self::Text(text) => out.push_str(text),
            Self::List(items) => {
                out.push_str("[\n");
                for item in items {
                    spaces(out, inner);
                    item.write(out, inner, inner, 1);
                    out.push_str(",\n");
                }
                spaces(out, indent);
                out.push(']');
            }
            Self::Call(name, fields) => {
                out.push_str(name);
                out.push_str(if name.is_empty() { "{\n" } else { " {\n" });
                for (field, value) in fields {
                    spaces(out, inner);
                    let _ = write!(out, "{field} = ");
                    value.write(out, inner, inner + field.len() + 3, 1);
                    out.push_str(",\n");
                }
                spaces(out, indent);
                out.push('}');
            }
        }
    }
}

fn spaces(out: &mut String, count: usize) {
    out.extend(std::iter::repeat_n(' ', count));
}

/// Materials by their text on one line: how often each is used, and its place among those that are used more than once.
#[derive(Default)]
struct Materials {
    by_text: BTreeMap<String, Use>,
    /// Those that are used more than once, in the order of their first use.
    shared: Vec<Node>,
}

#[derive(Clone, Copy)]
struct Use {
    first: usize,
    count: usize,
    name: Option<usize>,
}

impl Materials {
    fn count(&mut self, material: Node) {
        let first = self.by_text.len();
        let used = self.by_text.entry(key(&material)).or_insert(Use { first, count: 0, name: None });
        used.count += 1;
        if used.count == 2 {
            used.name = Some(self.shared.len());
            self.shared.push(material);
        }
    }

    /// Writes the definitions of what is shared, numbered in the order of first use.
    fn define(&mut self, out: &mut String) {
        let mut order: Vec<(usize, usize)> =
            self.by_text.values().filter_map(|used| Some((used.first, used.name?))).collect();
        order.sort_unstable();
        for (number, (_, place)) in order.iter().enumerate() {
            let name = name(number);
            let _ = write!(out, "{name} = ");
            if let Some(material) = self.shared.get(*place) {
                material.write(out, 0, name.len() + 3, 0);
            }
            out.push_str("\n\n");
        }
        let mut numbers = vec![0; order.len()];
        for (number, (_, place)) in order.iter().enumerate() {
            if let Some(slot) = numbers.get_mut(*place) {
                *slot = number;
            }
        }
        for used in self.by_text.values_mut() {
            used.name = used.name.and_then(|place| numbers.get(place).copied());
        }
    }

    /// The name of a material, where it has one.
    fn get(&self, material: &Node) -> Option<String> {
        self.by_text.get(&key(material))?.name.map(name)
    }
}

fn key(material: &Node) -> String {
    let mut key = String::new();
    material.write_line(&mut key, usize::MAX);
    key
}

fn name(number: usize) -> String {
    format!("material{}", number + 1)
}

fn object(primitive: &Primitive, materials: &Materials) -> Option<Node> {
    let material = material(&primitive.material)?;
    let material = materials.get(&material).map_or(material, Node::Text);
    if primitive.transform.is_some() {
        return None;
    }
    Some(match &primitive.shape {
        Shape::Sphere(sphere) => Node::call(
            "sphere",
            [("radius", real(sphere.radius)?), ("center", vector(sphere.center)?), ("material", material)],
        ),
        // The thesis writes n · p + d = 0, hry n · p = offset.
        Shape::Plane(plane) => Node::call(
            "plane",
            [
                ("normal", vector(plane.normal)?),
                ("offset", real(0.0 - plane.offset)?),
                ("material", material),
            ],
        ),
        Shape::Cuboid(_)
        | Shape::Frustum(_)
        | Shape::Disc(_)
        | Shape::Torus(_)
        | Shape::Quadric(_)
        | Shape::Implicit(_)
        | Shape::Csg(_)
        | Shape::Inverse(_)
        | Shape::Clip(_)
        | Shape::Mesh(_) => return None,
    })
}

fn material(material: &Material) -> Option<Node> {
    let Material { texture, reflection, shine, transmission, refractive_index, highlight, glow, bump } =
        material;
    if highlight.is_some() || glow.is_some() || bump.is_some() {
        return None;
    }
    let mut fields = vec![("color", color_of(texture)?)];
    // What is as it would be anyway is left out.
    let fields_of_material = [
        ("reflection", reflection, 0.0),
        ("shine", shine, 40.0),
        ("transparency", transmission, 0.0),
        ("ior", refractive_index, 1.5f64),
    ];
    for (name, field, default) in fields_of_material {
        let Field::Constant(value) = field else { return None };
        if value.to_bits() != default.to_bits() {
            fields.push((name, real(*value)?));
        }
    }
    Some(Node::Call("classic", fields))
}

fn color_of(texture: &Texture) -> Option<Node> {
    match texture {
        Texture::Solid(color) => grey_or_color(*color),
        Texture::Noise(noise) => noise_texture(noise),
        Texture::Function(_) => None,
    }
}

fn noise_texture(noise: &NoiseTexture) -> Option<Node> {
    let count = |octaves: u32| Node::Text(octaves.to_string());
    Some(match *noise {
        NoiseTexture::Solid { base, grid } => {
            Node::call("perlinSolid", [("color", color(base)?), ("grid", real(grid)?)])
        }
        NoiseTexture::SemiTurbulence { base, octaves, grid } => Node::call(
            "perlinSemiTurb",
            [("color", color(base)?), ("octaves", count(octaves)), ("grid", real(grid)?)],
        ),
        NoiseTexture::Turbulence { base, octaves, grid } => Node::call(
            "perlinTurb",
            [("color", color(base)?), ("octaves", count(octaves)), ("grid", real(grid)?)],
        ),
        NoiseTexture::Fire { added, base, octaves, grid } => Node::call(
            "perlinFire",
            [
                ("added", color(added)?),
                ("color", color(base)?),
                ("octaves", count(octaves)),
                ("grid", real(grid)?),
            ],
        ),
        NoiseTexture::Plasma { grid } => Node::call("perlinPlasma", [("grid", real(grid)?)]),
        NoiseTexture::Marble { base, octaves, grid, direction, power } => Node::call(
            "perlinMarble",
            [
                ("color", color(base)?),
                ("octaves", count(octaves)),
                ("grid", real(grid)?),
                ("direction", vector(direction)?),
                ("power", real(power)?),
            ],
        ),
        NoiseTexture::MarbleBase { base, added, octaves, grid, direction, power } => Node::call(
            "perlinMarbleBase",
            [
                ("color", color(base)?),
                ("added", color(added)?),
                ("octaves", count(octaves)),
                ("grid", real(grid)?),
                ("direction", vector(direction)?),
                ("power", real(power)?),
            ],
        ),
        NoiseTexture::Wood { base, octaves, grid, rings, power } => Node::call(
            "perlinWood",
            [
                ("color", color(base)?),
                ("octaves", count(octaves)),
                ("grid", real(grid)?),
                ("rings", real(rings)?),
                ("power", real(power)?),
            ],
        ),
    })
}

fn light(light: &Light) -> Option<Node> {
    Some(match light {
        Light::Point { position, intensity } => {
            Node::call("point", [("position", vector(*position)?), ("intensity", grey_or_color(*intensity)?)])
        }
        Light::Ambient { intensity } => Node::call("ambient", [("intensity", grey_or_color(*intensity)?)]),
        Light::Directional { .. } | Light::Spot { .. } => return None,
    })
}

/// A number in the fewest digits that read back to the same bits.
fn number(value: f64) -> Option<impl fmt::Display> {
    // `Display` never uses an exponent, and `LowerExp` always does.
    let (plain, short) = (value.to_string(), format!("{value:e}"));
    value.is_finite().then(|| if plain.len() <= short.len() + 2 { plain } else { short })
}

fn real(value: f64) -> Option<Node> {
    number(value).map(|text| Node::Text(text.to_string()))
}

fn vector(DVec3 { x, y, z }: DVec3) -> Option<Node> {
    Some(Node::Text(format!("({}, {}, {})", number(x)?, number(y)?, number(z)?)))
}

fn color(Rgb { r, g, b }: Rgb) -> Option<Node> {
    Some(Node::Text(format!("rgb {} {} {}", number(r)?, number(g)?, number(b)?)))
}

/// A number stands for a grey wherever a constructor wants a colour.
fn grey_or_color(color_value: Rgb) -> Option<Node> {
    let [r, g, b] = color_value.to_array().map(f64::to_bits);
    if r == g && g == b { real(color_value.r) } else { color(color_value) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::classic;

    fn converted(objects: &str, lights: &str) -> String {
        let text = format!(
            "renderDescr ( resolution (40,30) ) 3 [ scene {{ camera (0.0,0.0,150.0) (100,75) }}
             {{ background (0.2,0.3,0.5) }} {{ objects {objects} }} {{ lights {lights} }} ]"
        );
        let parsed = classic::parse(&text);
        convert(&parsed.description.unwrap_or_else(|| panic!("{:?}", parsed.diagnostics))).unwrap()
    }

    #[test]
    fn an_empty_scene_is_short() {
        assert_eq!(
            converted("", ""),
            "scene = {\n  size = (40, 30),\n  depth = 3,\n  samples = 1,\n  integrator = classic2005,\n  \
             encoding = raw,\n  camera = window { eye = (0, 0, 150), size = (100, 75) },\n  \
             background = rgb 0.2 0.3 0.5,\n  lights = [],\n  objects = [],\n}\n"
        );
    }

    #[test]
    fn shared_materials_are_defined_once_and_in_the_order_of_use() {
        let sphere = |color: &str| {
            format!(
                "(object ( sphere 1.5 (0.0,-2.0,0.0) ) ( texture ( diff solid {color} ) 0.3 20 0.0 0.0 ))"
            )
        };
        let (red, green, blue) = (sphere("(1.0,0.0,0.0)"), sphere("(0.0,1.0,0.0)"), sphere("(0.0,0.0,1.0)"));
        let text = converted(&[red.clone(), green.clone(), blue, green, red].concat(), "");
        assert!(
            text.starts_with(
                "material1 = classic { color = rgb 1 0 0, reflection = 0.3, shine = 20, ior = 0 }\n\n\
                 material2 = classic { color = rgb 0 1 0, reflection = 0.3, shine = 20, ior = 0 }\n\nscene = {\n"
            ),
            "{text}"
        );
        assert!(
            text.contains("    sphere { radius = 1.5, center = (0, -2, 0), material = material2 },\n"),
            "{text}"
        );
        assert_eq!(text.matches("rgb 0 0 1").count(), 1);
    }

    #[test]
    fn a_plane_has_its_offset_on_the_other_side_and_long_things_are_broken() {
        let plane = "(object ( plane (0.0,1.0,0.0,30.0) )
            ( texture ( diff perlin (perlinMarbleBase (0.1,0.2,0.3) (0.4,0.5,0.6) 3 7.5 (1.0,0.0,0.0) 2.0) ) 0.5 40 0.0 1.5 ))";
        let text = converted(plane, "(ambientLight (0.5,0.5,0.5))");
        assert!(text.contains("offset = -30,"), "{text}");
        assert!(text.contains("ambient { intensity = 0.5 }"), "{text}");
        assert!(text.lines().all(|line| line.len() <= WIDTH), "{text}");
        assert!(text.contains("color = perlinMarbleBase {\n"), "{text}");
    }

    #[test]
    fn numbers_are_short_and_exact() {
        let text = |value: f64| number(value).unwrap().to_string();
        assert_eq!(
            [text(1.0), text(0.1), text(-2.5), text(1e300), text(1e-7)],
            ["1", "0.1", "-2.5", "1e300", "1e-7"]
        );
        for value in [f64::MIN_POSITIVE, 5e-324, f64::MAX, 1.0 / 3.0, 123_456_789.125, -0.0] {
            assert_eq!(text(value).parse::<f64>().unwrap().to_bits(), value.to_bits());
        }
        assert!(number(f64::NAN).is_none() && number(f64::INFINITY).is_none());
    }
}
