//! What the parser found, in words.

use super::super::kind::SyntaxKind;
use super::super::parser::Parser;
use super::quoted;
use crate::diagnostic::Span;

impl Parser<'_> {
    /// The current token as a message names it: "the number `3`", "`)`", "the end of `x`".
    pub(in super::super) fn found(&self) -> String {
        if !self.is_end() {
            return self.described(self.at);
        }
        match self.definition_name() {
            Some(name) => format!("the end of {}", quoted(name)),
            None if self.at < self.tokens.len() => "the end of the line".into(),
            None => "the end of the file".into(),
        }
    }

    pub(in super::super) fn described(&self, token: usize) -> String {
        let text = quoted(self.text_of(token));
        match self.kind_of(token) {
            SyntaxKind::Number => format!("the number {text}"),
            SyntaxKind::Color => format!("the colour {text}"),
            SyntaxKind::Text => format!("the text {text}"),
            SyntaxKind::Name | SyntaxKind::TypeName => format!("the name {text}"),
            SyntaxKind::End => "the end of the file".into(),
            kind if kind.is_keyword() => format!("the word {text}"),
            _ => text,
        }
    }

    /// The name of the binding that this is in.
    pub(in super::super) fn definition_name(&self) -> Option<&str> {
        let layout = self.layouts.last()?;
        Some(self.text_of(layout.first)).filter(|_| self.kind_of(layout.first) == SyntaxKind::Name)
    }

    /// The name of that binding, its place, and the line that ended it, where a line did.
    pub(in super::super) fn ended_by_layout(&self) -> Option<(&str, Span, Span)> {
        let layout = self.layouts.last()?;
        let next = self.tokens.get(self.at)?;
        let ends = self.is_end() && next.starts_line && next.column < layout.limit && self.at < self.wall;
        ends.then(|| (self.text_of(layout.first), self.span_of(layout.first), self.span_of(self.at)))
    }
}
