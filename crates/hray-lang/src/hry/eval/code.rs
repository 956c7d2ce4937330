//! Expressions made ready for evaluation: every name resolved to where its value is.

use super::value::Symbol;
use crate::diagnostic::Span;
use crate::hry::ast::{BinaryOperator, UnaryOperator};
use crate::hry::library::Constructor;
use std::sync::Arc;

use super::value::Value;

/// An expression and its place.
#[derive(Debug)]
pub(super) struct Code {
    pub(super) kind: CodeKind,
    pub(super) span: Span,
}

#[derive(Debug)]
pub(super) enum CodeKind {
    Constant(Value),
    /// A local of the running function.
    Local(usize),
    /// Something that the running function captured.
    Captured(usize),
    /// A function of the running function's own group.
    Sibling(usize),
    /// A definition: its module and its place there.
    Global(usize, usize),
    Vector2(Box<[Code; 2]>),
    Vector3(Box<[Code; 3]>),
    List(Vec<Code>),
    Range(Box<RangeCode>),
    Comprehension(Box<ComprehensionCode>),
    Record(Arc<[Symbol]>, Vec<Code>),
    Update(Box<Code>, Vec<(Symbol, Code)>),
    Field(Box<Code>, FieldName),
    Call(Box<Code>, Vec<Code>),
    /// A constructor with a record that is written out: the fields by their places.
    Construct(&'static Constructor, Vec<(usize, Code)>),
    Unary(UnaryOperator, Box<Code>),
    Binary(BinaryOperator, Box<[Code; 2]>),
    And(Box<[Code; 2]>),
    Or(Box<[Code; 2]>),
    If(Box<[Code; 3]>),
    Let(Vec<Binding>, Box<Code>),
    Lambda(Lambda),
    Match(Box<Code>, Vec<(Pattern, Code)>),
}

/// A field of a record, or the components of a vector it stands for.
#[derive(Debug)]
pub(super) struct FieldName {
    pub(super) symbol: Symbol,
    pub(super) text: Arc<str>,
    /// Components by number, where the name is made of x, y, z or of r, g, b.
    pub(super) parts: Option<Vec<u8>>,
}

#[derive(Debug)]
pub(super) struct RangeCode {
    pub(super) first: Code,
    pub(super) second: Option<Code>,
    pub(super) last: Code,
}

#[derive(Debug)]
pub(super) struct ComprehensionCode {
    pub(super) body: Code,
    pub(super) qualifiers: Vec<QualifierCode>,
}

#[derive(Debug)]
pub(super) enum QualifierCode {
    Generator(Pattern, Code),
    Guard(Code),
    Let(Vec<Binding>),
}

/// One step of a `let`.
#[derive(Debug)]
pub(super) enum Binding {
    Value(Pattern, Code),
    /// Functions that may call each other; each goes to a local.
    Functions(Lambda, Vec<usize>),
}

/// A group of functions, and where what they capture comes from.
#[derive(Debug)]
pub(super) struct Lambda {
    pub(super) functions: Arc<[Arc<FunctionCode>]>,
    pub(super) captures: Vec<Capture>,
}

/// Where a captured value comes from, in the surrounding function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Capture {
    Local(usize),
    Captured(usize),
    Sibling(usize),
}

/// A function that is written in hry.
#[derive(Debug)]
pub(super) struct FunctionCode {
    /// Its name, where it has one.
    pub(super) name: Option<Arc<str>>,
    /// The definition that it is, where it is one at the top of a file: module and place.
    pub(super) origin: Option<(usize, usize)>,
    /// Parameter i is put into local i, and taken apart by the pattern where that is more than a name.
    pub(super) parameters: Vec<Pattern>,
    pub(super) body: Code,
    /// How many locals it needs.
    pub(super) locals: usize,
}

/// A pattern whose names are locals.
#[derive(Debug)]
pub(super) enum Pattern {
    Local(usize),
    Wildcard,
    Number(f64),
    Bool(bool),
    Text(Arc<str>),
    Vector(Vec<Pattern>),
    List { items: Vec<Pattern>, rest: Option<Option<usize>> },
    Record(Vec<(Symbol, FieldName, Pattern)>),
}
