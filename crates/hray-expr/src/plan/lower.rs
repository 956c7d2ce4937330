//! From the nodes of a function to operations on registers: one register for each result, as many as it takes.
//!
//! Some operations do the work of several nodes. They are found here, while lowering, by looking at what the
//! operands of a node have become; operations whose results nobody reads any more are removed afterwards.

use super::op::{LoopOp, NoiseOp, Op, Operand, Register, Term};
use crate::{Binary, Block, Input, Loop, Node, NodeId, NoiseKind, Unary};
use std::collections::HashMap;
use std::sync::Arc;

/// What all parts of a plan share.
#[derive(Default)]
pub(super) struct Shared {
    /// How many registers there are.
    pub(super) registers: Register,
    /// The registers of inputs.
    pub(super) inputs: [Option<Register>; Input::COUNT],
    /// Registers that hold a constant, for the operations that read nothing else.
    pub(super) constants: Vec<(Register, f64)>,
    known: HashMap<u64, Register>,
    /// The seeds of the tables of both kinds of noise.
    pub(super) improved: Vec<u64>,
    pub(super) classic: Vec<u64>,
}

impl Shared {
    fn register(&mut self) -> Register {
        self.registers += 1;
        self.registers - 1
    }

    fn input(&mut self, input: Input) -> Register {
        if let Some(register) = self.inputs[input as usize] {
            return register;
        }
        let register = self.register();
        self.inputs[input as usize] = Some(register);
        register
    }

    fn constant(&mut self, v: f64) -> Register {
        if let Some(register) = self.known.get(&v.to_bits()) {
            return *register;
        }
        let register = self.register();
        self.known.insert(v.to_bits(), register);
        self.constants.push((register, v));
        register
    }

    fn table(&mut self, kind: NoiseKind, seed: u64) -> usize {
        let seeds = match kind {
            NoiseKind::Improved => &mut self.improved,
            NoiseKind::Classic => &mut self.classic,
        };
        seeds.iter().position(|s| *s == seed).unwrap_or_else(|| {
            seeds.push(seed);
            seeds.len() - 1
        })
    }
}

/// The nodes of a function or of a body on their way to operations.
pub(super) struct Lowering<'a> {
    nodes: &'a [Node],
    shared: &'a mut Shared,
    /// What the arguments of a body are.
    arguments: &'a [Operand],
    /// How often each node is used.
    uses: Vec<u32>,
    /// What each node has become; nothing yet, or a block.
    operands: Vec<Option<Operand>>,
    /// The registers of the results of blocks, by block and result.
    results: HashMap<(NodeId, u8), Register>,
    /// Which results of each block are used.
    wanted: HashMap<NodeId, Vec<u8>>,
    done: Vec<bool>,
    ops: Vec<Option<Op>>,
    /// Of a node that has become noise, its operation, and its coordinates before they were scaled.
    noises: HashMap<NodeId, (usize, [Register; 3])>,
}

impl<'a> Lowering<'a> {
    pub(super) fn new(
        nodes: &'a [Node],
        roots: &[NodeId],
        arguments: &'a [Operand],
        shared: &'a mut Shared,
    ) -> Self {
        let mut uses = vec![0; nodes.len()];
        let mut wanted: HashMap<NodeId, Vec<u8>> = HashMap::new();
        for node in nodes {
            node.for_each_operand(|a| uses[a.index()] += 1);
            if let Node::Result(block, index) = node {
                wanted.entry(*block).or_default().push(*index);
            }
        }
        for root in roots {
            uses[root.index()] += 1;
        }
        Self {
            nodes,
            shared,
            arguments,
            uses,
            operands: vec![None; nodes.len()],
            results: HashMap::new(),
            wanted,
            done: vec![false; nodes.len()],
            ops: Vec::new(),
            noises: HashMap::new(),
        }
    }

    /// Lowers all nodes.
    pub(super) fn all(&mut self) {
        for i in 0..self.nodes.len() {
            self.node(NodeId(i as u32));
        }
    }

    /// Lowers what a node needs, and it.
    fn needed(&mut self, root: NodeId) {
        let mut needed = vec![false; root.index() + 1];
        needed[root.index()] = true;
        for i in (0..needed.len()).rev() {
            if needed[i] && !self.done[i] {
                self.nodes[i].for_each_operand(|a| needed[a.index()] = true);
            }
        }
        for i in (0..needed.len()).filter(|&i| needed[i]) {
            self.node(NodeId(i as u32));
        }
    }

