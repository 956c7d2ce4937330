//! `hray fmt`.

use crate::args::FmtArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::summary::counted;
use hray::{Destination, Error, Formatted, Input, Quoted};
use std::path::Path;

/// What became of a file.
enum Outcome {
    Same,
    Changed,
    Failed,
}

/// Lays out scenes.
pub(crate) fn run(arguments: &FmtArgs, console: &Console) -> Result<(), Failure> {
    let (mut changed, mut failed) = (0, 0);
    for path in &arguments.inputs {
        match format(&Input::from_argument(path.clone()), arguments.check, console)? {
            Outcome::Same => {}
            Outcome::Changed => changed += 1,
            Outcome::Failed => failed += 1,
        }
    }
    if arguments.check && changed > 0 {
        let (noun, verb) = if changed == 1 { ("", "is") } else { ("s", "are") };
        console.say(format_args!(
            "{changed} of {} file{noun} {verb} laid out differently; `hray fmt` changes that\n",
            arguments.inputs.len()
        ));
    }
    if failed > 0 {
        console.say(format_args!("{} could not be laid out\n", counted(failed, "file")));
    }
    if failed > 0 || (arguments.check && changed > 0) { Err(Failure::Told) } else { Ok(()) }
}

fn format(input: &Input, check: bool, console: &Console) -> Result<Outcome, Failure> {
    let name = input.name();
    let bytes = match hray::read_source(input) {
        Ok(bytes) => bytes,
        Err(error) => {
            console.error(error);
            return Ok(Outcome::Failed);
        }
    };
    let text = match hray::format_scene(&name, &bytes) {
        Formatted::Text(text) => text,
        Formatted::Classic => {
            console.error(format_args!(
                "{} is a classic scene, and those keep their layout; `hray convert` makes one in hry of it",
                Quoted(Path::new(&name))
            ));
            return Ok(Outcome::Failed);
        }
        Formatted::Errors(report) => {
            console.say(report.text(console.has_color()));
            return Ok(Outcome::Failed);
        }
    };
    let same = text.as_bytes() == bytes;
    match input {
        _ if check && !same => {
            console.print(format!("{name}\n").as_bytes()).map_err(|error| Failure::stdout(&error))?;
        }
        Input::Stdin if !check => {
            console.print(text.as_bytes()).map_err(|error| Failure::stdout(&error))?;
        }
        Input::File(path) if !same => {
            let written = Destination::file(path).and_then(|place| hray::write_text(&place, &text));
            if let Err(error) = written.map_err(Error::from) {
                console.error(error);
                return Ok(Outcome::Failed);
            }
        }
        _ => {}
    }
    Ok(if same { Outcome::Same } else { Outcome::Changed })
}
