//! From the fields of a constructor to what it makes.

use super::compile::{Compiler, internal};
use super::failure::{Failure, Outcome};
use super::machine::{Machine, depends_on_hit};
use super::scalar::parts;
use super::value::{Given, Kind, LightValue, MaterialValue, RecordValue, Scalar, ShapeNode, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::library::{Constructor, FieldSpec, FieldType, Makes, Range};
use crate::hry::program::listed;
use crate::hry::sources::STANDARD_BASE;
use crate::hry::syntax;
use glam::DVec3;
use hray_core::{
    Camera, Cuboid, Disc, Frustum, Light, OrthographicCamera, PerspectiveCamera, Plane, Quadric, Rgb, Shape,
    Sphere, Torus, WindowCamera,
};
use std::sync::Arc;

/// The fields of a constructor, given or by default, while something is made of them.
pub(super) struct Fields<'m, 'a> {
    machine: &'m mut Machine<'a>,
    constructor: &'static Constructor,
    given: Vec<Option<Given>>,
    /// The whole call.
    pub(super) span: Span,
}

impl<'a> Machine<'a> {
    /// The fields of a record by their places in a constructor.
    pub(super) fn given(
        &mut self,
        constructor: &'static Constructor,
        record: &RecordValue,
        span: Span,
    ) -> Outcome<Vec<Option<Given>>> {
        let mut given: Vec<Option<Given>> = constructor.fields.iter().map(|_| None).collect();
        for (name, value) in record.names.iter().zip(&record.values) {
            let text = self.symbols.name(*name);
            let Some((place, _)) = constructor.field(text) else {
                let names: Vec<&str> = constructor.fields.iter().map(|field| field.name).collect();
                let message = format!("`{}` has no field `{text}`", constructor.name);
                let error = Diagnostic::error("unknown-field", message, span, "made here");
                return Err(Failure::new(error.with_help(format!("it has {}", listed(&names)))));
            };
            if let Some(slot) = given.get_mut(place) {
                *slot = Some(Given { value: value.clone(), span });
            }
        }
        Ok(given)
    }

    /// Calls a constructor.
    pub(super) fn construct(
        &mut self,
        constructor: &'static Constructor,
        given: Vec<Option<Given>>,
        span: Span,
    ) -> Outcome<Value> {
        if constructor.makes == Makes::Material {
            return self.material(constructor, given, span);
        }
        let fields = Fields { machine: self, constructor, given, span };
        match constructor.makes {
            Makes::Shape => fields.shape(),
            Makes::Light => fields.light(),
            Makes::Camera => fields.camera(),
            Makes::Material | Makes::Scene => Err(internal(span, "a constructor that is none").into()),
        }
    }

    fn material(
        &mut self,
        constructor: &'static Constructor,
        given: Vec<Option<Given>>,
        span: Span,
    ) -> Outcome<Value> {
        for (field, given) in constructor.fields.iter().zip(&given) {
            if let Some(given) = given
                && parts(&given.value).is_some()
            {
                self.check(constructor, field, &given.value, given.span)?;
            }
        }
        Ok(Value::Material(Arc::new(MaterialValue { fields: given, span })))
    }

    /// The value of a field's default.
    pub(super) fn default_value(
        &mut self,
        constructor: &'static Constructor,
        place: usize,
        span: Span,
    ) -> Outcome<Value> {
        if let Some(value) = self.defaults.get(&(constructor.name, place)) {
            return Ok(value.clone());
        }
        let field = constructor.fields.get(place).and_then(|field| field.default);
        let text = field.ok_or_else(|| internal(span, "a default that is not there"))?;
        let module = syntax::parse(&format!("value = {text}"), STANDARD_BASE).module();
        let definition =
            module.definitions.first().ok_or_else(|| internal(span, "a default that cannot be read"))?;
        // Names in it are those of the library, which the modules of the library see.
        let code = Compiler::new(self.program, 0, &mut self.symbols).expression(&definition.body)?;
        let graph = self.graph.take();
        let value = self.run(&code, None, span);
        self.graph = graph;
        let value = value?;
        self.defaults.insert((constructor.name, place), value.clone());
        Ok(value)
    }

    /// Complains where a value is out of its field's range: an error where it makes no sense, else a warning.
    pub(super) fn check(
        &mut self,
        constructor: &'static Constructor,
        field: &'static FieldSpec,
        value: &Value,
        span: Span,
    ) -> Outcome<()> {
        let Some((kind, components)) = parts(value) else { return Ok(()) };
        let mut numbers = [0.0; 3];
        for (number, component) in numbers.iter_mut().zip(components).take(kind.len()) {
            match component {
                Scalar::Known(value) => *number = value,
                Scalar::Node(_) if field.varies => return Ok(()),
                Scalar::Node(_) => {
                    let what = format!("the field `{}` of `{}`", field.name, constructor.name);
                    return Err(depends_on_hit(&what, span));
                }
            }
        }
        let numbers = numbers.get(..kind.len()).unwrap_or_default();
        let complain = |wanted: String| {
            let shown = self.show(value, 60);
            Diagnostic::error(
                "out-of-range",
                format!(
                    "the field `{}` of `{}` is {wanted}, and this is {shown}",
                    field.name, constructor.name
                ),
                span,
                format!("{wanted} is expected"),
            )
        };
        let whole = |n: &f64| n.fract() == 0.0;
        let error = match field.range {
            _ if numbers.iter().any(|n| !n.is_finite()) => {
                let name = format!("`{}` of `{}`", field.name, constructor.name);
                return Err(Failure::new(not_finite(&name, numbers, &self.show(value, 60), span)));
            }
            Range::Positive if numbers.iter().any(|n| *n <= 0.0) => Some(complain("greater than 0".into())),
            Range::Positives if numbers.iter().any(|n| *n <= 0.0) => {
                Some(complain("greater than 0 in every component".into()))
            }
            Range::NonNegative if numbers.iter().any(|n| *n < 0.0) => Some(complain("0 or greater".into())),
            Range::Between(low, high) if numbers.iter().any(|n| *n <= low || *n >= high) => {
                let degrees = |v: f64| (v.to_degrees() * 1e6).round() / 1e6;
                Some(if field.unit == "radians" {
                    let error =
                        complain(format!("an angle between {}deg and {}deg", degrees(low), degrees(high)));
                    error.with_help("angles are in radians; write `35deg` for degrees")
                } else {
                    complain(format!("between {low} and {high}"))
                })
            }
            Range::Whole(low, high) if !numbers.iter().all(|n| whole(n) && *n >= low && *n <= high) => {
                Some(complain(format!("a whole number from {low} to {high}")))
            }
            Range::Direction if numbers.iter().all(|n| *n == 0.0) => Some(complain("not zero".into())),
            _ => None,
        };
        if let Some(error) = error {
            return Err(Failure::new(error));
        }
        let odd = match field.range {
            Range::Share => numbers.iter().any(|n| !(0.0..=1.0).contains(n)).then_some("from 0 to 1"),
            Range::Light => numbers.iter().any(|n| *n < 0.0).then_some("0 or greater"),
            Range::Radius => numbers.iter().any(|n| *n <= 0.0).then_some("greater than 0"),
            Range::Normal => numbers.iter().all(|n| *n == 0.0).then_some("not zero"),
            _ => None,
        };
        if let Some(wanted) = odd {
            let shown = self.show(value, 60);
            let message = format!(
                "the field `{}` of `{}` is usually {wanted}, and this is {shown}",
                field.name, constructor.name
            );
            self.warn(Diagnostic::warning("unusual-value", message, span, "surely not meant"));
        }
        Ok(())
    }

    /// Adds a warning, each only once.
    pub(super) fn warn(&mut self, warning: Diagnostic) {
        const MOST: usize = 100;
        if self.warnings.len() < MOST && !self.warnings.contains(&warning) {
            self.warnings.push(warning);
        }
    }
}

/// The complaint about a value that is no number, or infinite.
fn not_finite(name: &str, numbers: &[f64], shown: &str, span: Span) -> Diagnostic {
    if numbers.iter().any(|n| n.is_nan()) {
        let shown = if shown == "NaN" { String::new() } else { format!(": {shown}") };
        let message = format!("{name} is NaN, which means not a number{shown}");
        return Diagnostic::error("out-of-range", message, span, "cannot be calculated").with_help(
            "NaN is the result of 0 / 0, of the square root of a negative number, of `ln`, `acos` and `asin` outside of \
             what they take, and of everything calculated with it",
        );
    }
    Diagnostic::error("out-of-range", format!("{name} is infinite: {shown}"), span, "too large")
        .with_help("infinity is the result of a division by 0, and of numbers beyond 1.8e308")
}

impl<'m, 'a> Fields<'m, 'a> {
    pub(super) fn new(
        machine: &'m mut Machine<'a>,
        constructor: &'static Constructor,
        given: Vec<Option<Given>>,
        span: Span,
    ) -> Self {
        Self { machine, constructor, given, span }
    }

    pub(super) fn machine(&mut self) -> &mut Machine<'a> {
        self.machine
    }

    fn place(&self, name: &str) -> Outcome<(usize, &'static FieldSpec)> {
        let found = self.constructor.field(name);
        found.ok_or_else(|| internal(self.span, &format!("a field `{name}` that is not in the table")).into())
    }

    /// The value of a field and its place, where it was given.
    pub(super) fn optional(&self, name: &str) -> Option<Given> {
        let (place, _) = self.constructor.field(name)?;
        self.given.get(place)?.clone()
    }

    /// The value of a field, given or by default, in its range.
    pub(super) fn value(&mut self, name: &str) -> Outcome<(Value, Span)> {
        let (place, field) = self.place(name)?;
        if let Some(Some(given)) = self.given.get(place) {
            let (value, span) = (given.value.clone(), given.span);
            if field.range != Range::Any
                || matches!(field.kind, FieldType::Number | FieldType::Vec2 | FieldType::Vec3)
            {
                self.machine.check(self.constructor, field, &value, span)?;
            }
            return Ok((value, span));
        }
        if field.default.is_none() {
            let message = format!("`{}` needs the field `{name}`", self.constructor.name);
            let error =
                Diagnostic::error("missing-field", message, self.span, format!("`{name}` is missing"));
            return Err(Failure::new(error.with_help(format!("for example: {}", self.constructor.example))));
        }
        Ok((self.machine.default_value(self.constructor, place, self.span)?, self.span))
    }

    pub(super) fn number(&mut self, name: &str) -> Outcome<f64> {
        let (value, span) = self.value(name)?;
        let what = format!("the field `{name}` of `{}`", self.constructor.name);
        self.machine.known(&value, &what, span)
    }

    fn three(&mut self, name: &str) -> Outcome<[f64; 3]> {
        let (value, span) = self.value(name)?;
        match value {
            Value::Vec3(v) | Value::Color(v) => Ok(v),
            // A number for a grey.
            Value::Number(n) => Ok([n; 3]),
            Value::Symbolic(_) => {
                Err(depends_on_hit(&format!("the field `{name}` of `{}`", self.constructor.name), span))
            }
            other => Err(internal(span, &format!("{} in the field `{name}`", other.describe())).into()),
        }
    }

    pub(super) fn vector(&mut self, name: &str) -> Outcome<DVec3> {
        self.three(name).map(DVec3::from)
    }

    pub(super) fn color(&mut self, name: &str) -> Outcome<Rgb> {
        self.three(name).map(Rgb::from)
    }

    pub(super) fn pair(&mut self, name: &str) -> Outcome<[f64; 2]> {
        let (value, span) = self.value(name)?;
        match value {
            Value::Vec2(v) => Ok(v),
            Value::Symbolic(_) => {
                Err(depends_on_hit(&format!("the field `{name}` of `{}`", self.constructor.name), span))
            }
            other => Err(internal(span, &format!("{} in the field `{name}`", other.describe())).into()),
        }
    }

    fn shape(mut self) -> Outcome<Value> {
        let material = match self.optional("material") {
            Some(Given { value: Value::Material(material), .. }) => Some(material),
            _ => None,
        };
        let shape = match self.constructor.name {
            "mesh" => return self.mesh(material),
            "triangles" => return self.triangles(material),
            "sphere" => {
                Shape::Sphere(Sphere { radius: self.number("radius")?, center: self.vector("center")? })
            }
            "plane" => {
                // The thesis writes n · p + d = 0.
                let offset = 0.0 - self.number("offset")?;
                Shape::Plane(Plane { normal: self.vector("normal")?, offset })
            }
            "cube" => {
                let size = DVec3::splat(self.number("size")?);
                self.cuboid(size)?
            }
            "box" => {
                let size = self.vector("size")?;
                self.cuboid(size)?
            }
            "cylinder" => {
                let radius = self.number("radius")?;
                self.frustum([radius; 2])?
            }
            "cone" => {
                let radii = [self.number("radius")?, self.number("top")?];
                self.frustum(radii)?
            }
            "disc" => {
                let (radius, hole) = (self.number("radius")?, self.number("hole")?);
                self.less_than("hole", hole, radius)?;
                let (center, normal) = (self.vector("center")?, self.vector("normal")?);
                Shape::Disc(Arc::new(Disc { center, normal: unit(normal), radius, hole }))
            }
            "torus" => {
                let (radius, tube) = (self.number("radius")?, self.number("tube")?);
                self.less_than("tube", tube, radius)?;
                let (center, axis) = (self.vector("center")?, self.vector("axis")?);
                Shape::Torus(Arc::new(Torus { center, axis: unit(axis), radius, tube }))
            }
            "quadric" => {
                let [square, product, linear] =
                    [self.vector("square")?, self.vector("product")?, self.vector("linear")?];
                let constant = self.number("constant")?;
                if [square, product, linear].iter().all(|terms| *terms == DVec3::ZERO) {
                    let message = "a quadric needs `square`, `product` or `linear`";
                    let label = "without them it is nowhere 0, or everywhere";
                    let error = Diagnostic::error("no-surface", message, self.span, label);
                    return Err(Failure::new(error.with_help(
                        "for a sphere of radius 2: quadric { square = (1, 1, 1), constant = -4 }",
                    )));
                }
                Shape::Quadric(Arc::new(Quadric { square, product, linear, constant }))
            }
            "implicit" => self.implicit()?,
            name => return Err(internal(self.span, &format!("a shape `{name}` that is not made")).into()),
        };
        let origin = self.machine.origin(self.span);
        Machine::shape(ShapeNode::Leaf { shape, material, origin }, 0, self.span)
    }

    fn frustum(&mut self, radii: [f64; 2]) -> Outcome<Shape> {
        let (base, top) = (self.vector("from")?, self.vector("to")?);
        if base == top {
            let name = self.constructor.name;
            let span =
                self.optional("to").or_else(|| self.optional("from")).map_or(self.span, |given| given.span);
            let message = format!("`from` and `to` of `{name}` are the same point");
            let error = Diagnostic::error("out-of-range", message, span, "another point is expected");
            return Err(Failure::new(error.with_help("they are the middles of its two ends")));
        }
        let is_open = matches!(self.optional("open"), Some(Given { value: Value::Bool(true), .. }));
        Ok(Shape::Frustum(Arc::new(Frustum { base, top, radii, is_capped: !is_open })))
    }

    /// Complains where one field is not less than `radius`.
    fn less_than(&self, name: &str, value: f64, radius: f64) -> Outcome<()> {
        if value < radius {
            return Ok(());
        }
        let owner = self.constructor.name;
        let span = self.optional(name).map_or(self.span, |given| given.span);
        let message =
            format!("`{name}` of `{owner}` has to be less than `radius`, which is {radius}; this is {value}");
        Err(Failure::new(Diagnostic::error("out-of-range", message, span, "too large")))
    }

    fn cuboid(&mut self, size: DVec3) -> Outcome<Shape> {
        let center = self.vector("center")?;
        Ok(Shape::Cuboid(Cuboid { min: center - size / 2.0, max: center + size / 2.0 }))
    }

    fn light(mut self) -> Outcome<Value> {
        let intensity = self.color("intensity")?;
        let light = match self.constructor.name {
            "point" => Light::Point { position: self.vector("position")?, intensity },
            "ambient" => Light::Ambient { intensity },
            "directional" => Light::Directional { direction: unit(self.vector("direction")?), intensity },
            "spotlight" => {
                let (position, target) = (self.vector("position")?, self.vector("target")?);
                if position == target {
                    return Err(self.same_place("position", "target"));
                }
                let half = self.number("angle")? / 2.0;
                let softness = self.number("softness")?.clamp(0.0, 1.0);
                Light::Spot {
                    position,
                    axis: unit(target - position),
                    cos_inner: libm::cos(half * (1.0 - softness)),
                    cos_outer: libm::cos(half),
                    intensity,
                }
            }
            name => return Err(internal(self.span, &format!("a light `{name}` that is not made")).into()),
        };
        let origin = self.machine.origin(self.span);
        Ok(Value::Light(Arc::new(LightValue { light, origin })))
    }

    fn same_place(&self, a: &str, b: &str) -> Box<Failure> {
        let message = format!("`{a}` and `{b}` of this {} are the same point", self.constructor.name);
        Failure::new(
            Diagnostic::error("no-direction", message, self.span, "it has no direction")
                .with_help(format!("move one of them; the line from `{a}` to `{b}` is the direction")),
        )
    }

    fn camera(mut self) -> Outcome<Value> {
        if self.constructor.name == "window" {
            let (eye, window) = (self.vector("eye")?, self.pair("size")?);
            return Ok(Value::Camera(Arc::new(Camera::Window(WindowCamera { eye, window }))));
        }
        let (from, to, up) = (self.vector("from")?, self.vector("to")?, self.vector("up")?);
        if from == to {
            return Err(self.same_place("from", "to"));
        }
        let across = (to - from).cross(up);
        // What is left of `up` at right angles to the line of sight must be more than rounding.
        if across.dot(across) <= 1e-24 * (to - from).dot(to - from) * up.dot(up) {
            let message = "`up` points along the line of sight, so it does not say which way is up";
            let error =
                Diagnostic::error("no-direction", message, self.span, "this camera looks along its `up`");
            return Err(Failure::new(error.with_help("give another `up`, for example `up = (0, 0, -1)`")));
        }
        let camera = match self.constructor.name {
            "perspective" => {
                Camera::Perspective(PerspectiveCamera { from, to, up, fov: self.number("fov")? })
            }
            "orthographic" => {
                Camera::Orthographic(OrthographicCamera { from, to, up, height: self.number("height")? })
            }
            name => return Err(internal(self.span, &format!("a camera `{name}` that is not made")).into()),
        };
        Ok(Value::Camera(Arc::new(camera)))
    }
}

fn unit(v: DVec3) -> DVec3 {
    // Scaled first, so that the squares neither overflow nor vanish.
    let v = v / v.abs().max_element();
    v / v.dot(v).sqrt()
}

/// Whether a kind of value is a colour, or a number that stands for a grey.
pub(super) const fn is_color(kind: Kind) -> bool {
    matches!(kind, Kind::Color | Kind::Number)
}
