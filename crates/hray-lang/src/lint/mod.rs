//! Warnings about what is legal but was surely meant otherwise.
//!
//! Every lint has a code; [`LINTS`] lists them all. They look at an accepted scene, and only at its values:
//! a sensible scene gives none. Each can be allowed or denied by its code ([`LintLevels`]).
//!
//! Time is linear in the number of objects: the lints that compare objects compare each with a bounded
//! number of candidates ([`MOST_CANDIDATES`]), so of a huge scene they may miss something.

mod hidden;
mod levels;
mod picture;
mod sink;
mod surface;

pub use hidden::MOST_CANDIDATES;
pub use levels::{ALL_LINTS, Level, LintLevels, UnknownLint};
pub use sink::MOST_PER_LINT;

use crate::classic::Spans;
use crate::diagnostic::Diagnostic;
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

/// All lints.
pub const LINTS: &[Lint] = &[
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_sorted_distinct_and_in_kebab_case() {
        assert!(LINTS.is_sorted_by(|a, b| a.code < b.code));
        let kebab = |c: char| c.is_ascii_lowercase() || c == '-';
        assert!(LINTS.iter().all(|lint| lint.code.chars().all(kebab) && lint.code != ALL_LINTS));
    }
}
