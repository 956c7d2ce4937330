//! A function made ready for many points at a time.
//!
//! Points are taken in chunks that fit the nearest cache. For a chunk, every operation runs over all points before
//! the next one starts, in a loop that is nothing but that operation in lanes; so what it costs to find out which
//! operation is next is shared by the whole chunk.

mod each;
mod lower;
mod op;
mod registers;
mod run;

use crate::kernels::improved::Improved;
use crate::kernels::noise::Noise;
use crate::{Function, Input, NoiseTables};
use fearless_simd::Level;
use lower::{Lowering, Shared, remove_unread};
use op::{Op, Operand, Register};
use registers::Allocator;
use run::{Line, Tables};
use std::fmt;

/// The most lines of a chunk: 128 points.
const LINES: usize = 16;
/// Registers of all lines together take no more than this, in lines, where one line each does not take more.
const MOST_LINES: usize = 1 << 15;

/// A function made ready for running many points at a time. It gives what [`Function::evaluate`] gives, to the last
/// bit, whatever the instruction set; only which NaN a NaN is may differ.
pub struct Plan {
    inputs: Vec<Input>,
    /// The registers of the inputs.
    filled: Vec<(Register, Input)>,
    constants: Vec<(Register, f64)>,
    ops: Vec<Op>,
    outputs: Vec<Operand>,
    registers: usize,
    /// Of a chunk.
    lines: usize,
    tables: Tables,
}

/// Working memory of a [`Plan`], kept from call to call; one serves any plans in turn.
#[derive(Default)]
pub struct PlanScratch {
    registers: Vec<Vec<Line>>,
}

impl Plan {
    /// Lays out the noise that the function uses and decides in what order to compute what.
    #[must_use]
    pub fn new(function: &Function, tables: &NoiseTables) -> Self {
        let mut shared = Shared::default();
        let mut lowering = Lowering::new(function.nodes(), function.outputs(), &[], &mut shared);
        lowering.all();
        let outputs: Vec<_> = function.outputs().iter().map(|id| lowering.operand(*id)).collect();
        let mut ops = lowering.take_ops();
        remove_unread(&mut ops, &outputs, shared.registers);

        let inputs = Input::ALL.into_iter().zip(shared.inputs);
        let inputs: Vec<_> = inputs.filter_map(|(input, r)| r.map(|r| (r, input))).collect();
        let pinned = inputs.iter().map(|(r, _)| *r).chain(shared.constants.iter().map(|(r, _)| *r));
        let mut allocator = Allocator::new(shared.registers, pinned);
        allocator.allocate(ops.iter_mut(), &outputs);
        let registers = allocator.count() as usize;
        Self {
            inputs: function.inputs_used().collect(),
            filled: inputs.iter().map(|(r, input)| (allocator.placed(*r), *input)).collect(),
            constants: shared.constants.iter().map(|(r, v)| (allocator.placed(*r), *v)).collect(),
            outputs: outputs.into_iter().map(|operand| allocator.placed_operand(operand)).collect(),
            ops,
            registers,
            lines: (MOST_LINES / registers.max(1)).clamp(1, LINES),
            tables: Tables {
                improved: shared.improved.iter().map(|seed| Improved::new(*seed)).collect(),
                classic: Noise::with_seeds(tables, &shared.classic),
            },
        }
    }

    /// The inputs that it needs.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// Evaluates at `len` points. Of `inputs`, those that [`Plan::inputs`] names hold at least `len` numbers, the
    /// others may be empty; there are as many `outputs` as the function has, of at least `len` numbers each.
    pub fn evaluate(
        &self,
        level: Level,
        inputs: &[&[f64]; Input::COUNT],
        len: usize,
        scratch: &mut PlanScratch,
        outputs: &mut [&mut [f64]],
    ) {
        let registers = scratch.prepare(self.registers, self.lines);
        for (register, v) in &self.constants {
            registers[*register as usize][..self.lines.min(len.div_ceil(8))].fill(Line([*v; 8]));
        }
        let chunk = self.lines * 8;
        for start in (0..len).step_by(chunk) {
            let end = len.min(start + chunk);
            for (register, input) in &self.filled {
                fill(&mut registers[*register as usize], &inputs[*input as usize][start..end]);
            }
            run::run(level, &self.tables, &self.ops, registers, (end - start).div_ceil(8));
            for (output, operand) in outputs.iter_mut().zip(&self.outputs) {
                let output = &mut output[start..end];
                match operand {
                    Operand::Constant(v) => output.fill(*v),
                    Operand::Register(register) => read(&registers[*register as usize], output),
                }
            }
        }
    }
}

impl fmt::Debug for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Plan")
            .field("ops", &self.ops)
            .field("outputs", &self.outputs)
            .field("registers", &self.registers)
            .finish_non_exhaustive()
    }
}

impl PlanScratch {
    /// At least so many registers of at least so many lines.
    fn prepare(&mut self, registers: usize, lines: usize) -> &mut [Vec<Line>] {
        if self.registers.len() < registers {
            self.registers.resize_with(registers, Vec::new);
        }
        for register in &mut self.registers[..registers] {
            if register.len() < lines {
                register.resize(lines, Line([0.0; 8]));
            }
        }
        &mut self.registers[..registers]
    }
}

/// Copies numbers into a register. The lanes beyond repeat the last.
fn fill(register: &mut [Line], from: &[f64]) {
    let (whole, rest) = from.as_chunks::<8>();
    for (line, numbers) in register.iter_mut().zip(whole) {
        line.0 = *numbers;
    }
    if let (Some(last), Some(line)) = (rest.last(), register.get_mut(whole.len())) {
        line.0 = [*last; 8];
        line.0[..rest.len()].copy_from_slice(rest);
    }
}

/// Copies the numbers of a register out.
fn read(register: &[Line], to: &mut [f64]) {
    for (numbers, line) in to.chunks_mut(8).zip(register) {
        numbers.copy_from_slice(&line.0[..numbers.len()]);
    }
}
