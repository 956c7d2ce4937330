//! Puts the page into the program: the bytes of its files, by their paths.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

fn main() -> io::Result<()> {
    let here = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    let folder = here.join("dist");
    println!("cargo::rerun-if-changed={}", folder.display());
    let (mut files, mut open) = (Vec::new(), vec![folder.clone()]);
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next)? {
            let path = entry?.path();
            if path.is_dir() {
                open.push(path);
            } else if let Some(inside) = path.strip_prefix(&folder).ok().and_then(Path::to_str) {
                files.push((inside.replace('\\', "/"), path));
            }
        }
    }
    files.sort();
    let mut text = "/// By their paths.\nstatic PAGE: &[(&str, &[u8])] = &[\n".to_owned();
    for (inside, path) in files {
        let _ = writeln!(text, "    ({inside:?}, include_bytes!({:?})),", path.display().to_string());
    }
    text.push_str("];\n");
    fs::write(out.join("page.rs"), text)
}
