//! Stereolithography (3D Systems, 1989): triangles, as text or as binary numbers. Corners in equal places become one
//! vertex. Normals are left out: there is one to a triangle, and it follows from the corners.

use super::polygons::{Polygons, too_many};
use super::problem::{Outcome, Problem};
use super::words::{Word, Words, float};
use hray_core::Mesh;
use std::collections::HashMap;

/// A text, which has no meaning, and the number of triangles.
const HEADER: usize = 84;
/// A normal, three corners and two bytes.
const TRIANGLE: usize = 50;

pub(super) fn read(bytes: &[u8], notes: &mut Vec<String>) -> Outcome<Mesh> {
    let mut solid = Solid::default();
    if is_text(bytes) {
        text(bytes, &mut solid)?
    } else {
        binary(bytes, &mut solid, notes)?
    }
    solid.polygons.mesh()
}

/// Binary files may start with `solid`, too.
fn is_text(bytes: &[u8]) -> bool {
    let fits =
        count(bytes).is_some_and(|count| bytes.len() as u64 == HEADER as u64 + TRIANGLE as u64 * count);
    let start = bytes.trim_ascii_start();
    !fits && start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

fn count(bytes: &[u8]) -> Option<u64> {
    bytes.get(HEADER - 4..)?.first_chunk().map(|count| u32::from_le_bytes(*count).into())
}

/// Triangles with the vertices they share. The table is only looked up.
#[derive(Default)]
struct Solid {
    polygons: Polygons,
    known: HashMap<[u32; 3], u32>,
}

impl Solid {
    fn vertex(&mut self, position: [f32; 3]) -> u32 {
        // 0 and -0 are one place.
        let key = position.map(|x| (x + 0.0).to_bits());
        let positions = &mut self.polygons.positions;
        *self.known.entry(key).or_insert_with(|| {
            positions.push(position);
            // There are less than 2^29 corners.
            (positions.len() - 1) as u32
        })
    }
}

fn binary(bytes: &[u8], solid: &mut Solid, notes: &mut Vec<String>) -> Outcome<()> {
    let Some(count) = count(bytes) else {
        let what = format!(
            "an STL file starts with `solid`, or has {HEADER} bytes or more; this has {}",
            bytes.len()
        );
        return Err(Problem::byte(bytes.len(), what));
    };
    let body = bytes.get(HEADER..).unwrap_or_default();
    if count.saturating_mul(TRIANGLE as u64) > body.len() as u64 {
        let what = format!(
            "the header says that {count} triangles of {TRIANGLE} bytes follow, but the file has only {} bytes more",
            body.len()
        );
        return Err(Problem::byte(HEADER - 4, what));
    }
    let count = count as usize;
    if count > Mesh::MOST_TRIANGLES {
        return Err(Problem::byte(HEADER - 4, too_many()));
    }
    solid.polygons.triangles.reserve(count);
    for triangle in body.chunks_exact(TRIANGLE).take(count) {
        let mut floats =
            triangle.chunks_exact(4).map(|x| x.first_chunk().map_or(0.0, |x| f32::from_le_bytes(*x))).skip(3);
        let mut float = || floats.next().unwrap_or(0.0);
        let corners = [[float(), float(), float()], [float(), float(), float()], [float(), float(), float()]];
        let corners = corners.map(|position| solid.vertex(position));
        solid.polygons.triangles.push(corners);
    }
    let left = body.len() - count * TRIANGLE;
    if left > 0 {
        notes.push(format!(
            "{left} bytes come after the triangles that the header announces; they are not read"
        ));
    }
    Ok(())
}

fn text(bytes: &[u8], solid: &mut Solid) -> Outcome<()> {
    let mut words = Words::new(bytes, 0, 1);
    let mut corners: Vec<u32> = Vec::new();
    let is = |word: &[u8], name: &str| word.eq_ignore_ascii_case(name.as_bytes());
    // Solids; what is in them.
    while let Some(word) = words.next() {
        if !is(word, "solid") {
            let what = format!("a solid starts with `solid`, and this is {}", Word(word));
            return Err(Problem::line(words.line(), what));
        }
        words.skip_line();
        loop {
            let word = words.expect("`facet` or `endsolid`")?;
            if is(word, "endsolid") {
                words.skip_line();
                break;
            }
            if !is(word, "facet") {
                let what = format!("`facet` or `endsolid` should be here, and this is {}", Word(word));
                return Err(Problem::line(words.line(), what));
            }
            // The normal, whatever it is.
            words.skip_line();
            for wanted in ["outer", "loop"] {
                let word = words.expect(&format!("`{wanted}`"))?;
                if !is(word, wanted) {
                    let what = format!("`outer loop` should be here, and this is {}", Word(word));
                    return Err(Problem::line(words.line(), what));
                }
            }
            corners.clear();
            loop {
                let word = words.expect("`vertex` or `endloop`")?;
                if is(word, "endloop") {
                    break;
                }
                if !is(word, "vertex") {
                    let what = format!("`vertex` or `endloop` should be here, and this is {}", Word(word));
                    return Err(Problem::line(words.line(), what));
                }
                let mut position = [0.0; 3];
                for (slot, name) in position.iter_mut().zip(["x", "y", "z"]) {
                    let word = words.expect("a coordinate")?;
                    *slot = float(word, name, words.line())?;
                }
                corners.push(solid.vertex(position));
            }
            let word = words.expect("`endfacet`")?;
            if !is(word, "endfacet") {
                let what = format!("`endfacet` should be here, and this is {}", Word(word));
                return Err(Problem::line(words.line(), what));
            }
            solid.polygons.polygon(&corners);
            if solid.polygons.is_full() {
                return Err(Problem::line(words.line(), too_many()));
            }
        }
    }
    Ok(())
}
