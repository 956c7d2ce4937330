//! What came out, as tables of text.

use crate::measure::{Contestant, Role, Series, median, ratio};
use crate::meshes::{Mesh, MeshName};
use crate::rays::Kind;
use std::fmt::Write;

/// Hits, and the sum of distances to them where nearest hits are asked for, that Embree 4.4 finds as it is when nothing
/// special is asked of it. Its test is not quite the same for each instruction set, so a ray or a few may differ where
/// another is chosen than that of these figures; a watertight test differs by some tens.
#[must_use]
pub fn expected(mesh: MeshName, kind: Kind) -> (u64, Option<f64>) {
    let (primary, diffuse, shadow) = match mesh {
        MeshName::Bunny => ((455_675, 1.123_507e5), (153_936, 2.915_215e3), 144_717),
        MeshName::Split => ((455_675, 1.123_508e5), (153_942, 2.914_777e3), 144_719),
        MeshName::Terrain => ((732_372, 1.003_502e6), (518_644, 7.839_951e4), 211_969),
    };
    match kind {
        Kind::Primary => (primary.0, Some(primary.1)),
        Kind::Diffuse | Kind::Shuffled => (diffuse.0, Some(diffuse.1)),
        Kind::Ao => (diffuse.0, None),
        Kind::Shadow => (shadow, None),
    }
}

/// What every contestant made of the rays of some kinds: for each kind a series for each contestant.
pub type Results = Vec<(Kind, Vec<Series>)>;

/// The tables for one mesh and one number of threads: speeds, ratios of ours to the rival's, hits.
#[must_use]
pub fn tables(
    mesh: &Mesh,
    threads: usize,
    runs: usize,
    contestants: &[Contestant],
    results: &Results,
) -> String {
    let mut text = String::new();
    let mut line = |cells: &[String]| {
        let (first, rest) = cells.split_first().unwrap_or((&EMPTY, &[]));
        let rest: String = rest.iter().map(|cell| format!(" {cell:>14}")).collect();
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}", format!("{first:<42}{rest}").trim_end());
    };
    let row = |first: String, cell: &dyn Fn(Kind, &[Series]) -> String, more: &[String]| {
        let cells = results.iter().map(|(kind, series)| cell(*kind, series));
        [first].into_iter().chain(cells).chain(more.iter().cloned()).collect::<Vec<String>>()
    };
    let kinds = |kind: Kind, _: &[Series]| format!("{kind:?}").to_lowercase();

    let triangles = mesh.triangles.len();
    line(&[format!("{:?}, {triangles} triangles, {threads} thread(s), {runs} run(s)", mesh.name)]);
    let build = ["build s", "kept MB", "peak MB"].map(str::to_owned);
    line(&row("million rays in a second (median)".into(), &kinds, &build));
    for (i, contestant) in contestants.iter().enumerate() {
        let rate =
            |_: Kind, series: &[Series]| format!("{:.2}", median(series[i].rates.iter().copied()) / 1e6);
        let megabytes =
            |bytes: Option<u64>| bytes.map_or("-".into(), |bytes| format!("{:.1}", bytes as f64 / 1e6));
        let build =
            [format!("{:.3}", contestant.build), megabytes(contestant.kept), megabytes(contestant.peak)];
        line(&row(format!("  {}", contestant.name), &rate, &build));
    }

    let of = |wanted: &[Role]| {
        let wanted = wanted.to_vec();
        contestants.iter().enumerate().filter(move |(_, contestant)| wanted.contains(&contestant.role))
    };
    let pairs: Vec<_> = of(&[Role::Ours])
        .flat_map(|ours| of(&[Role::Robust, Role::Default]).map(move |rival| (ours, rival)))
        .collect();
    if !pairs.is_empty() {
        line(&row("times as fast (median over rounds)".into(), &kinds, &[]));
    }
    for ((ours, our), (theirs, their)) in pairs {
        let cell = |_: Kind, series: &[Series]| format!("{:.2}", ratio(&series[ours], &series[theirs]));
        line(&row(format!("  {} / {}", our.name, their.name), &cell, &[]));
    }

    line(&row("hits (compared with those expected)".into(), &kinds, &[]));
    for (i, contestant) in contestants.iter().enumerate() {
        let hits = |kind, series: &[Series]| {
            let hits = series[i].tally.hits;
            match i128::from(hits) - i128::from(expected(mesh.name, kind).0) {
                0 => format!("{hits} (=)"),
                difference => format!("{hits} ({difference:+})"),
            }
        };
        line(&row(format!("  {}", contestant.name), &hits, &[]));
    }
    line(&row("sum of distances (compared, relative)".into(), &kinds, &[]));
    for (i, contestant) in contestants.iter().enumerate() {
        let sum = |kind, series: &[Series]| {
            let difference = |expected: f64| format!("{:+.0e}", series[i].tally.sum / expected - 1.0);
            expected(mesh.name, kind).1.map_or("-".into(), difference)
        };
        line(&row(format!("  {}", contestant.name), &sum, &[]));
    }
    text
}

static EMPTY: String = String::new();

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::terrain;
    use crate::rays::Ray;
    use crate::trace::{Hit, Tally, Trace};
    use std::time::Duration;

    struct Nothing;

    impl Trace for Nothing {
        fn tally(&self, _: &[Ray], _: bool, _: usize) -> (Tally, Duration) {
            Default::default()
        }

        fn hits(&self, _: &[Ray]) -> Vec<Hit> {
            Vec::new()
        }
    }

    #[test]
    fn tables_compare() {
        let contestant = |name: &str, role| Contestant {
            name: name.into(),
            role,
            build: 0.5,
            kept: Some(2_000_000),
            peak: None,
            tracer: Box::new(Nothing),
        };
        let contestants = [contestant("rival", Role::Robust), contestant("ours", Role::Ours)];
        let series = |rate, hits| Series { rates: vec![rate; 3], tally: Tally { hits, sum: 1.003_502e6 } };
        let results = vec![(Kind::Primary, vec![series(4e6, 732_372), series(6e6, 732_370)])];
        let text = tables(&terrain(1), 2, 3, &contestants, &results);
        let cells = |start: &str| {
            let line = text.lines().find(|line| line.trim_start().starts_with(start)).unwrap();
            line.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        assert_eq!(cells("rival"), "rival 4.00 0.500 2.0 -");
        assert_eq!(cells("ours / rival"), "ours / rival 1.50");
        assert!(text.contains("732372 (=)") && text.contains("732370 (-2)"), "{text}");
        assert!(text.contains("+0e0"), "{text}");
    }
}
