//! Puts the page and the examples into the program: their bytes, by their paths.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

fn main() -> io::Result<()> {
    let here = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let out = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default());
    let page = table("PAGE", &here.join("dist"), |_| true)?;
    let examples = table("EXAMPLES", &here.join("../../examples"), |path| path.ends_with(".hry"))?;
    fs::write(out.join("embedded.rs"), format!("{page}\n{examples}"))
}

/// A table of the files below a folder, sorted by their paths.
fn table(name: &str, folder: &Path, wanted: impl Fn(&str) -> bool) -> io::Result<String> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let (mut files, mut open) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(next)? {
            let path = entry?.path();
            if path.is_dir() {
                open.push(path);
            } else if let Some(inside) = path.strip_prefix(folder).ok().and_then(Path::to_str) {
                files.push((inside.replace('\\', "/"), path));
            }
        }
    }
    files.sort();
    let mut text = format!("/// By their paths.\npub(crate) static {name}: &[(&str, &[u8])] = &[\n");
    for (inside, path) in files.iter().filter(|(inside, _)| wanted(inside)) {
        let _ = writeln!(text, "    ({inside:?}, include_bytes!({:?})),", path.display().to_string());
    }
    text.push_str("];\n");
    Ok(text)
}
