//! Times the whole program on the classic scenes, beside the original's times; and single rays, beside Embree's.

use crate::{Result, build_hray};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Seconds that the original takes, built with GHC -O2, on a machine with 2 cores; the shortest were measured
/// to a hundredth only, and of the noise scenes with 10 octaves the fastest stands for all (1.2 to 1.4).
const ORIGINAL: [(&str, f64); 18] = [
    ("trans2", 49.0),
    ("perlin0", 14.0),
    ("mirror", 3.6),
    ("perlin1", 1.9),
    ("circles", 1.3),
    ("perlinShowFire", 1.2),
    ("perlinShowMarble", 1.2),
    ("perlinShowMarbleBase", 1.2),
    ("perlinShowSemiTurb", 1.2),
    ("perlinShowTurb", 1.2),
    ("perlinShowWood", 1.2),
    ("perlinShowPlasma", 0.41),
    ("perlinShowSolid", 0.19),
    ("trans0", 0.71),
    ("trans1", 0.38),
    ("shadow2", 0.21),
    ("shadow0", 0.05),
    ("shadow1", 0.05),
];

/// Prints a table: for each scene the original's time and the median of `runs` runs of `hray SCENE OUT.ppm`,
/// on one thread and on two, with their ratios. The runs of all columns are interleaved.
///
/// # Errors
/// Where `HRAY_CLASSIC` does not name the folder of the classic scenes, or a scene does not render.
pub fn run(runs: usize) -> Result<()> {
    let classic = std::env::var_os("HRAY_CLASSIC").map(PathBuf::from);
    let classic = classic.ok_or("set HRAY_CLASSIC to the folder that holds the classic scenes")?;
    let hray = build_hray()?;
    let output = std::env::temp_dir().join(format!("hray-bench-{}.ppm", std::process::id()));
    println!(
        "{:<22}{:>9} {:>11} {:>7} {:>11} {:>7}",
        "scene", "2005", "1 thread", "ratio", "2 threads", "ratio"
    );
    for (name, original) in ORIGINAL {
        let mut times = [Vec::new(), Vec::new()];
        for _ in 0..runs {
            for (times, threads) in times.iter_mut().zip(["1", "2"]) {
                times.push(time(&hray, &classic, name, threads, &output)?);
            }
        }
        let [one, two] = times.map(median);
        println!(
            "{name:<22}{original:>7.2} s {:>8.1} ms {:>6.0}x {:>8.1} ms {:>6.0}x",
            one * 1e3,
            original / one,
            two * 1e3,
            original / two,
        );
    }
    // Only a leftover in the folder for such; nothing depends on its removal.
    let _ = std::fs::remove_file(&output);
    Ok(())
}

/// Builds the benchmark of rays against meshes (`crates/rays-bench`) for release and runs it.
///
/// # Errors
/// Where it does not build, or fails.
pub fn rays(arguments: &[&str]) -> Result<()> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let status = Command::new(cargo)
        .args(["run", "--quiet", "--release", "--package", "rays-bench", "--"])
        .args(arguments)
        .status()
        .map_err(|e| format!("cannot run cargo: {e}"))?;
    if status.success() { Ok(()) } else { Err("the benchmark of rays failed".into()) }
}

fn time(hray: &Path, classic: &Path, name: &str, threads: &str, output: &Path) -> Result<Duration> {
    // A new file each time: replacing one makes some file systems write it out at once.
    let _ = std::fs::remove_file(output);
    let start = Instant::now();
    let status = Command::new(hray)
        .arg(classic.join("scenes").join(format!("{name}.hry")))
        .arg(output)
        .args(["--threads", threads, "--noise-tables"])
        .arg(classic.join("noise-tables.json"))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|e| format!("cannot run {}: {e}", hray.display()))?;
    let elapsed = start.elapsed();
    if status.success() { Ok(elapsed) } else { Err(format!("{name} does not render")) }
}

/// The median in seconds.
fn median(mut times: Vec<Duration>) -> f64 {
    times.sort_unstable();
    times.get(times.len() / 2).map_or(f64::NAN, Duration::as_secs_f64)
}
