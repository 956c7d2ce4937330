//! What the command says, and where.

use indicatif::ProgressBar;
use std::fmt::Display;
use std::io::{self, IsTerminal, Write};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// The terminal, or whatever stands in its place. Standard output is for what was asked for; everything else
/// goes to standard error. Where standard error itself cannot be written to there is nobody left to tell, so
/// that is not an error.
#[derive(Debug)]
pub(crate) struct Console {
    interactive: bool,
    color: bool,
    /// The bar that is being shown.
    bar: Mutex<Option<ProgressBar>>,
}

impl Console {
    /// Looks at what standard error is. Colours are for terminals that know them, and for users who did not
    /// decline them (<https://no-color.org>).
    pub(crate) fn new() -> Self {
        let interactive = io::stderr().is_terminal();
        let declined = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let dumb = std::env::var_os("TERM").is_none_or(|term| term == "dumb");
        Self { interactive, color: interactive && !declined && !(dumb && cfg!(unix)), bar: Mutex::default() }
    }

    /// Whether somebody is watching standard error.
    pub(crate) const fn is_interactive(&self) -> bool {
        self.interactive
    }

    /// Whether to use colours on it.
    pub(crate) const fn has_color(&self) -> bool {
        self.color
    }

    /// Says what went wrong.
    pub(crate) fn error(&self, message: impl Display) {
        self.titled("error", "91", message);
    }

    /// Says what may be wrong.
    pub(crate) fn warning(&self, message: impl Display) {
        self.titled("warning", "93", message);
    }

    fn titled(&self, title: &str, color: &str, message: impl Display) {
        if self.color {
            self.say(format_args!("\x1b[1;{color}m{title}\x1b[0m\x1b[1m: {message}\x1b[0m\n"));
        } else {
            self.say(format_args!("{title}: {message}\n"));
        }
    }

    /// Writes text as it is to standard error. A bar makes way for it.
    pub(crate) fn say(&self, text: impl Display) {
        let text = text.to_string();
        if text.is_empty() {
            return;
        }
        // In one piece, so that the lines of several processes do not mix.
        let write = || {
            let _ = io::stderr().lock().write_all(text.as_bytes());
        };
        match &*self.bar.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    /// Shows a bar while `action` runs.
    pub(crate) fn with_bar<T>(&self, bar: &ProgressBar, action: impl FnOnce() -> T) -> T {
        let set = |bar| *self.bar.lock().unwrap_or_else(PoisonError::into_inner) = bar;
        set(Some(bar.clone()));
        let result = action();
        set(None);
        bar.finish_and_clear();
        result
    }

    /// Says what is going on where `action` takes more than two seconds.
    pub(crate) fn with_patience<T>(&self, doing: &str, action: impl FnOnce() -> T) -> T {
        const PATIENCE: Duration = Duration::from_secs(2);
        let (done, wait) = mpsc::channel::<()>();
        thread::scope(|scope| {
            scope.spawn(move || {
                if wait.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                    self.say(format_args!("still {doing} ... (Ctrl-C stops)\n"));
                }
            });
            let result = action();
            drop(done);
            result
        })
    }

    /// Writes what was asked for to standard output. A reader who has left early had enough, which is no
    /// error.
    ///
    /// # Errors
    /// That of the system, for instance where the disk is full.
    pub(crate) fn print(&self, text: &[u8]) -> io::Result<()> {
        let mut out = io::stdout().lock();
        match out.write_all(text).and_then(|()| out.flush()) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            result => result,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_known_while_it_is_shown() {
        let console = Console::new();
        let bar = ProgressBar::hidden();
        let is_known = || console.bar.lock().unwrap_or_else(PoisonError::into_inner).is_some();
        let inside = console.with_bar(&bar, || {
            console.say("\n");
            is_known()
        });
        assert!(inside && !is_known() && bar.is_finished());
    }
}
