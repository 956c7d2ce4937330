//! Transforms of anything that can be placed.

use super::compile::internal;
use super::failure::{Failure, Outcome};
use super::machine::{Machine, depends_on_hit};
use super::scalar::parts;
use super::value::{
    FunctionKind, Given, Kind, LightValue, MaterialValue, RecordValue, Scalar, ShapeNode, Value,
};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{BinaryOperator, ExprKind};
use crate::hry::library::Native;
use crate::hry::program::application;
use glam::{DAffine3, DMat3, DVec3};
use hray_core::{Camera, Light, OrthographicCamera, PerspectiveCamera};
use std::sync::Arc;

/// Sines and cosines nearer to 0 than this are 0: a quarter turn is exact.
const NO_ANGLE: f64 = 4.0 * f64::EPSILON;

impl Machine<'_> {
    /// `translate`, `rotate`, `scale`, `stretch`, `matrix` with all of their arguments.
    pub(super) fn transform(&mut self, native: Native, arguments: &[Value], span: Span) -> Outcome<Value> {
        let (transform, what) = match (native, arguments) {
            (Native::Translate, [by, what]) => (DAffine3::from_translation(self.vector(by, span)?), what),
            (Native::Scale, [by, what]) => {
                let by = self.known(by, "how something is placed", span)?;
                (DAffine3::from_scale(DVec3::splat(by)), what)
            }
            (Native::Stretch, [by, what]) => (DAffine3::from_scale(self.vector(by, span)?), what),
            (Native::Rotate, [axis, angle, what]) => {
                let axis = self.vector(axis, span)?;
                let angle = self.known(angle, "how something is placed", span)?;
                (DAffine3::from_mat3(self.rotation(axis, angle, span)?), what)
            }
            (Native::Matrix, [Value::Record(record), what]) => (self.matrix(record, span)?, what),
            _ => return Err(internal(span, "a transform with arguments that it does not take").into()),
        };
        self.check_transform(native, &transform, span)?;
        self.put(what, &Arc::new(transform), span)
    }

    /// Refuses what cannot be undone, at the argument that makes it so.
    fn check_transform(&self, native: Native, transform: &DAffine3, span: Span) -> Outcome<()> {
        let scale = transform.matrix3.to_cols_array().iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let flat = transform.matrix3.determinant() == 0.0 || scale == 0.0;
        if transform.is_finite() && !flat {
            return Ok(());
        }
        let at = self.argument(span, 0);
        let diagonal = transform.matrix3.to_cols_array_2d();
        let zero = (0..3).filter(|i| diagonal.get(*i).and_then(|c| c.get(*i)).is_some_and(|v| *v == 0.0));
        let zero: Vec<&str> = zero.filter_map(|i| ["x", "y", "z"].get(i).copied()).collect();
        let is_finite = transform.is_finite();
        let message = if is_finite {
            "this transform makes things flat, and so cannot be undone"
        } else {
            "this transform is not made of finite numbers"
        };
        let label = match native {
            _ if !is_finite => "not finite".to_owned(),
            Native::Scale => "this factor is 0".to_owned(),
            Native::Stretch => format!("the factor along {} is 0", zero.join(" and ")),
            Native::Matrix => "these columns lie in a plane".to_owned(),
            _ => "this transform".to_owned(),
        };
        let error = Diagnostic::error("transform", message, at, label);
        let error = if at == span { error } else { error.with_secondary(span, "used here") };
        Err(Failure::new(error.with_help(match native {
            _ if !is_finite => "every number in it has to be finite; is something divided by 0?",
            Native::Matrix => "the vectors `x`, `y` and `z` must not lie in one plane",
            _ => "a factor of 0 is not allowed; for something thin use a small one, such as 0.001",
        })))
    }

    /// The place of an argument, counted from 0, of the call at `span`, however it is written; `span` itself where it is not
    /// to be found.
    fn argument(&self, span: Span, index: usize) -> Span {
        let mut found = None;
        let modules = self.program.modules.iter().filter(|module| !module.is_standard);
        for definition in modules.flat_map(|module| &module.syntax.definitions) {
            definition.body.walk(&mut |expr| {
                let call = match &expr.kind {
                    ExprKind::Binary { operator: BinaryOperator::Pipe, right, .. } => right,
                    _ => expr,
                };
                if expr.span == span && found.is_none() {
                    found = application(call).1.get(index).map(|argument| argument.span);
                }
            });
        }
        found.unwrap_or(span)
    }

    fn vector(&self, value: &Value, span: Span) -> Outcome<DVec3> {
        match parts(value) {
            Some((Kind::Vec3, [Scalar::Known(x), Scalar::Known(y), Scalar::Known(z)])) => {
                Ok(DVec3::new(x, y, z))
            }
            Some((Kind::Vec3, _)) => Err(depends_on_hit("how something is placed", span)),
            _ => Err(internal(span, &format!("{} where a vector is needed", value.describe())).into()),
        }
    }

    /// A rotation about an axis by an angle in radians, counter-clockwise seen against the axis (Rodrigues' formula).
    fn rotation(&self, axis: DVec3, angle: f64, span: Span) -> Outcome<DMat3> {
        let length = axis.dot(axis).sqrt();
        if length == 0.0 || !length.is_finite() {
            let message = "the axis of a rotation needs a direction";
            let at = self.argument(span, 0);
            let label = if length == 0.0 { "this axis has length 0" } else { "this axis is not finite" };
            let error = Diagnostic::error("transform", message, at, label);
            let error = if at == span { error } else { error.with_secondary(span, "used here") };
            return Err(Failure::new(error.with_help("for example `rotate up 30deg`")));
        }
        let snap = |v: f64| {
            if v.abs() < NO_ANGLE {
                0.0
            } else if (v.abs() - 1.0).abs() < NO_ANGLE {
                v.signum()
            } else {
                v
            }
        };
        let (s, c) = (snap(libm::sin(angle)), snap(libm::cos(angle)));
        let DVec3 { x, y, z } = axis / length;
        let t = 1.0 - c;
        Ok(DMat3::from_cols(
            DVec3::new(t * x * x + c, t * x * y + s * z, t * x * z - s * y),
            DVec3::new(t * x * y - s * z, t * y * y + c, t * y * z + s * x),
            DVec3::new(t * x * z + s * y, t * y * z - s * x, t * z * z + c),
        ))
    }

    fn matrix(&mut self, record: &RecordValue, span: Span) -> Outcome<DAffine3> {
        let mut column = |name: &str| {
            let symbol = self.symbols.number(name);
            let value = record.get(symbol).cloned();
            let value = value.ok_or_else(|| internal(span, &format!("a matrix without `{name}`")))?;
            self.vector(&value, span)
        };
        let columns = [column("x")?, column("y")?, column("z")?];
        let origin = column("origin")?;
        Ok(DAffine3::from_mat3_translation(DMat3::from_cols(columns[0], columns[1], columns[2]), origin))
    }

    fn put(&mut self, what: &Value, transform: &Arc<DAffine3>, span: Span) -> Outcome<Value> {
        match what {
            Value::Shape(shape) => {
                // Moves of moves are one move.
                let (transform, shape) = match &shape.node {
                    ShapeNode::Placed { transform: inner, shape } => (Arc::new(**transform * **inner), shape),
                    _ => (transform.clone(), shape),
                };
                Self::shape(ShapeNode::Placed { transform, shape: shape.clone() }, shape.nesting, span)
            }
            Value::Function(function) => {
                let inverse = transform.inverse();
                let (inverse, function) = match &function.kind {
                    FunctionKind::Placed { inverse: inner, function } => (**inner * inverse, function),
                    _ => (inverse, function),
                };
                let nesting = function.nesting + 1;
                let kind = FunctionKind::Placed { inverse: Arc::new(inverse), function: function.clone() };
                self.function(kind, nesting, span)
            }
            Value::Material(material) => {
                let mut fields = Vec::with_capacity(material.fields.len());
                for field in &material.fields {
                    fields.push(match field {
                        Some(Given { value: value @ Value::Function(_), span: at }) => {
                            Some(Given { value: self.put(value, transform, span)?, span: *at })
                        }
                        other => other.clone(),
                    });
                }
                Ok(Value::Material(Arc::new(MaterialValue { fields, span: material.span })))
            }
            Value::Light(value) => {
                let LightValue { light, origin } = **value;
                let light = light_at(light, transform);
                Ok(Value::Light(Arc::new(LightValue { light, origin })))
            }
            Value::Camera(camera) => match &**camera {
                Camera::Perspective(c) => {
                    Ok(Value::Camera(Arc::new(Camera::Perspective(PerspectiveCamera {
                        from: transform.transform_point3(c.from),
                        to: transform.transform_point3(c.to),
                        up: transform.transform_vector3(c.up),
                        fov: c.fov,
                    }))))
                }
                Camera::Orthographic(c) => {
                    Ok(Value::Camera(Arc::new(Camera::Orthographic(OrthographicCamera {
                        from: transform.transform_point3(c.from),
                        to: transform.transform_point3(c.to),
                        up: transform.transform_vector3(c.up),
                        height: c.height * (transform.transform_vector3(c.up).length() / c.up.length()),
                    }))))
                }
                Camera::Window(_) => {
                    let message = "the window camera cannot be moved: its window lies in the plane z = 0";
                    Err(Failure::new(
                        Diagnostic::error("transform", message, span, "moved here")
                            .with_help("use a `perspective` camera, or move the scene"),
                    ))
                }
            },
            other => Err(internal(span, &format!("a transform of {}", other.describe())).into()),
        }
    }
}

fn light_at(light: Light, transform: &DAffine3) -> Light {
    let point = |p| transform.transform_point3(p);
    let unit = |v: DVec3| {
        let v = transform.transform_vector3(v);
        v / v.dot(v).sqrt()
    };
    match light {
        Light::Point { position, intensity } => Light::Point { position: point(position), intensity },
        Light::Ambient { .. } => light,
        Light::Directional { direction, intensity } => {
            Light::Directional { direction: unit(direction), intensity }
        }
        Light::Spot { position, axis, cos_inner, cos_outer, intensity } => {
            Light::Spot { position: point(position), axis: unit(axis), cos_inner, cos_outer, intensity }
        }
    }
}
