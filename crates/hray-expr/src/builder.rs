//! Making graphs: constants are folded and equal computations shared as nodes are made.

use crate::{Binary, Block, Function, Input, Loop, Node, NodeId, NoiseKind, Unary};
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

/// Loops may stand in loops up to this deep, so that what walks them may recurse.
const MAX_NESTING: usize = 32;

/// A graph would have more nodes than its builder allows, or loops in loops more than 32 deep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GraphTooLarge {
    /// The most nodes.
    pub budget: usize,
}

impl fmt::Display for GraphTooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the function needs more than {} operations, or loops nested more than {MAX_NESTING} deep",
            self.budget
        )
    }
}

impl std::error::Error for GraphTooLarge {}

/// Makes a graph, node by node.
///
/// A node whose operands are all constants becomes a constant, and a node that exists already is found again.
/// Nothing else is rewritten, so that what is computed is what was written, to the last bit.
///
/// A [`NodeId`] belongs to the builder that made it.
pub struct Builder {
    budget: usize,
    nodes: Vec<Node>,
    /// Of each node, how many of the open loops it is inside of; 0 if it depends on no loop's state.
    depths: Vec<u8>,
    /// Where each node is that can be shared. Only ever looked up in.
    known: HashMap<Key, NodeId>,
    /// The loops with given arguments.
    loops: HashMap<Box<[NodeId]>, Vec<NodeId>>,
    open: Vec<OpenLoop>,
    /// How many numbers of loops' states there are.
    arguments: u32,
}

/// A loop whose body is being made.
struct OpenLoop {
    /// The first node of it: its arguments are `start` and the following.
    start: usize,
    state: usize,
}

/// What makes a node the same as another. Images are the same when they are one in memory.
#[derive(PartialEq, Eq, Hash)]
enum Key {
    Constant(u64),
    Input(Input),
    Unary(Unary, NodeId),
    Binary(Binary, NodeId, NodeId),
    Select(NodeId, NodeId, NodeId),
    Noise(NoiseKind, u64, [NodeId; 3]),
    Cells(u64, Box<[NodeId]>),
    Image(usize, Box<[NodeId]>),
    Result(NodeId, u8),
}

impl Builder {
    /// With room for `budget` nodes, those inside of loops counted too.
    #[must_use]
    pub fn new(budget: usize) -> Self {
        Self {
            budget: budget.min(u32::MAX as usize),
            nodes: Vec::new(),
            depths: Vec::new(),
            known: HashMap::new(),
            loops: HashMap::new(),
            open: Vec::new(),
            arguments: 0,
        }
    }

    /// How many nodes have been made.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether none has.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The node of that place.
    pub(crate) fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// A number.
    ///
    /// # Errors
    /// [`GraphTooLarge`], as of all functions that make nodes.
    pub fn constant(&mut self, v: f64) -> Result<NodeId, GraphTooLarge> {
        self.share(Key::Constant(v.to_bits()), || Node::Constant(v))
    }

