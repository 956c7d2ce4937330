//! The functions of a scene, ready to be evaluated.

use fearless_simd::Level;
use hray_core::{Function, NoiseTables};
use hray_expr::{Input, Plan, PlanScratch};
use std::collections::HashMap;
use std::sync::Arc;

/// Plans; functions that are shared have one.
pub(super) struct Plans {
    tables: NoiseTables,
    known: HashMap<usize, u32>,
    list: Vec<(Arc<Function>, Plan)>,
    /// Whether any of them asks for one of u and v.
    pub(super) use_uv: bool,
}

impl Plans {
    pub(super) fn new(tables: &NoiseTables) -> Self {
        Self { tables: tables.clone(), known: HashMap::new(), list: Vec::new(), use_uv: false }
    }

    pub(super) const fn tables(&self) -> &NoiseTables {
        &self.tables
    }

    pub(super) fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The number of a function's plan; none where it has another number of outputs.
    pub(super) fn of(&mut self, function: &Arc<Function>, outputs: usize) -> Option<u32> {
        if function.outputs().len() != outputs {
            return None;
        }
        Some(*self.known.entry(Arc::as_ptr(function).addr()).or_insert_with(|| {
            let plan = Plan::new(function, &self.tables);
            self.use_uv |= uses_uv(&plan);
            // The function is kept, so that its address stays its own.
            self.list.push((function.clone(), plan));
            self.list.len() as u32 - 1
        }))
    }

    pub(super) fn uses_uv(&self, plan: u32) -> bool {
        uses_uv(&self.list[plan as usize].1)
    }

    /// Evaluates a plan of one or three outputs at `len` points; `outputs` are that many columns.
    pub(super) fn evaluate<'c>(
        &self,
        level: Level,
        plan: u32,
        inputs: &[&[f64]; Input::COUNT],
        len: usize,
        scratch: &mut PlanScratch,
        mut outputs: impl Iterator<Item = &'c mut [f64]>,
    ) {
        let plan = &self.list[plan as usize].1;
        match (outputs.next(), outputs.next(), outputs.next()) {
            (Some(x), Some(y), Some(z)) => plan.evaluate(level, inputs, len, scratch, &mut [x, y, z]),
            (Some(x), None, _) => plan.evaluate(level, inputs, len, scratch, &mut [x]),
            _ => {}
        }
    }
}

fn uses_uv(plan: &Plan) -> bool {
    plan.inputs().iter().any(|input| matches!(input, Input::U | Input::V))
}
