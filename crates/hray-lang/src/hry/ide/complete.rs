//! What may be written at a place.

use super::analysis::Analysis;
use super::context::{self, Context, PathOf, continues, defines, span_of};
use super::describe;
use super::hover::{TYPES, type_text};
use crate::diagnostic::Span;
use crate::hry::assets::{Assets, resolve};
use crate::hry::library::{Constructor, FieldSpec, FieldType, constructor};
use crate::hry::program::Global;
use crate::hry::syntax::{SyntaxKind, SyntaxNode, parse};
use crate::hry::types::Target;
use std::collections::BTreeSet;

/// What is put where a name is missing, so that the text around it reads as it will.
const MISSING: &str = "zz_missing";
/// The keywords that may begin an expression or go on with one.
const KEYWORDS: &[&str] = &["let", "in", "if", "then", "else", "match", "and", "or", "not", "true", "false"];
/// The extensions of images, in small letters.
const IMAGES: &[&str] =
    &["png", "jpg", "jpeg", "bmp", "tif", "tiff", "tga", "qoi", "ppm", "ff", "gif", "webp", "hdr", "exr"];

/// The extensions of files of meshes, in small letters.
const MODELS: &[&str] = &["ply", "stl", "obj", "gltf", "glb"];

/// Something that may be written at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Suggestion {
    /// What it is called.
    pub label: String,
    /// What it is.
    pub kind: SuggestionKind,
    /// Its type.
    pub detail: String,
    /// What it means, as Markdown; may be empty.
    pub documentation: String,
    /// What is put in the place of what is there.
    pub text: String,
    /// The same, where `${1:...}` is a part to be typed over and `$0` the place to go on; none where it is the same.
    pub snippet: Option<String>,
    /// What is replaced: what was typed of it already.
    pub span: Span,
    /// Its place in the list; those with smaller numbers come first.
    pub rank: usize,
}

/// The kinds of suggestions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SuggestionKind {
    /// A function.
    Function,
    /// A constructor.
    Constructor,
    /// A value.
    Value,
    /// A name bound inside the definition.
    Local,
    /// A field.
    Field,
    /// A word of the language.
    Keyword,
    /// A type.
    Type,
    /// A file.
    File,
    /// A folder.
    Folder,
    /// A file that was imported by a name.
    Module,
}

impl Analysis {
    /// What may be written at an offset.
    #[must_use]
    pub fn completions(&self, offset: usize, assets: &dyn Assets) -> Vec<Suggestion> {
        if self.is_classic() {
            return Vec::new();
        }
        let offset = self.text.floor_char_boundary(offset.min(self.text.len()));
        let before = self.text.get(..offset).unwrap_or("");
        let after = self.text.get(offset..).unwrap_or("");
        let start =
            offset - before.chars().rev().take_while(|c| continues(*c)).map(char::len_utf8).sum::<usize>();
        let root = parse(&self.text, 0).root();
        if let Some(context) = context::inside_token(&root, offset) {
            return match context {
                Context::Path(inner, of) => self.paths(inner, offset, of, assets),
                _ => Vec::new(),
            };
        }
        let typed = Span::new(start, offset);
        let name_end =
            offset + after.chars().take_while(|c| continues(*c)).map(char::len_utf8).sum::<usize>();
        let missing = if start == name_end { MISSING } else { "" };
        let patch = format!("{missing}{}", context::missing_brackets(&root, offset));
        if patch.is_empty() {
            return Completer { analysis: self, typed }.at(&root, start);
        }
        // What is missing is put in, for the parser to find.
        let (before, after) =
            (self.text.get(..name_end).unwrap_or(""), self.text.get(name_end..).unwrap_or(""));
        let patched = Self::new(&self.path, format!("{before}{patch}{after}").into(), assets);
        let root = parse(&patched.text, 0).root();
        Completer { analysis: &patched, typed }.at(&root, start)
    }

