//! The engine against the model, bit by bit.

use conformance::{compare, random};
use hray::NoiseTables;

/// Seeds 0 to 599; another range can be given as `HRAY_SEEDS=FROM..TO`.
#[test]
fn random_scenes_are_the_models_to_the_bit() {
    let seeds = std::env::var("HRAY_SEEDS").ok().and_then(|range| {
        let (from, to) = range.split_once("..")?;
        Some(from.parse().ok()?..to.parse().ok()?)
    });
    let tables = NoiseTables::default();
    let mut failures = Vec::new();
    for seed in seeds.unwrap_or(0..600) {
        let threads = 1 + (seed % 3) as usize;
        let description = random::description(seed).unwrap();
        if let Err(difference) = compare(&description, &tables, threads) {
            failures.push(format!("seed {seed}: {difference}"));
        }
    }
    assert!(failures.is_empty(), "{} scenes differ:\n{}", failures.len(), failures.join("\n"));
}

/// A comparison that could not fail would be worth nothing.
#[test]
fn a_difference_is_found() {
    let tables = NoiseTables::default();
    let mut differences = 0;
    for seed in 0..40 {
        let description = random::description(seed).unwrap();
        let mut other = description.clone();
        other.scene.background.r += 1e-16 + other.scene.background.r.abs() * 1e-15;
        let of = |d| conformance::engine_colors(d, &tables, 1);
        let (Ok(a), Ok(b)) = (of(&description), of(&other)) else { panic!("seed {seed} does not render") };
        differences += usize::from(a != b);
    }
    assert!(differences > 10, "only {differences} of 40 scenes show a change in the last place");
}
