//! Paths as URIs, and back.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The path of a file; none where the URI names something else.
pub(crate) fn to_path(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let rest = rest.strip_prefix("localhost").unwrap_or(rest);
    if !rest.starts_with('/') {
        return None;
    }
    let rest = rest.split(['?', '#']).next()?;
    let decoded = decode(rest)?;
    let mut path = decoded.as_str();
    // `/c:/scenes` is `c:/scenes` on Windows.
    if cfg!(windows) && path.as_bytes().get(2) == Some(&b':') {
        path = path.get(1..)?;
    }
    Some(PathBuf::from(path))
}

/// The URI of an absolute path.
pub(crate) fn from_path(path: &Path) -> String {
    let text = path.to_string_lossy();
    let text =
        if cfg!(windows) { text.trim_start_matches(r"\\?\").replace('\\', "/") } else { text.into_owned() };
    let mut uri = String::from("file://");
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(char::from(byte))
            }
            _ => {
                let _ = write!(uri, "%{byte:02X}");
            }
        }
    }
    uri
}

/// A text without its percent signs.
fn decode(text: &str) -> Option<String> {
    let (mut bytes, mut rest) = (Vec::with_capacity(text.len()), text.as_bytes());
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        if *first == b'%' {
            let digits = std::str::from_utf8(rest.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = rest.get(2..)?;
        } else {
            bytes.push(*first);
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn paths_come_back() {
        for path in ["/a/scene.hry", "/a b/é#?%.hry", "/"] {
            assert_eq!(to_path(&from_path(Path::new(path))).as_deref(), Some(Path::new(path)));
        }
        assert_eq!(to_path("file:///a%20b/c.hry"), Some("/a b/c.hry".into()));
        assert_eq!(to_path("file://localhost/a"), Some("/a".into()));
        for none in ["untitled:Untitled-1", "file://host/a", "file:///%", "file:///%zz", "", "file:///%FF"] {
            assert_eq!(to_path(none), None, "{none}");
        }
    }
}
