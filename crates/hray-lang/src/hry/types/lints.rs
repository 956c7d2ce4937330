//! Warnings about what is legal but was surely meant otherwise.

use crate::diagnostic::{Diagnostic, Span};
use crate::lint::Lint;

const fn lint(code: &'static str, explanation: &'static str) -> Lint {
    Lint { code, explanation }
}

/// The warnings that this pass gives.
pub const LINTS: &[Lint] = &[
    lint(
        "angle-unit",
        "An angle of more than a turn stands there without `deg`: angles are in radians, and 30 degrees are `30deg`.",
    ),
    lint(
        "color-scale",
        "The components of `rgb` are written as bytes from 0 to 255: they are linear light, where 1 is white.",
    ),
    lint(
        "constant-condition",
        "The condition of an `if` is written as `true` or `false`, so one branch is never used.",
    ),
    lint(
        "division-by-zero",
        "A division by a zero that stands there as a number: the result is not a number.",
    ),
    lint("negative-light", "A light or a share of a colour is negative: it takes light away."),
    lint("shadowing", "A name inside a definition hides one of the file, or one further out."),
    lint(
        "share-range",
        "A number outside 0 to 1 for something that is a share, such as `reflection`: more light leaves a surface than \
         falls on it.",
    ),
    lint("unreachable-arm", "A case of a `match` comes after one that takes everything."),
    lint(
        "unused-definition",
        "A definition that the scene does not need. Names that start with `_` are never unused.",
    ),
    lint("unused-import", "An import of which nothing is used."),
    lint(
        "unused-local",
        "A name bound by `let` that nothing uses. Names that start with `_` are never unused.",
    ),
];

/// A name inside a definition hides another.
pub(super) fn shadowing(name: &str, span: Span, first: Span, is_local: bool) -> Diagnostic {
    let what = if is_local { "another name further out" } else { "a definition of this file" };
    Diagnostic::warning("shadowing", format!("`{name}` hides {what}"), span, "inside, this one is meant")
        .with_secondary(first, "this one is hidden")
        .with_help("give one of them another name")
}
