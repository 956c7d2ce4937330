//! Demands on types that turn out not to be met, some time after they were made.

use super::super::infer::{Failure, Infer, Origin, written_operator};
use super::super::kind::Kind;
use super::super::scheme::{Constraint, Demand};
use super::super::store::Ty;
use crate::diagnostic::Diagnostic;
use crate::hry::ast::BinaryOperator;
use crate::hry::library::Constructor;

impl Infer<'_> {
    /// Reports a demand that cannot be met.
    pub(in crate::hry::types) fn failed(&mut self, constraint: &Constraint, failure: Failure) {
        let origin = constraint.origin;
        let error = match &constraint.demand {
            Demand::Arithmetic { operator, left, right, result } => {
                self.late_arithmetic(*operator, [*left, *right, *result], origin, failure)
            }
            Demand::Field { record, name, access, result } => match failure {
                Failure::NoField => self.no_field(None, *record, name, *access, origin),
                _ => self.late_field(name, *result, *record, origin),
            },
            Demand::Construct { record, constructor } => self.late_record(*record, constructor, origin),
            Demand::Slot { value, constructor, field } => {
                self.wrong_slot(None, origin.span, *value, constructor, field, None, origin.inside())
            }
        };
        self.report(error);
        if let Demand::Arithmetic { result, .. } | Demand::Field { result, .. } = constraint.demand
            && self.types.store.is_variable(result)
        {
            let _ = self.types.store.unify(result, Ty::ERROR);
        }
    }

    fn late_arithmetic(
        &self,
        operator: BinaryOperator,
        [left, right, result]: [Ty; 3],
        origin: Origin,
        failure: Failure,
    ) -> Diagnostic {
        let word = written_operator(operator);
        let wrong = [left, right].into_iter().find(|ty| {
            !self.types.store.is_error(*ty) && self.types.store.heads(*ty).meet(Kind::NUMERIC).is_empty()
        });
        let (l, r) = (self.words(left), self.words(right));
        let message = match (wrong, failure) {
            (Some(wrong), _) => format!(
                "`{word}` calculates with numbers, vectors and colours, but is given {} here",
                self.words(wrong)
            ),
            (None, Failure::Operands) => {
                format!("`{word}` does not go with {l} and {r}, which it is given here")
            }
            _ => format!("`{word}` of {l} and {r} is not {}, as it would have to be", self.words(result)),
        };
        let label = format!("`{}` {word} `{}`", self.show(left), self.show(right));
        let error = Diagnostic::error("wrong-operand", message, origin.span, label);
        let error = match origin.inside() {
            Some(via) => error.with_secondary(via, "calculated here"),
            None => error,
        };
        error.with_help("both sides have the same type, or one of them is a number")
    }

    fn late_field(&self, name: &str, result: Ty, record: Ty, origin: Origin) -> Diagnostic {
        let message = format!("the field `{name}` is used as {}, which it is not", self.words(result));
        let label = format!("a field of `{}`", self.show(record));
        let error = Diagnostic::error("wrong-field", message, origin.detail, label);
        match origin.inside() {
            Some(via) => error.with_secondary(via, "used here"),
            None => error,
        }
    }

    fn late_record(&self, record: Ty, constructor: &'static Constructor, origin: Origin) -> Diagnostic {
        let name = constructor.name;
        if name == "scene" {
            let message = format!(
                "`scene` is a record, or a function from the time in seconds to one, but this is {}",
                self.words(record)
            );
            return Diagnostic::error(
                "wrong-scene",
                message,
                origin.span,
                format!("found `{}`", self.show(record)),
            );
        }
        let message =
            format!("`{name}` takes a record with named fields, but is given {} here", self.words(record));
        let error = Diagnostic::error(
            "constructor-without-braces",
            message,
            origin.span,
            format!("found `{}`", self.show(record)),
        );
        let error = match origin.inside() {
            Some(via) => error.with_secondary(via, format!("goes to `{name}` here")),
            None => error,
        };
        error.with_help(format!("for example: {}", constructor.example))
    }

    /// Reports a demand that does not hold for all that an annotation promises.
    pub(in crate::hry::types) fn too_special(&mut self, constraint: &Constraint) {
        let origin = constraint.origin;
        let message = match &constraint.demand {
            Demand::Arithmetic { operator, left, right, .. } => format!(
                "`{}` takes the same type twice, or a number, but by the annotation `{}` and `{}` may be different types",
                written_operator(*operator),
                self.show(*left),
                self.show(*right)
            ),
            _ => "this does not work for every type that the annotation allows".into(),
        };
        let error = Diagnostic::error("not-general", message, origin.span, "does not always work");
        self.report(
            error.with_help("give both the same name in the annotation, or make one of them a `Number`"),
        );
    }
}
