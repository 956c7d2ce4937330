//! Where the parts of an accepted scene stand.

use super::cursor::Cursor;
use super::token::Token;
use crate::diagnostic::Span;

/// Where the parts of a scene stand in its source, as remarks about an accepted scene need it.
///
/// Of a primitive or light only the whole is kept, so that a scene of a million objects stays small; the
/// parts are found by another look at the source.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Spans {
    /// The pair of numbers that is the resolution.
    pub resolution: Span,
    /// The recursion depth.
    pub depth: Span,
    /// The camera section.
    pub camera: Span,
    /// The background section.
    pub background: Span,
    /// The start of the objects section, up to its word.
    pub objects: Span,
    /// The start of the lights section, up to its word.
    pub lights: Span,
    /// Each primitive, from its first to its last bracket.
    pub primitives: Vec<Span>,
    /// Each light, from its first to its last bracket.
    pub light_list: Vec<Span>,
}

impl Spans {
    /// The numbers from `first` on, `count` of them (counted from 0 within `element`, integers and reals
    /// alike), from the first to the last.
    #[must_use]
    pub fn numbers(source: &str, element: Span, first: usize, count: usize) -> Span {
        let mut cursor = Cursor::within(source, element);
        let mut index = 0;
        let mut found: Option<Span> = None;
        while index < first + count {
            let lexeme = cursor.bump();
            match lexeme.token {
                Token::End => break,
                Token::Integer | Token::Real => {
                    if index >= first {
                        found = Some(found.map_or(lexeme.span, |span| span.to(lexeme.span)));
                    }
                    index += 1;
                }
                _ => {}
            }
        }
        found.unwrap_or(element)
    }

    /// The shape of a primitive: `sphere 40.0 (0.0,0.0,-150.0)`.
    #[must_use]
    pub fn shape(source: &str, primitive: Span) -> Span {
        let mut cursor = Cursor::within(source, primitive);
        // "(object (" comes before it, and it ends with the first closing bracket: that of its point or plane.
        for _ in 0..3 {
            cursor.bump();
        }
        let word = cursor.bump().span;
        while !matches!(cursor.now().token, Token::End | Token::Close(_)) {
            cursor.bump();
        }
        word.to(cursor.bump().span)
    }
}
