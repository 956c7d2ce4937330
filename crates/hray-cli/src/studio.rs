//! `hray studio`.

use crate::args::StudioArgs;
use crate::console::Console;
use crate::failure::Failure;
use hray_studio::{Options, Server};

/// Serves the studio until it is interrupted.
pub(crate) fn run(arguments: &StudioArgs, console: &Console) -> Result<(), Failure> {
    let options = Options { target: arguments.target.clone(), port: arguments.port };
    let server = Server::start(&options).map_err(|error| Failure::Wrong(error.to_string()))?;
    let address = format!("{}\n", server.address());
    console.print(address.as_bytes()).map_err(|error| Failure::stdout(&error))?;
    console.say("The studio is open at this address. Ctrl-C ends it.\n");
    if !arguments.no_open && hray_studio::open_in_browser(server.address()).is_err() {
        console.say("No browser could be started; open the address in one.\n");
    }
    server.wait().map_err(|error| Failure::Wrong(error.to_string()))
}
