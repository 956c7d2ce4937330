#![allow(missing_docs, clippy::print_stdout, clippy::unwrap_used)]
use hray_bvh::{BuildOptions, TriangleMesh};
use std::time::Instant;
fn main() {
    let n: u32 = std::env::args().nth(1).and_then(|s| s.parse().ok()).unwrap_or(700);
    let threads: usize = std::env::args().nth(2).and_then(|s| s.parse().ok()).unwrap_or(1);
    let at = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
    let mut v = vec![];
    for j in 0..=n {
        for i in 0..=n {
            let (x, z) = (at(i), at(j));
            v.push([x, 0.1 * (((i * 2654435761u32) ^ (j * 40503)) % 17) as f32 / 170.0 + 0.2 * x * z, z]);
        }
    }
    let mut t = vec![];
    for j in 0..n {
        for i in 0..n {
            let a = j * (n + 1) + i;
            t.extend([[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
        }
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let mut best = f64::MAX;
    for _ in 0..5 {
        let s = Instant::now();
        let m = pool.install(|| TriangleMesh::build(&v, &t, &BuildOptions::default())).unwrap();
        best = best.min(s.elapsed().as_secs_f64());
        std::hint::black_box(&m);
    }
    println!("{} triangles {best:.3} s", t.len());
}