    /// The files that a text can name.
    fn paths(&self, inner: Span, offset: usize, of: PathOf, assets: &dyn Assets) -> Vec<Suggestion> {
        let written = Span::new(inner.start, offset).text(&self.text);
        let (folder, _) = written.rsplit_once('/').map_or(("", written), |(folder, name)| (folder, name));
        let prefix = if folder.is_empty() { String::new() } else { format!("{folder}/") };
        let Some(beside) = resolve(&self.path, &format!("{prefix}x")) else { return Vec::new() };
        let names: BTreeSet<String> =
            assets.neighbours(&beside).into_iter().filter(|path| *path != self.path).collect();
        let found = names.iter().filter_map(|path| {
            let name = path.rsplit('/').next()?;
            let extension = name.rsplit_once('.').map(|(_, extension)| extension.to_lowercase());
            let kind = match (extension.as_deref(), of) {
                (None, _) => SuggestionKind::Folder,
                (Some("hry"), PathOf::Module) => SuggestionKind::File,
                (Some(extension), PathOf::Model) if MODELS.contains(&extension) => SuggestionKind::File,
                (Some(extension), PathOf::Image) if IMAGES.contains(&extension) => SuggestionKind::File,
                _ => return None,
            };
            let slash = if kind == SuggestionKind::Folder { "/" } else { "" };
            let mut suggestion =
                plain(&format!("{prefix}{name}{slash}"), kind, Span::new(inner.start, offset));
            suggestion.rank = usize::from(kind == SuggestionKind::Folder);
            (!name.starts_with('.')).then_some(suggestion)
        });
        found.collect()
    }
}

fn plain(label: &str, kind: SuggestionKind, span: Span) -> Suggestion {
    Suggestion {
        label: label.to_owned(),
        kind,
        detail: String::new(),
        documentation: String::new(),
        text: label.to_owned(),
        snippet: None,
        span,
        rank: 0,
    }
}

/// Makes suggestions for a name in a text in which there is one.
struct Completer<'a> {
    analysis: &'a Analysis,
    /// What was typed of it.
    typed: Span,
}

