//! From a text to a scene, and what there is to say about it, in the words of the protocol.

use crate::protocol::{Event, Fix, Problem, Related, TextEdit};
use crate::units::Units;
use hray::{Assets, Description, Diagnostic, Limits, LoadOptions, SceneFile, Severity, Span, Summary};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A text that is to be evaluated.
#[derive(Clone)]
pub struct Work {
    /// The document.
    pub doc: String,
    /// Its version.
    pub version: u64,
    /// Its text.
    pub text: Arc<str>,
    /// What it may read.
    pub assets: Arc<dyn Assets + Send + Sync>,
    /// The moment, in seconds.
    pub time: f64,
    /// Definitions to replace.
    pub overrides: BTreeMap<String, String>,
    /// How much the evaluation may take.
    pub limits: Limits,
}

impl std::fmt::Debug for Work {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Work").field("doc", &self.doc).field("version", &self.version).finish_non_exhaustive()
    }
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Evaluated {
    /// All that is wrong.
    pub problems: Event,
    /// What it means.
    pub scene: Event,
    /// The scene; none where there are errors, and where there is none.
    pub description: Option<Description>,
}

impl Work {
    /// Reads, checks and evaluates; none where `stop` was set before the end.
    pub(crate) fn scene_file(&self, stop: &Arc<AtomicBool>) -> Option<SceneFile> {
        let options = LoadOptions {
            set: self.overrides.iter().map(|(name, value)| (name.clone(), value.clone())).collect(),
            time: self.time,
            limits: self.limits,
            modules: true,
            stop: Some(stop.clone()),
            ..LoadOptions::default()
        };
        let bytes = self.text.as_bytes().to_vec();
        let file = SceneFile::parse_among(&self.doc, &self.doc, bytes, self.assets.clone(), &options);
        (!stop.load(Ordering::Relaxed)).then_some(file)
    }

    /// Evaluates; none where `stop` was set before the end.
    #[must_use]
    pub fn evaluate(&self, stop: &Arc<AtomicBool>) -> Option<Evaluated> {
        let file = self.scene_file(stop)?;
        let description = file.description().cloned();
        let summary = description.as_ref().map(Summary::of);
        Some(Evaluated {
            problems: Event::Problems {
                doc: self.doc.clone(),
                version: self.version,
                items: problems(&file),
            },
            scene: Event::Scene {
                doc: self.doc.clone(),
                version: self.version,
                ok: description.is_some(),
                summary: summary.and_then(|summary| serde_json::to_value(summary).ok()),
                animated: file.is_animated(),
                module: file.module(),
            },
            description,
        })
    }
}

/// The diagnostics of a scene as problems.
fn problems(file: &SceneFile) -> Vec<Problem> {
    let mut places = Places { file, units: BTreeMap::new() };
    file.diagnostics().iter().map(|diagnostic| places.problem(diagnostic)).collect()
}

/// Where spans are, with the offsets of the files they are in.
struct Places<'a> {
    file: &'a SceneFile,
    units: BTreeMap<usize, Units>,
}

impl Places<'_> {
    fn place(&mut self, span: Span) -> (String, [usize; 2]) {
        let Some(source) = self.file.sources().file(span.start) else { return (String::new(), [0, 0]) };
        let units = self.units.entry(source.base).or_insert_with(|| Units::new(&source.text));
        let local = |offset: usize| source.text.floor_char_boundary(offset.saturating_sub(source.base));
        (source.path.clone(), units.span(Span::new(local(span.start), local(span.end.max(span.start)))))
    }

    fn problem(&mut self, diagnostic: &Diagnostic) -> Problem {
        let (file, [from, to]) = self.place(diagnostic.primary.span);
        let related = diagnostic.secondary.iter().map(|label| {
            let (file, [from, to]) = self.place(label.span);
            Related { file, from, to, text: label.text.clone() }
        });
        let related = related.collect();
        let fix = diagnostic.suggestion.as_ref().and_then(|suggestion| {
            let (of, [from, to]) = self.place(suggestion.span);
            let edits = vec![TextEdit { from, to, text: suggestion.replacement.clone() }];
            (of == file).then(|| Fix { title: suggestion.text.clone(), edits })
        });
        let words = diagnostic.suggestion.as_ref().map(|suggestion| suggestion.text.clone());
        Problem {
            file,
            from,
            to,
            severity: if diagnostic.severity == Severity::Error { "error" } else { "warning" },
            code: diagnostic.code,
            message: diagnostic.message.clone(),
            label: diagnostic.primary.text.clone(),
            related,
            notes: diagnostic.notes.clone(),
            help: diagnostic.help.clone().or(words),
            rendered: self.file.rendered(diagnostic),
            fixes: fix.into_iter().collect(),
            unnecessary: diagnostic.code.starts_with("unused-"),
        }
    }
}
