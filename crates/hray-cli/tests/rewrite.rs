//! `hray fmt` and `hray convert`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, SCENE};

const UNTIDY: &str = "scene={objects=[sphere{}],lights=[ambient{intensity=1}]}\n";

#[test]
fn a_classic_scene_becomes_one_in_hry_with_the_same_picture() {
    let folder = Folder::new();
    folder.run("convert scene.hry -o new.hry").says(0, &[]);
    let printed = folder.run("convert scene.hry");
    assert_eq!(printed.stdout, folder.read("new.hry"));
    folder.run("check new.hry --deny warnings").says(0, &["no errors, no warnings"]);
    for name in ["scene", "new"] {
        folder.run(&format!("{name}.hry {name}.ppm")).says(0, &[]);
        folder.run(&format!("render {name}.hry -o {name}.png -q")).says(0, &[]);
    }
    assert_eq!(folder.read("scene.ppm"), folder.read("new.ppm"));
    assert_eq!(folder.read("scene.png"), folder.read("new.png"));
    let piped = folder.run_with_input("convert -", SCENE.as_bytes());
    assert_eq!(piped.stdout, printed.stdout);
}

#[test]
fn what_cannot_be_converted_is_refused() {
    let folder = Folder::new();
    folder.write("new.hry", UNTIDY);
    folder.run("convert new.hry").says(1, &["`new.hry` is a scene in hry already"]);
    folder.run("convert scene.hry -o scene.hry").says(2, &["would replace the old one"]);
    folder.run("convert scene.hry new.hry").says(2, &["to name the new scene write `-o new.hry`"]);
    folder.run("convert none.hry").says(1, &["there is no such file"]);
    folder.run("convert scene.hry -o no/new.hry").says(1, &["there is no directory `no`"]);
    folder.write("wrong.hry", SCENE.replace("sphere", "spere"));
    folder.run("convert wrong.hry -o new.hry").says(1, &["wrong.hry:5:"]);
    assert_eq!(folder.read("new.hry"), UNTIDY.as_bytes());
    folder.write("inside-out.hry", SCENE.replace("sphere 25.0", "sphere -25.0"));
    let inside_out = folder.run("convert inside-out.hry");
    inside_out.says(0, &["sphere-radius"]);
    assert!(inside_out.stdout().contains("radius = -25,"), "{}", inside_out.stdout());
}

#[test]
fn files_are_laid_out_only_where_that_changes_them() {
    let folder = Folder::new();
    folder.write("a.hry", UNTIDY);
    let outcome = folder.run("fmt --check a.hry");
    outcome.says(1, &["1 of 1 file is laid out differently"]);
    assert_eq!((outcome.stdout(), folder.read("a.hry")), ("a.hry\n", UNTIDY.as_bytes().to_vec()));
    folder.run("fmt a.hry").says(0, &[]);
    let tidy = folder.read("a.hry");
    assert_ne!(tidy, UNTIDY.as_bytes());
    let time = || std::fs::metadata(folder.path("a.hry")).unwrap().modified().unwrap();
    let before = time();
    folder.run("fmt a.hry").says(0, &[]);
    assert_eq!((time(), folder.read("a.hry")), (before, tidy.clone()));
    folder.run("fmt --check a.hry").says(0, &[]);
    let piped = folder.run_with_input("fmt -", UNTIDY.as_bytes());
    assert_eq!((piped.code, piped.stdout), (Some(0), tidy));
    let checked = folder.run_with_input("fmt - --check", UNTIDY.as_bytes());
    assert_eq!((checked.code, checked.stdout()), (Some(1), "<standard input>\n"));
}

#[test]
fn what_cannot_be_laid_out_stays_as_it_is() {
    let folder = Folder::new();
    folder.run("fmt scene.hry").says(1, &["`scene.hry` is a classic scene", "hray convert"]);
    folder.write("wrong.hry", "scene = {\n");
    folder.write("a.hry", UNTIDY);
    folder
        .run("fmt wrong.hry none.hry a.hry")
        .says(1, &["wrong.hry:1:", "`none.hry`", "2 files could not be laid out"]);
    assert_eq!(folder.read("wrong.hry"), b"scene = {\n");
    assert_ne!(folder.read("a.hry"), UNTIDY.as_bytes());
    folder.run("fmt").says(2, &["<FILE>"]);
}

#[test]
fn what_convert_writes_is_laid_out_already() {
    let folder = Folder::new();
    folder.run("convert scene.hry -o new.hry").says(0, &[]);
    folder.run("fmt --check new.hry").says(0, &[]);
}
