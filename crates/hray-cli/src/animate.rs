//! `hray render --frames`: many pictures, or one file that holds them all.

use crate::args::RenderArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::job;
use crate::pattern::Pattern;
use crate::summary::{self, Total};
use crate::values::Frames;
use crate::{interrupt, progress};
use hray::{
    AnimationFormat, AnimationWriter, Control, Description, Destination, Error, Input, Moments, Options,
    PictureFormat, Quoted, SceneFile, Statistics,
};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// Frames a second where nothing else is asked for.
pub(crate) const DEFAULT_FPS: f64 = 24.0;

/// Where frames go.
enum Target {
    /// A picture each.
    Numbered(Pattern, PictureFormat),
    /// One file.
    OneFile(PathBuf, AnimationFormat),
}

/// The moment that a frame shows.
pub(crate) fn moment(frame: u32, arguments: &RenderArgs) -> f64 {
    f64::from(frame) / arguments.fps.unwrap_or(DEFAULT_FPS)
}

/// Says that time changes nothing, where that was surely not expected.
pub(crate) fn warn_of_a_still(file: &SceneFile, console: &Console, what: &str) {
    if !file.is_animated() {
        console.warning(format_args!(
            "the scene is not a function of the time, so {what}; in hry, `scene time = {{ ... }}` is one"
        ));
    }
}

/// Renders frames.
pub(crate) fn run(
    arguments: &RenderArgs,
    input: &Input,
    frames: Frames,
    console: &Console,
) -> Result<(), Failure> {
    let target = target(arguments, input, frames)?;
    let load = arguments.scene.options(&arguments.lints.levels, moment(frames.first, arguments));
    let file = job::read_scene(input, &load, console)?;
    if frames.count() > 1 {
        warn_of_a_still(&file, console, "all frames are alike");
    }
    let options = super::render::options(arguments)?;
    super::render::warn_of_another_shape(&options, job::description(&file)?, console);
    let animation = Animation {
        arguments,
        frames,
        options: &options,
        moments: file.moments(),
        first: Some(file.clone()),
        known: file.diagnostics().len(),
        control: Arc::new(Control::new()),
        console,
        total: Total::default(),
    };
    interrupt::stops(&animation.control);
    match target {
        Target::Numbered(pattern, format) => {
            for number in [frames.first, frames.last] {
                job::check_not_an_input(&pattern.name(number), input, &arguments.common)?;
            }
            animation.numbered(&pattern, format)
        }
        Target::OneFile(path, format) => {
            job::check_not_an_input(&path, input, &arguments.common)?;
            job::check_not_read(&path, &file)?;
            animation.one_file(&path, format)
        }
    }
}

/// Where the frames go, from the name of the output.
fn target(arguments: &RenderArgs, input: &Input, frames: Frames) -> Result<Target, Failure> {
    let output = match (&arguments.output, input) {
        (Some(output), _) => output.clone(),
        (None, Input::Stdin) => {
            return Err(Failure::Usage(
                "a scene from the standard input has no name to call its frames by; give one with \
                 `-o frame-####.png`"
                    .to_owned(),
            ));
        }
        (None, Input::File(path)) => numbered(path, "png"),
    };
    if output.as_os_str() == "-" {
        return Err(Failure::Usage(format!(
            "frames do not go to the standard output; name files with `-o {}`",
            numbered(Path::new("frame.png"), "png").display()
        )));
    }
    if let Some(pattern) = Pattern::of(&output) {
        let format = super::render::told_format(arguments, &output)?;
        return Ok(Target::Numbered(pattern, format));
    }
    if arguments.ascii || arguments.format.is_some() {
        return Err(Failure::Usage(format!(
            "--format and --ascii are for numbered pictures; write `-o {}`",
            numbered(&output, "png").display()
        )));
    }
    match AnimationFormat::from_path(&output) {
        Some(format) => Ok(Target::OneFile(output, format)),
        None => Err(Failure::Usage(format!(
            "{} names one picture, and there are {} frames; for numbered pictures write `-o {}`, for one file that \
             holds them all `-o {}` (or .apng, .webp)",
            Quoted(&output),
            frames.count(),
            numbered(&output, "png").display(),
            output.with_extension("gif").display()
        ))),
    }
}

/// `scene.hry` to `scene-####.png`.
fn numbered(path: &Path, extension: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let given = path.extension().and_then(|extension| extension.to_str());
    let extension = given.filter(|_| PictureFormat::from_path(path).is_ok()).unwrap_or(extension);
    path.with_file_name(format!("{stem}-####.{extension}"))
}

struct Animation<'a> {
    arguments: &'a RenderArgs,
    frames: Frames,
    options: &'a Options,
    moments: Moments<'a>,
    /// The first frame, which is known already.
    first: Option<SceneFile>,
    /// How many of the diagnostics were shown.
    known: usize,
    control: Arc<Control>,
    console: &'a Console,
    total: Total,
}

