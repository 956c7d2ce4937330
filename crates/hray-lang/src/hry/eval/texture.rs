//! Functions of a hit, from values to compiled graphs.

use super::compile::internal;
use super::construct::is_color;
use super::failure::{Failure, Outcome};
use super::machine::{Machine, grouped};
use super::scalar::parts;
use super::value::{FunctionKind, FunctionValue, Given, HitValue, RecordValue, Scalar, Value};
use crate::diagnostic::{Diagnostic, Span};
use hray_core::{DVec3, Field, Function, NoiseTexture, Rgb, Texture};
use hray_expr::{Builder, DerivativeError, Input, NodeId};
use std::sync::Arc;

/// The most operations that a function may take at one hit, loops counted as often as they may go round: about a tenth of
/// a second.
const MOST_OPERATIONS: u64 = 100_000_000;

/// What comes of a function of a hit.
pub(super) enum Compiled {
    /// The same everywhere.
    Constant([f64; 3]),
    /// A function.
    Function(Arc<Function>),
}

impl Machine<'_> {
    /// The hit, all of whose parts are inputs.
    fn hit(&mut self, span: Span) -> Outcome<HitValue> {
        let mut input =
            |input| -> Outcome<Scalar> { Ok(Scalar::Node(self.build(span, |graph| graph.input(input))?)) };
        let p = [input(Input::Px)?, input(Input::Py)?, input(Input::Pz)?];
        let world = [input(Input::Wx)?, input(Input::Wy)?, input(Input::Wz)?];
        let normal = [input(Input::Nx)?, input(Input::Ny)?, input(Input::Nz)?];
        let uv = [input(Input::U)?, input(Input::V)?];
        Ok(HitValue { p, world, normal, uv, time: Scalar::Known(self.time) })
    }

    /// Works a function out, for all hits at once. `outputs` says which numbers of its result are wanted.
    pub(super) fn compile(
        &mut self,
        function: &Value,
        span: Span,
        argument: impl FnOnce(HitValue) -> Value,
        outputs: impl FnOnce(&mut Builder, &Value) -> Result<Vec<NodeId>, Box<Failure>>,
    ) -> Outcome<Compiled> {
        let before = self.graph.replace(Builder::new(self.limits.nodes));
        let result = self.hit(span).and_then(|hit| self.apply_value(function, &[argument(hit)], span));
        let builder = std::mem::replace(&mut self.graph, before);
        let (value, mut builder) = (result?, builder.ok_or_else(|| internal(span, "a graph that is gone"))?);
        let nodes = outputs(&mut builder, &value)?;
        let constants: Option<Vec<f64>> = nodes.iter().map(|node| builder.as_constant(*node)).collect();
        if let Some(constants) = constants {
            let mut three = [0.0; 3];
            three.iter_mut().zip(constants).for_each(|(slot, value)| *slot = value);
            return Ok(Compiled::Constant(three));
        }
        let function = builder.finish(&nodes);
        if function.cost() > MOST_OPERATIONS {
            let message = format!(
                "this function may take more than {} operations for one hit",
                grouped(MOST_OPERATIONS)
            );
            return Err(Failure::new(
                Diagnostic::error("function-too-slow", message, span, "worked out for every hit")
                    .with_help("let `iterate` go round less often; loops inside loops multiply"),
            ));
        }
        Ok(Compiled::Function(Arc::new(function)))
    }

    /// A colour that may be a function of the hit.
    pub(super) fn texture(&mut self, given: &Given) -> Outcome<Texture> {
        if let Some((kind, components)) = parts(&given.value)
            && is_color(kind)
        {
            return Ok(Texture::Solid(known_color(components, kind.len(), given.span)?));
        }
        if let Value::Function(function) = &given.value
            && let Some(noise) = self.classic_texture(function)
        {
            return Ok(Texture::Noise(noise));
        }
        let compiled = self.compile(
            &given.value,
            given.span,
            |hit| Value::Hit(Arc::new(hit)),
            color_outputs(given.span),
        )?;
        Ok(match compiled {
            Compiled::Constant(color) => Texture::Solid(Rgb::from(color)),
            Compiled::Function(function) => Texture::Function(function),
        })
    }

    /// A number that may be a function of the hit.
    pub(super) fn varying(&mut self, given: &Given) -> Outcome<Field> {
        if let Some((_, [Scalar::Known(value), ..])) = parts(&given.value) {
            return Ok(Field::Constant(value));
        }
        let span = given.span;
        let compiled = self.compile(
            &given.value,
            span,
            |hit| Value::Hit(Arc::new(hit)),
            |graph, value| Ok(vec![single(graph, value, span)?]),
        )?;
        Ok(match compiled {
            Compiled::Constant([value, ..]) => Field::Constant(value),
            Compiled::Function(function) => Field::Function(function),
        })
    }

    /// The gradient of a height.
    pub(super) fn bump(&mut self, given: &Given) -> Outcome<Option<Arc<Function>>> {
        let span = given.span;
        let compiled = self.compile(
            &given.value,
            span,
            |hit| Value::Hit(Arc::new(hit)),
            |graph, value| {
                let height = single(graph, value, span)?;
                let mut slope =
                    |input| graph.derivative(height, input).map_err(|error| no_slope(&error, span));
                Ok(vec![slope(Input::Px)?, slope(Input::Py)?, slope(Input::Pz)?])
            },
        )?;
        Ok(match compiled {
            Compiled::Constant(_) => None,
            Compiled::Function(function) => Some(function),
        })
    }

    /// A function of a direction.
    pub(super) fn sky(&mut self, given: &Given) -> Outcome<Compiled> {
        let direction = |hit: HitValue| super::scalar::assemble(super::value::Kind::Vec3, hit.p);
        self.compile(&given.value, given.span, direction, color_outputs(given.span))
    }

    /// The texture of 2005 that a function is, where it is one of the library's with nothing but its record: it is then
    /// rendered by the integrator's own code, to the same bits.
    fn classic_texture(&self, function: &FunctionValue) -> Option<NoiseTexture> {
        let FunctionKind::Partial { function, arguments } = &function.kind else { return None };
        let FunctionKind::Closure(closure) = &function.kind else { return None };
        let (module, index) = closure.group.functions.get(closure.index)?.origin?;
        let module = self.program.modules.get(module).filter(|m| m.is_standard && m.path == "classic")?;
        let name = module.syntax.definitions.get(index)?.name()?;
        let [Value::Record(record)] = &arguments[..] else { return None };
        self.noise_texture(&name.text, record)
    }

    fn noise_texture(&self, name: &str, record: &RecordValue) -> Option<NoiseTexture> {
        let field = |wanted: &str| {
            let place = record.names.iter().position(|name| self.symbols.name(*name) == wanted)?;
            record.values.get(place)
        };
        let number = |wanted| match field(wanted)? {
            Value::Number(n) => Some(*n),
            _ => None,
        };
        let color = |wanted| match field(wanted)? {
            Value::Color(c) => Some(Rgb::from(*c)),
            _ => None,
        };
        let vector = |wanted| match field(wanted)? {
            Value::Vec3(v) => Some(DVec3::from(*v)),
            _ => None,
        };
        let octaves = |wanted| {
            let n = number(wanted)?;
            (n.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&n)).then_some(n as u32)
        };
        let grid = number("grid")?;
        Some(match name {
            "perlinSolid" => NoiseTexture::Solid { base: color("color")?, grid },
            "perlinSemiTurb" => {
                NoiseTexture::SemiTurbulence { base: color("color")?, octaves: octaves("octaves")?, grid }
            }
            "perlinTurb" => {
                NoiseTexture::Turbulence { base: color("color")?, octaves: octaves("octaves")?, grid }
            }
            "perlinFire" => NoiseTexture::Fire {
                added: color("added")?,
                base: color("color")?,
                octaves: octaves("octaves")?,
                grid,
            },
            "perlinPlasma" => NoiseTexture::Plasma { grid },
            "perlinMarble" => NoiseTexture::Marble {
                base: color("color")?,
                octaves: octaves("octaves")?,
                grid,
                direction: vector("direction")?,
                power: number("power")?,
            },
            "perlinMarbleBase" => NoiseTexture::MarbleBase {
                base: color("color")?,
                added: color("added")?,
                octaves: octaves("octaves")?,
                grid,
                direction: vector("direction")?,
                power: number("power")?,
            },
            "perlinWood" => NoiseTexture::Wood {
                base: color("color")?,
                octaves: octaves("octaves")?,
                grid,
                rings: number("rings")?,
                power: number("power")?,
            },
            _ => return None,
        })
    }
}

