//! An explained pixel has the colour of a render, to the bit, and its parts add up to it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

use conformance::random;
use hray::{
    Control, Description, ExplainedHit, Followed, Input, Integrator, LoadOptions, NoiseTables, Options,
    PixelExplanation, Reach, Resolution, Rgb, SceneFile, explain_pixel, render_to_memory,
};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};

fn same(a: Rgb, b: Rgb) -> bool {
    let mut pairs = a.to_array().into_iter().zip(b.to_array());
    pairs.all(|(a, b)| a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan()))
}

/// Explains every `step`th pixel, and compares with the render. Returns how many shadows, depth limits and rays were seen.
fn check(name: &str, description: &Description, options: &Options, step: usize) -> [usize; 3] {
    let control = Control::new();
    let (picture, _) = render_to_memory(description, options, &control).unwrap();
    let mut counts = [0; 3];
    for (i, rendered) in picture.pixels().iter().enumerate().step_by(step) {
        let (x, y) = (i as u32 % picture.width(), i as u32 / picture.width());
        let found = explain_pixel(description, options, x, y, &control)
            .unwrap_or_else(|error| panic!("{name} ({x}, {y}): {error}"));
        assert!(same(found.color, *rendered), "{name} ({x}, {y}): {:?} instead of {rendered:?}", found.color);
        if found.samples == 1 && !found.rays.is_empty() {
            assert!(same(found.rays[0].color, *rendered), "{name} ({x}, {y})");
        }
        let seen: u32 = found.seen.iter().map(|seen| seen.samples).sum();
        assert!(seen == found.samples || found.rays.is_empty(), "{name} ({x}, {y}): {:?}", found.seen);
        adds_up(name, description, &found);
        let hits = || found.rays.iter().filter_map(|ray| ray.hit.as_ref());
        let is_dark = |light: &&hray::LightPart| matches!(light.reach, Reach::Shadowed { .. });
        counts[0] += hits().flat_map(|hit| &hit.lights).filter(is_dark).count();
        counts[1] += hits().filter(|h| [h.mirrored, h.refracted].contains(&Followed::TooDeep)).count();
        counts[2] += found.rays.len();
    }
    counts
}

/// The same sums as the explanation has made, from what it tells.
fn adds_up(name: &str, description: &Description, found: &PixelExplanation) {
    for (index, ray) in found.rays.iter().enumerate() {
        assert!(ray.parent.is_none_or(|parent| parent < index));
        let Some(hit) = &ray.hit else { continue };
        let mut sum = Rgb::BLACK;
        for light in hit.lights.iter().rev() {
            assert!(
                same(light.contribution, light.diffuse + light.highlight) || light.highlight == Rgb::BLACK
            );
            if matches!(light.reach, Reach::Shadowed { .. }) {
                assert_eq!(light.contribution, Rgb::BLACK);
            }
            sum = sum + light.contribution;
        }
        sum = sum + hit.glow;
        let below = found.rays.iter().filter(|below| below.parent == Some(index));
        let followed = [hit.mirrored, hit.refracted].iter().filter(|f| **f == Followed::Yes).count();
        if found.omitted > 0 {
            continue;
        }
        assert_eq!(below.clone().count(), followed, "{name}");
        for below in below {
            sum = sum + below.color * below.weight;
        }
        let zero = |color: Rgb| Rgb::new(color.r + 0.0, color.g + 0.0, color.b + 0.0);
        assert!(same(zero(sum), zero(hit.sum)), "{name}: {sum:?} instead of {:?}", hit.sum);
        facing(description, hit);
    }
}

/// By the exact rules no light comes from behind.
fn facing(description: &Description, hit: &ExplainedHit) {
    if description.integrator == Integrator::Classic {
        let behind = hit.lights.iter().filter(|light| light.reach == Reach::Behind);
        behind.for_each(|light| assert_eq!(light.contribution, Rgb::BLACK));
    }
}

#[test]
fn random_scenes_by_both_rules() {
    let mut counts = [0; 3];
    for seed in 0..400 {
        let Some(mut description) = random::description(seed) else { continue };
        for integrator in [Integrator::Classic2005, Integrator::Classic] {
            description.integrator = integrator;
            let found = check(&format!("seed {seed}"), &description, &Options::default(), 37);
            counts.iter_mut().zip(found).for_each(|(count, found)| *count += found);
        }
    }
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}

fn scenes(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|e| e == "hry")).collect();
    paths.sort();
    paths
}

fn check_folder(folder: &Path, tables: &NoiseTables) -> usize {
    let mut checked = 0;
    for path in scenes(folder) {
        let options = LoadOptions { modules: true, ..LoadOptions::default() };
        let file = SceneFile::read(&Input::File(path.clone()), &options).unwrap();
        let Some(description) = file.description() else { continue };
        let name = path.display().to_string();
        for (size, samples, step) in [((40, 30), 1, 31), ((12, 9), 5, 23)] {
            let size = Resolution::new(size.0, size.1).ok();
            let options = Options {
                size,
                samples: NonZeroU32::new(samples),
                noise_tables: tables.clone(),
                ..Options::default()
            };
            check(&name, description, &options, step);
        }
        for i in 0..description.scene.primitives.len() {
            assert!(file.origins().object(i).is_some(), "{name}: object {i} has no place");
        }
        checked += 1;
    }
    checked
}

#[test]
fn the_examples() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    assert!(check_folder(&root.join("examples"), &NoiseTables::default()) > 20);
    assert!(check_folder(&root.join("docs/src/tutorial"), &NoiseTables::default()) > 9);
}

/// `HRAY_CLASSIC` names the folder of the original's scenes; where it is not set there is nothing to test, which the test of
/// their hashes says aloud.
#[test]
fn the_scenes_of_2005() {
    let Some(classic) = std::env::var_os("HRAY_CLASSIC").map(PathBuf::from) else { return };
    let tables = hray::read_noise_tables(&classic.join("noise-tables.json")).unwrap();
    assert_eq!(check_folder(&classic.join("scenes"), &tables), 18);
}
