//! The command line, as clap reads it.

use crate::lint_args::LintArgs;
use crate::scene_args::SceneArgs;
use crate::values::{self, Depth, Frames};
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use hray::{PictureFormat, Resolution};
use std::ffi::OsString;
use std::num::{NonZeroU32, NonZeroUsize};
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  hray render scene.hry                    writes scene.png
  hray render scene.hry -o big.exr --size 3840x2160 --samples 16
  hray render bunny.ply                    shows a mesh on a floor
  hray render orbit.hry --frames 0..47 -o orbit.gif
  hray check scene.hry                     says what is wrong with it
  hray explain scene.hry 400 300           says where a pixel's colour comes from
  hray scene.hry scene.ppm                 the classic form

Exit codes: 0 all went well, 1 something is wrong with the input or could not be
read or written, 2 the command line is wrong, 130 interrupted.";

/// A ray tracer that continues HRay (2005): from a scene file to its exact picture.
#[derive(Debug, Parser)]
#[command(name = "hray", version, after_help = AFTER_HELP, max_term_width = 100)]
#[command(
    args_conflicts_with_subcommands = true,
    override_usage = "hray <COMMAND>\n       hray [OPTIONS] INPUT.hry OUTPUT.ppm"
)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The form of 2005.
    #[command(flatten)]
    pub classic: ClassicArgs,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene to a picture
    Render(Box<RenderArgs>),
    /// Say what is wrong with scenes, without rendering them
    Check(CheckArgs),
    /// Show what is in a scene
    Info(InfoArgs),
    /// Explain a pixel: which object it shows, which line made that, which rays and lights its colour comes from
    Explain(Box<ExplainArgs>),
    /// Lay out scenes in hry in the one common style
    Fmt(FmtArgs),
    /// Turn a classic scene into one in hry that gives the same picture, or a file of meshes into one that shows it
    Convert(ConvertArgs),
    /// Answer an editor: a language server on the standard input and output
    #[command(
        after_help = "Editors start it; see editors/vscode/README.md for how to tell them.\nThe protocol is the Language Server Protocol 3.17."
    )]
    Lsp {
        /// Ignored: there is no other way to talk
        #[arg(long, hide = true)]
        stdio: bool,
    },
    /// Write scenes in the browser and watch them appear
    #[command(
        after_help = "The page is served to this machine alone, and can be reached only by the address that is printed.\nIt reads files in the folder of the scene, and writes nothing but scenes that are saved."
    )]
    Studio(StudioArgs),
    /// Print a script that lets a shell complete the commands and options
    #[command(
        after_help = "For example, for bash:\n  hray completions bash > ~/.local/share/bash-completion/completions/hray"
    )]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the man page
    #[command(after_help = "For example:\n  hray man > ~/.local/share/man/man1/hray.1")]
    Man {
        /// The command it is about [default: all of hray]
        command: Option<String>,
    },
}

/// `hray studio`.
#[derive(Args, Debug)]
pub(crate) struct StudioArgs {
    /// A scene, or a folder of scenes [default: the current folder]
    #[arg(value_name = "FILE or FOLDER")]
    pub target: Option<PathBuf>,
    /// Only print the address
    #[arg(long)]
    pub no_open: bool,
    /// The port, which must be free [default: the first free one from 4005 on]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub port: Option<u16>,
}

/// `hray INPUT.hry OUTPUT.ppm`.
#[derive(Args, Debug)]
pub(crate) struct ClassicArgs {
    /// Classic form: the scene file
    #[arg(value_name = "INPUT.hry")]
    pub input: Option<PathBuf>,
    /// Classic form: the picture, written as PPM text (P3) exactly as in 2005
    #[arg(value_name = "OUTPUT.ppm")]
    pub output: Option<PathBuf>,
    /// What the form has no place for; taken in to be answered better than clap would.
    #[arg(hide = true)]
    pub more: Vec<OsString>,
    #[command(flatten)]
    pub common: CommonArgs,
    #[command(flatten)]
    pub lints: LintArgs,
}

/// What every render takes.
#[derive(Args, Debug)]
pub(crate) struct CommonArgs {
    /// Use other noise tables than hray's own (JSON)
    #[arg(long, value_name = "FILE")]
    pub noise_tables: Option<PathBuf>,
    /// How many threads to use; changes no pixel [default: as many as the machine has]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::threads)]
    pub threads: Option<NonZeroUsize>,
}