fn known_color(parts: [Scalar; 3], len: usize, span: Span) -> Outcome<Rgb> {
    match parts {
        [Scalar::Known(grey), ..] if len == 1 => Ok(Rgb::new(grey, grey, grey)),
        [Scalar::Known(r), Scalar::Known(g), Scalar::Known(b)] => Ok(Rgb::new(r, g, b)),
        _ => Err(super::machine::depends_on_hit("a colour outside of a function of a hit", span)),
    }
}

fn node(graph: &mut Builder, scalar: Scalar, span: Span) -> Outcome<NodeId> {
    match scalar {
        Scalar::Node(node) => Ok(node),
        Scalar::Known(value) => {
            graph.constant(value).map_err(|_| internal(span, "no room for a constant").into())
        }
    }
}

pub(super) fn single(graph: &mut Builder, value: &Value, span: Span) -> Outcome<NodeId> {
    match parts(value) {
        Some((kind, [scalar, ..])) if kind.len() == 1 => node(graph, scalar, span),
        _ => Err(internal(span, &format!("{} where a number is needed", value.describe())).into()),
    }
}

/// Red, green and blue of a colour, or of a number for a grey.
fn color_outputs(span: Span) -> impl FnOnce(&mut Builder, &Value) -> Outcome<Vec<NodeId>> {
    move |graph, value| match parts(value) {
        Some((kind, components)) if is_color(kind) => {
            let components = if kind.len() == 1 { [components[0]; 3] } else { components };
            components.into_iter().map(|scalar| node(graph, scalar, span)).collect()
        }
        _ => Err(internal(span, &format!("{} where a colour is needed", value.describe())).into()),
    }
}

fn no_slope(error: &DerivativeError, span: Span) -> Box<Failure> {
    Failure::new(match error {
        DerivativeError::TooLarge(error) => Diagnostic::error(
            "function-too-large",
            format!("the slope of this height takes more than {} operations", error.budget),
            span,
            "too large",
        )
        .with_help("do less for each hit; or raise the budget with `--eval-nodes`"),
        DerivativeError::Loop => Diagnostic::error(
            "no-slope",
            "the slope of a height that is made by `iterate` is not known",
            span,
            "this height",
        )
        .with_help("bumps need a height without a loop whose end depends on the hit"),
    })
}
