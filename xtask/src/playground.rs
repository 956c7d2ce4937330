//! Builds the playground: the page of the studio with the engine as WebAssembly, as a folder that any web server can serve.

use crate::{Result, read, root};
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Vectors, and a stack that holds as many calls inside calls as the playground allows.
const RUSTFLAGS: &str = "-C target-feature=+simd128 -C link-arg=-zstack-size=33554432";

/// Builds into `out`, by default `target/playground`.
///
/// # Errors
/// Where something does not build or is missing, in words.
pub fn run(out: Option<&str>) -> Result<()> {
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    let out = out.map_or_else(|| target.join("playground"), PathBuf::from);
    let page = root().join("crates/hray-studio/dist");
    if !page.join("index.html").exists() {
        return Err(format!(
            "{} has no page; crates/hray-studio/page/README.md says how it is built",
            page.display()
        ));
    }
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let build = ["build", "--locked", "--profile", "playground", "--target", "wasm32-unknown-unknown"];
    command(Command::new(&cargo).args(build).args(["-p", "hray-playground"]).env("RUSTFLAGS", RUSTFLAGS))?;
    let module = target.join("wasm32-unknown-unknown/playground/hray_playground.wasm");
    let bindgen = bindgen(&cargo, &target)?;
    let engine = out.join("engine");
    fs::create_dir_all(&engine).map_err(|error| format!("cannot make {}: {error}", engine.display()))?;
    let glue = ["--target", "web", "--no-typescript", "--remove-name-section", "--remove-producers-section"];
    let glue = [&glue[..], &["--out-name", "hray_playground", "--out-dir"]].concat();
    command(Command::new(bindgen).args(glue).arg(&engine).arg(&module))?;
    optimise(&engine.join("hray_playground_bg.wasm"))?;
    copy(&page, &out)?;
    println!("{} can be served by any web server", out.display());
    Ok(())
}

/// The command of wasm-bindgen in the version of the library; installed where it is missing.
fn bindgen(cargo: &str, target: &Path) -> Result<PathBuf> {
    let lock = read(&root().join("Cargo.lock"))?;
    let version = lock.split("name = \"wasm-bindgen\"\nversion = \"").nth(1);
    let version = version.and_then(|rest| rest.split('"').next()).ok_or("Cargo.lock has no wasm-bindgen")?;
    let tools = target.join("tools");
    let own = tools.join("bin").join(format!("wasm-bindgen{}", std::env::consts::EXE_SUFFIX));
    for program in [OsStr::new("wasm-bindgen"), own.as_os_str()] {
        let told = Command::new(program).arg("--version").output();
        if told
            .is_ok_and(|told| String::from_utf8_lossy(&told.stdout).trim().ends_with(&format!(" {version}")))
        {
            return Ok(program.into());
        }
    }
    // It runs for a second or two: what counts is that it compiles in little time.
    let quick = [("OPT_LEVEL", "0"), ("LTO", "off"), ("CODEGEN_UNITS", "256"), ("DEBUG", "0")];
    let quick = quick.map(|(key, value)| (format!("CARGO_PROFILE_RELEASE_{key}"), value));
    let install = ["install", "wasm-bindgen-cli", "--version", version, "--force", "--root"];
    command(Command::new(cargo).args(install).arg(&tools).env_remove("CARGO_TARGET_DIR").envs(quick))?;
    Ok(own)
}

/// Makes the module smaller and faster, where the program for that is at hand.
fn optimise(module: &Path) -> Result<()> {
    if Command::new("wasm-opt").arg("--version").output().is_err() {
        println!("without wasm-opt the module is larger than it need be");
        return Ok(());
    }
    command(Command::new("wasm-opt").args(["-O3", "--all-features", "-o"]).arg(module).arg(module))
}

fn command(command: &mut Command) -> Result<()> {
    let name = command.get_program().to_string_lossy().into_owned();
    let status =
        command.current_dir(root()).status().map_err(|error| format!("cannot run {name}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{name} failed")) }
}

/// Copies what is in a folder.
fn copy(from: &Path, to: &Path) -> Result<()> {
    let failed = |path: &Path, error: std::io::Error| format!("cannot copy {}: {error}", path.display());
    fs::create_dir_all(to).map_err(|error| failed(to, error))?;
    for entry in fs::read_dir(from).map_err(|error| failed(from, error))? {
        let path = entry.map_err(|error| failed(from, error))?.path();
        let Some(name) = path.file_name() else { continue };
        if path.is_dir() {
            copy(&path, &to.join(name))?;
        } else {
            fs::copy(&path, to.join(name)).map_err(|error| failed(&path, error))?;
        }
    }
    Ok(())
}
