//! Derivatives of graphs, by the rules of calculus from the operands up.

use crate::{Binary, Block, Builder, GraphTooLarge, Input, Node, NodeId, NoiseKind, Unary};
use std::fmt;

/// Half the distance, in cells, between the two points that the slope of noise is taken from.
const STEP: f64 = 1.0 / 4096.0;

/// Why a function has no derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DerivativeError {
    /// The graph would become too large.
    TooLarge(GraphTooLarge),
    /// A loop depends on what the derivative is taken of, or a loop is not ended.
    Loop,
}

impl fmt::Display for DerivativeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge(error) => error.fmt(f),
            Self::Loop => write!(f, "a loop has no derivative"),
        }
    }
}

impl std::error::Error for DerivativeError {}

impl From<GraphTooLarge> for DerivativeError {
    fn from(error: GraphTooLarge) -> Self {
        Self::TooLarge(error)
    }
}

type Derivative = Result<Option<NodeId>, GraphTooLarge>;

impl Builder {
    /// The derivative of a node by an input.
    ///
    /// Where a function jumps (floor, comparisons, the branches of a selection) the slope beside the jump counts.
    /// Noise, cells and images take the difference of two values 2^-11 apart, in their own coordinates.
    ///
    /// # Errors
    /// [`DerivativeError`].
    pub fn derivative(&mut self, of: NodeId, with_respect_to: Input) -> Result<NodeId, DerivativeError> {
        // Which nodes are needed, then which of them depend on the input; operands come first.
        let mut needed = vec![false; of.index() + 1];
        needed[of.index()] = true;
        for i in (0..needed.len()).rev() {
            if needed[i] {
                self.node(NodeId(i as u32)).for_each_operand(|a| needed[a.index()] = true);
            }
        }
        let mut slopes: Vec<Option<NodeId>> = vec![None; needed.len()];
        // A block has no one slope; what matters is whether its arguments have any.
        let mut varies = vec![false; needed.len()];
        for i in (0..needed.len()).filter(|i| needed[*i]) {
            let id = NodeId(i as u32);
            let node = self.node(id).clone();
            let mut any = false;
            node.for_each_operand(|a| any |= varies[a.index()]);
            match &node {
                Node::Argument(_) => return Err(DerivativeError::Loop),
                Node::Input(input) if *input == with_respect_to => slopes[i] = Some(self.constant(1.0)?),
                Node::Block(Block::Loop(body), _) if any || mentions(&body.nodes, with_respect_to) => {
                    return Err(DerivativeError::Loop);
                }
                Node::Block(..) => varies[i] = any,
                _ if any => slopes[i] = self.slope(id, &node, &slopes)?,
                _ => {}
            }
            varies[i] |= slopes[i].is_some();
        }
        match slopes[of.index()] {
            Some(slope) => Ok(slope),
            None => Ok(self.constant(0.0)?),
        }
    }

    /// The slope of a node from those of its operands; none is 0.
    fn slope(&mut self, id: NodeId, node: &Node, slopes: &[Option<NodeId>]) -> Derivative {
        let of = |a: &NodeId| slopes[a.index()];
        match node {
            Node::Unary(f, a) => match of(a) {
                Some(slope) => self.unary_slope(*f, id, *a, slope),
                None => Ok(None),
            },
            Node::Binary(f, a, b) => self.binary_slope(*f, id, [*a, *b], [of(a), of(b)]),
            Node::Select(condition, a, b) => self.either(*condition, of(a), of(b)),
            Node::Noise(kind, seed, p) => self.noise_slope(*kind, *seed, *p, p.map(|a| of(&a))),
            Node::Result(block, index) => match self.node(*block).clone() {
                Node::Block(block, arguments) => {
                    let slopes: Vec<_> = arguments.iter().map(of).collect();
                    self.block_slope(&block, usize::from(*index), &arguments, &slopes)
                }
                _ => Ok(None),
            },
            _ => Ok(None),
        }
    }

