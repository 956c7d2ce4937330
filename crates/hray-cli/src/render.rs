//! `hray render`.

use crate::args::RenderArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::job::{self, Job};
use crate::summary;
use hray::{Description, Destination, Error, Input, Options, PictureFormat, Quoted};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Renders a scene.
pub(crate) fn run(arguments: &RenderArgs, console: &Console) -> Result<(), Failure> {
    let input = Input::from_argument(arguments.input.clone());
    let output = output_name(arguments, &input)?;
    let read = || job::read_scene(&input, &arguments.lints.levels, console);
    // A name that is made from the scene's is only as good as that one.
    let early = if arguments.output.is_none() { Some(read()?) } else { None };
    let destination = destination(&output)?;
    let format = format(arguments, &output, &destination, console)?;
    job::check_not_an_input(&output, &input, &arguments.common)?;

    let description = early.map_or_else(read, Ok)?;
    let options = Options {
        size: arguments.size,
        max_depth: arguments.depth,
        samples: arguments.samples,
        region: arguments.region,
        threads: arguments.common.threads,
        noise_tables: job::noise_tables(&arguments.common)?,
    };
    warn_of_another_shape(&options, &description, console);

    let job = Job {
        description: &description,
        options: &options,
        destination: &destination,
        name: &output,
        format,
    };
    let (statistics, time) = job.run(console, arguments.quiet)?;
    if !arguments.quiet {
        console.say(summary::of(&job, &statistics, time));
    }
    Ok(())
}

/// The picture's name: as it was given, or the scene's with another extension.
fn output_name(arguments: &RenderArgs, input: &Input) -> Result<PathBuf, Failure> {
    match (&arguments.output, input) {
        (Some(output), _) => Ok(output.clone()),
        (None, Input::Stdin) => Err(Failure::Usage(
            "a scene from the standard input has no name to call the picture by; give one with -o, or `-o -` \
             for the standard output"
                .to_owned(),
        )),
        (None, Input::File(path)) => {
            let format = arguments.format.unwrap_or(PictureFormat::Png);
            // The text form of PPM has no extension of its own.
            Ok(path.with_extension(format.extensions().first().unwrap_or(&"ppm")))
        }
    }
}

fn destination(output: &Path) -> Result<Destination, Failure> {
    if output.as_os_str() == "-" {
        return Ok(Destination::stdout());
    }
    Ok(Destination::file(output).map_err(Error::from)?)
}

/// The format that was asked for; failing that, the one that the name tells; failing that, where the name is
/// not that of a file, PNG.
fn format(
    arguments: &RenderArgs,
    output: &Path,
    destination: &Destination,
    console: &Console,
) -> Result<PictureFormat, Failure> {
    let told = PictureFormat::from_path(output);
    let mut format = match (arguments.format, &told) {
        (Some(format), _) => format,
        (None, Ok(format)) => *format,
        (None, Err(_)) if destination.is_direct() => PictureFormat::Png,
        (None, Err(error)) => {
            return Err(Failure::Usage(format!("{error}; or name the format with --format")));
        }
    };
    if arguments.ascii {
        if !matches!(format, PictureFormat::Ppm | PictureFormat::PpmAscii) {
            return Err(Failure::Usage(format!(
                "--ascii is for PPM, and the picture would be {format}; give it a name that ends in .ppm with -o, \
                 or add --format ppm"
            )));
        }
        format = PictureFormat::PpmAscii;
    }
    if let Ok(told) = told
        && told != format
        && format != PictureFormat::PpmAscii
    {
        console.warning(format_args!("{} will hold a picture of the format {format}", Quoted(output)));
    }
    if destination.is_stdout() && format != PictureFormat::PpmAscii && std::io::stdout().is_terminal() {
        return Err(Failure::Usage(
            "a picture is not for reading on a terminal; redirect the standard output, or give a file with -o"
                .to_owned(),
        ));
    }
    Ok(format)
}

fn warn_of_another_shape(options: &Options, description: &Description, console: &Console) {
    let Some(size) = options.size.filter(|_| options.changes_aspect(description)) else { return };
    let scene = description.resolution;
    let aspect = |size: hray::Resolution| f64::from(size.width()) / f64::from(size.height());
    let factor = aspect(size) / aspect(scene);
    let verb = if factor > 1.0 { "stretched" } else { "squeezed" };
    console.warning(format_args!(
        "--size {size} has another shape than the scene's {scene}; the camera's window stays, so everything is \
         {verb} to {factor:.2} times its width"
    ));
}
