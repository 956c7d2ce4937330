//! Calls of functions of every kind.

use super::code::{Code, FunctionCode, Pattern};
use super::compile::internal;
use super::failure::Outcome;
use super::machine::{Frame, Machine};
use super::value::{ClosureGroup, FunctionKind, FunctionValue, Value};
use crate::diagnostic::Span;
use std::sync::Arc;

impl Machine<'_> {
    pub(super) fn call(
        &mut self,
        callee: &Code,
        arguments: &[Code],
        frame: Frame<'_>,
        span: Span,
    ) -> Outcome<Value> {
        let Value::Function(function) = self.eval(callee, frame)? else {
            return Err(internal(callee.span, "a call of something that is not a function").into());
        };
        match &function.kind {
            FunctionKind::Closure(closure) => {
                if let Some(code) = closure.group.functions.get(closure.index)
                    && code.parameters.len() == arguments.len()
                {
                    let base = self.stack.len();
                    for argument in arguments {
                        match self.eval(argument, frame) {
                            Ok(value) => self.stack.push(value),
                            Err(error) => {
                                self.stack.truncate(base);
                                return Err(error);
                            }
                        }
                    }
                    return self.enter_closure(code, &closure.group, base, span);
                }
            }
            FunctionKind::Native(native) if super::natives::arity(*native) == arguments.len() => {
                let mut values: [Value; 4] = std::array::from_fn(|_| Value::Bool(false));
                for (slot, argument) in values.iter_mut().zip(arguments) {
                    *slot = self.eval(argument, frame)?;
                }
                return self.native(*native, values.get(..arguments.len()).unwrap_or_default(), span);
            }
            _ => {}
        }
        let arguments =
            arguments.iter().map(|argument| self.eval(argument, frame)).collect::<Outcome<Vec<_>>>()?;
        self.apply(&function, &arguments, span)
    }

    /// Runs a function whose arguments lie from `base` on.
    pub(super) fn enter_closure(
        &mut self,
        code: &Arc<FunctionCode>,
        group: &Arc<ClosureGroup>,
        base: usize,
        span: Span,
    ) -> Outcome<Value> {
        if let Err(error) = self.enter(code, base, span) {
            self.stack.truncate(base);
            return Err(error);
        }
        self.calls.push(span);
        let result = self.guarded(|machine| {
            let frame = Frame { base, group: Some(group) };
            for (i, parameter) in code.parameters.iter().enumerate() {
                if !matches!(parameter, Pattern::Local(_)) {
                    let value = machine.local(frame, i, span)?;
                    machine.bind(parameter, &value, frame, span)?;
                }
            }
            machine.eval(&code.body, frame)
        });
        self.calls.pop();
        self.leave(base);
        result.map_err(|mut error| {
            error.in_call(code.name.as_ref(), span);
            error
        })
    }

    /// Calls a function with any number of arguments: fewer than it takes give a function of the rest, more go on to its
    /// result.
    pub(super) fn apply(
        &mut self,
        function: &Arc<FunctionValue>,
        arguments: &[Value],
        span: Span,
    ) -> Outcome<Value> {
        let arity = function.arity();
        if arguments.len() < arity {
            let nesting = arguments.iter().map(Value::nesting).fold(function.nesting, u32::max) + 1;
            let (function, arguments) = (function.clone(), arguments.to_vec());
            return self.function(FunctionKind::Partial { function, arguments }, nesting, span);
        }
        let (now, later) = arguments.split_at(arity);
        let result = self.apply_exactly(function, now, span)?;
        if later.is_empty() {
            return Ok(result);
        }
        match result {
            Value::Function(function) => self.guarded(|machine| machine.apply(&function, later, span)),
            other => Err(internal(span, &format!("a call of {}", other.describe())).into()),
        }
    }

    pub(super) fn apply_exactly(
        &mut self,
        function: &Arc<FunctionValue>,
        arguments: &[Value],
        span: Span,
    ) -> Outcome<Value> {
        match &function.kind {
            FunctionKind::Closure(closure) => {
                let code = closure.group.functions.get(closure.index);
                let code = code.ok_or_else(|| internal(span, "a function that is not there"))?;
                let base = self.stack.len();
                self.stack.extend_from_slice(arguments);
                self.enter_closure(code, &closure.group, base, span)
            }
            FunctionKind::Native(native) => self.native(*native, arguments, span),
            FunctionKind::Constructor(constructor) => match arguments {
                [Value::Record(record)] => {
                    self.step(span)?;
                    let given = self.given(constructor, record, span)?;
                    self.construct(constructor, given, span)
                }
                _ => Err(internal(span, "a constructor without a record").into()),
            },
            FunctionKind::Partial { function, arguments: first } => {
                let all: Vec<Value> = first.iter().chain(arguments).cloned().collect();
                self.guarded(|machine| machine.apply(function, &all, span))
            }
            FunctionKind::Compose(first, second) => {
                let between = self.apply_value(first, arguments, span)?;
                self.apply_value(second, &[between], span)
            }
            FunctionKind::Placed { inverse, function } => match arguments {
                [Value::Hit(hit)] => {
                    let hit = self.moved(hit, inverse, span)?;
                    self.guarded(|machine| machine.apply(function, &[Value::Hit(Arc::new(hit))], span))
                }
                _ => Err(internal(span, "a moved function of something else than a hit").into()),
            },
            FunctionKind::Select(condition, a, b) => {
                let a = self.apply_value(a, arguments, span)?;
                let b = self.apply_value(b, arguments, span)?;
                self.merge(*condition, &a, &b, span)
            }
        }
    }

    /// Calls a value that is a function.
    pub(super) fn apply_value(
        &mut self,
        function: &Value,
        arguments: &[Value],
        span: Span,
    ) -> Outcome<Value> {
        match function {
            Value::Function(function) => self.guarded(|machine| machine.apply(function, arguments, span)),
            other => Err(internal(span, &format!("a call of {}", other.describe())).into()),
        }
    }
}

impl FunctionValue {
    /// How many arguments it takes.
    pub(super) fn arity(&self) -> usize {
        match &self.kind {
            FunctionKind::Closure(closure) => {
                closure.group.functions.get(closure.index).map_or(1, |code| code.parameters.len())
            }
            FunctionKind::Native(native) => super::natives::arity(*native),
            FunctionKind::Partial { function, arguments } => {
                function.arity().saturating_sub(arguments.len()).max(1)
            }
            FunctionKind::Constructor(_)
            | FunctionKind::Compose(..)
            | FunctionKind::Placed { .. }
            | FunctionKind::Select(..) => 1,
        }
    }
}
