//! Scenes of both languages, by way of the facade.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]
#![allow(clippy::panic, reason = "tests may fail loudly")]

use hray::{
    Formatted, Input, InputError, Language, Light, Limits, LintLevels, LoadOptions, SceneFile, format_scene,
};
use std::fs;

const MOVING: &str = "height = 4
scene time = {
  lights = [ point { position = (0, height, time) } ],
  objects = [ sphere {} ],
}
";

fn light_of(file: &SceneFile) -> [f64; 3] {
    let description = file.description().unwrap_or_else(|| panic!("{}", file.report(false)));
    match description.scene.lights[..] {
        [Light::Point { position, .. }] => position.to_array(),
        _ => panic!("{:?}", description.scene.lights),
    }
}

fn with(options: &LoadOptions) -> SceneFile {
    SceneFile::parse_with("moving.hry", MOVING.into(), options).unwrap()
}

#[test]
fn a_scene_is_shown_at_any_moment_without_reading_it_again() {
    let file = with(&LoadOptions { time: 0.5, ..LoadOptions::default() });
    assert_eq!((file.language(), file.is_animated()), (Language::Hry, true));
    assert_eq!(light_of(&file), [0.0, 4.0, 0.5]);
    assert_eq!(light_of(&file.at(2.0)), [0.0, 4.0, 2.0]);
    let mut moments = file.moments();
    for time in [1.0, -3.0, 1.0] {
        let file = moments.at(time);
        assert_eq!(light_of(&file), [0.0, 4.0, time]);
        assert_eq!(file.description().unwrap().scene.time, time);
    }
}

#[test]
fn settings_and_budgets_hold_at_every_moment() {
    let set = vec![("height".to_owned(), "1 + 1".to_owned())];
    let file = with(&LoadOptions { set, ..LoadOptions::default() });
    assert_eq!((light_of(&file), light_of(&file.at(7.0))), ([0.0, 2.0, 0.0], [0.0, 2.0, 7.0]));
    let limits = Limits { steps: 1000, ..Limits::default() };
    let file = with(&LoadOptions { limits, ..LoadOptions::default() });
    let mut moments = file.moments();
    // Each moment has its own steps.
    assert!((0..1000).all(|moment| moments.at(f64::from(moment)).errors() == 0));
    let limits = Limits { steps: 2, ..Limits::default() };
    assert_eq!(with(&LoadOptions { limits, ..LoadOptions::default() }).errors(), 1);
}

#[test]
fn a_scene_in_memory_reads_files_only_where_a_root_is_given() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("colors.hry"), "warm = gold\n").unwrap();
    let text = "import \"colors.hry\"\nscene = { background = warm, objects = [ sphere {} ], lights = [ ambient {} ] }\n";
    let file = SceneFile::parse("memory", text.into(), &LintLevels::default());
    assert!(file.report(false).contains("so there is no folder to read it from"), "{}", file.report(false));
    let root = Some(folder.path().to_owned());
    let options = LoadOptions { root, ..LoadOptions::default() };
    let file = SceneFile::parse_with("memory", text.into(), &options).unwrap();
    assert_eq!(file.report(false), "");
    assert_eq!(file.sources().files().len(), 2);
    let options = LoadOptions { root: Some(folder.path().join("none")), ..LoadOptions::default() };
    assert!(SceneFile::parse_with("memory", text.into(), &options).is_err());

    let scene = folder.path().join("scene.hry");
    fs::write(&scene, text).unwrap();
    assert!(hray::load(&scene).is_ok());
    let elsewhere = tempfile::tempdir().unwrap();
    let options = LoadOptions { root: Some(elsewhere.path().to_owned()), ..LoadOptions::default() };
    let error = SceneFile::read(&Input::File(scene), &options).unwrap_err();
    assert!(matches!(error, InputError::OutsideRoot { .. }), "{error}");
}

#[test]
fn errors_know_their_files() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("colors.hry"), "-- A comment.\nwarm = glod\n").unwrap();
    let scene = folder.path().join("scene.hry");
    fs::write(&scene, "import \"colors.hry\"\nscene = { background = warm, objects = [ sphere {} ], lights = [ ambient {} ] }\n").unwrap();
    let file = SceneFile::read(&Input::File(scene), &LoadOptions::default()).unwrap();
    let findings = file.findings().0;
    let [finding] = &findings[..] else { panic!("{}", file.report(false)) };
    let place = &finding.labels[0].place;
    assert!(place.file.ends_with("colors.hry"), "{place:?}");
    assert_eq!((place.line, place.column, place.start, place.end), (2, 8, 21, 25));
    assert!(file.report(false).contains("colors.hry:2:8"), "{}", file.report(false));
}

#[test]
fn only_hry_has_a_layout() {
    assert!(matches!(format_scene("a", b"renderDescr ( resolution"), Formatted::Classic));
    assert!(matches!(format_scene("a", b"scene = (\n"), Formatted::Errors(_)));
    assert!(matches!(format_scene("a", b"\xff"), Formatted::Errors(_)));
    let Formatted::Text(once) = format_scene("a", b"scene={depth=3}") else { panic!() };
    let Formatted::Text(twice) = format_scene("a", once.as_bytes()) else { panic!() };
    assert_eq!(once, twice);
}
