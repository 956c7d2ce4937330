//! What kind of thing is written at a place, by the syntax around it.

use crate::diagnostic::Span;
use crate::hry::syntax::{SyntaxKind, SyntaxNode, SyntaxToken};
use rowan::TextSize;

/// A name in a text, and what may stand there.
#[derive(Debug)]
pub(super) enum Context {
    /// Nothing that could be completed: a comment, a number, a name that is being made.
    Nothing,
    /// An expression.
    Expression,
    /// A type.
    Type,
    /// The name of a definition at the top of the file.
    Top,
    /// The name after a point; the expression before it.
    Field(SyntaxNode),
    /// The name of a field of a record.
    Record(SyntaxNode),
    /// A text that names a file, without its quotes.
    Path(Span, PathOf),
    /// A name in the list of an import; the import.
    ImportName(SyntaxNode),
}

/// What a path leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PathOf {
    /// A file to import.
    Module,
    /// An image.
    Image,
    /// A file of meshes.
    Model,
}

/// The token at an offset: of two that meet there the one before, unless that is white space.
pub(super) fn token_at(root: &SyntaxNode, offset: usize) -> Option<SyntaxToken> {
    let end = usize::from(root.text_range().end());
    let offset = TextSize::try_from(offset.min(end)).ok()?;
    let found = root.token_at_offset(offset);
    let (left, right) = (found.clone().left_biased(), found.right_biased());
    match left {
        Some(left) if left.kind() == SyntaxKind::Whitespace => right,
        left => left,
    }
}

/// Where a node or token is.
pub(super) fn span_of(range: rowan::TextRange) -> Span {
    Span::new(usize::from(range.start()), usize::from(range.end()))
}

/// Whether names may go on with a character.
pub(super) fn continues(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '\''
}

/// What is at an offset where nothing was typed yet, or what is inside tokens that hold text: none where it takes a name
/// there to know.
pub(super) fn inside_token(root: &SyntaxNode, offset: usize) -> Option<Context> {
    let token = token_at(root, offset)?;
    let span = span_of(token.text_range());
    match token.kind() {
        SyntaxKind::Comment if offset > span.start => Some(Context::Nothing),
        SyntaxKind::BlockComment if offset > span.start && offset < span.end => Some(Context::Nothing),
        SyntaxKind::Number | SyntaxKind::Color if offset > span.start => Some(Context::Nothing),
        SyntaxKind::Text if offset > span.start => Some(text(&token, span, offset)),
        _ => None,
    }
}

/// Inside a text.
fn text(token: &SyntaxToken, span: Span, offset: usize) -> Context {
    let closed = token.text().len() > 1 && token.text().ends_with('"');
    let inner = Span::new(span.start + 1, if closed { span.end - 1 } else { span.end });
    if offset > inner.end {
        return Context::Nothing;
    }
    let parents = token.parent().into_iter().flat_map(|parent| parent.ancestors()).take(3);
    for parent in parents {
        match parent.kind() {
            SyntaxKind::Import => return Context::Path(inner, PathOf::Module),
            SyntaxKind::FieldValue => {
                let named = parent.first_token().is_some_and(|first| first.text() == "file");
                return if named { Context::Path(inner, PathOf::Model) } else { Context::Nothing };
            }
            SyntaxKind::ApplyExpr => {
                let called = parent.first_token().is_some_and(|first| first.text() == "image");
                return if called { Context::Path(inner, PathOf::Image) } else { Context::Nothing };
            }
            _ => {}
        }
    }
    Context::Nothing
}

/// What the name at an offset is.
pub(super) fn of_name(root: &SyntaxNode, offset: usize) -> Context {
    let Some(token) = token_at(root, offset) else { return Context::Top };
    let Some(parent) = token.parent() else { return Context::Top };
    match parent.kind() {
        SyntaxKind::FieldExpr => parent.first_child().map_or(Context::Nothing, Context::Field),
        SyntaxKind::FieldValue => record(&parent),
        SyntaxKind::NameExpr => match parent.parent() {
            Some(field) if field.kind() == SyntaxKind::FieldValue && !defines(&field) => record(&field),
            _ => Context::Expression,
        },
        SyntaxKind::Import => {
            match parent.children_with_tokens().any(|t| t.kind() == SyntaxKind::OpenParen) {
                true => Context::ImportName(parent),
                false => Context::Nothing,
            }
        }
        kind if kind.is_type() => Context::Type,
        kind if kind.is_pattern() => match parent.parent() {
            Some(definition) if at_top(&definition) && definition.first_token().as_ref() == Some(&token) => {
                Context::Top
            }
            _ => Context::Nothing,
        },
        SyntaxKind::Definition | SyntaxKind::Annotation if at_top(&parent) => Context::Top,
        SyntaxKind::Definition | SyntaxKind::Annotation => Context::Nothing,
        SyntaxKind::File => Context::Top,
        _ => Context::Expression,
    }
}

fn at_top(definition: &SyntaxNode) -> bool {
    let kinds = [SyntaxKind::Definition, SyntaxKind::Annotation];
    kinds.contains(&definition.kind())
        && definition.parent().is_some_and(|file| file.kind() == SyntaxKind::File)
}

/// Whether a field has an `=`.
pub(super) fn defines(field: &SyntaxNode) -> bool {
    field.children_with_tokens().any(|token| token.kind() == SyntaxKind::Define)
}

fn record(field: &SyntaxNode) -> Context {
    field.parent().map_or(Context::Nothing, Context::Record)
}

/// The brackets that would have to be closed at an offset because nothing after it closes them: of those that are open
/// there the innermost, up to one that is closed.
pub(super) fn missing_brackets(root: &SyntaxNode, offset: usize) -> String {
    let mut open: Vec<(SyntaxKind, bool)> = Vec::new();
    let mut inside: Vec<(SyntaxKind, bool)> = Vec::new();
    let tokens = root.descendants_with_tokens().filter_map(|element| element.into_token());
    // How many of those inside are open still.
    let (mut is_after, mut depth) = (false, 0);
    for token in tokens {
        if !is_after && span_of(token.text_range()).end > offset {
            is_after = true;
            inside.clone_from(&open);
            depth = inside.len();
        }
        match token.kind() {
            kind if kind.is_open() => open.push((kind.closing(), false)),
            kind if kind.is_close() => {
                // It closes the nearest of its kind; those in between are closed by nothing.
                if let Some(at) = open.iter().rposition(|(closing, _)| *closing == kind) {
                    if is_after && at < depth {
                        inside.iter_mut().skip(at).take(1).for_each(|bracket| bracket.1 = true);
                        depth = at;
                    }
                    open.truncate(at);
                }
            }
            _ => {}
        }
        if is_after && open.is_empty() {
            break;
        }
    }
    if !is_after {
        inside = open;
    }
    inside.iter().rev().take_while(|(_, closed)| !closed).map(|(closing, _)| closing.spelling()).collect()
}
