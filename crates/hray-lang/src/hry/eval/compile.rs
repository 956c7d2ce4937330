//! From syntax to code: names become places.

use super::code::{
    Binding, Capture, Code, CodeKind, ComprehensionCode, FieldName, FunctionCode, Lambda, Pattern,
    QualifierCode, RangeCode,
};
use super::value::{FunctionKind, FunctionValue, Symbol, Value};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{self, BinaryOperator, Definition, Expr, ExprKind, PatternKind, Qualifier};
use crate::hry::library::Native;
use crate::hry::program::{Global, Program, application};
use hray_core::{Encoding, Integrator};
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// All field names that occur, each with its number.
#[derive(Debug, Default)]
pub(super) struct Symbols {
    numbers: HashMap<Arc<str>, Symbol>,
    names: Vec<Arc<str>>,
}

impl Symbols {
    pub(super) fn number(&mut self, name: &str) -> Symbol {
        if let Some(symbol) = self.numbers.get(name) {
            return *symbol;
        }
        let (symbol, name) = (Symbol(self.names.len() as u32), Arc::<str>::from(name));
        self.numbers.insert(name.clone(), symbol);
        self.names.push(name);
        symbol
    }

    pub(super) fn name(&self, symbol: Symbol) -> &str {
        self.names.get(symbol.0 as usize).map_or("", |name| name)
    }
}

/// What a name means inside a function.
#[derive(Clone, Copy)]
enum Place {
    Local(usize),
    Captured(usize),
    Sibling(usize),
}

/// A function that is being compiled.
#[derive(Default)]
struct Scope {
    /// Names in scope, innermost last, with their locals.
    names: Vec<(Arc<str>, usize)>,
    locals: usize,
    /// The names of the function's own group.
    siblings: Vec<Arc<str>>,
    captures: Vec<(Arc<str>, Capture)>,
}

/// Compiles the expressions of one module.
pub(super) struct Compiler<'a> {
    program: &'a Program,
    module: usize,
    symbols: &'a mut Symbols,
    scopes: Vec<Scope>,
}

/// A function as it is written: its name, where it has one, its parameters and its body.
type Written<'d> = (Option<Arc<str>>, &'d [ast::Pattern], &'d Expr);
type Result<T> = std::result::Result<T, Box<Diagnostic>>;

impl<'a> Compiler<'a> {
    pub(super) fn new(program: &'a Program, module: usize, symbols: &'a mut Symbols) -> Self {
        Self { program, module, symbols, scopes: vec![Scope::default()] }
    }

    /// A definition at the top: its body as a function without parameters, or itself as a function.
    pub(super) fn definition(&mut self, definition: &Definition, index: usize) -> Result<Arc<FunctionCode>> {
        let name = definition.name().map(|name| name.text);
        self.scopes = vec![Scope::default()];
        let function = self.body(name, &definition.parameters, &definition.body)?;
        Ok(Arc::new(FunctionCode { origin: Some((self.module, index)), ..function }))
    }

    /// An expression that stands alone.
    pub(super) fn expression(&mut self, expr: &Expr) -> Result<Arc<FunctionCode>> {
        self.scopes = vec![Scope::default()];
        Ok(Arc::new(self.body(None, &[], expr)?))
    }

    /// Parameters and body in the scope on top.
    fn body(
        &mut self,
        name: Option<Arc<str>>,
        parameters: &[ast::Pattern],
        body: &Expr,
    ) -> Result<FunctionCode> {
        for _ in parameters {
            self.new_local();
        }
        let patterns: Vec<Pattern> = parameters
            .iter()
            .enumerate()
            .map(|(i, parameter)| match &parameter.kind {
                PatternKind::Name(name) => {
                    self.scope().names.push((name.clone(), i));
                    Ok(Pattern::Local(i))
                }
                _ => self.pattern(parameter),
            })
            .collect::<Result<_>>()?;
        let body = self.expr(body)?;
        Ok(FunctionCode { name, origin: None, parameters: patterns, body, locals: self.scope().locals })
    }

