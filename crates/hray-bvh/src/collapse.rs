//! From a tree with two children a node to one with eight, as cheaply as it can be done: dynamic programming over how many
//! children each subtree gives to the node above it (Ylitie, Karras and Laine, *Efficient Incoherent Ray Traversal on GPUs
//! Through Compressed Wide BVHs*, HPG 2017, section 3.1).

use crate::Bounds;
use crate::tree::WIDTH;
use std::ops::Range;

/// A node with two children, or none.
#[derive(Clone, Debug)]
pub(crate) struct Binary {
    pub(crate) bounds: Bounds,
    /// The things in it, by place.
    pub(crate) places: Range<usize>,
    /// Its children; they come after it.
    pub(crate) children: Option<[usize; 2]>,
}

/// What becomes of a node that may give a number of roots.
#[derive(Clone, Copy, PartialEq)]
enum Plan {
    /// One: itself, as a leaf.
    Leaf,
    /// One: itself, as a node.
    Node,
    /// The same as with one root less.
    Fewer,
    /// So many come from the first child, the others from the second.
    Share(u8),
}

/// The best plan of each node, for each number of roots from 1 to `WIDTH`.
pub(crate) struct Collapse<'a> {
    nodes: &'a [Binary],
    plans: Vec<[Plan; WIDTH]>,
    /// How many of a node's own children come from the first.
    shares: Vec<u8>,
}

impl<'a> Collapse<'a> {
    /// Finds them. `leaf` is what a leaf of so many things costs to test, if it may be one; a node costs `node`.
    pub(crate) fn new(nodes: &'a [Binary], node: f32, leaf: impl Fn(usize) -> Option<f32>) -> Self {
        let mut costs = vec![[f32::INFINITY; WIDTH]; nodes.len()];
        let mut plans = vec![[Plan::Fewer; WIDTH]; nodes.len()];
        let mut shares = vec![0; nodes.len()];
        for (index, binary) in nodes.iter().enumerate().rev() {
            let area = binary.bounds.half_area();
            let as_leaf = leaf(binary.places.len()).map(|cost| area * cost);
            let mut cost = [as_leaf.unwrap_or(f32::INFINITY); WIDTH];
            plans[index][0] = Plan::Leaf;
            if let Some([left, right]) = binary.children {
                let shared: [(f32, u8); WIDTH] = std::array::from_fn(|more| {
                    let mut best = (f32::INFINITY, 1);
                    for share in 1..=more {
                        let cost = costs[left][share - 1] + costs[right][more - share];
                        if cost < best.0 {
                            best = (cost, share as u8);
                        }
                    }
                    best
                });
                shares[index] = shared[WIDTH - 1].1;
                let as_node = area * node + shared[WIDTH - 1].0;
                if as_leaf.is_none_or(|as_leaf| as_node < as_leaf) {
                    (cost[0], plans[index][0]) = (as_node, Plan::Node);
                }
                for more in 1..WIDTH {
                    cost[more] = cost[more - 1];
                    if shared[more].0 < cost[more] {
                        (cost[more], plans[index][more]) = (shared[more].0, Plan::Share(shared[more].1));
                    }
                }
            }
            costs[index] = cost;
        }
        Self { nodes, plans, shares }
    }

    /// Whether a node becomes a leaf.
    pub(crate) fn is_leaf(&self, index: usize) -> bool {
        self.plans[index][0] == Plan::Leaf
    }

    /// The children that a node gets, in order; of a leaf, itself.
    pub(crate) fn children(&self, index: usize) -> Vec<usize> {
        let mut children = Vec::with_capacity(WIDTH);
        match self.nodes[index].children {
            Some([left, right]) if !self.is_leaf(index) => {
                let share = usize::from(self.shares[index]);
                self.gather(left, share, &mut children);
                self.gather(right, WIDTH - share, &mut children);
            }
            _ => children.push(index),
        }
        children
    }

    fn gather(&self, index: usize, roots: usize, children: &mut Vec<usize>) {
        match (self.plans[index][roots - 1], self.nodes[index].children) {
            (Plan::Share(share), Some([left, right])) => {
                self.gather(left, usize::from(share), children);
                self.gather(right, roots - usize::from(share), children);
            }
            (Plan::Fewer, _) => self.gather(index, roots - 1, children),
            _ => children.push(index),
        }
    }
}
