//! The evaluator: code and values to values.

use super::code::{Binding, Capture, Code, CodeKind, FieldName, FunctionCode, Lambda};
use super::compile::{Compiler, Symbols, internal};
use super::failure::{Failure, Outcome};
use super::implicit;
use super::limits::{Limits, Meter};
use super::mesh::Prepared;
use super::origins::Places;
use super::scalar::{assemble, parts, truth};
use super::value::{
    Closure, ClosureGroup, FunctionKind, HitValue, Kind, RecordValue, Scalar, Symbol, TextValue, Value,
};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::assets::Assets;
use crate::hry::ast::{BinaryOperator, UnaryOperator};
use crate::hry::program::Program;
use hray_core::Image;
use hray_expr::{Builder, Unary};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// How deep conditions that depend on the hit may nest.
const MOST_BRANCHES: u32 = 600;
/// Stack that must be left for the next call, and what is added where it is not.
const RED_ZONE: usize = 1 << 20;
const MORE_STACK: usize = 16 << 20;

/// Steps after which it is asked anew whether the evaluation is to stop: some microseconds.
const STEPS_BETWEEN_LOOKS: u64 = 1 << 10;

/// What is known of a definition.
enum GlobalState {
    Unknown,
    Running,
    Known(Value),
}

/// An evaluation in progress.
pub(super) struct Machine<'a> {
    pub(super) program: &'a Program,
    pub(super) assets: &'a dyn Assets,
    pub(super) limits: Limits,
    /// Set from outside when nobody waits for the result any more.
    pub(super) stop: Option<&'a AtomicBool>,
    pub(super) meter: Meter,
    pub(super) symbols: Symbols,
    globals: Vec<Vec<GlobalState>>,
    /// The definitions that are being worked out, each needed by the one before.
    running: Vec<(usize, usize)>,
    pub(super) stack: Vec<Value>,
    pub(super) steps: u64,
    depth: u32,
    /// The graph that is being built while a function of a hit is evaluated.
    pub(super) graph: Option<Builder>,
    pub(super) branches: u32,
    pub(super) images: BTreeMap<String, Arc<Image>>,
    /// By their paths, and the normals that were asked for.
    pub(super) models: BTreeMap<(String, Option<bool>), Arc<Prepared>>,
    /// Values of the defaults of constructors' fields.
    pub(super) defaults: BTreeMap<(&'static str, usize), Value>,
    /// Implicit surfaces made so far.
    pub(super) surfaces: implicit::Known,
    pub(super) warnings: Vec<Diagnostic>,
    /// The places that made objects and lights.
    pub(super) places: Places,
    /// The calls that are running, the innermost last; of a definition only those inside it.
    pub(super) calls: Vec<Span>,
    /// The moment that is shown, in seconds.
    pub(super) time: f64,
}

/// A running function.
#[derive(Clone, Copy)]
pub(super) struct Frame<'f> {
    pub(super) base: usize,
    pub(super) group: Option<&'f Arc<ClosureGroup>>,
}

/// A text that is part of the program, so that it need not be counted.
pub(super) fn constant_text(text: &str) -> Value {
    let charge = Meter::default().charge(0);
    Value::Text(Arc::new(TextValue { text: text.to_owned(), _charge: charge }))
}

impl<'a> Machine<'a> {
    pub(super) fn new(program: &'a Program, assets: &'a dyn Assets, limits: Limits) -> Self {
        let count = |definitions: usize| (0..definitions).map(|_| GlobalState::Unknown).collect();
        Self {
            program,
            assets,
            limits,
            stop: None,
            meter: Meter::default(),
            symbols: Symbols::default(),
            globals: program.modules.iter().map(|module| count(module.syntax.definitions.len())).collect(),
            running: Vec::new(),
            stack: Vec::new(),
            steps: 0,
            depth: 0,
            graph: None,
            branches: 0,
            images: BTreeMap::new(),
            models: BTreeMap::new(),
            defaults: BTreeMap::new(),
            surfaces: implicit::Known::new(),
            warnings: Vec::new(),
            places: Places::default(),
            calls: Vec::new(),
            time: 0.0,
        }
    }