    /// What a lowered node has become.
    pub(super) fn operand(&self, id: NodeId) -> Operand {
        self.operands[id.index()].unwrap_or(Operand::Constant(0.0))
    }

    /// The operations so far, which are taken out.
    pub(super) fn take_ops(&mut self) -> Vec<Op> {
        self.noises.clear();
        let mut ops: Vec<_> = std::mem::take(&mut self.ops).into_iter().flatten().collect();
        ops.iter_mut().for_each(|op| {
            if let Op::Noise(noise) = op {
                noise.largest = noise.terms.iter().map(|term| term.scale.abs()).fold(0.0, f64::max);
            }
        });
        ops
    }

    /// A register with the value of a node.
    fn register(&mut self, id: NodeId) -> Register {
        match self.operand(id) {
            Operand::Register(register) => register,
            Operand::Constant(v) => self.shared.constant(v),
        }
    }

    fn node(&mut self, id: NodeId) {
        if std::mem::replace(&mut self.done[id.index()], true) {
            return;
        }
        let operand = match &self.nodes[id.index()] {
            Node::Constant(v) => Operand::Constant(*v),
            Node::Input(input) => Operand::Register(self.shared.input(*input)),
            Node::Argument(i) => self.arguments.get(*i as usize).copied().unwrap_or(Operand::Constant(0.0)),
            Node::Unary(f, a) => self.unary(id, *f, *a),
            Node::Binary(f, a, b) => self.binary(id, *f, *a, *b),
            Node::Select(condition, a, b) => {
                let condition = self.register(*condition);
                let (a, b) = (self.operand(*a), self.operand(*b));
                self.push(|out| Op::Select { condition, a, b, out })
            }
            Node::Noise(kind, seed, p) => self.noise(id, *kind, *seed, *p),
            Node::Block(block, arguments) => {
                self.block(id, block, arguments);
                return;
            }
            Node::Result(block, index) => match self.results.get(&(*block, *index)) {
                Some(register) => Operand::Register(*register),
                None => Operand::Constant(0.0),
            },
        };
        self.operands[id.index()] = Some(operand);
    }

    fn push(&mut self, op: impl FnOnce(Register) -> Op) -> Operand {
        let out = self.shared.register();
        self.ops.push(Some(op(out)));
        Operand::Register(out)
    }

    fn unary(&mut self, id: NodeId, f: Unary, a: NodeId) -> Operand {
        if f == Unary::Abs
            && let Some(mut noise) = self.take_noise(a, |noise| noise.is_plain() && !noise.absolute)
        {
            noise.0.absolute = true;
            return self.push_noise(id, noise);
        }
        match self.operand(a) {
            Operand::Constant(a) => Operand::Constant(f.apply(a)),
            Operand::Register(a) => self.push(|out| Op::Unary { f, a, out }),
        }
    }

    fn binary(&mut self, id: NodeId, f: Binary, a: NodeId, b: NodeId) -> Operand {
        let (x, y) = (self.operand(a), self.operand(b));
        if let (Operand::Constant(a), Operand::Constant(b)) = (x, y) {
            return Operand::Constant(f.apply(a, b));
        }
        let fused = match (f, x, y) {
            (Binary::Add, ..) => self.noise_sum(id, a, b).or_else(|| self.mul_add(a, b)),
            (Binary::Mul, _, Operand::Constant(weight)) => self.weighted(id, a, weight),
            (Binary::Mul, Operand::Constant(weight), _) => self.weighted(id, b, weight),
            (Binary::Div, _, Operand::Constant(divisor)) => {
                reciprocal(divisor).and_then(|weight| self.weighted(id, a, weight))
            }
            _ => None,
        };
        fused.unwrap_or_else(|| match (f, y) {
            (Binary::Div, Operand::Constant(divisor)) if reciprocal(divisor).is_some() => {
                let b = Operand::Constant(divisor.recip());
                self.push(|out| Op::Binary { f: Binary::Mul, a: x, b, out })
            }
            _ => self.push(|out| Op::Binary { f, a: x, b: y, out }),
        })
    }

    /// A product that is only used in a sum becomes part of it.
    fn mul_add(&mut self, a: NodeId, b: NodeId) -> Option<Operand> {
        for (product, other) in [(b, a), (a, b)] {
            if self.uses[product.index()] != 1 {
                continue;
            }
            let Node::Binary(Binary::Mul, x, y) = self.nodes[product.index()] else { continue };
            let (x, y) = if matches!(self.operand(x), Operand::Register(_)) { (x, y) } else { (y, x) };
            let (a, b, c) = (self.register(x), self.operand(y), self.operand(other));
            return Some(self.push(|out| Op::MulAdd { a, b, c, out }));
        }
        None
    }

