//! How the bytes of a glTF file are packed: the binary container, and data in URIs.

use super::super::problem::{Outcome, Problem};

/// The document of a file, where it starts, and, of the binary form, the bytes that follow it.
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    pub(super) start: usize,
    pub(super) binary: Option<&'a [u8]>,
}

/// Takes a file apart (glTF 2.0, section 4).
pub(super) fn open(bytes: &[u8]) -> Outcome<Container<'_>> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Container { json: bytes, start: 0, binary: None });
    }
    let word = |at: usize| {
        let four = bytes.get(at..).and_then(|rest| rest.first_chunk());
        let missing =
            || Problem::byte(bytes.len(), format!("the file ends where 4 bytes at byte {at} should be"));
        four.map(|four| u32::from_le_bytes(*four)).ok_or_else(missing)
    };
    let version = word(4)?;
    if version != 2 {
        return Err(Problem::byte(4, format!("the version of the file is {version}, and 2 is what is read")));
    }
    let length = word(8)? as usize;
    let bytes = bytes.get(..length).ok_or_else(|| {
        let what = format!("the header says that the file has {length} bytes, but it has {}", bytes.len());
        Problem::byte(8, what)
    })?;
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at < length {
        let (size, kind) = (word(at)? as usize, word(at + 4)?);
        let start = at + 8;
        let chunk = start.checked_add(size).and_then(|end| bytes.get(start..end)).ok_or_else(|| {
            let what = format!(
                "the header of this chunk says that it has {size} bytes, but the file has only {} more",
                length.saturating_sub(start)
            );
            Problem::byte(at, what)
        })?;
        match kind {
            0x4E4F_534A if json.is_none() => json = Some((chunk, start)),
            0x004E_4942 if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        at = start + size;
    }
    let (json, start) = json.ok_or_else(|| Problem::byte(12, "the file has no chunk `JSON`"))?;
    Ok(Container { json, start, binary })
}

/// The bytes of a `data:` URI in base64 (RFC 2397, RFC 4648).
pub(super) fn data(uri: &str) -> Result<Vec<u8>, String> {
    let Some((kind, data)) = uri.split_once(',') else {
        return Err("a data URI has a comma before its data".to_owned());
    };
    if !kind.ends_with(";base64") {
        return Err("a data URI must be in base64".to_owned());
    }
    let data = data.trim_end_matches('=');
    let mut bytes = Vec::with_capacity(data.len() / 4 * 3 + 2);
    let (mut bits, mut count) = (0u32, 0);
    for (place, byte) in data.bytes().enumerate() {
        let digit = match byte {
            b'A'..=b'Z' => byte - b'A',
            b'a'..=b'z' => byte - b'a' + 26,
            b'0'..=b'9' => byte - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return Err(format!("character {place} of its data is no digit of base64")),
        };
        bits = bits << 6 | u32::from(digit);
        count += 6;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    Ok(bytes)
}

/// A relative URI as a path: `%20` is a space (RFC 3986).
pub(super) fn path(uri: &str) -> Option<String> {
    let hex = |byte: u8| char::from(byte).to_digit(16).map(|digit| digit as u8);
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    loop {
        rest = match *rest {
            [] => break,
            [b'%', a, b, ref rest @ ..] => {
                bytes.push(hex(a)? << 4 | hex(b)?);
                rest
            }
            [byte, ref rest @ ..] => {
                bytes.push(byte);
                rest
            }
        };
    }
    String::from_utf8(bytes).ok()
}
