//! Finds the types of expressions (Hindley and Milner's way, with demands that wait until enough is known).

mod annotation;
mod apply;
mod construct;
mod expr;
mod generalise;
mod group;
mod matching;
mod operators;
mod pattern;
mod records;
mod scene;
mod solve;

pub(super) use expr::made;
pub(super) use group::counted;
pub(super) use operators::written as written_operator;
pub(super) use solve::{Allowed, Failure, field_of};

use super::kind::Kind;
use super::names::Names;
pub(super) use super::scheme::Origin;
use super::scheme::{Binding, Constraint, Demand, Scheme, Types};
use super::store::{Clash, Ty};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{BinaryOperator, Expr, Name};
use crate::hry::library::{Constructor, FieldSpec};
use crate::hry::program::{LoadedModule, Program};
use crate::hry::sources::Sources;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// More errors are counted, not shown.
const MOST_ERRORS: usize = 50;
/// Inference stops where there are more nodes of types.
const MOST_NODES: usize = 10_000_000;

/// Why a type is expected.
#[derive(Clone, Copy, Debug)]
pub(super) enum Why<'p> {
    /// An argument of a function, counted from 0; the function's type before any argument.
    Argument { callee: &'p Expr, index: usize, whole: Ty },
    /// The condition of an `if`, at the `if`.
    Condition(Span),
    /// A condition in a comprehension.
    Guard,
    /// An operand of `and`, `or`, `not`, at the operator.
    Logic(Span, &'static str),
    /// An operand of `<` and its like.
    Order(Span, BinaryOperator),
    /// An exponent.
    Exponent(Span),
    /// A component of a vector.
    Component,
    /// A bound of a range.
    Bound,
    /// What a generator draws from; the pattern.
    Generator(Span),
    /// An element of a list, like the first.
    Item { first: Span },
    /// A branch of an `if`, like the first.
    Branch { first: Span },
    /// An arm of a match, like the first.
    Arm { first: Span },
    /// What `++` joins to the left operand.
    Append { left: Span },
    /// An annotation.
    Annotation(Span),
    /// A field of a constructor.
    Field { constructor: &'static Constructor, field: &'static FieldSpec, name: Span },
    /// A field of a record that is changed.
    Update { name: &'p Name, record: Span },
    /// A pattern, of what it takes apart.
    Pattern { subject: Span },
    /// A definition that uses itself; the name.
    Recursion(Span),
}

/// A type that is expected, and why.
pub(super) type Expected<'p> = Option<(Ty, Why<'p>)>;

/// The inference of a program.
pub(super) struct Infer<'p> {
    pub(super) modules: &'p [Arc<LoadedModule>],
    pub(super) sources: &'p Sources,
    pub(super) root: Option<usize>,
    pub(super) names: &'p Names,
    pub(super) types: Types,
    pub(super) diagnostics: Vec<Diagnostic>,
    /// How many errors there were.
    errors: usize,
    /// How many of them are not shown.
    pub(super) more_errors: usize,
    /// The types of expressions and names.
    pub(super) notes: Vec<(Span, Ty)>,
    /// Uses of fields of constructors.
    pub(super) fields: Vec<(Span, &'static Constructor, &'static FieldSpec)>,
    /// Records that constructors were given.
    pub(super) literals: Vec<(Span, &'static Constructor)>,
    /// `record.field`: the record's place, and the field's.
    pub(super) accesses: Vec<(Span, Span)>,
    pub(super) locals: Vec<Option<Binding>>,
    level: u32,
    constraints: Vec<Constraint>,
    solved: Vec<bool>,
    /// Demands that are not decided, in the order in which they came up.
    pending: Vec<usize>,
    /// By a variable: the demands that wait for it; those on its fields apart.
    waiting: HashMap<Ty, Vec<usize>>,
    waiting_fields: HashMap<Ty, Vec<usize>>,
    registered: HashSet<(Ty, usize)>,
    exhausted: bool,
    /// The last expression that was not what was expected, and its type.
    refused: Option<(Span, Ty)>,
}

impl<'p> Infer<'p> {
    pub(super) fn new(
        modules: &'p [Arc<LoadedModule>],
        sources: &'p Sources,
        root: Option<usize>,
        names: &'p Names,
        types: Types,
    ) -> Self {
        Self {
            modules,
            sources,
            root,
            names,
            types,
            diagnostics: Vec::new(),
            errors: 0,
            more_errors: 0,
            notes: Vec::new(),
            fields: Vec::new(),
            literals: Vec::new(),
            accesses: Vec::new(),
            locals: vec![None; names.locals.len()],
            level: 0,
            constraints: Vec::new(),
            solved: Vec::new(),
            pending: Vec::new(),
            waiting: HashMap::new(),
            waiting_fields: HashMap::new(),
            registered: HashSet::new(),
            exhausted: false,
            refused: None,
        }
    }

    pub(super) fn of_program(program: &'p Program, names: &'p Names, types: Types) -> Self {
        Self::new(&program.modules, &program.sources, Some(program.root), names, types)
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        if diagnostic.is_error() {
            self.errors += 1;
        }
        if diagnostic.is_error() && self.errors > MOST_ERRORS {
            self.more_errors += 1;
        } else {
            self.diagnostics.push(diagnostic);
        }
    }

    /// The last words.
    pub(super) fn finish(&mut self) {
        if self.exhausted {
            let error = Diagnostic::error(
                "type-too-large",
                "the types of this program are too large to keep track of",
                Span::default(),
                "",
            );
            self.diagnostics.push(error.with_help("write types before the definitions that are used most"));
        }
        let more = std::mem::take(&mut self.more_errors);
        if let (1.., Some(last)) = (more, self.diagnostics.last_mut()) {
            last.notes.push(format!("there are {more} more errors"));
        }
    }

    fn note(&mut self, span: Span, ty: Ty) {
        self.notes.push((span, ty));
    }

    fn fresh(&mut self) -> Ty {
        self.fresh_of(Kind::ANY)
    }

    fn fresh_of(&mut self, kind: Kind) -> Ty {
        self.types.store.variable(self.level, kind)
    }

    /// Makes two types the same, and decides what can be decided then.
    fn unify(&mut self, a: Ty, b: Ty) -> Result<(), Clash> {
        let result = self.types.store.unify(a, b);
        self.solve();
        result
    }

    fn narrow(&mut self, ty: Ty, kind: Kind) -> Result<(), Clash> {
        let result = self.types.store.narrow(ty, kind);
        self.solve();
        result
    }

    /// Makes a type what is expected, or reports that it is not; the expected type.
    fn settle(&mut self, expr: &'p Expr, found: Ty, expected: Expected<'p>) -> Ty {
        let Some((ty, why)) = expected else { return found };
        if let Err(clash) = self.unify(found, ty) {
            self.refused = Some((expr.span, found));
            let diagnostic = self.mismatch(Some(expr), expr.span, found, ty, why, clash);
            self.report(diagnostic);
        }
        ty
    }

    /// Whether the outermost word of a type is known, so that it says something to expect it.
    fn is_known(&self, ty: Ty) -> bool {
        self.types.store.head(ty).is_some()
    }

    /// An expectation that says something.
    fn telling(&self, expected: Expected<'p>) -> Expected<'p> {
        expected.filter(|(ty, _)| self.is_known(*ty))
    }

    /// A use of something that has a type for every use.
    fn instantiate(&mut self, scheme: &Scheme, span: Span) -> Ty {
        if scheme.bound.is_empty() {
            return scheme.ty;
        }
        let mut map = HashMap::new();
        for variable in &scheme.bound {
            let kind = self.types.store.kind(*variable).unwrap_or(Kind::ANY);
            let fresh = self.fresh_of(kind);
            map.insert(self.types.store.find(*variable), fresh);
        }
        let ty = self.types.store.copy(scheme.ty, &mut map, 0);
        for constraint in &scheme.constraints {
            let demand = constraint.demand.map(|ty| self.types.store.copy(ty, &mut map, 0));
            let via = Some(constraint.origin.via.unwrap_or(constraint.origin.span));
            self.demand(demand, Origin { span, via, detail: span });
        }
        self.check_size();
        ty
    }

    fn check_size(&mut self) {
        if self.types.store.len() > MOST_NODES && !self.exhausted {
            self.exhausted = true;
            self.pending.clear();
        }
    }

    /// Adds a demand and decides it if it can be.
    fn demand(&mut self, demand: Demand, origin: Origin) {
        let id = self.constraints.len();
        self.constraints.push(Constraint { demand, origin });
        self.solved.push(false);
        self.pending.push(id);
        self.attempt(id);
        self.solve();
    }
}
