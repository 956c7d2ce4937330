//! A scene file: its text, what it describes, and what there is to say about it.

use crate::assets::{FolderAssets, Given, SceneAssets};
use crate::scene_of_model;
use crate::{Description, Diagnostic, Error, Findings, Input, InputError, Limits, LintLevels, LoadError};
use hray_lang::hry::assets::{AssetError, Assets};
use hray_lang::hry::eval::{Evaluator, Origins};
use hray_lang::hry::{Program, Sources, types};
use hray_lang::{Language, classic, decode, diagnostic, lint};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// How to load a scene.
#[derive(Clone, Debug, Default)]
pub struct LoadOptions {
    /// The level of every warning.
    pub levels: LintLevels,
    /// The folder whose files an hry scene may read, and no others; the scene lies in it. The scene's own folder where
    /// not given; a scene that is in no file can then read nothing.
    pub root: Option<PathBuf>,
    /// Definitions of an hry scene to replace: names, and expressions as they would be written in the scene.
    pub set: Vec<(String, String)>,
    /// The moment to show, in seconds, of a scene that is a function of the time.
    pub time: f64,
    /// How much the evaluation of an hry scene may take.
    pub limits: Limits,
    /// Ends the evaluation of an hry scene, with an error, soon after it is set.
    pub stop: Option<Arc<AtomicBool>>,
    /// Whether a file in hry may do without a scene, as one does that is there to be imported. Otherwise that is an error.
    pub modules: bool,
}

/// A scene as it was read, with its diagnostics.
#[derive(Clone, Debug)]
pub struct SceneFile {
    language: Language,
    sources: Sources,
    description: Option<Description>,
    /// Where its objects and lights were made.
    origins: Origins,
    diagnostics: Vec<Diagnostic>,
    animated: bool,
    /// How many definitions there are in a file without a scene.
    module: Option<usize>,
    /// What an hry scene without errors is evaluated from.
    checked: Option<Arc<CheckedScene>>,
}

/// An hry scene that can be evaluated.
#[derive(Debug)]
struct CheckedScene {
    program: Program,
    assets: SceneAssets,
    options: LoadOptions,
    /// What the checker warned of.
    warnings: Vec<Diagnostic>,
}

impl SceneFile {
    /// Reads a scene, and what it imports.
    ///
    /// # Errors
    /// [`InputError`] where it cannot be read, or does not lie in the root folder that was asked for. What is wrong with
    /// its text is in the diagnostics.
    ///
    /// A file of meshes, by its extension, is a scene that shows it: see [`crate::scene_of_model`].
    pub fn read(input: &Input, options: &LoadOptions) -> Result<Self, InputError> {
        if let Some(scene) = ModelScene::read(input, options)? {
            let ModelScene { assets, path, text } = scene;
            let assets = SceneAssets::Folder(assets);
            return Ok(Self::hry(&input.name(), &path, text.into(), assets, options));
        }
        let bytes = hray_io::read_source(input)?;
        let (assets, path) = FolderAssets::of(input, options.root.as_deref())?;
        Ok(Self::understand(&input.name(), &path, bytes, SceneAssets::Folder(assets), options))
    }

    /// Makes a scene of bytes, which are called `name` in diagnostics.
    #[must_use]
    pub fn parse(name: &str, bytes: Vec<u8>, levels: &LintLevels) -> Self {
        let options = LoadOptions { levels: levels.clone(), ..LoadOptions::default() };
        Self::understand(name, name, bytes, SceneAssets::Folder(FolderAssets::nothing()), &options)
    }

    /// Makes a scene of bytes, which are called `name` in diagnostics, lie at `path` in the root folder, and take what they
    /// import from `assets`. The root folder of the options means nothing here.
    #[must_use]
    pub fn parse_among(
        name: &str,
        path: &str,
        bytes: Vec<u8>,
        assets: Arc<dyn Assets + Send + Sync>,
        options: &LoadOptions,
    ) -> Self {
        Self::understand(name, path, bytes, SceneAssets::Given(Given(assets)), options)
    }

