//! What each name means: the local, the definition or the part of the library that it refers to.

use super::lints;
use super::unknown;
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{
    Definition, Expr, ExprKind, FieldValue, Import, ImportNames, Module, Name, Pattern, PatternKind,
    Qualifier,
};
use crate::hry::library::{CONSTRUCTORS, Constructor, FieldType, Makes};
use crate::hry::program::{Global, LoadedModule};
use std::collections::HashMap;
use std::sync::Arc;

/// What a name means.
#[derive(Clone, Copy, Debug)]
pub(super) enum Meaning {
    /// A local, by its place in [`Names::locals`].
    Local(usize),
    /// Something at the top of a file, or of the library.
    Global(Global),
    /// Nothing; an error was reported.
    Nothing,
}

/// A name that is bound inside a definition.
#[derive(Clone, Debug)]
pub(super) struct Local {
    pub(super) name: Arc<str>,
    /// Its place.
    pub(super) span: Span,
    /// Where it may be used.
    pub(super) scope: Span,
    /// Whether it is bound by `let`.
    pub(super) is_let: bool,
    pub(super) is_used: bool,
    /// Of a parameter of a definition: whether fields of a hit are read from it that tell that it is one, and
    /// no others.
    pub(super) fields: Fields,
}

/// The fields that are read from a local.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Fields {
    /// None that tell anything.
    #[default]
    None,
    /// Those of a hit, one of which tells.
    OfAHit,
    /// Others, too.
    Others,
}

/// The meanings of all names of a program's own modules.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    /// By the offset of a use.
    pub(super) uses: HashMap<usize, Meaning>,
    /// All uses, in the order in which they were met.
    pub(super) places: Vec<(Span, Meaning)>,
    pub(super) locals: Vec<Local>,
    /// By the offset of the name where it is bound.
    pub(super) bound: HashMap<usize, usize>,
    /// Of each group of bindings, by the offset of its first: which of the group each needs.
    pub(super) groups: HashMap<usize, Vec<Vec<usize>>>,
    /// Of each definition (module, index): the definitions that it needs, (module, index), in order.
    pub(super) needs: HashMap<(usize, usize), Vec<(usize, usize)>>,
    /// Places of records that are really names of imports (`p` in `p.gold`), by their offset.
    pub(super) qualifiers: HashMap<usize, Global>,
}

/// Finds the meanings of the names in a module.
pub(super) fn resolve(
    names: &mut Names,
    diagnostics: &mut Vec<Diagnostic>,
    place: usize,
    module: &LoadedModule,
) {
    let own = own_definitions(place, module);
    let mut resolver = Resolver {
        names,
        diagnostics,
        module,
        own,
        scopes: HashMap::new(),
        needs: Vec::new(),
        groups: Vec::new(),
        member: HashMap::new(),
        varying: None,
        hit_missing: None,
        choices: &[],
        called: None,
        current: None,
    };
    resolver.imports(&module.syntax);
    for (index, definition) in module.syntax.definitions.iter().enumerate() {
        resolver.needs.clear();
        resolver.current = definition.name().map(|name| name.text);
        resolver.definition(definition);
        let needs = std::mem::take(&mut resolver.needs);
        resolver.names.needs.insert((place, index), needs);
    }
}

/// The places of the names that a module defines itself.
fn own_definitions(place: usize, module: &LoadedModule) -> HashMap<Arc<str>, Span> {
    let definitions = module.syntax.definitions.iter().enumerate();
    let named = definitions.filter_map(|(index, definition)| {
        let name = definition.name()?;
        let here = Global::Definition { module: place, index };
        let found = module.scope.names.get(&name.text);
        found.is_some_and(|global| same(*global, here)).then_some((name.text, name.span))
    });
    named.collect()
}

/// Whether two globals are the same.
pub(super) fn same(a: Global, b: Global) -> bool {
    match (a, b) {
        (Global::Definition { module: m, index: i }, Global::Definition { module: n, index: j }) => {
            (m, i) == (n, j)
        }
        (Global::Native(a), Global::Native(b)) => a.native == b.native,
        (Global::Constructor(a), Global::Constructor(b)) => a.name == b.name,
        _ => false,
    }
}

/// The values of a type that has only a few.
const fn choices(kind: FieldType) -> &'static [&'static str] {
    match kind {
        FieldType::Integrator => &["whitted", "classic2005"],
        FieldType::Encoding => &["srgb", "raw"],
        FieldType::Bool => &["true", "false"],
        _ => &[],
    }
}

/// A group of bindings that is being walked.
struct Group {
    /// Which of them; none while their body is.
    current: Option<usize>,
    edges: Vec<Vec<usize>>,
}