/// `hray render`.
#[derive(Args, Debug)]
pub(crate) struct RenderArgs {
    /// The scene file, or - for the standard input; or a file of meshes (ply, stl, obj, gltf, glb), which is shown
    /// on a floor
    pub input: PathBuf,
    /// The picture, or - for the standard output [default: the input's name with .png, beside it]
    ///
    /// The extension tells the format, see --format. The file appears when it is complete; an older one of that
    /// name is untouched until then. With --frames, `####` in the name stands for the number of the frame (and its
    /// folder is made where it is missing); a .gif, .apng or .webp without it holds the whole animation.
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// The size of the picture, instead of the scene's; a camera that is a window (every classic one) keeps its shape, others see
    /// more or less
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = values::size)]
    pub size: Option<Resolution>,
    /// How many times a ray may be reflected or refracted, -1 to 10000, instead of the scene's number
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::depth)]
    pub depth: Option<Depth>,
    /// Samples a pixel, 1 to 65536: more give smoother edges [default: the scene's; 16 in hry where it says
    /// nothing, 1 in classic scenes]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::samples)]
    pub samples: Option<NonZeroU32>,
    /// Render only a part: X,Y is its upper left pixel, counted from the upper left
    #[arg(long, value_name = "X,Y,W,H", allow_hyphen_values = true, value_parser = values::region)]
    pub region: Option<[u32; 4]>,
    #[command(flatten)]
    pub common: CommonArgs,
    /// Write PPM as text (P3), exactly as in 2005
    #[arg(long)]
    pub ascii: bool,
    /// The format of the picture [default: by the extension, png on the standard output]
    #[arg(long, value_name = "FORMAT", value_parser = values::FormatParser)]
    pub format: Option<PictureFormat>,
    /// No progress bar and no summary; warnings and errors are still shown
    #[arg(short, long)]
    pub quiet: bool,
    /// The moment to show of a scene that is a function of the time [default: 0]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = values::seconds,
        conflicts_with_all = ["frame", "frames"], help_heading = "Animations")]
    pub time: Option<f64>,
    /// Render frames A to B, both included: frame 0 shows the moment 0
    #[arg(long, value_name = "A..B", allow_hyphen_values = true, value_parser = values::frames,
        help_heading = "Animations")]
    pub frames: Option<Frames>,
    /// Render one frame, as --frames would
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::frame,
        conflicts_with = "frames", help_heading = "Animations")]
    pub frame: Option<u32>,
    /// Frames a second [default: 24]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::fps,
        help_heading = "Animations")]
    pub fps: Option<f64>,
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub lints: LintArgs,
}

/// `hray check`.
#[derive(Args, Debug)]
#[command(after_long_help = crate::check::after_help())]
pub(crate) struct CheckArgs {
    /// The scene files, or - for the standard input
    #[arg(required = true, value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,
    /// Write JSON, for programs
    #[arg(long)]
    pub json: bool,
    /// The moment to check of a scene that is a function of the time [default: 0]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = values::seconds)]
    pub time: Option<f64>,
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub lints: LintArgs,
}

/// `hray info`.
#[derive(Args, Debug)]
pub(crate) struct InfoArgs {
    /// The scene file, or - for the standard input; or a file of meshes (ply, stl, obj, gltf, glb)
    pub input: PathBuf,
    /// Write JSON, for programs
    #[arg(long)]
    pub json: bool,
    /// The moment to look at of a scene that is a function of the time [default: 0]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = values::seconds)]
    pub time: Option<f64>,
    #[command(flatten)]
    pub scene: SceneArgs,
}

/// `hray explain`.
#[derive(Args, Debug)]
#[command(after_help = EXPLAIN_HELP)]
pub(crate) struct ExplainArgs {
    /// The scene file, or - for the standard input; or a file of meshes (ply, stl, obj, gltf, glb)
    pub input: PathBuf,
    /// The pixel's column, counted from 0 at the left
    #[arg(value_name = "X", allow_negative_numbers = true, value_parser = values::coordinate)]
    pub x: u32,
    /// The pixel's row, counted from 0 at the top, as image viewers count
    #[arg(value_name = "Y", allow_negative_numbers = true, value_parser = values::coordinate)]
    pub y: u32,
    /// Write JSON, for programs: everything, with all digits
    #[arg(long)]
    pub json: bool,
    /// Show all rays, the faint ones too
    #[arg(long)]
    pub all: bool,
    /// The size of the picture, instead of the scene's
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, value_parser = values::size)]
    pub size: Option<Resolution>,
    /// How many times a ray may be reflected or refracted, -1 to 10000, instead of the scene's number
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::depth)]
    pub depth: Option<Depth>,
    /// Samples a pixel, 1 to 65536, instead of the scene's number
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::samples)]
    pub samples: Option<NonZeroU32>,
    #[command(flatten)]
    pub common: CommonArgs,
    /// The moment to look at of a scene that is a function of the time [default: 0]
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = values::seconds)]
    pub time: Option<f64>,
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub lints: LintArgs,
}

const EXPLAIN_HELP: &str = "\
The colour is exactly the one that `hray render` with the same options gives the
pixel. Where a pixel has several samples, its colour is their mean, and the rays
that are shown are those through its centre.

For example:
  hray explain scene.hry 400 300
  hray explain scene.hry 400 300 --json";

/// `hray fmt`.
#[derive(Args, Debug)]
#[command(
    after_help = "A file is written only where that changes it, and then whole or not at all. Exit code 1: with \
                        --check, files that are laid out differently; a file that cannot be read, or has errors that \
                        leave its layout unclear."
)]
pub(crate) struct FmtArgs {
    /// The scene files, or - for the standard input, which goes to the standard output
    #[arg(required = true, value_name = "FILE")]
    pub inputs: Vec<PathBuf>,
    /// Write nothing, and list the files that would change
    #[arg(long)]
    pub check: bool,
}

/// `hray convert`.
#[derive(Args, Debug)]
pub(crate) struct ConvertArgs {
    /// The classic scene, or - for the standard input; or a file of meshes (ply, stl, obj, gltf, glb)
    #[arg(value_name = "OLD.hry")]
    pub input: PathBuf,
    /// The new scene, or - for the standard output, which is the default
    #[arg(short, long, value_name = "NEW.hry")]
    pub output: Option<PathBuf>,
}
