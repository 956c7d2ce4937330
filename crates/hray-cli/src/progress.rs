//! How far a render is.

use crate::console::Console;
use hray::Control;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

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
            loop {
                bar.set_position(control.pixels_done().min(pixels));
                bar.set_message(match bar.eta() {
                    _ if control.is_cancelled() => "stopping".to_owned(),
                    left if left < Duration::from_secs(1) => "a moment left".to_owned(),
                    left => format!("{} left", HumanDuration(left)),
                });
                if !matches!(wait.recv_timeout(REFRESH), Err(RecvTimeoutError::Timeout)) {
                    break;
                }
            }
            bar.finish_and_clear();
        });
        let result = render();
        drop(done);
        result
    })
}
