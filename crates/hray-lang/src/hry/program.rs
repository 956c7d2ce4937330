//! The files of a scene, read and put together: modules, imports, and what each name means at the top of each file.

use super::assets::{AssetError, Assets, resolve};
use super::ast::{Definition, Expr, ImportNames, Module, Name, PatternKind};
use super::library::{CONSTRUCTORS, Constructor, Makes, NATIVES, NativeSpec, STANDARD};
use super::sources::{STANDARD_BASE, SourceFile, Sources};
use super::syntax;
use crate::diagnostic::{Diagnostic, Span};
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// The most files that a scene may consist of.
const MOST_MODULES: usize = 1000;

/// A scene's files, parsed, with the meaning of their top-level names.
#[derive(Clone, Debug)]
pub struct Program {
    /// The texts.
    pub sources: Sources,
    /// The modules: those of the standard library first, then the scene's own; an imported module comes before those that
    /// import it.
    pub modules: Vec<Arc<LoadedModule>>,
    /// The scene itself, in `modules`.
    pub root: usize,
    /// Definitions of the root that were replaced from outside (`--set`), by name.
    pub overrides: Vec<(Arc<str>, Span)>,
}

/// One file.
#[derive(Clone, Debug)]
pub struct LoadedModule {
    /// Its path, relative to the root folder; of a module of the standard library its name.
    pub path: String,
    /// Its syntax.
    pub syntax: Module,
    /// What names mean in it, its own definitions and imports before the library's.
    pub scope: Scope,
    /// Whether it belongs to the standard library.
    pub is_standard: bool,
}

/// What top-level names mean in a file.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    /// Names as they are. Only looked up, never iterated in an order that matters.
    pub names: HashMap<Arc<str>, Global>,
    /// Names of imports `as` something, by that.
    pub qualified: HashMap<Arc<str>, HashMap<Arc<str>, Global>>,
}

/// What a top-level name means.
#[derive(Clone, Copy, Debug)]
pub enum Global {
    /// A definition, by its module's place in [`Program::modules`] and its own in [`Module::definitions`].
    Definition {
        /// The module.
        module: usize,
        /// The definition.
        index: usize,
    },
    /// A native function or value.
    Native(&'static NativeSpec),
    /// A constructor.
    Constructor(&'static Constructor),
}

impl Scope {
    /// What a name means: in the file, else in the library.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Global> {
        self.names.get(name).or_else(|| standard().names.get(name)).copied()
    }

    /// Every name that means something here, in alphabetical order.
    #[must_use]
    pub fn all(&self) -> Vec<(Arc<str>, Global)> {
        let mut all: Vec<_> = standard().names.iter().map(|(name, global)| (name.clone(), *global)).collect();
        all.retain(|(name, _)| !self.names.contains_key(name));
        all.extend(self.names.iter().map(|(name, global)| (name.clone(), *global)));
        all.sort_by(|a, b| a.0.cmp(&b.0));
        all
    }
}

impl Definition {
    /// The name that is bound, where it is a name.
    #[must_use]
    pub fn name(&self) -> Option<Name> {
        match &self.target.kind {
            PatternKind::Name(text) => Some(Name { text: text.clone(), span: self.target.span }),
            _ => None,
        }
    }
}

/// The standard library, parsed once.
#[derive(Debug)]
pub struct Standard {
    /// Its files.
    pub files: Vec<SourceFile>,
    /// Its modules, with the places that they have in every program.
    pub modules: Vec<Arc<LoadedModule>>,
    /// Every name of the library.
    pub names: HashMap<Arc<str>, Global>,
}

/// The standard library.
#[must_use]
pub fn standard() -> &'static Standard {
    static STANDARD_LIBRARY: OnceLock<Standard> = OnceLock::new();
    STANDARD_LIBRARY.get_or_init(|| {
        let mut names: HashMap<Arc<str>, Global> = HashMap::new();
        names.extend(NATIVES.iter().map(|native| (Arc::from(native.name), Global::Native(native))));
        let constructors = CONSTRUCTORS.iter().filter(|constructor| constructor.makes != Makes::Scene);
        names.extend(constructors.map(|c| (Arc::from(c.name), Global::Constructor(c))));
        let (mut files, mut modules, mut base) = (Vec::new(), Vec::new(), STANDARD_BASE);
        for (module, standard) in STANDARD.iter().enumerate() {
            let syntax = syntax::parse(standard.text, base).module();
            for (index, definition) in syntax.definitions.iter().enumerate() {
                if let Some(name) = definition.name() {
                    names.insert(name.text, Global::Definition { module, index });
                }
            }
            let name = format!("{}.hry of the library", standard.name);
            files.push(SourceFile { path: name.clone(), name, text: standard.text.into(), base });
            base += standard.text.len() + 1;
            let (path, scope) = (standard.name.to_owned(), Scope::default());
            modules.push(Arc::new(LoadedModule { path, syntax, scope, is_standard: true }));
        }
        Standard { files, modules, names }
    })
}

