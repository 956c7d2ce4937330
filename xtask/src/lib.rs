//! Project chores, run as `cargo xtask NAME`.
//!
//! [`tidy`] keeps the documents true, [`bless`] renders the examples anew, [`mod@bench`] times the program,
//! [`playground`] builds the studio for the web.

#![allow(clippy::print_stdout, reason = "chores talk to the person who runs them")]

pub mod bench;
pub mod bless;
pub mod playground;
pub mod tidy;

use std::path::{Path, PathBuf};

/// What went wrong, for the person who ran the chore.
pub type Result<T> = std::result::Result<T, String>;

/// The root of the workspace.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new(".")).to_path_buf()
}

/// The text of a file of the workspace.
///
/// # Errors
/// Where the file cannot be read, saying which.
pub fn read(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).map_err(|e| format!("cannot read {}: {e}", path.display()))
}

/// The classic scenes in a folder, by name without extension, sorted.
///
/// # Errors
/// Where the folder cannot be listed.
pub fn scenes(folder: &Path) -> Result<Vec<String>> {
    let entries = std::fs::read_dir(folder).map_err(|e| format!("cannot list {}: {e}", folder.display()))?;
    let mut names: Vec<String> = entries
        .filter_map(|entry| {
            let path = entry.ok()?.path();
            let is_scene = path.extension()? == "hry";
            is_scene.then(|| path.file_stem()?.to_str().map(str::to_owned))?
        })
        .collect();
    names.sort();
    Ok(names)
}

/// Builds `hray` for release and says where it is.
///
/// # Errors
/// Where it does not build.
pub fn build_hray() -> Result<PathBuf> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let status = std::process::Command::new(cargo)
        .args(["build", "--quiet", "--release", "--package", "hray-cli"])
        .current_dir(root())
        .status()
        .map_err(|e| format!("cannot run cargo: {e}"))?;
    if !status.success() {
        return Err("hray does not build".into());
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
    Ok(target.join("release").join(format!("hray{}", std::env::consts::EXE_SUFFIX)))
}
