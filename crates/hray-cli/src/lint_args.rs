//! `--allow`, `--warn` and `--deny`, where the last word on a warning counts.

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches};
use hray::{ALL_LINTS, CLASSIC_LINTS, LINTS, Level, Lint, LintLevels};
use std::fmt::Write;

const FLAGS: [(&str, Level, &str); 3] = [
    (
        "allow",
        Level::Allow,
        "Do not give this warning; `warnings` means all, and `hray check --help` lists the codes",
    ),
    ("warn", Level::Warn, "Give this warning, after all"),
    ("deny", Level::Deny, "Take this warning for an error"),
];

/// The levels that the command line sets.
#[derive(Clone, Debug, Default)]
pub(crate) struct LintArgs {
    /// The level of every warning.
    pub levels: LintLevels,
}

impl FromArgMatches for LintArgs {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut args = Self::default();
        args.update_from_arg_matches(matches)?;
        Ok(args)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        let mut settings = Vec::new();
        for (flag, level, _) in FLAGS {
            let places = matches.indices_of(flag).into_iter().flatten();
            let codes = matches.get_many::<String>(flag).into_iter().flatten();
            settings.extend(places.zip(codes).map(|(place, code)| (place, code, level)));
        }
        settings.sort_unstable_by_key(|(place, ..)| *place);
        for (_, code, level) in settings {
            // clap has accepted known codes only.
            let _ = self.levels.set(code, level);
        }
        Ok(())
    }
}

impl Args for LintArgs {
    fn augment_args(command: Command) -> Command {
        FLAGS.into_iter().fold(command, |command, (flag, _, help)| {
            let codes = LINTS.iter().map(|lint| lint.code).chain([ALL_LINTS]);
            command.arg(
                Arg::new(flag)
                    .long(flag)
                    .value_name("CODE")
                    .action(ArgAction::Append)
                    .value_parser(PossibleValuesParser::new(codes))
                    .hide_possible_values(true)
                    .help_heading("Warnings")
                    .help(help),
            )
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// All warnings, for the end of a help text.
pub(crate) fn list() -> String {
    let mut text =
        String::from("Warnings that can be allowed, and denied, by their codes.\n\nIn scenes in hry:\n");
    describe(&mut text, hray::hry_lints());
    text.push_str("\nIn classic scenes:\n");
    describe(&mut text, CLASSIC_LINTS);
    text
}

fn describe(text: &mut String, lints: &[Lint]) {
    for lint in lints {
        // Writing to a string cannot fail.
        let _ = write!(text, "\n  {}\n", lint.code);
        let mut line = String::from("     ");
        for word in lint.explanation.split(' ') {
            if line.len() + word.len() > 90 {
                text.push_str(&line);
                text.push('\n');
                line = String::from("     ");
            }
            line.push(' ');
            line.push_str(word);
        }
        text.push_str(&line);
        text.push('\n');
    }
}
