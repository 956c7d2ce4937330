//! Numbers in a text that may be changed by dragging them.

use super::analysis::Analysis;
use crate::diagnostic::Span;
use crate::hry::ast::{ExprKind, UnaryOperator};
use crate::hry::library::Range;
use crate::hry::types::Target;
use std::collections::BTreeMap;

/// A number in the text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberPlace {
    /// Where it is written, its sign and its suffix included.
    pub span: Span,
    /// As it is written: of `30deg` this is 30.
    pub value: f64,
    /// `deg`, or nothing.
    pub unit: &'static str,
    /// A small change: one of the last digit written, or a whole one where only whole numbers are allowed.
    pub step: f64,
    /// The least that is allowed where it is written.
    pub least: Option<f64>,
    /// The greatest.
    pub most: Option<f64>,
}

impl Analysis {
    /// The numbers that are written in the file, in order. In a classic scene they have no bounds.
    #[must_use]
    pub fn numbers(&self) -> Vec<NumberPlace> {
        let Some((program, _)) = &self.hry else { return classic(&self.text) };
        let Some(root) = program.root() else { return Vec::new() };
        let mut ranges = BTreeMap::new();
        let mut found = BTreeMap::new();
        for definition in &root.syntax.definitions {
            definition.body.walk(&mut |expr| {
                let fields = match &expr.kind {
                    ExprKind::Record(fields) | ExprKind::Update { fields, .. } => fields.as_slice(),
                    _ => &[],
                };
                for field in fields {
                    if let Some(Target::Field(_, spec)) = self.target(field.name.span.start) {
                        ranges.insert(field.value.span.start, spec.range);
                    }
                }
                let negated = matches!(&expr.kind, ExprKind::Unary { operator: UnaryOperator::Negate, operand }
                    if matches!(operand.kind, ExprKind::Number(_)));
                if negated || matches!(expr.kind, ExprKind::Number(_)) {
                    found.entry(expr.span.end).or_insert(expr.span);
                }
            });
        }
        let place = |span: &Span| {
            let range = ranges.get(&span.start).copied().unwrap_or(Range::Any);
            number(self.text.get(span.start..span.end)?, *span, range)
        };
        found.values().filter_map(place).collect()
    }
}

/// A number as it is written; none where the text is something else.
fn number(text: &str, span: Span, range: Range) -> Option<NumberPlace> {
    let (digits, unit) = text.strip_suffix("deg").map_or((text, ""), |digits| (digits, "deg"));
    let plain: String = digits.chars().filter(|c| *c != '_' && !c.is_whitespace()).collect();
    let value: f64 = plain.parse().ok().filter(|value: &f64| value.is_finite())?;
    let whole = matches!(range, Range::Whole(..));
    let (mantissa, exponent) = plain.split_once(['e', 'E']).unwrap_or((&plain, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let last = exponent.parse::<i32>().ok()? - i32::try_from(decimals).ok()?;
    let step = format!("1e{last}").parse().ok().filter(|step: &f64| *step > 0.0 && !whole).unwrap_or(1.0);
    let (least, most) = match range {
        Range::Positive | Range::Radius => (Some(step), None),
        Range::NonNegative | Range::Light => (Some(0.0), None),
        Range::Share => (Some(0.0), Some(1.0)),
        Range::Whole(least, most) => (Some(least), Some(most)),
        // Both are excluded, and may be in another unit.
        Range::Between(..) => (None, None),
        _ => (None, None),
    };
    Some(NumberPlace { span, value, unit, step, least, most })
}

/// The numbers of a classic scene: a sign, digits, and a point among them.
fn classic(text: &str) -> Vec<NumberPlace> {
    let bytes = text.as_bytes();
    let is_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'.';
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(&byte) = bytes.get(at) {
        let start = at;
        at += 1;
        let signed = byte == b'-' && bytes.get(at).is_some_and(u8::is_ascii_digit);
        if !signed && !is_word(byte) {
            continue;
        }
        while bytes.get(at).copied().is_some_and(is_word) {
            at += 1;
        }
        if signed || byte.is_ascii_digit() {
            let span = Span::new(start, at);
            found.extend(text.get(start..at).and_then(|text| number(text, span, Range::Any)));
        }
    }
    found
}