    fn noise(&mut self, id: NodeId, kind: NoiseKind, seed: u64, p: [NodeId; 3]) -> Operand {
        let table = self.shared.table(kind, seed);
        let scaled = p.map(|a| self.register(a));
        let (p, scale) = self.unscaled(p).unwrap_or((scaled, 1.0));
        let terms = vec![Term { scale, weight: 1.0 }];
        let noise = NoiseOp { kind, table, p, absolute: false, terms, largest: 0.0, sum: None, out: 0 };
        self.push_noise(id, (noise, scaled))
    }

    /// The point that all coordinates are the same multiple of.
    fn unscaled(&mut self, p: [NodeId; 3]) -> Option<([Register; 3], f64)> {
        let mut factors = [0.0; 3];
        let mut bases = p;
        for ((id, factor), base) in p.iter().zip(&mut factors).zip(&mut bases) {
            let Node::Binary(Binary::Mul, a, b) = self.nodes[id.index()] else { return None };
            (*base, *factor) = match (self.operand(a), self.operand(b)) {
                (Operand::Register(_), Operand::Constant(factor)) => (a, factor),
                (Operand::Constant(factor), Operand::Register(_)) => (b, factor),
                _ => return None,
            };
        }
        let same = factors.iter().all(|factor| factor.to_bits() == factors[0].to_bits());
        same.then(|| (bases.map(|base| self.register(base)), factors[0]))
    }

    /// Noise times a constant.
    fn weighted(&mut self, id: NodeId, noise: NodeId, weight: f64) -> Option<Operand> {
        let mut noise = self.take_noise(noise, NoiseOp::is_plain)?;
        noise.0.terms[0].weight = weight;
        Some(self.push_noise(id, noise))
    }

    /// A sum with noise becomes part of the noise.
    fn noise_sum(&mut self, id: NodeId, a: NodeId, b: NodeId) -> Option<Operand> {
        for (term, sum) in [(b, a), (a, b)] {
            let Some((mut noise, scaled)) = self.take_noise(term, NoiseOp::is_term) else { continue };
            if sum != term
                && let Some((mut before, before_scaled)) = self.take_noise(sum, |before| before.fits(&noise))
            {
                // Octave 0 is at the point itself, which may look like a multiple of another.
                let same = before.p == noise.p
                    || before.unscale_to(before_scaled, noise.p)
                    || noise.unscale_to(scaled, before.p);
                if same {
                    before.terms.append(&mut noise.terms);
                    return Some(self.push_noise(id, (before, before_scaled)));
                }
                self.restore(sum, (before, before_scaled));
            }
            noise.sum = Some(self.operand(sum));
            return Some(self.push_noise(id, (noise, scaled)));
        }
        None
    }

    /// Takes the noise that a node has become out of the operations, where it is used just once and is wanted.
    fn take_noise(
        &mut self,
        id: NodeId,
        wanted: impl FnOnce(&NoiseOp) -> bool,
    ) -> Option<(NoiseOp, [Register; 3])> {
        let (place, scaled) = *self.noises.get(&id)?;
        if self.uses[id.index()] != 1 {
            return None;
        }
        match self.ops[place].take() {
            Some(Op::Noise(noise)) if wanted(&noise) => Some((noise, scaled)),
            op => {
                self.ops[place] = op;
                None
            }
        }
    }

    /// Puts noise back that was taken in vain.
    fn restore(&mut self, id: NodeId, (noise, _): (NoiseOp, [Register; 3])) {
        if let Some((place, _)) = self.noises.get(&id) {
            self.ops[*place] = Some(Op::Noise(noise));
        }
    }

    fn push_noise(&mut self, id: NodeId, (mut noise, scaled): (NoiseOp, [Register; 3])) -> Operand {
        self.noises.insert(id, (self.ops.len(), scaled));
        self.push(|out| {
            noise.out = out;
            Op::Noise(noise)
        })
    }

