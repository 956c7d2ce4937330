//! The files of a program, and where in which of them a place is.

use super::program::standard;
use crate::diagnostic::Span;
use std::sync::Arc;

/// A file of a program. Its text occupies the offsets from `base` on, so that a span alone tells its file.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// What it is called in messages.
    pub name: String,
    /// Its path in the root folder; of a text in no file that of the file it belongs to.
    pub path: String,
    /// Its text.
    pub text: Arc<str>,
    /// The offset of its first byte.
    pub base: usize,
}

/// Where the offsets of the standard library begin: beyond those of any scene (in a browser, where a `usize` has 32 bits, beyond
/// the half of all memory).
pub const STANDARD_BASE: usize = 1 << if usize::BITS > 40 { 40 } else { usize::BITS - 1 };

/// All files of a program, in the order of their bases. The first is the scene itself; the standard library's are always
/// there, from [`STANDARD_BASE`] on.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<SourceFile>,
}

impl Sources {
    /// Adds a file after all others; its place among the files. There is an offset between two files, so that the end of
    /// one is not the start of the next.
    pub fn add(&mut self, name: String, text: Arc<str>) -> usize {
        self.add_at(name.clone(), name, text)
    }

    /// The same of a file whose path in the root folder is not its name.
    pub fn add_at(&mut self, name: String, path: String, text: Arc<str>) -> usize {
        let base = self.files.last().map_or(0, |last| last.base + last.text.len() + 1);
        self.files.push(SourceFile { name, path, text, base });
        self.files.len() - 1
    }

    /// All files.
    #[must_use]
    pub fn files(&self) -> &[SourceFile] {
        &self.files
    }

    /// The file that an offset lies in.
    #[must_use]
    pub fn file(&self, offset: usize) -> Option<&SourceFile> {
        let files = if offset < STANDARD_BASE { &self.files } else { &standard().files };
        let after = files.partition_point(|file| file.base <= offset);
        files.get(after.checked_sub(1)?)
    }

    /// The text under a span.
    #[must_use]
    pub fn text(&self, span: Span) -> &str {
        let local =
            |file: &SourceFile| Some(span.start.checked_sub(file.base)?..span.end.checked_sub(file.base)?);
        self.file(span.start).and_then(|file| file.text.get(local(file)?)).unwrap_or("")
    }

    /// `file:line:column` of an offset, counted in characters from 1.
    #[must_use]
    pub fn location(&self, offset: usize) -> (String, usize, usize) {
        let Some(file) = self.file(offset) else { return (String::new(), 1, 1) };
        let before = file.text.get(..file.text.floor_char_boundary(offset - file.base)).unwrap_or("");
        let line = before.matches('\n').count() + 1;
        let column =
            before.rsplit('\n').next().unwrap_or("").chars().filter(|c| *c != '\u{feff}').count() + 1;
        (file.name.clone(), line, column)
    }
}
