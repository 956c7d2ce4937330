//! The part of the library that is written in hry.

/// A file of the standard library.
#[derive(Debug)]
pub struct StandardModule {
    /// Its name: the heading of the reference.
    pub name: &'static str,
    /// Its text.
    pub text: &'static str,
}

/// All of them. Their definitions are in scope everywhere.
pub const STANDARD: &[StandardModule] = &[
    StandardModule { name: "prelude", text: include_str!("../../../std/prelude.hry") },
    StandardModule { name: "colours", text: include_str!("../../../std/colours.hry") },
    StandardModule { name: "patterns", text: include_str!("../../../std/patterns.hry") },
    StandardModule { name: "noise", text: include_str!("../../../std/noise.hry") },
    StandardModule { name: "surfaces", text: include_str!("../../../std/surfaces.hry") },
    StandardModule { name: "classic", text: include_str!("../../../std/classic.hry") },
];
