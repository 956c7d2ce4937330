//! Ctrl-C.

use hray::Control;
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The exit code of a command that was interrupted: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// From now on, Ctrl-C (and a request to terminate) stops the render through `control`, so that what is half
/// done is cleaned up. The second time it ends the process at once.
///
/// Until this is called the signals do what they always do, which is right as long as there is nothing to
/// clean up. Where they are ignored, as `nohup` asks, they stay ignored.
pub(crate) fn stops(control: &Arc<Control>) {
    let control = Arc::clone(control);
    let again = AtomicBool::new(false);
    // Without a handler Ctrl-C ends the process all the same, only less tidily.
    let _ = ctrlc::try_set_handler(move || {
        if again.swap(true, Ordering::Relaxed) {
            process::exit(INTERRUPTED);
        }
        control.cancel();
    });
}
