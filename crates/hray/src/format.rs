//! The layout of scenes in hry.

use crate::Diagnostic;
use hray_lang::hry::{Sources, format};
use hray_lang::{Language, decode, diagnostic};

/// What came of laying out a scene.
#[derive(Clone, Debug)]
pub enum Formatted {
    /// The text in the common layout.
    Text(String),
    /// It is a classic scene; only hry has a layout.
    Classic,
    /// It has errors that leave its layout unclear.
    Errors(FormatErrors),
}

/// Why a scene cannot be laid out.
#[derive(Clone, Debug)]
pub struct FormatErrors {
    sources: Sources,
    diagnostics: Vec<Diagnostic>,
}

impl FormatErrors {
    /// The errors, each with its place and the source line. `color` adds the colours of a terminal.
    #[must_use]
    pub fn text(&self, color: bool) -> String {
        diagnostic::render_sources(&self.diagnostics, &self.sources, color)
    }
}

/// Lays out a scene in the one common style. The bytes are called `name` in errors.
#[must_use]
pub fn format_scene(name: &str, bytes: &[u8]) -> Formatted {
    let decoded = decode::decode(bytes);
    let result = match decoded.error {
        Some(error) => Err(vec![error]),
        None if Language::of(&decoded.text) == Language::Classic => return Formatted::Classic,
        None => format::format(&decoded.text),
    };
    match result {
        Ok(text) => Formatted::Text(text),
        Err(diagnostics) => {
            let mut sources = Sources::default();
            sources.add(name.to_owned(), decoded.text.into());
            Formatted::Errors(FormatErrors { sources, diagnostics })
        }
    }
}
