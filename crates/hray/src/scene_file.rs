//! A scene file: its text, what it describes, and what there is to say about it.

use crate::{Description, Diagnostic, Error, Input, InputError, LintLevels, LoadError};
use hray_lang::{classic, decode, diagnostic, lint};
use std::borrow::Cow;
use std::path::Path;

/// A scene as it was read, with its diagnostics.
#[derive(Clone, Debug)]
pub struct SceneFile {
    name: String,
    text: String,
    description: Option<Description>,
    diagnostics: Vec<Diagnostic>,
}

impl SceneFile {
    /// Reads a scene.
    ///
    /// # Errors
    /// [`InputError`] where it cannot be read. What is wrong with its text is in the diagnostics.
    pub fn read(input: &Input, levels: &LintLevels) -> Result<Self, InputError> {
        Ok(Self::parse(&input.name(), hray_io::read_source(input)?, levels))
    }

    /// Makes a scene of bytes, which are called `name` in diagnostics.
    #[must_use]
    pub fn parse(name: &str, bytes: Vec<u8>, levels: &LintLevels) -> Self {
        let (text, unreadable) = match decode::decode(&bytes) {
            decode::Decoded { text: Cow::Owned(text), error } => (text, error),
            decode::Decoded { text: Cow::Borrowed(_), error } => {
                (String::from_utf8(bytes).unwrap_or_default(), error)
            }
        };
        let (description, diagnostics) = match unreadable {
            Some(error) => (None, vec![error]),
            None => Self::understand(&text, levels),
        };
        Self { name: name.to_owned(), text, description, diagnostics }
    }

    fn understand(text: &str, levels: &LintLevels) -> (Option<Description>, Vec<Diagnostic>) {
        let parsed = classic::parse(text);
        let mut diagnostics = parsed.diagnostics;
        if let Some(description) = &parsed.description {
            diagnostics.extend(lint::check(text, description, &parsed.spans, levels));
        }
        let denied = diagnostics.iter().any(Diagnostic::is_error);
        (parsed.description.filter(|_| !denied), diagnostics)
    }

    /// What the scene file describes; none where it has errors.
    #[must_use]
    pub const fn description(&self) -> Option<&Description> {
        self.description.as_ref()
    }

    /// Its errors and warnings.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
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
        diagnostic::render(&self.diagnostics, &self.name, &self.text, color)
    }

    /// What the scene file describes, or itself as an error.
    ///
    /// # Errors
    /// [`LoadError::Scene`] where it has errors.
    pub fn into_description(mut self) -> Result<Description, LoadError> {
        self.description.take().ok_or_else(|| LoadError::Scene(Box::new(self)))
    }
}

/// Reads the scene in a file. Warnings are passed over in silence; [`SceneFile::read`] has them.
///
/// # Errors
/// [`Error::Load`] where the file cannot be read, or has errors.
pub fn load(path: impl AsRef<Path>) -> Result<Description, Error> {
    let input = Input::File(path.as_ref().to_owned());
    Ok(SceneFile::read(&input, &LintLevels::default())?.into_description()?)
}