impl Program {
    /// Reads a scene and everything that it imports.
    ///
    /// `path` is where the scene lies in its root folder (`scene.hry`), `name` what it is called in messages. `overrides`
    /// are pairs of a definition's name and the text of an expression. What is wrong goes to `diagnostics`; the program is
    /// as complete as it could be made.
    #[must_use]
    pub fn load(
        name: &str,
        path: &str,
        text: Arc<str>,
        overrides: &[(String, String)],
        assets: &dyn Assets,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut loader = Loader {
            sources: Sources::default(),
            modules: standard().modules.clone(),
            loaded: HashMap::new(),
            open: Vec::new(),
            assets,
            diagnostics,
        };
        let base = loader.sources.add_at(name.to_owned(), path.to_owned(), text.clone());
        let mut syntax = loader.parse(&text, base);
        let replaced = loader.replace(&mut syntax, path, overrides);
        let root = loader.finish(path.to_owned(), syntax);
        Self { sources: loader.sources, modules: loader.modules, root, overrides: replaced }
    }

    /// The same program without the type annotations of what was replaced from outside: a value that is set may be of
    /// another type. None where there are no such annotations.
    #[must_use]
    pub fn without_annotations(&self) -> Option<Self> {
        let mut program = self.clone();
        let root = Arc::make_mut(program.modules.get_mut(self.root)?);
        let is_set = |d: &Definition| {
            d.name().is_some_and(|name| self.overrides.iter().any(|(set, _)| *set == name.text))
        };
        let set = root.syntax.definitions.iter_mut().filter(|definition| is_set(definition));
        let dropped = set.filter_map(|definition| definition.annotation.take()).count();
        (dropped > 0).then_some(program)
    }

    /// The definition of a global, where it is one.
    #[must_use]
    pub fn definition(&self, module: usize, index: usize) -> Option<&Definition> {
        self.modules.get(module)?.syntax.definitions.get(index)
    }

    /// The scene itself.
    #[must_use]
    pub fn root(&self) -> Option<&LoadedModule> {
        self.modules.get(self.root).map(Arc::as_ref)
    }
}

