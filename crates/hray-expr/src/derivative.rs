//! Slopes, by the rules of calculus on graphs.

use crate::{Binary, Block, Builder, DerivativeError, Input, Node, NodeId, Unary};
use std::collections::HashMap;

/// The step by which noise, cells and images are differentiated, in the units of their own arguments.
const STEP: f64 = 1.0 / 4096.0;

impl Builder {
    /// The derivative of a node with respect to an input, by forward accumulation. Where a function has corners, one side's
    /// slope is taken; what jumps has the slope of its pieces. Noise, cells and images are differenced over 2^-12 of the units of
    /// their own arguments.
    ///
    /// # Errors
    /// [`DerivativeError`] where it takes too many nodes, or is the result of a loop.
    pub fn derivative(&mut self, of: NodeId, with_respect_to: Input) -> Result<NodeId, DerivativeError> {
        let mut needed: Vec<NodeId> = vec![of];
        let mut order = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        while let Some(id) = needed.pop() {
            if seen.insert(id) {
                order.push(id);
                needed.extend(self.node(id).arguments());
            }
        }
        // Arguments come before what is made of them.
        order.sort_unstable();
        let mut slopes: HashMap<NodeId, Option<NodeId>> = HashMap::new();
        for id in order {
            let slope = self.slope(id, with_respect_to, &slopes)?;
            slopes.insert(id, slope);
        }
        match slopes.get(&of).copied().flatten() {
            Some(slope) => Ok(slope),
            None => Ok(self.constant(0.0)?),
        }
    }

    /// The slope of a node, of those of its arguments; none where it is 0.
    fn slope(
        &mut self,
        id: NodeId,
        input: Input,
        slopes: &HashMap<NodeId, Option<NodeId>>,
    ) -> Result<Option<NodeId>, DerivativeError> {
        let slope = |id: &NodeId| slopes.get(id).copied().flatten();
        Ok(match self.node(id).clone() {
            Node::Constant(_) | Node::Argument(_) | Node::Block(..) => None,
            Node::Input(i) if i == input => Some(self.constant(1.0)?),
            Node::Input(_) => None,
            Node::Unary(f, a) => match slope(&a) {
                None => None,
                Some(da) => match self.unary_slope(f, id, a)? {
                    None => None,
                    Some(factor) => Some(self.binary(Binary::Mul, factor, da)?),
                },
            },
            Node::Binary(f, a, b) => self.binary_slope(f, id, [a, b], [slope(&a), slope(&b)])?,
            Node::Select(c, a, b) => match (slope(&a), slope(&b)) {
                (None, None) => None,
                (da, db) => {
                    let zero = self.constant(0.0)?;
                    Some(self.select(c, da.unwrap_or(zero), db.unwrap_or(zero))?)
                }
            },
            Node::Noise(kind, seed, p) => {
                let slopes = p.map(|p| slope(&p));
                self.differenced(&p, &slopes, |graph, p| graph.noise(kind, seed, [p[0], p[1], p[2]]))?
            }
            Node::Result(block, i) => match self.node(block).clone() {
                Node::Block(Block::Loop(_), arguments) => {
                    if arguments.iter().any(|a| slope(a).is_some()) {
                        return Err(DerivativeError::Loop);
                    }
                    // The body may use the input itself.
                    return Err(DerivativeError::Loop);
                }
                Node::Block(block, arguments) => {
                    let slopes: Vec<Option<NodeId>> = arguments.iter().map(slope).collect();
                    self.differenced(&arguments, &slopes, |graph, p| {
                        Ok(graph.block(block.clone(), p)?[usize::from(i)])
                    })?
                }
                _ => None,
            },
        })
    }

    /// d f(a) / d a; none where it is 0.
    fn unary_slope(&mut self, f: Unary, value: NodeId, a: NodeId) -> Result<Option<NodeId>, DerivativeError> {
        let one = self.constant(1.0)?;
        Ok(Some(match f {
            Unary::Neg => self.constant(-1.0)?,
            Unary::Abs => {
                let zero = self.constant(0.0)?;
                let minus = self.constant(-1.0)?;
                let negative = self.binary(Binary::Less, a, zero)?;
                self.select(negative, minus, one)?
            }
            Unary::Floor | Unary::Ceil | Unary::Round | Unary::Not => return Ok(None),
            Unary::Sqrt => {
                let half = self.constant(0.5)?;
                self.binary(Binary::Div, half, value)?
            }
            Unary::Sin => self.unary(Unary::Cos, a)?,
            Unary::Cos => {
                let sine = self.unary(Unary::Sin, a)?;
                self.unary(Unary::Neg, sine)?
            }
            Unary::Tan => {
                let square = self.binary(Binary::Mul, value, value)?;
                self.binary(Binary::Add, one, square)?
            }
            Unary::Asin | Unary::Acos => {
                let square = self.binary(Binary::Mul, a, a)?;
                let rest = self.binary(Binary::Sub, one, square)?;
                let root = self.unary(Unary::Sqrt, rest)?;
                let sign = if f == Unary::Asin { one } else { self.constant(-1.0)? };
                self.binary(Binary::Div, sign, root)?
            }
            Unary::Atan => {
                let square = self.binary(Binary::Mul, a, a)?;
                let sum = self.binary(Binary::Add, one, square)?;
                self.binary(Binary::Div, one, sum)?
            }
            Unary::Exp => value,
            Unary::Ln => self.binary(Binary::Div, one, a)?,
        }))
    }

