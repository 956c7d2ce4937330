//! In which order bindings that use each other are worked out.

use super::compile::mentions;
use crate::hry::ast::{Definition, Pattern, PatternKind};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Bindings that need each other, or one that does not.
#[derive(Debug)]
pub(super) struct Component {
    /// Their places.
    pub(super) members: Vec<usize>,
    /// Whether one of them needs itself, directly or through others.
    pub(super) recursive: bool,
}

/// The strongly connected components of bindings, each after those it needs (R. Tarjan, "Depth-First Search and Linear
/// Graph Algorithms", 1972; without recursion). Among themselves in the order of the source.
pub(super) fn components(bindings: &[Definition]) -> Vec<Component> {
    let mut owner: BTreeMap<Arc<str>, usize> = BTreeMap::new();
    for (i, binding) in bindings.iter().enumerate() {
        for name in bound(&binding.target) {
            owner.insert(name, i);
        }
    }
    let names: BTreeSet<Arc<str>> = owner.keys().cloned().collect();
    let needs: Vec<Vec<usize>> = bindings
        .iter()
        .map(|binding| {
            let mut found = BTreeSet::new();
            mentions(&binding.body, &names, &mut found);
            let own: BTreeSet<Arc<str>> = binding.parameters.iter().flat_map(bound).collect();
            let owners: BTreeSet<usize> = found
                .iter()
                .filter(|name| !own.contains(*name))
                .filter_map(|name| owner.get(name).copied())
                .collect();
            owners.into_iter().collect()
        })
        .collect();
    tarjan(&needs)
}

fn tarjan(needs: &[Vec<usize>]) -> Vec<Component> {
    const UNSEEN: usize = usize::MAX;
    let count = needs.len();
    let (mut index, mut low, mut on_stack) = (vec![UNSEEN; count], vec![0; count], vec![false; count]);
    let (mut stack, mut result, mut next) = (Vec::new(), Vec::new(), 0);
    for start in 0..count {
        if index[start] != UNSEEN {
            continue;
        }
        let mut work = vec![(start, 0)];
        while let Some((node, edge)) = work.pop() {
            if edge == 0 {
                (index[node], low[node]) = (next, next);
                next += 1;
                stack.push(node);
                on_stack[node] = true;
            }
            match needs[node].get(edge) {
                Some(&to) => {
                    work.push((node, edge + 1));
                    if index[to] == UNSEEN {
                        work.push((to, 0));
                    } else if on_stack[to] {
                        low[node] = low[node].min(index[to]);
                    }
                }
                None => {
                    if low[node] == index[node] {
                        let from = stack.iter().rposition(|n| *n == node).unwrap_or(0);
                        let mut members = stack.split_off(from);
                        members.iter().for_each(|member| on_stack[*member] = false);
                        members.sort_unstable();
                        let recursive = members.len() > 1 || needs[node].contains(&node);
                        result.push(Component { members, recursive });
                    }
                    if let Some((parent, _)) = work.last() {
                        low[*parent] = low[*parent].min(low[node]);
                    }
                }
            }
        }
    }
    result
}

/// The names that a pattern binds.
pub(super) fn bound(pattern: &Pattern) -> Vec<Arc<str>> {
    match &pattern.kind {
        PatternKind::Name(name) => vec![name.clone()],
        PatternKind::Vector(items) => items.iter().flat_map(bound).collect(),
        PatternKind::List { items, rest } => {
            let rest = rest.iter().flatten().map(|name| name.text.clone());
            items.iter().flat_map(bound).chain(rest).collect()
        }
        PatternKind::Record(fields) => fields.iter().flat_map(|(_, pattern)| bound(pattern)).collect(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::tarjan;

    #[test]
    fn components_come_after_what_they_need() {
        let needs = [vec![1], vec![2, 3], vec![1], vec![], vec![4, 0]];
        let found: Vec<_> = tarjan(&needs).into_iter().map(|c| (c.members, c.recursive)).collect();
        assert_eq!(found, [(vec![3], false), (vec![1, 2], true), (vec![0], false), (vec![4], true)]);
    }
}