    /// `file:line:column` of a place, the file only where it is not the scene itself.
    pub(super) fn place(&self, span: Span) -> String {
        let (file, line, column) = self.program.sources.location(span.start);
        let root = self.program.sources.files().first().is_some_and(|root| root.name == file);
        if root { format!("{line}:{column}") } else { format!("{file}:{line}:{column}") }
    }

    /// The number of a place that makes something now.
    pub(super) fn origin(&mut self, span: Span) -> u32 {
        self.places.number(span, &self.calls)
    }

    /// Counts a step.
    #[inline]
    pub(super) fn step(&mut self, span: Span) -> Outcome<()> {
        self.steps += 1;
        if self.steps > self.limits.steps {
            return Err(self.out_of_steps(span));
        }
        if self.steps.is_multiple_of(STEPS_BETWEEN_LOOKS) { self.look_for_a_stop(span) } else { Ok(()) }
    }

    #[cold]
    fn look_for_a_stop(&self, span: Span) -> Outcome<()> {
        if self.stop.is_none_or(|stop| !stop.load(Ordering::Relaxed)) {
            return Ok(());
        }
        Err(Failure::new(Diagnostic::error("stopped", "the evaluation was stopped", span, "it was here")))
    }

    #[cold]
    fn out_of_steps(&self, span: Span) -> Box<Failure> {
        let message = format!("the scene takes more than {} steps to work out", grouped(self.limits.steps));
        Failure::new(
            Diagnostic::error(
                "too-many-steps",
                message,
                span,
                "this is where it was when the budget ran out",
            )
            .with_help("look for a recursion that does not end; or raise the budget with `--eval-steps`"),
        )
    }

    /// The value of a definition.
    pub(super) fn global(&mut self, module: usize, index: usize, span: Span) -> Outcome<Value> {
        let slot = self.globals.get_mut(module).and_then(|globals| globals.get_mut(index));
        match slot {
            Some(GlobalState::Known(value)) => return Ok(value.clone()),
            Some(GlobalState::Running) => return Err(self.needs_itself(module, index, span)),
            Some(slot) => *slot = GlobalState::Running,
            None => return Err(internal(span, "a definition that is not there").into()),
        }
        // It does not depend on the hit, whoever needs it first.
        let graph = self.graph.take();
        let branches = std::mem::take(&mut self.branches);
        let calls = std::mem::take(&mut self.calls);
        self.running.push((module, index));
        let result = self.evaluate_definition(module, index, span);
        self.running.pop();
        self.calls = calls;
        self.branches = branches;
        self.graph = graph;
        let state = match &result {
            Ok(value) => GlobalState::Known(value.clone()),
            Err(_) => GlobalState::Unknown,
        };
        if let Some(slot) = self.globals.get_mut(module).and_then(|globals| globals.get_mut(index)) {
            *slot = state;
        }
        result
    }

    fn evaluate_definition(&mut self, module: usize, index: usize, span: Span) -> Outcome<Value> {
        let program = self.program;
        let definition = program.definition(module, index);
        let definition = definition.ok_or_else(|| internal(span, "a definition that is not there"))?;
        let code = Compiler::new(program, module, &mut self.symbols).definition(definition, index)?;
        if code.parameters.is_empty() {
            return self.run(&code, None, span);
        }
        let group = Arc::new(ClosureGroup { functions: vec![code].into(), captured: Vec::new() });
        self.function(FunctionKind::Closure(Closure { group, index: 0 }), 1, span)
    }

    fn needs_itself(&self, module: usize, index: usize, span: Span) -> Box<Failure> {
        let name = |(module, index): (usize, usize)| {
            let name = self.program.definition(module, index).and_then(|definition| definition.name());
            name.map_or_else(String::new, |name| name.text.to_string())
        };
        let start = self.running.iter().position(|running| *running == (module, index)).unwrap_or(0);
        let mut circle: Vec<String> = self.running.iter().skip(start).map(|running| name(*running)).collect();
        circle.push(name((module, index)));
        let message = format!("`{}` needs itself", name((module, index)));
        let mut error =
            Diagnostic::error("needs-itself", message, span, "needed here to work out its own value");
        if circle.len() > 2 {
            error = error.with_note(format!("the circle: {}", circle.join(" -> ")));
        }
        Failure::new(error.with_help(
            "only functions may use themselves; give one of them a parameter, or break the circle",
        ))
    }

