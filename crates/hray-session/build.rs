//! Puts the examples into the library: their texts, by their names.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::{fs, io};

fn main() -> io::Result<()> {
    let here = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    let folder = here.join("../../examples");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(&folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "hry") {
            files.extend(path.file_stem().map(|name| (name.to_string_lossy().into_owned(), path.clone())));
        }
    }
    files.sort();
    let mut text = "/// By their names.\nstatic EXAMPLES: &[(&str, &str)] = &[\n".to_owned();
    for (name, path) in files {
        let _ = writeln!(text, "    ({name:?}, include_str!({:?})),", path.display().to_string());
    }
    text.push_str("];\n");
    fs::write(out.join("examples.rs"), text)
}
