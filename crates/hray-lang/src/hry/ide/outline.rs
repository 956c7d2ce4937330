//! The library as files that can be read: what is written in hry as it is, and the rest as a list of signatures.

use super::analysis::{FileId, Place};
use super::describe;
use crate::diagnostic::Span;
use crate::hry::library::{CONSTRUCTORS, Makes, NATIVES, STANDARD};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::sync::OnceLock;

/// The name of the file that lists what is not written in hry.
pub const OUTLINE: &str = "builtin";

struct Outline {
    text: String,
    /// By the name of an entry and of its field. Only looked up.
    places: HashMap<(&'static str, Option<&'static str>), Span>,
}

/// The text of a file of the library.
#[must_use]
pub fn library_text(name: &str) -> Option<&'static str> {
    if name == OUTLINE {
        return Some(&outline().text);
    }
    STANDARD.iter().find(|module| module.name == name).map(|module| module.text)
}

/// Where an entry, or a field of it, is in the outline.
pub(super) fn outline_place(name: &str, field: Option<&str>) -> Option<Place> {
    let places = &outline().places;
    let found = places.iter().find(|((n, f), _)| *n == name && *f == field);
    found.map(|(_, span)| Place { file: FileId::Library(OUTLINE), span: *span })
}

fn outline() -> &'static Outline {
    static OUTLINE_TEXT: OnceLock<Outline> = OnceLock::new();
    OUTLINE_TEXT.get_or_init(|| {
        let mut text = String::from("-- What the language knows that is not written in hry itself.\n");
        let mut places = HashMap::new();
        let mut name = |text: &mut String, name: &'static str, field| {
            places.insert(field, Span::new(text.len(), text.len() + name.len()));
            text.push_str(name);
        };
        for constructor in CONSTRUCTORS.iter().filter(|constructor| constructor.makes != Makes::Scene) {
            let _ = write!(text, "\n{}", comment("--| ", constructor.doc));
            name(&mut text, constructor.name, (constructor.name, None));
            text.push_str(" :\n");
            for (index, field) in constructor.fields.iter().enumerate() {
                text.push_str(&comment(
                    "  -- ",
                    &describe::field_text(constructor, field).replace("\n\n", " "),
                ));
                text.push_str(if index == 0 { "  { " } else { "  , " });
                name(&mut text, field.name, (constructor.name, Some(field.name)));
                let _ = writeln!(text, " : {}", describe::field_type(field));
            }
            let _ = writeln!(text, "  }} -> {}", describe::made(constructor));
        }
        for native in NATIVES {
            let _ = write!(text, "\n{}", comment("--| ", native.doc));
            name(&mut text, native.name, (native.name, None));
            let _ = writeln!(text, " : {}", native.signature);
        }
        Outline { text, places }
    })
}

/// A text as lines of comment, each begun by `start`.
fn comment(start: &str, text: &str) -> String {
    const WIDTH: usize = 100;
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.len() + word.len() < WIDTH => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.iter().map(|line| format!("{start}{line}\n")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_is_at_its_place() {
        let place =
            |name, field| outline_place(name, field).map(|place| place.span.text(&outline().text).to_owned());
        assert_eq!(place("sphere", None).as_deref(), Some("sphere"));
        assert_eq!(place("sphere", Some("radius")).as_deref(), Some("radius"));
        assert_eq!(place("sin", None).as_deref(), Some("sin"));
        assert_eq!(place("nothing", None), None);
        assert!(library_text("prelude").is_some() && library_text("nothing").is_none());
    }
}
