//! What the classic form and `hray render` have in common: a scene is read, rendered, and written.

use crate::args::CommonArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::{interrupt, progress};
use hray::{
    Control, Description, Destination, Error, Input, LoadOptions, NoiseTables, Options, PictureFormat,
    Quoted, SceneFile, Statistics,
};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What reading a scene is called where it takes long.
pub(crate) const READING: &str = "working out the scene";

/// Reads a scene without errors and shows its warnings.
pub(crate) fn read_scene(
    input: &Input,
    options: &LoadOptions,
    console: &Console,
) -> Result<SceneFile, Failure> {
    let file = console.with_patience(READING, || SceneFile::read(input, options)).map_err(Error::from)?;
    console.say(report(&file, console));
    if file.description().is_some() { Ok(file) } else { Err(Failure::Told) }
}

/// What a scene without errors describes.
pub(crate) fn description(file: &SceneFile) -> Result<&Description, Failure> {
    file.description().ok_or(Failure::Told)
}

/// The diagnostics of a scene, and an empty line to set them off from what follows.
pub(crate) fn report(file: &SceneFile, console: &Console) -> String {
    let mut text = file.report(console.has_color());
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

/// The noise tables that were asked for, or hray's own.
pub(crate) fn noise_tables(common: &CommonArgs) -> Result<NoiseTables, Failure> {
    match &common.noise_tables {
        None => Ok(NoiseTables::default()),
        Some(path) => Ok(hray::read_noise_tables(path).map_err(Error::from)?),
    }
}

/// Refuses to replace what the picture is made from.
pub(crate) fn check_not_an_input(output: &Path, input: &Input, common: &CommonArgs) -> Result<(), Failure> {
    if hray::same_file(output, input.path()) {
        Err(would_replace(output, "the scene"))
    } else if common.noise_tables.as_ref().is_some_and(|tables| hray::same_file(output, tables)) {
        Err(would_replace(output, "the noise tables"))
    } else {
        Ok(())
    }
}

/// Refuses to replace a file that the scene imports, or an image that it uses.
pub(crate) fn check_not_read(output: &Path, file: &SceneFile) -> Result<(), Failure> {
    if file.images().iter().any(|image| hray::same_file(output, image)) {
        return Err(would_replace(output, "an image that the scene uses,"));
    }
    let mut imported = file.sources().files().iter().skip(1);
    if imported.any(|source| hray::same_file(output, Path::new(&source.name))) {
        return Err(would_replace(output, "a file that the scene imports,"));
    }
    Ok(())
}

fn would_replace(output: &Path, what: &str) -> Failure {
    let output = Quoted(output);
    Failure::Usage(format!("the picture would replace {what} {output}; choose another name for it"))
}

/// A picture to be made.
#[derive(Debug)]
pub(crate) struct Job<'a> {
    /// The scene.
    pub description: &'a Description,
    /// How to render it.
    pub options: &'a Options,
    /// Where the picture goes.
    pub destination: &'a Destination,
    /// And how it is called in messages.
    pub name: &'a Path,
    /// Its format.
    pub format: PictureFormat,
}

impl Job<'_> {
    /// Renders and writes the picture; what it took.
    pub(crate) fn run(&self, console: &Console, quiet: bool) -> Result<(Statistics, Duration), Failure> {
        let Self { description, options, destination, format, .. } = *self;
        let settings = options.settings(description).map_err(Error::from)?;
        let control = Arc::new(Control::new());
        interrupt::stops(&control);
        let start = Instant::now();
        let render = || hray::render_to(description, options, destination, format, &control);
        let result = if quiet {
            render()
        } else {
            progress::watching(console, &control, settings.region.pixels(), render)
        };
        match result {
            Ok(statistics) => Ok((statistics, start.elapsed())),
            Err(Error::Cancelled) => Err(Failure::Interrupted(self.interrupted())),
            Err(error) => Err(error.into()),
        }
    }

    fn interrupted(&self) -> String {
        if self.destination.is_stdout() {
            "interrupted: the picture on the standard output is not complete".to_owned()
        } else if self.destination.is_direct() {
            format!("interrupted: the picture on {} is not complete", Quoted(self.name))
        } else {
            format!("interrupted: nothing was written to {}", Quoted(self.name))
        }
    }
}
