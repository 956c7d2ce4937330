//! hray as a library: load a scene, render it, save the picture.
//!
//! ```
//! use hray::{Control, Options};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let directory = tempfile::tempdir()?;
//! # std::env::set_current_dir(&directory)?;
//! # std::fs::write("ball.hry", "renderDescr ( resolution (40,30) ) 3 [
//! #   scene { camera (0.0,0.0,150.0) (100,75) } { background (0.0,0.0,0.0) }
//! #   { objects (object ( sphere 25.0 (0.0,0.0,-50.0) ) ( texture ( diff solid (0.9,0.5,0.1) ) 0.3 20 0.0 0.0 )) }
//! #   { lights (pointLight (80.0,80.0,100.0) (0.9,0.9,0.9)) } ]")?;
//! let scene = hray::load("ball.hry")?;
//! let statistics = hray::render_to_file(&scene, &Options::default(), "ball.png", &Control::new())?;
//! println!("{} rays", statistics.rays.total());
//! # assert!(std::fs::read("ball.png")?.starts_with(b"\x89PNG"));
//! # Ok(())
//! # }
//! ```
//!
//! The steps are there one by one, too. [`SceneFile`] is a scene, in either language, with its source text and everything
//! there is to say about it, as text and as [`Findings`] for programs; [`LoadOptions`] say what it may read, which of its
//! definitions are replaced, and which moment is shown, and [`SceneFile::moments`] gives one after another, for
//! animations. [`explain`] says of a pixel which object it shows, which line of the text made that, and which rays and
//! lights its colour is the sum of. [`Options`] change what the scene file asks for; [`render_to_memory`] gives the colours as
//! they were computed, in double precision, as a [`Picture`] that can be looked at and saved. A [`Control`],
//! shared with another thread, tells how far a render is and stops it:
//!
//! ```
//! use hray::{Control, LintLevels, Options, PictureFormat, SceneFile};
//!
//! let text = "renderDescr ( resolution (40,30) ) 3 [
//!     scene { camera (0.0,0.0,150.0) (100,75) } { background (0.2,0.3,0.5) } { objects } { lights } ]";
//! let file = SceneFile::parse("a.hry", text.into(), &LintLevels::default());
//! assert_eq!(file.report(false), "");
//! let Some(scene) = file.description() else { panic!("there are no errors") };
//!
//! let options = Options { size: Some(hray::Resolution::new(80, 60)?), ..Options::default() };
//! let (picture, _) = hray::render_to_memory(scene, &options, &Control::new())?;
//! assert_eq!(picture.pixel(79, 59), Some(hray::Rgb::new(0.2, 0.3, 0.5)));
//! assert!(picture.encode(PictureFormat::Ppm)?.starts_with(b"P6\n80 60\n255\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A picture depends on the scene, the options and the noise tables alone: not on the machine, the number of
//! threads or what else is going on.

mod assets;
mod error;
mod explain;
mod findings;
mod format;
mod model_scene;
mod options;
mod picture;
mod render;
mod scene_file;
mod summary;
mod work_folder;

pub use error::{Error, LoadError};
pub use explain::{
    Explanation, Hit, LightShare, Object, Ray, SeenObject, SourcePlace, Surface, display_color, explain,
    explain_pixel,
};
pub use findings::{Finding, FindingLabel, FindingPlace, FindingSuggestion, Findings};
pub use format::{FormatErrors, Formatted, format_scene};
pub use model_scene::scene_of_model;
pub use options::{Options, OptionsError};
pub use picture::Picture;
pub use render::{render_frame, render_to, render_to_bytes, render_to_file, render_to_memory};
pub use scene_file::{LoadOptions, Moments, SceneFile, load, model_scene};
pub use summary::{Bounds, CameraSummary, Materials, Meshes, Objects, Summary, WorstCase};
pub use work_folder::{OpenTexts, WorkAssets, WorkFolder};

pub use hray_core::{
    Background, Camera, Clip, Csg, CsgOperation, Cuboid, DAffine3, DMat3, DVec2, DVec3, Description,
    DescriptionError, Encoding, Field, Function, Image, Integrator, Light, MAX_DEPTH, MAX_PIXELS, MIN_DEPTH,
    Material, Mesh, Model, ModelFormat, ModelMaterial, ModelPart, NoiseTables, NoiseTexture,
    OrthographicCamera, PerspectiveCamera, Plane, Primitive, Resolution, Rgb, Scene, Shape, Sphere, Texture,
    WindowCamera,
};
pub use hray_io::{
    AnimationFormat, AnimationWriter, Destination, FileStamp, Folder, FolderError, Input, InputError,
    MAX_FPS, MAX_MODEL_BYTES, MAX_SOURCE_BYTES, MIN_FPS, OutputError, PictureFormat, Quoted, TablesError,
    UnknownFormat, create_folder, decode_image, decode_model, model_format, parse_noise_tables, read_model,
    read_noise_tables, read_source, same_file, write_text,
};
pub use hray_lang::Language;
pub use hray_lang::classic::write as write_classic;
pub use hray_lang::diagnostic::{Diagnostic, Severity, Span};
pub use hray_lang::hry::assets::{AssetError, Assets, resolve as resolve_path};
pub use hray_lang::hry::eval::{Limits, Origin, Origins};
pub use hray_lang::hry::ide;
pub use hray_lang::hry::{Sources, convert};
pub use hray_lang::lint::{ALL_LINTS, CLASSIC_LINTS, LINTS, Level, Lint, LintLevels, UnknownLint, hry_lints};
pub use hray_render::{
    Control, ExplainError, ExplainedHit, ExplainedRay, Followed, LightPart, MAX_EXPLAINED_RAYS, MAX_SAMPLES,
    MAX_SOLID_PARTS, MeshTrees, ObjectId, PixelExplanation, Prepared, RayCounts, RayKind, Reach, Region,
    RegionError, RenderError, Seen, Settings, Statistics, Tracer,
};
