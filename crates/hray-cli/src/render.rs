//! `hray render`.

use crate::args::RenderArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::job::{self, Job};
use crate::pattern::Pattern;
use crate::{animate, summary};
use hray::{AnimationFormat, Description, Destination, Error, Input, Options, PictureFormat, Quoted};
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Renders a scene.
pub(crate) fn run(arguments: &RenderArgs, console: &Console) -> Result<(), Failure> {
    let input = Input::from_argument(arguments.input.clone());
    if let Some(frames) = arguments.frames {
        return animate::run(arguments, &input, frames, console);
    }
    let output = output_name(arguments, &input)?;
    let time = arguments.time.or(arguments.frame.map(|frame| animate::moment(frame, arguments)));
    let load = arguments.scene.options(&arguments.lints.levels, time.unwrap_or(0.0));
    let read = || job::read_scene(&input, &load, console);
    // A name that is made from the scene's is only as good as that one.
    let early = if arguments.output.is_none() { Some(read()?) } else { None };
    let destination = destination(&output)?;
    let format = format(arguments, &output, &destination, console)?;
    job::check_not_an_input(&output, &input, &arguments.common)?;

    let file = early.map_or_else(read, Ok)?;
    if time.is_some() {
        animate::warn_of_a_still(&file, console, "every moment of it is the same");
    }
    job::check_not_read(&output, &file)?;
    let description = job::description(&file)?;
    let options = options(arguments)?;
    warn_of_another_shape(&options, description, console);

    let job = Job { description, options: &options, destination: &destination, name: &output, format };
    let (statistics, time) = job.run(console, arguments.quiet)?;
    if !arguments.quiet {
        console.say(summary::of(&job, &statistics, time));
    }
    Ok(())
}

/// How to render.
pub(crate) fn options(arguments: &RenderArgs) -> Result<Options, Failure> {
    Ok(Options {
        size: arguments.size,
        max_depth: arguments.depth,
        samples: arguments.samples,
        region: arguments.region,
        threads: arguments.common.threads,
        noise_tables: job::noise_tables(&arguments.common)?,
    })
}

/// The picture's name: as it was given, or the scene's with another extension.
fn output_name(arguments: &RenderArgs, input: &Input) -> Result<PathBuf, Failure> {
    match (&arguments.output, input) {
        (Some(output), _) => {
            let numbered = arguments.frame.and_then(|frame| Some(Pattern::of(output)?.name(frame)));
            Ok(numbered.unwrap_or_else(|| output.clone()))
        }
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
    let unnamed = arguments.format.is_none() && PictureFormat::from_path(output).is_err();
    let format = if destination.is_direct() && unnamed {
        if arguments.ascii { return Err(not_ppm(PictureFormat::Png)) } else { PictureFormat::Png }
    } else {
        told_format(arguments, output)?
    };
    if let Ok(told) = PictureFormat::from_path(output)
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

/// The format that was asked for, else the one that the name tells.
pub(crate) fn told_format(arguments: &RenderArgs, output: &Path) -> Result<PictureFormat, Failure> {
    let format = match (arguments.format, PictureFormat::from_path(output)) {
        (Some(format), _) => format,
        (None, Ok(format)) => format,
        (None, Err(_)) if AnimationFormat::from_path(output).is_some() && arguments.frames.is_none() => {
            return Err(Failure::Usage(format!(
                "{} is the name of an animation; say which frames it has, such as `--frames 0..47`",
                Quoted(output)
            )));
        }
        (None, Err(error)) => {
            return Err(Failure::Usage(format!(
                "{error}; or name the format with --format. An animation (--frames) may also be .gif or .apng"
            )));
        }
    };
    if !arguments.ascii {
        return Ok(format);
    }
    match format {
        PictureFormat::Ppm | PictureFormat::PpmAscii => Ok(PictureFormat::PpmAscii),
        format => Err(not_ppm(format)),
    }
}

fn not_ppm(format: PictureFormat) -> Failure {
    Failure::Usage(format!(
        "--ascii is for PPM, and the picture would be {format}; give it a name that ends in .ppm with -o, or add \
         --format ppm"
    ))
}

pub(crate) fn warn_of_another_shape(options: &Options, description: &Description, console: &Console) {
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