    fn scope(&mut self) -> &mut Scope {
        if self.scopes.is_empty() {
            self.scopes.push(Scope::default());
        }
        let last = self.scopes.len() - 1;
        &mut self.scopes[last]
    }

    fn new_local(&mut self) -> usize {
        let scope = self.scope();
        scope.locals += 1;
        scope.locals - 1
    }

    fn bind(&mut self, name: &Arc<str>) -> usize {
        let local = self.new_local();
        self.scope().names.push((name.clone(), local));
        local
    }

    fn pattern(&mut self, pattern: &ast::Pattern) -> Result<Pattern> {
        Ok(match &pattern.kind {
            PatternKind::Name(name) => Pattern::Local(self.bind(name)),
            PatternKind::Wildcard => Pattern::Wildcard,
            PatternKind::Number(n) => Pattern::Number(*n),
            PatternKind::Bool(b) => Pattern::Bool(*b),
            PatternKind::Text(text) => Pattern::Text(text.clone()),
            PatternKind::Vector(items) => Pattern::Vector(self.patterns(items)?),
            PatternKind::List { items, rest } => {
                let items = self.patterns(items)?;
                let rest = rest.as_ref().map(|name| name.as_ref().map(|name| self.bind(&name.text)));
                Pattern::List { items, rest }
            }
            PatternKind::Record(fields) => Pattern::Record(
                fields
                    .iter()
                    .map(|(name, pattern)| {
                        let field = self.field_name(&name.text);
                        Ok((field.symbol, field, self.pattern(pattern)?))
                    })
                    .collect::<Result<_>>()?,
            ),
            PatternKind::Error => return Err(internal(pattern.span, "a pattern that could not be read")),
        })
    }

    fn patterns(&mut self, patterns: &[ast::Pattern]) -> Result<Vec<Pattern>> {
        patterns.iter().map(|pattern| self.pattern(pattern)).collect()
    }

    fn field_name(&mut self, text: &Arc<str>) -> FieldName {
        FieldName { symbol: self.symbols.number(text), text: text.clone(), parts: components(text) }
    }

    /// Where the value of a name is, in the function at `level`; captures are added on the way.
    fn find(&mut self, name: &str, level: usize) -> Option<Place> {
        let scope = self.scopes.get(level)?;
        if let Some((_, local)) = scope.names.iter().rev().find(|(n, _)| **n == *name) {
            return Some(Place::Local(*local));
        }
        if let Some(index) = scope.siblings.iter().position(|n| **n == *name) {
            return Some(Place::Sibling(index));
        }
        if let Some(index) = scope.captures.iter().position(|(n, _)| **n == *name) {
            return Some(Place::Captured(index));
        }
        let outside = match self.find(name, level.checked_sub(1)?)? {
            Place::Local(local) => Capture::Local(local),
            Place::Captured(index) => Capture::Captured(index),
            Place::Sibling(index) => Capture::Sibling(index),
        };
        let captures = &mut self.scopes.get_mut(level)?.captures;
        captures.push((name.into(), outside));
        Some(Place::Captured(captures.len() - 1))
    }

    fn name(&mut self, name: &str, span: Span) -> Result<CodeKind> {
        Ok(match self.find(name, self.scopes.len() - 1) {
            Some(Place::Local(local)) => CodeKind::Local(local),
            Some(Place::Captured(index)) => CodeKind::Captured(index),
            Some(Place::Sibling(index)) => CodeKind::Sibling(index),
            None => {
                let module = self.program.modules.get(self.module);
                let global = module.and_then(|module| module.scope.get(name));
                let unknown = || internal(span, &format!("the name `{name}` means nothing"));
                Self::global(global.ok_or_else(unknown)?)
            }
        })
    }