    /// The number, where the node is a constant.
    #[must_use]
    pub fn as_constant(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(v) => Some(*v),
            _ => None,
        }
    }

    /// Something about the hit.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn input(&mut self, input: Input) -> Result<NodeId, GraphTooLarge> {
        self.share(Key::Input(input), || Node::Input(input))
    }

    /// A function of one number.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn unary(&mut self, f: Unary, a: NodeId) -> Result<NodeId, GraphTooLarge> {
        if let Some(a) = self.as_constant(a) {
            return self.constant(f.apply(a));
        }
        self.share(Key::Unary(f, a), || Node::Unary(f, a))
    }

    /// A function of two numbers.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn binary(&mut self, f: Binary, a: NodeId, b: NodeId) -> Result<NodeId, GraphTooLarge> {
        if let (Some(a), Some(b)) = (self.as_constant(a), self.as_constant(b)) {
            return self.constant(f.apply(a, b));
        }
        self.share(Key::Binary(f, a, b), || Node::Binary(f, a, b))
    }

    /// `then` where `condition` is true (not 0), else `otherwise`. Both are computed at every point, unless the
    /// condition is constant.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn select(
        &mut self,
        condition: NodeId,
        then: NodeId,
        otherwise: NodeId,
    ) -> Result<NodeId, GraphTooLarge> {
        if then == otherwise {
            return Ok(then);
        }
        if let Some(condition) = self.as_constant(condition) {
            return Ok(if condition == 0.0 { otherwise } else { then });
        }
        self.share(Key::Select(condition, then, otherwise), || Node::Select(condition, then, otherwise))
    }

    /// Noise at a point, given in cells.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn noise(&mut self, kind: NoiseKind, seed: u64, p: [NodeId; 3]) -> Result<NodeId, GraphTooLarge> {
        self.share(Key::Noise(kind, seed, p), || Node::Noise(kind, seed, p))
    }

    /// A computation with several results: one node for each. Loops are better made with
    /// [`Builder::begin_loop`].
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn block(&mut self, block: Block, arguments: &[NodeId]) -> Result<Vec<NodeId>, GraphTooLarge> {
        let results = block.results();
        let arguments: Box<[NodeId]> = arguments.into();
        let id = match &block {
            Block::Cells { seed } => {
                let key = Key::Cells(*seed, arguments.clone());
                self.share(key, || Node::Block(block, arguments))?
            }
            Block::Image(image) => {
                let key = Key::Image(Arc::as_ptr(image) as usize, arguments.clone());
                self.share(key, || Node::Block(block, arguments))?
            }
            Block::Loop(_) => self.share_loop(block, arguments)?,
        };
        (0..results).map(|i| self.result(id, i)).collect()
    }

    fn share_loop(&mut self, block: Block, arguments: Box<[NodeId]>) -> Result<NodeId, GraphTooLarge> {
        let known = self.loops.get(&arguments).into_iter().flatten();
        let same = |id: &&NodeId| matches!(self.node(**id), Node::Block(other, _) if *other == block);
        if let Some(&id) = known.clone().find(same) {
            return Ok(id);
        }
        let id = self.push(Node::Block(block, arguments.clone()))?;
        self.loops.entry(arguments).or_default().push(id);
        Ok(id)
    }

    fn result(&mut self, block: NodeId, index: usize) -> Result<NodeId, GraphTooLarge> {
        let Ok(index) = u8::try_from(index) else { return Err(self.too_large()) };
        self.share(Key::Result(block, index), || Node::Result(block, index))
    }

    /// Begins a loop with `state` numbers of state, at most 256: gives the nodes that stand for them in its body.
    ///
    /// # Errors
    /// [`GraphTooLarge`]; then the loop has not begun.
    pub fn begin_loop(&mut self, state: usize) -> Result<Vec<NodeId>, GraphTooLarge> {
        let fits = self.nodes.len().saturating_add(state) <= self.budget;
        if self.open.len() >= MAX_NESTING || state > 256 || !fits {
            return Err(self.too_large());
        }
        self.open.push(OpenLoop { start: self.nodes.len(), state });
        let depth = self.open.len() as u8;
        let arguments = (0..state).map(|_| {
            let id = NodeId(self.nodes.len() as u32);
            self.nodes.push(Node::Argument(self.arguments));
            self.depths.push(depth);
            self.arguments += 1;
            id
        });
        Ok(arguments.collect())
    }

    /// Ends the innermost loop, and gives its results: the state, replaced by `step` until it has been `max` times
    /// or `until` is true (not 0).
    ///
    /// What `until` and `step` need and depends on the state is done at every step; everything else is done once,
    /// before the loop. The nodes of the state and what depends on them must not be used any more.
    ///
    /// # Errors
    /// [`GraphTooLarge`]; the loop has ended all the same.
    pub fn end_loop(
        &mut self,
        max: u32,
        initial: &[NodeId],
        until: NodeId,
        step: &[NodeId],
    ) -> Result<Vec<NodeId>, GraphTooLarge> {
        let depth = self.open.len() as u8;
        let Some(open) = self.open.pop() else { return Ok(initial.to_vec()) };
        if max == 0 {
            return Ok(initial.to_vec());
        }
        let mut body = Body { builder: self, open: &open, depth, nodes: Vec::new(), captured: Vec::new() };
        let places = body.collect(until, step);
        let (nodes, captured) = (body.nodes, body.captured);
        let place = |id: &NodeId| places.get(id).copied().unwrap_or(NodeId(0));
        let body = Loop {
            state: open.state,
            captured: captured.len(),
            max,
            nodes,
            until: place(&until),
            step: step.iter().map(place).collect(),
        };
        let arguments: Vec<NodeId> = initial.iter().copied().chain(captured).collect();
        self.block(Block::Loop(Arc::new(body)), &arguments)
    }

    /// Ends the innermost loop without making it, after an error.
    pub fn cancel_loop(&mut self) {
        self.open.pop();
    }

    /// The function with these results. Nodes that they do not need are left out.
    #[must_use]
    pub fn finish(self, outputs: &[NodeId]) -> Function {
        let mut needed = vec![false; self.nodes.len()];
        for output in outputs {
            needed[output.index()] = true;
        }
        for (i, node) in self.nodes.iter().enumerate().rev() {
            if needed[i] {
                node.for_each_operand(|a| needed[a.index()] = true);
            }
        }
        let mut places = vec![NodeId(0); self.nodes.len()];
        let mut nodes = Vec::new();
        for (i, node) in self.nodes.iter().enumerate().filter(|(i, _)| needed[*i]) {
            places[i] = NodeId(nodes.len() as u32);
            nodes.push(node.map_operands(|a| places[a.index()]));
        }
        Function::new(nodes, outputs.iter().map(|id| places[id.index()]).collect())
    }

    const fn too_large(&self) -> GraphTooLarge {
        GraphTooLarge { budget: self.budget }
    }

    fn share(&mut self, key: Key, node: impl FnOnce() -> Node) -> Result<NodeId, GraphTooLarge> {
        if let Some(&id) = self.known.get(&key) {
            return Ok(id);
        }
        let id = self.push(node())?;
        self.known.insert(key, id);
        Ok(id)
    }

    fn push(&mut self, node: Node) -> Result<NodeId, GraphTooLarge> {
        if self.nodes.len() >= self.budget {
            return Err(self.too_large());
        }
        let mut depth = 0;
        node.for_each_operand(|a| depth = depth.max(self.depths[a.index()]));
        let id = NodeId(self.nodes.len() as u32);
        self.nodes.push(node);
        self.depths.push(depth);
        Ok(id)
    }
}

