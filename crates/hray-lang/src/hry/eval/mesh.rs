//! Meshes: from files, and from lists of points and faces.

use super::compile::internal;
use super::construct::Fields;
use super::failure::{Failure, Outcome};
use super::limits::Charge;
use super::machine::{Machine, depends_on_hit};
use super::value::{Given, ListValue, MaterialValue, ShapeNode, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::library::constructor;
use crate::hry::program::missing_asset;
use glam::DAffine3;
use hray_core::{Mesh, Model, ModelMaterial, ModelPart, Rgb, Shape};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::Arc;

/// Where normals are worked out, edges between triangles that are turned by more than this against each other stay sharp:
/// the cosine of 40 degrees.
const COS_CREASE: f64 = 0.766_044_443_118_978;

/// A model as shapes are made of it.
pub(super) struct Prepared {
    parts: Vec<PreparedPart>,
    _charge: Charge,
}

struct PreparedPart {
    mesh: Arc<Mesh>,
    transform: Option<Arc<DAffine3>>,
    material: Option<Arc<MaterialValue>>,
}

impl Machine<'_> {
    /// The model in a file, read once, with the normals that were asked for, made once.
    fn model(&mut self, written: &str, smooth: Option<bool>, span: Span) -> Outcome<Arc<Prepared>> {
        let path = self.asset_path(written, span)?;
        let key = (path, smooth);
        if let Some(prepared) = self.models.get(&key) {
            return Ok(prepared.clone());
        }
        let path = &key.0;
        let model = self.assets.model(path);
        let model = model.map_err(|error| Failure::new(missing_asset(self.assets, path, span, &error)))?;
        for note in &model.notes {
            self.warn(not_read(format!("{path:?}: {note}"), span));
        }
        let prepared = Arc::new(self.prepare(&model, smooth, span)?);
        if prepared.parts.is_empty() {
            self.warn(not_read(format!("{path:?} has no triangles, so there is nothing to see"), span));
        }
        self.models.insert(key, prepared.clone());
        Ok(prepared)
    }

    fn prepare(&mut self, model: &Model, smooth: Option<bool>, span: Span) -> Outcome<Prepared> {
        let mut meshes: BTreeMap<*const Mesh, Arc<Mesh>> = BTreeMap::new();
        let mut materials: BTreeMap<*const ModelMaterial, Arc<MaterialValue>> = BTreeMap::new();
        let mut parts = Vec::new();
        // Before anything is made of it.
        let mut charge = self.meter.charge(model.bytes() as u64);
        self.check_memory(span)?;
        let filled = |part: &&ModelPart| !part.mesh.triangles().is_empty();
        for ModelPart { mesh, transform, material, .. } in model.parts.iter().filter(filled) {
            self.step(span)?;
            let made = meshes.entry(Arc::as_ptr(mesh)).or_insert_with(|| with_normals(mesh, smooth)).clone();
            let material = match material {
                None => None,
                Some(material) => Some(match materials.entry(Arc::as_ptr(material)) {
                    Entry::Occupied(known) => known.get().clone(),
                    Entry::Vacant(place) => place.insert(Arc::new(material_of(material, span)?)).clone(),
                }),
            };
            parts.push(PreparedPart { mesh: made, transform: transform.map(Arc::new), material });
        }
        if smooth.is_some() {
            let made: usize = meshes.values().map(|mesh| mesh.bytes()).sum();
            charge = self.meter.charge((model.bytes() + made) as u64);
            self.check_memory(span)?;
        }
        Ok(Prepared { parts, _charge: charge })
    }
}

fn not_read(message: String, span: Span) -> Diagnostic {
    let mut warning = Diagnostic::error("not-read", message, span, "of this file");
    warning.severity = crate::diagnostic::Severity::Warning;
    warning
}

/// A mesh with the normals that were asked for: none, or some in any case.
fn with_normals(mesh: &Arc<Mesh>, smooth: Option<bool>) -> Arc<Mesh> {
    match smooth {
        Some(true) if mesh.normals().is_empty() => Arc::new(mesh.smoothed(COS_CREASE)),
        Some(false) if !mesh.normals().is_empty() => Arc::new(mesh.faceted()),
        _ => mesh.clone(),
    }
}

