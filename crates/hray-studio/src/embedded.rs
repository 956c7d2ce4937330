//! What the program has in it: the page, and the examples.

use hray_session::example_of;
use hray_session::protocol::Example;

include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// A file of the page.
pub(crate) fn page(path: &str) -> Option<&'static [u8]> {
    PAGE.iter().find(|(name, _)| *name == path).map(|(_, bytes)| *bytes)
}

/// The examples that are scenes, with the addresses of those pictures that are part of the page.
#[must_use]
pub fn examples() -> Vec<Example> {
    let texts = EXAMPLES.iter().filter_map(|(path, bytes)| {
        let name = path.strip_suffix(".hry")?;
        Some((name, std::str::from_utf8(bytes).ok()?))
    });
    let scenes = texts.filter(|(_, text)| text.starts_with("renderDescr") || text.contains("\nscene"));
    let example = |(name, text): (&str, &str)| {
        let picture = format!("examples/{name}.jpg");
        let picture = page(&picture).is_some().then_some(picture);
        example_of(name, text, picture)
    };
    scenes.map(example).collect()
}
