//! Patterns: taking values apart, and choosing between cases.

use super::code::{Code, Pattern};
use super::compile::internal;
use super::failure::{Failure, Outcome};
use super::machine::{Frame, Machine};
use super::scalar::{assemble, parts};
use super::value::{Kind, Scalar, Value};
use crate::diagnostic::{Diagnostic, Span};

/// What a pattern says of a value.
pub(super) enum Matched {
    Yes,
    No,
    /// It depends on the hit.
    Depends(Scalar),
}

impl Machine<'_> {
    /// Binds an irrefutable pattern.
    pub(super) fn bind(
        &mut self,
        pattern: &Pattern,
        value: &Value,
        frame: Frame<'_>,
        span: Span,
    ) -> Outcome<()> {
        match self.matches(pattern, value, frame, span)? {
            Matched::Yes => Ok(()),
            Matched::No | Matched::Depends(_) => {
                let message = format!("{} does not fit this pattern", value.describe());
                Err(Failure::new(Diagnostic::error("no-match", message, span, "taken apart here")))
            }
        }
    }

    /// Whether a value fits a pattern; the names of the pattern are bound as far as it does.
    pub(super) fn matches(
        &mut self,
        pattern: &Pattern,
        value: &Value,
        frame: Frame<'_>,
        span: Span,
    ) -> Outcome<Matched> {
        let equal = |scalar| match scalar {
            Scalar::Known(0.0) => Matched::No,
            Scalar::Known(_) => Matched::Yes,
            depends => Matched::Depends(depends),
        };
        let inner: Vec<(&Pattern, Value)> = match pattern {
            Pattern::Local(local) => {
                self.set_local(frame, *local, value.clone());
                return Ok(Matched::Yes);
            }
            Pattern::Wildcard => return Ok(Matched::Yes),
            Pattern::Number(n) => return self.equal(&Value::Number(*n), value, span).map(equal),
            Pattern::Bool(b) => return self.equal(&Value::Bool(*b), value, span).map(equal),
            Pattern::Text(text) => {
                return Ok(if matches!(value, Value::Text(v) if *v.text == **text) {
                    Matched::Yes
                } else {
                    Matched::No
                });
            }
            Pattern::Vector(items) => {
                let (_, parts) =
                    parts(value).ok_or_else(|| internal(span, "a vector pattern for something else"))?;
                items.iter().zip(parts.map(|part| assemble(Kind::Number, [part; 3]))).collect()
            }
            Pattern::List { items, rest } => {
                let Value::List(list) = value else {
                    return Err(internal(span, "a list pattern for something else").into());
                };
                let fits = if rest.is_some() {
                    list.items.len() >= items.len()
                } else {
                    list.items.len() == items.len()
                };
                if !fits {
                    return Ok(Matched::No);
                }
                if let Some(Some(local)) = rest {
                    let after = list.items.get(items.len()..).unwrap_or_default().to_vec();
                    self.steps = self.steps.saturating_add(after.len() as u64);
                    self.step(span)?;
                    let after = self.list(after, span)?;
                    self.set_local(frame, *local, after);
                }
                items.iter().zip(list.items.iter().cloned()).collect()
            }
            Pattern::Record(fields) => fields
                .iter()
                .map(|(_, name, p)| Ok((p, Self::field(value, name, span)?)))
                .collect::<Outcome<_>>()?,
        };
        let mut all = Scalar::Known(1.0);
        for (pattern, value) in inner {
            match self.matches(pattern, &value, frame, span)? {
                Matched::Yes => {}
                Matched::No => return Ok(Matched::No),
                Matched::Depends(on) => all = self.both(all, on, span)?,
            }
        }
        Ok(equal(all))
    }

    pub(super) fn arms(
        &mut self,
        subject: &Value,
        arms: &[(Pattern, Code)],
        frame: Frame<'_>,
        span: Span,
    ) -> Outcome<Value> {
        let mut depends: Vec<(Scalar, Value)> = Vec::new();
        let mut result = None;
        for (pattern, body) in arms {
            match self.matches(pattern, subject, frame, span)? {
                Matched::No => {}
                Matched::Yes => {
                    result = Some(self.eval(body, frame)?);
                    break;
                }
                Matched::Depends(on) => {
                    self.branch(span)?;
                    let value = self.eval(body, frame)?;
                    depends.push((on, value));
                }
            }
        }
        self.branches -= depends.len() as u32;
        let Some(mut result) = result else {
            let message = "no case of this `match` fits";
            let found = format!("this is {}", self.show(subject, 40));
            return Err(Failure::new(
                Diagnostic::error("no-match", message, span, found)
                    .with_help("add a last case `_ -> ...` for all others"),
            ));
        };
        for (on, value) in depends.into_iter().rev() {
            result = self.merge(on, &value, &result, span)?;
        }
        Ok(result)
    }
}
