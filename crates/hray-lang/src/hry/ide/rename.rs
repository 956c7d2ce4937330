//! New names for definitions and locals.
//!
//! A renaming is tried before it is proposed: the texts are changed and read again, and where then another set of places
//! means the renamed thing than before, or there are errors that were not there, it is refused. So it cannot capture a name,
//! nor be captured.

use super::analysis::{Analysis, FileId, Place};
use super::context::{defines, token_at};
use crate::diagnostic::Span;
use crate::hry::syntax::{SyntaxKind, SyntaxNode, parse};
use crate::hry::types::Target;
use std::collections::BTreeMap;

/// Where a name is, and what it is called now.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Renaming {
    /// The name under the pointer.
    pub span: Span,
    /// It.
    pub name: String,
    /// Where it is bound.
    pub defined: Place,
}

/// A replacement in one of the scene's own files.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Edit {
    /// The path of the file.
    pub path: String,
    /// What is replaced.
    pub span: Span,
    /// What by.
    pub text: String,
}

impl Analysis {
    /// The name at an offset, where it can be changed.
    ///
    /// # Errors
    /// Why it cannot, in a sentence.
    pub fn renaming(&self, offset: usize) -> Result<Renaming, String> {
        let nothing = || "there is no name here".to_owned();
        let root = parse(&self.text, 0).root();
        let token =
            token_at(&root, offset).filter(|token| token.kind() == SyntaxKind::Name).ok_or_else(nothing)?;
        let (span, name) = (super::context::span_of(token.text_range()), token.text().to_owned());
        let defined = match self.target(span.start) {
            Some(Target::Field(constructor, _)) => {
                return Err(format!("`{name}` is a field of `{}` and keeps its name", constructor.name));
            }
            Some(target) => self.defined_at(&target),
            None => return Err(format!("what `{name}` is called is not decided here")),
        };
        match defined {
            Some(Place { file: FileId::Own(_), .. }) if name == "scene" && self.is_top(&defined) => {
                Err("what is rendered is called `scene`".into())
            }
            Some(place @ Place { file: FileId::Own(_), .. }) => Ok(Renaming { span, name, defined: place }),
            _ => Err(format!("`{name}` belongs to the library and keeps its name")),
        }
    }

    /// Whether a name is bound at the top of the file.
    fn is_top(&self, place: &Option<Place>) -> bool {
        let root = self.hry.as_ref().and_then(|(program, _)| program.root());
        let span = place.as_ref().map(|place| place.span);
        root.is_some_and(|root| root.syntax.definitions.iter().any(|d| Some(d.target.span) == span))
    }

    fn error_count(&self) -> usize {
        self.remarks().iter().filter(|remark| remark.severity == crate::diagnostic::Severity::Error).count()
    }
}

/// The edits that give a new name to what is bound at `defined`, in all files that `roots` consist of, in order.
///
/// `reread` analyses the file at a path again, with the texts that are given by their paths in the place of what there is.
///
/// # Errors
/// Why it cannot have that name, in a sentence.
pub fn rename(
    roots: &[&Analysis],
    renaming: &Renaming,
    new: &str,
    text_of: impl Fn(&str) -> Option<String>,
    reread: impl Fn(&str, &BTreeMap<String, String>) -> Option<Analysis>,
) -> Result<Vec<Edit>, String> {
    check_name(new)?;
    if new == renaming.name {
        return Ok(Vec::new());
    }
    let uses: Vec<Vec<Place>> = roots.iter().map(|root| root.uses_of(&renaming.defined)).collect();
    let mut all: Vec<&Place> = uses.iter().flatten().collect();
    all.sort();
    all.dedup();
    let (mut edits, mut texts) = (Vec::new(), BTreeMap::<String, Text>::new());
    for place in all {
        let FileId::Own(path) = &place.file else { continue };
        if !texts.contains_key(path) {
            let old = text_of(path).ok_or_else(|| format!("{path:?} cannot be read"))?;
            texts.insert(path.clone(), Text { root: parse(&old, 0).root(), old });
        }
        let Some(text) = texts.get(path) else { continue };
        if place.span.text(&text.old) != renaming.name {
            continue;
        }
        let edited =
            if text.is_short(place.span) { format!("{} = {new}", renaming.name) } else { new.to_owned() };
        edits.push(Edit { path: path.clone(), span: place.span, text: edited });
    }
    let changed: BTreeMap<String, String> =
        texts.iter().map(|(path, text)| (path.clone(), apply(&text.old, path, &edits))).collect();
    let moved = |place: &Place| shifted(place, &edits);
    for (root, before) in roots.iter().zip(&uses).filter(|(_, uses)| !uses.is_empty()) {
        let clash = || format!("`{new}` already means something else where `{}` is used", renaming.name);
        let after = reread(&root.path, &changed).ok_or_else(clash)?;
        let mut expected: Vec<Place> = before.iter().map(moved).collect();
        expected.sort();
        if after.uses_of(&moved(&renaming.defined)) != expected || after.error_count() > root.error_count() {
            return Err(clash());
        }
    }
    Ok(edits)
}

struct Text {
    root: SyntaxNode,
    old: String,
}

impl Text {
    /// Whether the name at a place is a field in its short form, `{ name }`, and so the name of a field, too.
    fn is_short(&self, span: Span) -> bool {
        let token = token_at(&self.root, span.start + 1);
        let fields = [SyntaxKind::FieldValue, SyntaxKind::FieldPattern];
        let parents =
            token.and_then(|token| token.parent()).into_iter().flat_map(|parent| parent.ancestors()).take(2);
        parents
            .into_iter()
            .find(|parent| fields.contains(&parent.kind()))
            .is_some_and(|field| !defines(&field))
    }
}

/// A text after the edits of one file, which are in order.
fn apply(old: &str, path: &str, edits: &[Edit]) -> String {
    let (mut text, mut at) = (String::with_capacity(old.len()), 0);
    for edit in edits.iter().filter(|edit| edit.path == path) {
        text.push_str(old.get(at..edit.span.start).unwrap_or(""));
        text.push_str(&edit.text);
        at = edit.span.end;
    }
    text.push_str(old.get(at..).unwrap_or(""));
    text
}

/// Where a place is after the edits. A name in its short form is at the end of what replaced it.
fn shifted(place: &Place, edits: &[Edit]) -> Place {
    let FileId::Own(path) = &place.file else { return place.clone() };
    let mut span = place.span;
    for edit in edits.iter().filter(|edit| edit.path == *path) {
        if edit.span == place.span {
            let name = edit.text.rsplit(' ').next().unwrap_or("").len();
            let end = span.start + edit.text.len();
            return Place { file: place.file.clone(), span: Span::new(end - name, end) };
        }
        if edit.span.end <= place.span.start {
            let moved = |at: usize| (at + edit.text.len()).saturating_sub(edit.span.end - edit.span.start);
            span = Span::new(moved(span.start), moved(span.end));
        }
    }
    Place { file: place.file.clone(), span }
}

/// Whether a value can have a name.
fn check_name(name: &str) -> Result<(), String> {
    let root = parse(name, 0).root();
    let token = root.first_token().filter(|token| token.text() == name);
    match token.map(|token| token.kind()) {
        Some(SyntaxKind::Name) if parse(&format!("{name} = 0"), 0).errors().is_empty() => Ok(()),
        Some(SyntaxKind::TypeName) => Err(format!("`{name}` begins with a capital letter; only types do")),
        Some(kind) if kind.is_keyword() => Err(format!("`{name}` is a word of the language")),
        _ => Err(format!("{name:?} is no name: a letter or `_`, then letters, digits, `_` and `'`")),
    }
}
