//! The abstract syntax of a file: what the lossless tree says, without white space and comments.
//!
//! Spans are offsets into the program's [`Sources`](super::Sources), so a span alone tells its file.

use crate::diagnostic::Span;
use std::sync::Arc;

/// A file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Module {
    /// Its imports, in order.
    pub imports: Vec<Import>,
    /// Its definitions, in order. Those that could not be read are left out.
    pub definitions: Vec<Definition>,
}

/// `import "palette.hry" (gold, ink)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The whole of it.
    pub span: Span,
    /// The path as written.
    pub path: Arc<str>,
    /// Its place, quotes included.
    pub path_span: Span,
    /// What comes in, and how.
    pub names: ImportNames,
}

/// What an import brings into scope.
#[derive(Clone, Debug, PartialEq)]
pub enum ImportNames {
    /// Every definition of the file.
    All,
    /// Those listed.
    Listed(Vec<Name>),
    /// None by itself: they are written `name.definition`.
    As(Name),
}

/// A name at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The name.
    pub text: Arc<str>,
    /// Its place.
    pub span: Span,
}

/// `name parameters = body`, at the top or in a `let`. A `let` may bind a pattern instead of a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// What is bound: a [`PatternKind::Name`] wherever there are parameters, and at the top.
    pub target: Pattern,
    /// The parameters; none for a plain value.
    pub parameters: Vec<Pattern>,
    /// What it is.
    pub body: Expr,
    /// Its type, where that is written before it.
    pub annotation: Option<TypeExpr>,
    /// Its documentation (`--|` lines above it), joined by line breaks.
    pub doc: Option<Arc<str>>,
    /// From the name to the end of the body.
    pub span: Span,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Its place.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A number, its suffix applied.
    Number(f64),
    /// `true`, `false`.
    Bool(bool),
    /// A text, its escapes resolved.
    Text(Arc<str>),
    /// `#rrggbb`: the bytes as written (encoded sRGB).
    Color([u8; 3]),
    /// A name.
    Name(Arc<str>),
    /// `(x, y)` or `(x, y, z)`.
    Vector(Vec<Expr>),
    /// `[a, b, c]`.
    List(Vec<Expr>),
    /// `[first .. last]`, `[first, second .. last]`.
    Range {
        /// The first element.
        first: Box<Expr>,
        /// The second, where the step is not 1.
        second: Option<Box<Expr>>,
        /// The bound, included.
        last: Box<Expr>,
    },
    /// `[body | qualifiers]`.
    Comprehension {
        /// An element.
        body: Box<Expr>,
        /// Where elements come from; at least one.
        qualifiers: Vec<Qualifier>,
    },
    /// `{ a = 1, b }`.
    Record(Vec<FieldValue>),
    /// `{ record | a = 1 }`.
    Update {
        /// The record.
        record: Box<Expr>,
        /// What changes; at least one field.
        fields: Vec<FieldValue>,
    },
    /// `record.field`.
    Field {
        /// The record, vector, colour, hit, or qualified import.
        record: Box<Expr>,
        /// The field.
        name: Name,
    },
    /// `function argument`; several arguments nest.
    Apply {
        /// What is called.
        function: Box<Expr>,
        /// With what.
        argument: Box<Expr>,
    },
    /// `-a`, `not a`.
    Unary {
        /// The operator.
        operator: UnaryOperator,
        /// Its operand.
        operand: Box<Expr>,
    },
    /// `a + b` and its like.
    Binary {
        /// The operator.
        operator: BinaryOperator,
        /// Its place.
        operator_span: Span,
        /// The left operand.
        left: Box<Expr>,
        /// The right operand.
        right: Box<Expr>,
    },
    /// `if condition then a else b`.
    If {
        /// The condition.
        condition: Box<Expr>,
        /// Where it is true.
        then: Box<Expr>,
        /// Where it is not.
        otherwise: Box<Expr>,
    },
    /// `let bindings in body`. Bindings may use each other in any order.
    Let {
        /// The bindings.
        bindings: Vec<Definition>,
        /// What they are for.
        body: Box<Expr>,
    },
    /// `\parameters -> body`.
    Lambda {
        /// The parameters; at least one.
        parameters: Vec<Pattern>,
        /// The body.
        body: Box<Expr>,
    },
    /// `match subject { pattern -> body, ... }`.
    Match {
        /// What is looked at.
        subject: Box<Expr>,
        /// The cases, in order.
        arms: Vec<(Pattern, Expr)>,
    },
    /// `(expression : type)`.
    Annotated {
        /// The expression.
        expression: Box<Expr>,
        /// Its type.
        annotation: TypeExpr,
    },
    /// What could not be read; an error was reported.
    Error,
}

/// `name = value` in a record. The value of the short form `name` is the name itself.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldValue {
    /// The field.
    pub name: Name,
    /// Its value.
    pub value: Expr,
}