struct Loader<'a> {
    sources: Sources,
    modules: Vec<Arc<LoadedModule>>,
    /// By path: the module, or none where it could not be read.
    loaded: HashMap<String, Option<usize>>,
    /// The paths of the files that are being read, each imported by the one before.
    open: Vec<String>,
    assets: &'a dyn Assets,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Loader<'_> {
    fn parse(&mut self, text: &str, file: usize) -> Module {
        let base = self.sources.files().get(file).map_or(0, |file| file.base);
        let parsed = syntax::parse(text, base);
        self.diagnostics.extend(parsed.errors().iter().cloned());
        parsed.module()
    }

    /// Replaces definitions by expressions from outside.
    fn replace(
        &mut self,
        syntax: &mut Module,
        path: &str,
        overrides: &[(String, String)],
    ) -> Vec<(Arc<str>, Span)> {
        let mut replaced = Vec::new();
        for (name, text) in overrides {
            // What it reads, it reads from the folder of the scene.
            let (called, text) = (format!("--set {name}"), format!("{name} = {text}"));
            let file = self.sources.add_at(called, path.to_owned(), text.into());
            let text = self.sources.files().get(file).map_or_else(|| "".into(), |file| file.text.clone());
            let mut given = self.parse(&text, file);
            let found = syntax.definitions.iter().position(|d| d.name().is_some_and(|n| *n.text == **name));
            match (found.and_then(|i| syntax.definitions.get_mut(i)), given.definitions.pop()) {
                (Some(definition), Some(new)) => {
                    replaced.push((Arc::from(name.as_str()), definition.span));
                    definition.parameters = Vec::new();
                    definition.body = new.body;
                }
                (None, Some(new)) => self.unknown_override(syntax, name, new.target.span),
                (_, None) => {}
            }
        }
        replaced
    }

    fn unknown_override(&mut self, syntax: &Module, name: &str, span: Span) {
        let names = syntax.definitions.iter().filter_map(Definition::name);
        let names: Vec<Arc<str>> = names.map(|name| name.text).collect();
        let mut error = Diagnostic::error(
            "unknown-override",
            format!("there is no definition `{name}` to set"),
            span,
            "not defined in the scene",
        );
        if let Some(near) = nearest(name, names.iter().map(AsRef::as_ref)) {
            error = error.with_help(format!("did you mean `{near}`?"));
        } else if !names.is_empty() {
            error = error.with_help(format!("the scene defines {}", listed(&names)));
        }
        self.diagnostics.push(error);
    }

    /// Reads what a module imports, makes its scope and adds it to the program.
    fn finish(&mut self, path: String, syntax: Module) -> usize {
        self.open.push(path.clone());
        let imported: Vec<_> = syntax.imports.iter().map(|import| self.import(import)).collect();
        self.open.pop();
        let module = self.modules.len();
        let mut scope = Scope::default();
        for (import, found) in syntax.imports.iter().zip(imported) {
            if let Some(found) = found {
                self.bring_in(&mut scope, import, found);
            }
        }
        let mut first: HashMap<Arc<str>, Span> = HashMap::new();
        for (index, definition) in syntax.definitions.iter().enumerate() {
            let Some(name) = definition.name() else { continue };
            if let Some(earlier) = first.get(&name.text) {
                let message = format!("`{}` is defined twice", name.text);
                let error = Diagnostic::error("defined-twice", message, name.span, "defined again here")
                    .with_secondary(*earlier, "first defined here")
                    .with_help("give one of them another name, or remove it");
                self.diagnostics.push(error);
                continue;
            }
            first.insert(name.text.clone(), name.span);
            scope.names.insert(name.text, Global::Definition { module, index });
        }
        self.modules.push(Arc::new(LoadedModule { path, syntax, scope, is_standard: false }));
        module
    }

    /// The module that an import means.
    fn import(&mut self, import: &super::ast::Import) -> Option<usize> {
        let from = self.open.last().cloned().unwrap_or_default();
        let Some(path) = resolve(&from, &import.path) else {
            let error = Diagnostic::error(
                "import-outside",
                format!("`{}` leads out of the root folder", import.path),
                import.path_span,
                "not inside the root folder",
            );
            self.diagnostics.push(error.with_help(
                "paths are written with slashes from the folder of the file that imports; `--root FOLDER` widens the root",
            ));
            return None;
        };
        if let Some(start) = self.open.iter().position(|open| *open == path) {
            let mut cycle: Vec<&str> = self.open.iter().skip(start).map(String::as_str).collect();
            cycle.push(&path);
            let error = Diagnostic::error(
                "import-cycle",
                format!("files import each other in a circle: {}", cycle.join(" -> ")),
                import.path_span,
                "this import closes the circle",
            );
            let help = "move what both need into a third file";
            self.diagnostics.push(error.with_help(help));
            return None;
        }
        if let Some(module) = self.loaded.get(&path) {
            return *module;
        }
        let module = self.read(&path, import.path_span);
        self.loaded.insert(path, module);
        module
    }

    fn read(&mut self, path: &str, span: Span) -> Option<usize> {
        if self.modules.len() >= MOST_MODULES {
            let message = format!("a scene may consist of {MOST_MODULES} files at most");
            self.diagnostics.push(Diagnostic::error("too-many-files", message, span, "one too many"));
            return None;
        }
        match self.assets.text(path) {
            Ok(text) => {
                let text: Arc<str> = text.into();
                let file = self.sources.add_at(self.assets.name(path), path.to_owned(), text.clone());
                let syntax = self.parse(&text, file);
                Some(self.finish(path.to_owned(), syntax))
            }
            Err(error) => {
                self.diagnostics.push(missing_asset(self.assets, path, span, &error));
                None
            }
        }
    }

    /// Makes the names of an import mean something.
    fn bring_in(&mut self, scope: &mut Scope, import: &super::ast::Import, module: usize) {
        let Some(found) = self.modules.get(module).cloned() else { return };
        let defined = |name: &str| {
            let global = found.scope.names.get(name).copied();
            global.filter(|global| matches!(global, Global::Definition { module: m, .. } if *m == module))
        };
        let all = found.syntax.definitions.iter().filter_map(Definition::name);
        let all: Vec<Arc<str>> = all.map(|name| name.text).collect();
        match &import.names {
            ImportNames::All => {
                let names = all.iter().filter_map(|name| Some((name.clone(), defined(name)?)));
                scope.names.extend(names.filter(|(name, _)| &**name != "scene"));
            }
            ImportNames::As(prefix) => {
                let names = all.iter().filter_map(|name| Some((name.clone(), defined(name)?)));
                scope.qualified.insert(prefix.text.clone(), names.collect());
            }
            ImportNames::Listed(names) => {
                for name in names {
                    match defined(&name.text) {
                        Some(global) => {
                            scope.names.insert(name.text.clone(), global);
                        }
                        None => self.not_exported(import, name, &all),
                    }
                }
            }
        }
    }

    fn not_exported(&mut self, import: &super::ast::Import, name: &Name, all: &[Arc<str>]) {
        let message = format!("{:?} does not define `{}`", import.path, name.text);
        let error = Diagnostic::error("unknown-import", message, name.span, "not defined there");
        let error = match nearest(&name.text, all.iter().map(AsRef::as_ref)) {
            Some(near) => error.with_suggestion(name.span, near, format!("did you mean `{near}`?")),
            None if all.is_empty() => error.with_help("that file defines nothing"),
            None => error.with_help(format!("it defines {}", listed(all))),
        };
        self.diagnostics.push(error);
    }
}

