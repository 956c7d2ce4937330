//! `cargo xtask NAME`: the chores of [`xtask`].

#![allow(clippy::print_stderr, reason = "chores talk to the person who runs them")]

use std::process::ExitCode;

const USAGE: &str = "usage: cargo xtask NAME
  tidy            checks that the documents name what exists and that crates depend as they may
  bless           renders examples/*.hry anew: pictures and hashes
  playground [--out DIR]
                  builds the studio as a folder for any web server, with the engine as WebAssembly
                  (default target/playground)
  bench [N]       whole-process time of the classic scenes (folder in HRAY_CLASSIC), median of N runs
                  each (default 9), beside the original's
  bench rays ...  single rays against large meshes, beside Embree; `bench rays --help` says what it takes";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let result = match words.as_slice() {
        ["tidy"] => xtask::tidy::run(),
        ["playground"] => xtask::playground::run(None),
        ["playground", "--out", out] => xtask::playground::run(Some(out)),
        ["bless"] => xtask::bless::run(),
        ["bench"] => xtask::bench::run(9),
        ["bench", "rays", arguments @ ..] => xtask::bench::rays(arguments),
        ["bench", runs] => runs
            .parse()
            .ok()
            .filter(|runs| *runs > 0)
            .ok_or_else(|| format!("`{runs}` is not a number of runs\n{USAGE}"))
            .and_then(xtask::bench::run),
        _ => Err(USAGE.into()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}
