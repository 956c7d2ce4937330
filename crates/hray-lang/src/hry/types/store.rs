//! Types: a store of nodes with variables that are bound as more becomes known.

use super::kind::{Head, Kind};
use std::collections::HashMap;
use std::sync::Arc;

/// A type: a place in a [`Store`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Ty(pub(super) u32);

/// What stands at a place.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Node {
    /// The same as another.
    Link(Ty),
    /// Not known yet; after generalisation, a parameter of a scheme.
    Variable {
        /// How deep inside `let`s it belongs: what is deeper than the environment can be generalised.
        level: u32,
        /// What it may become.
        kind: Kind,
    },
    /// A variable of an annotation, which must stay what it is.
    Rigid {
        /// As written.
        name: Arc<str>,
        /// The level of the annotated definition.
        level: u32,
        /// What it stands for.
        kind: Kind,
    },
    /// A type that stands alone.
    Alone(Head),
    /// A list.
    List(Ty),
    /// A function from the first to the second.
    Function(Ty, Ty),
    /// A record; fields in the order of their names.
    Record(Arc<[(Arc<str>, Ty)]>),
    /// The type of what is wrong. It agrees with everything, so that one mistake is one error.
    Error,
}

/// The level of variables that a scheme generalises.
pub(super) const GENERIC: u32 = u32::MAX;
/// Types nest no deeper.
pub(super) const MOST_NESTED: usize = 400;

/// Why two types do not agree: the innermost disagreement.
#[derive(Clone, Copy, Debug)]
pub(super) enum Clash {
    /// Two types that differ.
    Differ(Ty, Ty),
    /// A type is none of those that are allowed.
    Kind(Ty, Kind),
    /// A type would contain itself.
    Infinite,
    /// A variable of an annotation would leave it.
    Escape(Ty),
    /// Nested too deeply.
    TooDeep,
}

/// All types of a program.
#[derive(Clone, Debug)]
pub(super) struct Store {
    nodes: Vec<Node>,
    /// What was changed since the current unification began, to take it back.
    trail: Vec<(Ty, Node)>,
    /// Variables that became something since the last call of [`Store::woken`].
    woken: Vec<Ty>,
    marks: Vec<u32>,
    mark: u32,
}

impl Default for Store {
    fn default() -> Self {
        let mut nodes = vec![Node::Error];
        nodes.extend(Head::ALONE.map(Node::Alone));
        Self { nodes, trail: Vec::new(), woken: Vec::new(), marks: Vec::new(), mark: 0 }
    }
}

impl Ty {
    /// The type of what is wrong.
    pub(super) const ERROR: Self = Self(0);
    pub(super) const NUMBER: Self = Self::alone(Head::Number);
    pub(super) const BOOL: Self = Self::alone(Head::Bool);
    pub(super) const TEXT: Self = Self::alone(Head::Text);
    pub(super) const VEC2: Self = Self::alone(Head::Vec2);
    pub(super) const VEC3: Self = Self::alone(Head::Vec3);
    pub(super) const COLOR: Self = Self::alone(Head::Color);
    pub(super) const HIT: Self = Self::alone(Head::Hit);

    /// A type that stands alone.
    pub(super) const fn alone(head: Head) -> Self {
        Self(head as u32 + 1)
    }
}

impl Store {
    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    fn add(&mut self, node: Node) -> Ty {
        // Inference stops long before there are so many.
        let ty = Ty(u32::try_from(self.nodes.len()).unwrap_or(0));
        self.nodes.push(node);
        ty
    }

    pub(super) fn variable(&mut self, level: u32, kind: Kind) -> Ty {
        match kind.only() {
            Some(head) => Ty::alone(head),
            None => self.add(Node::Variable { level, kind }),
        }
    }

    pub(super) fn rigid(&mut self, name: Arc<str>, level: u32, kind: Kind) -> Ty {
        self.add(Node::Rigid { name, level, kind })
    }

    pub(super) fn list(&mut self, of: Ty) -> Ty {
        self.add(Node::List(of))
    }

    pub(super) fn function(&mut self, from: Ty, to: Ty) -> Ty {
        self.add(Node::Function(from, to))
    }

