//! Types as text: as hry writes them, and in words.

use super::infer::written_operator;
use super::kind::Kind;
use super::scheme::{Demand, Scheme};
use super::store::{Node, Store, Ty};
use crate::hry::ast::BinaryOperator;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Types are shown no deeper, and records no longer.
const MOST_SHOWN: usize = 12;
const MOST_FIELDS: usize = 12;
const MOST_LENGTH: usize = 400;

/// Writes types; a variable has one name in all that it writes.
pub(super) struct Printer<'s> {
    store: &'s Store,
    names: HashMap<Ty, String>,
    taken: HashSet<String>,
}

impl<'s> Printer<'s> {
    pub(super) fn new(store: &'s Store) -> Self {
        Self { store, names: HashMap::new(), taken: HashSet::new() }
    }

    /// A type as it is written.
    pub(super) fn show(&mut self, ty: Ty) -> String {
        let mut text = String::new();
        self.write(&mut text, ty, 0, false);
        text
    }

    /// A scheme: its type, and what must hold of its variables.
    pub(super) fn scheme(&mut self, scheme: &Scheme) -> String {
        let mut text = self.show(scheme.ty);
        let mut demands: Vec<String> = Vec::new();
        let mut fields: BTreeMap<String, String> = BTreeMap::new();
        for constraint in &scheme.constraints {
            match &constraint.demand {
                Demand::Arithmetic { left, right, result, .. } => {
                    let sum = written_operator(BinaryOperator::Add);
                    let sides = [self.show(*left), self.show(*right), self.show(*result)];
                    demands.push(format!("{} {sum} {} : {}", sides[0], sides[1], sides[2]));
                }
                Demand::Field { record, name, result, .. } => {
                    let (record, result) = (self.show(*record), self.show(*result));
                    fields.insert(format!("{record}.{name}"), result);
                }
                Demand::Construct { record, constructor } => {
                    demands.push(format!("{} fits `{}`", self.show(*record), constructor.name));
                }
                Demand::Slot { value, constructor, field } => {
                    demands.push(format!(
                        "{} fits `{}` of `{}`",
                        self.show(*value),
                        field.name,
                        constructor.name
                    ));
                }
            }
        }
        let fields: Vec<String> = fields.into_iter().map(|(field, ty)| format!("{field} : {ty}")).collect();
        for variable in &scheme.bound {
            let Some(kind) = self.store.kind(*variable) else { continue };
            let special = !kind.is_any() && kind.name().is_none() && kind != Kind::EQUATABLE;
            let variable = self.show(*variable);
            // That something is a record, or fits a field, follows from what is said already.
            let follows = |text: &String| {
                text.starts_with(&format!("{variable}.")) || text.starts_with(&format!("{variable} fits"))
            };
            if special && !fields.iter().any(follows) && !demands.iter().any(follows) {
                demands.push(format!("{variable} is {}", kind.words()));
            }
        }
        demands.splice(0..0, fields);
        demands.dedup();
        if !demands.is_empty() {
            text.push_str(" where ");
            text.push_str(&demands.join(", "));
        }
        text
    }

    fn write(&mut self, text: &mut String, ty: Ty, depth: usize, in_parentheses: bool) {
        if depth > MOST_SHOWN || text.len() > MOST_LENGTH {
            text.push_str("..");
            return;
        }
        let ty = self.store.find(ty);
        match self.store.get(ty) {
            Node::Alone(head) => text.push_str(head.name()),
            Node::Error => text.push('?'),
            Node::List(of) => {
                text.push('[');
                self.write(text, *of, depth + 1, false);
                text.push(']');
            }
            Node::Function(from, to) => {
                if in_parentheses {
                    text.push('(');
                }
                self.write(text, *from, depth + 1, true);
                text.push_str(" -> ");
                self.write(text, *to, depth, false);
                if in_parentheses {
                    text.push(')');
                }
            }
            Node::Record(fields) => {
                let fields = fields.clone();
                text.push('{');
                for (i, (name, ty)) in fields.iter().enumerate() {
                    text.push_str(if i == 0 { " " } else { ", " });
                    if i == MOST_FIELDS {
                        text.push_str("..");
                        break;
                    }
                    text.push_str(name);
                    text.push_str(" : ");
                    self.write(text, *ty, depth + 1, false);
                }
                text.push_str(if fields.is_empty() { "}" } else { " }" });
            }
            Node::Rigid { name, .. } => {
                self.taken.insert(name.to_string());
                text.push_str(name);
            }
            Node::Variable { kind, .. } => {
                let name = self.variable(ty, *kind);
                text.push_str(&name);
            }
            Node::Link(_) => {}
        }
    }

    fn variable(&mut self, ty: Ty, kind: Kind) -> String {
        if let Some(name) = self.names.get(&ty) {
            return name.clone();
        }
        let mut number = 0_usize;
        let name = loop {
            let name = match kind.name() {
                Some(name) if number == 0 => name.to_owned(),
                Some(name) => format!("{name}{number}"),
                None => letters(number),
            };
            number += 1;
            if self.taken.insert(name.clone()) {
                break name;
            }
        };
        self.names.insert(ty, name.clone());
        name
    }

    /// A type in words, with an article.
    pub(super) fn words(&mut self, ty: Ty) -> String {
        match self.store.get(ty) {
            Node::Alone(head) => head.words().into(),
            Node::List(of) => match self.plural(*of, 0) {
                Some(plural) => format!("a list of {plural}"),
                None => "a list".into(),
            },
            Node::Function(..) => format!("a function (`{}`)", self.show(ty)),
            Node::Record(fields) if fields.is_empty() => "the empty record".into(),
            Node::Record(_) => format!("a record (`{}`)", self.show(ty)),
            Node::Rigid { name, kind, .. } if kind.is_any() => format!("any type `{name}`"),
            Node::Rigid { name, kind, .. } => format!("any `{name}` ({})", kind.words()),
            Node::Variable { kind, .. } => kind.words(),
            Node::Error | Node::Link(_) => "unknown".into(),
        }
    }

    /// A type in words, several of it.
    pub(super) fn several(&mut self, ty: Ty) -> String {
        self.plural(ty, 0).unwrap_or_else(|| "these".into())
    }

    fn plural(&mut self, ty: Ty, depth: usize) -> Option<String> {
        match self.store.get(ty) {
            Node::List(_) if depth > 2 => Some("lists".into()),
            Node::List(of) => {
                let of = self.plural(*of, depth + 1);
                Some(of.map_or_else(|| "lists".into(), |of| format!("lists of {of}")))
            }
            Node::Function(..) => Some(format!("functions (`{}`)", self.show(ty))),
            Node::Record(_) => Some("records".into()),
            _ => self.store.head(ty).map(|head| head.plural().into()),
        }
    }
}

/// `a` to `z`, then `a1` and so on.
fn letters(number: usize) -> String {
    let letter = char::from(b'a' + u8::try_from(number % 26).unwrap_or(0));
    match number / 26 {
        0 => letter.into(),
        round => format!("{letter}{round}"),
    }
}
