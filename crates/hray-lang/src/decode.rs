//! From the bytes of a file to text.

use crate::diagnostic::{Diagnostic, Span};
use std::borrow::Cow;

/// How many bytes after a wrong one are kept, to show where it stands.
const KEPT_AFTER: usize = 100;

/// The text of a scene file, and what is wrong with its encoding.
#[derive(Clone, Debug)]
pub struct Decoded<'a> {
    /// The text; where the bytes are not UTF-8, the part up to the first wrong byte and a little more, with
    /// replacement characters, good for showing the place and nothing else.
    pub text: Cow<'a, str>,
    /// The error, where the bytes are not UTF-8.
    pub error: Option<Diagnostic>,
}

/// Reads bytes as UTF-8, the only encoding of scene files.
#[must_use]
pub fn decode(bytes: &[u8]) -> Decoded<'_> {
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return Decoded { text: Cow::Borrowed(text), error: None },
        Err(error) => error,
    };
    let offset = error.valid_up_to();
    let (valid, rest) = bytes.split_at(offset);
    let mut text = String::from_utf8_lossy(valid).into_owned();
    let line_end = rest.iter().take(KEPT_AFTER).position(|byte| *byte == b'\n');
    let shown = rest.get(..line_end.unwrap_or(KEPT_AFTER.min(rest.len()))).unwrap_or_default();
    text.push_str(&String::from_utf8_lossy(shown));
    let span = Span::new(offset, text.ceil_char_boundary(offset + 1));
    Decoded { error: Some(explain(bytes, offset, span)), text: Cow::Owned(text) }
}

fn explain(bytes: &[u8], offset: usize, span: Span) -> Diagnostic {
    let line = 1 + bytes.iter().take(offset).filter(|byte| **byte == b'\n').count();
    let byte = bytes.get(offset).copied().unwrap_or_default();
    let message =
        format!("the file is not UTF-8 text: wrong byte {byte:#04x} in line {line}, at byte offset {offset}");
    let error = Diagnostic::error("not-utf8", message, span, "the first byte that is not UTF-8");
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        return error.with_help("this looks like UTF-16; save the file as UTF-8");
    }
    if bytes.iter().take(1000).any(|byte| *byte == 0) {
        return error
            .with_help("this is no text file; a scene is a text file in UTF-8 (plain ASCII is fine)");
    }
    error.with_help("save the file as UTF-8 (plain ASCII is fine)")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf8_is_passed_on_and_anything_else_is_one_error_with_its_place() {
        assert!(decode("é(".as_bytes()).error.is_none());
        let decoded = decode(b"one\ntwo \xE9 three\nfour");
        let error = decoded.error.unwrap();
        assert!(error.message.contains("0xe9 in line 2, at byte offset 8"), "{}", error.message);
        assert_eq!(decoded.text, "one\ntwo \u{fffd} three");
        assert_eq!(error.primary.span.text(&decoded.text), "\u{fffd}");
    }

    #[test]
    fn a_cut_off_character_and_utf16_are_named() {
        assert!(decode(b"ab\xC3").error.unwrap().message.contains("offset 2"));
        assert!(decode(b"\xFF\xFEr\0e\0").error.unwrap().help.unwrap().contains("UTF-16"));
    }
}