impl Completer<'_> {
    fn at(&self, root: &SyntaxNode, start: usize) -> Vec<Suggestion> {
        match context::of_name(root, start + 1) {
            Context::Nothing | Context::Path(..) => Vec::new(),
            Context::Expression => self.expression(start),
            Context::Type => self.types(),
            Context::Top => self.top(),
            Context::Field(before) => self.after_point(&before, start),
            Context::Record(record) => self.record_fields(&record, start),
            Context::ImportName(import) => self.import_names(&import),
        }
    }

    fn plain(&self, label: &str, kind: SuggestionKind) -> Suggestion {
        plain(label, kind, self.typed)
    }

    /// Names in scope, and keywords.
    fn expression(&self, start: usize) -> Vec<Suggestion> {
        let Some((program, checked)) = &self.analysis.hry else { return Vec::new() };
        let Some(root) = program.root() else { return Vec::new() };
        let mut found = Vec::new();
        let locals = checked.completion_at(start).locals;
        let local_names: BTreeSet<&str> = locals.iter().map(|(name, _)| name.as_str()).collect();
        for (name, ty) in locals.iter().filter(|(name, _)| name != MISSING) {
            found.push(Suggestion { detail: ty.clone(), ..self.plain(name, SuggestionKind::Local) });
        }
        for (name, global) in root.scope.all() {
            if !local_names.contains(&*name) && &*name != MISSING {
                found.extend(self.global(&name, global));
            }
        }
        let mut modules: Vec<_> = root.scope.qualified.keys().collect();
        modules.sort();
        found.extend(
            modules
                .into_iter()
                .map(|name| Suggestion { rank: 1, ..self.plain(name, SuggestionKind::Module) }),
        );
        found.extend(
            KEYWORDS.iter().map(|word| Suggestion { rank: 3, ..self.plain(word, SuggestionKind::Keyword) }),
        );
        found
    }

    /// A name at the top; none where it is private to the library.
    fn global(&self, name: &str, global: Global) -> Option<Suggestion> {
        let is_own = match global {
            Global::Definition { module, .. } => {
                let (program, _) = self.analysis.hry.as_ref()?;
                !program.modules.get(module)?.is_standard
            }
            _ => false,
        };
        if !is_own && name.starts_with('_') {
            return None;
        }
        let signature = describe::signature(self.analysis, name, global);
        let detail = signature.split_once(" : ").map_or("", |(_, ty)| ty).to_owned();
        let (kind, snippet) = match global {
            Global::Constructor(_) => (SuggestionKind::Constructor, Some(format!("{name} {{ $0 }}"))),
            _ if is_function(&detail) => (SuggestionKind::Function, None),
            _ => (SuggestionKind::Value, None),
        };
        Some(Suggestion {
            detail,
            documentation: describe::documentation(self.analysis, global),
            snippet,
            rank: if is_own { 1 } else { 2 },
            ..self.plain(name, kind)
        })
    }

    fn types(&self) -> Vec<Suggestion> {
        let types = TYPES.iter().map(|name| Suggestion {
            documentation: type_text(name).unwrap_or("").to_owned(),
            ..self.plain(name, SuggestionKind::Type)
        });
        let kinds = [
            ("numeric", "Number, Vec2, Vec3 or Color."),
            ("vector", "Vec2 or Vec3."),
            ("placeable", "Shape, Material, Light, Camera, or a function of a Hit."),
            ("appendable", "A list or Text."),
        ];
        let kinds = kinds.iter().map(|(name, text)| Suggestion {
            documentation: format!("A variable that stands for {text}"),
            rank: 1,
            ..self.plain(name, SuggestionKind::Type)
        });
        types.chain(kinds).collect()
    }

    /// What can begin a line at the top: an import, the scene, and names that are annotated but not defined.
    fn top(&self) -> Vec<Suggestion> {
        let mut found = Vec::new();
        if !self.analysis.defines_scene() {
            found.push(Suggestion {
                documentation: "What is rendered.".into(),
                text: "scene = ".into(),
                snippet: Some("scene = {\n  $0\n}".into()),
                ..self.plain("scene", SuggestionKind::Value)
            });
        }
        found.push(Suggestion {
            documentation: "Brings in the definitions of another file.".into(),
            text: "import ".into(),
            snippet: Some("import \"$0\"".into()),
            rank: 1,
            ..self.plain("import", SuggestionKind::Keyword)
        });
        found
    }

    /// What may follow the point after an expression.
    fn after_point(&self, before: &SyntaxNode, start: usize) -> Vec<Suggestion> {
        let Some((program, checked)) = &self.analysis.hry else { return Vec::new() };
        let text = before.text().to_string();
        let local =
            matches!(checked.definition_at(span_of(before.text_range()).start), Some(Target::Local(_)));
        let module = program.root().and_then(|root| root.scope.qualified.get(text.trim()));
        if let (Some(names), false) = (module, local) {
            let mut names: Vec<_> = names.iter().filter(|(name, _)| !name.starts_with('_')).collect();
            names.sort_by(|a, b| a.0.cmp(b.0));
            return names.into_iter().filter_map(|(name, global)| self.global(name, *global)).collect();
        }
        let fields = checked.completion_at(start).fields.into_iter().enumerate();
        let fields = fields.map(|(rank, (name, ty))| Suggestion {
            documentation: hit_field(&name, &ty).to_owned(),
            detail: ty,
            rank,
            ..self.plain(&name, SuggestionKind::Field)
        });
        fields.collect()
    }

    /// The fields that a record has not yet.
    fn record_fields(&self, record: &SyntaxNode, start: usize) -> Vec<Suggestion> {
        let is_here = |field: &SyntaxNode| {
            let span = span_of(field.text_range());
            span.start <= start && start < span.end
        };
        let fields = record.children().filter(|child| child.kind() == SyntaxKind::FieldValue);
        let (here, others): (Vec<_>, Vec<_>) = fields.partition(is_here);
        let given: BTreeSet<String> =
            others.iter().filter_map(|f| Some(f.first_token()?.text().to_owned())).collect();
        let has_value = here.first().is_some_and(defines);
        let mut found = match self.owner(record) {
            Some(Owner::Constructor(constructor)) => constructor
                .fields
                .iter()
                .enumerate()
                .map(|(at, field)| self.field(constructor, field, at, has_value))
                .collect(),
            Some(Owner::Record(fields)) => {
                let fields = fields.into_iter().enumerate();
                let fields = fields.map(|(rank, (name, ty))| Suggestion {
                    text: if has_value { name.clone() } else { format!("{name} = ") },
                    detail: ty,
                    rank,
                    ..self.plain(&name, SuggestionKind::Field)
                });
                fields.collect()
            }
            // Of a record of any fields the short form takes every name.
            None if record.kind() == SyntaxKind::RecordExpr => self.expression(start),
            None => Vec::new(),
        };
        found.retain(|suggestion| !given.contains(&suggestion.label));
        found
    }

    /// What the fields of a record are those of.
    fn owner(&self, record: &SyntaxNode) -> Option<Owner> {
        let (_, checked) = self.analysis.hry.as_ref()?;
        if record.kind() == SyntaxKind::UpdateExpr {
            let changed = record.first_child()?;
            let (_, ty) = checked.type_at(span_of(changed.text_range()).start)?;
            return record_type(&ty).map(Owner::Record).or_else(|| hit_type(&ty));
        }
        let parent = record.parent()?;
        match parent.kind() {
            // Fields of `f a { ... }`: by the type of the parameter.
            SyntaxKind::ApplyExpr => {
                let mut callee = parent.first_child()?;
                let mut before = 0;
                while callee.kind() == SyntaxKind::ApplyExpr {
                    before += 1;
                    callee = callee.first_child()?;
                }
                let name = span_of(callee.last_token()?.text_range());
                let Some(Target::Global(global)) = checked.definition_at(name.start) else { return None };
                if let Global::Constructor(constructor) = global {
                    return (before == 0).then_some(Owner::Constructor(constructor));
                }
                let scheme = checked.scheme_of(global)?;
                let parameter = parameters(&scheme).into_iter().nth(before)?;
                record_type(&parameter).map(Owner::Record)
            }
            _ => self.in_scene(record).then(|| constructor("scene").map(Owner::Constructor))?,
        }
    }

    /// Whether a record is what `scene` is, or gives.
    fn in_scene(&self, record: &SyntaxNode) -> bool {
        for parent in record.ancestors().skip(1) {
            match parent.kind() {
                SyntaxKind::ParenExpr | SyntaxKind::LambdaExpr | SyntaxKind::IfExpr => {}
                SyntaxKind::LetExpr
                    if parent.last_child().as_ref().is_some_and(|body| {
                        span_of(body.text_range()).start <= span_of(record.text_range()).start
                    }) => {}
                SyntaxKind::Definition => {
                    let at_top = parent.parent().is_some_and(|file| file.kind() == SyntaxKind::File);
                    return at_top && parent.first_token().is_some_and(|name| name.text() == "scene");
                }
                _ => return false,
            }
        }
        false
    }

    fn field(&self, constructor: &Constructor, field: &FieldSpec, at: usize, has_value: bool) -> Suggestion {
        let default = field.default.filter(|default| !default.is_empty()).unwrap_or(match field.kind {
            FieldType::Vec3 => "(0, 0, 0)",
            FieldType::Vec2 => "(0, 0)",
            _ => "",
        });
        let escaped = default.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}");
        let mut detail = describe::field_type(field);
        if let Some(default) = field.default.filter(|default| !default.is_empty()) {
            detail += &format!(" = {default}");
        }
        Suggestion {
            detail,
            documentation: describe::field_text(constructor, field),
            text: if has_value { field.name.into() } else { format!("{} = ", field.name) },
            snippet: (!has_value).then(|| format!("{} = ${{1:{escaped}}}", field.name)),
            // What must be given comes first.
            rank: at + if field.default.is_none() { 0 } else { 100 },
            ..self.plain(field.name, SuggestionKind::Field)
        }
    }

    /// What an imported file defines and the list has not yet.
    fn import_names(&self, import: &SyntaxNode) -> Vec<Suggestion> {
        let Some((program, _)) = &self.analysis.hry else { return Vec::new() };
        let tokens: Vec<_> = import.children_with_tokens().filter_map(|child| child.into_token()).collect();
        let path = tokens.iter().find(|token| token.kind() == SyntaxKind::Text);
        let path = path.and_then(|path| resolve(&self.analysis.path, path.text().trim_matches('"')));
        let module = program.modules.iter().position(|m| !m.is_standard && Some(&m.path) == path.as_ref());
        let Some((place, module)) = module.and_then(|place| Some((place, program.modules.get(place)?)))
        else {
            return Vec::new();
        };
        let listed: BTreeSet<&str> = tokens.iter().map(|token| token.text()).collect();
        let definitions = module.syntax.definitions.iter().enumerate();
        let found = definitions.filter_map(|(index, definition)| {
            let name = definition.name()?.text;
            let is_free = !listed.contains(&*name) || name.len() == self.typed.end - self.typed.start;
            (is_free && !name.starts_with('_'))
                .then(|| self.global(&name, Global::Definition { module: place, index }))?
        });
        found.collect()
    }
}

