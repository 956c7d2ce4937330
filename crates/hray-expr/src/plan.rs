//! A function made ready for many points at a time.

use crate::{Function, Input, NoiseTables};
use fearless_simd::Level;

/// A function made ready for running many points at a time.
pub struct Plan {
    function: Function,
    tables: NoiseTables,
    inputs: Vec<Input>,
}

/// Working memory of a [`Plan`], kept from call to call; one serves any plans in turn.
#[derive(Default)]
pub struct PlanScratch {}

impl Plan {
    /// Lays out the noise that the function uses and decides in what order to compute what.
    #[must_use]
    pub fn new(function: &Function, tables: &NoiseTables) -> Self {
        Self { function: function.clone(), tables: tables.clone(), inputs: function.inputs_used().collect() }
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
        _level: Level,
        inputs: &[&[f64]; Input::COUNT],
        len: usize,
        _scratch: &mut PlanScratch,
        outputs: &mut [&mut [f64]],
    ) {
        for i in 0..len {
            let mut at = [0.0; Input::COUNT];
            for input in &self.inputs {
                at[*input as usize] = inputs[*input as usize][i];
            }
            for (output, value) in outputs.iter_mut().zip(self.function.evaluate(&self.tables, &at)) {
                output[i] = value;
            }
        }
    }
}
