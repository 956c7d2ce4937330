//! `hray INPUT.hry OUTPUT.ppm`: the command of 2005.

use crate::args::{ClassicArgs, Cli};
use crate::console::Console;
use crate::failure::Failure;
use crate::job::{self, Job};
use clap::CommandFactory;
use hray::{Destination, Input, LoadOptions, Options, PictureFormat, Quoted};
use std::ffi::OsStr;
use std::path::Path;
use std::time::Duration;

/// One letter in so many may be wrong in the name of a command for it to be recognised, and two at most.
const LETTERS_PER_TYPO: usize = 3;
const MAX_TYPOS: usize = 2;

/// Renders as the program of 2005 did, and says the same two lines about it.
pub(crate) fn run(arguments: &ClassicArgs, console: &Console) -> Result<(), Failure> {
    let (input, output) = match (&arguments.input, &arguments.output) {
        (Some(input), Some(output)) => (input, output),
        (Some(input), None) => return Err(one_name(input)),
        (None, _) => return Err(Failure::usage("name the scene, for instance `hray render scene.hry`")),
    };
    if let Some(command) = meant_command(input) {
        let rest: Vec<_> =
            [output.as_os_str()].into_iter().chain(arguments.more.iter().map(AsRef::as_ref)).collect();
        return Err(no_command(input, &command, &rest.join(OsStr::new(" ")).to_string_lossy()));
    }
    if !arguments.more.is_empty() {
        return Err(Failure::usage(
            "the classic form takes two names, of a scene and of its picture; to render several scenes, call hray \
             for each",
        ));
    }
    check_output(input, output)?;
    let source = Input::from_argument(input.clone());
    job::check_not_an_input(output, &source, &arguments.common)?;
    let destination = Destination::file(output).map_err(hray::Error::from)?;
    let load = LoadOptions { levels: arguments.lints.levels.clone(), ..LoadOptions::default() };
    let file = job::read_scene(&source, &load, console)?;
    job::check_not_read(output, &file)?;
    let noise_tables = job::noise_tables(&arguments.common)?;
    let options = Options { threads: arguments.common.threads, noise_tables, ..Options::default() };

    let format = PictureFormat::PpmAscii;
    let description = job::description(&file)?;
    let job = Job { description, options: &options, destination: &destination, name: output, format };
    let (_, time) = job.run(console, false)?;
    let text = format!(
        "Image output written to {} in PPM format\nTime needed to render the image: {}\n",
        output.display(),
        minutes_and_seconds(time)
    );
    console.print(text.as_bytes()).map_err(|error| Failure::stdout(&error))
}

/// `0m07s`.
fn minutes_and_seconds(time: Duration) -> String {
    let seconds = time.as_secs();
    format!("{}m{:02}s", seconds / 60, seconds % 60)
}

/// The command that is almost what was typed in place of a file that does not exist.
fn meant_command(typed: &Path) -> Option<String> {
    let text = typed.to_str().filter(|_| std::fs::symlink_metadata(typed).is_err())?.to_lowercase();
    let near = |name: &str| (strsim::osa_distance(&text, name), name.to_owned());
    let nearest = Cli::command().get_subcommands().map(|command| near(command.get_name())).min()?;
    let allowed = (nearest.1.len() / LETTERS_PER_TYPO).min(MAX_TYPOS);
    (nearest.0 <= allowed).then_some(nearest.1)
}

fn one_name(input: &Path) -> Failure {
    match meant_command(input) {
        Some(command) => no_command(input, &command, "..."),
        None => Failure::usage(format!(
            "there is one name where the classic form takes two; to render {} to a PNG: `hray render {}`",
            Quoted(input),
            input.display()
        )),
    }
}

fn no_command(typed: &Path, command: &str, rest: &str) -> Failure {
    if typed.as_os_str() == command {
        return Failure::usage(format!("options come after the command: `hray {command} {rest} [OPTIONS]`"));
    }
    Failure::usage(format!(
        "there is no command and no file {}; did you mean `hray {command} {rest}`?",
        Quoted(typed)
    ))
}

/// The classic form writes PPM; a name that promises something else is refused.
fn check_output(input: &Path, output: &Path) -> Result<(), Failure> {
    let (from, to) = (input.display(), output.display());
    let instead = match PictureFormat::from_path(output) {
        _ if output.as_os_str() == "-" => format!("hray render {from} -o - --format ppm-ascii"),
        Ok(PictureFormat::Ppm) => return Ok(()),
        Ok(_) => format!("hray render {from} -o {to}"),
        Err(_) if output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("hry")) => {
            return Err(Failure::usage(format!(
                "{} is named as a scene, and the picture would be written to it; to render several scenes, call \
                 hray for each",
                Quoted(output)
            )));
        }
        Err(_) => return Ok(()),
    };
    Err(Failure::usage(format!(
        "the classic form writes PPM to a file; for {} use `{instead}`",
        Quoted(output)
    )))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_written_as_in_2005() {
        let text = |millis| minutes_and_seconds(Duration::from_millis(millis));
        assert_eq!([text(0), text(7_999), text(61_000)], ["0m00s", "0m07s", "1m01s"]);
        assert_eq!(text(3_600_000 + 5_000), "60m05s");
    }

    #[test]
    fn a_command_with_a_typo_is_recognised() {
        let meant = |typed| meant_command(Path::new(typed));
        assert_eq!(meant("rendr").as_deref(), Some("render"));
        assert_eq!(meant("Chekc").as_deref(), Some("check"));
        assert_eq!((meant("scene.hry"), meant("no-such-file")), (None, None));
        assert_eq!((meant("a"), meant("mn").as_deref()), (None, Some("man")));
    }
}
