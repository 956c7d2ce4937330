//! Imports, annotations, definitions and `let`.

use super::super::kind::SyntaxKind;
use super::super::parser::{Parser, Promise};
use super::quoted;
use crate::diagnostic::Diagnostic;

impl Parser<'_> {
    /// An annotation has to be followed by its definition, which begins with token `next`.
    pub(in super::super) fn kept_promise(&mut self, promise: &mut Option<Promise>, next: Option<usize>) {
        let Some(promised) = promise.take() else { return };
        let name = self.text_of(promised.name());
        if next.is_some_and(|next| self.text_of(next) == name) {
            return;
        }
        let message = format!("the type of {} is given, but no definition follows", quoted(name));
        let label = format!("expected `{name} = ...` directly below this");
        let error = Diagnostic::error("missing-definition", message, self.span_of(promised.name()), label);
        self.report(error);
    }

    pub(in super::super) fn no_path(&self) -> Diagnostic {
        let message = format!("expected the path of a file, found {}", self.found());
        let error = Diagnostic::error("import", message, self.here(), "expected a text");
        error.with_help("write `import \"palette.hry\"`")
    }

    pub(in super::super) fn no_import_name(&self) -> Diagnostic {
        let message = format!("expected a name to import, found {}", self.found());
        Diagnostic::error("import", message, self.here(), "expected a name")
    }

    pub(in super::super) fn after_import(&self) -> Diagnostic {
        let message = format!("the import is over, but {} follows", self.found());
        let error = Diagnostic::error("import", message, self.here(), "not expected here");
        error.with_help(
            "an import is `import \"a.hry\"`, `import \"a.hry\" (b, c)` or `import \"a.hry\" as a`",
        )
    }

    pub(in super::super) fn after_annotation(&self, first: usize) -> Diagnostic {
        let message =
            format!("the type of {} is over, but {} follows", quoted(self.text_of(first)), self.found());
        Diagnostic::error("annotation", message, self.here(), "not expected in a type")
    }

    pub(in super::super) fn check_target(&mut self, first: usize) {
        if self.kind_of(first) != SyntaxKind::Name {
            let message = "a definition begins with a name";
            let error = Diagnostic::error("definition", message, self.span_of(first), "expected a name");
            self.report(error);
        }
    }

    pub(in super::super) fn no_define(&self, first: usize) -> Diagnostic {
        let message = format!("expected `=`, found {}", self.found());
        let label = format!("{} needs `=` and a value", quoted(self.text_of(first)));
        Diagnostic::error("missing-equals", message, self.here(), label)
    }

    pub(in super::super) fn after_body(&self, first: usize, is_top: bool) -> Diagnostic {
        let _ = is_top;
        let name = quoted(self.text_of(first));
        let message = format!("the definition of {name} is over, but {} follows", self.found());
        Diagnostic::error("unexpected", message, self.here(), "not expected here")
    }

    pub(in super::super) fn no_in(&self, first: usize) -> Diagnostic {
        let message = format!("this `let` has no `in`, found {}", self.found());
        let error = Diagnostic::error("missing-in", message, self.here(), "expected `in` and a value");
        error.with_secondary(self.span_of(first), "the `let`")
    }

    pub(in super::super) fn no_binding(&self) -> Diagnostic {
        let message = format!("a `let` needs a definition, found {}", self.found());
        Diagnostic::error("missing-binding", message, self.here(), "expected `name = value`")
    }

    /// What some write between bindings.
    pub(in super::super) fn between_bindings(&mut self) {}

    pub(in super::super) fn no_definition(&mut self) {
        self.fail(|parser| {
            let message = format!("expected a definition, found {}", parser.found());
            Diagnostic::error("definition", message, parser.here(), "expected `name = value`")
        });
    }
}
