//! Renders the examples anew and records their hashes.

use crate::{Result, build_hray, root, scenes};
use sha2::{Digest, Sha256};
use std::path::Path;
use std::process::Command;

/// Renders every scene of `examples/` and of the tutorial to a picture beside it, and writes `examples/SHA256SUMS`: for each
/// classic example the hash of the P3 file that the classic form writes.
///
/// # Errors
/// Where a scene does not render or a file cannot be written.
pub fn run() -> Result<()> {
    let hray = build_hray()?;
    for folder in ["examples", "docs/src/tutorial"] {
        bless(&hray, &root().join(folder))?;
    }
    Ok(())
}

/// What a text in a folder of scenes is.
fn kind(text: &str) -> Kind {
    let defines_scene = text.lines().any(|line| line.starts_with("scene ") || line.starts_with("scene="));
    match text.trim_start().starts_with("renderDescr") {
        true => Kind::Classic,
        false if defines_scene => Kind::Hry,
        false => Kind::Module,
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Classic,
    Hry,
    /// Others import it.
    Module,
}

fn bless(hray: &Path, folder: &Path) -> Result<()> {
    let scratch = std::env::temp_dir().join(format!("hray-bless-{}.ppm", std::process::id()));
    let mut sums = String::new();
    for name in scenes(folder)? {
        let scene = folder.join(format!("{name}.hry"));
        let run = |command: &mut Command| match command.status() {
            Ok(status) if status.success() => Ok(()),
            Ok(_) => Err(format!("{name} does not render")),
            Err(error) => Err(format!("cannot run hray: {error}")),
        };
        let kind = kind(&crate::read(&scene)?);
        if kind == Kind::Module {
            continue;
        }
        let picture = folder.join(format!("{name}.png"));
        run(Command::new(hray).args(["render", "--quiet"]).arg(&scene).arg("-o").arg(&picture))?;
        if kind == Kind::Hry {
            continue;
        }
        run(Command::new(hray).arg(&scene).arg(&scratch).stdout(std::process::Stdio::null()))?;
        let bytes = std::fs::read(&scratch).map_err(|e| format!("{name}: {e}"))?;
        sums.push_str(&format!("{:x}  {name}.ppm\n", Sha256::digest(&bytes)));
    }
    // Only a leftover in the folder for such; nothing depends on its removal.
    let _ = std::fs::remove_file(&scratch);
    if sums.is_empty() {
        return Ok(());
    }
    std::fs::write(folder.join("SHA256SUMS"), sums)
        .map_err(|e| format!("cannot write examples/SHA256SUMS: {e}"))
}