    fn global(global: Global) -> CodeKind {
        let function =
            |kind| CodeKind::Constant(Value::Function(Arc::new(FunctionValue { kind, nesting: 0 })));
        match global {
            Global::Definition { module, index } => CodeKind::Global(module, index),
            Global::Constructor(constructor) => function(FunctionKind::Constructor(constructor)),
            Global::Native(spec) => CodeKind::Constant(match spec.native {
                Native::Whitted => Value::Integrator(Integrator::Classic),
                Native::Classic2005 => Value::Integrator(Integrator::Classic2005),
                Native::Srgb => Value::Encoding(Encoding::Srgb),
                Native::Raw => Value::Encoding(Encoding::Raw),
                native => return function(FunctionKind::Native(native)),
            }),
        }
    }

    fn exprs(&mut self, exprs: &[Expr]) -> Result<Vec<Code>> {
        exprs.iter().map(|expr| self.expr(expr)).collect()
    }

    fn pair(&mut self, left: &Expr, right: &Expr) -> Result<Box<[Code; 2]>> {
        Ok(Box::new([self.expr(left)?, self.expr(right)?]))
    }

    /// Compiles an expression.
    fn expr(&mut self, expr: &Expr) -> Result<Code> {
        let kind = match &expr.kind {
            ExprKind::Number(n) => CodeKind::Constant(Value::Number(*n)),
            ExprKind::Bool(b) => CodeKind::Constant(Value::Bool(*b)),
            ExprKind::Text(text) => CodeKind::Constant(super::machine::constant_text(text)),
            ExprKind::Color(bytes) => CodeKind::Constant(Value::Color(bytes.map(super::color::decode))),
            ExprKind::Name(name) => self.name(name, expr.span)?,
            ExprKind::Vector(items) => match &items[..] {
                [x, y] => CodeKind::Vector2(self.pair(x, y)?),
                [x, y, z] => CodeKind::Vector3(Box::new([self.expr(x)?, self.expr(y)?, self.expr(z)?])),
                _ => return Err(internal(expr.span, "a vector of another size than 2 or 3")),
            },
            ExprKind::List(items) => CodeKind::List(self.exprs(items)?),
            ExprKind::Range { first, second, last } => CodeKind::Range(Box::new(RangeCode {
                first: self.expr(first)?,
                second: second.as_ref().map(|second| self.expr(second)).transpose()?,
                last: self.expr(last)?,
            })),
            ExprKind::Comprehension { body, qualifiers } => self.comprehension(body, qualifiers)?,
            ExprKind::Record(fields) => {
                let names: Vec<Symbol> = fields.iter().map(|f| self.symbols.number(&f.name.text)).collect();
                let values = fields.iter().map(|f| self.expr(&f.value)).collect::<Result<_>>()?;
                CodeKind::Record(names.into(), values)
            }
            ExprKind::Update { record, fields } => {
                let record = Box::new(self.expr(record)?);
                let field =
                    |f: &ast::FieldValue| Ok((self.symbols.number(&f.name.text), self.expr(&f.value)?));
                CodeKind::Update(record, fields.iter().map(field).collect::<Result<_>>()?)
            }
            ExprKind::Field { record, name } => match self.qualified(record, name) {
                Some(global) => Self::global(global),
                None => CodeKind::Field(Box::new(self.expr(record)?), self.field_name(&name.text)),
            },
            ExprKind::Apply { .. } => self.call(expr)?,
            ExprKind::Unary { operator, operand } => {
                CodeKind::Unary(*operator, Box::new(self.expr(operand)?))
            }
            ExprKind::Binary { operator, left, right, .. } => match operator {
                BinaryOperator::Pipe => {
                    let (callee, arguments) = application(right);
                    let arguments =
                        arguments.into_iter().chain([&**left]).map(|argument| self.expr(argument));
                    let arguments = arguments.collect::<Result<_>>()?;
                    CodeKind::Call(Box::new(self.expr(callee)?), arguments)
                }
                BinaryOperator::And => CodeKind::And(self.pair(left, right)?),
                BinaryOperator::Or => CodeKind::Or(self.pair(left, right)?),
                _ => CodeKind::Binary(*operator, self.pair(left, right)?),
            },
            ExprKind::If { condition, then, otherwise } => {
                CodeKind::If(Box::new([self.expr(condition)?, self.expr(then)?, self.expr(otherwise)?]))
            }
            ExprKind::Let { bindings, body } => {
                let depth = self.scope().names.len();
                let bindings = self.bindings(bindings)?;
                let body = self.expr(body)?;
                self.scope().names.truncate(depth);
                CodeKind::Let(bindings, Box::new(body))
            }
            ExprKind::Lambda { parameters, body } => CodeKind::Lambda(self.lambda(parameters, body)?),
            ExprKind::Match { subject, arms } => {
                let subject = Box::new(self.expr(subject)?);
                let mut compiled = Vec::new();
                for (pattern, body) in arms {
                    let depth = self.scope().names.len();
                    let pattern = self.pattern(pattern)?;
                    compiled.push((pattern, self.expr(body)?));
                    self.scope().names.truncate(depth);
                }
                CodeKind::Match(subject, compiled)
            }
            ExprKind::Annotated { expression, .. } => return self.expr(expression),
            ExprKind::Error => return Err(internal(expr.span, "an expression that could not be read")),
        };
        Ok(Code { kind, span: expr.span })
    }