    /// Makes a scene of bytes, which are called `name` in diagnostics, and reads what they import from the root folder
    /// of the options, as if the scene lay in that.
    ///
    /// # Errors
    /// [`InputError`] where there is no such folder.
    pub fn parse_with(name: &str, bytes: Vec<u8>, options: &LoadOptions) -> Result<Self, InputError> {
        let (assets, path) = FolderAssets::without_file(options.root.as_deref())?;
        Ok(Self::understand(name, &path, bytes, SceneAssets::Folder(assets), options))
    }

    fn understand(
        name: &str,
        path: &str,
        bytes: Vec<u8>,
        assets: SceneAssets,
        options: &LoadOptions,
    ) -> Self {
        let (text, unreadable) = match decode::decode(&bytes) {
            decode::Decoded { text: Cow::Owned(text), error } => (text, error),
            decode::Decoded { text: Cow::Borrowed(_), error } => {
                (String::from_utf8(bytes).unwrap_or_default(), error)
            }
        };
        let language = Language::of(&text);
        match (unreadable, language) {
            (Some(error), _) => Self::of_one_text(language, name, text, None, vec![error]),
            (None, Language::Classic) => Self::classic(name, text, options),
            (None, Language::Hry) => Self::hry(name, path, text.into(), assets, options),
        }
    }

    fn of_one_text(
        language: Language,
        name: &str,
        text: String,
        description: Option<Description>,
        diagnostics: Vec<Diagnostic>,
    ) -> Self {
        let mut sources = Sources::default();
        sources.add(name.to_owned(), text.into());
        Self {
            language,
            sources,
            description,
            origins: Origins::default(),
            diagnostics,
            animated: false,
            module: None,
            checked: None,
        }
    }

    fn classic(name: &str, text: String, options: &LoadOptions) -> Self {
        let parsed = classic::parse(&text);
        let mut diagnostics = parsed.diagnostics;
        if let Some(description) = &parsed.description {
            diagnostics.extend(lint::check(&text, description, &parsed.spans, &options.levels));
        }
        diagnostics.extend(options.set.first().map(|(name, _)| nothing_to_set(name)));
        let denied = diagnostics.iter().any(Diagnostic::is_error);
        let description = parsed.description.filter(|_| !denied);
        let classic::Spans { primitives, light_list, .. } = parsed.spans;
        Self {
            origins: Origins::single(primitives, light_list),
            ..Self::of_one_text(Language::Classic, name, text, description, diagnostics)
        }
    }

    fn hry(name: &str, path: &str, text: Arc<str>, assets: SceneAssets, options: &LoadOptions) -> Self {
        let mut diagnostics = Vec::new();
        let mut program = Program::load(name, path, text, &options.set, assets.get(), &mut diagnostics);
        let read = diagnostics.clone();
        types::check(&program, &mut diagnostics);
        // A value that is set may be of another type than the one it replaces, as long as that fits everywhere.
        if diagnostics.iter().any(Diagnostic::is_error)
            && let Some(free) = program.without_annotations()
        {
            let mut found = read;
            types::check(&free, &mut found);
            if !found.iter().any(Diagnostic::is_error) {
                (program, diagnostics) = (free, found);
            }
        }
        let module = if options.modules { definitions_of_module(&program, &diagnostics) } else { None };
        if module.is_some() {
            diagnostics.retain(|diagnostic| diagnostic.code != NO_SCENE);
        }
        lint::apply(&options.levels, &mut diagnostics);
        let mut file = Self {
            language: Language::Hry,
            sources: program.sources.clone(),
            description: None,
            origins: Origins::default(),
            diagnostics: diagnostics.clone(),
            animated: false,
            module,
            checked: None,
        };
        if file.errors() > 0 || module.is_some() {
            return file;
        }
        let checked =
            Arc::new(CheckedScene { program, assets, options: options.clone(), warnings: diagnostics });
        file.checked = Some(checked);
        file.at(options.time)
    }

