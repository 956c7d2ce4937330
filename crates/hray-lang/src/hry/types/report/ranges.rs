//! Numbers that a field of a constructor does not take.

use super::super::infer::Infer;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Expr, ExprKind, UnaryOperator};
use crate::hry::library::{Constructor, FieldSpec, Range};

/// The value of a number that stands there as one.
pub(super) fn constant(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Number(value) => Some(*value),
        ExprKind::Unary { operator: UnaryOperator::Negate, operand } => constant(operand).map(|value| -value),
        ExprKind::Annotated { expression, .. } => constant(expression),
        _ => None,
    }
}

/// The numbers of a value, as far as they stand there, each with its place; `rgb` included.
fn constants(expr: &Expr) -> Vec<(f64, Span)> {
    let single = |expr: &Expr| constant(expr).map(|value| (value, expr.span));
    match &expr.kind {
        ExprKind::Vector(parts) => parts.iter().filter_map(single).collect(),
        ExprKind::Apply { .. } => {
            let (callee, arguments) = crate::hry::program::application(expr);
            match &callee.kind {
                ExprKind::Name(name) if &**name == "rgb" => {
                    arguments.into_iter().filter_map(single).collect()
                }
                _ => Vec::new(),
            }
        }
        _ => single(expr).into_iter().collect(),
    }
}

impl Infer<'_> {
    /// Checks a value against the range of its field, as far as it stands there in numbers.
    pub(in crate::hry::types) fn range(
        &mut self,
        constructor: &'static Constructor,
        field: &'static FieldSpec,
        expr: &Expr,
    ) {
        let values = constants(expr);
        if let Range::Direction | Range::Normal = field.range {
            let is_zero = matches!(&expr.kind, ExprKind::Vector(parts) if parts.len() == values.len())
                && values.iter().all(|(value, _)| *value == 0.0);
            match field.range {
                _ if !is_zero => {}
                Range::Normal => {
                    let message =
                        format!("`{}` of `{}` is a vector of length 0", field.name, constructor.name);
                    let warning = Diagnostic::warning("plane-normal", message, expr.span, "surely not meant");
                    self.report(warning.with_help("no ray hits such a plane; a floor has `normal = up`"));
                }
                _ => {
                    self.out_of_range(constructor, field, expr.span, "a vector of length 0 has no direction")
                }
            }
            return;
        }
        for (value, span) in values {
            let problem = problem(field.range, value);
            match problem {
                Some(Problem::Error(text)) => self.out_of_range(constructor, field, span, &text),
                Some(Problem::Warning(code, text, help)) => {
                    let message = format!("`{}` of `{}` {text}", field.name, constructor.name);
                    self.report(Diagnostic::warning(code, message, span, "surely not meant").with_help(help));
                }
                None => {}
            }
        }
    }

    fn out_of_range(&mut self, constructor: &Constructor, field: &FieldSpec, span: Span, text: &str) {
        let message = format!("`{}` of `{}`: {text}", field.name, constructor.name);
        let error = Diagnostic::error("out-of-range", message, span, "not allowed here")
            .with_note(format!("`{}`: {}", field.name, field.doc));
        let error = match (field.name, field.unit) {
            ("fov" | "angle", _) => {
                error.with_help("angles are in radians; one in degrees is written `40deg`")
            }
            _ => error,
        };
        self.report(error);
    }
}

enum Problem {
    Error(String),
    Warning(&'static str, String, &'static str),
}

fn problem(range: Range, value: f64) -> Option<Problem> {
    let error = |is_wrong: bool, text: String| is_wrong.then_some(Problem::Error(text));
    match range {
        Range::Any | Range::Direction | Range::Normal => None,
        Range::Radius => {
            let help = "0 gives a point, which no ray hits; a negative radius turns the normals inward";
            let text = format!("is not greater than 0: {value}");
            (value <= 0.0).then_some(Problem::Warning("sphere-radius", text, help))
        }
        Range::Positive | Range::Positives => error(value <= 0.0, format!("{value} is not greater than 0")),
        Range::NonNegative => error(value < 0.0, format!("{value} is below 0")),
        Range::Between(low, high) => error(
            value <= low || value >= high,
            format!("{value} is not between {low} and {}", rounded(high)),
        ),
        Range::Whole(low, high) => {
            let outside = value < low || value > high;
            let text = if outside {
                format!("{value} is not from {low} to {high}")
            } else {
                format!("{value} is not a whole number")
            };
            error(outside || value % 1.0 != 0.0, text)
        }
        Range::Share => {
            let help = "it is a share: 0 is nothing, 1 is all; 40% is 0.4";
            let wrong = !(0.0..=1.0).contains(&value);
            wrong.then(|| {
                Problem::Warning("share-range", format!("is a share from 0 to 1, but this is {value}"), help)
            })
        }
        Range::Light => {
            let help = "such a light takes light away; 0 is none";
            (value < 0.0).then(|| Problem::Warning("negative-light", format!("is negative: {value}"), help))
        }
    }
}

fn rounded(value: f64) -> f64 {
    (value * 10_000.0).round() / 10_000.0
}
