//! Rendering a description to wherever its picture is wanted.

use crate::picture::Memory;
use crate::{
    AnimationWriter, Control, Description, Destination, Error, Options, OutputError, Picture, PictureFormat,
    Settings, Statistics,
};
use hray_io::PictureWriter;
use hray_render::RenderError;
use std::convert::Infallible;
use std::path::Path;

/// Renders to a file, in the format that its name tells. The file appears when it is complete; until then,
/// and where anything fails, what was there before is untouched.
///
/// # Errors
/// [`Error::Format`] where the name does not tell a format, and those of [`render_to`].
pub fn render_to_file(
    description: &Description,
    options: &Options,
    path: impl AsRef<Path>,
    control: &Control,
) -> Result<Statistics, Error> {
    let path = path.as_ref();
    let format = PictureFormat::from_path(path)?;
    render_to(description, options, &Destination::file(path)?, format, control)
}

/// Renders to a file, a device or the standard output.
///
/// Everything that can be refused is refused before the first ray. Pixels are written as they are rendered,
/// so that memory does not grow with the picture, except in formats that want the whole of it at once.
///
/// # Errors
/// [`Error::Options`], [`Error::Output`], [`Error::Cancelled`], [`Error::Threads`], [`Error::Solids`].
pub fn render_to(
    description: &Description,
    options: &Options,
    destination: &Destination,
    format: PictureFormat,
    control: &Control,
) -> Result<Statistics, Error> {
    let settings = options.settings(description)?;
    let [width, height] = size(&settings);
    let writer = PictureWriter::create(destination, format, width, height)?;
    render_into(description, options, &settings, format, writer, control)
}

/// Renders one frame of an animation. Its size is that of the animation.
///
/// # Errors
/// As [`render_to`].
pub fn render_frame(
    description: &Description,
    options: &Options,
    animation: &mut AnimationWriter,
    control: &Control,
) -> Result<Statistics, Error> {
    let settings = options.settings(description)?;
    // The pixels of an animation are those of a PNG.
    let encode = |run: &[crate::Rgb]| PictureFormat::Png.encode(run, description.encoding);
    hray_render::render(description, &options.noise_tables, &settings, control, encode, |bytes| {
        animation.write(&bytes)
    })
    .map_err(from_render)
}

fn from_render(error: RenderError<OutputError>) -> Error {
    match error {
        RenderError::Cancelled => Error::Cancelled,
        RenderError::Threads => Error::Threads,
        RenderError::Solids => Error::Solids,
        RenderError::Sink(error) => Error::Output(error),
    }
}

/// Renders to the bytes of a file of that format.
///
/// # Errors
/// As [`render_to`].
pub fn render_to_bytes(
    description: &Description,
    options: &Options,
    format: PictureFormat,
    control: &Control,
) -> Result<(Vec<u8>, Statistics), Error> {
    let settings = options.settings(description)?;
    let [width, height] = size(&settings);
    let memory = Memory::default();
    let writer = PictureWriter::to_writer(memory.clone(), Path::new("-"), format, width, height)?;
    let statistics = render_into(description, options, &settings, format, writer, control)?;
    Ok((memory.take(), statistics))
}

/// Renders to colours in double precision, 24 bytes a pixel.
///
/// # Errors
/// [`Error::Options`], [`Error::Cancelled`], [`Error::Threads`], [`Error::Solids`], [`Error::Memory`].
pub fn render_to_memory(
    description: &Description,
    options: &Options,
    control: &Control,
) -> Result<(Picture, Statistics), Error> {
    let settings = options.settings(description)?;
    let [width, height] = size(&settings);
    let count = settings.region.pixels();
    let mut pixels = Vec::new();
    let reserved = usize::try_from(count).ok().and_then(|n| pixels.try_reserve_exact(n).ok());
    reserved.ok_or(Error::Memory { bytes: count * size_of::<crate::Rgb>() as u64 })?;
    let statistics = hray_render::render(
        description,
        &options.noise_tables,
        &settings,
        control,
        <[crate::Rgb]>::to_vec,
        |run| {
            pixels.extend_from_slice(&run);
            Ok::<(), Infallible>(())
        },
    )
    .map_err(|error| match error {
        RenderError::Cancelled => Error::Cancelled,
        RenderError::Threads => Error::Threads,
        RenderError::Solids => Error::Solids,
        RenderError::Sink(never) => match never {},
    })?;
    // A finished render has given every pixel of the region.
    let picture = Picture::new(width, height, description.encoding, pixels).ok_or(Error::Cancelled)?;
    Ok((picture, statistics))
}

fn size(settings: &Settings) -> [u32; 2] {
    [settings.region.width(), settings.region.height()]
}

fn render_into(
    description: &Description,
    options: &Options,
    settings: &Settings,
    format: PictureFormat,
    mut writer: PictureWriter,
    control: &Control,
) -> Result<Statistics, Error> {
    let statistics = hray_render::render(
        description,
        &options.noise_tables,
        settings,
        control,
        |run| format.encode(run, description.encoding),
        |bytes| writer.write(&bytes),
    )
    .map_err(from_render)?;
    writer.finish()?;
    Ok(statistics)
}
