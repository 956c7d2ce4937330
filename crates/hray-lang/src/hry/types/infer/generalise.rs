//! From the type of a definition to a type for every use.

use super::group::Member;
use super::solve::{TELLING_HIT_FIELDS, field_of};
use super::{Infer, MOST_NODES};
use crate::diagnostic::{Diagnostic, Span};
use crate::hry::types::kind::Head;
use crate::hry::types::scheme::{Access, Constraint, Demand, Scheme};
use crate::hry::types::store::{GENERIC, Node, Ty};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

/// The most parts of a type that is made anew for every use, and of one that is not.
const MOST_PARTS: usize = 4_000;
const MOST_FIXED_PARTS: usize = 200_000;
/// The most demands that a definition makes on the types it is used at.
const MOST_DEMANDS: usize = 200;

impl<'p> Infer<'p> {
    /// The schemes of definitions whose demands are those from `start` on.
    pub(super) fn generalise(&mut self, members: &[Member<'p>], start: usize) -> Vec<Scheme> {
        self.solve();
        let mut open = Vec::new();
        self.take_open(start, &mut open);
        self.become_hits(&open);
        self.take_open(start, &mut open);
        if members.iter().any(|member| member.annotation.is_some()) {
            self.settle_rigid(&open);
            self.take_open(start, &mut open);
        }
        let closed = self.keep_outer(open);
        members.iter().map(|member| self.scheme(member, &closed)).collect()
    }

    /// The undecided demands.
    fn take_open(&mut self, start: usize, open: &mut Vec<usize>) {
        if start < self.pending.len() {
            open.extend(self.pending.split_off(start));
        }
        open.retain(|id| self.solved.get(*id) == Some(&false));
    }

    fn demand_of(&self, id: usize) -> Option<&Demand> {
        self.constraints.get(id).map(|constraint| &constraint.demand)
    }

    fn level_of(&self, ty: Ty) -> Option<u32> {
        match self.types.store.get(ty) {
            Node::Variable { level, .. } | Node::Rigid { level, .. } => Some(*level),
            _ => None,
        }
    }

    /// A variable whose fields are all those of a hit, and one of them tells, is one.
    fn become_hits(&mut self, open: &[usize]) {
        let mut fields: BTreeMap<Ty, Vec<Arc<str>>> = BTreeMap::new();
        for id in open {
            if let Some(Demand::Field { record, name, .. }) = self.demand_of(*id) {
                fields.entry(self.types.store.find(*record)).or_default().push(name.clone());
            }
        }
        for (variable, names) in fields {
            let is_inner = self.level_of(variable).is_some_and(|level| level > self.level);
            let all = names.iter().all(|name| field_of(Head::Hit, name, Access::Whole).is_some());
            let one = names.iter().any(|name| TELLING_HIT_FIELDS.contains(&&**name));
            let can = self.types.store.heads(variable).has(Head::Hit);
            if is_inner && all && one && can && self.types.store.is_variable(variable) {
                let _ = self.unify(variable, Ty::HIT);
            }
        }
        self.solve();
    }

    /// Demands on the variables of annotations must hold for all that those stand for. What else they depend
    /// on is made a number where it can be, which goes with everything.
    fn settle_rigid(&mut self, open: &[usize]) {
        for id in open {
            let Some(constraint) = self.constraints.get(*id).cloned() else { continue };
            let types = constraint.demand.types();
            let is_rigid = |ty: &Ty| matches!(self.types.store.get(*ty), Node::Rigid { level, .. } if *level > self.level);
            if self.solved.get(*id) != Some(&false) || !types.iter().any(is_rigid) {
                continue;
            }
            if let Demand::Arithmetic { left, right, .. } = constraint.demand {
                for side in [left, right] {
                    if self.types.store.is_variable(side) {
                        let _ = self.unify(side, Ty::NUMBER);
                    }
                }
            }
            if self.solved.get(*id) == Some(&false) {
                self.done(*id);
                self.too_special(&constraint);
            }
        }
    }

    /// Demands that also concern variables from outside stay open, and so do all variables that they concern.
    /// The others.
    fn keep_outer(&mut self, open: Vec<usize>) -> Vec<usize> {
        let mut concerned: HashMap<Ty, Vec<usize>> = HashMap::new();
        let mut outer = Vec::new();
        let mut is_outer: HashSet<Ty> = HashSet::new();
        for id in &open {
            for variable in self.variables_of(*id) {
                concerned.entry(variable).or_default().push(*id);
                let level = self.level_of(variable).unwrap_or(0);
                if level <= self.level && is_outer.insert(variable) {
                    outer.push(variable);
                }
            }
        }
        let mut kept: HashSet<usize> = HashSet::new();
        while let Some(variable) = outer.pop() {
            for id in concerned.remove(&variable).unwrap_or_default() {
                if !kept.insert(id) {
                    continue;
                }
                for other in self.variables_of(id) {
                    if is_outer.insert(other) {
                        self.types.store.set_level(other, self.level);
                        outer.push(other);
                    }
                }
            }
        }
        let (kept, closed) = open.into_iter().partition(|id| kept.contains(id));
        self.pending.extend::<Vec<usize>>(kept);
        closed
    }

    fn variables_of(&mut self, id: usize) -> Vec<Ty> {
        let types = self.demand_of(id).map(Demand::types);
        types.map(|types| self.types.store.variables(types).0).unwrap_or_default()
    }

    fn scheme(&mut self, member: &Member<'p>, closed: &[usize]) -> Scheme {
        let span = member.definition.target.span;
        let (inside, size) = self.types.store.variables([member.ty]);
        let inner = |infer: &Self, ty: &Ty| infer.level_of(*ty).is_some_and(|level| level > infer.level);
        let mut bound: Vec<Ty> = inside.into_iter().filter(|ty| inner(self, ty)).collect();
        let most = if bound.is_empty() { MOST_FIXED_PARTS } else { MOST_PARTS };
        if size > most || self.types.store.is_too_deep(member.ty) || self.types.store.len() > MOST_NODES {
            self.too_large(member, span);
            return Scheme { ty: Ty::ERROR, bound: Vec::new(), constraints: Vec::new() };
        }
        let constraints = self.connected(&mut bound, closed);
        if constraints.len() > MOST_DEMANDS {
            self.too_large(member, span);
            return Scheme { ty: Ty::ERROR, bound: Vec::new(), constraints: Vec::new() };
        }
        for variable in &bound {
            self.types.store.set_level(*variable, GENERIC);
        }
        Scheme { ty: member.ty, bound, constraints }
    }

    /// The demands that concern some variables, directly or not; their variables are added. Demands on what
    /// cannot be seen from outside are about values that nothing has, so they are dropped.
    fn connected(&mut self, bound: &mut Vec<Ty>, closed: &[usize]) -> Vec<Constraint> {
        if closed.is_empty() || bound.is_empty() {
            return Vec::new();
        }
        let mut concerned: HashMap<Ty, Vec<usize>> = HashMap::new();
        for id in closed {
            for variable in self.variables_of(*id) {
                concerned.entry(variable).or_default().push(*id);
            }
        }
        let mut seen: HashSet<Ty> = bound.iter().copied().collect();
        let (mut taken, mut next) = (Vec::new(), 0);
        while let Some(variable) = bound.get(next).copied() {
            next += 1;
            for id in concerned.remove(&variable).unwrap_or_default() {
                if taken.contains(&id) || taken.len() > MOST_DEMANDS {
                    continue;
                }
                taken.push(id);
                let more = self.variables_of(id);
                bound.extend(more.into_iter().filter(|variable| seen.insert(*variable)));
            }
        }
        taken.sort_unstable();
        let mut known: HashSet<(Ty, Ty, Ty)> = HashSet::new();
        let constraints = taken.iter().filter_map(|id| self.constraints.get(*id));
        let distinct = constraints.filter(|constraint| match constraint.demand {
            Demand::Arithmetic { left, right, result, .. } => {
                let find = |ty| self.types.store.find(ty);
                let (left, right) = (find(left), find(right));
                known.insert((left.min(right), left.max(right), find(result)))
            }
            _ => true,
        });
        distinct.cloned().collect()
    }

    fn too_large(&mut self, member: &Member<'p>, span: Span) {
        let name = member.definition.name().map_or_else(|| "this".into(), |name| name.text);
        let error = Diagnostic::error(
            "type-too-large",
            format!("the type of `{name}` is too large"),
            span,
            "what this may be used for is too much to keep track of",
        );
        self.report(error.with_help(format!(
            "write its type before it, for example `{name} : Number -> Number`, or split it"
        )));
    }
}