/// What a model says of a material, as `classic` would make it.
fn material_of(material: &ModelMaterial, span: Span) -> Outcome<MaterialValue> {
    let table = constructor("classic").ok_or_else(|| internal(span, "a table without `classic`"))?;
    let ModelMaterial { base_color, emission, opacity, .. } = material;
    let mut given = vec![("color", Value::Color(base_color.to_array()))];
    if *emission != Rgb::BLACK {
        given.push(("glow", Value::Color(emission.to_array())));
    }
    if *opacity < 1.0 {
        // Seen through without being bent: it is not known to be solid.
        given.extend([("transparency", Value::Number(1.0 - opacity)), ("ior", Value::Number(1.0))]);
    }
    let mut fields: Vec<Option<Given>> = table.fields.iter().map(|_| None).collect();
    for (name, value) in given {
        if let Some(slot) = table.field(name).and_then(|(place, _)| fields.get_mut(place)) {
            *slot = Some(Given { value, span });
        }
    }
    Ok(MaterialValue { fields, span })
}

impl Fields<'_, '_> {
    /// `mesh { ... }`
    pub(super) fn mesh(mut self, material: Option<Arc<MaterialValue>>) -> Outcome<Value> {
        let smooth = self.smooth()?;
        let (file, span) = self.value("file")?;
        let Value::Text(file) = file else {
            return Err(internal(span, &format!("{} in the field `file`", file.describe())).into());
        };
        let whole = self.span;
        let machine = self.machine();
        let prepared = machine.model(&file.text, smooth, span)?;
        let origin = machine.origin(whole);
        let mut shapes = Vec::with_capacity(prepared.parts.len());
        for part in &prepared.parts {
            machine.step(whole)?;
            let shape = Shape::Mesh(part.mesh.clone());
            let material = material.clone().or_else(|| part.material.clone());
            let leaf = Machine::shape(ShapeNode::Leaf { shape, material, origin }, 0, whole)?;
            shapes.push(match (&part.transform, &leaf) {
                (Some(transform), Value::Shape(shape)) => {
                    let node = ShapeNode::Placed { transform: transform.clone(), shape: shape.clone() };
                    Machine::shape(node, 0, whole)?
                }
                _ => leaf,
            });
        }
        if shapes.len() == 1 {
            return shapes.pop().ok_or_else(|| internal(whole, "a shape that is gone").into());
        }
        match machine.list(shapes, whole)? {
            Value::List(list) => Machine::shape(ShapeNode::Group(list), 1, whole),
            other => Err(internal(whole, &format!("{} of parts", other.describe())).into()),
        }
    }

    fn smooth(&mut self) -> Outcome<Option<bool>> {
        match self.optional("smooth") {
            None => Ok(None),
            Some(Given { value: Value::Bool(smooth), .. }) => Ok(Some(smooth)),
            Some(Given { value: Value::Symbolic(_), span }) => Err(depends_on_hit("`smooth`", span)),
            Some(Given { value, span }) => {
                Err(internal(span, &format!("{} in the field `smooth`", value.describe())).into())
            }
        }
    }

