//! How long it takes to turn the colours of an 800 x 600 picture into the bytes of each format.

#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a benchmark may fail loudly, and its macros make items"
)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hray_core::{Encoding, Rgb};
use hray_io::{PictureFormat, PictureWriter};
use std::hint::black_box;
use std::path::Path;

const WIDTH: u32 = 800;
const HEIGHT: u32 = 600;

/// A picture with smooth parts, noisy parts and a constant background.
fn picture() -> Vec<Rgb> {
    let mut state = 1u64;
    let mut noise = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..HEIGHT)
        .flat_map(|y| (0..WIDTH).map(move |x| (f64::from(x) / 800.0, f64::from(y) / 600.0)))
        .map(|(x, y)| match (x < 0.3, y < 0.3) {
            (_, true) => Rgb::new(0.2, 0.3, 0.5),
            (true, _) => Rgb::new(noise(), noise(), noise()),
            _ => Rgb::new(x, y, x * y),
        })
        .collect()
}

fn encode(criterion: &mut Criterion) {
    let pixels = picture();
    let mut group = criterion.benchmark_group("encode");
    group.throughput(Throughput::Elements(3 * pixels.len() as u64));
    for format in [PictureFormat::PpmAscii, PictureFormat::Ppm, PictureFormat::Farbfeld, PictureFormat::Exr] {
        group.bench_function(format.name(), |bencher| {
            bencher.iter(|| {
                for run in black_box(&pixels).chunks(4096) {
                    black_box(format.encode(run, Encoding::Raw));
                }
            });
        });
    }
    group.finish();
}

fn write(criterion: &mut Criterion) {
    let pixels = picture();
    let mut group = criterion.benchmark_group("write");
    group.sample_size(20);
    for format in PictureFormat::ALL {
        group.bench_function(format.name(), |bencher| {
            bencher.iter(|| {
                let mut writer =
                    PictureWriter::to_writer(std::io::sink(), Path::new("-"), format, WIDTH, HEIGHT).unwrap();
                for run in pixels.chunks(4096) {
                    writer.write(&format.encode(run, Encoding::Raw)).unwrap();
                }
                writer.finish().unwrap();
            });
        });
    }
    group.finish();
}

criterion_group!(benches, encode, write);
criterion_main!(benches);
