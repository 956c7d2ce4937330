//! How fast a binary PLY file of 4 million triangles is read: `cargo run --release -p hray-io --example mesh_speed`.
#![allow(clippy::print_stdout)]

use std::path::Path;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let side = 1415u32;
    let count = (side - 1) * (side - 1) * 2;
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n\
         property float z\nelement face {count}\nproperty list uchar int vertex_indices\nend_header\n",
        side * side
    )
    .into_bytes();
    for vertex in 0..side * side {
        let (x, y) = ((vertex % side) as f32, (vertex / side) as f32);
        bytes.extend([x, y, x * y].iter().flat_map(|x| x.to_le_bytes()));
    }
    for square in 0..count / 2 {
        let a = square / (side - 1) * side + square % (side - 1);
        for corners in [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]] {
            bytes.push(3);
            bytes.extend(corners.iter().flat_map(|corner| corner.to_le_bytes()));
        }
    }
    let megabytes = bytes.len() as f64 / 1e6;
    for _ in 0..5 {
        let start = Instant::now();
        let model = hray_io::decode_model(&bytes, Path::new("a.ply"), &|_| Err(String::new()))?;
        let seconds = start.elapsed().as_secs_f64();
        let triangles: usize = model.parts.iter().map(|part| part.mesh.triangles().len()).sum();
        println!(
            "{triangles} triangles, {megabytes:.0} MB in {seconds:.3} s: {:.0} MB/s",
            megabytes / seconds
        );
    }
    Ok(())
}
