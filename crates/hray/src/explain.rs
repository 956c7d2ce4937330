//! Explains a pixel in the words of the scene: which object, made where in the text, which rays, which lights.

use crate::{Control, Description, Error, Light, Options, PictureFormat, Rgb, SceneFile, Shape};
use hray_lang::diagnostic::{Diagnostic, Places, Span};
use hray_lang::hry::Sources;
use hray_lang::hry::eval::Origin;
use hray_render::{ExplainedHit, Followed, ObjectId, PixelExplanation, RayKind, Reach};
use serde::Serialize;
use std::collections::BTreeMap;

/// So many characters of an expression are shown.
const LONGEST_TEXT: usize = 100;

/// How a pixel came by its colour. It serialises to an object with these names as keys; a number that is infinite or no
/// number becomes `null`. Colours are the numbers that the scene computes with (linear light in hry): red, green, blue.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// The pixel, from the left and from the top, counted from 0.
    pub pixel: [u32; 2],
    /// Width and height of the picture.
    pub size: [u32; 2],
    /// The moment that is shown, in seconds.
    pub time: f64,
    /// The colour of the pixel, to the bit as a render gives it.
    pub color: [f64; 3],
    /// The same as a display shows it, and as most picture files hold it: `#rrggbb`.
    pub display: String,
    /// How many samples that is the mean of.
    pub samples: u32,
    /// What the samples see, what most of them see first.
    pub seen: Vec<SeenObject>,
    /// What the first of the rays sees, which leads through the pixel's own point (its centre, or with the window camera its
    /// lower left corner); none for the background.
    pub object: Option<Object>,
    /// The tree of rays of that one point: each ray stands before those that it leads to. The first comes from the camera; with
    /// one sample its colour is the pixel's. Empty where the depth is -1.
    pub rays: Vec<Ray>,
    /// How many rays were followed beyond those listed; there is a limit of [`crate::MAX_EXPLAINED_RAYS`].
    pub omitted: u64,
}

/// What some of the samples see.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeenObject {
    /// The object; none for the background.
    pub object: Option<Object>,
    /// How many samples see it.
    pub samples: u32,
}

/// An object of the scene, and where it comes from.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Object {
    /// Its number among the objects of the scene, in the order of the source, from 0.
    pub index: usize,
    /// Where it is a solid: the number of the part whose surface is meant, from the first operand to the last.
    pub part: Option<usize>,
    /// `sphere`, `plane`, `box` or `mesh`.
    pub kind: &'static str,
    /// The definition of the scene that made it, where that has a name other than `scene`.
    pub name: Option<String>,
    /// Where it was made.
    pub place: Option<SourcePlace>,
    /// The calls of functions that led there, the innermost first, at most four.
    pub calls: Vec<SourcePlace>,
    /// Where it is a part of a solid: where that was made.
    pub solid: Option<SourcePlace>,
}

/// An expression in a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SourcePlace {
    /// What the file is called in messages.
    pub file: String,
    /// Its path in the root folder.
    pub path: String,
    /// The line where it begins, from 1.
    pub line: usize,
    /// The column where it begins, in characters from 1.
    pub column: usize,
    /// The line of its end.
    pub end_line: usize,
    /// The column one past its last character.
    pub end_column: usize,
    /// Its start in UTF-16 code units from the start of the file.
    pub from: usize,
    /// Its end in UTF-16 code units.
    pub to: usize,
    /// The expression on one line, cut off after a hundred characters.
    pub text: String,
}

