//! The user's browser.

use std::io;
use std::process::{Command, Stdio};

/// Opens an address in the browser that the user has chosen for the system.
///
/// # Errors
/// Where there is no program that does so.
pub fn open_in_browser(address: &str) -> io::Result<()> {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(arguments).arg(address);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn()?;
    // Whoever opens it ends at once, or is the browser itself.
    std::thread::spawn(move || child.wait());
    Ok(())
}
