//! Khronos' glTF 2.0 (ISO/IEC 12113), as text and in its binary form (GLB): a tree of nodes that place meshes, whose numbers
//! lie in buffers.

mod accessor;
mod container;
mod json;

use super::Companions;
use super::polygons::{Polygons, too_many};
use super::problem::{Outcome, Problem};
use hray_core::{DAffine3, DMat3, DVec3, Mesh, ModelMaterial, ModelPart, Rgb};
use json::Document;
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The most parts of a model.
const MOST_PARTS: usize = 1 << 20;
/// The most bytes of all buffers together.
const MOST_BYTES: usize = super::MAX_MODEL_BYTES as usize;
/// What is required and makes no difference to what is read, or is understood.
const UNDERSTOOD: [&str; 4] =
    ["KHR_mesh_quantization", "KHR_texture_transform", "KHR_lights_punctual", "KHR_texture_basisu"];

/// Whether a file is one, by its start.
pub(super) fn is_one(bytes: &[u8]) -> bool {
    bytes.starts_with(b"glTF") || bytes.trim_ascii_start().starts_with(b"{")
}

pub(super) fn read(bytes: &[u8], files: &Companions<'_>, notes: &mut Vec<String>) -> Outcome<Vec<ModelPart>> {
    let container = container::open(bytes)?;
    let document: Document = serde_json::from_slice(container.json).map_err(|error| {
        if container.start == 0 {
            let what = error.to_string();
            let what = what.rsplit_once(" at line ").map_or(&what[..], |(what, _)| what).to_owned();
            Problem::line(error.line(), format!("{what} (column {})", error.column()))
        } else {
            Problem::byte(container.start, format!("in the JSON that starts here, {error}"))
        }
    })?;
    if !document.asset.version.starts_with("2.") {
        let version = &document.asset.version;
        let what = format!("the version of the file is {version:?}, and \"2.0\" is what is read");
        return Err(Problem::part("asset", what));
    }
    let unknown = |name: &&String| !UNDERSTOOD.contains(&&name[..]) && !name.starts_with("KHR_materials_");
    if let Some(name) = document.extensions_required.iter().find(unknown) {
        let what =
            format!("the file needs {name:?}, which is not read; export it without (compression, as a rule)");
        return Err(Problem::part("extensionsRequired", what));
    }
    let buffers = buffers(&document, container.binary, files)?;
    let reader = Reader { document: &document, buffers, notes: BTreeSet::new() };
    reader.parts(notes)
}

/// The bytes of all buffers, which are there.
fn buffers<'a>(
    document: &Document,
    binary: Option<&'a [u8]>,
    files: &Companions<'_>,
) -> Outcome<Vec<Cow<'a, [u8]>>> {
    let mut buffers: Vec<Cow<'a, [u8]>> = Vec::new();
    let mut sum = 0usize;
    for (number, buffer) in document.buffers.iter().enumerate() {
        let wrong = |what: String| Problem::part(format!("buffers[{number}]"), what);
        let bytes: Cow<'a, [u8]> = match (&buffer.uri, binary) {
            (None, Some(binary)) if number == 0 => Cow::Borrowed(binary),
            (None, _) => return Err(wrong("it has no uri, and the file has no chunk `BIN` for it".into())),
            (Some(uri), _) if uri.starts_with("data:") => Cow::Owned(container::data(uri).map_err(wrong)?),
            (Some(uri), _) => {
                let path = container::path(uri).ok_or_else(|| wrong(format!("{uri:?} is no path")))?;
                let read = files(&path);
                Cow::Owned(read.map_err(|reason| wrong(format!("cannot read {path:?}: {reason}")))?)
            }
        };
        if bytes.len() < buffer.byte_length {
            let what = format!("its byteLength is {}, but it has {} bytes", buffer.byte_length, bytes.len());
            return Err(wrong(what));
        }
        sum = sum.saturating_add(bytes.len());
        if sum > MOST_BYTES {
            return Err(wrong(format!(
                "the buffers have more than {MOST_BYTES} bytes together, the most that is read"
            )));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}

struct Reader<'a> {
    document: &'a Document,
    buffers: Vec<Cow<'a, [u8]>>,
    notes: BTreeSet<&'static str>,
}

/// The accessors that a mesh is made of, and how: equal ones make equal meshes.
type Source = (Option<usize>, [Option<usize>; 4], u32);

