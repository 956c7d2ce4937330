//! Better words than clap's for what is typed by habit.

use crate::args::Cli;
use crate::failure::Failure;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Error};
use hray::{PictureFormat, Quoted};
use std::ffi::OsString;
use std::path::Path;

/// What to say of a command line that clap refuses.
pub(crate) fn explain(error: Error) -> Failure {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    hint(&error, &arguments).map_or(Failure::CommandLine(error), Failure::Usage)
}

fn hint(error: &Error, arguments: &[OsString]) -> Option<String> {
    let (ErrorKind::UnknownArgument, Some(ContextValue::String(unknown))) =
        (error.kind(), error.get(ContextKind::InvalidArg))
    else {
        return None;
    };
    if let Some(hint) = split_setting(unknown, arguments).or_else(|| split_size(unknown, arguments)) {
        return Some(hint);
    }
    let cli = Cli::command();
    let is_command = |name: &OsString| cli.get_subcommands().any(|command| name == command.get_name());
    match arguments.iter().find(|argument| is_command(argument)) {
        Some(command) if command == "render" && !unknown.starts_with('-') => Some(second_name(unknown)),
        Some(command) if command == "convert" && !unknown.starts_with('-') => Some(format!(
            "unexpected argument {}; to name the new scene write `-o {}`",
            Quoted(Path::new(unknown)),
            unknown.escape_debug()
        )),
        Some(_) => None,
        None => {
            let render = cli.find_subcommand("render")?;
            let known = render.get_arguments().any(|argument| {
                argument.get_long().is_some_and(|long| unknown.strip_prefix("--") == Some(long))
                    || argument.get_short().is_some_and(|short| *unknown == format!("-{short}"))
            });
            known.then(|| classic_option(unknown, arguments))
        }
    }
}

/// `--set count 3`, or `--set count = 3`.
fn split_setting(unknown: &str, arguments: &[OsString]) -> Option<String> {
    let place = arguments.windows(3).position(|three| three[0] == "--set" && three[2] == unknown)?;
    let name = arguments.get(place + 1)?.to_str().filter(|name| !name.contains('='))?;
    let value = arguments.get(place + 2..)?.iter().find(|value| *value != "=")?.to_string_lossy();
    let value = value.trim_start_matches('=');
    Some(format!("a setting is one word: `--set {}={}`", name.escape_debug(), value.escape_debug()))
}

/// `--size 320 240`
fn split_size(unknown: &str, arguments: &[OsString]) -> Option<String> {
    let place = arguments.windows(3).position(|three| three[0] == "--size" && three[2] == unknown)?;
    let width = arguments.get(place + 1)?.to_str()?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    (is_number(width) && is_number(unknown))
        .then(|| format!("a size is one word: `--size {width}x{unknown}`"))
}

/// `hray render a.hry x.png`.
fn second_name(name: &str) -> String {
    let quoted = Quoted(Path::new(name));
    if has_extension(Path::new(name), "hry") {
        return format!("unexpected argument {quoted}; to render several scenes, call hray for each");
    }
    format!("unexpected argument {quoted}; to name the picture write `-o {}`", name.escape_debug())
}

/// `hray a.hry o.ppm --samples 4`.
fn classic_option(option: &str, arguments: &[OsString]) -> String {
    let paths = || arguments.iter().map(Path::new);
    let shown = |path: &Path| path.to_string_lossy().escape_debug().to_string();
    let input = paths().find(|path| has_extension(path, "hry")).map_or_else(|| "INPUT.hry".to_owned(), shown);
    let output = paths().find(|path| PictureFormat::from_path(path).is_ok());
    let output = output.map_or_else(|| "OUTPUT.ppm".to_owned(), shown);
    let rest = if matches!(option, "-o" | "--output") { String::new() } else { format!(" {option} ...") };
    format!("the classic form takes no {option}; use `hray render {input} -o {output}{rest}`")
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}
