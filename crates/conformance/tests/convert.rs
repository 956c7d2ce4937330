//! Classic scenes in hry are the same scenes.

use conformance::{engine_colors, random, recorded};
use hray::{Description, LintLevels, NoiseTables, SceneFile};
use std::path::{Path, PathBuf};

/// Converts and loads; the text, and what came back.
fn through_hry(description: &Description) -> Result<(String, Description), String> {
    let text = hray::convert(description).ok_or("it cannot be converted")?;
    let file = SceneFile::parse("converted.hry", text.clone().into_bytes(), &LintLevels::default());
    match file.description() {
        Some(back) => Ok((text, back.clone())),
        None => Err(format!("{}\n{text}", file.report(false))),
    }
}

/// Whether the scene comes back equal, and its picture with every bit.
fn check(description: &Description, tables: &NoiseTables, renders: bool) -> Result<(), String> {
    let (text, back) = through_hry(description)?;
    if back != *description {
        return Err(format!("another scene: {back:#?}\ninstead of {description:#?}\n{text}"));
    }
    if !renders {
        return Ok(());
    }
    let bits = |description| {
        let colors = engine_colors(description, tables, 2)?;
        Ok::<_, String>(colors.into_iter().map(|c| c.to_array().map(f64::to_bits)).collect::<Vec<_>>())
    };
    if bits(description)? == bits(&back)? { Ok(()) } else { Err(format!("another picture:\n{text}")) }
}

#[test]
fn random_scenes_come_back_equal() {
    let tables = NoiseTables::default();
    let failures: Vec<String> = (0..600)
        .filter_map(|seed| {
            let description = random::description(seed)?;
            check(&description, &tables, seed % 4 == 0).err().map(|error| format!("seed {seed}: {error}"))
        })
        .collect();
    assert!(failures.is_empty(), "{} scenes differ, the first:\n{}", failures.len(), failures[0]);
}

fn scenes_of(folder: &Path, scenes: &Path, tables: &NoiseTables) -> usize {
    let names = recorded(folder).unwrap();
    let mut count = 0;
    for (name, _) in names {
        let path = scenes.join(format!("{name}.hry"));
        let text = std::fs::read_to_string(&path).unwrap();
        if !text.trim_start().starts_with("renderDescr") {
            continue;
        }
        let mut description = hray::load(&path).unwrap();
        // At the same size in both, and small enough for a test.
        description.resolution = hray::Resolution::new(64, 48).unwrap();
        check(&description, tables, true).unwrap_or_else(|error| panic!("{name}: {error}"));
        count += 1;
    }
    count
}

#[test]
fn the_scenes_of_2005_come_back_equal() {
    let Some(classic) = std::env::var_os("HRAY_CLASSIC").map(PathBuf::from) else { return };
    let tables = hray::read_noise_tables(&classic.join("noise-tables.json")).unwrap();
    assert_eq!(scenes_of(&classic, &classic.join("scenes"), &tables), 18);
}

#[test]
fn the_classic_examples_come_back_equal() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    assert!(scenes_of(&examples, &examples, &NoiseTables::default()) > 0);
}