struct Resolver<'a> {
    names: &'a mut Names,
    diagnostics: &'a mut Vec<Diagnostic>,
    module: &'a LoadedModule,
    own: HashMap<Arc<str>, Span>,
    /// The locals that a name means, innermost last.
    scopes: HashMap<Arc<str>, Vec<usize>>,
    needs: Vec<(usize, usize)>,
    groups: Vec<Group>,
    /// Of a local bound in a group: the group and its place in it.
    member: HashMap<usize, (usize, usize)>,
    /// The value of a field that may vary over a surface, where it is being walked and is no function yet.
    varying: Option<Span>,
    /// The name of a hit that such a value lacks, which was said.
    hit_missing: Option<(Span, Arc<str>)>,
    /// The values of which the field that is being walked takes one.
    choices: &'static [&'static str],
    /// The start of a name that is given arguments.
    called: Option<usize>,
    /// The name of the definition at the top that is being walked.
    current: Option<Arc<str>>,
}

impl Resolver<'_> {
    fn imports(&mut self, syntax: &Module) {
        for import in &syntax.imports {
            self.import(import);
        }
    }

    fn import(&mut self, import: &Import) {
        match &import.names {
            ImportNames::All => {}
            ImportNames::Listed(listed) => {
                for name in listed {
                    if let Some(global @ Global::Definition { .. }) = self.module.scope.names.get(&name.text)
                    {
                        self.names.places.push((name.span, Meaning::Global(*global)));
                    }
                }
            }
            ImportNames::As(prefix) => {
                if let Some(own) = self.own.get(&prefix.text) {
                    let message = format!("`{}` is the name of an import and of a definition", prefix.text);
                    let error = Diagnostic::error("defined-twice", message, prefix.span, "an import")
                        .with_secondary(*own, "a definition")
                        .with_help("give one of them another name");
                    self.diagnostics.push(error);
                }
            }
        }
    }

    fn definition(&mut self, definition: &Definition) {
        let mut locals = Vec::new();
        for parameter in &definition.parameters {
            self.bind(parameter, definition.span, false, &mut locals);
        }
        match (&definition.body.kind, definition.name()) {
            (ExprKind::Record(fields), Some(name)) if &*name.text == "scene" => {
                let scene = CONSTRUCTORS.iter().find(|constructor| constructor.makes == Makes::Scene);
                self.fields_of(scene, fields);
            }
            _ => self.expr(&definition.body),
        }
        self.leave(&locals);
    }

    /// Brings the names of a pattern into scope.
    fn bind(&mut self, pattern: &Pattern, scope: Span, is_let: bool, locals: &mut Vec<usize>) {
        match &pattern.kind {
            PatternKind::Name(name) => self.bind_name(name, pattern.span, scope, is_let, locals),
            PatternKind::Vector(parts) => {
                parts.iter().for_each(|part| self.bind(part, scope, is_let, locals))
            }
            PatternKind::List { items, rest } => {
                items.iter().for_each(|item| self.bind(item, scope, is_let, locals));
                if let Some(Some(rest)) = rest {
                    self.bind_name(&rest.text, rest.span, scope, is_let, locals);
                }
            }
            PatternKind::Record(fields) => {
                fields.iter().for_each(|(_, pattern)| self.bind(pattern, scope, is_let, locals));
            }
            _ => {}
        }
    }

    fn bind_name(&mut self, name: &Arc<str>, span: Span, scope: Span, is_let: bool, locals: &mut Vec<usize>) {
        let outer = self.scopes.get(name).and_then(|locals| locals.last());
        let outer = outer.and_then(|local| self.names.locals.get(*local).map(|local| local.span));
        let together =
            locals.iter().any(|local| self.names.locals.get(*local).is_some_and(|l| l.name == *name));
        if let (true, Some(first)) = (together, outer) {
            let error =
                Diagnostic::error("defined-twice", format!("`{name}` is bound twice"), span, "again here")
                    .with_secondary(first, "first bound here")
                    .with_help("give one of them another name, or write `_` for what is not needed");
            self.diagnostics.push(error);
        } else if let Some(first) = outer.or_else(|| self.own.get(name).copied())
            && !name.starts_with('_')
        {
            self.diagnostics.push(lints::shadowing(name, span, first, outer.is_some()));
        }
        let local = self.names.locals.len();
        self.names.locals.push(Local {
            name: name.clone(),
            span,
            scope,
            is_let,
            is_used: false,
            fields: Fields::None,
        });
        self.names.bound.insert(span.start, local);
        self.scopes.entry(name.clone()).or_default().push(local);
        locals.push(local);
    }

    fn leave(&mut self, locals: &[usize]) {
        for local in locals.iter().rev() {
            let name = self.names.locals.get(*local).map(|local| local.name.clone());
            if let Some(stack) = name.and_then(|name| self.scopes.get_mut(&name)) {
                stack.pop();
            }
        }
    }

    /// Bindings that may use each other; their names stay in scope, in `locals`.
    fn bindings(&mut self, bindings: &[Definition], scope: Span, locals: &mut Vec<usize>) {
        let Some(first) = bindings.first() else { return };
        let group = self.groups.len();
        let mut bound = Vec::new();
        for (place, binding) in bindings.iter().enumerate() {
            let before = bound.len();
            self.bind(&binding.target, scope, true, &mut bound);
            for local in bound.iter().skip(before) {
                self.member.insert(*local, (group, place));
            }
        }
        self.groups.push(Group { current: None, edges: vec![Vec::new(); bindings.len()] });
        for (place, binding) in bindings.iter().enumerate() {
            if let Some(group) = self.groups.get_mut(group) {
                group.current = Some(place);
            }
            self.definition(binding);
        }
        if let Some(group) = self.groups.get_mut(group) {
            group.current = None;
        }
        // The group is walked; its names stay in scope, but which binding uses them matters no more.
        for local in &bound {
            self.member.remove(local);
        }
        locals.extend(bound);
        if let Some(group) = self.groups.pop() {
            self.names.groups.insert(first.span.start, group.edges);
        }
    }

    fn name(&mut self, name: &Arc<str>, span: Span) {
        let meaning = self.meaning(name, span);
        self.names.uses.insert(span.start, meaning);
        self.names.places.push((span, meaning));
    }

    fn meaning(&mut self, name: &Arc<str>, span: Span) -> Meaning {
        if let Some(local) = self.scopes.get(name).and_then(|locals| locals.last()).copied() {
            self.used(local);
            return Meaning::Local(local);
        }
        if let Some(global) = self.module.scope.get(name) {
            self.needed(global);
            return Meaning::Global(global);
        }
        if self.lacks_hit(name, span) {
            return Meaning::Nothing;
        }
        let locals = self.scopes.iter().filter(|(_, locals)| !locals.is_empty());
        let mut locals: Vec<&str> = locals.map(|(name, _)| &**name).collect();
        locals.sort_unstable();
        let is_called = self.called == Some(span.start);
        let around = unknown::Around {
            module: self.module,
            locals: &locals,
            choices: self.choices,
            is_called,
            current: self.current.as_deref(),
        };
        self.diagnostics.push(unknown::name(name, span, &around));
        Meaning::Nothing
    }

    /// Whether a name that means nothing is that of a hit, where the value of a field could be a function of one. It is
    /// said once for every value.
    fn lacks_hit(&mut self, name: &Arc<str>, span: Span) -> bool {
        let Some(value) = self.varying else { return false };
        let known = |(place, said): &(Span, Arc<str>)| *place == value && said == name;
        if self.hit_missing.as_ref().is_some_and(known) {
            return true;
        }
        if !matches!(&**name, "h" | "hit") {
            return false;
        }
        self.diagnostics.push(unknown::hit(name, span, value));
        self.hit_missing = Some((value, name.clone()));
        true
    }

    /// The fields of a record that is given to a constructor.
    fn constructor_fields(&mut self, callee: &Expr, fields: &[FieldValue]) {
        let constructor = match self.names.uses.get(&callee.span.start) {
            Some(Meaning::Global(Global::Constructor(constructor))) => Some(*constructor),
            _ => None,
        };
        self.fields_of(constructor, fields);
    }

    fn fields_of(&mut self, constructor: Option<&'static Constructor>, fields: &[FieldValue]) {
        for field in fields {
            let found = constructor.and_then(|constructor| constructor.field(&field.name.text));
            let varies = found.is_some_and(|(_, spec)| spec.varies || spec.kind == FieldType::Height);
            let outer = std::mem::replace(&mut self.varying, varies.then_some(field.value.span));
            self.choices = match (found.map(|(_, spec)| spec.kind), &field.value.kind) {
                (Some(kind), ExprKind::Name(_)) => choices(kind),
                _ => &[],
            };
            self.expr(&field.value);
            self.choices = &[];
            self.varying = outer;
        }
    }

    fn used(&mut self, local: usize) {
        let within = self.member.get(&local).copied();
        let Some((group, place)) = within else {
            self.mark(local);
            return;
        };
        match self.groups.get_mut(group).and_then(|group| Some((group.current?, group))) {
            Some((from, group)) => {
                if let Some(edges) = group.edges.get_mut(from)
                    && edges.last() != Some(&place)
                {
                    edges.push(place);
                }
                // A binding that only uses itself is of no use.
                if from != place {
                    self.mark(local);
                }
            }
            None => self.mark(local),
        }
    }

    /// A field is read from something.
    fn field(&mut self, record: &Expr, name: &str) {
        let Some(Meaning::Local(local)) = self.names.uses.get(&record.span.start) else { return };
        if let (ExprKind::Name(_), Some(local)) = (&record.kind, self.names.locals.get_mut(*local)) {
            local.fields = match (local.fields, name) {
                (Fields::Others, _) => Fields::Others,
                (_, "p" | "world" | "normal") => Fields::OfAHit,
                (known, "uv" | "time") => known,
                _ => Fields::Others,
            };
        }
    }

    fn mark(&mut self, local: usize) {
        if let Some(local) = self.names.locals.get_mut(local) {
            local.is_used = true;
        }
    }

    fn needed(&mut self, global: Global) {
        if let Global::Definition { module, index } = global
            && self.needs.last() != Some(&(module, index))
        {
            self.needs.push((module, index));
        }
    }

    /// `p.gold` where `p` is an import; whether it was.
    fn qualified(&mut self, record: &Expr, name: &Name) -> bool {
        let ExprKind::Name(prefix) = &record.kind else { return false };
        if self.scopes.get(prefix).is_some_and(|locals| !locals.is_empty()) {
            return false;
        }
        let Some(names) = self.module.scope.qualified.get(prefix) else { return false };
        let meaning = match names.get(&name.text) {
            Some(global) => {
                self.needed(*global);
                self.names.qualifiers.insert(record.span.start, *global);
                Meaning::Global(*global)
            }
            None => {
                self.diagnostics.push(unknown::qualified(prefix, name, names));
                Meaning::Nothing
            }
        };
        self.names.uses.insert(record.span.start, meaning);
        self.names.uses.insert(name.span.start, meaning);
        self.names.places.push((name.span, meaning));
        true
    }

    fn expr(&mut self, expr: &Expr) {
        match &expr.kind {
            ExprKind::Name(name) => self.name(name, expr.span),
            ExprKind::Vector(parts) | ExprKind::List(parts) => parts.iter().for_each(|part| self.expr(part)),
            ExprKind::Range { first, second, last } => {
                self.expr(first);
                second.iter().for_each(|second| self.expr(second));
                self.expr(last);
            }
            ExprKind::Comprehension { body, qualifiers } => self.comprehension(expr.span, body, qualifiers),
            ExprKind::Record(fields) => fields.iter().for_each(|field| self.expr(&field.value)),
            ExprKind::Update { record, fields } => {
                self.expr(record);
                fields.iter().for_each(|field| self.field(record, &field.name.text));
                fields.iter().for_each(|field| self.expr(&field.value));
            }
            ExprKind::Field { record, name } => {
                if !self.qualified(record, name) {
                    self.expr(record);
                    self.field(record, &name.text);
                }
            }
            ExprKind::Apply { function, argument } => {
                if let ExprKind::Name(_) = function.kind {
                    self.called = Some(function.span.start);
                }
                self.expr(function);
                match (&function.kind, &argument.kind) {
                    (ExprKind::Name(_), ExprKind::Record(fields)) => {
                        self.constructor_fields(function, fields)
                    }
                    _ => self.expr(argument),
                }
            }
            ExprKind::Unary { operand, .. } => self.expr(operand),
            ExprKind::Binary { left, right, .. } => {
                self.expr(left);
                self.expr(right);
            }
            ExprKind::If { condition, then, otherwise } => {
                self.expr(condition);
                self.expr(then);
                self.expr(otherwise);
            }
            ExprKind::Let { bindings, body } => {
                let mut locals = Vec::new();
                self.bindings(bindings, expr.span, &mut locals);
                self.expr(body);
                self.leave(&locals);
            }
            ExprKind::Lambda { parameters, body } => {
                let mut locals = Vec::new();
                parameters.iter().for_each(|parameter| self.bind(parameter, expr.span, false, &mut locals));
                let outer = self.varying.take();
                self.expr(body);
                self.varying = outer;
                self.leave(&locals);
            }
            ExprKind::Match { subject, arms } => {
                self.expr(subject);
                for (pattern, body) in arms {
                    let mut locals = Vec::new();
                    self.bind(pattern, pattern.span.to(body.span), false, &mut locals);
                    self.expr(body);
                    self.leave(&locals);
                }
            }
            ExprKind::Annotated { expression, .. } => self.expr(expression),
            ExprKind::Number(_)
            | ExprKind::Bool(_)
            | ExprKind::Text(_)
            | ExprKind::Color(_)
            | ExprKind::Error => {}
        }
    }

    fn comprehension(&mut self, scope: Span, body: &Expr, qualifiers: &[Qualifier]) {
        let mut locals = Vec::new();
        for qualifier in qualifiers {
            match qualifier {
                Qualifier::Generator { pattern, list } => {
                    self.expr(list);
                    let mut bound = Vec::new();
                    self.bind(pattern, scope, false, &mut bound);
                    locals.extend(bound);
                }
                Qualifier::Guard(guard) => self.expr(guard),
                Qualifier::Let(bindings) => self.bindings(bindings, scope, &mut locals),
            }
        }
        self.expr(body);
        self.leave(&locals);
    }
}
