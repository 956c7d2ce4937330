//! Arithmetic on as many points at once as the machine has lanes: the inner loops of the renderer and of
//! compiled functions alike. Functions here are `inline(always)` because only code that is inlined into a
//! dispatched function is compiled for the machine's instruction set.

pub mod cells;
pub mod improved;
pub mod lanes;
pub mod noise;
pub mod power;
pub mod sine;