    fn unary_slope(&mut self, f: Unary, value: NodeId, a: NodeId, slope: NodeId) -> Derivative {
        let one = self.constant(1.0)?;
        let result = match f {
            Unary::Neg => self.unary(Unary::Neg, slope)?,
            Unary::Abs => {
                let zero = self.constant(0.0)?;
                let above = self.binary(Binary::Less, zero, a)?;
                let below = self.binary(Binary::Less, a, zero)?;
                let negative = self.unary(Unary::Neg, slope)?;
                let not_above = self.select(below, negative, zero)?;
                self.select(above, slope, not_above)?
            }
            Unary::Floor | Unary::Ceil | Unary::Round | Unary::Not => return Ok(None),
            Unary::Sqrt => {
                let twice = self.binary(Binary::Add, value, value)?;
                self.binary(Binary::Div, slope, twice)?
            }
            Unary::Sin => {
                let cos = self.unary(Unary::Cos, a)?;
                self.binary(Binary::Mul, cos, slope)?
            }
            Unary::Cos => {
                let sin = self.unary(Unary::Sin, a)?;
                let negative = self.unary(Unary::Neg, sin)?;
                self.binary(Binary::Mul, negative, slope)?
            }
            Unary::Tan => {
                let square = self.binary(Binary::Mul, value, value)?;
                let factor = self.binary(Binary::Add, one, square)?;
                self.binary(Binary::Mul, factor, slope)?
            }
            Unary::Asin | Unary::Acos => {
                let square = self.binary(Binary::Mul, a, a)?;
                let rest = self.binary(Binary::Sub, one, square)?;
                let root = self.unary(Unary::Sqrt, rest)?;
                let root = if f == Unary::Asin { root } else { self.unary(Unary::Neg, root)? };
                self.binary(Binary::Div, slope, root)?
            }
            Unary::Atan => {
                let square = self.binary(Binary::Mul, a, a)?;
                let factor = self.binary(Binary::Add, one, square)?;
                self.binary(Binary::Div, slope, factor)?
            }
            Unary::Exp => self.binary(Binary::Mul, value, slope)?,
            Unary::Ln => self.binary(Binary::Div, slope, a)?,
        };
        Ok(Some(result))
    }

    fn binary_slope(
        &mut self,
        f: Binary,
        value: NodeId,
        [a, b]: [NodeId; 2],
        [da, db]: [Option<NodeId>; 2],
    ) -> Derivative {
        match f {
            Binary::Add => self.plus(da, db),
            Binary::Sub => self.minus(da, db),
            Binary::Mul => {
                let left = self.times(da, b)?;
                let right = self.times(db, a)?;
                self.plus(left, right)
            }
            Binary::Div => {
                let shrinking = self.times(db, value)?;
                let top = self.minus(da, shrinking)?;
                top.map(|top| self.binary(Binary::Div, top, b)).transpose()
            }
            Binary::Modulo => {
                let quotient = self.binary(Binary::Div, a, b)?;
                let whole = self.unary(Unary::Floor, quotient)?;
                let moved = self.times(db, whole)?;
                self.minus(da, moved)
            }
            Binary::Min => {
                let first = self.binary(Binary::Less, a, b)?;
                self.either(first, da, db)
            }
            Binary::Max => {
                let first = self.binary(Binary::Less, b, a)?;
                self.either(first, da, db)
            }
            Binary::Pow => self.power_slope(value, [a, b], [da, db]),
            Binary::Atan2 => {
                let left = self.times(da, b)?;
                let right = self.times(db, a)?;
                let top = self.minus(left, right)?;
                let aa = self.binary(Binary::Mul, a, a)?;
                let bb = self.binary(Binary::Mul, b, b)?;
                let squared = self.binary(Binary::Add, aa, bb)?;
                top.map(|top| self.binary(Binary::Div, top, squared)).transpose()
            }
            Binary::Less | Binary::LessEqual | Binary::Equal | Binary::And | Binary::Or | Binary::Random => {
                Ok(None)
            }
        }
    }

    /// b a^(b-1) a' + a^b ln a b'.
    fn power_slope(
        &mut self,
        value: NodeId,
        [a, b]: [NodeId; 2],
        [da, db]: [Option<NodeId>; 2],
    ) -> Derivative {
        let one = self.constant(1.0)?;
        let less = self.binary(Binary::Sub, b, one)?;
        let lower = self.binary(Binary::Pow, a, less)?;
        let factor = self.binary(Binary::Mul, b, lower)?;
        let base = self.times(da, factor)?;
        let exponent = match db {
            None => None,
            Some(db) => {
                let log = self.unary(Unary::Ln, a)?;
                let factor = self.binary(Binary::Mul, value, log)?;
                Some(self.binary(Binary::Mul, db, factor)?)
            }
        };
        self.plus(base, exponent)
    }