    /// Evaluates code that stands alone, or a definition without parameters.
    pub(super) fn run(
        &mut self,
        code: &Arc<FunctionCode>,
        group: Option<&Arc<ClosureGroup>>,
        span: Span,
    ) -> Outcome<Value> {
        let base = self.stack.len();
        self.enter(code, base, span)?;
        let result = self.guarded(|machine| machine.eval(&code.body, Frame { base, group }));
        self.leave(base);
        result
    }

    /// Makes room for the locals of a function whose arguments lie from `base` on.
    pub(super) fn enter(&mut self, code: &FunctionCode, base: usize, span: Span) -> Outcome<()> {
        self.step(span)?;
        if self.depth >= self.limits.depth {
            return Err(self.too_deep(code, span));
        }
        self.depth += 1;
        self.stack.resize(base + code.locals, Value::Bool(false));
        Ok(())
    }

    pub(super) fn leave(&mut self, base: usize) {
        self.depth -= 1;
        self.stack.truncate(base);
    }

    #[cold]
    fn too_deep(&self, code: &FunctionCode, span: Span) -> Box<Failure> {
        let name = code.name.as_ref().map_or_else(|| "a function".to_owned(), |name| format!("`{name}`"));
        let message = format!("calls go deeper than {}", grouped(self.limits.depth.into()));
        Failure::new(
            Diagnostic::error("too-deep", message, span, format!("{name} is called once too often inside itself"))
                .with_help(
                    "look for a recursion that does not end; for a long loop use `fold` or `iterate`; or raise the budget with \
                     `--eval-depth`",
                ),
        )
    }

    /// Runs with enough stack.
    pub(super) fn guarded<T>(&mut self, run: impl FnOnce(&mut Self) -> T) -> T {
        stacker::maybe_grow(RED_ZONE, MORE_STACK, || run(self))
    }

    pub(super) fn local(&self, frame: Frame<'_>, local: usize, span: Span) -> Outcome<Value> {
        let value = self.stack.get(frame.base + local).cloned();
        value.ok_or_else(|| internal(span, "a local that is not there").into())
    }

    pub(super) fn set_local(&mut self, frame: Frame<'_>, local: usize, value: Value) {
        if let Some(slot) = self.stack.get_mut(frame.base + local) {
            *slot = value;
        }
    }

    pub(super) fn captured(frame: Frame<'_>, index: usize, span: Span) -> Outcome<Value> {
        let value = frame.group.and_then(|group| group.captured.get(index)).cloned();
        value.ok_or_else(|| internal(span, "a captured value that is not there").into())
    }

    pub(super) fn sibling(&self, frame: Frame<'_>, index: usize, span: Span) -> Outcome<Value> {
        let group = frame.group.ok_or_else(|| internal(span, "a function that is not there"))?;
        let nesting = group.captured.iter().map(Value::nesting).max().unwrap_or(0) + 1;
        self.function(FunctionKind::Closure(Closure { group: group.clone(), index }), nesting, span)
    }

