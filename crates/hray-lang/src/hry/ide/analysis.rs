//! A text with everything that it imports, read and checked.

use super::remarks::{self, Remark};
use crate::diagnostic::{Diagnostic, Severity, Span};
use crate::hry::assets::Assets;
use crate::hry::eval::{Limits, evaluate};
use crate::hry::format::format;
use crate::hry::library::STANDARD;
use crate::hry::program::{Program, standard};
use crate::hry::sources::STANDARD_BASE;
use crate::hry::types::{Checked, check};
use crate::lint::{self, LintLevels};
use crate::{Language, classic};
use std::sync::Arc;

/// The codes of errors that may only come from budgets that are smaller here than when a scene is rendered.
const BUDGETS: &[&str] = &["too-many-steps", "too-much-memory", "list-too-long"];

/// A file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FileId {
    /// By its path, relative to the root folder.
    Own(String),
    /// A file of the library, by its name; see [`library_text`](super::library_text).
    Library(&'static str),
}

/// A stretch of text in a file, in offsets from the file's beginning.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// The file.
    pub file: FileId,
    /// Where in it.
    pub span: Span,
}

/// A text, read and checked. Its own offsets are those of the program, as it is the program's first file.
#[derive(Clone, Debug)]
pub struct Analysis {
    pub(super) text: Arc<str>,
    pub(super) path: String,
    /// Nothing where the text is classic.
    pub(super) hry: Option<(Program, Checked)>,
    diagnostics: Vec<Diagnostic>,
}

impl Analysis {
    /// Reads and checks a text whose path in the root folder is `path`.
    #[must_use]
    pub fn new(path: &str, text: Arc<str>, assets: &dyn Assets) -> Self {
        let mut diagnostics = Vec::new();
        let hry = if Language::of(&text) == Language::Classic {
            let parsed = classic::parse(&text);
            diagnostics = parsed.diagnostics;
            if let Some(description) = &parsed.description {
                let levels = LintLevels::default();
                diagnostics.extend(lint::check(&text, description, &parsed.spans, &levels));
            }
            None
        } else {
            let program = Program::load(path, path, text.clone(), &[], assets, &mut diagnostics);
            let checked = check(&program, &mut diagnostics);
            Some((program, checked))
        };
        Self { text, path: path.to_owned(), hry, diagnostics }
    }

    /// Whether it is in the grammar of 2005.
    #[must_use]
    pub const fn is_classic(&self) -> bool {
        self.hry.is_none()
    }

    /// The text.
    #[must_use]
    pub fn text(&self) -> &Arc<str> {
        &self.text
    }

    /// Its path in the root folder.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Whether there are errors, in this file or in what it imports.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|diagnostic| diagnostic.is_error() && diagnostic.code != "no-scene")
    }

    /// Whether it is a scene, and not there to be imported.
    pub(super) fn defines_scene(&self) -> bool {
        let root = self.hry.as_ref().and_then(|(program, _)| program.root());
        root.is_some_and(|root| {
            root.syntax.definitions.iter().any(|d| d.name().is_some_and(|n| &*n.text == "scene"))
        })
    }

    /// What reading and checking found.
    #[must_use]
    pub fn remarks(&self) -> Vec<Remark> {
        self.diagnostics.iter().filter_map(|diagnostic| remarks::remark(self, diagnostic)).collect()
    }

    /// What only evaluation finds, at time 0. Nothing where there are errors already, or no scene to evaluate. That a budget
    /// is used up is only a warning, as budgets may be smaller here than when the scene is rendered.
    #[must_use]
    pub fn evaluated(&self, assets: &dyn Assets, limits: &Limits) -> Vec<Remark> {
        let Some((program, _)) = &self.hry else { return Vec::new() };
        if self.has_errors() || !self.defines_scene() {
            return Vec::new();
        }
        let mut found = evaluate(program, assets, 0.0, limits).diagnostics;
        for diagnostic in found.iter_mut().filter(|diagnostic| BUDGETS.contains(&diagnostic.code)) {
            diagnostic.severity = Severity::Warning;
            diagnostic.notes.push("the editor looks no further".into());
        }
        found.iter().filter_map(|diagnostic| remarks::remark(self, diagnostic)).collect()
    }

    /// The text in the common layout; none where it is classic or has errors that leave its layout unclear.
    #[must_use]
    pub fn formatted(&self) -> Option<String> {
        self.hry.as_ref()?;
        format(&self.text).ok()
    }

    /// Where a span of the program is.
    pub(super) fn place(&self, span: Span) -> Option<Place> {
        let Some((program, _)) = &self.hry else {
            return Some(Place { file: FileId::Own(self.path.clone()), span });
        };
        let file = program.sources.file(span.start)?;
        let local = Span::new(span.start.checked_sub(file.base)?, span.end.checked_sub(file.base)?);
        if span.start >= STANDARD_BASE {
            let index = standard().files.iter().position(|other| other.base == file.base)?;
            return Some(Place { file: FileId::Library(STANDARD.get(index)?.name), span: local });
        }
        Some(Place { file: FileId::Own(file.path.clone()), span: local })
    }

    /// The span in the program of a place in one of its own files.
    pub(super) fn span(&self, place: &Place) -> Option<Span> {
        let (program, _) = self.hry.as_ref()?;
        let FileId::Own(path) = &place.file else { return None };
        let file = program.sources.files().iter().find(|file| file.path == *path)?;
        Some(Span::new(file.base + place.span.start, file.base + place.span.end))
    }

    /// The paths of the files that it consists of, itself included.
    #[must_use]
    pub fn files(&self) -> Vec<String> {
        match &self.hry {
            None => vec![self.path.clone()],
            Some((program, _)) => program.sources.files().iter().map(|file| file.path.clone()).collect(),
        }
    }
}