    fn noise_slope(
        &mut self,
        kind: NoiseKind,
        seed: u64,
        p: [NodeId; 3],
        slopes: [Option<NodeId>; 3],
    ) -> Derivative {
        self.difference(&p, &slopes, |builder, p| builder.noise(kind, seed, [p[0], p[1], p[2]]))
    }

    fn block_slope(
        &mut self,
        block: &Block,
        index: usize,
        arguments: &[NodeId],
        slopes: &[Option<NodeId>],
    ) -> Derivative {
        self.difference(arguments, slopes, |builder, p| Ok(builder.block(block.clone(), p)?[index]))
    }

    /// The slope of `f` at `p`, by central differences along the coordinates that have a slope themselves.
    fn difference(
        &mut self,
        p: &[NodeId],
        slopes: &[Option<NodeId>],
        f: impl Fn(&mut Self, &[NodeId]) -> Result<NodeId, GraphTooLarge>,
    ) -> Derivative {
        let mut sum = None;
        for (i, slope) in slopes.iter().enumerate().filter(|(_, slope)| slope.is_some()) {
            let mut at = |offset: f64| {
                let offset = self.constant(offset)?;
                let mut moved = p.to_vec();
                moved[i] = self.binary(Binary::Add, p[i], offset)?;
                f(self, &moved)
            };
            let (ahead, behind) = (at(STEP)?, at(-STEP)?);
            let rise = self.binary(Binary::Sub, ahead, behind)?;
            let per_cell = self.constant(0.5 / STEP)?;
            let steep = self.binary(Binary::Mul, rise, per_cell)?;
            let term = self.times(*slope, steep)?;
            sum = self.plus(sum, term)?;
        }
        Ok(sum)
    }

    fn either(&mut self, condition: NodeId, a: Option<NodeId>, b: Option<NodeId>) -> Derivative {
        if a.is_none() && b.is_none() {
            return Ok(None);
        }
        let zero = self.constant(0.0)?;
        Ok(Some(self.select(condition, a.unwrap_or(zero), b.unwrap_or(zero))?))
    }

