//! File names in messages.

use std::fmt::{self, Write};
use std::path::Path;

/// A path as it appears in a message: between backticks, with control characters escaped, so that no file
/// name can move the cursor of a terminal or break a line.
#[derive(Clone, Copy, Debug)]
pub struct Quoted<'a>(pub &'a Path);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_char('`')?;
        for c in self.0.to_string_lossy().chars() {
            if c.is_control() { write!(f, "{}", c.escape_default())? } else { f.write_char(c)? }
        }
        f.write_char('`')
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_are_escaped() {
        assert_eq!(Quoted(Path::new("a b/é.png")).to_string(), "`a b/é.png`");
        assert_eq!(Quoted(Path::new("a\n\u{1b}[2J")).to_string(), "`a\\n\\u{1b}[2J`");
    }
}