/// What a record's fields belong to.
enum Owner {
    Constructor(&'static Constructor),
    Record(Vec<(String, String)>),
}

/// The fields of a hit.
fn hit_type(ty: &str) -> Option<Owner> {
    let fields = [("p", "Vec3"), ("world", "Vec3"), ("normal", "Vec3"), ("uv", "Vec2"), ("time", "Number")];
    let owned = || fields.iter().map(|(name, ty)| ((*name).to_owned(), (*ty).to_owned())).collect();
    (ty == "Hit").then(|| Owner::Record(owned()))
}

fn hit_field(name: &str, ty: &str) -> &'static str {
    match (name, ty) {
        ("p", "Vec3") => "The point in the shape's own coordinates, before any transform.",
        ("world", "Vec3") => "The point in the scene's coordinates.",
        ("normal", "Vec3") => {
            "The direction at right angles to the surface: of length 1, outward, in the scene's coordinates."
        }
        ("uv", "Vec2") => "The place on the surface, from (0, 0) to (1, 1).",
        ("time", "Number") => "The time in seconds.",
        _ => "",
    }
}

fn is_function(ty: &str) -> bool {
    parameters(ty).len() > 1
}

/// The parameters of a function's type and what it gives, as hry writes them.
fn parameters(ty: &str) -> Vec<String> {
    split(ty, "->")
}

