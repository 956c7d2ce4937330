//! Completions and the man page, out of the definition of the command line.

use crate::args::Cli;
use crate::console::Console;
use crate::failure::Failure;
use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;

/// Prints a completion script.
pub(crate) fn completions(shell: Shell, console: &Console) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "hray", &mut script);
    console.print(&script).map_err(|error| Failure::stdout(&error))
}

/// Prints the man page of hray, or of one of its commands.
pub(crate) fn man(command: Option<&str>, console: &Console) -> Result<(), Failure> {
    let mut cli = Cli::command();
    cli.build();
    let page = match command {
        None => cli,
        Some(name) => match cli.find_subcommand(name) {
            Some(command) => command.clone(),
            None => {
                let names: Vec<_> = cli.get_subcommands().map(|command| command.get_name()).collect();
                return Err(Failure::usage(format!(
                    "there is no command `{name}`; there are {}",
                    names.join(", ")
                )));
            }
        },
    };
    let mut text = Vec::new();
    Man::new(page).render(&mut text).map_err(|error| Failure::stdout(&error))?;
    console.print(&text).map_err(|error| Failure::stdout(&error))
}