impl Animation<'_> {
    /// The scene of a frame. What is new about it is said.
    fn scene(&mut self, frame: u32) -> Result<SceneFile, Failure> {
        if let Some(first) = self.first.take() {
            return Ok(first);
        }
        let time = moment(frame, self.arguments);
        let file = self.moments.at(time);
        if file.description().is_none() {
            self.console.say(job::report(&file, self.console));
            return Err(Failure::Wrong(format!("frame {frame}, at {time} seconds, has errors")));
        }
        if file.diagnostics().len() > self.known {
            self.known = file.diagnostics().len();
            self.console.say(job::report(&file, self.console));
        }
        Ok(file)
    }

    /// Runs `render`, with a progress bar over all frames of so many pixels.
    fn watched<T>(&mut self, pixels: u64, render: impl FnOnce(&mut Self) -> T) -> T {
        if self.arguments.quiet {
            return render(self);
        }
        let (console, control) = (self.console, self.control.clone());
        let pixels = pixels * u64::from(self.frames.count());
        progress::watching(console, &control, pixels, || render(self))
    }

    fn pixels(&self, description: &Description) -> Result<(u64, [u32; 2]), Failure> {
        let settings = self.options.settings(description).map_err(Error::from)?;
        Ok((settings.region.pixels(), [settings.region.width(), settings.region.height()]))
    }

    fn first_description(&self) -> Result<&Description, Failure> {
        self.first.as_ref().and_then(SceneFile::description).ok_or(Failure::Told)
    }

    fn numbered(mut self, pattern: &Pattern, format: PictureFormat) -> Result<(), Failure> {
        let (pixels, _) = self.pixels(self.first_description()?)?;
        hray::create_folder(pattern.folder()).map_err(Error::from)?;
        let start = Instant::now();
        self.watched(pixels, |animation| animation.numbered_frames(pattern, format))?;
        let names = [self.frames.first, self.frames.last].map(|number| pattern.name(number));
        self.say_summary(&summary::of_frames(&names, format, &self.total, start.elapsed()));
        Ok(())
    }

    fn numbered_frames(&mut self, pattern: &Pattern, format: PictureFormat) -> Result<(), Failure> {
        for frame in self.frames.first..=self.frames.last {
            let file = self.scene(frame)?;
            let name = pattern.name(frame);
            job::check_not_read(&name, &file)?;
            let destination = Destination::file(&name).map_err(Error::from)?;
            let description = job::description(&file)?;
            match hray::render_to(description, self.options, &destination, format, &self.control) {
                Ok(statistics) => self.count(description, &statistics),
                Err(Error::Cancelled) => return Err(self.interrupted(frame)),
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    /// What is there after Ctrl-C, and how to go on.
    fn interrupted(&self, frame: u32) -> Failure {
        let Frames { first, last } = self.frames;
        let done = match frame.checked_sub(1).filter(|done| *done >= first) {
            None => "no frame is complete".to_owned(),
            Some(done) if done == first => format!("frame {done} is complete"),
            Some(done) => format!("frames {first} to {done} are complete"),
        };
        Failure::Interrupted(format!("interrupted: {done}; go on with `--frames {frame}..{last}`"))
    }

    fn one_file(mut self, path: &Path, format: AnimationFormat) -> Result<(), Failure> {
        let (pixels, size) = self.pixels(self.first_description()?)?;
        let destination = Destination::file(path).map_err(Error::from)?;
        let fps = self.arguments.fps.unwrap_or(DEFAULT_FPS);
        let mut writer = AnimationWriter::create(&destination, format, size, self.frames.count(), fps)
            .map_err(Error::from)?;
        let start = Instant::now();
        self.watched(pixels, |animation| animation.frames_into(&mut writer, size, path))?;
        writer.finish().map_err(Error::from)?;
        self.say_summary(&summary::of_animation(
            path,
            format,
            self.frames.count(),
            &self.total,
            start.elapsed(),
        ));
        Ok(())
    }

    fn frames_into(
        &mut self,
        writer: &mut AnimationWriter,
        size: [u32; 2],
        path: &Path,
    ) -> Result<(), Failure> {
        for frame in self.frames.first..=self.frames.last {
            let file = self.scene(frame)?;
            job::check_not_read(path, &file)?;
            let description = job::description(&file)?;
            let (_, [width, height]) = self.pixels(description)?;
            if [width, height] != size {
                return Err(Failure::Wrong(format!(
                    "frame {frame} has {width} by {height} pixels, and those before have {} by {}; one file holds \
                     frames of one size, which --size can give them",
                    size[0], size[1]
                )));
            }
            match hray::render_frame(description, self.options, writer, &self.control) {
                Ok(statistics) => self.count(description, &statistics),
                Err(Error::Cancelled) => {
                    return Err(Failure::Interrupted(format!(
                        "interrupted: nothing was written to {}; numbered pictures (`-o {}`) can be gone on with",
                        Quoted(path),
                        numbered(&path.with_extension("png"), "png").display()
                    )));
                }
                Err(error) => return Err(error.into()),
            }
        }
        Ok(())
    }

    fn count(&mut self, description: &Description, statistics: &Statistics) {
        let size = self.pixels(description).map_or([0, 0], |(_, size)| size);
        self.total.add(size, statistics);
    }

    fn say_summary(&self, text: &str) {
        if !self.arguments.quiet {
            self.console.say(text);
        }
    }
}
