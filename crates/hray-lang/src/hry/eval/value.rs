//! Values while a scene is evaluated.

use super::code::FunctionCode;
use super::limits::Charge;
use crate::diagnostic::Span;
use crate::hry::library::{Constructor, Native};
use glam::DAffine3;
use hray_core::{Camera, CsgOperation, Encoding, Image, Integrator, Light, Shape};
use hray_expr::NodeId;
use std::sync::Arc;

/// A number that is known, or one that depends on a hit.
#[derive(Clone, Copy, Debug)]
pub(super) enum Scalar {
    Known(f64),
    Node(NodeId),
}

/// A name of a field, by its place among all names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Symbol(pub(super) u32);

/// A value. Numbers, vectors and truth values that depend on a hit are [`Value::Symbolic`].
#[derive(Clone, Debug)]
pub(super) enum Value {
    Number(f64),
    Bool(bool),
    Vec2([f64; 2]),
    Vec3([f64; 3]),
    Color([f64; 3]),
    Text(Arc<TextValue>),
    List(Arc<ListValue>),
    Record(Arc<RecordValue>),
    Function(Arc<FunctionValue>),
    Symbolic(Arc<Symbolic>),
    Hit(Arc<HitValue>),
    Shape(Arc<ShapeValue>),
    Material(Arc<MaterialValue>),
    Light(Arc<LightValue>),
    Camera(Arc<Camera>),
    Image(Arc<Image>),
    Integrator(Integrator),
    Encoding(Encoding),
}

#[derive(Debug)]
pub(super) struct TextValue {
    pub(super) text: String,
    pub(super) _charge: Charge,
}

#[derive(Debug)]
pub(super) struct ListValue {
    pub(super) items: Vec<Value>,
    /// How deep functions and lists nest in it, see [`Value::nesting`].
    pub(super) nesting: u32,
    pub(super) _charge: Charge,
}

/// The fields of a record, in the order of the literal that made it.
#[derive(Debug)]
pub(super) struct RecordValue {
    pub(super) names: Arc<[Symbol]>,
    pub(super) values: Vec<Value>,
}

impl RecordValue {
    pub(super) fn get(&self, name: Symbol) -> Option<&Value> {
        let place = self.names.iter().position(|n| *n == name)?;
        self.values.get(place)
    }
}

/// What kind of value a [`Symbolic`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Number,
    Bool,
    Vec2,
    Vec3,
    Color,
}

impl Kind {
    pub(super) const fn len(self) -> usize {
        match self {
            Self::Number | Self::Bool => 1,
            Self::Vec2 => 2,
            Self::Vec3 | Self::Color => 3,
        }
    }
}

/// A value of which at least one component depends on a hit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Symbolic {
    pub(super) kind: Kind,
    /// Its components; those beyond its kind's number are not used.
    pub(super) parts: [Scalar; 3],
}

/// A hit.
#[derive(Clone, Copy, Debug)]
pub(super) struct HitValue {
    pub(super) p: [Scalar; 3],
    pub(super) world: [Scalar; 3],
    pub(super) normal: [Scalar; 3],
    pub(super) uv: [Scalar; 2],
    pub(super) time: Scalar,
}

#[derive(Debug)]
pub(super) struct FunctionValue {
    pub(super) kind: FunctionKind,
    /// How deep functions and lists nest in it, so that chains of them stay short enough to be called and dropped.
    pub(super) nesting: u32,
}

#[derive(Debug)]
pub(super) enum FunctionKind {
    /// A function that is written in hry.
    Closure(Closure),
    /// A native function without its arguments.
    Native(Native),
    Constructor(&'static Constructor),
    /// A function with some of its arguments.
    Partial {
        function: Arc<FunctionValue>,
        arguments: Vec<Value>,
    },
    /// `f >> g`
    Compose(Value, Value),
    /// A function of a hit, moved: the hit's position is taken back first.
    Placed {
        inverse: Arc<DAffine3>,
        function: Arc<FunctionValue>,
    },
    /// One function or the other, depending on the hit.
    Select(Scalar, Value, Value),
}

/// One of a group of functions that may call each other.
#[derive(Clone, Debug)]
pub(super) struct Closure {
    pub(super) group: Arc<ClosureGroup>,
    pub(super) index: usize,
}

#[derive(Debug)]
pub(super) struct ClosureGroup {
    pub(super) functions: Arc<[Arc<FunctionCode>]>,
    /// What their bodies use of the surroundings.
    pub(super) captured: Vec<Value>,
}

/// A shape as it was written; it becomes primitives when the scene is put together.
#[derive(Debug)]
pub(super) struct ShapeValue {
    pub(super) node: ShapeNode,
    /// How deep shapes nest in it.
    pub(super) nesting: u32,
    /// The bytes of a mesh that is its own.
    pub(super) _charge: Option<Charge>,
}

impl ShapeValue {
    /// What of it has no inside, if anything has none.
    pub(super) fn hollow(&self) -> Option<Hollow<'_>> {
        match &self.node {
            ShapeNode::Leaf { shape, .. } => (!shape.is_solid()).then_some(Hollow::Shape(shape)),
            ShapeNode::Csg { .. } | ShapeNode::Inverse { .. } => None,
            ShapeNode::Clip { .. } => Some(Hollow::Clipped),
            ShapeNode::Group(list) => list.items.iter().find_map(|item| match item {
                Value::Shape(shape) => shape.hollow(),
                _ => None,
            }),
            ShapeNode::Placed { shape, .. } | ShapeNode::Painted { shape, .. } => shape.hollow(),
        }
    }
}

