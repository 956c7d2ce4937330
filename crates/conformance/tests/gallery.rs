//! The scenes in hry that the project shows: each is as a user would want to find it, and its picture is the recorded one,
//! to the byte, at a small size. `HRAY_BLESS=1` records them anew.

use hray::{Control, Input, Language, LoadOptions, Options, PictureFormat, Resolution, SceneFile};
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};

/// Pixels across, and samples a pixel, of the recorded pictures.
const WIDTH: u32 = 160;
const SAMPLES: NonZeroU32 = NonZeroU32::new(4).unwrap();

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The scenes in hry of a folder, in the order of their names. Files that others import say nothing to render.
fn scenes(folder: &str) -> Vec<(PathBuf, SceneFile)> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> =
        entries.filter(|path| path.extension().is_some_and(|e| e == "hry")).collect();
    paths.sort();
    let read = |path: PathBuf| {
        let file = SceneFile::read(&Input::File(path.clone()), &LoadOptions::default()).unwrap();
        (path, file)
    };
    let hry = paths.into_iter().filter(|path| path.with_extension("png").exists()).map(read);
    hry.filter(|(_, file)| file.language() == Language::Hry).collect()
}

fn check(folder: &str, at_least: usize) {
    let scenes = scenes(folder);
    assert!(scenes.len() >= at_least, "{} scenes in {folder}", scenes.len());
    let mut failures = Vec::new();
    for (path, file) in scenes {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        assert_eq!(file.report(false), "", "{name} has something to complain about");
        let text = std::fs::read_to_string(&path).unwrap();
        match hray::format_scene(&name, text.as_bytes()) {
            hray::Formatted::Text(formatted) => {
                assert_eq!(formatted, text, "{name}: hray fmt lays it out otherwise")
            }
            other => panic!("{name}: {other:?}"),
        }

        let description = file.description().unwrap();
        let whole = description.resolution;
        let height = (f64::from(WIDTH) * f64::from(whole.height()) / f64::from(whole.width())).round();
        let size = Resolution::new(WIDTH.into(), height as i64).unwrap();
        let options = Options { size: Some(size), samples: Some(SAMPLES), ..Options::default() };
        let format = PictureFormat::Png;
        let (picture, _) = hray::render_to_bytes(description, &options, format, &Control::new()).unwrap();
        let recorded = root().join("crates/conformance/pictures").join(format!("{name}.png"));
        if std::env::var_os("HRAY_BLESS").is_some() {
            std::fs::write(&recorded, &picture).unwrap();
        } else if std::fs::read(&recorded).unwrap_or_default() != picture {
            failures.push(name);
        }
    }
    assert!(failures.is_empty(), "other pictures than recorded: {failures:?}");
}

#[test]
fn the_examples_in_hry_are_as_recorded() {
    check("examples", 12);
}

#[test]
fn the_steps_of_the_tutorial_are_as_recorded() {
    check("docs/src/tutorial", 10);
}