    fn block(&mut self, id: NodeId, block: &Block, arguments: &[NodeId]) {
        let wanted = self.wanted.get(&id).cloned().unwrap_or_default();
        let mut out = vec![None; block.results()];
        for index in wanted {
            if let Some(out @ None) = out.get_mut(usize::from(index)) {
                *out = Some(self.shared.register());
            }
        }
        match block {
            Block::Cells { seed } => {
                let p = [0, 1, 2].map(|i| self.register(arguments[i]));
                self.ops.push(Some(Op::Cells { seed: *seed, p, out: out.clone() }));
            }
            Block::Image(image) => {
                let at = [0, 1].map(|i| self.register(arguments[i]));
                self.ops.push(Some(Op::Image { image: Arc::clone(image), at, out: out.clone() }));
            }
            Block::Loop(body) => {
                let state: Vec<_> =
                    out.iter_mut().map(|out| *out.get_or_insert_with(|| self.shared.register())).collect();
                let arguments: Vec<_> = arguments.iter().map(|id| self.operand(*id)).collect();
                let op = lower_loop(body, &arguments, state, self.shared);
                self.ops.push(Some(Op::Loop(op)));
            }
        }
        for (i, register) in out.into_iter().enumerate() {
            if let Some(register) = register {
                self.results.insert((id, i as u8), register);
            }
        }
    }
}

fn lower_loop(body: &Loop, arguments: &[Operand], state: Vec<Register>, shared: &mut Shared) -> LoopOp {
    let active = shared.register();
    let (initial, captured) = arguments.split_at(body.state.min(arguments.len()));
    let inside: Vec<_> =
        state.iter().map(|r| Operand::Register(*r)).chain(captured.iter().copied()).collect();
    let roots: Vec<_> = std::iter::once(body.until).chain(body.step.iter().copied()).collect();
    let mut lowering = Lowering::new(&body.nodes, &roots, &inside, shared);
    lowering.needed(body.until);
    let until = lowering.operand(body.until);
    let check = lowering.take_ops();
    lowering.all();
    let mut step: Vec<_> = body.step.iter().map(|id| lowering.operand(*id)).collect();
    // The state is replaced number by number; what the step takes from another place of it is set aside.
    for (i, step) in step.iter_mut().enumerate() {
        let moved = matches!(*step, Operand::Register(r) if r != state[i] && state.contains(&r));
        if moved {
            let a = *step;
            *step = lowering.push(|out| Op::Copy { a, out });
        }
    }
    let body_ops = lowering.take_ops();
    LoopOp { max: body.max, initial: initial.to_vec(), state, active, check, until, body: body_ops, step }
}

impl NoiseOp {
    /// Noise alone.
    fn is_plain(&self) -> bool {
        self.is_term() && self.terms[0].weight == 1.0
    }

    /// Noise with a weight.
    fn is_term(&self) -> bool {
        self.sum.is_none() && self.terms.len() == 1
    }

    /// Whether `term` can be one more of its terms, if their points agree.
    fn fits(&self, term: &Self) -> bool {
        (self.kind, self.table, self.absolute) == (term.kind, term.table, term.absolute)
    }

    /// Takes back the scale of a single term, where that makes its point `p`.
    fn unscale_to(&mut self, scaled: [Register; 3], p: [Register; 3]) -> bool {
        let possible = scaled == p && self.terms.len() == 1;
        if possible {
            self.terms[0].scale = 1.0;
            self.p = p;
        }
        possible
    }
}

/// The number that one may multiply by instead of dividing by a power of two.
fn reciprocal(divisor: f64) -> Option<f64> {
    let exact = divisor.is_normal() && divisor.to_bits() & 0x000F_FFFF_FFFF_FFFF == 0;
    exact.then(|| divisor.recip()).filter(|r| r.is_normal())
}

/// Removes the operations whose results are not read, by what comes after or as `results`.
pub(super) fn remove_unread(ops: &mut Vec<Op>, results: &[Operand], registers: Register) {
    let mut read = vec![false; registers as usize];
    for result in results {
        if let Operand::Register(register) = result {
            read[*register as usize] = true;
        }
    }
    keep_read(ops, &mut read);
}

fn keep_read(ops: &mut Vec<Op>, read: &mut [bool]) {
    let mut kept = Vec::with_capacity(ops.len());
    for mut op in std::mem::take(ops).into_iter().rev() {
        let mut wanted = false;
        op.for_each_write(&mut |r| wanted |= read[*r as usize]);
        if !wanted {
            continue;
        }
        if let Op::Loop(body) = &mut op {
            body.for_each_result(&mut |r| read[*r as usize] = true);
            for state in &body.state {
                read[*state as usize] = true;
            }
            keep_read(&mut body.body, read);
            keep_read(&mut body.check, read);
        }
        op.for_each_read(&mut |r| read[*r as usize] = true);
        kept.push(op);
    }
    kept.reverse();
    *ops = kept;
}
