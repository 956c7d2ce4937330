//! The command `hray`.
//!
//! Everything here is about words: reading the command line, saying what happened, and the exit code. What the
//! words stand for is done by the `hray` library.
//!
//! Exit codes: 0 where all went well; 1 where the input is wrong, or something could not be read or written;
//! 2 where the command line is wrong; 130 after Ctrl-C.

mod animate;
mod args;
mod check;
mod classic;
mod console;
mod convert;
mod explain;
mod explain_text;
mod failure;
mod fmt;
mod generate;
mod hints;
mod info;
mod interrupt;
mod job;
mod lint_args;
mod lsp;
mod pattern;
mod progress;
mod render;
mod scene_args;
mod studio;
mod summary;
mod values;

use args::{Cli, Command};
use clap::Parser;
use console::Console;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let console = Console::new();
    match run(&console) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.tell(&console),
    }
}

fn run(console: &Console) -> Result<(), Failure> {
    let cli = Cli::try_parse().map_err(hints::explain)?;
    match &cli.command {
        None => classic::run(&cli.classic, console),
        Some(Command::Render(arguments)) => render::run(arguments, console),
        Some(Command::Check(arguments)) => check::run(arguments, console),
        Some(Command::Info(arguments)) => info::run(arguments, console),
        Some(Command::Explain(arguments)) => explain::run(arguments, console),
        Some(Command::Fmt(arguments)) => fmt::run(arguments, console),
        Some(Command::Convert(arguments)) => convert::run(arguments, console),
        Some(Command::Lsp { .. }) => lsp::run(),
        Some(Command::Studio(arguments)) => studio::run(arguments, console),
        Some(Command::Completions { shell }) => generate::completions(*shell, console),
        Some(Command::Man { command }) => generate::man(command.as_deref(), console),
    }
}
