//! The page, which is part of the program.

include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// A file of the page.
pub(crate) fn page(path: &str) -> Option<&'static [u8]> {
    PAGE.iter().find(|(name, _)| *name == path).map(|(_, bytes)| *bytes)
}
