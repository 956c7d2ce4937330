//! The outline of a file.

use super::analysis::Analysis;
use crate::diagnostic::Span;
use crate::hry::ast::{Definition, Expr, ExprKind};

/// How deep definitions inside definitions are listed.
const DEEPEST: usize = 8;

/// A definition.
#[derive(Clone, Debug, PartialEq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// Its type, where that is known.
    pub detail: Option<String>,
    /// What it is.
    pub kind: SymbolKind,
    /// All of it.
    pub span: Span,
    /// Its name's place.
    pub name_span: Span,
    /// Definitions in it.
    pub children: Vec<Symbol>,
}

/// The kinds of definitions that are shown differently.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// What is rendered.
    Scene,
    /// A function.
    Function,
    /// Any other value.
    Value,
}

impl Analysis {
    /// The definitions of the file, those inside others below them.
    #[must_use]
    pub fn symbols(&self) -> Vec<Symbol> {
        let root = self.hry.as_ref().and_then(|(program, _)| program.root());
        root.map_or_else(Vec::new, |root| self.all(&root.syntax.definitions, 0))
    }

    fn all(&self, definitions: &[Definition], depth: usize) -> Vec<Symbol> {
        definitions.iter().filter_map(|definition| self.symbol(definition, depth)).collect()
    }

    fn symbol(&self, definition: &Definition, depth: usize) -> Option<Symbol> {
        let name = definition.name()?;
        let own = |span: Span| span.end <= self.text.len();
        if !own(definition.span) || !own(name.span) {
            return None;
        }
        let (_, checked) = self.hry.as_ref()?;
        let detail = checked.type_at(name.span.start).map(|(_, ty)| ty);
        let is_function =
            !definition.parameters.is_empty() || matches!(definition.body.kind, ExprKind::Lambda { .. });
        let kind = match &*name.text {
            "scene" if depth == 0 => SymbolKind::Scene,
            _ if is_function => SymbolKind::Function,
            _ => SymbolKind::Value,
        };
        let children = if depth < DEEPEST { self.inside(&definition.body, depth + 1) } else { Vec::new() };
        Some(Symbol {
            name: name.text.to_string(),
            detail,
            kind,
            span: definition.span.to(name.span),
            name_span: name.span,
            children,
        })
    }

    /// The bindings of the `let` that an expression is, or that a function gives.
    fn inside(&self, expr: &Expr, depth: usize) -> Vec<Symbol> {
        let mut expr = expr;
        loop {
            match &expr.kind {
                ExprKind::Lambda { body, .. } => expr = body,
                ExprKind::Let { bindings, .. } => return self.all(bindings, depth),
                _ => return Vec::new(),
            }
        }
    }
}
