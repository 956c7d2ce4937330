//! PLY as text: numbers, with white space between them.

use super::super::polygons::Polygons;
use super::super::problem::{Outcome, Problem};
use super::super::words::{Word, Words, float, whole};
use super::header::{Element, Encoding, Header, Property};
use super::{COMPONENTS, Layout, Use, add, note_unused, use_of};

pub(super) fn read(bytes: &[u8], header: &Header, notes: &mut Vec<String>) -> Outcome<Polygons> {
    let mut words = Words::new(bytes, header.body, header.line);
    let mut polygons = Polygons::default();
    let vertices = header.element(b"vertex").map_or(0, |element| element.count);
    for element in header.elements.iter().filter(|element| !element.properties.is_empty()) {
        check_count(element, &words)?;
        match use_of(element) {
            (Use::Vertices, _) => read_vertices(element, &mut words, &mut polygons)?,
            (Use::Nothing, _) => {
                note_unused(element, notes);
                for _ in 0..element.count {
                    for property in &element.properties {
                        skip(property, element, &mut words)?;
                    }
                }
            }
            (of, list) => read_faces(element, of, list, vertices, &mut words, &mut polygons)?,
        }
    }
    if let Some(word) = words.next() {
        notes.push(format!(
            "line {}: {} comes after the last of what the header announces; the rest is not read",
            words.line(),
            Word(word)
        ));
    }
    Ok(polygons)
}

/// Each value takes a byte, and one before it.
fn check_count(element: &Element, words: &Words<'_>) -> Outcome<()> {
    let least = 2 * element.least_bytes(Encoding::Ascii) as u64;
    if element.count.saturating_mul(least) > words.left() as u64 + 1 {
        let name = String::from_utf8_lossy(&element.name);
        let what = format!(
            "the header says that {} of `{name}` follow, but the file has only {} bytes more",
            element.count,
            words.left()
        );
        return Err(Problem::line(words.line(), what));
    }
    Ok(())
}

fn read_vertices(element: &Element, words: &mut Words<'_>, polygons: &mut Polygons) -> Outcome<()> {
    let layout = Layout::of(element);
    if !layout.has_positions() {
        return Err(Problem::line(words.line(), "the vertices have no properties x, y and z"));
    }
    layout.reserve(element.count as usize, polygons);
    for _ in 0..element.count {
        let mut vertex = [0.0; COMPONENTS];
        for (property, place) in element.properties.iter().zip(&layout.places) {
            let Some(place) = *place else {
                skip(property, element, words)?;
                continue;
            };
            let name = || format!("the {} of a vertex", String::from_utf8_lossy(&property.name));
            let word = match words.next() {
                Some(word) => word,
                None => words.expect(&name())?,
            };
            let value = match float(word, "a number of a vertex", words.line()) {
                Ok(value) => value,
                Err(_) => float(word, &name(), words.line())?,
            };
            if let Some(slot) = vertex.get_mut(place) {
                *slot = layout.component(place, property.kind, f64::from(value));
            }
        }
        layout.push(&vertex, polygons);
    }
    Ok(())
}

fn read_faces(
    element: &Element,
    of: Use,
    list: Option<usize>,
    vertices: u64,
    words: &mut Words<'_>,
    polygons: &mut Polygons,
) -> Outcome<()> {
    let (mut corners, mut scratch) = (Vec::new(), Vec::new());
    for _ in 0..element.count {
        for (place, property) in element.properties.iter().enumerate() {
            if Some(place) != list {
                skip(property, element, words)?;
                continue;
            }
            corners.clear();
            for _ in 0..length(words)? {
                let word = words.expect("a corner of a face")?;
                corners.push(whole(word, "a corner of a face", words.line())?);
            }
            add(of, &corners, vertices, &mut scratch, polygons)
                .map_err(|what| Problem::line(words.line(), format!("of this face, {what}")))?;
        }
    }
    Ok(())
}

fn length(words: &mut Words<'_>) -> Outcome<u64> {
    let word = words.expect("the length of a list")?;
    let length = whole(word, "the length of a list", words.line())?;
    u64::try_from(length)
        .map_err(|_| Problem::line(words.line(), format!("the length of a list cannot be {length}")))
}

fn skip(property: &Property, element: &Element, words: &mut Words<'_>) -> Outcome<()> {
    let count = if property.length.is_some() { length(words)? } else { 1 };
    for _ in 0..count {
        if words.next().is_none() {
            let name = String::from_utf8_lossy(&property.name);
            words.expect(&format!("`{name}` of `{}`", String::from_utf8_lossy(&element.name)))?;
        }
    }
    Ok(())
}
