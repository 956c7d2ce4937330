//! What did not change is not read again.

#![allow(clippy::unwrap_used, reason = "tests may fail loudly")]

use hray::Assets;
use hray_session::{FolderFiles, MemoryFiles};
use std::fs;
use std::sync::Arc;

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn a_mesh_is_read_when_its_file_changes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.ply");
    fs::write(&path, PLY).unwrap();
    let files = FolderFiles::open(folder.path()).unwrap();
    let first = files.model("a.ply").unwrap();
    assert!(Arc::ptr_eq(&first, &files.model("a.ply").unwrap()));
    fs::write(&path, PLY.replace("1 0 0", "1.5 0 0")).unwrap();
    let second = files.model("a.ply").unwrap();
    assert_ne!(first.parts[0].mesh, second.parts[0].mesh);
    fs::remove_file(&path).unwrap();
    assert!(files.model("a.ply").is_err());
}

#[test]
fn files_in_memory_are_read_when_they_are_put_there_anew() {
    let files = MemoryFiles::default();
    assert!(files.model("m/a.ply").is_err());
    files.put("m/a.ply", Some(PLY.into())).unwrap();
    let first = files.model("m/a.ply").unwrap();
    assert!(Arc::ptr_eq(&first, &files.model("m/a.ply").unwrap()));
    files.put("m/a.ply", Some(PLY.replace("1 0 0", "2 0 0").into())).unwrap();
    assert_ne!(first.parts[0].mesh, files.model("m/a.ply").unwrap().parts[0].mesh);
    assert_eq!(files.neighbours("m/x"), ["m/a.ply"]);
    files.put("m/a.ply", None).unwrap();
    assert!(files.model("m/a.ply").is_err());
    assert!(files.put("../a.ply", Some(Vec::new())).is_err());
}
