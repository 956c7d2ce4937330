//! From the value of `scene` to a description.

use super::compile::internal;
use super::construct::Fields;
use super::failure::{Failure, Outcome};
use super::limits::Limits;
use super::lints::Places;
use super::machine::Machine;
use super::origins::{Flat, Origins};
use super::texture::Compiled;
use super::value::{Given, LightValue, MaterialValue, ShapeNode, ShapeValue, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::assets::Assets;
use crate::hry::library::{Constructor, constructor};
use crate::hry::program::{Global, Program};
use glam::{DAffine3, DVec3};
use hray_core::{
    Background, Clip, Csg, CsgOperation, Description, Field, Material, Primitive, Quadric, Resolution, Rgb,
    Scene, Shape, Texture,
};
use std::collections::HashMap;
use std::num::NonZeroU32;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The most primitives of a scene.
const MOST_PRIMITIVES: usize = 100_000_000;

/// What came of evaluating a program.
#[derive(Clone, Debug, Default)]
pub struct Evaluated {
    /// The scene; none where there are errors.
    pub description: Option<Description>,
    /// Where its objects and lights were made.
    pub origins: Origins,
    /// Errors, and warnings about values.
    pub diagnostics: Vec<Diagnostic>,
    /// Whether `scene` is a function of the time.
    pub animated: bool,
}

/// Evaluates programs that were checked without errors. What does not depend on the time is worked out once, however many
/// moments are asked for.
pub struct Evaluator<'a> {
    machine: Machine<'a>,
}

impl std::fmt::Debug for Evaluator<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Evaluator").finish_non_exhaustive()
    }
}

/// Evaluates a program that was checked without errors, at a time in seconds.
#[must_use]
pub fn evaluate(program: &Program, assets: &dyn Assets, time: f64, limits: &Limits) -> Evaluated {
    Evaluator::new(program, assets, limits).at(time)
}

impl<'a> Evaluator<'a> {
    /// An evaluation of `program` within `limits`; each moment has the steps anew.
    #[must_use]
    pub fn new(program: &'a Program, assets: &'a dyn Assets, limits: &Limits) -> Self {
        Self { machine: Machine::new(program, assets, *limits) }
    }

    /// The same, ended with an error soon after `stop` is set, which another thread may do.
    #[must_use]
    pub fn stopped_by(mut self, stop: &'a AtomicBool) -> Self {
        self.machine.stop = Some(stop);
        self
    }

    /// The scene at a time in seconds.
    #[must_use]
    pub fn at(&mut self, time: f64) -> Evaluated {
        (self.machine.time, self.machine.steps) = (time, 0);
        let result = self.machine.scene();
        let mut diagnostics = std::mem::take(&mut self.machine.warnings);
        match result {
            Ok((description, origins, animated)) => {
                Evaluated { description: Some(description), origins, diagnostics, animated }
            }
            Err(failure) => {
                diagnostics.push(failure.into_diagnostic(|span| self.machine.place(span)));
                Evaluated { diagnostics, ..Evaluated::default() }
            }
        }
    }
}

/// Materials that were compiled already, by the values they were made of. Only looked up.
#[derive(Default)]
struct Materials {
    known: HashMap<usize, (Arc<MaterialValue>, Arc<Material>)>,
    plain: Option<Arc<Material>>,
}

