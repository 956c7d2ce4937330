//! Building a graph, sharing what is the same and folding what is constant.

use crate::{Binary, Block, Function, Input, Loop, Node, NodeId, NoiseKind, Unary};
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

/// A graph has more nodes than it may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GraphTooLarge {
    /// The most nodes.
    pub budget: usize,
}

impl fmt::Display for GraphTooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the function takes more than {} operations", self.budget)
    }
}

impl std::error::Error for GraphTooLarge {}

/// Why something has no derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DerivativeError {
    /// It would take too many nodes.
    TooLarge(GraphTooLarge),
    /// It is the result of a loop.
    Loop,
}

impl From<GraphTooLarge> for DerivativeError {
    fn from(error: GraphTooLarge) -> Self {
        Self::TooLarge(error)
    }
}

impl fmt::Display for DerivativeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge(error) => error.fmt(f),
            Self::Loop => f.write_str("the result of a loop has no known derivative"),
        }
    }
}

impl std::error::Error for DerivativeError {}

/// What makes two nodes the same.
#[derive(Clone, PartialEq, Eq, Hash)]
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

/// A graph that is being built. Equal nodes are one; what is made of constants is a constant. Nothing else is rewritten, so
/// that a graph computes the bits that its expression says.
#[derive(Debug)]
pub struct Builder {
    nodes: Vec<Node>,
    /// How many loops a node is inside of: 0 outside, 1 where it depends on the outermost loop's arguments, and so on.
    levels: Vec<u32>,
    known: HashMap<Key, NodeId>,
    budget: usize,
    /// The open loops' first arguments, and how many each has.
    loops: Vec<(u32, usize)>,
    /// Arguments made so far, so that each is another.
    arguments: u32,
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Key")
    }
}

type Made = Result<NodeId, GraphTooLarge>;

impl Builder {
    /// A graph of at most `budget` nodes.
    #[must_use]
    pub fn new(budget: usize) -> Self {
        Self {
            nodes: Vec::new(),
            levels: Vec::new(),
            known: HashMap::new(),
            budget: budget.min(u32::MAX as usize),
            loops: Vec::new(),
            arguments: 0,
        }
    }

