//! What is known of the types of names, and what is still demanded of types.

use super::store::{Store, Ty};
use crate::diagnostic::Span;
use crate::hry::ast::BinaryOperator;
use crate::hry::library::{Constructor, FieldSpec};
use crate::hry::sources::STANDARD_BASE;
use std::sync::Arc;

/// The type of a definition, for all values of its variables.
#[derive(Clone, Debug)]
pub(super) struct Scheme {
    pub(super) ty: Ty,
    /// The variables, rigid ones of annotations included.
    pub(super) bound: Vec<Ty>,
    /// What must hold of them.
    pub(super) constraints: Vec<Constraint>,
}

/// What is known of the type of a name.
#[derive(Clone, Debug)]
pub(super) enum Binding {
    /// One type: of parameters, and of definitions while they are looked at.
    Mono(Ty),
    /// A type for every use.
    Poly(Arc<Scheme>),
}

/// A demand that could not be decided yet.
#[derive(Clone, Debug)]
pub(super) struct Constraint {
    pub(super) demand: Demand,
    pub(super) origin: Origin,
}

/// Where a demand comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    /// Where it is made.
    pub(super) span: Span,
    /// Inside which function it is really made, where `span` is a use of that.
    pub(super) via: Option<Span>,
    /// The place of an operator, or of the name of a field.
    pub(super) detail: Span,
}

impl Origin {
    /// Where inside a function of the user's own files the demand is really made.
    pub(super) fn inside(&self) -> Option<Span> {
        self.via.filter(|via| via.start < STANDARD_BASE)
    }
}

/// How a field is used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Access {
    /// `record.field`
    Read,
    /// `{ record | field = ... }`, or a record pattern: not of vectors and colours.
    Whole,
}

/// What is demanded of types.
#[derive(Clone, Debug)]
pub(super) enum Demand {
    /// `left + right` and its like: the same type twice, or one is a number.
    Arithmetic { operator: BinaryOperator, left: Ty, right: Ty, result: Ty },
    /// `record` has a field.
    Field { record: Ty, name: Arc<str>, result: Ty, access: Access },
    /// `record` can be given to a constructor.
    Construct { record: Ty, constructor: &'static Constructor },
    /// `value` can be given to a field of a constructor.
    Slot { value: Ty, constructor: &'static Constructor, field: &'static FieldSpec },
}

impl Demand {
    /// The types it is about; some of them twice.
    pub(super) const fn types(&self) -> [Ty; 3] {
        match self {
            Self::Arithmetic { left, right, result, .. } => [*left, *right, *result],
            Self::Field { record, result, .. } => [*record, *result, *result],
            Self::Construct { record, .. } => [*record; 3],
            Self::Slot { value, .. } => [*value; 3],
        }
    }

    /// The same about other types.
    pub(super) fn map(&self, mut with: impl FnMut(Ty) -> Ty) -> Self {
        match self.clone() {
            Self::Arithmetic { operator, left, right, result } => {
                Self::Arithmetic { operator, left: with(left), right: with(right), result: with(result) }
            }
            Self::Field { record, name, result, access } => {
                Self::Field { record: with(record), name, result: with(result), access }
            }
            Self::Construct { record, constructor } => Self::Construct { record: with(record), constructor },
            Self::Slot { value, constructor, field } => Self::Slot { value: with(value), constructor, field },
        }
    }
}

/// All that is known of the types of definitions and of the library.
#[derive(Clone, Debug, Default)]
pub(super) struct Types {
    pub(super) store: Store,
    /// By module and definition.
    pub(super) definitions: Vec<Vec<Binding>>,
    /// In the order of the table.
    pub(super) natives: Vec<Arc<Scheme>>,
}