/// A part of a comprehension after the bar.
#[derive(Clone, Debug, PartialEq)]
pub enum Qualifier {
    /// `pattern <- list`.
    Generator {
        /// Takes an element.
        pattern: Pattern,
        /// Where elements come from.
        list: Expr,
    },
    /// A condition that must hold.
    Guard(Expr),
    /// `let` bindings for what follows.
    Let(Vec<Definition>),
}

/// Prefix operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UnaryOperator {
    /// `-`
    Negate,
    /// `not`
    Not,
}

/// Infix operators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BinaryOperator {
    /// `|>`
    Pipe,
    /// `>>`
    Compose,
    /// `or`
    Or,
    /// `and`
    And,
    /// `==`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `++`
    Append,
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `%`
    Modulo,
    /// `^`
    Power,
}

/// A pattern.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// What it is.
    pub kind: PatternKind,
    /// Its place.
    pub span: Span,
}

/// The kinds of patterns.
#[derive(Clone, Debug, PartialEq)]
pub enum PatternKind {
    /// Binds anything.
    Name(Arc<str>),
    /// Takes anything.
    Wildcard,
    /// That number.
    Number(f64),
    /// That truth value.
    Bool(bool),
    /// That text.
    Text(Arc<str>),
    /// A vector, two or three.
    Vector(Vec<Pattern>),
    /// A list: its first elements, and the rest.
    List {
        /// The first elements.
        items: Vec<Pattern>,
        /// None where the list has no more; else the name of the rest, where it has one.
        rest: Option<Option<Name>>,
    },
    /// A record with at least these fields.
    Record(Vec<(Name, Pattern)>),
    /// What could not be read; an error was reported.
    Error,
}

/// A type as written.
#[derive(Clone, Debug, PartialEq)]
pub struct TypeExpr {
    /// What it is.
    pub kind: TypeExprKind,
    /// Its place.
    pub span: Span,
}

/// The kinds of written types.
#[derive(Clone, Debug, PartialEq)]
pub enum TypeExprKind {
    /// `Number`, `Vec3`, ... or a variable (lower case).
    Name(Arc<str>),
    /// `[a]`
    List(Box<TypeExpr>),
    /// `a -> b`
    Function(Box<TypeExpr>, Box<TypeExpr>),
    /// `{ a : Number }`
    Record(Vec<(Name, TypeExpr)>),
    /// What could not be read; an error was reported.
    Error,
}

impl Expr {
    /// Calls `visit` for this expression and everything in it, the outer before the inner.
    pub fn walk<'e>(&'e self, visit: &mut impl FnMut(&'e Self)) {
        visit(self);
        for child in self.children() {
            child.walk(visit);
        }
    }

    /// The expressions directly in this one, in the order of the source.
    #[must_use]
    pub fn children(&self) -> Vec<&Self> {
        match &self.kind {
            ExprKind::Number(_)
            | ExprKind::Bool(_)
            | ExprKind::Text(_)
            | ExprKind::Color(_)
            | ExprKind::Name(_)
            | ExprKind::Error => Vec::new(),
            ExprKind::Vector(items) | ExprKind::List(items) => items.iter().collect(),
            ExprKind::Range { first, second, last } => {
                [Some(first), second.as_ref(), Some(last)].into_iter().flatten().map(AsRef::as_ref).collect()
            }
            ExprKind::Comprehension { body, qualifiers } => {
                let inner = qualifiers.iter().flat_map(Qualifier::children);
                std::iter::once(&**body).chain(inner).collect()
            }
            ExprKind::Record(fields) => fields.iter().map(|field| &field.value).collect(),
            ExprKind::Update { record, fields } => {
                std::iter::once(&**record).chain(fields.iter().map(|field| &field.value)).collect()
            }
            ExprKind::Field { record, .. } => vec![record],
            ExprKind::Apply { function, argument } => vec![function, argument],
            ExprKind::Unary { operand, .. } => vec![operand],
            ExprKind::Binary { left, right, .. } => vec![left, right],
            ExprKind::If { condition, then, otherwise } => vec![condition, then, otherwise],
            ExprKind::Let { bindings, body } => {
                bindings.iter().map(|binding| &binding.body).chain(std::iter::once(&**body)).collect()
            }
            ExprKind::Lambda { body, .. } => vec![body],
            ExprKind::Match { subject, arms } => {
                std::iter::once(&**subject).chain(arms.iter().map(|(_, body)| body)).collect()
            }
            ExprKind::Annotated { expression, .. } => vec![expression],
        }
    }
}

impl Qualifier {
    /// The expressions directly in it, in the order of the source.
    #[must_use]
    pub fn children(&self) -> Vec<&Expr> {
        match self {
            Self::Generator { list, .. } => vec![list],
            Self::Guard(condition) => vec![condition],
            Self::Let(bindings) => bindings.iter().map(|binding| &binding.body).collect(),
        }
    }
}
