//! `hray check`.

use crate::args::CheckArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::summary::counted;
use crate::{job, lint_args};
use hray::{Finding, Findings, Input, LoadOptions, Quoted, SceneFile};
use std::path::Path;

/// What comes after the help: the warnings, and the shape of the JSON.
pub(crate) fn after_help() -> String {
    format!("{}\n{JSON}", lint_args::list())
}

const JSON: &str = "\
With --json the standard output is one list of findings, of all files, in this shape:

  [ { \"file\": \"scene.hry\", \"severity\": \"error\", \"code\": \"unknown-name\",
      \"message\": \"there is no `spere`\",
      \"labels\": [ { \"file\": \"scene.hry\", \"line\": 3, \"column\": 15, \"end_line\": 3,
                    \"end_column\": 20, \"start\": 47, \"end\": 52,
                    \"text\": \"not defined\", \"primary\": true } ],
      \"notes\": [], \"help\": null,
      \"suggestion\": { \"file\": \"scene.hry\", \"line\": 3, ..., \"replacement\": \"sphere\",
                      \"text\": \"did you mean `sphere`?\" } } ]

Lines and columns count from 1, columns in characters; `start` and `end` are bytes from the start of the file. The
place that a finding is about comes first; a finding about a file as a whole has no labels. `suggestion` may be null.";

/// Shows the diagnostics of all scenes and counts them.
pub(crate) fn run(arguments: &CheckArgs, console: &Console) -> Result<(), Failure> {
    let load = LoadOptions {
        modules: true,
        ..arguments.scene.options(&arguments.lints.levels, arguments.time.unwrap_or(0.0))
    };
    let (mut errors, mut warnings) = (0, 0);
    let mut findings = Findings(Vec::new());
    for path in &arguments.inputs {
        let input = Input::from_argument(path.clone());
        match console.with_patience(job::READING, || SceneFile::read(&input, &load)) {
            Ok(file) => {
                if arguments.json {
                    findings.0.extend(file.findings().0);
                } else {
                    console.say(job::report(&file, console));
                    if let Some(definitions) = file.module().filter(|_| file.errors() == 0) {
                        let count = counted(definitions, "definition");
                        let name = Quoted(Path::new(&input.name())).to_string();
                        console.say(format_args!("{name} has no scene, only {count} for others to import\n"));
                    }
                }
                errors += file.errors();
                warnings += file.warnings();
            }
            Err(error) => {
                if arguments.json {
                    findings.0.push(Finding::about_file(&input.name(), "unreadable", error.to_string()));
                } else {
                    console.error(error);
                }
                errors += 1;
            }
        }
    }
    if arguments.json {
        let text = serde_json::to_string_pretty(&findings)
            .map_err(|error| Failure::Wrong(format!("cannot write JSON: {error}")))?;
        console.print(format!("{text}\n").as_bytes()).map_err(|error| Failure::stdout(&error))?;
    } else {
        console.say(format_args!(
            "checked {}: {}, {}\n",
            counted(arguments.inputs.len(), "file"),
            counted(errors, "error"),
            counted(warnings, "warning")
        ));
    }
    if errors == 0 { Ok(()) } else { Err(Failure::Told) }
}
