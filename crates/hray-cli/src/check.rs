//! `hray check`.

use crate::args::CheckArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::job;
use crate::summary::counted;
use hray::{Input, SceneFile};

/// Shows the diagnostics of all scenes and counts them.
pub(crate) fn run(arguments: &CheckArgs, console: &Console) -> Result<(), Failure> {
    let (mut errors, mut warnings) = (0, 0);
    for path in &arguments.inputs {
        match SceneFile::read(&Input::from_argument(path.clone()), &arguments.lints.levels) {
            Ok(file) => {
                console.say(job::report(&file, console));
                errors += file.errors();
                warnings += file.warnings();
            }
            Err(error) => {
                console.error(error);
                errors += 1;
            }
        }
    }
    console.say(format_args!(
        "checked {}: {}, {}\n",
        counted(arguments.inputs.len(), "file"),
        counted(errors, "error"),
        counted(warnings, "warning")
    ));
    if errors == 0 { Ok(()) } else { Err(Failure::Told) }
}