    /// The scene at another moment, in seconds, without reading it again. For many moments use [`SceneFile::moments`].
    #[must_use]
    pub fn at(&self, time: f64) -> Self {
        self.moments().at(time)
    }

    /// The scene at one moment after another. What does not depend on the time is worked out once.
    #[must_use]
    pub fn moments(&self) -> Moments<'_> {
        let evaluator = self
            .checked
            .as_deref()
            .map(|checked| {
                let CheckedScene { program, assets, options, .. } = checked;
                let evaluator = Evaluator::new(program, assets.get(), &options.limits);
                options.stop.iter().fold(evaluator, |evaluator, stop| evaluator.stopped_by(stop))
            });
        Moments { file: self, evaluator }
    }

    /// The language it is written in.
    #[must_use]
    pub const fn language(&self) -> Language {
        self.language
    }

    /// Whether the scene is a function of the time, so that its moments can differ.
    #[must_use]
    pub const fn is_animated(&self) -> bool {
        self.animated
    }

    /// How many definitions there are in a file that has no scene, and need not have one: see [`LoadOptions::modules`].
    #[must_use]
    pub const fn module(&self) -> Option<usize> {
        self.module
    }

    /// The images that it was made from, where it is a scene in hry: the paths that lead to them. Those that only a later
    /// moment needs are there once that was asked for.
    #[must_use]
    pub fn images(&self) -> Vec<PathBuf> {
        self.checked.as_ref().map_or_else(Vec::new, |checked| checked.assets.assets_read())
    }

    /// What the scene file describes; none where it has errors.
    #[must_use]
    pub const fn description(&self) -> Option<&Description> {
        self.description.as_ref()
    }

    /// Its errors and warnings. Their spans are offsets into [`SceneFile::sources`].
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// The texts that it consists of: the scene itself first, then what it imports and what was set.
    #[must_use]
    pub const fn sources(&self) -> &Sources {
        &self.sources
    }

    /// Where the objects and lights of the description were made: spans in [`SceneFile::sources`].
    #[must_use]
    pub const fn origins(&self) -> &Origins {
        &self.origins
    }

    /// The name of the definition that an offset in the sources lies in, where it has one and is not the scene itself.
    pub(crate) fn definition_at(&self, offset: usize) -> Option<String> {
        let program = &self.checked.as_ref()?.program;
        let definitions = program.modules.iter().filter(|module| !module.is_standard);
        let mut definitions = definitions.flat_map(|module| &module.syntax.definitions);
        let found =
            definitions.find(|definition| (definition.span.start..definition.span.end).contains(&offset));
        found?.name().map(|name| name.text.to_string()).filter(|name| name != "scene")
    }

    /// How many of the diagnostics are errors.
    #[must_use]
    pub fn errors(&self) -> usize {
        self.diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()
    }

    /// How many of the diagnostics are warnings.
    #[must_use]
    pub fn warnings(&self) -> usize {
        self.diagnostics.len() - self.errors()
    }

    /// The diagnostics as text, each with its place, the source line and what to do; empty where there are
    /// none. `color` adds the colours of a terminal.
    #[must_use]
    pub fn report(&self, color: bool) -> String {
        diagnostic::render_sources(&self.diagnostics, &self.sources, color)
    }

    /// One of the diagnostics as text, without colours.
    #[must_use]
    pub fn rendered(&self, diagnostic: &Diagnostic) -> String {
        diagnostic::render_sources(std::slice::from_ref(diagnostic), &self.sources, false)
    }

    /// The diagnostics for programs, with lines and columns.
    #[must_use]
    pub fn findings(&self) -> Findings {
        Findings::of(&self.diagnostics, &self.sources)
    }

    /// What the scene file describes, or itself as an error.
    ///
    /// # Errors
    /// [`LoadError::Scene`] where it has errors.
    pub fn into_description(mut self) -> Result<Description, LoadError> {
        self.description.take().ok_or_else(|| LoadError::Scene(Box::new(self)))
    }
}