    /// The slope of a function of two numbers.
    fn binary_slope(
        &mut self,
        f: Binary,
        value: NodeId,
        [a, b]: [NodeId; 2],
        slopes: [Option<NodeId>; 2],
    ) -> Result<Option<NodeId>, DerivativeError> {
        if slopes == [None, None] {
            return Ok(None);
        }
        let zero = self.constant(0.0)?;
        let [da, db] = slopes.map(|slope| slope.unwrap_or(zero));
        Ok(Some(match f {
            Binary::Add | Binary::Sub => match slopes {
                [Some(da), None] => da,
                _ => self.binary(f, da, db)?,
            },
            Binary::Mul => {
                let left = self.binary(Binary::Mul, da, b)?;
                let right = self.binary(Binary::Mul, a, db)?;
                self.binary(Binary::Add, left, right)?
            }
            Binary::Div => {
                let change = self.binary(Binary::Mul, value, db)?;
                let rest = self.binary(Binary::Sub, da, change)?;
                self.binary(Binary::Div, rest, b)?
            }
            Binary::Modulo => {
                let quotient = self.binary(Binary::Div, a, b)?;
                let whole = self.unary(Unary::Floor, quotient)?;
                let change = self.binary(Binary::Mul, whole, db)?;
                self.binary(Binary::Sub, da, change)?
            }
            Binary::Min => {
                let first = self.binary(Binary::Less, a, b)?;
                self.select(first, da, db)?
            }
            Binary::Max => {
                let first = self.binary(Binary::Less, b, a)?;
                self.select(first, da, db)?
            }
            Binary::Pow => {
                // a^b (b a'/a + b' ln a), the first as b a^(b-1) a'.
                let one = self.constant(1.0)?;
                let less = self.binary(Binary::Sub, b, one)?;
                let power = self.binary(Binary::Pow, a, less)?;
                let factor = self.binary(Binary::Mul, b, power)?;
                let left = self.binary(Binary::Mul, factor, da)?;
                match slopes[1] {
                    None => left,
                    Some(db) => {
                        let log = self.unary(Unary::Ln, a)?;
                        let change = self.binary(Binary::Mul, log, db)?;
                        let right = self.binary(Binary::Mul, value, change)?;
                        self.binary(Binary::Add, left, right)?
                    }
                }
            }
            Binary::Atan2 => {
                let left = self.binary(Binary::Mul, b, da)?;
                let right = self.binary(Binary::Mul, a, db)?;
                let above = self.binary(Binary::Sub, left, right)?;
                let (aa, bb) = (self.binary(Binary::Mul, a, a)?, self.binary(Binary::Mul, b, b)?);
                let below = self.binary(Binary::Add, aa, bb)?;
                self.binary(Binary::Div, above, below)?
            }
            Binary::Less | Binary::LessEqual | Binary::Equal | Binary::And | Binary::Or | Binary::Random => {
                return Ok(None);
            }
        }))
    }

    /// The slope of something that is only known by its values.
    fn differenced(
        &mut self,
        arguments: &[NodeId],
        slopes: &[Option<NodeId>],
        make: impl Fn(&mut Self, &[NodeId]) -> Result<NodeId, crate::GraphTooLarge>,
    ) -> Result<Option<NodeId>, DerivativeError> {
        let (step, scale) = (self.constant(STEP)?, self.constant(0.5 / STEP)?);
        let mut sum: Option<NodeId> = None;
        for (i, slope) in slopes.iter().enumerate() {
            let Some(slope) = slope else { continue };
            let mut shifted = arguments.to_vec();
            shifted[i] = self.binary(Binary::Add, arguments[i], step)?;
            let above = make(self, &shifted)?;
            shifted[i] = self.binary(Binary::Sub, arguments[i], step)?;
            let below = make(self, &shifted)?;
            let difference = self.binary(Binary::Sub, above, below)?;
            let rate = self.binary(Binary::Mul, difference, scale)?;
            let term = self.binary(Binary::Mul, rate, *slope)?;
            sum = Some(match sum {
                None => term,
                Some(sum) => self.binary(Binary::Add, sum, term)?,
            });
        }
        Ok(sum)
    }
}