    /// `palette.gold`, where `palette` is an import and no local of that name hides it.
    fn qualified(&mut self, record: &Expr, name: &ast::Name) -> Option<Global> {
        let ExprKind::Name(prefix) = &record.kind else { return None };
        if self.find(prefix, self.scopes.len() - 1).is_some() {
            return None;
        }
        let scope = &self.program.modules.get(self.module)?.scope;
        scope.qualified.get(prefix)?.get(&name.text).copied()
    }

    fn call(&mut self, expr: &Expr) -> Result<CodeKind> {
        let (callee, arguments) = application(expr);
        let code = self.expr(callee)?;
        if let (CodeKind::Constant(Value::Function(function)), [argument]) = (&code.kind, &arguments[..])
            && let (FunctionKind::Constructor(constructor), ExprKind::Record(fields)) =
                (&function.kind, &argument.kind)
        {
            let known = |f: &ast::FieldValue| constructor.field(&f.name.text).map(|(place, _)| place);
            let places: Option<Vec<usize>> = fields.iter().map(known).collect();
            let places = places.ok_or_else(|| internal(expr.span, "an unknown field"))?;
            let values = fields.iter().map(|f| self.expr(&f.value)).collect::<Result<Vec<_>>>()?;
            return Ok(CodeKind::Construct(constructor, places.into_iter().zip(values).collect()));
        }
        let arguments = arguments.into_iter().map(|argument| self.expr(argument)).collect::<Result<_>>()?;
        Ok(CodeKind::Call(Box::new(code), arguments))
    }

    fn comprehension(&mut self, body: &Expr, qualifiers: &[Qualifier]) -> Result<CodeKind> {
        let depth = self.scope().names.len();
        let mut compiled = Vec::new();
        for qualifier in qualifiers {
            compiled.push(match qualifier {
                Qualifier::Generator { pattern, list } => {
                    let list = self.expr(list)?;
                    QualifierCode::Generator(self.pattern(pattern)?, list)
                }
                Qualifier::Guard(condition) => QualifierCode::Guard(self.expr(condition)?),
                Qualifier::Let(bindings) => QualifierCode::Let(self.bindings(bindings)?),
            });
        }
        let body = self.expr(body)?;
        self.scope().names.truncate(depth);
        Ok(CodeKind::Comprehension(Box::new(ComprehensionCode { body, qualifiers: compiled })))
    }

    fn lambda(&mut self, parameters: &[ast::Pattern], body: &Expr) -> Result<Lambda> {
        self.group(&[(None, parameters, body)])
    }

