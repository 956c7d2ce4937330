//! `hray INPUT.hry OUTPUT.ppm`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, decoded_text};

#[test]
fn the_picture_and_the_two_lines_are_those_of_2005() {
    let folder = Folder::new();
    let outcome = folder.run("scene.hry scene.ppm");
    outcome.says(0, &[]);
    assert_eq!(
        outcome.stdout(),
        "Image output written to scene.ppm in PPM format\nTime needed to render the image: 0m00s\n"
    );
    let bytes = folder.read("scene.ppm");
    assert!(bytes.starts_with(b"P3\n40 30\n255\n") && bytes.ends_with(b" "));
    assert_eq!(bytes.iter().filter(|byte| **byte == b'\n').count(), 3);
    let (width, height, pixels) = decoded_text(&bytes);
    assert_eq!((width, height, pixels.len()), (40, 30, 40 * 30 * 3));
    assert_eq!(folder.names(), ["scene.hry", "scene.ppm"]);
}

#[test]
fn it_takes_threads_tables_and_levels() {
    let folder = Folder::new();
    folder.run("scene.hry one.ppm --threads 1").says(0, &[]);
    folder.run("--threads 3 scene.hry three.ppm").says(0, &[]);
    assert_eq!(folder.read("one.ppm"), folder.read("three.ppm"));
    folder.write("tables.json", "{}");
    folder.run("scene.hry a.ppm --noise-tables tables.json").says(
        1,
        &["noise tables `tables.json` cannot be used: line 1, column 2: ", "`permutation` is missing"],
    );
    folder.write("bright.hry", common::SCENE.replace("(0.2,0.3,0.5)", "(2.0,0.3,0.5)"));
    folder.run("bright.hry a.ppm").says(0, &["warning", "component-range"]);
    assert!(folder.read("a.ppm").starts_with(b"P3\n40 30\n255\n510 76 128 "));
    let quiet = folder.run("bright.hry a.ppm --allow component-range");
    assert_eq!((quiet.code, quiet.stderr.as_str()), (Some(0), ""));
    folder.run("bright.hry b.ppm --deny warnings").says(1, &["error", "component-range"]);
    assert!(!folder.path("b.ppm").exists());
}

#[test]
fn a_name_of_another_format_is_refused_with_the_command_that_writes_it() {
    let folder = Folder::new();
    folder.run("scene.hry scene.png").says(2, &["`hray render scene.hry -o scene.png`"]);
    folder.run("scene.hry -").says(2, &["`hray render scene.hry -o - --format ppm-ascii`"]);
    folder.write("other.hry", "mine");
    folder.run("scene.hry other.hry").says(2, &["`other.hry` is named as a scene"]);
    assert_eq!(folder.read("other.hry"), b"mine");
    assert_eq!(folder.names(), ["other.hry", "scene.hry"]);
    // Any other name will do, as in 2005.
    folder.run("scene.hry picture").says(0, &[]);
    assert!(folder.read("picture").starts_with(b"P3\n"));
}

#[test]
fn a_command_with_a_typo_is_not_taken_for_a_scene() {
    let folder = Folder::new();
    folder.run("rendr scene.hry").says(2, &["did you mean `hray render scene.hry`?"]);
    folder.run("chekc a b").says(2, &["did you mean `hray check a b`?"]);
    folder.run("chek").says(2, &["did you mean `hray check ...`?"]);
    folder.run("scene.hry").says(2, &["takes two", "`hray render scene.hry`"]);
    folder.run("").says(2, &["Usage: hray"]);
    folder.run("--threads 2").says(2, &["name the scene", "Usage: hray"]);
    folder.run("a b c").says(2, &["takes two names"]);
    folder.run("nothing.hry a.ppm").says(1, &["cannot read `nothing.hry`: there is no such file"]);
    // A file may have the name all the same.
    folder.write("rendr", common::SCENE);
    folder.run("rendr a.ppm").says(0, &[]);
}

#[test]
fn options_of_render_are_answered_with_the_line_that_takes_them() {
    let folder = Folder::new();
    for option in
        ["--samples 4", "--size 4x3", "--depth -1", "--region 0,0,1,1", "--quiet", "-q", "--format ppm"]
    {
        let name = option.split(' ').next().unwrap();
        let no = format!("the classic form takes no {name}; ");
        let line = format!("`hray render a.hry -o o.ppm {name} ...`");
        folder.run(&format!("a.hry o.ppm {option}")).says(2, &[&no, &line]);
        folder.run(&format!("{option} a.hry o.ppm")).says(2, &[&no, &line]);
    }
    folder.run("a.hry -o o.ppm").says(2, &["takes no -o; use `hray render a.hry -o o.ppm`"]);
    folder.run("a.hry o.ppm --nothing").says(2, &["unexpected argument '--nothing'"]);
}