impl Machine<'_> {
    fn scene(&mut self) -> Outcome<(Description, Origins, bool)> {
        let module = self.program.root;
        let found = self.program.root().and_then(|root| root.scope.names.get("scene").copied());
        let index = match found {
            Some(Global::Definition { module: of, index }) if of == module => index,
            _ => {
                return Err(Failure::new(
                    Diagnostic::error("no-scene", "the file does not define `scene`", Span::at(0), "")
                        .with_help("what is rendered is the definition `scene`; for example:\n\n    scene = { objects = [ sphere {} ], lights = [ point { position = (3, 4, 5) } ] }"),
                ));
            }
        };
        let span =
            self.program.definition(module, index).map_or(Span::at(0), |definition| definition.target.span);
        let mut value = self.global(module, index, span)?;
        let animated = matches!(value, Value::Function(_));
        if animated {
            value = self.apply_value(&value, &[Value::Number(self.time)], span)?;
        }
        let Value::Record(record) = value else {
            return Err(internal(span, "a scene that is not a record").into());
        };
        let table: &'static Constructor =
            constructor("scene").ok_or_else(|| internal(span, "a table without the scene"))?;
        let mut given = self.given(table, &record, span)?;
        self.place_fields(module, index, table, &mut given);
        let (description, origins) = self.describe(table, given, span)?;
        Ok((description, origins, animated))
    }

    /// Where the scene is written out as a record, its fields have places of their own.
    fn place_fields(&self, module: usize, index: usize, table: &Constructor, given: &mut [Option<Given>]) {
        use crate::hry::ast::ExprKind;
        let Some(definition) = self.program.definition(module, index) else { return };
        let mut body = &definition.body;
        while let ExprKind::Let { body: inner, .. } = &body.kind {
            body = inner;
        }
        let fields = match &body.kind {
            ExprKind::Record(fields) | ExprKind::Update { fields, .. } => fields,
            _ => return,
        };
        for field in fields {
            let place = table.field(&field.name.text).map(|(place, _)| place);
            if let Some(Some(given)) = place.and_then(|place| given.get_mut(place)) {
                given.span = field.value.span;
            }
        }
    }

    fn describe(
        &mut self,
        table: &'static Constructor,
        given: Vec<Option<Given>>,
        span: Span,
    ) -> Outcome<(Description, Origins)> {
        let time = self.time;
        let background = {
            let place = table.field("background").map(|(place, _)| place);
            place.and_then(|place| given.get(place).cloned().flatten())
        };
        let background = match background {
            Some(given @ Given { value: Value::Function(_), .. }) => match self.sky(&given)? {
                Compiled::Constant(color) => Some(Background::Uniform(Rgb::from(color))),
                Compiled::Function(function) => Some(Background::Function(function)),
            },
            _ => None,
        };
        let mut fields = Fields::new(self, table, given, span);
        let [width, height] = fields.pair("size")?;
        let size_span = fields.optional("size").map_or(span, |given| given.span);
        let resolution = Resolution::new(width as i64, height as i64).map_err(|error| {
            Failure::new(Diagnostic::error("out-of-range", error.to_string(), size_span, "this size"))
        })?;
        let place = |name| fields.optional(name).map_or(span, |given| given.span);
        let places = Places {
            lights: place("lights"),
            camera: place("camera"),
            depth: place("depth"),
            objects: place("objects"),
        };
        let max_depth = fields.number("depth")? as i32;
        let samples = NonZeroU32::new(fields.number("samples")? as u32).unwrap_or(NonZeroU32::MIN);
        let wrong = |value: &Value| internal(span, &format!("{} in the scene", value.describe()));
        let integrator = match fields.value("integrator")?.0 {
            Value::Integrator(integrator) => integrator,
            other => return Err(wrong(&other).into()),
        };
        let encoding = match fields.value("encoding")?.0 {
            Value::Encoding(encoding) => encoding,
            other => return Err(wrong(&other).into()),
        };
        let camera = match fields.value("camera")?.0 {
            Value::Camera(camera) => *camera,
            other => return Err(wrong(&other).into()),
        };
        let background = match background {
            Some(background) => background,
            None => Background::Uniform(fields.color("background")?),
        };
        let lights: Vec<LightValue> = match fields.value("lights")?.0 {
            Value::List(list) => list
                .items
                .iter()
                .map(|item| match item {
                    Value::Light(light) => Ok(**light),
                    other => Err(wrong(other).into()),
                })
                .collect::<Outcome<_>>()?,
            other => return Err(wrong(&other).into()),
        };
        let objects = match fields.value("objects")?.0 {
            Value::List(list) => list,
            other => return Err(wrong(&other).into()),
        };
        drop(fields);
        let mut flat = Flat::default();
        flat.primitives.reserve(objects.items.len());
        flat.origins.reserve(objects.items.len());
        let mut materials = Materials::default();
        for item in &objects.items {
            match item {
                Value::Shape(shape) => self.flatten(shape, None, None, &mut materials, &mut flat, span)?,
                other => return Err(wrong(other).into()),
            }
        }
        let Flat { primitives, origins, parts } = flat;
        let light_origins = lights.iter().map(|light| light.origin).collect();
        let origins = Origins::new(&self.places, origins, parts, light_origins);
        let lights = lights.iter().map(|light| light.light).collect();
        let scene = Scene { camera, background, primitives, lights, time };
        let description = Description { resolution, max_depth, samples, integrator, encoding, scene };
        self.lint(&description, &origins, places);
        Ok((description, origins))
    }

    /// Adds the primitives that a shape consists of.
    fn flatten(
        &mut self,
        shape: &ShapeValue,
        transform: Option<&Arc<DAffine3>>,
        material: Option<&Arc<MaterialValue>>,
        materials: &mut Materials,
        into: &mut Flat,
        span: Span,
    ) -> Outcome<()> {
        self.step(span)?;
        match &shape.node {
            ShapeNode::Leaf { shape, material: own, origin } => {
                if into.primitives.len() >= MOST_PRIMITIVES {
                    let message = format!("the scene has more than {MOST_PRIMITIVES} objects");
                    return Err(Failure::new(Diagnostic::error(
                        "too-many-objects",
                        message,
                        span,
                        "this scene",
                    )));
                }
                let material = self.material_of(own.as_ref().or(material), materials)?;
                let primitive = Primitive { shape: shape.clone(), transform: transform.cloned(), material };
                into.push(primitive, *origin, Vec::new());
            }
            ShapeNode::Csg { operation, operands: [left, right], origin } => {
                let left = self.operand(left, material, materials, span)?;
                let right = self.operand(right, material, materials, span)?;
                let (shape, parts) = match (left, right) {
                    (Some((left, mut parts)), Some((right, more))) => {
                        parts.extend(more);
                        let csg = Csg { operation: *operation, operands: [left, right] };
                        (Shape::Csg(Arc::new(csg)), parts)
                    }
                    // With nothing, a union or a difference leaves what there is.
                    (Some(only), None) if *operation != CsgOperation::Intersection => {
                        return Self::add_operand(only, *origin, transform, into);
                    }
                    (None, Some(only)) if *operation == CsgOperation::Union => {
                        return Self::add_operand(only, *origin, transform, into);
                    }
                    _ => return Ok(()),
                };
                let material = self.material_of(None, materials)?;
                into.push(Primitive { shape, transform: transform.cloned(), material }, *origin, parts);
            }
            ShapeNode::Inverse { solid, origin } => {
                let (shape, parts) = match self.operand(solid, material, materials, span)? {
                    Some((solid, parts)) => (Shape::Inverse(Arc::new(solid)), parts),
                    // What is everywhere, without a surface.
                    None => {
                        let [square, product, linear] = [DVec3::ZERO; 3];
                        let everything = Quadric { square, product, linear, constant: -1.0 };
                        (Shape::Quadric(Arc::new(everything)), Vec::new())
                    }
                };
                let material = self.material_of(None, materials)?;
                into.push(Primitive { shape, transform: transform.cloned(), material }, *origin, parts);
            }
            ShapeNode::Clip { within, shape, origin } => {
                // Within nothing there is nothing.
                let Some((within, more)) = self.operand(within, material, materials, span)? else {
                    return Ok(());
                };
                let mut flat = Flat::default();
                self.flatten(shape, None, material, materials, &mut flat, span)?;
                let plain = self.material_of(None, materials)?;
                for (i, shape) in flat.primitives.into_iter().enumerate() {
                    let mut parts = flat.parts.remove(&i).unwrap_or_else(|| vec![flat.origins[i]]);
                    for part in &more {
                        self.step(span)?;
                        parts.push(*part);
                    }
                    let shape = Shape::Clip(Arc::new(Clip { shape, within: within.clone() }));
                    let clipped = Primitive { shape, transform: transform.cloned(), material: plain.clone() };
                    into.push(clipped, *origin, parts);
                }
            }
            ShapeNode::Group(list) => {
                for item in &list.items {
                    if let Value::Shape(shape) = item {
                        self.flatten(shape, transform, material, materials, into, span)?;
                    }
                }
            }
            ShapeNode::Placed { transform: inner, shape } => {
                let whole = transform.map_or_else(|| inner.clone(), |outer| Arc::new(**outer * **inner));
                self.flatten(shape, Some(&whole), material, materials, into, span)?;
            }
            ShapeNode::Painted { material: outer, shape } => {
                // The innermost paint wins: it was there first.
                self.flatten(shape, transform, Some(outer), materials, into, span)?;
            }
        }
        Ok(())
    }

    fn add_operand(
        (operand, parts): (Primitive, Vec<u32>),
        origin: u32,
        transform: Option<&Arc<DAffine3>>,
        into: &mut Flat,
    ) -> Outcome<()> {
        let whole = match (transform, &operand.transform) {
            (Some(outer), Some(inner)) => Some(Arc::new(**outer * **inner)),
            (Some(outer), None) => Some(outer.clone()),
            (None, inner) => inner.clone(),
        };
        let operand = Primitive { transform: whole, ..operand };
        match (&operand.shape, &parts[..]) {
            (shape, _) if shape.is_made_of_others() => into.push(operand, origin, parts),
            (_, [only]) => into.push(operand, *only, Vec::new()),
            _ => into.push(operand, origin, Vec::new()),
        }
        Ok(())
    }

    /// A shape as one primitive, the union of what it consists of, and the places that made its parts. None where that is
    /// nothing.
    fn operand(
        &mut self,
        shape: &ShapeValue,
        material: Option<&Arc<MaterialValue>>,
        materials: &mut Materials,
        span: Span,
    ) -> Outcome<Option<(Primitive, Vec<u32>)>> {
        let mut flat = Flat::default();
        self.flatten(shape, None, material, materials, &mut flat, span)?;
        let leaves = flat.leaves();
        let mut all = flat.primitives;
        // A balanced tree, so that many do not nest deeply; the order stays.
        while all.len() > 1 {
            let mut joined = Vec::with_capacity(all.len().div_ceil(2));
            let mut rest = all.into_iter();
            while let Some(left) = rest.next() {
                joined.push(match rest.next() {
                    None => left,
                    Some(right) => {
                        let material = left.material.clone();
                        let csg = Csg { operation: CsgOperation::Union, operands: [left, right] };
                        Primitive { shape: Shape::Csg(Arc::new(csg)), transform: None, material }
                    }
                });
            }
            all = joined;
        }
        Ok(all.pop().map(|whole| (whole, leaves)))
    }

    fn material_of(
        &mut self,
        value: Option<&Arc<MaterialValue>>,
        materials: &mut Materials,
    ) -> Outcome<Arc<Material>> {
        let Some(value) = value else {
            let plain = || Arc::new(Material::matte(Texture::Solid(Rgb::new(1.0, 1.0, 1.0))));
            return Ok(materials.plain.get_or_insert_with(plain).clone());
        };
        let key = Arc::as_ptr(value) as usize;
        if let Some((_, material)) = materials.known.get(&key) {
            return Ok(material.clone());
        }
        let material = Arc::new(self.compile_material(value)?);
        materials.known.insert(key, (value.clone(), material.clone()));
        Ok(material)
    }

    fn compile_material(&mut self, value: &MaterialValue) -> Outcome<Material> {
        let table =
            constructor("classic").ok_or_else(|| internal(value.span, "a table without `classic`"))?;
        let given = |name: &str| {
            let (place, _) = table.field(name)?;
            value.fields.get(place)?.clone()
        };
        let or_default = |machine: &mut Self, name: &str| -> Outcome<Given> {
            match given(name) {
                Some(given) => Ok(given),
                None => {
                    let place = table.field(name).map_or(0, |(place, _)| place);
                    Ok(Given { value: machine.default_value(table, place, value.span)?, span: value.span })
                }
            }
        };
        let field = |machine: &mut Self, name: &str| -> Outcome<Field> {
            let given = or_default(machine, name)?;
            machine.varying(&given)
        };
        let color = or_default(self, "color")?;
        let place = |name: &str| given(name).map_or(value.span, |given| given.span);
        let material = Material {
            texture: self.texture(&color)?,
            reflection: field(self, "reflection")?,
            shine: field(self, "shine")?,
            transmission: field(self, "transparency")?,
            refractive_index: field(self, "ior")?,
            highlight: given("highlight").map(|given| self.varying(&given)).transpose()?,
            glow: given("glow").map(|given| self.texture(&given)).transpose()?,
            bump: match given("bump") {
                Some(given) => self.bump(&given)?,
                None => None,
            },
        };
        self.lint_material(&material, [place("shine"), place("ior")]);
        Ok(material)
    }
}
