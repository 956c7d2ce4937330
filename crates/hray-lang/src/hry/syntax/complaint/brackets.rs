//! Brackets without a partner.

use super::super::kind::SyntaxKind;
use crate::diagnostic::{Diagnostic, Span};

/// What comes after the place where a bracket has to be closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum After {
    Closing,
    Field,
    Definition,
}

/// A bracket that is not closed. It has to be before `next`, the token where reading goes on; `end` is the end of what is
/// before that.
pub(crate) fn unclosed(kind: SyntaxKind, open: Span, end: usize, next: Option<(After, Span)>) -> Diagnostic {
    let closing = kind.closing().spelling();
    let message = format!("this `{}` is not closed", kind.spelling());
    let error =
        Diagnostic::error("unclosed-bracket", message, open, format!("expected a `{closing}` for it"));
    let error = match next {
        Some((After::Closing, span)) => error.with_secondary(span, "this closes a bracket further out"),
        Some((After::Field, span)) => error.with_secondary(span, "this looks like the next field"),
        Some((After::Definition, span)) => error.with_secondary(span, "this looks like the next definition"),
        None => error,
    };
    let space = if kind == SyntaxKind::OpenBrace { " " } else { "" };
    error.with_suggestion(Span::at(end), format!("{space}{closing}"), format!("add `{closing}`"))
}

/// A closing bracket that closes nothing; `open` is the bracket that it does not fit.
pub(crate) fn stray(kind: SyntaxKind, span: Span, open: Option<(SyntaxKind, Span)>) -> Diagnostic {
    let message = format!("this `{}` closes nothing", kind.spelling());
    let error = Diagnostic::error("stray-bracket", message, span, "there is no bracket open for it");
    let error = match open {
        Some((open, place)) => {
            error.with_secondary(place, format!("this `{}` is open here, and closed later", open.spelling()))
        }
        None => error,
    };
    error.with_suggestion(span, "", "remove it")
}

/// A closing bracket of the wrong kind.
pub(crate) fn wrong(kind: SyntaxKind, span: Span, opener: SyntaxKind, open: Span) -> Diagnostic {
    let (closing, opening) = (opener.closing().spelling(), opener.spelling());
    let message = format!("`{opening}` is closed by `{closing}`, not by `{}`", kind.spelling());
    let error = Diagnostic::error("wrong-bracket", message, span, format!("expected `{closing}`"));
    error.with_secondary(open, "opened here").with_suggestion(span, closing, format!("write `{closing}`"))
}