    /// `triangles { ... }`
    pub(super) fn triangles(mut self, material: Option<Arc<MaterialValue>>) -> Outcome<Value> {
        let smooth = self.smooth()?;
        let (points, points_span) = self.items("points")?;
        let (faces, faces_span) = self.items("faces")?;
        let given =
            |fields: &mut Self, name: &str| fields.optional(name).map(|_| fields.items(name)).transpose();
        let normals = given(&mut self, "normals")?;
        let uvs = given(&mut self, "uvs")?;
        let whole = self.span;
        let machine = self.machine();
        let triangles = count_triangles(&faces, faces_span)?;
        let per_vertex = 12 * (1 + usize::from(normals.is_some())) + 8 * usize::from(uvs.is_some());
        let bytes = 12 * triangles + per_vertex * points.items.len();
        // Normals that are worked out can double every vertex at each of its corners.
        let more = if smooth == Some(true) && normals.is_none() { 2 * bytes + 72 * triangles } else { 0 };
        let charge = machine.meter.charge((bytes + more) as u64);
        machine.check_memory(whole)?;

        let positions = machine.vectors::<3>(&points, "points", points_span)?;
        let mut made: Vec<[u32; 3]> = Vec::with_capacity(triangles);
        let mut corners: Vec<u32> = Vec::new();
        for (number, face) in faces.items.iter().enumerate() {
            let Value::List(face) = face else {
                return Err(internal(faces_span, "a face that is no list").into());
            };
            corners.clear();
            for (corner, value) in face.items.iter().enumerate() {
                machine.step(faces_span)?;
                let n = machine.known(value, "a corner of a face", faces_span)?;
                if n.fract() != 0.0 || !(0.0..positions.len() as f64).contains(&n) {
                    let message = format!(
                        "corner {corner} of face {number} is point {n}, but there are {} points, counted from 0",
                        positions.len()
                    );
                    let error = Diagnostic::error("no-such-point", message, faces_span, "in these faces");
                    return Err(Failure::new(error.with_help("faces and corners are counted from 0, too")));
                }
                corners.push(n as u32);
            }
            if let [first, rest @ ..] = &corners[..] {
                made.extend(rest.windows(2).filter_map(|pair| match *pair {
                    [b, c] => Some([*first, b, c]),
                    _ => None,
                }));
            }
        }
        let mut mesh = Mesh::new(positions, made).map_err(|error| wrong_mesh(&error, whole))?;
        if let Some((normals, span)) = normals {
            let normals = machine.vectors::<3>(&normals, "normals", span)?;
            mesh = mesh.with_normals(normals).map_err(|error| wrong_mesh(&error, span))?;
        }
        if let Some((uvs, span)) = uvs {
            let uvs = machine.vectors::<2>(&uvs, "uvs", span)?;
            mesh = mesh.with_uvs(uvs).map_err(|error| wrong_mesh(&error, span))?;
        }
        let shape = Shape::Mesh(with_normals(&Arc::new(mesh), smooth));
        let origin = machine.origin(whole);
        Machine::charged_shape(ShapeNode::Leaf { shape, material, origin }, 0, Some(charge), whole)
    }

    fn items(&mut self, name: &str) -> Outcome<(Arc<ListValue>, Span)> {
        match self.value(name)? {
            (Value::List(list), span) => Ok((list, span)),
            (other, span) => {
                Err(internal(span, &format!("{} in the field `{name}`", other.describe())).into())
            }
        }
    }
}

/// How many triangles faces come to, each of which has three corners or more.
fn count_triangles(faces: &ListValue, span: Span) -> Outcome<usize> {
    let mut count = 0usize;
    for (number, face) in faces.items.iter().enumerate() {
        let Value::List(face) = face else { return Err(internal(span, "a face that is no list").into()) };
        let corners = face.items.len();
        if corners < 3 {
            let message = format!("face {number} has {corners} corners, and a face has three or more");
            let error = Diagnostic::error("too-few-corners", message, span, "in these faces");
            return Err(Failure::new(error.with_help("faces are counted from 0")));
        }
        count = count.saturating_add(corners - 2);
    }
    if count > Mesh::MOST_TRIANGLES {
        let error = hray_core::MeshError::TooMany { triangles: count };
        return Err(wrong_mesh(&error, span));
    }
    Ok(count)
}

fn wrong_mesh(error: &hray_core::MeshError, span: Span) -> Box<Failure> {
    Failure::new(Diagnostic::error("wrong-mesh", error.to_string(), span, "these do not make a mesh"))
}

impl Machine<'_> {
    /// Vectors in single precision.
    fn vectors<const N: usize>(
        &mut self,
        list: &ListValue,
        name: &str,
        span: Span,
    ) -> Outcome<Vec<[f32; N]>> {
        let mut vectors = Vec::with_capacity(list.items.len());
        for (number, item) in list.items.iter().enumerate() {
            self.step(span)?;
            let numbers: &[f64] = match item {
                Value::Vec3(v) => v,
                Value::Vec2(v) => v,
                Value::Symbolic(_) => {
                    return Err(depends_on_hit(&format!("the field `{name}` of `triangles`"), span));
                }
                other => return Err(internal(span, &format!("{} in `{name}`", other.describe())).into()),
            };
            let vector = std::array::from_fn(|place| numbers.get(place).copied().unwrap_or(0.0) as f32);
            if !vector.iter().all(|x: &f32| x.is_finite()) {
                let message = format!(
                    "number {number} of `{name}`, counted from 0, is {}, and must be finite in single precision",
                    self.show(item, 60)
                );
                return Err(Failure::new(Diagnostic::error("out-of-range", message, span, "in this list")));
            }
            vectors.push(vector);
        }
        Ok(vectors)
    }
}
