//! Expression graphs: functions of a hit, as data.

use crate::Image;
use std::sync::Arc;

/// What a function may ask of the point it is evaluated at, one number each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum Input {
    /// Position in object space (of the shape's own coordinates, before any transform), x.
    Px,
    /// Position in object space, y.
    Py,
    /// Position in object space, z.
    Pz,
    /// Position in world space, x.
    Wx,
    /// Position in world space, y.
    Wy,
    /// Position in world space, z.
    Wz,
    /// Unit outward geometric normal in world space, x.
    Nx,
    /// Unit outward geometric normal in world space, y.
    Ny,
    /// Unit outward geometric normal in world space, z.
    Nz,
    /// First surface parameter.
    U,
    /// Second surface parameter.
    V,
    /// Time in seconds.
    Time,
}

impl Input {
    /// How many inputs there are.
    pub const COUNT: usize = 12;

    /// All of them, in the order of their numbers.
    pub const ALL: [Self; Self::COUNT] = [
        Self::Px,
        Self::Py,
        Self::Pz,
        Self::Wx,
        Self::Wy,
        Self::Wz,
        Self::Nx,
        Self::Ny,
        Self::Nz,
        Self::U,
        Self::V,
        Self::Time,
    ];
}

/// A number that is computed, by its place in a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(pub u32);

impl NodeId {
    /// As an index.
    pub(crate) const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Functions of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// -a
    Neg,
    /// |a|
    Abs,
    /// The largest whole number that is not above a.
    Floor,
    /// The smallest whole number that is not below a.
    Ceil,
    /// The nearest whole number, halves away from zero.
    Round,
    /// The square root; NaN below 0.
    Sqrt,
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// Tangent of an angle in radians.
    Tan,
    /// Inverse sine, in radians.
    Asin,
    /// Inverse cosine, in radians.
    Acos,
    /// Inverse tangent, in radians.
    Atan,
    /// e to the power of a.
    Exp,
    /// Natural logarithm.
    Ln,
    /// 1 where a is 0 (false), else 0.
    Not,
}

/// Functions of two numbers. Comparisons and the logical connectives give 1 for true and 0 for false.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// a + b
    Add,
    /// a - b
    Sub,
    /// a b
    Mul,
    /// a / b
    Div,
    /// a - b floor(a / b): the remainder that has the sign of b.
    Modulo,
    /// a where a < b, else b.
    Min,
    /// a where a > b, else b.
    Max,
    /// a to the power of b, as `libm::pow` has it.
    Pow,
    /// The angle of the point (x = b, y = a), in radians.
    Atan2,
    /// a < b
    Less,
    /// a <= b
    LessEqual,
    /// a = b
    Equal,
    /// Both a and b are true.
    And,
    /// a or b is true.
    Or,
    /// A number in [0, 1) that depends on a (the seed) and b (the index) alone and looks random:
    /// [`crate::random`].
    Random,
}

/// A family of noise: smooth random functions of a point, about in [-1, 1], 0 at whole coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NoiseKind {
    /// K. Perlin, "Improving Noise", SIGGRAPH 2002 (thesis, reference 21). Seed 0 is the published permutation; any
    /// other shuffles it.
    Improved,
    /// K. Perlin, "An Image Synthesizer", SIGGRAPH 1985, with the tables that the render is given. Seeds 0, 1
    /// and 2 are the three permutations loaded; any other shuffles the first.
    Classic,
}

/// A computation with several results.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Worley's cellular texture of a point (S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996),
    /// one feature point a unit cell. Arguments: x, y, z. Results: distance to the nearest feature point,
    /// distance to the second nearest, a number in [0, 1) that belongs to the nearest, and the vector (x, y, z)
    /// from the point to the nearest.
    Cells {
        /// Selects the feature points.
        seed: u64,
    },
    /// An image, bilinear between the centres of its pixels and repeated in both directions. Arguments: u from
    /// the left, v from the bottom, both in [0, 1] over the image. Results: red, green, blue (linear) and alpha.
    Image(Arc<Image>),
    /// Steps a state. Arguments: the initial state, then `captured` numbers that the steps may use. Results: the
    /// state after the loop.
    Loop(Arc<Loop>),
}

