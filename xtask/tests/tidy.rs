//! The documents tell the truth, and the checks that say so can fail.

use std::path::Path;
use xtask::tidy::{
    allowed_edges, forbidden_edges, foreign_dependencies, missing_paths, run, unreasoned_dependencies,
};

#[test]
fn the_workspace_is_tidy() {
    if let Err(complaints) = run() {
        panic!("{complaints}");
    }
}

#[test]
fn a_path_that_does_not_exist_is_found() {
    let root = xtask::root();
    let text =
        "See `xtask/src/lib.rs`, `xtask/src/gone.rs` and [this](docs/gone.md), but not `f(x)` or `a -> b`.";
    assert_eq!(missing_paths(text, &root), ["xtask/src/gone.rs", "docs/gone.md"]);
    assert!(missing_paths("```\n`no/such/path`\n```", &root).is_empty());
    assert_eq!(missing_paths("`no/such`", Path::new("/")), ["no/such"]);
}

#[test]
fn a_forbidden_edge_is_found() {
    let allowed = allowed_edges("```edges\na -> b, c\nb -> nothing\nc -> nothing\n```").unwrap();
    let actual = allowed_edges("```edges\na -> b\nb -> c\nd -> nothing\n```").unwrap();
    let complaints = forbidden_edges(&allowed, &actual).join("\n");
    assert!(complaints.contains("b depends on c"), "{complaints}");
    assert!(complaints.contains("lacks the crate d"), "{complaints}");
    assert!(complaints.contains("names the crate c"), "{complaints}");
    assert!(!complaints.contains("a depends"), "{complaints}");
    assert!(allowed_edges("nothing here").is_err());
}

#[test]
fn a_dependency_without_a_reason_is_found() {
    let manifest = "[workspace.dependencies]\na = \"1\" # because\n# so that\nb = \"1\"\nc = \"1\"\n[other]\nd = \"1\"\n";
    assert_eq!(unreasoned_dependencies(manifest), ["Cargo.toml gives no reason for `c = \"1\"`"]);
}

#[test]
fn a_foreign_dependency_of_the_model_is_found() {
    let manifest =
        "[dependencies]\nlibm.workspace = true\nglam = \"1\"\n\n[dev-dependencies]\nproptest = \"1\"\n";
    assert_eq!(foreign_dependencies(manifest).collect::<Vec<_>>(), ["glam = \"1\""]);
}