impl Reader<'_> {
    fn parts(mut self, notes: &mut Vec<String>) -> Outcome<Vec<ModelPart>> {
        let document = self.document;
        let roots = self.roots()?;
        let mut seen = vec![false; document.nodes.len()];
        let mut left: Vec<(usize, Option<DAffine3>)> =
            roots.into_iter().rev().map(|node| (node, None)).collect();
        let mut meshes: BTreeMap<Source, Arc<Mesh>> = BTreeMap::new();
        let mut materials: BTreeMap<usize, Arc<ModelMaterial>> = BTreeMap::new();
        let mut parts = Vec::new();
        // What meshes may take together: the most that the bytes of the file can amount to without being read again and
        // again.
        let bytes: usize = self.buffers.iter().map(|buffer| buffer.len()).sum();
        let mut budget = bytes.saturating_mul(16).saturating_add(1 << 28);
        while let Some((number, above)) = left.pop() {
            let place = format!("nodes[{number}]");
            let Some(node) = document.nodes.get(number) else {
                let what =
                    format!("there is no such node; there are {}, counted from 0", document.nodes.len());
                return Err(Problem::part(place, what));
            };
            if std::mem::replace(seen.get_mut(number).unwrap_or(&mut false), true) {
                return Err(Problem::part(place, "it is the child of more than one node, or of itself"));
            }
            let transform = match (above, placement(node)) {
                (Some(above), Some(own)) => Some(above * own),
                (above, own) => above.or(own),
            };
            left.extend(node.children.iter().rev().map(|child| (*child, transform)));
            let Some(mesh) = node.mesh else { continue };
            if transform.is_some_and(|t| !t.is_finite() || t.matrix3.determinant() == 0.0) {
                self.notes.insert("nodes that make their mesh flat, as with a scale of 0, are left out");
                continue;
            }
            if node.skin.is_some() {
                self.notes.insert("skins are not read: what they move is in its place of rest");
            }
            let Some(found) = document.meshes.get(mesh) else {
                let count = document.meshes.len();
                let what = format!("it names mesh {mesh}, but there are {count}, counted from 0");
                return Err(Problem::part(place, what));
            };
            for (index, primitive) in found.primitives.iter().enumerate() {
                let place = format!("meshes[{mesh}].primitives[{index}]");
                let Some(shape) = self.mesh(primitive, &place, &mut meshes, &mut budget)? else { continue };
                let name = if node.name.is_empty() { found.name.clone() } else { node.name.clone() };
                let material = primitive.material.map(|number| self.material(number, &place, &mut materials));
                let material = material.transpose()?;
                parts.push(ModelPart { name, mesh: shape, transform, material });
                if parts.len() > MOST_PARTS {
                    return Err(Problem::part(place, format!("there are more than {MOST_PARTS} parts")));
                }
            }
        }
        notes.extend(self.notes.into_iter().map(str::to_owned));
        Ok(parts)
    }

    /// The nodes of the scene that is shown; where there are no scenes, those that are nobody's children.
    fn roots(&self) -> Outcome<Vec<usize>> {
        let document = self.document;
        let number = document.scene.unwrap_or(0);
        if let Some(scene) = document.scenes.get(number) {
            return Ok(scene.nodes.clone());
        }
        if document.scene.is_some() {
            let count = document.scenes.len();
            let what = format!("it is {number}, but there are {count} scenes, counted from 0");
            return Err(Problem::part("scene", what));
        }
        let children: BTreeSet<usize> =
            document.nodes.iter().flat_map(|node| &node.children).copied().collect();
        Ok((0..document.nodes.len()).filter(|node| !children.contains(node)).collect())
    }

    /// The mesh of a primitive; none where it has no triangles.
    fn mesh(
        &mut self,
        primitive: &json::Primitive,
        place: &str,
        known: &mut BTreeMap<Source, Arc<Mesh>>,
        budget: &mut usize,
    ) -> Outcome<Option<Arc<Mesh>>> {
        let mode = primitive.mode.unwrap_or(4);
        if mode < 4 {
            self.notes.insert("points and lines are not shown");
            return Ok(None);
        }
        if mode > 6 {
            return Err(Problem::part(place, format!("there is no mode {mode}")));
        }
        if !primitive.targets.is_empty() {
            self.notes.insert("morph targets are not read");
        }
        let attributes = ["POSITION", "NORMAL", "TEXCOORD_0", "COLOR_0"]
            .map(|name| primitive.attributes.get(name).copied());
        let Some(position) = attributes[0] else {
            // Allowed, and then there is nothing to see.
            return Ok(None);
        };
        let source = (primitive.indices, attributes, mode);
        if let Some(mesh) = known.get(&source) {
            return Ok(Some(mesh.clone()));
        }
        let positions = self.array(position, &["VEC3"], place)?;
        let count = positions.count;
        let corners = match primitive.indices {
            None => (0..u32::try_from(count).unwrap_or(u32::MAX)).collect(),
            Some(indices) => {
                let array = self.array(indices, &["SCALAR"], place)?;
                spend(budget, array.count.saturating_mul(16), place)?;
                let corners: Vec<u32> = (0..array.count).map(|index| array.index(index)).collect();
                let wrong = corners.iter().position(|corner| *corner as usize >= count);
                if let Some(at) = wrong {
                    let corner = corners.get(at).copied().unwrap_or_default();
                    let what = format!(
                        "index {at} of accessors[{indices}] is {corner}, but there are {count} vertices"
                    );
                    return Err(Problem::part(place, what));
                }
                corners
            }
        };
        // Buffers are often shared: only the vertices that are used are taken.
        let mut used: Vec<u32> = corners.clone();
        used.sort_unstable();
        used.dedup();
        spend(budget, used.len().saturating_mul(48), place)?;
        let numbers: Vec<u32> = if used.len() == count {
            corners
        } else {
            corners.iter().map(|corner| used.partition_point(|vertex| vertex < corner) as u32).collect()
        };
        let take = |attribute: Option<usize>, kinds: &[&str]| {
            let array = attribute.map(|accessor| self.array(accessor, kinds, place)).transpose()?;
            match array {
                Some(array) if array.count < count => {
                    let what =
                        format!("an attribute has {} elements, but there are {count} vertices", array.count);
                    Err(Problem::part(place, what))
                }
                array => Ok(array),
            }
        };
        let normals = take(attributes[1], &["VEC3"])?;
        let uvs = take(attributes[2], &["VEC2"])?;
        let colors = take(attributes[3], &["VEC3", "VEC4"])?;
        let used = || used.iter().map(|vertex| *vertex as usize);
        let mut polygons = Polygons {
            positions: used().map(|vertex| positions.floats(vertex)).collect(),
            normals: normals.iter().flat_map(|array| used().map(|vertex| array.floats(vertex))).collect(),
            // Their v leads down.
            uvs: uvs
                .iter()
                .flat_map(|array| used().map(|vertex| array.floats(vertex)))
                .map(|[u, v]| [u, 1.0 - v])
                .collect(),
            colors: colors.iter().flat_map(|array| used().map(|vertex| array.floats(vertex))).collect(),
            triangles: Vec::new(),
        };
        match mode {
            5 => polygons.strip(&numbers),
            6 => polygons.polygon(&numbers),
            _ => polygons.triangles.extend(numbers.as_chunks::<3>().0),
        }
        if polygons.is_full() {
            return Err(Problem::part(place, too_many()));
        }
        let mesh = polygons.mesh().map_err(|problem| Problem::part(place, problem.to_string()))?;
        let mesh = Arc::new(mesh);
        known.insert(source, mesh.clone());
        Ok(Some(mesh))
    }

    fn material(
        &mut self,
        number: usize,
        user: &str,
        known: &mut BTreeMap<usize, Arc<ModelMaterial>>,
    ) -> Outcome<Arc<ModelMaterial>> {
        if let Some(material) = known.get(&number) {
            return Ok(material.clone());
        }
        let Some(found) = self.document.materials.get(number) else {
            let count = self.document.materials.len();
            let what = format!("it names material {number}, but there are {count}, counted from 0");
            return Err(Problem::part(user, what));
        };
        let surface = found.pbr_metallic_roughness.as_ref();
        let [r, g, b, alpha] = surface.and_then(|surface| surface.base_color_factor).unwrap_or([1.0; 4]);
        if surface.is_some_and(|surface| surface.base_color_texture.is_some()) {
            self.notes.insert("the images that materials name are not read");
        }
        let emission = found.emissive_factor.unwrap_or_default();
        // Numbers in JSON are finite, but can be anything else.
        let share = |x: f64| x.clamp(0.0, 1.0);
        let material = Arc::new(ModelMaterial {
            name: found.name.clone(),
            base_color: Rgb::new(share(r), share(g), share(b)),
            emission: Rgb::from(emission.map(|x| x.max(0.0))),
            opacity: if found.alpha_mode.as_deref() == Some("BLEND") { share(alpha) } else { 1.0 },
        });
        known.insert(number, material.clone());
        Ok(material)
    }
}

