//! Lists, ranges and comprehensions; and texts, which are counted as they are.

use super::code::{Code, CodeKind, Pattern, QualifierCode, RangeCode};
use super::compile::internal;
use super::failure::{Failure, Outcome};
use super::machine::{Frame, Machine, depends_on_hit, grouped};
use super::value::{ListValue, Scalar, TextValue, Value};
use crate::diagnostic::{Diagnostic, Span};
use std::sync::Arc;

impl Machine<'_> {
    /// A list, where it is not too long.
    pub(super) fn list(&mut self, items: Vec<Value>, span: Span) -> Outcome<Value> {
        self.check_length(items.len(), span)?;
        let bytes = (items.capacity() * size_of::<Value>()) as u64
            + items.iter().map(Value::owned_bytes).sum::<u64>();
        let nesting = items.iter().map(Value::nesting).max().unwrap_or(0);
        let charge = self.meter.charge(bytes);
        self.check_memory(span)?;
        Ok(Value::List(Arc::new(ListValue { items, nesting, _charge: charge })))
    }

    pub(super) fn check_length(&self, length: usize, span: Span) -> Outcome<()> {
        if length <= self.limits.list {
            return Ok(());
        }
        let message = format!(
            "the list at {} grew past {} elements",
            self.place(span),
            grouped(self.limits.list as u64)
        );
        Err(Failure::new(
            Diagnostic::error("list-too-long", message, span, "this list")
                .with_help("make fewer elements; or raise the budget with `--eval-list`"),
        ))
    }

    pub(super) fn check_memory(&self, span: Span) -> Outcome<()> {
        if self.meter.used() <= self.limits.memory {
            return Ok(());
        }
        let message =
            format!("the values of the scene take more than {} MiB", grouped(self.limits.memory >> 20));
        Err(Failure::new(
            Diagnostic::error(
                "too-much-memory",
                message,
                span,
                "this is what was made when the budget ran out",
            )
            .with_help("make less at a time; or raise the budget with `--eval-memory`"),
        ))
    }

    /// A text, where it is not too long.
    pub(super) fn text(&mut self, text: String, span: Span) -> Outcome<Value> {
        let charge = self.meter.charge(text.capacity() as u64);
        self.check_memory(span)?;
        Ok(Value::Text(Arc::new(TextValue { text, _charge: charge })))
    }

    pub(super) fn range(&mut self, range: &RangeCode, frame: Frame<'_>, span: Span) -> Outcome<Value> {
        let mut bound = |code: &Code| -> Outcome<f64> {
            match self.number(code, frame)? {
                Scalar::Known(value) if value.is_finite() => Ok(value),
                Scalar::Known(value) => {
                    let message = format!("a range cannot have the bound {value}");
                    Err(Failure::new(Diagnostic::error(
                        "range-bound",
                        message,
                        code.span,
                        "not a finite number",
                    )))
                }
                Scalar::Node(_) => Err(depends_on_hit("the length of a list", code.span)),
            }
        };
        let first = bound(&range.first)?;
        let second = range.second.as_ref().map(&mut bound).transpose()?;
        let last = bound(&range.last)?;
        let step = second.map_or(1.0, |second| second - first);
        if step == 0.0 {
            let message = "this range makes no steps, so it would never end";
            return Err(Failure::new(
                Diagnostic::error("range-step", message, span, "its first two numbers are equal")
                    .with_help("`[first, second .. last]` goes on by second - first"),
            ));
        }
        // The last is included where it is met but for rounding.
        let count = ((last - first) / step + 1e-9).floor() + 1.0;
        if count < 1.0 {
            return self.list(Vec::new(), span);
        }
        if count > self.limits.list as f64 {
            self.check_length(usize::MAX, span)?;
        }
        self.steps = self.steps.saturating_add(count as u64);
        self.step(span)?;
        let items = (0..count as usize).map(|i| Value::Number(first + i as f64 * step)).collect();
        self.list(items, span)
    }

    pub(super) fn qualifiers(
        &mut self,
        qualifiers: &[QualifierCode],
        body: &Code,
        frame: Frame<'_>,
        items: &mut Vec<Value>,
        span: Span,
    ) -> Outcome<()> {
        let Some((qualifier, rest)) = qualifiers.split_first() else {
            self.step(span)?;
            self.check_length(items.len() + 1, span)?;
            items.push(self.eval(body, frame)?);
            return Ok(());
        };
        match qualifier {
            QualifierCode::Generator(pattern, list) => {
                // A range that is only walked through need not be made.
                if let CodeKind::Range(range) = &list.kind
                    && range.second.is_none()
                {
                    return self.walk_range(pattern, range, list.span, (rest, body), frame, items, span);
                }
                let Value::List(list) = self.eval(list, frame)? else {
                    return Err(internal(list.span, "a generator over something else than a list").into());
                };
                for item in &list.items {
                    self.bind(pattern, item, frame, span)?;
                    self.qualifiers(rest, body, frame, items, span)?;
                }
                Ok(())
            }
            QualifierCode::Guard(condition) => match self.number(condition, frame)? {
                Scalar::Known(0.0) => self.step(span),
                Scalar::Known(_) => self.qualifiers(rest, body, frame, items, span),
                Scalar::Node(_) => Err(depends_on_hit("the length of a list", condition.span)),
            },
            QualifierCode::Let(bindings) => {
                self.bindings(bindings, frame)?;
                self.qualifiers(rest, body, frame, items, span)
            }
        }
    }

    #[allow(clippy::too_many_arguments, reason = "the state of one loop")]
    pub(super) fn walk_range(
        &mut self,
        pattern: &Pattern,
        range: &RangeCode,
        range_span: Span,
        (rest, body): (&[QualifierCode], &Code),
        frame: Frame<'_>,
        items: &mut Vec<Value>,
        span: Span,
    ) -> Outcome<()> {
        let (first, last) = (self.number(&range.first, frame)?, self.number(&range.last, frame)?);
        let (Scalar::Known(first), Scalar::Known(last)) = (first, last) else {
            return Err(depends_on_hit("the length of a list", range_span));
        };
        if !(first.is_finite() && last.is_finite()) {
            let message = "a range cannot have a bound that is not a finite number";
            return Err(Failure::new(Diagnostic::error("range-bound", message, range_span, "this range")));
        }
        let count = ((last - first) + 1e-9).floor() + 1.0;
        let mut i = 0.0;
        while i < count {
            self.bind(pattern, &Value::Number(first + i), frame, span)?;
            self.qualifiers(rest, body, frame, items, span)?;
            i += 1.0;
        }
        Ok(())
    }
}