/// The complaint about an asset that is not to be had.
pub(super) fn missing_asset(assets: &dyn Assets, path: &str, span: Span, error: &AssetError) -> Diagnostic {
    let message = match error {
        AssetError::NotFound => format!("there is no file {path:?} in the root folder"),
        AssetError::Outside => format!("{path:?} lies outside the root folder"),
        AssetError::Unreadable(reason) => format!("{path:?} cannot be read: {reason}"),
    };
    let diagnostic = Diagnostic::error("missing-file", message, span, "not to be had");
    match error {
        AssetError::NotFound => {
            let around = assets.neighbours(path);
            let with_ending = format!("{path}.hry");
            if around.contains(&with_ending) {
                return diagnostic
                    .with_help(format!("did you mean {with_ending:?}? The ending belongs to the name"));
            }
            match nearest(path, around.iter().map(String::as_str)) {
                Some(near) => diagnostic.with_help(format!("did you mean {near:?}?")),
                None => diagnostic.with_help(
                    "the root is the folder of the scene; `--root FOLDER` widens it to a folder further up",
                ),
            }
        }
        AssetError::Outside => diagnostic.with_help("`--root FOLDER` widens the root to a folder further up"),
        AssetError::Unreadable(_) => diagnostic,
    }
}

/// The name among `names` that was probably meant by `name`.
pub(super) fn nearest<'n>(name: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let allowed = (name.chars().count() / 3).clamp(1, 3);
    let lower = name.to_lowercase();
    let distance = |candidate: &str| strsim::osa_distance(&lower, &candidate.to_lowercase());
    let near = names.filter(|candidate| *candidate != name).map(|candidate| (distance(candidate), candidate));
    near.filter(|(distance, _)| *distance <= allowed).min().map(|(_, candidate)| candidate)
}

/// `a`, `b` and `c`, or the first ten of many.
pub(super) fn listed<T: AsRef<str>>(names: &[T]) -> String {
    const SHOWN: usize = 12;
    let quoted: Vec<String> = names.iter().take(SHOWN).map(|name| format!("`{}`", name.as_ref())).collect();
    match quoted.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some(_) if names.len() > SHOWN => format!("{} and {} more", quoted.join(", "), names.len() - SHOWN),
        Some((last, first)) => format!("{} and {last}", first.join(", ")),
    }
}

/// An expression's callee and arguments, where it is an application.
#[must_use]
pub fn application(expr: &Expr) -> (&Expr, Vec<&Expr>) {
    let (mut callee, mut arguments) = (expr, Vec::new());
    while let super::ast::ExprKind::Apply { function, argument } = &callee.kind {
        arguments.push(&**argument);
        callee = function;
    }
    arguments.reverse();
    (callee, arguments)
}
