//! Any bytes as a file of meshes of each format: they are read or refused, with a reason. The first byte tells the format
//! where the content does not. What is read is a scene.

#![no_main]

use hray_io::decode_model;
use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let Some((first, rest)) = bytes.split_first() else { return };
    let names = ["a.ply", "a.stl", "a.obj", "a.gltf", "a.glb"];
    let name = names[usize::from(*first) % names.len()];
    // Whatever file is named has the same bytes.
    let files = |_: &str| Ok(rest.to_vec());
    match decode_model(rest, Path::new(name), &files) {
        Err(error) => assert!(!error.reason().is_empty()),
        Ok(model) => {
            for part in &model.parts {
                let count = part.mesh.positions().len();
                assert!(part.mesh.triangles().as_flattened().iter().all(|vertex| (*vertex as usize) < count));
                if part.mesh.normals().is_empty() {
                    let smooth = part.mesh.smoothed(0.75);
                    assert_eq!(smooth.triangles().len(), part.mesh.triangles().len());
                }
            }
            let _ = hray::scene_of_model(name, &model);
        }
    }
});
