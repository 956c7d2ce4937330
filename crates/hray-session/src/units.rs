//! Offsets in UTF-16, which is what editors in browsers count in, and in bytes.

use hray::Span;

/// Translates offsets of one text.
#[derive(Clone, Debug, Default)]
pub struct Units {
    /// After each character that is not ASCII: the offset in bytes, and in UTF-16.
    steps: Vec<[usize; 2]>,
    /// The length of the text in bytes.
    length: usize,
}

impl Units {
    /// For a text.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let (mut steps, mut gained) = (Vec::new(), 0);
        if !text.is_ascii() {
            for (at, c) in text.char_indices().filter(|(_, c)| !c.is_ascii()) {
                let end = at + c.len_utf8();
                gained += c.len_utf8() - c.len_utf16();
                steps.push([end, end - gained]);
            }
        }
        Self { steps, length: text.len() }
    }

    /// From bytes to UTF-16. What is beyond the end is the end.
    #[must_use]
    pub fn to_utf16(&self, byte: usize) -> usize {
        let byte = byte.min(self.length);
        let after = self.steps.partition_point(|step| step[0] <= byte);
        match after.checked_sub(1).and_then(|before| self.steps.get(before)) {
            Some([bytes, units]) => units + (byte - bytes),
            None => byte,
        }
    }

    /// From UTF-16 to bytes. What is beyond the end is the end; inside a character, its beginning.
    #[must_use]
    pub fn to_byte(&self, text: &str, unit: usize) -> usize {
        let after = self.steps.partition_point(|step| step[1] <= unit);
        let byte = match after.checked_sub(1).and_then(|before| self.steps.get(before)) {
            Some([bytes, units]) => bytes + (unit - units),
            None => unit,
        };
        text.floor_char_boundary(byte.min(self.length))
    }

    /// A span as `[from, to]` in UTF-16.
    #[must_use]
    pub fn span(&self, span: Span) -> [usize; 2] {
        [self.to_utf16(span.start), self.to_utf16(span.end.max(span.start))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_come_back() {
        for text in ["", "abc", "a\u{e9}b", "\u{1d11e}x\u{1d11e}", "\u{feff}\u{20ac}\r\n\u{e9}"] {
            let units = Units::new(text);
            let mut expected = 0;
            for (byte, c) in text.char_indices().chain([(text.len(), ' ')]) {
                assert_eq!(units.to_utf16(byte), expected, "{text:?} {byte}");
                assert_eq!(units.to_byte(text, expected), byte, "{text:?} {byte}");
                expected += c.len_utf16();
            }
            assert_eq!(units.to_byte(text, 99), text.len());
            assert_eq!(units.to_utf16(99), text.encode_utf16().count());
        }
        // In the middle of a surrogate pair.
        assert_eq!(Units::new("\u{1d11e}").to_byte("\u{1d11e}", 1), 0);
    }
}
