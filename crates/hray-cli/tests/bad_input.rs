//! Whatever the input, there is an error message and an exit code, and nothing is lost.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, Outcome, SCENE};
use std::io::Write;
use std::process::Stdio;

#[test]
fn an_older_picture_survives_what_is_wrong_with_the_scene() {
    let folder = Folder::new();
    let scenes: [(&str, Vec<u8>, &str); 9] = [
        ("empty", Vec::new(), "error"),
        ("spaces", b" \n\n".to_vec(), "error"),
        (
            "not-utf8",
            SCENE.replace("objects", "obj\u{e9}cts").replace('\u{e9}', "\u{0}").into_bytes(),
            "error",
        ),
        ("latin1", [SCENE.as_bytes(), b"\xe9"].concat(), "not UTF-8"),
        ("large", SCENE.replace("(40,30)", "(2000000000,2000000000)").into_bytes(), "2000000000"),
        ("deep", SCENE.replace(") 6 [", ") 10001 [").into_bytes(), "10001"),
        ("deeper", SCENE.replace(") 6 [", ") -2 [").into_bytes(), "-2"),
        ("octaves", SCENE.replace(" 3 7.5", " -3 7.5").into_bytes(), "-3"),
        (
            "brackets",
            "renderDescr ( resolution ".bytes().chain(std::iter::repeat_n(b'(', 1 << 20)).collect(),
            "error",
        ),
    ];
    folder.write("old.png", "old");
    for (name, scene, said) in scenes {
        folder.write("wrong.hry", scene);
        folder.run("render wrong.hry -o old.png").says(1, &["error", said]);
        folder.run("render wrong.hry -o new.png").says(1, &["error", "wrong.hry"]);
        assert_eq!(folder.read("old.png"), b"old", "{name}");
        assert_eq!(folder.names(), ["old.png", "scene.hry", "wrong.hry"], "{name}");
    }
}

#[test]
fn what_is_no_file_is_called_by_its_name() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("dir")).unwrap();
    for form in ["render dir -o a.png", "dir a.ppm", "check dir", "info dir"] {
        folder.run(form).says(1, &["cannot read `dir`: it is a directory"]);
    }
    for form in ["render none.hry", "none.hry a.ppm", "check none.hry", "info none.hry"] {
        folder.run(form).says(1, &["cannot read `none.hry`: there is no such file"]);
    }
    folder.run("render scene.hry/x").says(1, &["cannot read `scene.hry/x`"]);
    folder.run("render no/x.hry").says(1, &["cannot read `no/x.hry`: there is no such file"]);
    folder.run(&format!("render {}.hry", "x".repeat(300))).says(1, &["cannot read `xxx"]);
    folder.run("render scene.hry --noise-tables dir").says(1, &["cannot read `dir`: it is a directory"]);
    assert_eq!(folder.names(), ["dir", "scene.hry"]);
}

#[test]
fn a_place_that_cannot_be_written_is_refused_before_rendering() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("dir")).unwrap();
    // It would never end.
    folder.write("endless.hry", common::ENDLESS);
    folder
        .run("render endless.hry -o dir --format png")
        .says(1, &["cannot write to `dir`: it is a directory"]);
    folder.run("render endless.hry -o no/a.png").says(1, &["there is no directory `no`; create it first"]);
    folder.run("endless.hry no/a.ppm").says(1, &["there is no directory `no`"]);
    assert_eq!(folder.names(), ["dir", "endless.hry", "scene.hry"]);
}

#[test]
fn an_endless_pipe_ends() {
    let folder = Folder::new();
    let mut child = folder
        .command()
        .args(["render", "-", "-o", "a.png"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let block = [b'('; 1 << 20];
    let mut blocks = 0;
    while pipe.write_all(&block).is_ok() {
        blocks += 1;
        assert!(blocks < 1000, "it reads without end");
    }
    let outcome = Outcome::of(child.wait_with_output().unwrap());
    outcome.says(1, &["cannot read the standard input: it is longer than 256 MiB"]);
    assert_eq!(folder.names(), ["scene.hry"]);
}

#[test]
fn strange_arguments_are_only_wrong() {
    let folder = Folder::new();
    folder.run("--nothing").says(2, &["unexpected argument"]);
    folder.run("render").says(2, &["<INPUT>"]);
    folder
        .run("render scene.hry extra")
        .says(2, &["unexpected argument `extra`; to name the picture write `-o extra`"]);
    folder.run("render a.hry x.png").says(2, &["to name the picture write `-o x.png`"]);
    folder.run("render a.hry b.hry").says(2, &["call hray for each"]);
    folder.run("render scene.hry --region -1,0,1,1").says(2, &["a region is four whole numbers"]);
    folder.run("render scene.hry --samples -1").says(2, &["a number of samples goes from"]);
    folder.run("render scene.hry --threads -1").says(2, &["a number of threads goes from"]);
    folder.run("render scene.hry --size -4x3").says(2, &["--size"]);
    folder.run("render scene.hry --size").says(2, &["--size"]);
    folder
        .run("--threads 2 render scene.hry")
        .says(2, &["options come after the command: `hray render scene.hry [OPTIONS]`"]);
    let empty = folder.command().args(["render", ""]).output().unwrap();
    Outcome::of(empty).says(2, &["a value is required for"]);
    let odd = folder.command().args(["render", "a\u{1b}[2J\n.hry", "-o", "a.png"]).output().unwrap();
    let odd = Outcome::of(odd);
    odd.says(1, &["cannot read `a\\u{1b}[2J\\n.hry`"]);
}

#[cfg(unix)]
#[test]
fn names_need_not_be_utf8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new();
    let name = OsStr::from_bytes(b"\xff.hry");
    std::fs::write(folder.path("x").with_file_name(name), SCENE).unwrap();
    let run = |arguments: &[&OsStr]| Outcome::of(folder.command().args(arguments).output().unwrap());
    run(&[OsStr::new("render"), name]).says(0, &[]);
    run(&[name, OsStr::from_bytes(b"\xfe.ppm")]).says(0, &[]);
    run(&[OsStr::from_bytes(b"\xfd"), OsStr::new("a.ppm")]).says(1, &["there is no such file"]);
    run(&[OsStr::new("render"), name, OsStr::new("--size"), OsStr::from_bytes(b"\xfd")]).says(2, &["UTF-8"]);
    run(&[OsStr::new("render"), name, OsStr::new("--format"), OsStr::from_bytes(b"\xfd")])
        .says(2, &["--format"]);
}