/// What has no inside.
pub(super) enum Hollow<'a> {
    Shape(&'a Shape),
    /// Whatever is clipped.
    Clipped,
}

#[derive(Debug)]
pub(super) enum ShapeNode {
    /// `origin` is the number of the place that made it, as in `Csg`.
    Leaf {
        shape: Shape,
        material: Option<Arc<MaterialValue>>,
        origin: u32,
    },
    Csg {
        operation: CsgOperation,
        operands: [Arc<ShapeValue>; 2],
        origin: u32,
    },
    Inverse {
        solid: Arc<ShapeValue>,
        origin: u32,
    },
    Clip {
        within: Arc<ShapeValue>,
        shape: Arc<ShapeValue>,
        origin: u32,
    },
    Group(Arc<ListValue>),
    Placed {
        transform: Arc<DAffine3>,
        shape: Arc<ShapeValue>,
    },
    Painted {
        material: Arc<MaterialValue>,
        shape: Arc<ShapeValue>,
    },
}

/// A light, and the number of the place that made it.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightValue {
    pub(super) light: Light,
    pub(super) origin: u32,
}

/// A material: the fields that were given, by their places in its constructor.
#[derive(Clone, Debug)]
pub(super) struct MaterialValue {
    pub(super) fields: Vec<Option<Given>>,
    /// Where it was made.
    pub(super) span: Span,
}

/// A field's value, and the place it was given at.
#[derive(Clone, Debug)]
pub(super) struct Given {
    pub(super) value: Value,
    pub(super) span: Span,
}

impl Value {
    /// What kind of value it is, as messages name it.
    pub(super) fn describe(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Bool(_) => "a truth value",
            Self::Vec2(_) => "a vector of two",
            Self::Vec3(_) => "a vector of three",
            Self::Color(_) => "a colour",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Record(_) => "a record",
            Self::Function(_) => "a function",
            Self::Symbolic(s) => match s.kind {
                Kind::Number => "a number that depends on the hit",
                Kind::Bool => "a truth value that depends on the hit",
                Kind::Vec2 | Kind::Vec3 => "a vector that depends on the hit",
                Kind::Color => "a colour that depends on the hit",
            },
            Self::Hit(_) => "a hit",
            Self::Shape(_) => "a shape",
            Self::Material(_) => "a material",
            Self::Light(_) => "a light",
            Self::Camera(_) => "a camera",
            Self::Image(_) => "an image",
            Self::Integrator(_) => "an integrator",
            Self::Encoding(_) => "an encoding",
        }
    }

    /// How deep functions, lists and records nest in it.
    pub(super) fn nesting(&self) -> u32 {
        match self {
            Self::Function(function) => function.nesting,
            Self::List(list) => list.nesting,
            Self::Record(record) => record.values.iter().map(Self::nesting).max().unwrap_or(0),
            Self::Material(material) => {
                let values = material.fields.iter().flatten().map(|given| given.value.nesting());
                values.max().unwrap_or(0)
            }
            _ => 0,
        }
    }

    /// About how many bytes it holds by itself, besides its own size; 0 where it shares them.
    pub(super) fn owned_bytes(&self) -> u64 {
        const SHAPE: u64 = size_of::<ShapeValue>() as u64 + 16;
        const SMALL: u64 = 64;
        match self {
            Self::Shape(shape) if Arc::strong_count(shape) == 1 => match &shape.node {
                ShapeNode::Leaf { .. }
                | ShapeNode::Csg { .. }
                | ShapeNode::Inverse { .. }
                | ShapeNode::Clip { .. }
                | ShapeNode::Group(_) => SHAPE,
                ShapeNode::Placed { .. } | ShapeNode::Painted { .. } => 2 * SHAPE + 112,
            },
            Self::Record(record) if Arc::strong_count(record) == 1 => {
                SMALL + record.values.iter().map(|v| size_of::<Self>() as u64 + v.owned_bytes()).sum::<u64>()
            }
            Self::Function(f) if Arc::strong_count(f) == 1 => 3 * SMALL,
            Self::Material(m) if Arc::strong_count(m) == 1 => 8 * SMALL,
            Self::Symbolic(_) | Self::Hit(_) | Self::Light(_) | Self::Camera(_) => 2 * SMALL,
            _ => 0,
        }
    }
}
