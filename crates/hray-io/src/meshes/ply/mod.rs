//! The Polygon File Format (G. Turk, "The PLY Polygon File Format", Stanford University, 1994): a header that says what
//! follows, then that, as text or as binary numbers.

mod ascii;
mod binary;
mod header;

use super::polygons::{Polygons, linear, too_many};
use super::problem::Outcome;
use header::{Element, Encoding, Header, Property, Scalar};
use hray_core::Mesh;

/// A mesh, and what there is to say about it.
pub(super) struct Ply {
    pub(super) mesh: Mesh,
    pub(super) notes: Vec<String>,
}

/// Whether a file is one, by its first line.
pub(super) fn is_one(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

pub(super) fn read(bytes: &[u8]) -> Outcome<Ply> {
    let header = Header::read(bytes)?;
    let mut notes = Vec::new();
    let polygons = match header.encoding {
        Encoding::Ascii => ascii::read(bytes, &header, &mut notes)?,
        _ => binary::read(bytes, &header, &mut notes)?,
    };
    Ok(Ply { mesh: polygons.mesh()?, notes })
}

/// The number of components that a vertex can have: position, normal, uv and colour.
const COMPONENTS: usize = 11;
const NORMAL: usize = 3;
const UV: usize = 6;
const COLOR: usize = 8;

/// Which properties of a vertex are what.
struct Layout {
    /// By property: its place among the components.
    places: Vec<Option<usize>>,
    has_normals: bool,
    has_uvs: bool,
    has_colors: bool,
    /// The linear light of a byte.
    table: Vec<f32>,
}

impl Layout {
    fn of(element: &Element) -> Self {
        let place = |property: &Property| {
            if property.length.is_some() {
                return None;
            }
            Some(match &property.name[..] {
                b"x" => 0,
                b"y" => 1,
                b"z" => 2,
                b"nx" => NORMAL,
                b"ny" => NORMAL + 1,
                b"nz" => NORMAL + 2,
                b"u" | b"s" | b"texture_u" | b"texture_s" => UV,
                b"v" | b"t" | b"texture_v" | b"texture_t" => UV + 1,
                b"red" | b"r" | b"diffuse_red" => COLOR,
                b"green" | b"g" | b"diffuse_green" => COLOR + 1,
                b"blue" | b"b" | b"diffuse_blue" => COLOR + 2,
                _ => return None,
            })
        };
        let places: Vec<Option<usize>> = element.properties.iter().map(place).collect();
        let has = |mut range: std::ops::Range<usize>| range.all(|place| places.contains(&Some(place)));
        let (has_normals, has_uvs, has_colors) = (has(NORMAL..UV), has(UV..COLOR), has(COLOR..COMPONENTS));
        let table = (0..=255).map(|byte| linear(f64::from(byte) / 255.0)).collect();
        Self { places, has_normals, has_uvs, has_colors, table }
    }

    fn has_positions(&self) -> bool {
        (0..NORMAL).all(|place| self.places.contains(&Some(place)))
    }

    /// A component as it is kept: colours that are whole numbers are in sRGB.
    fn component(&self, place: usize, kind: Scalar, value: f64) -> f32 {
        match kind {
            _ if place < COLOR || kind.is_float() => value as f32,
            Scalar::U8 => self.table.get(value as usize).copied().unwrap_or(1.0),
            Scalar::U16 => linear(value / 65535.0),
            _ => linear((value / 255.0).clamp(0.0, 1.0)),
        }
    }

    fn reserve(&self, count: usize, polygons: &mut Polygons) {
        polygons.positions.reserve(count);
        polygons.normals.reserve(if self.has_normals { count } else { 0 });
        polygons.uvs.reserve(if self.has_uvs { count } else { 0 });
        polygons.colors.reserve(if self.has_colors { count } else { 0 });
    }

    fn push(&self, vertex: &[f32; COMPONENTS], polygons: &mut Polygons) {
        let [x, y, z, nx, ny, nz, u, v, r, g, b] = *vertex;
        polygons.positions.push([x, y, z]);
        if self.has_normals {
            polygons.normals.push([nx, ny, nz]);
        }
        if self.has_uvs {
            polygons.uvs.push([u, v]);
        }
        if self.has_colors {
            polygons.colors.push([r, g, b]);
        }
    }
}

/// What an element is for.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    Vertices,
    Faces,
    Strips,
    Nothing,
}

/// What an element is for, and which of its properties lists corners.
fn use_of(element: &Element) -> (Use, Option<usize>) {
    let is_list = |property: &Property| property.length.is_some() && !property.kind.is_float();
    let named = |property: &Property| matches!(&property.name[..], b"vertex_indices" | b"vertex_index");
    let corners = element.properties.iter().position(|property| is_list(property) && named(property));
    match (&element.name[..], corners) {
        (b"vertex", _) => (Use::Vertices, None),
        (b"face", Some(_)) => (Use::Faces, corners),
        (b"tristrips", Some(_)) => (Use::Strips, corners),
        _ => (Use::Nothing, None),
    }
}

/// Notes of what is not read.
fn note_unused(element: &Element, notes: &mut Vec<String>) {
    let name = String::from_utf8_lossy(&element.name);
    if element.count > 0 && (element.name == b"face" || element.name == b"tristrips") {
        notes.push(format!("the element `{name}` has no list `vertex_indices`, so it is not read"));
    }
}

/// Corners of a face, or of strips that -1 separates, as triangles; the number of the vertex that is not there, otherwise.
fn add(
    of: Use,
    corners: &[i64],
    vertices: u64,
    scratch: &mut Vec<u32>,
    into: &mut Polygons,
) -> Result<(), String> {
    scratch.clear();
    for &corner in corners {
        match u32::try_from(corner) {
            Ok(vertex) if u64::from(vertex) < vertices => scratch.push(vertex),
            _ if corner == -1 && of == Use::Strips => {
                into.strip(scratch);
                scratch.clear();
            }
            _ => return Err(no_such_vertex(corner, vertices)),
        }
    }
    if of == Use::Strips {
        into.strip(scratch);
    } else {
        into.polygon(scratch);
    }
    if into.is_full() { Err(too_many()) } else { Ok(()) }
}

fn no_such_vertex(corner: i64, vertices: u64) -> String {
    format!("it names vertex {corner}, but there are {vertices} vertices, counted from 0")
}
