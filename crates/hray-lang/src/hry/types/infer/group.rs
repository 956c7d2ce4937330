//! Definitions that need each other, at the top of a file or in a `let`.

use super::annotation::Variables;
use super::{Infer, Why};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Definition, PatternKind};
use crate::hry::types::graph::components;
use crate::hry::types::names::Fields;
use crate::hry::types::scheme::Binding;
use crate::hry::types::store::Ty;
use std::sync::Arc;

/// A function takes no more parameters.
const MOST_PARAMETERS: usize = 100;

/// A definition whose type is being found.
pub(super) struct Member<'p> {
    pub(super) definition: &'p Definition,
    pub(super) place: Place,
    pub(super) ty: Ty,
    /// The place of its annotation.
    pub(super) annotation: Option<Span>,
    /// The parameters and the type of the body, where there is no annotation.
    parts: Option<(Vec<Ty>, Ty)>,
}

/// Where the type of a definition is kept.
#[derive(Clone, Copy)]
pub(super) enum Place {
    Top {
        module: usize,
        index: usize,
    },
    Local(usize),
    /// It could not be read, or is there twice: nothing refers to it.
    Nowhere,
}

impl<'p> Infer<'p> {
    /// Finds the types of all definitions of some modules.
    pub(in crate::hry::types) fn modules(&mut self, range: std::ops::Range<usize>) {
        let modules = self.modules;
        let mut nodes = Vec::new();
        let mut first = Vec::new();
        for module in range.clone() {
            first.push(nodes.len());
            let count = modules.get(module).map_or(0, |module| module.syntax.definitions.len());
            nodes.extend((0..count).map(|index| (module, index)));
            while self.types.definitions.len() <= module {
                self.types.definitions.push(Vec::new());
            }
            if let Some(slots) = self.types.definitions.get_mut(module) {
                *slots = vec![Binding::Mono(Ty::ERROR); count];
            }
        }
        let node = |(module, index): (usize, usize)| {
            Some(first.get(module.checked_sub(range.start)?)? + index).filter(|node| *node < nodes.len())
        };
        let edges: Vec<Vec<usize>> = nodes
            .iter()
            .map(|key| self.names.needs.get(key).map_or(&[][..], Vec::as_slice))
            .map(|needs| needs.iter().filter_map(|key| node(*key)).collect())
            .collect();
        for component in components(&edges) {
            let members = component.iter().filter_map(|node| {
                let (module, index) = *nodes.get(*node)?;
                let definition = modules.get(module)?.syntax.definitions.get(index)?;
                Some((definition, Place::Top { module, index }))
            });
            let members = members.collect();
            self.group(members);
        }
    }

    /// Bindings of a `let`.
    pub(super) fn bindings(&mut self, bindings: &'p [Definition]) {
        let Some(first) = bindings.first() else { return };
        let none = Vec::new();
        let edges = self.names.groups.get(&first.span.start).unwrap_or(&none);
        for component in components(edges) {
            let definitions: Vec<&Definition> = component.iter().filter_map(|i| bindings.get(*i)).collect();
            let all_names =
                definitions.iter().all(|binding| matches!(binding.target.kind, PatternKind::Name(_)));
            if all_names {
                let place = |binding: &Definition| {
                    self.names
                        .bound
                        .get(&binding.target.span.start)
                        .map_or(Place::Nowhere, |i| Place::Local(*i))
                };
                let members = definitions.into_iter().map(|binding| (binding, place(binding))).collect();
                self.group(members);
            } else {
                self.taken_apart(&definitions);
            }
        }
    }

