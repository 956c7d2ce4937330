//! How far a render is.

use crate::console::Console;
use hray::Control;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

/// A render that is done before this passes needs no bar.
const PATIENCE: Duration = Duration::from_millis(300);
const REFRESH: Duration = Duration::from_millis(100);
const TEMPLATE: &str = "[{elapsed}] [{bar:40}] {percent}% {msg}";

/// Runs `render`, and shows meanwhile how many of its pixels are done and how long the rest may take, if
/// somebody is watching.
pub(crate) fn watching<T>(
    console: &Console,
    control: &Control,
    pixels: u64,
    render: impl FnOnce() -> T,
) -> T {
    if !console.is_interactive() {
        return render();
    }
    let start = Instant::now();
    thread::scope(|scope| {
        let (done, wait) = channel::<()>();
        // Where no thread can be had for the bar, there is no bar.
        let _ = thread::Builder::new().name("progress".into()).spawn_scoped(scope, move || {
            if !matches!(wait.recv_timeout(PATIENCE), Err(RecvTimeoutError::Timeout)) {
                return;
            }
            let bar = ProgressBar::new(pixels);
            if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
                bar.set_style(style.progress_chars("=> "));
            }
            console.with_bar(&bar, || {
                loop {
                    let done = control.pixels_done().min(pixels);
                    bar.set_position(done);
                    bar.set_message(match time_left(start.elapsed(), done, pixels) {
                        _ if control.is_cancelled() => "stopping".to_owned(),
                        None => "time unknown".to_owned(),
                        Some(left) if left < Duration::from_secs(1) => "a moment left".to_owned(),
                        Some(left) => format!("{} left", HumanDuration(left)),
                    });
                    if !matches!(wait.recv_timeout(REFRESH), Err(RecvTimeoutError::Timeout)) {
                        break;
                    }
                }
            });
        });
        let result = render();
        drop(done);
        result
    })
}

/// What the rest takes at the pace so far; so it grows while nothing is done.
fn time_left(elapsed: Duration, done: u64, total: u64) -> Option<Duration> {
    let rest = total.saturating_sub(done) as f64 / done as f64;
    // Infinite, or no number, where nothing is done.
    Duration::try_from_secs_f64(elapsed.as_secs_f64() * rest).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_grows_while_nothing_is_done() {
        let left = |elapsed, done| time_left(Duration::from_secs(elapsed), done, 100);
        assert_eq!((left(10, 0), left(10, 100)), (None, Some(Duration::ZERO)));
        assert_eq!(
            (left(10, 50), left(20, 50)),
            (Some(Duration::from_secs(10)), Some(Duration::from_secs(20)))
        );
    }
}
