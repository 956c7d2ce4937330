//! Wavefront's OBJ ("Object Files (.obj)", Advanced Visualizer Manual, appendix B1): polygons that name positions, normals
//! and texture coordinates apart from each other. What is made of one material becomes one part.

use super::Companions;
use super::mtl;
use super::polygons::{Polygons, too_many};
use super::problem::{Outcome, Problem};
use super::words::{Word, float, whole};
use hray_core::{ModelMaterial, ModelPart};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// Stands for a normal or a texture coordinate that a corner does not have.
const NONE: u32 = u32::MAX;

pub(super) fn read(bytes: &[u8], files: &Companions<'_>, notes: &mut Vec<String>) -> Outcome<Vec<ModelPart>> {
    let mut reader = Reader::new(files);
    for (number, line) in Lines::new(bytes) {
        reader.line(&line, number)?;
    }
    reader.finish(notes)
}

/// The lines of a file, each with its number, counted from 1. A backslash at the end of a line takes the next one in.
struct Lines<'a> {
    rest: Option<&'a [u8]>,
    number: usize,
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self { rest: Some(bytes), number: 0 }
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest?;
        let end = rest.iter().position(|byte| *byte == b'\n');
        self.rest = end.and_then(|end| rest.get(end + 1..));
        self.number += 1;
        rest.get(..end.unwrap_or(rest.len())).map(<[u8]>::trim_ascii_end)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, std::borrow::Cow<'a, [u8]>);

    fn next(&mut self) -> Option<Self::Item> {
        let mut line = std::borrow::Cow::Borrowed(self.physical()?);
        let number = self.number;
        while line.last() == Some(&b'\\') {
            let owned = line.to_mut();
            owned.pop();
            let Some(more) = self.physical() else { break };
            owned.push(b' ');
            owned.extend_from_slice(more);
        }
        Some((number, line))
    }
}

/// What is made of one material.
#[derive(Default)]
struct Part {
    name: String,
    material: String,
    polygons: Polygons,
    /// The vertex that stands for a position, a texture coordinate and a normal. Only looked up.
    known: HashMap<[u32; 3], u32>,
    lacks_uvs: bool,
    lacks_normals: bool,
}

struct Reader<'a> {
    files: &'a Companions<'a>,
    positions: Vec<[f32; 3]>,
    /// Of the first positions; of all where they have colours.
    colors: Vec<[f32; 3]>,
    uvs: Vec<[f32; 2]>,
    normals: Vec<[f32; 3]>,
    parts: Vec<Part>,
    /// The part that is written to, by the name of its material.
    by_material: BTreeMap<Vec<u8>, usize>,
    current: Option<usize>,
    material: Vec<u8>,
    name: String,
    libraries: Vec<String>,
    triangles: usize,
    has_curves: bool,
    corners: Vec<u32>,
}

impl<'a> Reader<'a> {
    fn new(files: &'a Companions<'a>) -> Self {
        Self {
            files,
            positions: Vec::new(),
            colors: Vec::new(),
            uvs: Vec::new(),
            normals: Vec::new(),
            parts: Vec::new(),
            by_material: BTreeMap::new(),
            current: None,
            material: Vec::new(),
            name: String::new(),
            libraries: Vec::new(),
            triangles: 0,
            has_curves: false,
            corners: Vec::new(),
        }
    }

    fn line(&mut self, line: &[u8], number: usize) -> Outcome<()> {
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let Some(first) = words.next() else { return Ok(()) };
        match first {
            b"v" => {
                let mut values = [0.0; 6];
                let count = floats(&mut words, &mut values, "a coordinate", number)?;
                let [x, y, z, r, g, b] = values;
                if count < 3 {
                    let what = format!("a vertex has three coordinates, and this has {count}");
                    return Err(Problem::line(number, what));
                }
                self.positions.push([x, y, z]);
                if count == 6 {
                    self.colors.push([r, g, b]);
                }
            }
            b"vt" => {
                let mut values = [0.0; 2];
                if floats(&mut words, &mut values, "a texture coordinate", number)? == 0 {
                    return Err(Problem::line(
                        number,
                        "a texture coordinate has a number or two, and this has none",
                    ));
                }
                self.uvs.push(values);
            }
            b"vn" => {
                let mut values = [0.0; 3];
                let count = floats(&mut words, &mut values, "a component of a normal", number)?;
                if count < 3 {
                    let what = format!("a normal has three components, and this has {count}");
                    return Err(Problem::line(number, what));
                }
                self.normals.push(values);
            }
            b"f" | b"fo" => self.face(words, number)?,
            b"usemtl" => {
                self.material = line.get(first.len()..).unwrap_or_default().trim_ascii().to_vec();
                self.current = None;
            }
            b"mtllib" => {
                let names = line.get(first.len()..).unwrap_or_default().trim_ascii();
                self.libraries.push(String::from_utf8_lossy(names).into_owned());
            }
            b"o" | b"g" => {
                let name = line.get(first.len()..).unwrap_or_default().trim_ascii();
                self.name = String::from_utf8_lossy(name).into_owned();
            }
            b"curv" | b"curv2" | b"surf" => self.has_curves = true,
            // Comments, groups of smoothness, and whatever else there is.
            _ => {}
        }
        Ok(())
    }