    pub(super) fn record(&mut self, mut fields: Vec<(Arc<str>, Ty)>) -> Ty {
        fields.sort_by(|a, b| a.0.cmp(&b.0));
        self.add(Node::Record(fields.into()))
    }

    /// Where a type really stands.
    pub(super) fn find(&self, ty: Ty) -> Ty {
        let mut ty = ty;
        while let Some(Node::Link(next)) = self.nodes.get(ty.0 as usize) {
            ty = *next;
        }
        ty
    }

    /// What a type is.
    pub(super) fn get(&self, ty: Ty) -> &Node {
        self.nodes.get(self.find(ty).0 as usize).unwrap_or(&Node::Error)
    }

    /// The head of a type, where it is known.
    pub(super) fn head(&self, ty: Ty) -> Option<Head> {
        match self.get(ty) {
            Node::Alone(head) => Some(*head),
            Node::List(_) => Some(Head::List),
            Node::Function(..) => Some(Head::Function),
            Node::Record(_) => Some(Head::Record),
            _ => None,
        }
    }

    pub(super) fn is_error(&self, ty: Ty) -> bool {
        matches!(self.get(ty), Node::Error)
    }

    pub(super) fn is_variable(&self, ty: Ty) -> bool {
        matches!(self.get(ty), Node::Variable { .. })
    }

    /// The kind of a variable, rigid or not.
    pub(super) fn kind(&self, ty: Ty) -> Option<Kind> {
        match self.get(ty) {
            Node::Variable { kind, .. } | Node::Rigid { kind, .. } => Some(*kind),
            _ => None,
        }
    }

    /// What a type surely is one of.
    pub(super) fn heads(&self, ty: Ty) -> Kind {
        match (self.head(ty), self.kind(ty)) {
            (Some(head), _) => Kind::of(&[head]),
            (_, Some(kind)) => kind,
            _ => Kind::ANY,
        }
    }

    /// Parameters of a function type, and its result.
    pub(super) fn parameters(&self, ty: Ty) -> (Vec<Ty>, Ty) {
        let (mut ty, mut parameters) = (ty, Vec::new());
        while let Node::Function(from, to) = self.get(ty) {
            if parameters.len() > MOST_NESTED {
                break;
            }
            parameters.push(*from);
            ty = *to;
        }
        (parameters, ty)
    }

    /// The variables that became something since this was last asked.
    pub(super) fn woken(&mut self) -> Vec<Ty> {
        std::mem::take(&mut self.woken)
    }

    fn set(&mut self, ty: Ty, node: Node) {
        if let Some(slot) = self.nodes.get_mut(ty.0 as usize) {
            let before = std::mem::replace(slot, node);
            self.trail.push((ty, before));
        }
    }

    /// Makes a variable belong to a level that is further out.
    pub(super) fn set_level(&mut self, ty: Ty, to: u32) {
        let ty = self.find(ty);
        if let Some(Node::Variable { level, .. }) = self.nodes.get_mut(ty.0 as usize) {
            *level = to;
        }
    }

    /// Makes two types the same. Where they do not agree, nothing changes.
    pub(super) fn unify(&mut self, a: Ty, b: Ty) -> Result<(), Clash> {
        let result = self.unify_within(a, b, 0);
        self.settle(result)
    }

    /// Makes a type one of a kind. Where it is not, nothing changes.
    pub(super) fn narrow(&mut self, ty: Ty, kind: Kind) -> Result<(), Clash> {
        let result = self.demand(ty, kind, 0);
        self.settle(result)
    }

    fn settle(&mut self, result: Result<(), Clash>) -> Result<(), Clash> {
        let trail = std::mem::take(&mut self.trail);
        match result {
            Ok(()) => {
                let variables = trail
                    .iter()
                    .filter(|(_, before)| matches!(before, Node::Variable { .. } | Node::Rigid { .. }));
                self.woken.extend(variables.map(|(ty, _)| *ty));
            }
            Err(_) => {
                for (ty, before) in trail.into_iter().rev() {
                    if let Some(slot) = self.nodes.get_mut(ty.0 as usize) {
                        *slot = before;
                    }
                }
            }
        }
        result
    }