    /// How many nodes there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    fn push(&mut self, node: Node, level: u32) -> Made {
        if self.nodes.len() >= self.budget {
            return Err(GraphTooLarge { budget: self.budget });
        }
        self.nodes.push(node);
        self.levels.push(level);
        Ok(NodeId(self.nodes.len() as u32 - 1))
    }

    fn level(&self, of: &[NodeId]) -> u32 {
        of.iter().filter_map(|id| self.levels.get(id.0 as usize)).copied().max().unwrap_or(0)
    }

    fn shared(&mut self, key: Key, node: Node, of: &[NodeId]) -> Made {
        if let Some(id) = self.known.get(&key) {
            return Ok(*id);
        }
        let id = self.push(node, self.level(of))?;
        self.known.insert(key, id);
        Ok(id)
    }

    /// A constant.
    ///
    /// # Errors
    /// [`GraphTooLarge`], as all that follow.
    pub fn constant(&mut self, value: f64) -> Made {
        self.shared(Key::Constant(value.to_bits()), Node::Constant(value), &[])
    }

    /// The value of a node, where it is a constant.
    #[must_use]
    pub fn as_constant(&self, id: NodeId) -> Option<f64> {
        match self.nodes.get(id.0 as usize) {
            Some(Node::Constant(value)) => Some(*value),
            _ => None,
        }
    }

    /// Something about the hit.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn input(&mut self, input: Input) -> Made {
        self.shared(Key::Input(input), Node::Input(input), &[])
    }

    /// A function of one number.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn unary(&mut self, f: Unary, a: NodeId) -> Made {
        match self.as_constant(a) {
            Some(a) => self.constant(f.apply(a)),
            None => self.shared(Key::Unary(f, a), Node::Unary(f, a), &[a]),
        }
    }

    /// A function of two numbers.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn binary(&mut self, f: Binary, a: NodeId, b: NodeId) -> Made {
        match (self.as_constant(a), self.as_constant(b)) {
            (Some(a), Some(b)) => self.constant(f.apply(a, b)),
            _ => self.shared(Key::Binary(f, a, b), Node::Binary(f, a, b), &[a, b]),
        }
    }

    /// The second where the first is true (not 0), else the third.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn select(&mut self, condition: NodeId, then: NodeId, otherwise: NodeId) -> Made {
        if then == otherwise {
            return Ok(then);
        }
        match self.as_constant(condition) {
            Some(condition) => Ok(if condition != 0.0 { then } else { otherwise }),
            None => {
                let of = [condition, then, otherwise];
                self.shared(
                    Key::Select(condition, then, otherwise),
                    Node::Select(condition, then, otherwise),
                    &of,
                )
            }
        }
    }

    /// Noise at a point.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn noise(&mut self, kind: NoiseKind, seed: u64, p: [NodeId; 3]) -> Made {
        self.shared(Key::Noise(kind, seed, p), Node::Noise(kind, seed, p), &p)
    }

    /// A computation with several results: one node for each.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn block(&mut self, block: Block, arguments: &[NodeId]) -> Result<Vec<NodeId>, GraphTooLarge> {
        let results = block.results();
        let key = match &block {
            Block::Cells { seed } => Some(Key::Cells(*seed, arguments.into())),
            Block::Image(image) => Some(Key::Image(Arc::as_ptr(image) as usize, arguments.into())),
            Block::Loop(_) => None,
        };
        let node = Node::Block(block, arguments.into());
        let id = match key {
            Some(key) => self.shared(key, node, arguments)?,
            None => self.push(node, self.level(arguments))?,
        };
        (0..results)
            .map(|i| self.shared(Key::Result(id, i as u8), Node::Result(id, i as u8), &[id]))
            .collect()
    }

    /// Begins the body of a loop over a state of that many numbers: the nodes that stand for it.
    ///
    /// # Errors
    /// [`GraphTooLarge`].
    pub fn begin_loop(&mut self, state: usize) -> Result<Vec<NodeId>, GraphTooLarge> {
        let level = self.loops.len() as u32 + 1;
        let first = self.arguments;
        let arguments: Result<Vec<NodeId>, _> = (0..state)
            .map(|_| {
                self.arguments += 1;
                self.push(Node::Argument(self.arguments - 1), level)
            })
            .collect();
        let arguments = arguments?;
        self.loops.push((first, state));
        Ok(arguments)
    }

    /// Gives up the innermost loop.
    pub fn cancel_loop(&mut self) {
        self.loops.pop();
    }

    /// Ends the body of the innermost loop: at most `max` times, until `until` is true, the state becomes `step`. The nodes
    /// that stand for the state after it. What does not depend on the loop's state is computed once, before it.
    ///
    /// # Errors
    /// [`GraphTooLarge`]; the loop is given up then.
    pub fn end_loop(
        &mut self,
        max: u32,
        initial: &[NodeId],
        until: NodeId,
        step: &[NodeId],
    ) -> Result<Vec<NodeId>, GraphTooLarge> {
        let level = self.loops.len() as u32;
        let Some((first, state)) = self.loops.pop() else { return Ok(initial.to_vec()) };
        // What the body needs, in the order in which it was made.
        let mut needed: Vec<u32> = Vec::new();
        let mut seen = vec![false; self.nodes.len()];
        let mut work: Vec<NodeId> = step.iter().copied().chain([until]).collect();
        while let Some(id) = work.pop() {
            let place = id.0 as usize;
            if seen.get(place).copied().unwrap_or(true) {
                continue;
            }
            seen[place] = true;
            needed.push(id.0);
            if self.levels[place] >= level {
                work.extend(self.nodes[place].arguments());
            }
        }
        needed.sort_unstable();
        let mut places: HashMap<NodeId, NodeId> = HashMap::new();
        let (mut nodes, mut captured) = (Vec::new(), Vec::new());
        for id in needed {
            let (node, outside) = (&self.nodes[id as usize], self.levels[id as usize] < level);
            let node = match node {
                Node::Constant(_) | Node::Input(_) => node.clone(),
                _ if outside => {
                    captured.push(NodeId(id));
                    Node::Argument((state + captured.len() - 1) as u32)
                }
                Node::Argument(argument) => Node::Argument(argument - first),
                node => node.map(|argument| places.get(&argument).copied().unwrap_or(argument)),
            };
            nodes.push(node);
            places.insert(NodeId(id), NodeId(nodes.len() as u32 - 1));
        }
        let place = |id: &NodeId| places.get(id).copied().unwrap_or(*id);
        let body = Loop {
            state,
            captured: captured.len(),
            max,
            until: place(&until),
            step: step.iter().map(place).collect(),
            nodes,
        };
        let arguments: Vec<NodeId> = initial.iter().copied().chain(captured).collect();
        self.block(Block::Loop(Arc::new(body)), &arguments)
    }

    /// The function whose results are `outputs`; what they do not need is left out.
    #[must_use]
    pub fn finish(self, outputs: &[NodeId]) -> Function {
        let mut needed = vec![false; self.nodes.len()];
        let mut work: Vec<NodeId> = outputs.to_vec();
        while let Some(id) = work.pop() {
            if let Some(slot) = needed.get_mut(id.0 as usize)
                && !std::mem::replace(slot, true)
            {
                work.extend(self.nodes[id.0 as usize].arguments());
            }
        }
        let mut places = vec![NodeId(0); self.nodes.len()];
        let mut nodes = Vec::new();
        for (id, node) in self.nodes.into_iter().enumerate() {
            if needed[id] {
                let node = node.map(|argument| places.get(argument.0 as usize).copied().unwrap_or(argument));
                nodes.push(node);
                places[id] = NodeId(nodes.len() as u32 - 1);
            }
        }
        let outputs = outputs.iter().map(|id| places.get(id.0 as usize).copied().unwrap_or(*id)).collect();
        Function::new(nodes, outputs)
    }
}

impl Node {
    /// The nodes it is made of.
    #[must_use]
    pub fn arguments(&self) -> Vec<NodeId> {
        match self {
            Self::Constant(_) | Self::Input(_) | Self::Argument(_) => Vec::new(),
            Self::Unary(_, a) | Self::Result(a, _) => vec![*a],
            Self::Binary(_, a, b) => vec![*a, *b],
            Self::Select(a, b, c) => vec![*a, *b, *c],
            Self::Noise(_, _, p) => p.to_vec(),
            Self::Block(_, arguments) => arguments.to_vec(),
        }
    }

    /// The same of other nodes.
    #[must_use]
    pub fn map(&self, to: impl Fn(NodeId) -> NodeId) -> Self {
        match self {
            Self::Constant(_) | Self::Input(_) | Self::Argument(_) => self.clone(),
            Self::Unary(f, a) => Self::Unary(*f, to(*a)),
            Self::Result(a, i) => Self::Result(to(*a), *i),
            Self::Binary(f, a, b) => Self::Binary(*f, to(*a), to(*b)),
            Self::Select(a, b, c) => Self::Select(to(*a), to(*b), to(*c)),
            Self::Noise(kind, seed, p) => Self::Noise(*kind, *seed, p.map(to)),
            Self::Block(block, arguments) => {
                Self::Block(block.clone(), arguments.iter().map(|a| to(*a)).collect())
            }
        }
    }
}

impl Builder {
    pub(crate) fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.0 as usize]
    }
}