/// The body of a loop on its way out of the builder.
struct Body<'a> {
    builder: &'a Builder,
    open: &'a OpenLoop,
    depth: u8,
    nodes: Vec<Node>,
    /// What the body uses of the outside.
    captured: Vec<NodeId>,
}

impl Body<'_> {
    /// Moves what `until` and `step` need into the body, and says where it is there.
    fn collect(&mut self, until: NodeId, step: &[NodeId]) -> HashMap<NodeId, NodeId> {
        let start = self.open.start;
        let mut needed = vec![false; self.builder.nodes.len() - start];
        let roots = || std::iter::once(&until).chain(step);
        for root in roots().filter(|id| self.inside(**id)) {
            needed[root.index() - start] = true;
        }
        for i in (0..needed.len()).rev().filter(|&i| self.builder.depths[start + i] == self.depth) {
            if needed[i] {
                self.builder.nodes[start + i].for_each_operand(|a| {
                    if self.inside(a) {
                        needed[a.index() - start] = true;
                    }
                });
            }
        }
        let mut places = HashMap::new();
        for i in (0..needed.len()).filter(|&i| needed[i]) {
            let id = NodeId((start + i) as u32);
            let node = self.builder.node(id);
            node.for_each_operand(|a| {
                if !self.inside(a) {
                    self.place_outside(a, &mut places);
                }
            });
            // Its own arguments are the first nodes of a loop.
            let node = match node {
                Node::Argument(_) => Node::Argument(i as u32),
                node => node.map_operands(|a| places.get(&a).copied().unwrap_or(NodeId(0))),
            };
            self.place(id, node, &mut places);
        }
        for root in roots() {
            if !self.inside(*root) {
                self.place_outside(*root, &mut places);
            }
        }
        places
    }

    /// Whether a node changes from step to step.
    fn inside(&self, id: NodeId) -> bool {
        id.index() >= self.open.start && self.builder.depths[id.index()] == self.depth
    }

    /// Constants and inputs are taken along, everything else is captured.
    fn place_outside(&mut self, id: NodeId, places: &mut HashMap<NodeId, NodeId>) {
        if places.contains_key(&id) {
            return;
        }
        let node = match self.builder.node(id) {
            node @ (Node::Constant(_) | Node::Input(_)) => node.clone(),
            _ => {
                self.captured.push(id);
                Node::Argument((self.open.state + self.captured.len() - 1) as u32)
            }
        };
        self.place(id, node, places);
    }

    fn place(&mut self, id: NodeId, node: Node, places: &mut HashMap<NodeId, NodeId>) {
        places.insert(id, NodeId(self.nodes.len() as u32));
        self.nodes.push(node);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NoiseTables;

    #[test]
    fn constants_fold_and_equal_nodes_are_one() {
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let one = b.constant(1.0).unwrap();
        let two = b.binary(Binary::Add, one, one).unwrap();
        assert_eq!(b.as_constant(two), Some(2.0));
        assert_eq!(b.binary(Binary::Mul, x, two), b.binary(Binary::Mul, x, two));
        assert_ne!(b.constant(0.0), b.constant(-0.0));
        assert_eq!(b.constant(f64::NAN), b.constant(f64::NAN));
        let len = b.len();
        assert_eq!(b.select(one, x, two), Ok(x));
        assert_eq!(b.select(x, two, two), Ok(two));
        assert_eq!(b.len(), len);
    }

    #[test]
    fn nothing_is_rewritten_that_could_change_a_bit() {
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let zero = b.constant(0.0).unwrap();
        let product = b.binary(Binary::Mul, x, zero).unwrap();
        let sum = b.binary(Binary::Add, product, zero).unwrap();
        let f = b.finish(&[product, sum]);
        let at = |x: f64| {
            let mut inputs = [0.0; Input::COUNT];
            inputs[Input::Px as usize] = x;
            f.evaluate(&NoiseTables::default(), &inputs)
        };
        assert!(at(-1.0)[0].is_sign_negative() && at(-1.0)[1].is_sign_positive());
        assert!(at(f64::INFINITY)[0].is_nan());
    }

    #[test]
    fn what_no_output_needs_is_gone() {
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let y = b.input(Input::Py).unwrap();
        b.unary(Unary::Sin, y).unwrap();
        let z = b.unary(Unary::Cos, x).unwrap();
        let f = b.finish(&[z, z]);
        assert_eq!(f.nodes().len(), 2);
        assert_eq!(f.inputs_used().collect::<Vec<_>>(), [Input::Px]);
        assert_eq!(f.outputs(), [NodeId(1), NodeId(1)]);
        assert_eq!(f.cost(), 2);
    }

    #[test]
    fn the_budget_is_kept() {
        let mut b = Builder::new(2);
        let x = b.input(Input::Px).unwrap();
        let y = b.unary(Unary::Sin, x).unwrap();
        assert_eq!(b.unary(Unary::Sin, x), Ok(y));
        assert_eq!(b.unary(Unary::Sin, y), Err(GraphTooLarge { budget: 2 }));
        assert_eq!(b.begin_loop(1), Err(GraphTooLarge { budget: 2 }));
        let mut b = Builder::new(1000);
        for _ in 0..MAX_NESTING {
            b.begin_loop(1).unwrap();
        }
        assert!(b.begin_loop(1).is_err());
    }

    /// The sum of i j over i < 4, j < x: loops in a loop, with captures from every level.
    #[test]
    fn loops_nest_and_hoist() {
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let zero = b.constant(0.0).unwrap();
        let one = b.constant(1.0).unwrap();
        let four = b.constant(4.0).unwrap();
        let outer = b.begin_loop(2).unwrap();
        let hoisted = b.unary(Unary::Floor, x).unwrap();
        let inner = b.begin_loop(2).unwrap();
        let product = b.binary(Binary::Mul, outer[0], inner[0]).unwrap();
        let sum = b.binary(Binary::Add, inner[1], product).unwrap();
        let next = b.binary(Binary::Add, inner[0], one).unwrap();
        let done = b.binary(Binary::LessEqual, hoisted, inner[0]).unwrap();
        let inner = b.end_loop(100, &[zero, outer[1]], done, &[next, sum]).unwrap();
        let next = b.binary(Binary::Add, outer[0], one).unwrap();
        let done = b.binary(Binary::Equal, outer[0], four).unwrap();
        let outer = b.end_loop(50, &[zero, zero], done, &[next, inner[1]]).unwrap();
        let f = b.finish(&outer);
        let mut inputs = [0.0; Input::COUNT];
        inputs[Input::Px as usize] = 3.5;
        assert_eq!(f.evaluate(&NoiseTables::default(), &inputs), [4.0, (1.0 + 2.0 + 3.0) * 3.0]);
        let floors = |nodes: &[Node]| nodes.iter().filter(|n| matches!(n, Node::Unary(..))).count();
        assert_eq!(floors(f.nodes()), 1, "what does not change is outside");
    }

    #[test]
    fn a_loop_ends_after_its_most_steps_and_may_swap() {
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let y = b.input(Input::Py).unwrap();
        let never = b.constant(0.0).unwrap();
        let state = b.begin_loop(2).unwrap();
        let swapped = b.end_loop(3, &[x, y], never, &[state[1], state[0]]).unwrap();
        let f = b.finish(&swapped);
        let mut inputs = [0.0; Input::COUNT];
        (inputs[0], inputs[1]) = (1.0, 2.0);
        assert_eq!(f.evaluate(&NoiseTables::default(), &inputs), [2.0, 1.0]);
    }
}