/// A ray, and what it brings back.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ray {
    /// Its place in the list.
    pub index: usize,
    /// The place of the ray that leads to it; none for the first.
    pub parent: Option<usize>,
    /// How many times it was mirrored or refracted so far.
    pub level: u32,
    /// `camera`, `reflection`, `transmission`, or `inner-reflection` where light cannot leave something transparent.
    pub kind: &'static str,
    /// Where it starts, in world space.
    pub origin: [f64; 3],
    /// Where it leads: a unit vector.
    pub direction: [f64; 3],
    /// How far it is to what it meets; none where it sees the background.
    pub distance: Option<f64>,
    /// The colour that it brings back.
    pub color: [f64; 3],
    /// What the parent multiplies that with; 1 for the first.
    pub weight: f64,
    /// The product: what it adds to its parent.
    pub contribution: [f64; 3],
    /// What it adds to the first ray, were nothing clipped on the way: its colour times the weights up to there.
    pub in_pixel: [f64; 3],
    /// What it meets; none where it sees the background.
    pub hit: Option<Hit>,
}

/// What a ray meets, and the light that comes from there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hit {
    /// The object.
    pub object: Object,
    /// Where that is a mesh, the number of the triangle.
    pub triangle: Option<u32>,
    /// The point, in world space.
    pub point: [f64; 3],
    /// The normal that is shaded with.
    pub normal: [f64; 3],
    /// Whether the surface is seen from inside the object.
    pub inside: bool,
    /// What the surface is like here.
    pub material: Surface,
    /// What each light gives, in the order of the source.
    pub lights: Vec<LightShare>,
    /// The light that the surface gives off by itself.
    pub glow: [f64; 3],
    /// What became of the mirrored light: `none` (the surface does not mirror), `followed`, or `too-deep` where the picture's
    /// depth ends it, which counts as black.
    pub mirrored: &'static str,
    /// What became of the light let through; besides these `lost`, which is what light that cannot leave becomes by the
    /// rules of 2005.
    pub refracted: &'static str,
    /// The sum of lights, glow, and contributions of the rays that this leads to, in this order.
    pub sum: [f64; 3],
    /// Whether that was more or less than a colour can be, so that the ray brings back less or more.
    pub clipped: bool,
}

/// What a surface is like at a point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Surface {
    /// Its own colour.
    pub color: [f64; 3],
    /// The share of mirrored light.
    pub reflection: f64,
    /// The share of light let through.
    pub transparency: f64,
    /// The index of refraction.
    pub ior: f64,
    /// The strength of the highlight.
    pub highlight: f64,
    /// The exponent of the highlight.
    pub shine: f64,
}

/// What a light gives to a hit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightShare {
    /// Its number among the lights, in the order of the source, from 0.
    pub light: usize,
    /// `point`, `ambient`, `directional` or `spotlight`.
    pub kind: &'static str,
    /// Where it was made.
    pub place: Option<SourcePlace>,
    /// `lit`; `everywhere` of an ambient light; `behind` where the surface faces away; `outside-cone` of a spotlight;
    /// `shadowed`.
    pub reach: &'static str,
    /// How far away the light is; none for ambient and directional ones.
    pub distance: Option<f64>,
    /// What is in the way, the nearest thing.
    pub shadowed_by: Option<Object>,
    /// How far that is from the point.
    pub shadow_distance: Option<f64>,
    /// What is scattered to all sides.
    pub diffuse: [f64; 3],
    /// The highlight.
    pub highlight: [f64; 3],
    /// Both: what it adds to the hit.
    pub contribution: [f64; 3],
    /// What it adds to the first ray, were nothing clipped on the way.
    pub in_pixel: [f64; 3],
}

