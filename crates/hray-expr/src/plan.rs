//! Functions made ready for many points.

use crate::{Function, Input, Node, NoiseTables};
use fearless_simd::Level;

/// A function with the noise that it uses.
#[derive(Clone, Debug)]
pub struct Plan {
    function: Function,
    tables: NoiseTables,
    inputs: Vec<Input>,
}

/// What one thread needs to run plans.
#[derive(Debug, Default)]
pub struct PlanScratch {}

impl Plan {
    /// Makes a function ready.
    #[must_use]
    pub fn new(function: &Function, tables: &NoiseTables) -> Self {
        let mut inputs: Vec<Input> = Vec::new();
        collect(function.nodes(), &mut inputs);
        inputs.sort_unstable();
        inputs.dedup();
        Self { function: function.clone(), tables: tables.clone(), inputs }
    }

    /// The inputs it needs.
    #[must_use]
    pub fn inputs(&self) -> &[Input] {
        &self.inputs
    }

    /// The results at `len` points.
    pub fn evaluate(
        &self,
        _level: Level,
        inputs: &[&[f64]; Input::COUNT],
        len: usize,
        _scratch: &mut PlanScratch,
        outputs: &mut [&mut [f64]],
    ) {
        for i in 0..len {
            let at = std::array::from_fn(|input| inputs[input].get(i).copied().unwrap_or(0.0));
            for (column, value) in outputs.iter_mut().zip(self.function.evaluate(&self.tables, &at)) {
                column[i] = value;
            }
        }
    }
}

fn collect(nodes: &[Node], inputs: &mut Vec<Input>) {
    for node in nodes {
        match node {
            Node::Input(input) => inputs.push(*input),
            Node::Block(crate::Block::Loop(body), _) => collect(&body.nodes, inputs),
            _ => {}
        }
    }
}