    pub(super) fn eval(&mut self, code: &Code, frame: Frame<'_>) -> Outcome<Value> {
        let span = code.span;
        match &code.kind {
            CodeKind::Constant(value) => Ok(value.clone()),
            CodeKind::Local(local) => self.local(frame, *local, span),
            CodeKind::Captured(index) => Self::captured(frame, *index, span),
            CodeKind::Sibling(index) => self.sibling(frame, *index, span),
            CodeKind::Global(module, index) => {
                match self.globals.get(*module).and_then(|globals| globals.get(*index)) {
                    Some(GlobalState::Known(value)) => Ok(value.clone()),
                    _ => self.guarded(|machine| machine.global(*module, *index, span)),
                }
            }
            CodeKind::Vector2(items) => {
                let [x, y] = &**items;
                let (x, y) = (self.number(x, frame)?, self.number(y, frame)?);
                Ok(assemble(Kind::Vec2, [x, y, Scalar::Known(0.0)]))
            }
            CodeKind::Vector3(items) => {
                let [x, y, z] = &**items;
                let parts = [self.number(x, frame)?, self.number(y, frame)?, self.number(z, frame)?];
                Ok(assemble(Kind::Vec3, parts))
            }
            CodeKind::List(items) => {
                let mut values = Vec::with_capacity(items.len());
                for item in items {
                    self.step(item.span)?;
                    values.push(self.eval(item, frame)?);
                }
                self.list(values, span)
            }
            CodeKind::Range(range) => self.range(range, frame, span),
            CodeKind::Comprehension(comprehension) => {
                let mut items = Vec::new();
                self.qualifiers(&comprehension.qualifiers, &comprehension.body, frame, &mut items, span)?;
                self.list(items, span)
            }
            CodeKind::Record(names, values) => {
                let values = values.iter().map(|value| self.eval(value, frame)).collect::<Outcome<_>>()?;
                Ok(Value::Record(Arc::new(RecordValue { names: names.clone(), values })))
            }
            CodeKind::Update(record, fields) => self.update(record, fields, frame, span),
            CodeKind::Field(record, name) => {
                let record = self.eval(record, frame)?;
                Self::field(&record, name, span)
            }
            CodeKind::Call(function, arguments) => self.call(function, arguments, frame, span),
            CodeKind::Construct(constructor, fields) => {
                let mut given = Vec::with_capacity(constructor.fields.len());
                given.resize_with(constructor.fields.len(), || None);
                for (place, code) in fields {
                    let value = self.eval(code, frame)?;
                    if let Some(slot) = given.get_mut(*place) {
                        *slot = Some(super::value::Given { value, span: code.span });
                    }
                }
                self.step(span)?;
                self.construct(constructor, given, span)
            }
            CodeKind::Unary(UnaryOperator::Negate, operand) => {
                let value = self.eval(operand, frame)?;
                self.each(Unary::Neg, &value, span)
            }
            CodeKind::Unary(UnaryOperator::Not, operand) => {
                let operand = self.number(operand, frame)?;
                let not = self.unary(Unary::Not, operand, span)?;
                Ok(assemble(Kind::Bool, [not; 3]))
            }
            CodeKind::Binary(operator, operands) => {
                let [left, right] = &**operands;
                let left = self.eval(left, frame)?;
                let right = self.eval(right, frame)?;
                self.operate(*operator, &left, &right, span)
            }
            CodeKind::And(operands) => {
                let [left, right] = &**operands;
                match self.number(left, frame)? {
                    Scalar::Known(0.0) => Ok(Value::Bool(false)),
                    left => {
                        let right = self.number(right, frame)?;
                        let both = self.both(left, right, span)?;
                        Ok(assemble(Kind::Bool, [both; 3]))
                    }
                }
            }
            CodeKind::Or(operands) => {
                let [left, right] = &**operands;
                let left = self.number(left, frame)?;
                if matches!(left, Scalar::Known(value) if value != 0.0) {
                    return Ok(Value::Bool(true));
                }
                let right = self.number(right, frame)?;
                let either = match (left, right) {
                    (Scalar::Known(_), right) => right,
                    (left, Scalar::Known(0.0)) => left,
                    (left, right) => self.binary(hray_expr::Binary::Or, left, right, span)?,
                };
                Ok(assemble(Kind::Bool, [either; 3]))
            }
            CodeKind::If(parts) => {
                let [condition, then, otherwise] = &**parts;
                self.step(span)?;
                match self.number(condition, frame)? {
                    Scalar::Known(0.0) => self.eval(otherwise, frame),
                    Scalar::Known(_) => self.eval(then, frame),
                    depends => {
                        self.branch(condition.span)?;
                        let then = self.eval(then, frame)?;
                        let otherwise = self.eval(otherwise, frame)?;
                        self.branches -= 1;
                        self.merge(depends, &then, &otherwise, condition.span)
                    }
                }
            }
            CodeKind::Let(bindings, body) => {
                self.bindings(bindings, frame)?;
                self.eval(body, frame)
            }
            CodeKind::Lambda(lambda) => {
                let group = self.close(lambda, frame, span)?;
                let nesting = group.captured.iter().map(Value::nesting).max().unwrap_or(0) + 1;
                self.function(FunctionKind::Closure(Closure { group, index: 0 }), nesting, span)
            }
            CodeKind::Match(subject, arms) => {
                let subject_value = self.eval(subject, frame)?;
                self.step(span)?;
                self.arms(&subject_value, arms, frame, subject.span)
            }
        }
    }