/// The fields of a record type.
fn record_type(ty: &str) -> Option<Vec<(String, String)>> {
    let inner = ty.trim().strip_prefix('{')?.strip_suffix('}')?;
    let fields = split(inner, ",").into_iter();
    fields
        .map(|field| {
            let (name, ty) = field.split_once(':')?;
            Some((name.trim().to_owned(), ty.trim().to_owned()))
        })
        .collect()
}

/// The parts of a type between separators that are in no brackets.
fn split(ty: &str, separator: &str) -> Vec<String> {
    let (mut parts, mut open, mut start, mut at) = (Vec::new(), 0_usize, 0, 0);
    while let Some(c) = ty.get(at..).and_then(|rest| rest.chars().next()) {
        match c {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open = open.saturating_sub(1),
            _ if open == 0 && ty.get(at..).is_some_and(|rest| rest.starts_with(separator)) => {
                parts.push(ty.get(start..at).unwrap_or("").trim().to_owned());
                at += separator.len();
                start = at;
                continue;
            }
            _ => {}
        }
        at += c.len_utf8();
    }
    parts.push(ty.get(start..).unwrap_or("").trim().to_owned());
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_taken_apart() {
        assert_eq!(parameters("(a -> b) -> [a] -> [b]"), ["(a -> b)", "[a]", "[b]"]);
        let fields = record_type("{ light : Color, f : Hit -> { a : Number } }").unwrap();
        assert_eq!(fields[1], ("f".to_owned(), "Hit -> { a : Number }".to_owned()));
        assert_eq!(record_type("Number"), None);
    }
}
