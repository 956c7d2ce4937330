//! The header of a PLY file: what follows it, and how.

use super::super::problem::{Outcome, Problem};
use super::super::words::{Word, whole};

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// What kind of number something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn of(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    pub(super) const fn is_float(self) -> bool {
        matches!(self, Self::F32 | Self::F64)
    }
}

/// A property of the things of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: Vec<u8>,
    /// Of a list, the kind of its length.
    pub(super) length: Option<Scalar>,
    pub(super) kind: Scalar,
}

/// Things of one kind, such as all vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    /// How many there are said to be.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

impl Element {
    /// The fewest bytes that one of them takes.
    pub(super) fn least_bytes(&self, encoding: Encoding) -> usize {
        self.properties
            .iter()
            .map(|property| match encoding {
                // A digit and a space; the last of a file may do without.
                Encoding::Ascii => 1,
                _ => property.length.unwrap_or(property.kind).size(),
            })
            .sum()
    }

    /// The bytes that each of them takes in a binary file, where that is always the same.
    pub(super) fn stride(&self) -> Option<usize> {
        self.properties.iter().map(|p| p.length.is_none().then(|| p.kind.size())).sum()
    }
}

/// What a header says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the body starts, in bytes, and on which line.
    pub(super) body: usize,
    pub(super) line: usize,
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Outcome<Self> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let (mut at, mut line) = (0, 0);
        loop {
            let rest = bytes.get(at..).unwrap_or_default();
            let end = rest.iter().position(|byte| *byte == b'\n');
            let text = rest.get(..end.unwrap_or(rest.len())).unwrap_or_default();
            line += 1;
            let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            let first = words.next();
            if line == 1 && first != Some(b"ply") {
                return Err(Problem::line(1, "a PLY file starts with a line `ply`"));
            }
            let Some(end) = end else {
                return Err(Problem::line(line, "the file ends before `end_header`"));
            };
            at += end + 1;
            match first {
                None | Some(b"comment" | b"obj_info") => {}
                Some(b"ply") if line == 1 => {}
                Some(b"format") => encoding = Some(format(words.next(), line)?),
                Some(b"element") => elements.push(element(words.next(), words.next(), line)?),
                Some(b"property") => {
                    let words: Vec<&[u8]> = words.collect();
                    let element = elements
                        .last_mut()
                        .ok_or_else(|| Problem::line(line, "a property comes before any element"))?;
                    element.properties.push(property(&words, line)?);
                }
                Some(b"end_header") => {
                    let missing =
                        || Problem::line(line, "the header has no line `format`, such as `format ascii 1.0`");
                    let encoding = encoding.ok_or_else(missing)?;
                    return Ok(Self { encoding, elements, body: at, line: line + 1 });
                }
                Some(word) => {
                    let what = format!(
                        "a header has lines `format`, `comment`, `element`, `property` and `end_header`, and this \
                         starts with {}",
                        Word(word)
                    );
                    return Err(Problem::line(line, what));
                }
            }
        }
    }

    /// The element of that name.
    pub(super) fn element(&self, name: &[u8]) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

fn format(word: Option<&[u8]>, line: usize) -> Outcome<Encoding> {
    match word {
        Some(b"ascii") => Ok(Encoding::Ascii),
        Some(b"binary_little_endian") => Ok(Encoding::LittleEndian),
        Some(b"binary_big_endian") => Ok(Encoding::BigEndian),
        other => Err(Problem::line(
            line,
            format!(
                "the format is `ascii`, `binary_little_endian` or `binary_big_endian`, and not {}",
                Word(other.unwrap_or_default())
            ),
        )),
    }
}

fn element(name: Option<&[u8]>, count: Option<&[u8]>, line: usize) -> Outcome<Element> {
    let (Some(name), Some(count)) = (name, count) else {
        return Err(Problem::line(line, "an element has a name and a count: `element vertex 8`"));
    };
    let number = whole(count, "the count of an element", line)?;
    let count = u64::try_from(number)
        .map_err(|_| Problem::line(line, format!("there cannot be {number} of an element")))?;
    Ok(Element { name: name.to_vec(), count, properties: Vec::new() })
}

fn property(words: &[&[u8]], line: usize) -> Outcome<Property> {
    let kind = |word: &[u8]| {
        let what = || {
            format!(
                "the kinds of number are char, uchar, short, ushort, int, uint, float and double, and not {}",
                Word(word)
            )
        };
        Scalar::of(word).ok_or_else(|| Problem::line(line, what()))
    };
    match *words {
        [b"list", length, item, name, ..] => {
            let (length, item) = (kind(length)?, kind(item)?);
            if length.is_float() {
                return Err(Problem::line(line, "the length of a list must be a whole number"));
            }
            Ok(Property { name: name.to_vec(), length: Some(length), kind: item })
        }
        [scalar, name, ..] if scalar != b"list" => {
            Ok(Property { name: name.to_vec(), length: None, kind: kind(scalar)? })
        }
        _ => {
            let what = "a property is `property float x` or `property list uchar int vertex_indices`";
            Err(Problem::line(line, what))
        }
    }
}
