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

/// Up to `WIDTH` nodes.
#[derive(Default)]
pub(crate) struct Children {
    nodes: [usize; WIDTH],
    count: usize,
}

impl Children {
    fn push(&mut self, node: usize) {
        self.nodes[self.count] = node;
        self.count += 1;
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = usize> {
        self.nodes[..self.count].iter().copied()
    }
}

/// The best plan of each node, for each number of roots from 1 to `WIDTH`.
pub(crate) struct Collapse<'a> {
    nodes: &'a [Binary],
    plans: Vec<[Plan; WIDTH]>,
    /// How many of a node's own children come from the first, and how many there are.
    shares: Vec<(u8, u8)>,
}

impl<'a> Collapse<'a> {
    /// Finds them. `leaf` is what a leaf of so many things costs to test, if it may be one; a node costs `node`.
    pub(crate) fn new(nodes: &'a [Binary], node: f32, leaf: impl Fn(usize) -> Option<f32>) -> Self {
        let mut costs = vec![[f32::INFINITY; WIDTH]; nodes.len()];
        let mut plans = vec![[Plan::Fewer; WIDTH]; nodes.len()];
        let mut shares = vec![(1, 2); nodes.len()];
        // The most roots that a node can give: near the leaves, where most nodes are, that is few.
        let mut most = vec![1u8; nodes.len()];
        for (index, binary) in nodes.iter().enumerate().rev() {
            let area = binary.bounds.half_area();
            let as_leaf = leaf(binary.places.len()).map_or(f32::INFINITY, |cost| area * cost);
            let plan = &mut plans[index];
            plan[0] = Plan::Leaf;
            let Some([left, right]) = binary.children else {
                costs[index] = [as_leaf; WIDTH];
                continue;
            };
            let (of_left, of_right) = (usize::from(most[left]), usize::from(most[right]));
            let roots = (of_left + of_right).min(WIDTH);
            most[index] = roots as u8;
            // The cheapest way to give so many roots, less one; none gives 1.
            let mut shared = [(f32::INFINITY, 1); WIDTH];
            for first in 0..of_left {
                for second in 0..of_right.min(WIDTH - 1 - first) {
                    let cost = costs[left][first] + costs[right][second];
                    if cost < shared[first + second + 1].0 {
                        shared[first + second + 1] = (cost, first as u8 + 1);
                    }
                }
            }
            let mut own = 1;
            for more in 2..roots {
                if shared[more].0 < shared[own].0 {
                    own = more;
                }
            }
            shares[index] = (shared[own].1, own as u8 + 1);
            let as_node = area * node + shared[own].0;
            let mut cost = [as_leaf; WIDTH];
            if as_node < as_leaf || as_leaf == f32::INFINITY {
                (cost[0], plan[0]) = (as_node, Plan::Node);
            }
            for more in 1..WIDTH {
                cost[more] = cost[more - 1];
                if shared[more].0 < cost[more] {
                    (cost[more], plan[more]) = (shared[more].0, Plan::Share(shared[more].1));
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
    pub(crate) fn children(&self, index: usize) -> Children {
        let mut children = Children::default();
        match self.nodes[index].children {
            Some([left, right]) if !self.is_leaf(index) => {
                let (share, roots) = self.shares[index];
                self.gather(left, usize::from(share), &mut children);
                self.gather(right, usize::from(roots - share), &mut children);
            }
            _ => children.push(index),
        }
        children
    }

    fn gather(&self, index: usize, roots: usize, children: &mut Children) {
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