/// Explains a pixel, `x` from the left and `y` from the top, of the picture of a scene with these options; their region and
/// threads do not matter. The colour is that of a render to the bit, and its parts are checked to add up to it.
///
/// # Errors
/// [`Error::Load`] where the scene has errors, [`Error::Options`], [`Error::Explain`], [`Error::Cancelled`],
/// [`Error::Solids`].
pub fn explain(
    file: &SceneFile,
    options: &Options,
    x: u32,
    y: u32,
    control: &Control,
) -> Result<Explanation, Error> {
    let Some(description) = file.description() else {
        return Err(Error::Load(crate::LoadError::Scene(Box::new(file.clone()))));
    };
    let found = explain_pixel(description, options, x, y, control)?;
    let settings = Options { region: None, ..options.clone() }.settings(description)?;
    let words = Words::new(file, description, &found);
    let mut weights: Vec<f64> = Vec::with_capacity(found.rays.len());
    let mut rays = Vec::with_capacity(found.rays.len());
    for (index, ray) in found.rays.iter().enumerate() {
        let above = ray.parent.and_then(|parent| weights.get(parent).copied()).unwrap_or(1.0);
        let weight = above * ray.weight;
        weights.push(weight);
        rays.push(Ray {
            index,
            parent: ray.parent,
            level: ray.level,
            kind: kind_of_ray(ray.kind),
            origin: ray.origin.to_array(),
            direction: ray.direction.to_array(),
            distance: ray.hit.as_ref().map(|hit| hit.distance),
            color: ray.color.to_array(),
            weight: ray.weight,
            contribution: (ray.color * ray.weight).to_array(),
            in_pixel: (ray.color * weight).to_array(),
            hit: ray.hit.as_ref().map(|hit| words.hit(hit, ray.color, weight)),
        });
    }
    let seen = found.seen.iter();
    let seen = seen.map(|seen| SeenObject {
        object: seen.object.map(|object| words.object(object)),
        samples: seen.samples,
    });
    let seen = seen.collect();
    Ok(Explanation {
        pixel: [x, y],
        size: [settings.resolution.width(), settings.resolution.height()],
        time: description.scene.time,
        color: found.color.to_array(),
        display: display_color(found.color, description),
        samples: found.samples,
        seen,
        object: rays.first().and_then(|ray| ray.hit.as_ref()).map(|hit| hit.object.clone()),
        rays,
        omitted: found.omitted,
    })
}

/// The same as plain data, of a description that need not come from a file.
///
/// # Errors
/// [`Error::Options`], [`Error::Explain`], [`Error::Cancelled`], [`Error::Solids`].
pub fn explain_pixel(
    description: &Description,
    options: &Options,
    x: u32,
    y: u32,
    control: &Control,
) -> Result<PixelExplanation, Error> {
    let settings = Options { region: None, ..options.clone() }.settings(description)?;
    let found = hray_render::explain(description, &options.noise_tables, &settings, [x, y], control);
    found.map_err(|error| match error {
        hray_render::ExplainError::Cancelled => Error::Cancelled,
        hray_render::ExplainError::Solids => Error::Solids,
        other => Error::Explain(other),
    })
}

/// A colour as a display shows it, and as most picture files hold it: `#rrggbb`.
#[must_use]
pub fn display_color(color: Rgb, description: &Description) -> String {
    let bytes = PictureFormat::Png.encode(&[color], description.encoding);
    bytes.iter().fold("#".to_owned(), |text, byte| format!("{text}{byte:02x}"))
}

const fn kind_of_ray(kind: RayKind) -> &'static str {
    match kind {
        RayKind::Camera => "camera",
        RayKind::Reflection => "reflection",
        RayKind::Transmission => "transmission",
        RayKind::InnerReflection => "inner-reflection",
    }
}

const fn followed(followed: Followed) -> &'static str {
    match followed {
        Followed::NotAsked => "none",
        Followed::Yes => "followed",
        Followed::TooDeep => "too-deep",
        Followed::Lost => "lost",
    }
}

/// From numbers of objects and lights to what the text calls them.
struct Words<'a> {
    description: &'a Description,
    objects: BTreeMap<ObjectId, Object>,
    lights: Vec<Option<SourcePlace>>,
}