    fn unify_within(&mut self, a: Ty, b: Ty, depth: usize) -> Result<(), Clash> {
        let (a, b) = (self.find(a), self.find(b));
        if a == b {
            return Ok(());
        }
        if depth > MOST_NESTED {
            return Err(Clash::TooDeep);
        }
        match (self.get(a).clone(), self.get(b).clone()) {
            (Node::Variable { level: l, kind: k }, Node::Variable { level: m, kind: n }) => {
                let kind = k.meet(n);
                if kind.is_empty() {
                    return Err(Clash::Differ(a, b));
                }
                if let Some(head) = kind.only() {
                    self.set(b, Node::Link(Ty::alone(head)));
                } else if (l.min(m), kind) != (m, n) {
                    self.set(b, Node::Variable { level: l.min(m), kind });
                }
                self.set(a, Node::Link(b));
                Ok(())
            }
            (Node::Variable { level, kind }, _) => self.bind(a, level, kind, b, depth),
            (_, Node::Variable { level, kind }) => self.bind(b, level, kind, a, depth),
            (Node::Error, _) | (_, Node::Error) => Ok(()),
            (Node::List(x), Node::List(y)) => {
                self.set(a, Node::Link(b));
                self.unify_within(x, y, depth + 1)
            }
            (Node::Function(p, q), Node::Function(r, s)) => {
                self.set(a, Node::Link(b));
                self.unify_within(p, r, depth + 1)?;
                self.unify_within(q, s, depth + 1)
            }
            (Node::Record(x), Node::Record(y)) => {
                if !x.iter().map(|field| &field.0).eq(y.iter().map(|field| &field.0)) {
                    return Err(Clash::Differ(a, b));
                }
                self.set(a, Node::Link(b));
                x.iter().zip(y.iter()).try_for_each(|(x, y)| self.unify_within(x.1, y.1, depth + 1))
            }
            _ => Err(Clash::Differ(a, b)),
        }
    }

    fn bind(&mut self, variable: Ty, level: u32, kind: Kind, to: Ty, depth: usize) -> Result<(), Clash> {
        self.inside(variable, level, to)?;
        self.set(variable, Node::Link(to));
        self.demand(to, kind, depth)
    }

    /// A variable cannot contain itself; what it contains belongs to its level.
    fn inside(&mut self, variable: Ty, level: u32, ty: Ty) -> Result<(), Clash> {
        let mut open = vec![ty];
        self.clear_marks();
        while let Some(next) = open.pop() {
            let next = self.find(next);
            if next == variable {
                return Err(Clash::Infinite);
            }
            if !self.mark(next) {
                continue;
            }
            match self.get(next).clone() {
                Node::Variable { level: inner, kind } if inner > level => {
                    self.set(next, Node::Variable { level, kind });
                }
                Node::Rigid { level: inner, .. } if inner > level => return Err(Clash::Escape(next)),
                Node::List(of) => open.push(of),
                Node::Function(from, to) => open.extend([from, to]),
                Node::Record(fields) => open.extend(fields.iter().map(|field| field.1)),
                _ => {}
            }
        }
        Ok(())
    }

    fn demand(&mut self, ty: Ty, kind: Kind, depth: usize) -> Result<(), Clash> {
        let ty = self.find(ty);
        if depth > MOST_NESTED {
            return Err(Clash::TooDeep);
        }
        let fits = |fits: bool| if fits { Ok(()) } else { Err(Clash::Kind(ty, kind)) };
        match self.get(ty).clone() {
            Node::Error | Node::Link(_) => Ok(()),
            Node::Alone(head) => fits(kind.has(head)),
            Node::Variable { level, kind: known } => {
                let both = kind.meet(known);
                fits(!both.is_empty())?;
                if let Some(head) = both.only() {
                    self.set(ty, Node::Link(Ty::alone(head)));
                } else if both != known {
                    self.set(ty, Node::Variable { level, kind: both });
                }
                Ok(())
            }
            Node::Rigid { name, level, kind: known } => {
                // An annotation has no word for what can be compared, so a plain variable may turn out to be
                // that.
                if known.is_any() && kind == Kind::EQUATABLE {
                    self.set(ty, Node::Rigid { name, level, kind });
                    return Ok(());
                }
                fits(known.within(kind))
            }
            Node::List(of) => {
                fits(kind.has(Head::List))?;
                if kind.is_equatable() { self.demand(of, Kind::EQUATABLE, depth + 1) } else { Ok(()) }
            }
            Node::Record(fields) => {
                fits(kind.has(Head::Record))?;
                if !kind.is_equatable() {
                    return Ok(());
                }
                fields.iter().try_for_each(|(_, ty)| self.demand(*ty, Kind::EQUATABLE, depth + 1))
            }
            Node::Function(from, _) => {
                fits(kind.has(Head::Function))?;
                if kind.is_placeable() { self.unify_within(from, Ty::HIT, depth + 1) } else { Ok(()) }
            }
        }
    }

