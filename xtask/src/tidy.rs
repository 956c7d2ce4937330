//! Whether the documents still tell the truth, and the crates depend on each other as they may.

use crate::{Result, read, root};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Documents whose paths must exist.
const DOCUMENTS: [&str; 6] = [
    "ARCHITECTURE.md",
    "README.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
    "docs/performance.md",
    "fuzz/README.md",
];
/// Longer source files usually hide a second concept.
const LONGEST_FILE: usize = 800;

/// Runs every check.
///
/// # Errors
/// With one line for each thing that is not as it should be.
pub fn run() -> Result<()> {
    let mut complaints = Vec::new();
    for document in DOCUMENTS {
        let text = read(&root().join(document))?;
        complaints.extend(
            missing_paths(&text, &root())
                .into_iter()
                .map(|path| format!("{document} names `{path}`, which does not exist")),
        );
        complaints.extend(placeholders(&text).map(|word| format!("{document} still says {word}")));
    }
    complaints.extend(
        foreign_dependencies(&read(&root().join("crates/hray-model/Cargo.toml"))?)
            .map(|line| format!("hray-model depends on more than libm: {line}")),
    );
    let allowed = allowed_edges(&read(&root().join("ARCHITECTURE.md"))?)?;
    complaints.extend(forbidden_edges(&allowed, &actual_edges()?));
    complaints.extend(long_files()?);
    complaints.extend(unreasoned_dependencies(&read(&root().join("Cargo.toml"))?));
    if complaints.is_empty() { Ok(()) } else { Err(complaints.join("\n")) }
}

/// The paths in back quotes or link targets of a document that do not exist below `root`.
///
/// A path is what has a slash and only letters, digits and `._-/` in it.
#[must_use]
pub fn missing_paths(document: &str, root: &Path) -> Vec<String> {
    let is_path = |text: &str| {
        text.contains('/')
            && !text.starts_with('/')
            && !text.contains("://")
            && text.chars().all(|c| c.is_ascii_alphanumeric() || "._-/".contains(c))
    };
    let mut in_code = false;
    let mut missing = Vec::new();
    for line in document.lines() {
        if line.trim_start().starts_with("```") {
            in_code = !in_code;
        }
        if in_code {
            continue;
        }
        let quoted = line.split('`').skip(1).step_by(2);
        let linked = line.split("](").skip(1).filter_map(|rest| rest.split(')').next());
        let paths = quoted.chain(linked).filter(|text| is_path(text));
        missing.extend(paths.filter(|path| !root.join(path).exists()).map(str::to_owned));
    }
    missing
}

/// Words of a document that were to be replaced.
fn placeholders(document: &str) -> impl Iterator<Item = &str> {
    let words = document.split(|c: char| !c.is_ascii_uppercase() && c != '_');
    words.filter(|word| {
        ["TODO", "TBD", "FIXME"].contains(word) || word.ends_with("_PLACEHOLDER") || word.ends_with("_TABLE")
    })
}

/// The lines of a manifest's `[dependencies]` that name something else than `libm`.
pub fn foreign_dependencies(manifest: &str) -> impl Iterator<Item = &str> {
    let table = manifest.split("[dependencies]\n").nth(1).unwrap_or("");
    let lines = table.lines().take_while(|line| !line.starts_with('['));
    lines.filter(|line| !line.trim().is_empty() && !line.starts_with('#') && !line.starts_with("libm"))
}

type Edges = BTreeMap<String, BTreeSet<String>>;

/// The table of edges in ARCHITECTURE.md: the code block that starts with ```` ```edges ````, a line
/// `crate -> other, other` for each crate.
///
/// # Errors
/// Where there is no such block, or a line that is not of that form.
pub fn allowed_edges(document: &str) -> Result<Edges> {
    let block = document.split("```edges\n").nth(1).and_then(|rest| rest.split("```").next());
    let block = block.ok_or("ARCHITECTURE.md has no block of edges")?;
    let mut edges = Edges::new();
    for line in block.lines().filter(|line| !line.trim().is_empty()) {
        let (from, to) = line.split_once("->").ok_or_else(|| format!("not an edge: {line}"))?;
        let to = to.split(',').map(str::trim).filter(|name| !name.is_empty() && *name != "nothing");
        edges.insert(from.trim().to_owned(), to.map(str::to_owned).collect());
    }
    Ok(edges)
}

/// What each crate of the workspace depends on within it, tests and benchmarks included.
fn actual_edges() -> Result<Edges> {
    let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let output = Command::new(cargo)
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .map_err(|e| format!("cannot run cargo: {e}"))?;
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.stdout).map_err(|e| format!("cargo metadata: {e}"))?;
    let packages = metadata["packages"].as_array().ok_or("cargo metadata names no packages")?;
    let name = |value: &serde_json::Value| value["name"].as_str().map(str::to_owned);
    let ours: BTreeSet<String> = packages.iter().filter_map(name).collect();
    Ok(packages
        .iter()
        .filter_map(|package| {
            let dependencies = package["dependencies"].as_array()?;
            let within = dependencies.iter().filter_map(name).filter(|name| ours.contains(name));
            Some((name(package)?, within.collect()))
        })
        .collect())
}

/// A complaint for every edge that is not in the table, and for every crate that the table lacks or invents.
#[must_use]
pub fn forbidden_edges(allowed: &Edges, actual: &Edges) -> Vec<String> {
    let mut complaints = Vec::new();
    for (from, to) in actual {
        match allowed.get(from) {
            None => complaints.push(format!("the table of edges in ARCHITECTURE.md lacks the crate {from}")),
            Some(may) => complaints.extend(
                to.difference(may)
                    .map(|to| format!("{from} depends on {to}, which ARCHITECTURE.md does not allow")),
            ),
        }
    }
    let gone = allowed.keys().filter(|name| !actual.contains_key(*name));
    complaints
        .extend(gone.map(|name| format!("ARCHITECTURE.md names the crate {name}, which does not exist")));
    complaints
}

fn long_files() -> Result<Vec<String>> {
    let mut files = Vec::new();
    for folder in ["crates", "xtask"] {
        rust_files(&root().join(folder), &mut files)?;
    }
    let mut complaints = Vec::new();
    for file in files {
        let lines = read(&file)?.lines().count();
        if lines > LONGEST_FILE {
            complaints.push(format!("{} has {lines} lines; {LONGEST_FILE} are the limit", file.display()));
        }
    }
    Ok(complaints)
}

fn rust_files(folder: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    let entries = std::fs::read_dir(folder).map_err(|e| format!("cannot list {}: {e}", folder.display()))?;
    for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
        if path.is_dir() && path.file_name().is_some_and(|name| name != "target") {
            rust_files(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

/// The external dependencies without a reason beside or above them.
#[must_use]
pub fn unreasoned_dependencies(manifest: &str) -> Vec<String> {
    let Some(table) = manifest.split("[workspace.dependencies]\n").nth(1) else {
        return vec!["Cargo.toml has no [workspace.dependencies]".into()];
    };
    let mut previous = "";
    let mut complaints = Vec::new();
    for line in table.lines().take_while(|line| !line.starts_with('[')) {
        let external = line.contains('=') && !line.starts_with('#') && !line.contains("path = ");
        if external && !line.contains('#') && !previous.starts_with('#') {
            complaints.push(format!("Cargo.toml gives no reason for `{line}`"));
        }
        previous = line;
    }
    complaints
}