impl Block {
    /// How many results it has.
    #[must_use]
    pub fn results(&self) -> usize {
        match self {
            Self::Cells { .. } => 6,
            Self::Image(_) => 4,
            Self::Loop(body) => body.state,
        }
    }
}

/// The body of a loop: while it has been done fewer than `max` times and `until` of the state is false, the state
/// is replaced by its step.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// Numbers in the state.
    pub state: usize,
    /// Numbers captured from outside.
    pub captured: usize,
    /// The most steps.
    pub max: u32,
    /// The nodes of the body. Its leaves are constants, inputs and [`Node::Argument`]s: first the state, then
    /// what is captured.
    pub nodes: Vec<Node>,
    /// Whether to stop, in `nodes`.
    pub until: NodeId,
    /// The next state, in `nodes`.
    pub step: Vec<NodeId>,
}

/// One step of a computation. Arguments come before what is made of them.
#[derive(Clone, Debug)]
pub enum Node {
    /// A number, compared and shared by its bits.
    Constant(f64),
    /// Something about the hit.
    Input(Input),
    /// Inside a loop body: state or captured number of that index.
    Argument(u32),
    /// A function of one number.
    Unary(Unary, NodeId),
    /// A function of two numbers.
    Binary(Binary, NodeId, NodeId),
    /// The second where the first is true (not 0), else the third. Both are computed, also all the way down a
    /// chain of selections: what a branch costs is paid at every point.
    Select(NodeId, NodeId, NodeId),
    /// Noise at a point.
    Noise(NoiseKind, u64, [NodeId; 3]),
    /// A computation with several results, which [`Node::Result`] picks.
    Block(Block, Box<[NodeId]>),
    /// One result of a block.
    Result(NodeId, u8),
}

impl Node {
    /// Hands out the nodes that this one is made of, in order.
    pub(crate) fn for_each_operand(&self, mut f: impl FnMut(NodeId)) {
        match self {
            Self::Constant(_) | Self::Input(_) | Self::Argument(_) => {}
            Self::Unary(_, a) | Self::Result(a, _) => f(*a),
            Self::Binary(_, a, b) => [*a, *b].into_iter().for_each(f),
            Self::Select(a, b, c) => [*a, *b, *c].into_iter().for_each(f),
            Self::Noise(_, _, p) => p.iter().copied().for_each(f),
            Self::Block(_, arguments) => arguments.iter().copied().for_each(f),
        }
    }

    /// The same node of other operands.
    pub(crate) fn map_operands(&self, mut f: impl FnMut(NodeId) -> NodeId) -> Self {
        let mut node = self.clone();
        match &mut node {
            Self::Constant(_) | Self::Input(_) | Self::Argument(_) => {}
            Self::Unary(_, a) | Self::Result(a, _) => *a = f(*a),
            Self::Binary(_, a, b) => (*a, *b) = (f(*a), f(*b)),
            Self::Select(a, b, c) => (*a, *b, *c) = (f(*a), f(*b), f(*c)),
            Self::Noise(_, _, p) => p.iter_mut().for_each(|a| *a = f(*a)),
            Self::Block(_, arguments) => arguments.iter_mut().for_each(|a| *a = f(*a)),
        }
        node
    }
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Constant(a), Self::Constant(b)) => a.to_bits() == b.to_bits(),
            (Self::Input(a), Self::Input(b)) => a == b,
            (Self::Argument(a), Self::Argument(b)) => a == b,
            (Self::Unary(f, a), Self::Unary(g, b)) => f == g && a == b,
            (Self::Binary(f, a, c), Self::Binary(g, b, d)) => f == g && a == b && c == d,
            (Self::Select(a, c, e), Self::Select(b, d, f)) => a == b && c == d && e == f,
            (Self::Noise(k, s, p), Self::Noise(l, t, q)) => k == l && s == t && p == q,
            (Self::Block(f, a), Self::Block(g, b)) => f == g && a == b,
            (Self::Result(a, i), Self::Result(b, j)) => a == b && i == j,
            _ => false,
        }
    }
}