    fn clear_marks(&mut self) {
        self.marks.resize(self.nodes.len(), 0);
        self.mark = self.mark.wrapping_add(1);
        if self.mark == 0 {
            self.marks.fill(0);
            self.mark = 1;
        }
    }

    /// Marks a node; whether it was not marked before.
    fn mark(&mut self, ty: Ty) -> bool {
        let mark = self.mark;
        self.marks.get_mut(ty.0 as usize).is_some_and(|slot| std::mem::replace(slot, mark) != mark)
    }

    /// The variables inside types, rigid or not, each once, in the order of appearance; and how many nodes
    /// there are.
    pub(super) fn variables(&mut self, types: impl IntoIterator<Item = Ty>) -> (Vec<Ty>, usize) {
        let mut open: Vec<Ty> = types.into_iter().collect();
        open.reverse();
        let (mut found, mut size) = (Vec::new(), 0);
        self.clear_marks();
        while let Some(next) = open.pop() {
            let next = self.find(next);
            if !self.mark(next) {
                continue;
            }
            size += 1;
            match self.get(next) {
                Node::Variable { .. } | Node::Rigid { .. } => found.push(next),
                Node::List(of) => open.push(*of),
                Node::Function(from, to) => {
                    let (from, to) = (*from, *to);
                    open.extend([to, from]);
                }
                Node::Record(fields) => open.extend(fields.clone().iter().rev().map(|field| field.1)),
                _ => {}
            }
        }
        (found, size)
    }

    /// How deep a type nests, counted up to [`MOST_NESTED`] and a bit. The results of a function count as one
    /// level each.
    pub(super) fn is_too_deep(&self, ty: Ty) -> bool {
        // Memory over what was seen keeps shared parts from being walked again and again.
        let mut deepest: HashMap<Ty, usize> = HashMap::new();
        let mut open = vec![(ty, 0)];
        while let Some((next, depth)) = open.pop() {
            let next = self.find(next);
            if depth > MOST_NESTED {
                return true;
            }
            let seen = deepest.entry(next).or_insert(0);
            if *seen > depth {
                continue;
            }
            *seen = depth + 1;
            match self.get(next) {
                Node::List(of) => open.push((*of, depth + 1)),
                Node::Function(from, to) => open.extend([(*from, depth + 1), (*to, depth + 1)]),
                Node::Record(fields) => open.extend(fields.iter().map(|field| (field.1, depth + 1))),
                _ => {}
            }
        }
        false
    }

    /// A copy with some variables replaced; parts without any are shared. The map remembers what was copied
    /// already.
    pub(super) fn copy(&mut self, ty: Ty, map: &mut HashMap<Ty, Ty>, depth: usize) -> Ty {
        let ty = self.find(ty);
        if let Some(known) = map.get(&ty) {
            return *known;
        }
        if depth > MOST_NESTED + 2 {
            return Ty::ERROR;
        }
        let copied = match self.get(ty).clone() {
            Node::List(of) => {
                let of = self.find(of);
                let copied = self.copy(of, map, depth + 1);
                if copied == of { ty } else { self.list(copied) }
            }
            Node::Function(from, to) => {
                let (from, to) = (self.find(from), self.find(to));
                let copied = (self.copy(from, map, depth + 1), self.copy(to, map, depth + 1));
                if copied == (from, to) { ty } else { self.function(copied.0, copied.1) }
            }
            Node::Record(fields) => {
                let copied: Vec<_> =
                    fields.iter().map(|(name, ty)| (name.clone(), self.copy(*ty, map, depth + 1))).collect();
                if copied[..] == fields[..] { ty } else { self.add(Node::Record(copied.into())) }
            }
            _ => ty,
        };
        map.insert(ty, copied);
        copied
    }
}
