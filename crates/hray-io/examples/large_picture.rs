//! Writes a large synthetic picture and says what it took, to check that memory stays within bounds:
//!
//! ```text
//! cargo run --release -p hray-io --example large_picture -- OUTPUT.png [SIDE]
//! ```

use hray_core::{Encoding, Rgb};
use hray_io::{Destination, PictureFormat, PictureWriter};
use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1);
    let path = PathBuf::from(arguments.next().ok_or("give the name of the picture")?);
    let side: u32 = match arguments.next() {
        Some(text) => text.to_string_lossy().parse()?,
        None => 10_000,
    };
    let format = PictureFormat::from_path(&path)?;

    let start = Instant::now();
    let mut writer = PictureWriter::create(&Destination::file(&path)?, format, side, side)?;
    let scale = 1.0 / f64::from(side);
    let mut row = Vec::new();
    for y in 0..side {
        row.clear();
        row.extend((0..side).map(|x| {
            let (u, v) = (f64::from(x) * scale, f64::from(y) * scale);
            Rgb::new(u, v, if (x / 64 + y / 64) % 2 == 0 { u * v } else { 0.5 })
        }));
        for run in row.chunks(4096) {
            writer.write(&format.encode(run, Encoding::Raw))?;
        }
    }
    writer.finish()?;

    let mut out = std::io::stdout();
    writeln!(out, "{side} x {side} as {format}: {:.2} s", start.elapsed().as_secs_f64())?;
    if let Ok(status) = std::fs::read_to_string("/proc/self/status")
        && let Some(peak) = status.lines().find(|line| line.starts_with("VmHWM"))
    {
        writeln!(out, "{peak}")?;
    }
    Ok(())
}