impl<'a> Words<'a> {
    /// The words for everything in an explanation. Each file is walked only once.
    fn new(file: &'a SceneFile, description: &'a Description, found: &PixelExplanation) -> Self {
        let mut objects: BTreeMap<ObjectId, Object> = BTreeMap::new();
        let hits = || found.rays.iter().filter_map(|ray| ray.hit.as_ref());
        let mut ids: Vec<ObjectId> = found.seen.iter().filter_map(|seen| seen.object).collect();
        ids.extend(hits().map(|hit| hit.object));
        ids.extend(hits().flat_map(|hit| &hit.lights).filter_map(|light| match light.reach {
            Reach::Shadowed { by, .. } => Some(by),
            _ => None,
        }));
        ids.sort_unstable();
        ids.dedup();
        let origins = file.origins();
        let lights: Vec<Option<Origin>> =
            (0..description.scene.lights.len()).map(|light| origins.light(light)).collect();
        let made = |id: &ObjectId| match id.part {
            None => [origins.object(id.primitive), None],
            Some(part) => [origins.part(id.primitive, part), origins.object(id.primitive)],
        };
        let all = ids.iter().flat_map(made).chain(lights.iter().cloned()).flatten();
        let spans: Vec<Span> = all.flat_map(|origin| origin.calls.into_iter().chain([origin.span])).collect();
        let places = SourcePlaces::new(file, &spans);
        for id in ids {
            let [own, solid] = made(&id);
            let place = |span: &Span| places.of(*span);
            objects.insert(
                id,
                Object {
                    index: id.primitive,
                    part: id.part,
                    kind: kind_of_object(description, id),
                    name: own.as_ref().and_then(|origin| file.definition_at(origin.span.start)),
                    place: own.as_ref().and_then(|origin| place(&origin.span)),
                    calls: own.iter().flat_map(|origin| &origin.calls).filter_map(place).collect(),
                    solid: solid.and_then(|origin| place(&origin.span)),
                },
            );
        }
        let lights =
            lights.iter().map(|light| light.as_ref().and_then(|origin| places.of(origin.span))).collect();
        Self { description, objects, lights }
    }

    fn object(&self, id: ObjectId) -> Object {
        self.objects.get(&id).cloned().unwrap_or_else(|| Object {
            index: id.primitive,
            part: id.part,
            kind: kind_of_object(self.description, id),
            name: None,
            place: None,
            calls: Vec::new(),
            solid: None,
        })
    }

    fn hit(&self, hit: &ExplainedHit, color: Rgb, weight: f64) -> Hit {
        let lights = hit.lights.iter().enumerate().map(|(light, part)| {
            let kind = self.description.scene.lights.get(light).map_or("light", |light| match light {
                Light::Point { .. } => "point",
                Light::Ambient { .. } => "ambient",
                Light::Directional { .. } => "directional",
                Light::Spot { .. } => "spotlight",
            });
            let (reach, shadow) = match part.reach {
                Reach::Everywhere => ("everywhere", None),
                Reach::Lit => ("lit", None),
                Reach::Behind => ("behind", None),
                Reach::OutsideCone => ("outside-cone", None),
                Reach::Shadowed { by, distance } => ("shadowed", Some((by, distance))),
            };
            let is_somewhere = part.reach != Reach::Everywhere && part.distance.is_finite();
            LightShare {
                light,
                kind,
                place: self.lights.get(light).cloned().flatten(),
                reach,
                distance: is_somewhere.then_some(part.distance),
                shadowed_by: shadow.map(|(by, _)| self.object(by)),
                shadow_distance: shadow.map(|(_, distance)| distance),
                diffuse: part.diffuse.to_array(),
                highlight: part.highlight.to_array(),
                contribution: part.contribution.to_array(),
                in_pixel: (part.contribution * weight).to_array(),
            }
        });
        Hit {
            object: self.object(hit.object),
            triangle: hit.triangle,
            point: hit.point.to_array(),
            normal: hit.normal.to_array(),
            inside: hit.inside,
            material: Surface {
                color: hit.base.to_array(),
                reflection: hit.reflection,
                transparency: hit.transmission,
                ior: hit.refractive_index,
                highlight: hit.highlight,
                shine: hit.shine,
            },
            lights: lights.collect(),
            glow: hit.glow.to_array(),
            mirrored: followed(hit.mirrored),
            refracted: followed(hit.refracted),
            sum: hit.sum.to_array(),
            clipped: hit.sum != color,
        }
    }
}