    /// The value of an expression that is a number or a truth value.
    pub(super) fn number(&mut self, code: &Code, frame: Frame<'_>) -> Outcome<Scalar> {
        match self.eval(code, frame)? {
            Value::Number(n) => Ok(Scalar::Known(n)),
            Value::Bool(b) => Ok(truth(b)),
            Value::Symbolic(symbolic) if symbolic.kind.len() == 1 => Ok(symbolic.parts[0]),
            other => {
                Err(internal(code.span, &format!("{} where a number is needed", other.describe())).into())
            }
        }
    }

    /// Enters a branch that depends on the hit.
    pub(super) fn branch(&mut self, span: Span) -> Outcome<()> {
        self.branches += 1;
        if self.branches <= MOST_BRANCHES {
            return Ok(());
        }
        Err(Failure::new(
            Diagnostic::error(
                "recursion-on-hit",
                "this recursion ends only where the hit says so",
                span,
                "this condition depends on the hit, so both of its branches are followed, without end",
            )
            .with_note("a function of a hit is worked out once, for all hits: how often it recurses cannot depend on one")
            .with_help("write the loop as `iterate max until step start`, which may end where the hit says so"),
        ))
    }

    pub(super) fn bindings(&mut self, bindings: &[Binding], frame: Frame<'_>) -> Outcome<()> {
        for binding in bindings {
            match binding {
                Binding::Value(pattern, code) => {
                    let value = self.eval(code, frame)?;
                    self.bind(pattern, &value, frame, code.span)?;
                }
                Binding::Functions(lambda, locals) => {
                    let group = self.close(lambda, frame, Span::at(0))?;
                    let nesting = group.captured.iter().map(Value::nesting).max().unwrap_or(0) + 1;
                    for (index, local) in locals.iter().enumerate() {
                        let kind = FunctionKind::Closure(Closure { group: group.clone(), index });
                        let value = self.function(kind, nesting, Span::at(0))?;
                        self.set_local(frame, *local, value);
                    }
                }
            }
        }
        Ok(())
    }

    /// A group of functions with what they capture.
    fn close(&mut self, lambda: &Lambda, frame: Frame<'_>, span: Span) -> Outcome<Arc<ClosureGroup>> {
        let captured = lambda
            .captures
            .iter()
            .map(|capture| match *capture {
                Capture::Local(local) => self.local(frame, local, span),
                Capture::Captured(index) => Self::captured(frame, index, span),
                Capture::Sibling(index) => self.sibling(frame, index, span),
            })
            .collect::<Outcome<_>>()?;
        Ok(Arc::new(ClosureGroup { functions: lambda.functions.clone(), captured }))
    }

    /// `{ record | field = value }`.
    fn update(
        &mut self,
        record: &Code,
        fields: &[(Symbol, Code)],
        frame: Frame<'_>,
        span: Span,
    ) -> Outcome<Value> {
        match self.eval(record, frame)? {
            Value::Record(record) => {
                let mut values = record.values.clone();
                for (name, code) in fields {
                    let value = self.eval(code, frame)?;
                    let place = record.names.iter().position(|n| n == name);
                    match place.and_then(|place| values.get_mut(place)) {
                        Some(slot) => *slot = value,
                        None => {
                            return Err(internal(code.span, "an update of a field that is not there").into());
                        }
                    }
                }
                Ok(Value::Record(Arc::new(RecordValue { names: record.names.clone(), values })))
            }
            Value::Hit(hit) => {
                let mut hit = *hit;
                for (name, code) in fields {
                    let value = self.eval(code, frame)?;
                    let (_, value) =
                        parts(&value).ok_or_else(|| internal(code.span, "a hit of something else"))?;
                    match self.symbols.name(*name) {
                        "p" => hit.p = value,
                        "world" => hit.world = value,
                        "normal" => hit.normal = value,
                        "uv" => hit.uv = [value[0], value[1]],
                        "time" => hit.time = value[0],
                        _ => {
                            return Err(
                                internal(code.span, "an update of a field that a hit does not have").into()
                            );
                        }
                    }
                }
                Ok(Value::Hit(Arc::new(hit)))
            }
            other => Err(internal(span, &format!("an update of {}", other.describe())).into()),
        }
    }