    fn plus(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Derivative {
        match (a, b) {
            (Some(a), Some(b)) => Ok(Some(self.binary(Binary::Add, a, b)?)),
            (one, None) | (None, one) => Ok(one),
        }
    }

    fn minus(&mut self, a: Option<NodeId>, b: Option<NodeId>) -> Derivative {
        match (a, b) {
            (Some(a), Some(b)) => Ok(Some(self.binary(Binary::Sub, a, b)?)),
            (None, Some(b)) => Ok(Some(self.unary(Unary::Neg, b)?)),
            (a, None) => Ok(a),
        }
    }

    /// A slope times a factor.
    fn times(&mut self, slope: Option<NodeId>, factor: NodeId) -> Derivative {
        match slope {
            None => Ok(None),
            Some(slope) if self.as_constant(slope) == Some(1.0) => Ok(Some(factor)),
            Some(slope) => Ok(Some(self.binary(Binary::Mul, slope, factor)?)),
        }
    }
}

/// Whether a body asks for an input.
fn mentions(nodes: &[Node], input: Input) -> bool {
    nodes.iter().any(|node| match node {
        Node::Input(other) => *other == input,
        Node::Block(Block::Loop(body), _) => mentions(&body.nodes, input),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NoiseTables;

    fn at(x: f64) -> [f64; Input::COUNT] {
        let mut inputs = [0.3; Input::COUNT];
        inputs[Input::Px as usize] = x;
        inputs
    }

    /// Compares the derivative by x with a difference of the function itself.
    fn check(make: impl Fn(&mut Builder, NodeId, NodeId) -> NodeId, points: &[f64]) {
        let mut b = Builder::new(10_000);
        let x = b.input(Input::Px).unwrap();
        let y = b.input(Input::Py).unwrap();
        let f = make(&mut b, x, y);
        let slope = b.derivative(f, Input::Px).unwrap();
        let f = b.finish(&[f, slope]);
        let tables = NoiseTables::default();
        for &x in points {
            let h = 1e-6;
            let value = |x| f.evaluate(&tables, &at(x))[0];
            let expected = (value(x + h) - value(x - h)) / (2.0 * h);
            let slope = f.evaluate(&tables, &at(x))[1];
            assert!((slope - expected).abs() < 1e-4 * (1.0 + expected.abs()), "{x}: {slope} for {expected}");
        }
    }

    #[test]
    fn slopes_of_functions_of_one_number() {
        use Unary::{Abs, Acos, Asin, Atan, Ceil, Cos, Exp, Floor, Ln, Neg, Not, Round, Sin, Sqrt, Tan};
        for f in [Neg, Abs, Floor, Ceil, Round, Sqrt, Sin, Cos, Tan, Asin, Acos, Atan, Exp, Ln, Not] {
            check(|b, x, _| b.unary(f, x).unwrap(), &[0.2, 0.7]);
            check(
                |b, x, y| {
                    let squared = b.binary(Binary::Mul, x, x).unwrap();
                    let inner = b.binary(Binary::Mul, squared, y).unwrap();
                    b.unary(f, inner).unwrap()
                },
                &[0.6, 1.1, -1.3],
            );
        }
        check(|b, x, _| b.unary(Unary::Abs, x).unwrap(), &[-2.0, 3.0]);
    }

    #[test]
    fn slopes_of_functions_of_two_numbers() {
        use Binary::{
            Add, And, Atan2, Div, Equal, Less, LessEqual, Max, Min, Modulo, Mul, Or, Pow, Random, Sub,
        };
        for f in [Add, Sub, Mul, Div, Modulo, Min, Max, Pow, Atan2, Less, LessEqual, Equal, And, Or] {
            check(|b, x, y| b.binary(f, x, y).unwrap(), &[0.7, 1.7]);
            check(|b, x, y| b.binary(f, y, x).unwrap(), &[0.7, 1.7]);
            check(
                |b, x, y| {
                    let sin = b.unary(Unary::Sin, x).unwrap();
                    let sum = b.binary(Add, sin, y).unwrap();
                    b.binary(f, sum, x).unwrap()
                },
                &[0.7, 1.6],
            );
        }
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let f = b.binary(Random, x, x).unwrap();
        let slope = b.derivative(f, Input::Px).unwrap();
        assert_eq!(b.as_constant(slope), Some(0.0));
    }

    #[test]
    fn slopes_of_noise_cells_and_selections() {
        for kind in [NoiseKind::Improved, NoiseKind::Classic] {
            check(
                |b, x, y| {
                    let two = b.constant(2.0).unwrap();
                    let p = b.binary(Binary::Mul, x, two).unwrap();
                    b.noise(kind, 3, [p, y, x]).unwrap()
                },
                &[0.3, 1.4, -2.7],
            );
        }
        check(|b, x, y| b.block(Block::Cells { seed: 1 }, &[x, y, y]).unwrap()[0], &[0.31, 1.41, -2.7]);
        check(
            |b, x, y| {
                let first = b.binary(Binary::Less, x, y).unwrap();
                let square = b.binary(Binary::Mul, x, x).unwrap();
                b.select(first, square, y).unwrap()
            },
            &[0.1, 0.9],
        );
    }

    #[test]
    fn loops_have_no_slope_unless_they_stay_the_same() {
        let mut b = Builder::new(100);
        let x = b.input(Input::Px).unwrap();
        let y = b.input(Input::Py).unwrap();
        let never = b.constant(0.0).unwrap();
        let state = b.begin_loop(1).unwrap();
        let next = b.binary(Binary::Mul, state[0], x).unwrap();
        assert_eq!(b.derivative(next, Input::Px), Err(DerivativeError::Loop));
        let power = b.end_loop(3, &[y], never, &[next]).unwrap()[0];
        assert_eq!(b.derivative(power, Input::Px), Err(DerivativeError::Loop));
        assert_eq!(b.derivative(power, Input::Py), Err(DerivativeError::Loop));
        let slope = b.derivative(power, Input::Time).unwrap();
        assert_eq!(b.as_constant(slope), Some(0.0));
    }
}
