//! A folder for one test, and the real binary run in it.

#![allow(dead_code, reason = "not every test file needs all of it")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may fail loudly")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A small scene with something of everything: reflection, refraction, noise, both shapes, both lights.
pub(crate) const SCENE: &str = "renderDescr ( resolution (40,30) ) 6 [
scene { camera (0.0,0.0,150.0) (100,75) }
      { background (0.2,0.3,0.5) }
      { objects
          (object ( sphere 25.0 (10.0,0.0,-50.0) ) ( texture ( diff solid (0.9,0.5,0.1) ) 0.3 20 0.4 1.3 ))
          (object ( plane (0.0,1.0,0.0,30.0) ) ( texture ( diff perlin (perlinTurb (0.5,0.9,0.2) 3 7.5) ) 0.5 20 0.0 0.0 )) }
      { lights (pointLight (80.0,80.0,100.0) (0.9,0.9,0.9))
               (ambientLight (0.05,0.05,0.05)) } ]
";

/// Two facing mirrors that are half transparent: every hit sends two rays on, so that the picture takes about
/// 2^depth of them. It would not be done within a lifetime.
pub(crate) const ENDLESS: &str = "renderDescr ( resolution (400,300) ) 60 [
scene { camera (0.0,0.0,150.0) (100,75) }
      { background (0.2,0.3,0.5) }
      { objects
          (object ( plane (0.0,0.0,1.0,50.0) ) ( texture ( diff solid (0.9,0.5,0.1) ) 0.5 20 0.5 1.0 ))
          (object ( plane (0.0,0.0,1.0,80.0) ) ( texture ( diff solid (0.1,0.5,0.9) ) 0.5 20 0.5 1.0 )) }
      { lights (pointLight (80.0,80.0,100.0) (0.9,0.9,0.9)) } ]
";

/// A folder, with `scene.hry` in it.
pub(crate) struct Folder(TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        folder.write("scene.hry", SCENE);
        folder
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// What is there, temporary files included.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("hray"));
        command.current_dir(self.0.path()).stdin(Stdio::null());
        command
    }

    /// Runs the binary with arguments that have no spaces in them.
    pub(crate) fn run(&self, arguments: &str) -> Outcome {
        self.run_with_input(arguments, b"")
    }

    /// The same, started in a folder inside.
    pub(crate) fn run_in(&self, inside: &str, arguments: &str) -> Outcome {
        let mut command = self.command();
        command.current_dir(self.path(inside));
        Outcome::of(command.args(arguments.split_whitespace()).output().unwrap())
    }

    /// The same with something on the standard input.
    pub(crate) fn run_with_input(&self, arguments: &str, input: &[u8]) -> Outcome {
        let mut command = assert_cmd::Command::from_std(self.command());
        Outcome::of(command.args(arguments.split_whitespace()).write_stdin(input).output().unwrap())
    }
}

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub code: Option<i32>,
    pub stdout: Vec<u8>,
    pub stderr: String,
}

impl Outcome {
    pub(crate) fn of(output: Output) -> Self {
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(!stderr.contains("panicked"), "{stderr}");
        Self { code: output.status.code(), stdout: output.stdout, stderr }
    }

    pub(crate) fn stdout(&self) -> &str {
        std::str::from_utf8(&self.stdout).unwrap()
    }

    /// Ended with that code, and said all of these on standard error.
    #[track_caller]
    pub(crate) fn says(&self, code: i32, parts: &[&str]) -> &Self {
        assert_eq!(self.code, Some(code), "{}", self.stderr);
        for part in parts {
            assert!(self.stderr.contains(part), "{part:?} is missing in:\n{}", self.stderr);
        }
        self
    }
}

/// Width, height and pixels of a file that the `image` crate reads, at eight bits a component.
pub(crate) fn decoded(path: &Path) -> (u32, u32, Vec<u8>) {
    let image = image::open(path).unwrap().to_rgb8();
    (image.width(), image.height(), image.into_raw())
}

/// Width, height and components of a P3 file.
pub(crate) fn decoded_text(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let text = std::str::from_utf8(bytes).unwrap();
    let mut words = text.split_ascii_whitespace();
    assert_eq!(words.next(), Some("P3"));
    let mut number = || words.next().map(|word| word.parse::<u32>().unwrap());
    let (width, height) = (number().unwrap(), number().unwrap());
    assert_eq!(number(), Some(255));
    let pixels = std::iter::from_fn(number).map(|component| u8::try_from(component).unwrap()).collect();
    (width, height, pixels)
}
