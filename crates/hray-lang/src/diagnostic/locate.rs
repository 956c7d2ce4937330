//! Lines and columns of many places in one pass over the source.

/// Where a byte offset lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Location {
    /// The line, from 1.
    pub(crate) line: usize,
    /// The offset of the line's first character (a byte order mark is none).
    pub(crate) line_start: usize,
    /// The column in characters, from 1.
    pub(crate) column: usize,
}

/// The locations of a set of offsets.
pub(crate) struct Locations(Vec<(usize, Location)>);

impl Locations {
    /// Locates `offsets` (character boundaries inside the source) with one walk over the source, however
    /// many there are and however long its lines.
    pub(crate) fn new(source: &str, mut offsets: Vec<usize>) -> Self {
        offsets.sort_unstable();
        offsets.dedup();
        let mark = if source.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        let mut here = Location { line: 1, line_start: mark, column: 1 };
        let mut walked = mark;
        let mut table = Vec::with_capacity(offsets.len());
        for offset in offsets {
            here.pass(source.as_bytes().get(walked..offset).unwrap_or_default(), walked);
            walked = walked.max(offset);
            table.push((offset, here));
        }
        Self(table)
    }

    /// The location of an offset among those given to [`Locations::new`].
    pub(crate) fn get(&self, offset: usize) -> Location {
        let found = self.0.binary_search_by_key(&offset, |entry| entry.0);
        let start = Location { line: 1, line_start: 0, column: 1 };
        found.ok().and_then(|index| self.0.get(index)).map_or(start, |entry| entry.1)
    }
}

impl Location {
    /// Moves past `bytes`, the first of which is at `offset`.
    fn pass(&mut self, bytes: &[u8], offset: usize) {
        self.line += bytes.iter().filter(|byte| **byte == b'\n').count();
        let mut rest = bytes;
        if let Some(last) = bytes.iter().rposition(|byte| *byte == b'\n') {
            self.line_start = offset + last + 1;
            self.column = 1;
            rest = bytes.get(last + 1..).unwrap_or_default();
        }
        // Every character has one byte that does not continue another.
        self.column += rest.iter().filter(|byte| **byte & 0xC0 != 0x80).count();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_characters() {
        let source = "\u{feff}aé\r\nb\tc\n\nd";
        let offset = |text: &str| source.find(text).unwrap();
        let all: Vec<usize> = source.char_indices().map(|(i, _)| i).chain([source.len()]).collect();
        let locations = Locations::new(source, all);
        let place = |i| (locations.get(i).line, locations.get(i).column);
        assert_eq!(place(0), (1, 1));
        assert_eq!(place(offset("a")), (1, 1));
        assert_eq!(place(offset("é")), (1, 2));
        assert_eq!(place(offset("\r")), (1, 3));
        assert_eq!(place(offset("c")), (2, 3));
        assert_eq!(place(offset("d")), (4, 1));
        assert_eq!(place(source.len()), (4, 2));
        assert_eq!(locations.get(offset("c")).line_start, offset("b"));
    }
}
