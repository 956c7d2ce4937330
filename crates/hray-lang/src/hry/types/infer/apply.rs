//! Functions and their arguments.

use super::{Expected, Infer, Why};
use crate::hry::ast::{Expr, ExprKind};
use crate::hry::library::Constructor;
use crate::hry::program::{Global, application};
use crate::hry::types::kind::Head;
use crate::hry::types::names::Meaning;
use crate::hry::types::store::{Node, Ty};

/// A call whose arguments are being looked at.
struct Call<'a, 'p> {
    callee: &'p Expr,
    arguments: &'a [&'p Expr],
    /// The type of the function before any argument.
    whole: Ty,
    /// An argument that was refused.
    refused: Option<Refused>,
}

#[derive(Clone, Copy)]
struct Refused {
    found: Ty,
    wanted: Ty,
    /// The place of the complaint.
    complaint: usize,
}

impl<'p> Infer<'p> {
    /// `f a b`
    pub(super) fn application(&mut self, expr: &'p Expr, expected: Expected<'p>) -> Ty {
        let (callee, arguments) = application(expr);
        self.call(expr, callee, &arguments, expected)
    }

    pub(super) fn call(
        &mut self,
        expr: &'p Expr,
        callee: &'p Expr,
        arguments: &[&'p Expr],
        expected: Expected<'p>,
    ) -> Ty {
        let found = match self.constructor_of(callee) {
            Some(constructor) => self.constructor_call(expr, constructor, callee, arguments),
            None => {
                let errors = self.diagnostics.len();
                let found = self.function_call(callee, arguments);
                if self.diagnostics.len() == errors {
                    self.odd_literals(callee, arguments);
                }
                found
            }
        };
        self.settle(expr, found, expected)
    }

    /// The constructor that a name means.
    pub(super) fn constructor_of(&self, callee: &Expr) -> Option<&'static Constructor> {
        match (&callee.kind, self.names.uses.get(&callee.span.start)) {
            (ExprKind::Name(_), Some(Meaning::Global(Global::Constructor(constructor)))) => Some(constructor),
            _ => None,
        }
    }

