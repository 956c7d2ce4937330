//! Renders the examples anew and records their hashes.

use crate::{Result, build_hray, root, scenes};
use sha2::{Digest, Sha256};
use std::process::Command;

/// Renders every scene of `examples/` to a picture beside it, and writes `examples/SHA256SUMS`: for each the
/// hash of the P3 file that the classic form writes.
///
/// # Errors
/// Where a scene does not render or a file cannot be written.
pub fn run() -> Result<()> {
    let hray = build_hray()?;
    let folder = root().join("examples");
    let scratch = std::env::temp_dir().join(format!("hray-bless-{}.ppm", std::process::id()));
    let mut sums = String::new();
    for name in scenes(&folder)? {
        let scene = folder.join(format!("{name}.hry"));
        let run = |command: &mut Command| match command.status() {
            Ok(status) if status.success() => Ok(()),
            Ok(_) => Err(format!("{name} does not render")),
            Err(error) => Err(format!("cannot run hray: {error}")),
        };
        run(Command::new(&hray).arg(&scene).arg(&scratch).stdout(std::process::Stdio::null()))?;
        let picture = folder.join(format!("{name}.png"));
        run(Command::new(&hray).args(["render", "--quiet"]).arg(&scene).arg("-o").arg(&picture))?;
        let bytes = std::fs::read(&scratch).map_err(|e| format!("{name}: {e}"))?;
        sums.push_str(&format!("{:x}  {name}.ppm\n", Sha256::digest(&bytes)));
    }
    // Only a leftover in the folder for such; nothing depends on its removal.
    let _ = std::fs::remove_file(&scratch);
    std::fs::write(folder.join("SHA256SUMS"), sums)
        .map_err(|e| format!("cannot write examples/SHA256SUMS: {e}"))
}