fn kind_of_object(description: &Description, id: ObjectId) -> &'static str {
    let primitive = description.scene.primitives.get(id.primitive);
    let shape = match id.part {
        None => primitive,
        Some(part) => primitive.and_then(|primitive| primitive.leaves().nth(part)),
    };
    match shape.map(|primitive| &primitive.shape) {
        Some(Shape::Sphere(_)) => "sphere",
        Some(Shape::Plane(_)) => "plane",
        Some(Shape::Cuboid(_)) => "box",
        Some(Shape::Frustum(frustum)) if frustum.radii[0] == frustum.radii[1] => "cylinder",
        Some(Shape::Frustum(_)) => "cone",
        Some(Shape::Disc(_)) => "disc",
        Some(Shape::Torus(_)) => "torus",
        Some(Shape::Quadric(_)) => "quadric",
        Some(Shape::Implicit(_)) => "implicit surface",
        Some(Shape::Mesh(_)) => "mesh",
        Some(Shape::Csg(_) | Shape::Inverse(_) | Shape::Clip(_)) | None => "solid",
    }
}

/// The places of some spans, found with one walk over each file.
struct SourcePlaces {
    known: BTreeMap<Span, SourcePlace>,
}

impl SourcePlaces {
    fn new(file: &SceneFile, spans: &[Span]) -> Self {
        let sources = file.sources();
        // That is how places are asked for.
        let asked: Vec<Diagnostic> =
            spans.iter().map(|&span| Diagnostic::warning("place", "", span, "")).collect();
        let places = Places::new(sources, &asked);
        let units = code_units(sources, spans);
        let mut known = BTreeMap::new();
        for &span in spans {
            let (Some(place), Some(source)) = (places.of(span), sources.file(span.start)) else { continue };
            let units = |offset: usize| units.get(&offset).copied().unwrap_or(0);
            known.entry(span).or_insert_with(|| SourcePlace {
                file: place.file.to_owned(),
                path: source.path.clone(),
                line: place.start.line,
                column: place.start.column,
                end_line: place.end.line,
                end_column: place.end.column,
                from: units(span.start),
                to: units(span.end),
                text: on_one_line(sources.text(span)),
            });
        }
        Self { known }
    }

    fn of(&self, span: Span) -> Option<SourcePlace> {
        self.known.get(&span).cloned()
    }
}

/// How many UTF-16 code units stand before both ends of each span in its file, by offsets into the sources.
fn code_units(sources: &Sources, spans: &[Span]) -> BTreeMap<usize, usize> {
    let mut units: BTreeMap<usize, usize> = spans.iter().flat_map(|s| [(s.start, 0), (s.end, 0)]).collect();
    let (mut base, mut at, mut count) = (None, 0, 0);
    for (&offset, units) in &mut units {
        let Some(file) = sources.file(offset) else { continue };
        if base != Some(file.base) {
            (base, at, count) = (Some(file.base), 0, 0);
        }
        let local = offset - file.base;
        count += file.text.get(at..local).map_or(0, |text| text.chars().map(char::len_utf16).sum());
        (at, *units) = (local, count);
    }
    units
}

/// The start of a text, its white space made single spaces.
fn on_one_line(text: &str) -> String {
    let mut line = String::new();
    for word in text.split_whitespace() {
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
        if line.len() > 4 * LONGEST_TEXT {
            break;
        }
    }
    match line.char_indices().nth(LONGEST_TEXT) {
        Some((end, _)) => format!("{}...", line.get(..end).unwrap_or("").trim_end()),
        None => line,
    }
}