    fn function_call(&mut self, callee: &'p Expr, arguments: &[&'p Expr]) -> Ty {
        let whole = self.expr(callee, None);
        let mut call = Call { callee, arguments, whole, refused: None };
        let mut ty = whole;
        for (index, argument) in arguments.iter().enumerate() {
            let Some((from, to)) = self.taken(ty) else {
                if !self.types.store.is_error(ty) && call.refused.is_none() {
                    let error = self.not_a_function(callee, whole, arguments, index);
                    self.report(error);
                }
                return self.given_up(arguments, index);
            };
            match self.argument(&mut call, index, argument, from) {
                Some(()) => ty = to,
                None => return self.given_up(arguments, index + 1),
            }
        }
        ty
    }

    /// Looks at the arguments that are left, for the sake of what may be wrong inside them.
    fn given_up(&mut self, arguments: &[&'p Expr], from: usize) -> Ty {
        for rest in arguments.iter().skip(from) {
            self.expr(rest, None);
        }
        Ty::ERROR
    }

    /// One argument of a call. None where nothing more can be said about the call.
    fn argument(
        &mut self,
        call: &mut Call<'_, 'p>,
        index: usize,
        argument: &'p Expr,
        from: Ty,
    ) -> Option<()> {
        let why = Why::Argument { callee: call.callee, index, whole: call.whole };
        if let Some(refused) = call.refused {
            // What comes after an argument that was refused is probably off, too.
            let found = self.expr(argument, None);
            let fits = |one: Ty, place: Ty| {
                self.types.store.head(one).is_some_and(|head| self.types.store.heads(place).has(head))
            };
            if fits(found, refused.wanted) && fits(refused.found, from) && !fits(found, from) {
                self.suggest_order(refused.complaint, call.callee, call.arguments);
            }
            return Some(());
        }
        if let ExprKind::Vector(parts) = &argument.kind
            && index == 0
            && call.arguments.len() == 1
        {
            return self.vector_argument(call, argument, parts, from, why);
        }
        let before = self.diagnostics.len();
        self.expr(argument, Some((from, why)));
        let new = self.diagnostics.iter().enumerate().skip(before);
        let mut complaints =
            new.filter(|(_, error)| error.code == "wrong-argument" && error.primary.span == argument.span);
        let Some((complaint, _)) = complaints.next() else { return Some(()) };
        if let Some((calls, is_list)) = self.constructor_calls(call, from) {
            self.suggest_calls(complaint, call.arguments, &calls, is_list);
            return None;
        }
        if let Some(constructor) =
            index.checked_sub(1).and_then(|before| self.constructor_of(call.arguments.get(before)?))
            && let Some(error) = self.diagnostics.get_mut(complaint)
        {
            let field = constructor.fields.first().map_or("field", |field| field.name);
            let name = constructor.name;
            error.notes.clear();
            error.help = Some(format!(
                "`{name}` takes a record; a function that takes one value is `(\\x -> {name} {{ {field} = x }})`"
            ));
            return None;
        }
        if self.is_function_after_pipe(call, argument) {
            self.suggest_pipe(complaint, argument);
            return None;
        }
        if self.is_call_without_parentheses(call, index) {
            let count = self.arguments_within(call, index);
            self.suggest_parentheses(complaint, call.arguments, index, count);
            return None;
        }
        if matches!(argument.kind, ExprKind::List(_))
            && matches!(self.quoted(call.callee.span), Some("union" | "intersection" | "difference"))
        {
            // That the second shape is missing is no news.
            return None;
        }
        let found = self.refused_type(argument, from);
        if self.is_list_apart(call, index, found, from) {
            self.suggest_list(complaint, call.arguments);
            return None;
        }
        if let Some(parts) = self.components_apart(call, index, found, from) {
            self.suggest_vector(complaint, parts);
            return None;
        }
        call.refused = Some(Refused { found, wanted: from, complaint });
        Some(())
    }

    /// Of `difference cube {} sphere {}`: each constructor with its record, in parentheses; and whether they are elements of
    /// one list.
    fn constructor_calls(&self, call: &Call<'_, 'p>, wanted: Ty) -> Option<(Vec<String>, bool)> {
        let mut rest = call.arguments;
        let mut calls = Vec::new();
        let mut found = false;
        while let [first, others @ ..] = rest {
            let text = self.quoted(first.span)?;
            match (self.constructor_of(first), others) {
                (Some(_), [record, others @ ..]) if matches!(record.kind, ExprKind::Record(_)) => {
                    calls.push(format!("{text} {}", self.quoted(record.span)?));
                    (found, rest) = (true, others);
                }
                _ => {
                    calls.push(text.to_owned());
                    rest = others;
                }
            }
        }
        let is_list = matches!(self.types.store.get(wanted), Node::List(_));
        let takes = self.types.store.parameters(call.whole).0.len();
        (found && (is_list || calls.len() == takes)).then_some((calls, is_list))
    }

    /// Whether `group a b` probably meant `group [a, b]`: a function of one list gets several of its elements.
    fn is_list_apart(&self, call: &Call<'_, 'p>, index: usize, found: Ty, wanted: Ty) -> bool {
        let store = &self.types.store;
        let Node::List(of) = store.get(wanted) else { return false };
        let piped = call.arguments.iter().any(|argument| argument.span.end <= call.callee.span.start);
        index == 0
            && call.arguments.len() > store.parameters(call.whole).0.len()
            && !piped
            && store.head(found).is_some_and(|head| store.heads(*of).has(head))
    }

    /// Whether `x |> f a g b` probably meant `x |> f a |> g b`.
    fn is_function_after_pipe(&self, call: &Call<'_, 'p>, argument: &Expr) -> bool {
        let piped = call.arguments.iter().any(|argument| argument.span.end <= call.callee.span.start);
        piped
            && argument.span.start > call.callee.span.end
            && matches!(argument.kind, ExprKind::Name(_))
            && self.names.uses.get(&argument.span.start).is_some_and(|meaning| self.is_function(*meaning))
    }

    /// Of `f g x y`, where `g` is a function: how many of the arguments, itself included, are its call.
    fn arguments_within(&self, call: &Call<'_, 'p>, index: usize) -> usize {
        let rest = call.arguments.len() - index;
        let takes = self.types.store.parameters(call.whole).0.len();
        // What is left over once the function has all of its arguments.
        let left = takes.saturating_sub(index + 1);
        let within = rest.saturating_sub(left);
        if within > 1 { within } else { rest }
    }

    /// Whether `f 0 1 0` probably meant `f (0, 1, 0)`: the arguments that would be the components.
    fn components_apart<'a>(
        &mut self,
        call: &Call<'a, 'p>,
        index: usize,
        found: Ty,
        wanted: Ty,
    ) -> Option<&'a [&'p Expr]> {
        let count = match self.types.store.head(wanted) {
            Some(Head::Vec3) => 3,
            Some(Head::Vec2) => 2,
            _ => return None,
        };
        let is_number = |infer: &Self, ty: Ty| infer.types.store.head(ty) == Some(Head::Number);
        let parts = call.arguments.get(index..index + count)?;
        let piped = parts.iter().any(|part| part.span.end <= call.callee.span.start);
        if !is_number(self, found) || piped {
            return None;
        }
        for part in parts.iter().skip(1) {
            let ty = self.expr(part, None);
            if !is_number(self, ty) {
                return None;
            }
        }
        Some(parts)
    }

    /// The type that an argument has, which was refused.
    fn refused_type(&self, argument: &Expr, wanted: Ty) -> Ty {
        let found = self.refused.filter(|(span, _)| *span == argument.span);
        found.map_or(wanted, |(_, ty)| ty)
    }

    /// The only argument of a call, written as a vector. `f (a, b)` probably meant `f a b` where `f` takes no
    /// vector, or `a` is no number.
    fn vector_argument(
        &mut self,
        call: &Call<'_, 'p>,
        argument: &'p Expr,
        parts: &'p [Expr],
        from: Ty,
        why: Why<'p>,
    ) -> Option<()> {
        let vector = if parts.len() == 2 { Ty::VEC2 } else { Ty::VEC3 };
        if let Node::List(of) = self.types.store.get(from) {
            let of = *of;
            let types: Vec<Ty> = parts.iter().map(|part| self.expr(part, None)).collect();
            let is_element = |ty: &Ty| {
                self.types
                    .store
                    .head(*ty)
                    .is_some_and(|head| head != Head::Number && self.types.store.heads(of).has(head))
            };
            if types.iter().all(is_element) {
                let error = self.list_in_parentheses(call.callee, argument);
                self.report(error);
                return None;
            }
        }
        let heads = self.types.store.heads(from);
        let takes_vector = self.types.store.head(vector).is_some_and(|head| heads.has(head));
        let takes_several = self.types.store.parameters(call.whole).0.len() >= parts.len();
        let mut is_vector = true;
        for part in parts {
            if takes_several {
                let ty = self.expr(part, None);
                is_vector &= self.types.store.heads(ty).has(Head::Number);
                if is_vector && takes_vector {
                    self.settle(part, ty, Some((Ty::NUMBER, Why::Component)));
                }
            } else {
                self.expr(part, Some((Ty::NUMBER, Why::Component)));
            }
        }
        if takes_several && !(takes_vector && is_vector) {
            let error = self.call_with_commas(call.callee, call.whole, argument);
            self.report(error);
            return None;
        }
        self.note(argument.span, vector);
        self.settle(argument, vector, Some((from, why)));
        Some(())
    }

    /// Whether `f g x` probably meant `f (g x)`: `g` is a function where none is taken, and `x` would be one
    /// too many.
    fn is_call_without_parentheses(&self, call: &Call<'_, 'p>, index: usize) -> bool {
        let Some(argument) = call.arguments.get(index) else { return false };
        let piped = call.arguments.iter().any(|argument| argument.span.end <= call.callee.span.start);
        let found = self.notes.iter().rev().find(|(span, _)| *span == argument.span);
        let is_function = matches!(argument.kind, ExprKind::Name(_))
            && found.is_some()
            && self.names.uses.get(&argument.span.start).is_some_and(|meaning| self.is_function(*meaning));
        is_function && !piped && self.types.store.parameters(call.whole).0.len() < call.arguments.len()
    }

    fn is_function(&self, meaning: Meaning) -> bool {
        use crate::hry::types::scheme::Binding;
        let binding = match meaning {
            Meaning::Local(local) => self.locals.get(local).cloned().flatten(),
            Meaning::Global(Global::Definition { module, index }) => {
                self.types.definitions.get(module).and_then(|m| m.get(index)).cloned()
            }
            Meaning::Global(Global::Native(native)) => {
                self.types.natives.get(native.native as usize).cloned().map(Binding::Poly)
            }
            Meaning::Global(Global::Constructor(_)) => return true,
            Meaning::Nothing => None,
        };
        let ty = match binding {
            Some(Binding::Mono(ty)) => ty,
            Some(Binding::Poly(scheme)) => scheme.ty,
            None => return false,
        };
        self.types.store.head(ty) == Some(Head::Function)
    }

    /// What a function takes and gives. What is not known yet becomes a function.
    fn taken(&mut self, ty: Ty) -> Option<(Ty, Ty)> {
        if let Node::Function(from, to) = self.types.store.get(ty) {
            return Some((*from, *to));
        }
        if !self.types.store.is_variable(ty) {
            return None;
        }
        let (from, to) = (self.fresh(), self.fresh());
        let function = self.types.store.function(from, to);
        self.unify(ty, function).ok().map(|()| (from, to))
    }
}