    /// Functions that may call each other, by their names.
    fn group(&mut self, functions: &[Written<'_>]) -> Result<Lambda> {
        let siblings: Vec<Arc<str>> =
            functions.iter().map(|(name, ..)| name.clone().unwrap_or_else(|| "".into())).collect();
        let mut compiled = Vec::new();
        let mut captures = Vec::new();
        for (name, parameters, body) in functions {
            // All of a group share what they capture.
            self.scopes.push(Scope { siblings: siblings.clone(), captures, ..Scope::default() });
            let function = self.body(name.clone(), parameters, body);
            captures = self.scopes.pop().map(|scope| scope.captures).unwrap_or_default();
            compiled.push(Arc::new(function?));
        }
        Ok(Lambda {
            functions: compiled.into(),
            captures: captures.into_iter().map(|(_, from)| from).collect(),
        })
    }

    /// The bindings of a `let` in an order in which each comes after what it needs; they stay in scope.
    fn bindings(&mut self, bindings: &[Definition]) -> Result<Vec<Binding>> {
        let mut code = Vec::new();
        for component in super::order::components(bindings) {
            let members: Vec<&Definition> =
                component.members.iter().filter_map(|i| bindings.get(*i)).collect();
            let functions = members.iter().all(|definition| !definition.parameters.is_empty());
            match &members[..] {
                [single] if single.parameters.is_empty() => {
                    if component.recursive {
                        return Err(needs_itself(single));
                    }
                    let value = self.expr(&single.body)?;
                    code.push(Binding::Value(self.pattern(&single.target)?, value));
                }
                members if functions => {
                    let group: Vec<_> = members
                        .iter()
                        .map(|d| (d.name().map(|name| name.text), &d.parameters[..], &d.body))
                        .collect();
                    let lambda = self.group(&group)?;
                    let locals = group.iter().map(|(name, ..)| match name {
                        Some(name) => self.bind(name),
                        None => self.new_local(),
                    });
                    let locals = locals.collect();
                    code.push(Binding::Functions(lambda, locals));
                }
                members => {
                    let value = members.iter().find(|definition| definition.parameters.is_empty());
                    return Err(
                        value.map_or_else(|| internal(Span::at(0), "an empty group"), |d| needs_itself(d))
                    );
                }
            }
        }
        Ok(code)
    }
}

/// The components that a name of x, y, z or of r, g, b stands for: one to three of them.
fn components(name: &str) -> Option<Vec<u8>> {
    let of = |letters: &str| -> Option<Vec<u8>> {
        name.chars().map(|c| letters.find(c).and_then(|place| u8::try_from(place).ok())).collect()
    };
    if name.is_empty() || name.len() > 3 {
        return None;
    }
    of("xyz").or_else(|| if name.len() == 1 { of("rgb") } else { None })
}

fn needs_itself(definition: &Definition) -> Box<Diagnostic> {
    let name = definition.name().map_or_else(|| "this binding".to_owned(), |name| format!("`{}`", name.text));
    Box::new(
        Diagnostic::error(
            "needs-itself",
            format!("{name} needs itself"),
            definition.target.span,
            "its value is needed to work out its value",
        )
        .with_help("only functions may use themselves; give it a parameter, or break the circle"),
    )
}

/// A fault of the language itself: what should have been refused before got here.
pub(super) fn internal(span: Span, what: &str) -> Box<Diagnostic> {
    Box::new(
        Diagnostic::error("internal", format!("hray got into a state it should not: {what}"), span, "here")
            .with_help("this is a fault of hray, not of the scene; please report it with the scene"),
    )
}

/// The free names of an expression that are among `of`. (Over-approximates where a local hides one of them.)
pub(super) fn mentions(expr: &Expr, of: &BTreeSet<Arc<str>>, found: &mut BTreeSet<Arc<str>>) {
    expr.walk(&mut |expr| {
        if let ExprKind::Name(name) = &expr.kind
            && of.contains(name)
        {
            found.insert(name.clone());
        }
    });
}
