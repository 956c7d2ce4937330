//! A text that is open in the editor.

use super::position::{Encoding, Lines};
use hray::ide::{Analysis, Remark};
use lsp_types::{Position, Range, TextDocumentContentChangeEvent};
use std::path::PathBuf;
use std::sync::Arc;

/// A text, where it lies, and what is known of it.
#[derive(Debug)]
pub(crate) struct Document {
    pub(crate) text: Arc<str>,
    pub(crate) lines: Lines,
    pub(crate) version: i32,
    pub(crate) home: Home,
    /// Of the text as it is; none where that was not looked at yet.
    pub(crate) analysis: Option<Arc<Analysis>>,
    /// What evaluating the text as it is found.
    pub(crate) evaluated: Vec<Remark>,
    /// Whether the client has been told what is wrong with it.
    pub(crate) is_told: bool,
}

/// Where a text lies.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Home {
    /// The folder whose files it may import; none where it is in no file.
    pub(crate) root: Option<PathBuf>,
    /// Its path in that.
    pub(crate) path: String,
}

impl Document {
    pub(crate) fn new(text: &str, version: i32, home: Home) -> Self {
        let (lines, text) = (Lines::new(text), Arc::from(text));
        Self { text, lines, version, home, analysis: None, evaluated: Vec::new(), is_told: false }
    }

    /// Puts in what was changed.
    pub(crate) fn change(
        &mut self,
        changes: Vec<TextDocumentContentChangeEvent>,
        version: i32,
        encoding: Encoding,
    ) {
        for change in changes {
            self.text = match change.range {
                None => change.text.into(),
                Some(range) => {
                    let span = self.lines.span(&self.text, range, encoding);
                    let before = self.text.get(..span.start).unwrap_or("");
                    let after = self.text.get(span.end..).unwrap_or("");
                    [before, &change.text, after].concat().into()
                }
            };
            self.lines = Lines::new(&self.text);
        }
        self.version = version;
        self.forget();
    }

    /// What was known of it holds no longer.
    pub(crate) fn forget(&mut self) {
        self.analysis = None;
        self.evaluated.clear();
        self.is_told = false;
    }

    pub(crate) fn offset(&self, position: Position, encoding: Encoding) -> usize {
        self.lines.offset(&self.text, position, encoding)
    }

    pub(crate) fn range(&self, span: hray::Span, encoding: Encoding) -> Range {
        self.lines.range(&self.text, span, encoding)
    }
}
