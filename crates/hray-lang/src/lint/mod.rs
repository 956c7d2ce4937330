//! Warnings about what is legal but was surely meant otherwise.
//!
//! Every lint has a code; [`LINTS`] lists them all. Those of classic scenes are found here ([`check`]): they look at an
//! accepted scene, and only at its values. Those of hry scenes are found where these are checked and evaluated. A
//! sensible scene gives none. Each can be allowed or denied by its code ([`LintLevels`]).
//!
//! Time is linear in the number of objects: the lints that compare objects compare each with a bounded
//! number of candidates ([`MOST_CANDIDATES`]), so of a huge scene they may miss something.

pub(crate) mod coincident;
mod hidden;
mod levels;
mod picture;
mod sink;
mod surface;

pub use hidden::MOST_CANDIDATES;
pub use levels::{ALL_LINTS, Level, LintLevels, UnknownLint};
pub use sink::MOST_PER_LINT;

use crate::classic::Spans;
use crate::diagnostic::{Diagnostic, Severity};
use hray_core::Description;

/// A lint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lint {
    /// Its name, as diagnostics show it and as it is allowed or denied by.
    pub code: &'static str,
    /// What it warns of, and why.
    pub explanation: &'static str,
}

const fn lint(code: &'static str, explanation: &'static str) -> Lint {
    Lint { code, explanation }
}

/// All lints: those of classic scenes, then those of hry.
pub const LINTS: &[Lint] = &all::<{ CLASSIC_LINTS.len() + TYPES.len() + VALUES.len() }>();

/// The lints of what the checker of hry finds in a text.
const TYPES: &[Lint] = crate::hry::types::LINTS;

/// The lints of what evaluation finds in values.
const VALUES: &[Lint] = &[
    lint(
        "unusual-value",
        "A field has a value that is worked out, and lies outside of what makes sense for it, such as a reflection above 1.",
    ),
    lint(
        "camera-inside-sphere",
        "The camera is inside a sphere that lets no light through, and no light is in there: the picture is dark.",
    ),
    lint(
        "no-surface",
        "The function of an implicit surface is 0 nowhere in its box, so there is nothing to see.",
    ),
    lint(
        "unbounded-function",
        "The function of an implicit surface may be 0 and infinite in one place, however small: its surface may have flaws there.",
    ),
    lint(
        "coincident-surfaces",
        "Two surfaces lie in each other, so that rounding decides which of them is seen, or whether a skin is left where one \
         solid is cut out of another: in pictures that looks like speckles.",
    ),
    lint("no-objects", "The scene has no objects, so only the background is seen."),
    lint(
        "not-read",
        "A file of meshes has something that is not taken over, such as images, or names a file that is not there.",
    ),
];

const fn all<const N: usize>() -> [Lint; N] {
    let mut all = [lint("", ""); N];
    let tables = [CLASSIC_LINTS, TYPES, VALUES];
    let (mut table, mut place) = (0, 0);
    while table < tables.len() {
        let mut i = 0;
        while i < tables[table].len() {
            all[place] = tables[table][i];
            (i, place) = (i + 1, place + 1);
        }
        table += 1;
    }
    all
}

/// The lints of hry scenes, by the parts of the language that find them.
#[must_use]
pub fn hry_lints() -> &'static [Lint] {
    LINTS.get(CLASSIC_LINTS.len()..).unwrap_or_default()
}

/// The lints of classic scenes.
pub const CLASSIC_LINTS: &[Lint] = &[
    lint("black-picture", "A recursion depth of -1 traces no ray at all: the picture is black."),
    lint(
        "component-range",
        "A component of a colour or light, a reflection or a transparency coefficient lies outside 0 to 1, so \
         that sums overflow what a picture can show.",
    ),
    lint(
        "duplicate-object",
        "An object has exactly the shape of a later one. Of two objects hit at the same distance the later is \
         seen, so the earlier never is.",
    ),
    lint(
        "eye-in-window",
        "The eye lies in the plane of the window (z = 0), so all rays run along that plane instead of through \
         it.",
    ),
    lint(
        "light-inside-sphere",
        "A point light lies inside a sphere. Transparent objects cast shadows like all others, so the light \
         reaches nothing outside that sphere.",
    ),
    lint(
        "many-octaves",
        "More than 30 octaves of noise: each is half as strong as the one before, so the last of them change no \
         pixel, but all cost time. (From 1024 on the sum is not a number, and the surface white.)",
    ),
    lint(
        "negative-shine",
        "A negative highlight exponent: the highlight is strongest where it should be none.",
    ),
    lint("no-lights", "There are objects but no lights: every surface is black."),
    lint("noise-grid", "A noise grid of 0: the position is divided by it."),
    lint(
        "object-behind-plane",
        "A sphere lies wholly behind an opaque plane, seen from the window, and no light is there: it cannot \
         be seen and casts no shadow that can.",
    ),
    lint(
        "object-inside-object",
        "A sphere lies wholly inside an opaque sphere that the window is outside of: it cannot be seen.",
    ),
    lint(
        "pixel-aspect",
        "The window and the resolution have different proportions, so that pixels are not square and spheres \
         look like eggs.",
    ),
    lint("plane-normal", "A plane with a normal (a, b, c) of length 0, or nearly so, is hit by no ray."),
    lint(
        "refraction-index",
        "A material lets light through, but its refraction index is 0 or negative. 1 does not bend the light, \
         water has about 1.33, glass 1.5.",
    ),
    lint("sphere-radius", "A sphere has the radius 0, or a negative one, which turns its normals inward."),
    lint("window-size", "A side of the camera's window is 0, or negative, which mirrors the picture."),
];

/// The findings about a description that was read from `source`, in the order of the source.
///
/// Lints at [`Level::Deny`] give errors; where there is one, the description is not to be rendered.
#[must_use]
pub fn check(source: &str, description: &Description, spans: &Spans, levels: &LintLevels) -> Vec<Diagnostic> {
    let mut sink = sink::Sink::new(source, levels);
    picture::check(&mut sink, description, spans);
    surface::check(&mut sink, &description.scene, spans);
    hidden::check(&mut sink, &description.scene, spans);
    sink.finish()
}

/// Gives the warnings among the findings about an hry scene their levels: those at [`Level::Allow`] go, those at
/// [`Level::Deny`] become errors.
pub fn apply(levels: &LintLevels, diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.retain_mut(|diagnostic| {
        if diagnostic.is_error() || !LINTS.iter().any(|lint| lint.code == diagnostic.code) {
            return true;
        }
        let level = levels.get(diagnostic.code);
        if level == Level::Deny {
            diagnostic.severity = Severity::Error;
        }
        level != Level::Allow
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_sorted_distinct_and_in_kebab_case() {
        assert!(CLASSIC_LINTS.is_sorted_by(|a, b| a.code < b.code));
        let mut codes: Vec<_> = LINTS.iter().map(|lint| lint.code).collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), LINTS.len());
        let kebab = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(LINTS.iter().all(|lint| lint.code.chars().all(kebab) && lint.code != ALL_LINTS));
    }
}
