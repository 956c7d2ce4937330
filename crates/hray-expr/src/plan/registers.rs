//! Few registers in place of many: each is used again once its number has been read for the last time.

use super::op::{Op, Operand, Register};

/// Gives registers their final numbers.
pub(super) struct Allocator {
    /// The final number of each register.
    places: Vec<Register>,
    /// Of each register: the sequence that writes it, and which of its operations reads it last.
    lives: Vec<(u32, usize)>,
    free: Vec<Register>,
    count: Register,
    sequences: u32,
}

impl Allocator {
    /// For `registers` registers, of which `pinned` keep theirs for good.
    pub(super) fn new(registers: Register, pinned: impl Iterator<Item = Register>) -> Self {
        let mut allocator = Self {
            places: vec![0; registers as usize],
            lives: vec![(0, 0); registers as usize],
            free: Vec::new(),
            count: 0,
            sequences: 0,
        };
        for register in pinned {
            allocator.place(register);
        }
        allocator
    }

    /// How many there are in the end.
    pub(super) const fn count(&self) -> Register {
        self.count
    }

    pub(super) fn placed(&self, register: Register) -> Register {
        self.places[register as usize]
    }

    pub(super) fn placed_operand(&self, operand: Operand) -> Operand {
        match operand {
            Operand::Register(register) => Operand::Register(self.placed(register)),
            constant @ Operand::Constant(_) => constant,
        }
    }

    fn place(&mut self, register: Register) {
        let place = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.places[register as usize] = place;
    }

    /// Places the registers of a sequence of operations; those of `results` are kept to its end. Gives those that
    /// are in use then.
    pub(super) fn allocate<'a>(
        &mut self,
        ops: impl Iterator<Item = &'a mut Op>,
        results: &[Operand],
    ) -> Vec<Register> {
        let mut ops: Vec<&mut Op> = ops.collect();
        self.sequences += 1;
        let sequence = self.sequences;
        let written = self.measure(sequence, &mut ops, results);
        for (i, op) in ops.iter_mut().enumerate() {
            let mut ending = Vec::new();
            let mut note = |r: &mut Register| {
                if self.lives[*r as usize] == (sequence, i) && !ending.contains(r) {
                    ending.push(*r);
                }
            };
            op.for_each_write(&mut note);
            op.for_each_read_within(&mut note);
            op.for_each_write(&mut |r| self.place(*r));
            if let Op::Loop(body) = op {
                let results: Vec<_> = std::iter::once(body.until).chain(body.step.iter().copied()).collect();
                let inner = self.allocate(body.check.iter_mut().chain(&mut body.body), &results);
                body.for_each_result(&mut |r| *r = self.placed(*r));
                self.free.extend(inner);
            }
            op.for_each_read(&mut |r| *r = self.placed(*r));
            op.for_each_write(&mut |r| *r = self.placed(*r));
            for register in ending {
                self.free.push(self.placed(register));
            }
        }
        let end = (sequence, ops.len());
        written.into_iter().filter(|r| self.lives[*r as usize] == end).map(|r| self.placed(r)).collect()
    }

    /// Notes when each register that the sequence writes is read last: at an operation, or at the end.
    fn measure(&mut self, sequence: u32, ops: &mut [&mut Op], results: &[Operand]) -> Vec<Register> {
        let mut written = Vec::new();
        for (i, op) in ops.iter_mut().enumerate() {
            op.for_each_write(&mut |r| {
                self.lives[*r as usize] = (sequence, i);
                written.push(*r);
            });
            op.for_each_read_within(&mut |r| self.read(sequence, *r, i));
        }
        for result in results {
            if let Operand::Register(register) = result {
                self.read(sequence, *register, ops.len());
            }
        }
        written
    }

    fn read(&mut self, sequence: u32, register: Register, at: usize) {
        let life = &mut self.lives[register as usize];
        if life.0 == sequence {
            life.1 = at;
        }
    }
}