    fn face<'w>(&mut self, words: impl Iterator<Item = &'w [u8]>, number: usize) -> Outcome<()> {
        let index = match self.current {
            Some(index) => index,
            None => {
                let next = self.parts.len();
                let index = *self.by_material.entry(self.material.clone()).or_insert(next);
                if index == next {
                    let material = String::from_utf8_lossy(&self.material).into_owned();
                    self.parts.push(Part { name: self.name.clone(), material, ..Part::default() });
                }
                self.current = Some(index);
                index
            }
        };
        let has_colors = self.colors.len() == self.positions.len();
        let Some(part) = self.parts.get_mut(index) else { return Ok(()) };
        self.corners.clear();
        for word in words {
            let mut fields = word.split(|byte| *byte == b'/');
            let mut place = |count: usize, what: &str| match fields.next() {
                None | Some(b"") => Ok(NONE),
                Some(field) => resolve(field, count, what, number),
            };
            let position = place(self.positions.len(), "vertex")?;
            let uv = place(self.uvs.len(), "texture coordinate")?;
            let normal = place(self.normals.len(), "normal")?;
            let Some(at) = self.positions.get(position as usize) else {
                let what = format!("a corner of a face names a vertex, and this is {}", Word(word));
                return Err(Problem::line(number, what));
            };
            let polygons = &mut part.polygons;
            let vertex = *part.known.entry([position, uv, normal]).or_insert_with(|| {
                polygons.positions.push(*at);
                polygons.uvs.push(self.uvs.get(uv as usize).copied().unwrap_or_default());
                polygons.normals.push(self.normals.get(normal as usize).copied().unwrap_or_default());
                if has_colors {
                    polygons.colors.extend(self.colors.get(position as usize));
                }
                // Limited by the number of triangles.
                (polygons.positions.len() - 1) as u32
            });
            part.lacks_uvs |= uv == NONE;
            part.lacks_normals |= normal == NONE;
            self.corners.push(vertex);
        }
        let before = part.polygons.triangles.len();
        part.polygons.polygon(&self.corners);
        self.triangles += part.polygons.triangles.len() - before;
        if self.triangles > hray_core::Mesh::MOST_TRIANGLES {
            return Err(Problem::line(number, too_many()));
        }
        Ok(())
    }

    fn finish(self, notes: &mut Vec<String>) -> Outcome<Vec<ModelPart>> {
        let mut materials: BTreeMap<String, Arc<ModelMaterial>> = BTreeMap::new();
        for names in &self.libraries {
            self.library(names, &mut materials, notes)?;
        }
        if self.has_curves {
            notes.push("curves and curved surfaces are not read".to_owned());
        }
        let mut parts = Vec::with_capacity(self.parts.len());
        for Part { name, material, mut polygons, lacks_uvs, lacks_normals, .. } in self.parts {
            if lacks_uvs {
                polygons.uvs = Vec::new();
            }
            if lacks_normals {
                polygons.normals = Vec::new();
            }
            if polygons.colors.len() != polygons.positions.len() {
                polygons.colors = Vec::new();
            }
            let mesh = Arc::new(polygons.mesh()?);
            let material = materials.get(&material).cloned();
            parts.push(ModelPart { name, mesh, transform: None, material });
        }
        Ok(parts)
    }

    /// Reads the materials of a library: one file with spaces in its name, or several.
    fn library(
        &self,
        names: &str,
        materials: &mut BTreeMap<String, Arc<ModelMaterial>>,
        notes: &mut Vec<String>,
    ) -> Outcome<()> {
        let whole = (self.files)(names);
        let several = whole.is_err() && names.contains(char::is_whitespace);
        let files: Vec<(&str, Result<Vec<u8>, String>)> = if several {
            names.split_whitespace().map(|name| (name, (self.files)(name))).collect()
        } else {
            vec![(names, whole)]
        };
        for (name, file) in files {
            match file {
                Err(reason) => notes.push(format!("the materials in {name:?} are not read: {reason}")),
                Ok(bytes) => mtl::read(&bytes, materials, notes)
                    .map_err(|problem| Problem::part(format!("in {name:?}"), problem.to_string()))?,
            }
        }
        Ok(())
    }
}

/// Reads numbers, as many as there are and have a place; how many there were.
pub(super) fn floats<'w>(
    words: &mut impl Iterator<Item = &'w [u8]>,
    values: &mut [f32],
    what: &str,
    line: usize,
) -> Outcome<usize> {
    let mut count = 0;
    for (value, word) in values.iter_mut().zip(words) {
        *value = float(word, what, line)?;
        count += 1;
    }
    Ok(count)
}

/// The place from 0 that an index means: from 1, or, where it is negative, from the last one so far.
fn resolve(field: &[u8], count: usize, what: &str, line: usize) -> Outcome<u32> {
    let index = whole(field, "an index", line)?;
    let place = match index {
        1.. => index - 1,
        _ => index.saturating_add(count as i64),
    };
    match u32::try_from(place) {
        Ok(place) if index != 0 && (place as usize) < count => Ok(place),
        _ => {
            let range = if count == 0 {
                "there is none so far".to_owned()
            } else {
                format!("there are 1 to {count} so far")
            };
            Err(Problem::line(line, format!("the face names {what} {index}, but {range}")))
        }
    }
}