    /// Bindings some of which take a value apart: they have one type.
    fn taken_apart(&mut self, bindings: &[&'p Definition]) {
        let types: Vec<Ty> = bindings
            .iter()
            .map(|binding| {
                let ty = self.fresh();
                self.pattern(&binding.target, ty, binding.body.span, false);
                ty
            })
            .collect();
        for (binding, ty) in bindings.iter().zip(types) {
            let expected = (ty, Why::Pattern { subject: binding.target.span });
            if binding.parameters.is_empty() {
                self.expr(&binding.body, Some(expected));
            } else {
                let (parts, whole) = self.parts(binding);
                self.body(binding, &parts);
                let _ = self.unify(ty, whole);
            }
        }
    }

    fn group(&mut self, members: Vec<(&'p Definition, Place)>) {
        if self.exhausted {
            return;
        }
        let start = self.pending.len();
        self.level += 1;
        let members: Vec<Member<'p>> = members.into_iter().map(|(d, place)| self.member(d, place)).collect();
        for member in &members {
            self.keep(member.place, Binding::Mono(member.ty));
        }
        for member in &members {
            self.member_body(member);
        }
        self.level -= 1;
        let schemes = self.generalise(&members, start);
        for (member, scheme) in members.iter().zip(schemes) {
            self.note(member.definition.target.span, scheme.ty);
            self.keep(member.place, Binding::Poly(Arc::new(scheme)));
        }
    }

    fn member(&mut self, definition: &'p Definition, place: Place) -> Member<'p> {
        if let Some(written) = &definition.annotation {
            let ty = self.written(written, &mut Variables::rigid(), 0);
            return Member { definition, place, ty, annotation: Some(written.span), parts: None };
        }
        let (parts, ty) = self.parts(definition);
        Member { definition, place, ty, annotation: None, parts: Some(parts) }
    }

    /// Variables for the parameters and the body of a definition, and the type that they make.
    fn parts(&mut self, definition: &Definition) -> ((Vec<Ty>, Ty), Ty) {
        let count = definition.parameters.len();
        if let (true, Some(parameter)) = (count > MOST_PARAMETERS, definition.parameters.get(MOST_PARAMETERS))
        {
            let message = format!("a function takes {MOST_PARAMETERS} parameters at most");
            let error = Diagnostic::error("too-many-parameters", message, parameter.span, "one too many");
            self.report(error.with_help("put what belongs together into a record"));
        }
        let parameters: Vec<Ty> = (0..count.min(MOST_PARAMETERS)).map(|_| self.fresh()).collect();
        let result = self.fresh();
        let whole = parameters.iter().rev().fold(result, |to, from| self.types.store.function(*from, to));
        ((parameters, result), whole)
    }

    fn keep(&mut self, place: Place, binding: Binding) {
        let slot = match place {
            Place::Top { module, index } => {
                self.types.definitions.get_mut(module).and_then(|m| m.get_mut(index))
            }
            Place::Local(local) => {
                if let Some(slot) = self.locals.get_mut(local) {
                    *slot = Some(binding);
                }
                return;
            }
            Place::Nowhere => return,
        };
        if let Some(slot) = slot {
            *slot = binding;
        }
    }

    fn member_body(&mut self, member: &Member<'p>) {
        let definition = member.definition;
        if self.is_scene(member.place, definition) {
            self.scene(definition, member.ty, member.annotation);
            return;
        }
        match (&member.parts, member.annotation) {
            (Some(parts), _) => self.body(definition, parts),
            (None, Some(annotation)) => self.annotated_body(definition, member.ty, annotation),
            (None, None) => {}
        }
    }

    /// The body of a definition without an annotation.
    pub(super) fn body(&mut self, definition: &'p Definition, (parameters, result): &(Vec<Ty>, Ty)) {
        for (pattern, ty) in definition.parameters.iter().zip(parameters) {
            self.pattern(pattern, *ty, pattern.span, false);
            // Generalisation would find it to be a hit; knowing it before the body makes for better errors
            // there.
            let local =
                self.names.bound.get(&pattern.span.start).and_then(|local| self.names.locals.get(*local));
            if local.is_some_and(|local| local.span == pattern.span && local.fields == Fields::OfAHit) {
                let _ = self.unify(*ty, Ty::HIT);
            }
        }
        let errors = self.errors;
        let found = self.expr(&definition.body, None);
        // After an error in the body, that it does not agree with its use inside is no news.
        if self.errors > errors {
            let _ = self.unify(found, *result);
            return;
        }
        self.settle(&definition.body, found, Some((*result, Why::Recursion(definition.target.span))));
    }

    /// The body of a definition, checked against its annotation.
    fn annotated_body(&mut self, definition: &'p Definition, ty: Ty, annotation: Span) {
        let mut expected = ty;
        for pattern in &definition.parameters {
            let (from, to) = match self.function_parts(expected) {
                Some(parts) => parts,
                None => {
                    if !self.types.store.is_error(expected) {
                        self.too_many_parameters(definition, pattern.span, ty, annotation);
                    }
                    (Ty::ERROR, Ty::ERROR)
                }
            };
            self.pattern(pattern, from, pattern.span, false);
            expected = to;
        }
        self.expr(&definition.body, Some((expected, Why::Annotation(annotation))));
    }

    fn too_many_parameters(&mut self, definition: &Definition, span: Span, ty: Ty, annotation: Span) {
        let name = definition.name().map_or_else(|| "it".into(), |name| name.text);
        let (parameters, _) = self.types.store.parameters(ty);
        let message = format!(
            "`{name}` has {}, but its annotation says {}",
            counted(definition.parameters.len(), "parameter"),
            counted(parameters.len(), "parameter")
        );
        let error = Diagnostic::error("wrong-annotation", message, span, "one too many for the annotation")
            .with_secondary(annotation, format!("its type, by the annotation: `{}`", self.show(ty)))
            .with_help("each parameter stands before an arrow: `f : Number -> Number -> Color` has two");
        self.report(error);
    }
}

/// `1 parameter`, `2 parameters`.
pub(in crate::hry::types) fn counted(count: usize, what: &str) -> String {
    let count_words = if count == 0 { "no".to_owned() } else { count.to_string() };
    format!("{count_words} {what}{}", if count == 1 { "" } else { "s" })
}
