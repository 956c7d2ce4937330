//! What a render did, in a few lines.

use crate::job::Job;
use hray::{AnimationFormat, PictureFormat, Statistics};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The summary at the end of `hray render`.
pub(crate) fn of(job: &Job<'_>, statistics: &Statistics, time: Duration) -> String {
    let scene = &job.description.scene;
    // The job has been run, so the settings are valid.
    let size = job.options.settings(job.description).map_or_else(
        |_| String::new(),
        |settings| format!("{}x{}", settings.region.width(), settings.region.height()),
    );
    let name =
        if job.destination.is_stdout() { "the standard output".into() } else { job.name.to_string_lossy() };
    format!(
        "{name}: {size} {}, {}, {}\n{}",
        job.format,
        counted(scene.primitives.len(), "object"),
        counted(scene.lights.len(), "light"),
        work(statistics, time)
    )
}

/// What several renders did together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Total {
    statistics: Statistics,
    frames: u32,
    /// The size of the last one.
    size: [u32; 2],
}

impl Total {
    /// Counts one more.
    pub(crate) fn add(&mut self, size: [u32; 2], statistics: &Statistics) {
        self.statistics.rays += statistics.rays;
        self.statistics.threads = self.statistics.threads.max(statistics.threads);
        (self.frames, self.size) = (self.frames + 1, size);
    }
}

/// The summary of numbered pictures, of which the first and the last are named.
pub(crate) fn of_frames(
    [first, last]: &[PathBuf; 2],
    format: PictureFormat,
    total: &Total,
    time: Duration,
) -> String {
    let Total { frames, size: [width, height], statistics } = total;
    let (first, last) = (first.to_string_lossy(), last.to_string_lossy());
    let names = if first == last { first.into_owned() } else { format!("{first} to {last}") };
    let frames = counted(*frames as usize, "frame");
    format!("{names}: {frames}, {width}x{height} {format}\n{}", work(statistics, time))
}

/// The summary of an animation in one file.
pub(crate) fn of_animation(
    path: &Path,
    format: AnimationFormat,
    frames: u32,
    total: &Total,
    time: Duration,
) -> String {
    let Total { size: [width, height], statistics, .. } = total;
    let (name, frames) = (path.to_string_lossy(), counted(frames as usize, "frame"));
    format!("{name}: {frames}, {width}x{height} {format}\n{}", work(statistics, time))
}

/// Rays, and the time that they took.
fn work(statistics: &Statistics, time: Duration) -> String {
    let (rays, seconds) = (&statistics.rays, time.as_secs_f64());
    format!(
        "{} rays: {} camera, {} shadow, {} reflection, {} refraction\n\
         {} with {}, {} rays per second\n",
        grouped(rays.total()),
        grouped(rays.camera),
        grouped(rays.shadow),
        grouped(rays.reflection),
        grouped(rays.refraction),
        duration(seconds),
        counted(statistics.threads, "thread"),
        grouped((rays.total() as f64 / seconds.max(1e-9)) as u64),
    )
}

/// `12.3 ms`, `1.234 s`.
fn duration(seconds: f64) -> String {
    if seconds < 0.1 { format!("{:.1} ms", seconds * 1e3) } else { format!("{seconds:.3} s") }
}

/// "no lights", "1 light", "2 lights".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    match count {
        0 => format!("no {noun}s"),
        1 => format!("1 {noun}"),
        n => format!("{} {noun}s", grouped(n as u64)),
    }
}

/// A number with commas between its thousands.
pub(crate) fn grouped(number: u64) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_times_are_in_milliseconds() {
        assert_eq!([duration(0.00123), duration(0.1), duration(2.5)], ["1.2 ms", "0.100 s", "2.500 s"]);
    }

    #[test]
    fn numbers_are_readable() {
        assert_eq!(
            [grouped(0), grouped(999), grouped(1_000), grouped(12_345_678)],
            ["0", "999", "1,000", "12,345,678"]
        );
        assert_eq!(
            [counted(0, "light"), counted(1, "light"), counted(2, "light")],
            ["no lights", "1 light", "2 lights"]
        );
    }
}