fn spend(budget: &mut usize, bytes: usize, place: &str) -> Outcome<()> {
    let left = budget.checked_sub(bytes);
    let what =
        "the file uses the same numbers for so many meshes that they would take far more memory than it";
    *budget = left.ok_or_else(|| Problem::part(place, what))?;
    Ok(())
}

/// Where a node places what is in it; none where it does not move it.
fn placement(node: &json::Node) -> Option<DAffine3> {
    if let Some(matrix) = &node.matrix {
        let column = |at: usize| DVec3::new(matrix[at], matrix[at + 1], matrix[at + 2]);
        let columns = DMat3::from_cols(column(0), column(4), column(8));
        return Some(DAffine3::from_mat3_translation(columns, column(12)))
            .filter(|t| *t != DAffine3::IDENTITY);
    }
    let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    // Of a quaternion of length 1; of others the direction.
    let s = 2.0 / (x * x + y * y + z * z + w * w);
    let rotation = DMat3::from_cols(
        DVec3::new(1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)),
        DVec3::new(s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)),
        DVec3::new(s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)),
    );
    let scale = DMat3::from_diagonal(DVec3::from(node.scale.unwrap_or([1.0; 3])));
    let translation = DVec3::from(node.translation.unwrap_or_default());
    Some(DAffine3::from_mat3_translation(rotation * scale, translation)).filter(|t| *t != DAffine3::IDENTITY)
}
