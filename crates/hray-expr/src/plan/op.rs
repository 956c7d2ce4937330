//! What a plan is made of: operations on registers, which hold one number for each point of a chunk.

use crate::{Binary, Image, NoiseKind, Unary};
use std::sync::Arc;

/// The number of a register.
pub(super) type Register = u32;

/// What an operation reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operand {
    Register(Register),
    /// The same number at all points.
    Constant(f64),
}

/// One operation on a chunk. The register it writes is none of those that it reads.
#[derive(Debug)]
pub(super) enum Op {
    Copy {
        a: Operand,
        out: Register,
    },
    Unary {
        f: Unary,
        a: Register,
        out: Register,
    },
    Binary {
        f: Binary,
        a: Operand,
        b: Operand,
        out: Register,
    },
    /// a b + c, rounded twice.
    MulAdd {
        a: Register,
        b: Operand,
        c: Operand,
        out: Register,
    },
    Select {
        condition: Register,
        a: Operand,
        b: Operand,
        out: Register,
    },
    Noise(NoiseOp),
    Cells {
        seed: u64,
        p: [Register; 3],
        out: Vec<Option<Register>>,
    },
    Image {
        image: Arc<Image>,
        at: [Register; 2],
        out: Vec<Option<Register>>,
    },
    Loop(LoopOp),
}

/// A sum of noise at multiples of one point: of one term for noise alone, of several for turbulence.
///
/// Starting from `sum`, or else from the first term, it adds weight × noise(scale × p), or that of |noise|, term by
/// term.
#[derive(Debug)]
pub(super) struct NoiseOp {
    pub(super) kind: NoiseKind,
    /// Which of the plan's tables of that kind.
    pub(super) table: usize,
    pub(super) p: [Register; 3],
    pub(super) absolute: bool,
    pub(super) terms: Vec<Term>,
    /// The largest scale of its terms, by magnitude.
    pub(super) largest: f64,
    pub(super) sum: Option<Operand>,
    pub(super) out: Register,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Term {
    pub(super) scale: f64,
    pub(super) weight: f64,
}

#[derive(Debug)]
pub(super) struct LoopOp {
    pub(super) max: u32,
    pub(super) initial: Vec<Operand>,
    pub(super) state: Vec<Register>,
    /// 1 where the loop goes on.
    pub(super) active: Register,
    /// What `until` needs.
    pub(super) check: Vec<Op>,
    pub(super) until: Operand,
    /// What `step` needs besides.
    pub(super) body: Vec<Op>,
    pub(super) step: Vec<Operand>,
}

impl Operand {
    /// The register in it.
    fn register(&mut self) -> Option<&mut Register> {
        match self {
            Self::Register(register) => Some(register),
            Self::Constant(_) => None,
        }
    }
}

impl Op {
    /// Hands out the registers that it reads itself. Of a loop: the initial state.
    pub(super) fn for_each_read(&mut self, f: &mut dyn FnMut(&mut Register)) {
        match self {
            Self::Unary { a, .. } => f(a),
            Self::Copy { a, .. } => a.register().into_iter().for_each(f),
            Self::Binary { a, b, .. } => [a, b].into_iter().filter_map(Operand::register).for_each(f),
            Self::MulAdd { a, b, c, .. } => {
                f(a);
                [b, c].into_iter().filter_map(Operand::register).for_each(f);
            }
            Self::Select { condition, a, b, .. } => {
                f(condition);
                [a, b].into_iter().filter_map(Operand::register).for_each(f);
            }
            Self::Noise(noise) => {
                noise.p.iter_mut().for_each(&mut *f);
                noise.sum.iter_mut().filter_map(Operand::register).for_each(f);
            }
            Self::Cells { p, .. } => p.iter_mut().for_each(f),
            Self::Image { at, .. } => at.iter_mut().for_each(f),
            Self::Loop(body) => body.initial.iter_mut().filter_map(Operand::register).for_each(f),
        }
    }

    /// Hands out the registers that it writes itself. Of a loop: the state, and where it goes on.
    pub(super) fn for_each_write(&mut self, f: &mut dyn FnMut(&mut Register)) {
        match self {
            Self::Copy { out, .. }
            | Self::Unary { out, .. }
            | Self::Binary { out, .. }
            | Self::MulAdd { out, .. }
            | Self::Select { out, .. }
            | Self::Noise(NoiseOp { out, .. }) => f(out),
            Self::Cells { out, .. } | Self::Image { out, .. } => out.iter_mut().flatten().for_each(f),
            Self::Loop(body) => {
                body.state.iter_mut().for_each(&mut *f);
                f(&mut body.active);
            }
        }
    }

    /// Hands out all registers that it reads, those in the body of a loop too.
    pub(super) fn for_each_read_within(&mut self, f: &mut dyn FnMut(&mut Register)) {
        self.for_each_read(f);
        if let Self::Loop(body) = self {
            for op in body.check.iter_mut().chain(&mut body.body) {
                op.for_each_read_within(f);
            }
            body.for_each_result(f);
        }
    }
}

impl LoopOp {
    /// Hands out the registers that the loop itself reads after each part of its body.
    pub(super) fn for_each_result(&mut self, f: &mut dyn FnMut(&mut Register)) {
        std::iter::once(&mut self.until).chain(&mut self.step).filter_map(Operand::register).for_each(f);
    }
}
