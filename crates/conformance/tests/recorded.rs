//! Pictures whose bytes are known: those of 2005, and the project's own examples.

use conformance::{converted_p3_hash, p3_hash, recorded};
use hray::NoiseTables;
use std::path::{Path, PathBuf};

fn check(recorded: &[(String, String)], scenes: &Path, tables: &NoiseTables) -> usize {
    let mut failures = Vec::new();
    for (name, expected) in recorded {
        let scene = scenes.join(format!("{name}.hry"));
        let found = p3_hash(&scene, tables);
        if found.as_ref() != Ok(expected) {
            failures.push(format!("{name}: {found:?} instead of {expected}"));
        }
        let converted = is_classic(&scene).then(|| converted_p3_hash(&scene, tables));
        if converted.as_ref().is_some_and(|found| !matches!(found, Ok(Some(hash)) if hash == expected)) {
            failures.push(format!("{name} in hry: {converted:?} instead of {expected}"));
        }
    }
    assert!(failures.is_empty(), "{} pictures differ:\n{}", failures.len(), failures.join("\n"));
    recorded.len()
}

fn is_classic(scene: &Path) -> bool {
    let file = hray::SceneFile::read(&hray::Input::File(scene.to_owned()), &hray::LoadOptions::default());
    file.is_ok_and(|file| file.language() == hray::Language::Classic)
}

/// The 18 scenes of the original distribution, with its own noise tables. They are not part of the project:
/// `HRAY_CLASSIC` names the folder that holds them.
#[test]
fn the_pictures_of_2005_are_reproduced_byte_for_byte() {
    let Some(classic) = std::env::var_os("HRAY_CLASSIC").map(PathBuf::from) else {
        // Past the capture of the test harness, so that it is seen in an ordinary run.
        use std::io::Write;
        let _ = writeln!(
            std::io::stderr(),
            "SKIPPED: the pictures of 2005 (set HRAY_CLASSIC to the folder of the original's scenes)"
        );
        return;
    };
    let tables = hray::read_noise_tables(&classic.join("noise-tables.json")).unwrap();
    assert_eq!(check(&recorded(&classic).unwrap(), &classic.join("scenes"), &tables), 18);
}

#[test]
fn the_examples_are_as_recorded() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let count = check(&recorded(&examples).unwrap(), &examples, &NoiseTables::default());
    let paths = std::fs::read_dir(&examples).unwrap().map(|entry| entry.unwrap().path());
    let scenes = paths.filter(|path| path.extension().is_some_and(|e| e == "hry") && is_classic(path));
    assert_eq!(scenes.count(), count, "every classic example has its hash recorded (cargo xtask bless)");
}
