//! `hray check`, `info`, `completions` and `man`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, SCENE};

#[test]
fn check_counts_what_it_finds_in_all_files() {
    let folder = Folder::new();
    folder.run("check scene.hry").says(0, &["checked 1 file: no errors, no warnings\n"]);
    folder.write("bright.hry", SCENE.replace("(0.2,0.3,0.5)", "(2.0,0.3,0.5)"));
    folder.write("wrong.hry", SCENE.replace("sphere", "spere").replace("plane", "plain"));
    let outcome = folder.run("check scene.hry bright.hry wrong.hry none.hry");
    outcome.says(
        1,
        &["checked 4 files: 3 errors, 1 warning\n", "bright.hry:3:", "wrong.hry:5:", "wrong.hry:6:"],
    );
    outcome.says(1, &["`none.hry`: there is no such file", "help: "]);
    assert!(outcome.stdout.is_empty());
    folder.run("check bright.hry").says(0, &["1 warning\n"]);
    folder.run("check bright.hry --deny warnings").says(1, &["1 error, no warnings\n"]);
    folder.run("check bright.hry --allow warnings").says(0, &["no errors, no warnings\n"]);
    folder.run("check").says(2, &["<INPUT>"]);
    assert_eq!(folder.run_with_input("check -", SCENE.as_bytes()).code, Some(0));
    assert_eq!(folder.names(), ["bright.hry", "scene.hry", "wrong.hry"]);
}

#[test]
fn info_shows_what_the_window_of_2005_showed_and_more() {
    let folder = Folder::new();
    let outcome = folder.run("info scene.hry");
    outcome.says(0, &[]);
    assert_eq!(
        outcome.stdout(),
        "resolution   40 x 30 (1,200 pixels)\n\
         depth        6\n\
         camera       eye (0, 0, 150), window 100 x 75\n\
         background   (0.2, 0.3, 0.5)\n\
         objects      2 (1 sphere, 1 plane)\n\
         lights       2 (1 point, 1 ambient)\n\
         materials    2 reflective, 1 transparent\n\
         textures     1 perlinTurb, 1 solid\n\
         spheres in   (-15, -25, -75) to (35, 25, -25)\n\
         worst case   254 rays a sample: objects that reflect and transmit double the rays with every level of \
         depth\n\
         warnings     none\n"
    );
    folder.write("wrong.hry", "renderDescr");
    folder.run("info wrong.hry").says(1, &["error", "wrong.hry:1:"]);
}

#[test]
fn info_speaks_json() {
    let folder = Folder::new();
    let outcome = folder.run("info scene.hry --json");
    let value: serde_json::Value = serde_json::from_str(outcome.stdout()).unwrap();
    assert_eq!(value["width"], 40);
    assert_eq!(value["objects"]["spheres"], 1);
    assert_eq!(value["camera"]["eye"], serde_json::json!([0.0, 0.0, 150.0]));
    assert_eq!(value["materials"]["textures"]["perlinTurb"], 1);
    assert_eq!(value["worst_case"]["branches"], 2);
    assert_eq!((&value["name"], &value["warnings"]), (&"scene.hry".into(), &0.into()));
}

#[test]
fn completions_and_man_pages_come_from_the_command_line_itself() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let outcome = folder.run(&format!("completions {shell}"));
        assert!(outcome.stdout().contains("region"), "{shell}");
    }
    folder.run("completions tcsh").says(2, &["possible values: bash"]);
    assert!(folder.run("man").stdout().contains(".TH hray 1"));
    let render = folder.run("man render");
    assert!(render.stdout().contains(".TH hray-render 1") && render.stdout().contains("region"));
    folder.run("man nothing").says(2, &["there is no command `nothing`; there are render, check"]);
}

#[test]
fn help_and_version_are_what_was_asked_for() {
    let folder = Folder::new();
    for arguments in ["--help", "-h", "help", "help render", "render --help", "check --help"] {
        let outcome = folder.run(arguments);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""), "{arguments}");
        assert!(outcome.stdout().contains("Usage: hray"), "{arguments}");
    }
    assert!(folder.run("check --help").stdout().contains("light-inside-sphere"));
    assert!(folder.run("--version").stdout().starts_with("hray 0."));
}