    pub(super) fn field(record: &Value, name: &FieldName, span: Span) -> Outcome<Value> {
        let missing = || -> Box<Failure> {
            internal(span, &format!("a field `{}` that is not there", name.text)).into()
        };
        match record {
            Value::Record(record) => record.get(name.symbol).cloned().ok_or_else(missing),
            Value::Hit(hit) => {
                let HitValue { p, world, normal, uv, time } = **hit;
                Ok(match &*name.text {
                    "p" => assemble(Kind::Vec3, p),
                    "world" => assemble(Kind::Vec3, world),
                    "normal" => assemble(Kind::Vec3, normal),
                    "uv" => assemble(Kind::Vec2, [uv[0], uv[1], Scalar::Known(0.0)]),
                    "time" => assemble(Kind::Number, [time; 3]),
                    _ => return Err(missing()),
                })
            }
            value => {
                let (Some((_, parts)), Some(places)) = (parts(value), &name.parts) else {
                    return Err(missing());
                };
                let mut picked = [Scalar::Known(0.0); 3];
                for (slot, place) in picked.iter_mut().zip(places) {
                    *slot = *parts.get(usize::from(*place)).ok_or_else(missing)?;
                }
                let kind = match places.len() {
                    1 => Kind::Number,
                    2 => Kind::Vec2,
                    _ => Kind::Vec3,
                };
                Ok(assemble(kind, picked))
            }
        }
    }

    fn operate(
        &mut self,
        operator: BinaryOperator,
        left: &Value,
        right: &Value,
        span: Span,
    ) -> Outcome<Value> {
        match operator {
            BinaryOperator::Equal => {
                let equal = self.equal(left, right, span)?;
                Ok(assemble(Kind::Bool, [equal; 3]))
            }
            BinaryOperator::NotEqual => {
                let equal = self.equal(left, right, span)?;
                let not = self.unary(Unary::Not, equal, span)?;
                Ok(assemble(Kind::Bool, [not; 3]))
            }
            BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual => self.comparison(operator, left, right, span),
            BinaryOperator::Append => match (left, right) {
                (Value::List(left), Value::List(right)) => {
                    self.check_length(left.items.len().saturating_add(right.items.len()), span)?;
                    let items: Vec<Value> = left.items.iter().chain(&right.items).cloned().collect();
                    self.steps = self.steps.saturating_add(items.len() as u64);
                    self.step(span)?;
                    self.list(items, span)
                }
                (Value::Text(left), Value::Text(right)) => {
                    let text = format!("{}{}", left.text, right.text);
                    self.text(text, span)
                }
                _ => Err(internal(span, "`++` of something else than lists and texts").into()),
            },
            BinaryOperator::Compose => {
                let nesting = left.nesting().max(right.nesting()) + 1;
                self.function(FunctionKind::Compose(left.clone(), right.clone()), nesting, span)
            }
            _ => self.arithmetic(operator, left, right, span),
        }
    }
}

/// The complaint that something depends on the hit which may not.
pub(super) fn depends_on_hit(what: &str, span: Span) -> Box<Failure> {
    Failure::new(
        Diagnostic::error("depends-on-hit", format!("{what} cannot depend on the hit"), span, "this depends on the hit")
            .with_help(
                "a function of a hit is worked out once, for all hits; only numbers, truth values, vectors and colours in it may \
                 depend on one",
            ),
    )
}

/// A number with commas between its thousands.
pub(super) fn grouped(number: u64) -> String {
    match number {
        1_000_000.. if number.is_multiple_of(1_000_000) => format!("{} million", grouped(number / 1_000_000)),
        _ => {
            let digits = number.to_string();
            let mut text = String::new();
            for (i, digit) in digits.chars().enumerate() {
                if i > 0 && (digits.len() - i).is_multiple_of(3) {
                    text.push(',');
                }
                text.push(digit);
            }
            text
        }
    }
}
