//! Imports.

use super::super::kind::SyntaxKind;
use super::super::parser::Parser;
use crate::diagnostic::{Diagnostic, Span};

impl Parser<'_> {
    /// No text follows `import`.
    pub(in super::super) fn no_path(&self) -> Diagnostic {
        let here = self.here();
        let error = Diagnostic::error(
            "import",
            format!("expected the path of a file, found {}", self.found()),
            here,
            "expected a text",
        );
        match self.current {
            SyntaxKind::Name | SyntaxKind::TypeName => {
                let mut last = self.at;
                while self.tokens.get(last + 1).is_some_and(|next| !next.spaced) {
                    last += 1;
                }
                let span = Span::new(here.start, self.span_of(last).end);
                let path = self.slice(span).unwrap_or("");
                let end = if path.contains(['.', '/']) { "" } else { ".hry" };
                error.with_suggestion(span, format!("\"{path}{end}\""), "put the path in quotes")
            }
            _ => error.with_help("write `import \"palette.hry\" (gold, ink)`"),
        }
    }

    pub(in super::super) fn no_import_name(&self) -> Diagnostic {
        let message = format!("expected a name, found {}", self.found());
        let error =
            Diagnostic::error("import", message, self.here(), "expected the name of a definition to import");
        error.with_help("write `import \"palette.hry\" (gold, ink)` or `import \"palette.hry\" as palette`")
    }

    pub(in super::super) fn after_import(&self) -> Diagnostic {
        let here = self.here();
        let message = format!("{} cannot follow an import", self.found());
        let error = Diagnostic::error("import", message, here, "expected the end of the line");
        match self.current {
            SyntaxKind::Name => {
                let mut last = self.at;
                while matches!(self.kind_of(last + 1), SyntaxKind::Name | SyntaxKind::Comma)
                    && self.tokens.get(last + 1).is_some_and(|next| !next.starts_line)
                {
                    last += 1;
                }
                let span = Span::new(here.start, self.span_of(last).end);
                let names = self.slice(span).unwrap_or("");
                error.with_suggestion(span, format!("({names})"), "put the names in parentheses")
            }
            SyntaxKind::Semicolon => error.with_suggestion(here, "", "remove it"),
            _ => error.with_help(
                "an import is `import \"a.hry\"`, `import \"a.hry\" (b, c)` or `import \"a.hry\" as a`",
            ),
        }
    }
}
