//! `--frames`, `--frame` and `--time`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, decoded};

/// A ball that moves to the right by one unit a second.
const MOVING: &str = "scene time = {
  size = (20, 10),
  samples = 1,
  camera = orthographic { from = (0, 0, 5), to = (0, 0, 0) },
  lights = [ambient { intensity = 1 }],
  objects = [sphere { radius = 0.5, center = (time, 0, 0) }],
}
";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("moving.hry", MOVING);
    folder
}

#[test]
fn frames_are_numbered_pictures_each_of_its_moment() {
    let folder = folder();
    folder
        .run("render moving.hry --frames 0..2 --fps 1 -o out/sub/f-####.png")
        .says(0, &["f-0000.png to out/sub/f-0002.png: 3 frames, 20x10 png"]);
    folder.run("render moving.hry --time 2 -o two.png").says(0, &[]);
    folder.run("render moving.hry --frame 2 --fps 1 -o one-##.png").says(0, &["one-02.png"]);
    let [first, last] = ["out/sub/f-0000.png", "out/sub/f-0002.png"].map(|name| decoded(&folder.path(name)));
    assert_ne!(first, last);
    assert_eq!(folder.read("out/sub/f-0002.png"), folder.read("two.png"));
    assert_eq!(folder.read("one-02.png"), folder.read("two.png"));
    folder.run("render moving.hry --frames 98..100 --size 4x2 -q").says(0, &[]);
    let names = folder.names();
    assert!(
        ["moving-0098.png", "moving-0100.png"].iter().all(|name| names.contains(&(*name).to_owned())),
        "{names:?}"
    );
    folder.run("render moving.hry --frames 9..10 -o w#.ppm --ascii -q").says(0, &[]);
    assert!(folder.read("w10.ppm").starts_with(b"P3\n"));
}

#[test]
fn one_file_holds_an_animation() {
    let folder = folder();
    for (name, mark) in [("a.gif", &b"GIF89a"[..]), ("a.apng", b"\x89PNG"), ("a.webp", b"RIFF")] {
        let command = format!("render moving.hry --frames 0..3 --fps 10 -o {name}");
        folder.run(&command).says(0, &[name, "4 frames, 20x10"]);
        let bytes = folder.read(name);
        assert!(bytes.starts_with(mark), "{name}");
        folder.run(&format!("{command} --threads 1")).says(0, &[]);
        assert_eq!(folder.read(name), bytes, "{name}");
    }
    folder.run("render moving.hry --frames 0..3 --fps 60 -o a.gif").says(1, &["60 frames a second"]);
    assert!(folder.names().iter().all(|name| !name.ends_with(".tmp")));
}

#[test]
fn a_name_for_one_picture_is_no_name_for_many() {
    let folder = folder();
    folder
        .run("render moving.hry --frames 0..3 -o a.png")
        .says(2, &["`a.png` names one picture, and there are 4 frames", "-o a-####.png", "-o a.gif"]);
    folder.run("render moving.hry --frames 0..3 -o -").says(2, &["frames do not go to the standard output"]);
    folder.run("render moving.hry -o a.gif").says(2, &["the name of an animation", "--frames 0..47"]);
    folder.run("render moving.hry --frames 0..3 --format png -o a.gif").says(2, &["numbered pictures"]);
    folder.run("render moving.hry --frames 3..0").says(2, &["frames go from the first to the last: 0..3"]);
    folder.run("render moving.hry --frames 12").says(2, &["such as 0..47"]);
    folder.run("render moving.hry --frames 0..3 --frame 1").says(2, &["cannot be used with"]);
    folder.run("render moving.hry --frames 0..3 --time 1").says(2, &["cannot be used with"]);
    folder.run("render moving.hry --frames 0..3 --fps 0").says(2, &["frames a second"]);
    folder.run("render moving.hry --time soon").says(2, &["a time is a number of seconds"]);
    folder.run_with_input("render - --frames 0..1", MOVING.as_bytes()).says(2, &["-o frame-####.png"]);
    assert_eq!(folder.names(), ["moving.hry", "scene.hry"]);
}

#[test]
fn a_scene_without_time_is_rendered_with_one_warning() {
    let folder = folder();
    let outcome = folder.run("render scene.hry --frames 0..2 -o f#.png");
    outcome.says(0, &["all frames are alike"]);
    assert_eq!(outcome.stderr.matches("warning").count(), 1);
    assert_eq!(folder.read("f0.png"), folder.read("f2.png"));
    folder.run("render scene.hry --time 2 -o a.png").says(0, &["every moment of it is the same"]);
    folder.run("render moving.hry --time 2 -o a.png").says(0, &[]);
}

#[test]
fn what_goes_wrong_at_a_later_moment_is_said_with_the_frame() {
    let folder = folder();
    folder.write("late.hry", MOVING.replace("radius = 0.5", "radius = sqrt (1.5 - time)"));
    folder
        .run("render late.hry --frames 0..3 --fps 1 -o f#.png")
        .says(1, &["late.hry:6:", "frame 2, at 2 seconds, has errors"]);
    assert!(folder.names().contains(&"f1.png".to_owned()));
    folder.run("render late.hry --frames 0..3 --fps 1 -o a.gif").says(1, &["frame 2"]);
    folder.write("grows.hry", MOVING.replace("(20, 10)", "(20 + time, 10)"));
    folder
        .run("render grows.hry --frames 0..3 --fps 1 -o a.gif")
        .says(1, &["frame 1 has 21 by 10 pixels, and those before have 20 by 10"]);
    folder.run("render grows.hry --frames 0..3 --fps 1 -o a.gif --size 8x4").says(0, &[]);
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_the_frames_that_are_complete_and_says_how_to_go_on() {
    use std::process::{Command, Stdio};
    use std::time::{Duration, Instant};
    let folder = folder();
    // Every frame after the first takes far too long.
    folder.write("slow.hry", MOVING.replace("samples = 1", "samples = if time > 0 then 65536 else 1"));
    let run = |output: &str| {
        let arguments = ["render", "slow.hry", "--frames", "0..9", "--size", "2000x1000", "-o", output];
        folder.command().args(arguments).stderr(Stdio::piped()).spawn().unwrap()
    };
    let child = run("f#.png");
    let start = Instant::now();
    let begun = |names: &[String]| {
        names.contains(&"f0.png".to_owned()) && names.iter().any(|name| name.starts_with(".hray-"))
    };
    while !begun(&folder.names()) {
        assert!(start.elapsed() < Duration::from_secs(60), "it has not begun");
        std::thread::sleep(Duration::from_millis(5));
    }
    std::thread::sleep(Duration::from_millis(100));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let outcome = common::Outcome::of(child.wait_with_output().unwrap());
    outcome.says(130, &["interrupted: frame 0 is complete; go on with `--frames 1..9`"]);
    assert_eq!(folder.names(), ["f0.png", "moving.hry", "scene.hry", "slow.hry"]);
}
