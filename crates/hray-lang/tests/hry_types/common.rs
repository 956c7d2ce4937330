//! Programs of one file or several, checked.

use hray_core::Image;
use hray_lang::diagnostic::{Diagnostic, render};
use hray_lang::hry::Program;
use hray_lang::hry::assets::{AssetError, Assets};
use hray_lang::hry::types::{Checked, check};
use std::sync::Arc;

/// Files that can be imported.
pub(crate) struct Files(pub(crate) &'static [(&'static str, &'static str)]);

impl Assets for Files {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        found.map(|(_, text)| (*text).to_owned()).ok_or(AssetError::NotFound)
    }

    fn image(&self, _path: &str) -> Result<Arc<Image>, AssetError> {
        Err(AssetError::NotFound)
    }

    fn neighbours(&self, _path: &str) -> Vec<String> {
        self.0.iter().map(|(name, _)| (*name).to_owned()).collect()
    }
}

/// A program, what is known of it, and what is wrong with it.
pub(crate) fn checked(text: &str, files: &Files) -> (Program, Checked, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    let program = Program::load("scene.hry", "scene.hry", text.into(), &[], files, &mut diagnostics);
    let checked = check(&program, &mut diagnostics);
    for span in diagnostics.iter().flat_map(Diagnostic::spans) {
        let fits = program
            .sources
            .file(span.start)
            .is_some_and(|file| file.text.get(span.start - file.base..span.end - file.base).is_some());
        assert!(fits, "{span:?} does not fit\n{diagnostics:?}");
    }
    (program, checked, diagnostics)
}

/// A file with a scene that needs nothing of it.
pub(crate) fn with_scene(text: &str) -> String {
    format!("{text}\nscene = {{ objects = [sphere {{}}] }}\n")
}

/// What a user sees of a file that stands alone.
pub(crate) fn shown(text: &str) -> String {
    let (_, _, diagnostics) = checked(text, &Files(&[]));
    render(&diagnostics, "scene.hry", text, false)
}

/// The errors only, of definitions beside a scene.
pub(crate) fn errors(text: &str) -> String {
    let text = with_scene(text);
    let (_, _, diagnostics) = checked(&text, &Files(&[]));
    let errors: Vec<_> = diagnostics.into_iter().filter(Diagnostic::is_error).collect();
    render(&errors, "scene.hry", &text, false)
}