/// A scene at one moment after another.
#[derive(Debug)]
pub struct Moments<'a> {
    file: &'a SceneFile,
    evaluator: Option<Evaluator<'a>>,
}

impl Moments<'_> {
    /// The scene at a moment, in seconds. A scene that is no function of the time is always the same, and so is one with
    /// errors that come before evaluation.
    #[must_use]
    pub fn at(&mut self, time: f64) -> SceneFile {
        let (Some(evaluator), Some(checked)) = (&mut self.evaluator, &self.file.checked) else {
            return self.file.clone();
        };
        let mut evaluated = evaluator.at(time);
        lint::apply(&checked.options.levels, &mut evaluated.diagnostics);
        // What the checker saw in the text, the evaluator may find in the value.
        let told = |span| checked.warnings.iter().any(|warning| warning.primary.span == span);
        evaluated.diagnostics.retain(|found| found.is_error() || !told(found.primary.span));
        let mut file = SceneFile {
            language: Language::Hry,
            sources: self.file.sources.clone(),
            description: None,
            origins: evaluated.origins,
            diagnostics: checked.warnings.clone(),
            animated: evaluated.animated,
            module: None,
            checked: Some(checked.clone()),
        };
        file.diagnostics.append(&mut evaluated.diagnostics);
        file.description = evaluated.description.filter(|_| file.errors() == 0);
        file
    }
}

/// The code of the complaint about a file without a scene.
const NO_SCENE: &str = "no-scene";

/// How many definitions there are in a file that is there to be imported: it defines something, and nothing that was
/// probably meant to be the scene.
fn definitions_of_module(program: &Program, diagnostics: &[Diagnostic]) -> Option<usize> {
    let is_module = |found: &Diagnostic| found.code == NO_SCENE && found.suggestion.is_none();
    let count = program.root()?.syntax.definitions.len();
    (count > 0 && diagnostics.iter().any(is_module)).then_some(count)
}

fn nothing_to_set(name: &str) -> Diagnostic {
    let message = format!("a classic scene has no definitions, so `{name}` cannot be set");
    Diagnostic::error("unknown-override", message, diagnostic::Span::at(0), "")
        .with_help("`hray convert` makes an hry scene of a classic one")
}

/// The text of the scene that a file of meshes is read as, by its extension; none where it is no such file.
///
/// # Errors
/// [`InputError`] where it cannot be read, or is damaged.
pub fn model_scene(input: &Input) -> Result<Option<String>, InputError> {
    Ok(ModelScene::read(input, &LoadOptions::default())?.map(|scene| scene.text))
}

/// What a file of meshes is read as.
struct ModelScene {
    assets: FolderAssets,
    path: String,
    text: String,
}

impl ModelScene {
    fn read(input: &Input, options: &LoadOptions) -> Result<Option<Self>, InputError> {
        let Input::File(file) = input else { return Ok(None) };
        if hray_io::model_format(file).is_none() {
            return Ok(None);
        }
        let (assets, path) = FolderAssets::of(input, options.root.as_deref())?;
        let name = path.rsplit('/').next().unwrap_or(&path);
        let model = assets.model(&path).map_err(|error| match error {
            AssetError::NotFound => InputError::Missing { path: file.clone() },
            error => InputError::Model { path: file.clone(), reason: error.to_string() },
        })?;
        let text = scene_of_model(name, &model);
        Ok(Some(Self { assets, path, text }))
    }
}

/// Reads the scene in a file. Warnings are passed over in silence; [`SceneFile::read`] has them.
///
/// # Errors
/// [`Error::Load`] where the file cannot be read, or has errors.
pub fn load(path: impl AsRef<Path>) -> Result<Description, Error> {
    let input = Input::File(path.as_ref().to_owned());
    Ok(SceneFile::read(&input, &LoadOptions::default())?.into_description()?)
}
