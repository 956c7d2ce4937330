//! Signals, pipes, links and devices.

#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{ENDLESS, Folder, Outcome};
use std::io::Read;
use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

/// Waits until the render has begun, which is when its temporary file is there.
fn wait_for_temporary_file(folder: &Folder) {
    let start = Instant::now();
    while !folder.names().iter().any(|name| name.starts_with(".hray-")) {
        assert!(start.elapsed() < Duration::from_secs(20), "it has not begun");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn ctrl_c_stops_a_render_and_leaves_what_was_there() {
    for (arguments, output, name) in [
        (&["render", "endless.hry", "-o", "a.png"][..], "a.png", "-INT"),
        (&["render", "endless.hry", "-o", "a.bmp", "--threads", "1"][..], "a.bmp", "-TERM"),
        (&["endless.hry", "a.ppm"][..], "a.ppm", "-INT"),
    ] {
        let folder = Folder::new();
        folder.write("endless.hry", ENDLESS);
        folder.write(output, "old");
        let child =
            folder.command().args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        wait_for_temporary_file(&folder);
        std::thread::sleep(Duration::from_millis(100));
        let start = Instant::now();
        signal(&child, name);
        let outcome = Outcome::of(child.wait_with_output().unwrap());
        assert!(start.elapsed() < Duration::from_secs(5), "it took {:?} to stop", start.elapsed());
        outcome.says(130, &[&format!("interrupted: nothing was written to `{output}`")]);
        assert!(outcome.stdout.is_empty());
        assert_eq!(folder.read(output), b"old");
        assert_eq!(folder.names(), [output, "endless.hry", "scene.hry"]);
    }
}

#[test]
fn ctrl_c_stops_what_waits_for_input() {
    let folder = Folder::new();
    let mut child = folder
        .command()
        .args(["render", "-", "-o", "a.png"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(100));
    signal(&child, "-INT");
    // The input stays open meanwhile.
    assert!(!child.wait().unwrap().success());
    assert_eq!(folder.names(), ["scene.hry"]);
}

#[test]
fn a_reader_that_leaves_is_no_panic() {
    let folder = Folder::new();
    let mut child = folder
        .command()
        .args(["render", "scene.hry", "-o", "-", "--format", "ppm-ascii", "--size", "800x600"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut start = [0; 3];
    let mut pipe = child.stdout.take().unwrap();
    pipe.read_exact(&mut start).unwrap();
    drop(pipe);
    let outcome = Outcome::of(child.wait_with_output().unwrap());
    assert_eq!(&start, b"P3\n");
    outcome.says(
        1,
        &["cannot write the standard output: broken pipe; the program that was reading it has ended"],
    );

    for arguments in [&["man"][..], &["--help"], &["info", "scene.hry"], &["scene.hry", "a.ppm"]] {
        let mut child =
            folder.command().args(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        Outcome::of(child.wait_with_output().unwrap()).says(0, &[]);
    }
}

#[test]
fn a_device_stays_a_device() {
    let folder = Folder::new();
    folder.run("render scene.hry -o /dev/null").says(0, &["/dev/null: 40x30 png"]);
    folder.run("scene.hry /dev/null").says(0, &[]);
    assert!(std::fs::metadata("/dev/null").unwrap().file_type().is_char_device());
    let out = folder.run("render scene.hry -o /dev/stdout -q");
    assert!(out.stdout.starts_with(b"\x89PNG"), "{}", out.stderr);
    if Path::new("/dev/full").exists() {
        let full = "cannot write `/dev/full`: no space left on device; free some space, or write elsewhere";
        folder.run("render scene.hry -o /dev/full").says(1, &[full]);
        folder.run("scene.hry /dev/full").says(1, &[full]);
        let output = folder
            .command()
            .args(["info", "scene.hry"])
            .stdout(std::fs::File::create("/dev/full").unwrap())
            .output()
            .unwrap();
        Outcome::of(output).says(1, &["cannot write to the standard output"]);
    }
    if Path::new("/dev/zero").exists() {
        folder.run("check /dev/zero").says(1, &["cannot read `/dev/zero`: it is longer than 256 MiB"]);
        folder.run("render scene.hry --noise-tables /dev/zero").says(1, &["longer than 1 MiB"]);
    }
}

#[test]
fn a_named_pipe_is_written_to() {
    let folder = Folder::new();
    let made = Command::new("mkfifo").arg(folder.path("pipe.ppm")).status();
    if !made.is_ok_and(|status| status.success()) {
        return;
    }
    let path = folder.path("pipe.ppm");
    let reader = std::thread::spawn(move || std::fs::read(path).unwrap());
    folder.run("scene.hry pipe.ppm").says(0, &[]);
    folder.run("scene.hry file.ppm").says(0, &[]);
    assert_eq!(reader.join().unwrap(), folder.read("file.ppm"));
    assert!(std::fs::symlink_metadata(folder.path("pipe.ppm")).unwrap().file_type().is_fifo());
}

#[test]
fn a_link_stays_a_link_and_permissions_stay() {
    let folder = Folder::new();
    folder.write("target.png", "old");
    std::fs::set_permissions(folder.path("target.png"), std::fs::Permissions::from_mode(0o600)).unwrap();
    symlink("target.png", folder.path("link.png")).unwrap();
    folder.run("render scene.hry -o link.png").says(0, &[]);
    assert!(std::fs::symlink_metadata(folder.path("link.png")).unwrap().is_symlink());
    assert!(folder.read("target.png").starts_with(b"\x89PNG"));
    assert_eq!(std::fs::metadata(folder.path("target.png")).unwrap().permissions().mode() & 0o777, 0o600);
    symlink("scene.hry", folder.path("link.ppm")).unwrap();
    folder.run("scene.hry link.ppm").says(2, &["would replace the scene `link.ppm`"]);
    assert_eq!(folder.read("scene.hry"), common::SCENE.as_bytes());
}

#[test]
fn the_scene_on_standard_input_is_not_replaced() {
    let folder = Folder::new();
    if !Path::new("/dev/stdin").exists() {
        return;
    }
    let scene = std::fs::File::open(folder.path("scene.hry")).unwrap();
    let output = folder
        .command()
        .args(["render", "-", "-o", "scene.hry", "--format", "png"])
        .stdin(scene)
        .output()
        .unwrap();
    Outcome::of(output).says(2, &["would replace the scene"]);
    assert_eq!(folder.read("scene.hry"), common::SCENE.as_bytes());
}
