//! Timing tracers against each other.

use crate::rays::{Kind, Rays};
use crate::trace::{Tally, Trace};
use clap::ValueEnum;
use cpu_time::ProcessTime;
use std::time::Instant;

/// What is taken for the time that something takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Clock {
    /// The time that passes.
    Wall,
    /// The time that the threads are on a processor, shared out among them: on a machine that has other work at the
    /// same time, what would pass without it, nearly.
    Cpu,
}

impl Clock {
    /// Does something on `threads` threads, and says how many seconds it took.
    pub fn time<T>(self, threads: usize, work: impl FnOnce() -> T) -> (T, f64) {
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        let made = work();
        let seconds = match self {
            Self::Wall => wall.elapsed().as_secs_f64(),
            Self::Cpu => cpu.elapsed().as_secs_f64() / threads as f64,
        };
        (made, seconds)
    }
}

/// What a tracer is compared as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// One of this project's.
    Ours,
    /// The rival as it is when nothing special is asked of it. Its hits are those that checks are about.
    Default,
    /// The rival where no ray may slip between two triangles, as none slips past ours.
    Robust,
    /// Another form of the rival, shown for its own sake.
    Other,
}

/// A tracer over a mesh.
pub struct Contestant {
    /// What it is called in tables.
    pub name: String,
    /// What it is compared as.
    pub role: Role,
    /// Seconds that building it took.
    pub build: f64,
    /// Bytes that it keeps, the mesh itself not included.
    pub kept: Option<u64>,
    /// Bytes that it needed at once while it was built, the mesh itself not included.
    pub peak: Option<u64>,
    /// What traces.
    pub tracer: Box<dyn Trace>,
}

/// What one contestant made of the rays of one kind.
#[derive(Clone, Debug)]
pub struct Series {
    /// Rays in a second, one figure for each run.
    pub rates: Vec<f64>,
    /// What was hit, in every run alike.
    pub tally: Tally,
}

/// Times each contestant with the rays of a kind `runs` times: in each round every contestant runs once, one after
/// the other, so that what disturbs the machine disturbs them all.
#[must_use]
pub fn measure(
    contestants: &[Contestant],
    rays: &Rays,
    kind: Kind,
    threads: usize,
    runs: usize,
    clock: Clock,
) -> Vec<Series> {
    let rays = rays.of(kind);
    let series = |_: &Contestant| Series { rates: Vec::new(), tally: Tally::default() };
    let mut all: Vec<Series> = contestants.iter().map(series).collect();
    for _ in 0..runs {
        for (contestant, series) in contestants.iter().zip(&mut all) {
            let start = Instant::now();
            let (tally, busy) = contestant.tracer.tally(rays, kind.any_hit(), threads);
            let seconds = match clock {
                Clock::Wall => start.elapsed().as_secs_f64(),
                Clock::Cpu => busy.as_secs_f64() / threads as f64,
            };
            series.tally = tally;
            series.rates.push(rays.len() as f64 / seconds);
        }
    }
    all
}

/// The median; of an even number of figures, the mean of the two in the middle.
#[must_use]
pub fn median(figures: impl IntoIterator<Item = f64>) -> f64 {
    let mut figures: Vec<f64> = figures.into_iter().collect();
    figures.sort_unstable_by(f64::total_cmp);
    let middle = figures.len() / 2;
    match figures.as_slice() {
        [] => f64::NAN,
        sorted if sorted.len() % 2 == 1 => sorted[middle],
        sorted => (sorted[middle - 1] + sorted[middle]) / 2.0,
    }
}

/// How many times as fast the first is as the second: the median over rounds, so that only runs that followed each
/// other are compared.
#[must_use]
pub fn ratio(a: &Series, b: &Series) -> f64 {
    median(a.rates.iter().zip(&b.rates).map(|(a, b)| a / b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median([3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median([4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median([]).is_nan());
    }

    #[test]
    fn ratios_compare_runs_of_one_round() {
        let series = |rates: [f64; 3]| Series { rates: rates.into(), tally: Tally::default() };
        assert_eq!(ratio(&series([2.0, 20.0, 9.0]), &series([1.0, 10.0, 3.0])), 2.0);
    }
}
