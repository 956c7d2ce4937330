//! Who else may use a definition, and what of a text is replaced: for every interface that renames and lays out.

use hray::ide::{Analysis, FileId, Place};
use hray::{Assets, Span};
use std::sync::Arc;

/// So many files that are not open are looked at for uses of a definition, and no more text than this.
pub const MOST_NEIGHBOURS: usize = 1000;
const MOST_SEARCHED: usize = 16 << 20;

/// Analyses of those of the files at `paths` that may use what is defined at `defined`, in order.
pub fn users(
    paths: impl IntoIterator<Item = String>,
    defined: &Place,
    assets: &dyn Assets,
) -> Vec<Arc<Analysis>> {
    let FileId::Own(path) = &defined.file else { return Vec::new() };
    let name = assets.text(path).map(|text| defined.span.text(&text).to_owned()).unwrap_or_default();
    let (mut found, mut room) = (Vec::new(), MOST_SEARCHED);
    for path in paths.into_iter().take(MOST_NEIGHBOURS) {
        let Ok(text) = assets.text(&path) else { continue };
        let Some(left) = room.checked_sub(text.len()) else { break };
        room = left;
        // Whoever uses a definition of another file imports that file, and says its name.
        if text.contains("import") && text.contains(&name) {
            found.push(Arc::new(Analysis::new(&path, text.into(), assets)));
        }
    }
    found
}

/// What of a text is replaced by what to make another of it; none where they are the same.
#[must_use]
pub fn difference<'n>(old: &str, new: &'n str) -> Option<(Span, &'n str)> {
    if old == new {
        return None;
    }
    let same = |(a, b): &(char, char)| a == b;
    let before: usize = old.chars().zip(new.chars()).take_while(same).map(|(c, _)| c.len_utf8()).sum();
    let (old_rest, new_rest) = (old.get(before..)?, new.get(before..)?);
    let after: usize =
        old_rest.chars().rev().zip(new_rest.chars().rev()).take_while(same).map(|(c, _)| c.len_utf8()).sum();
    Some((Span::new(before, old.len() - after), new_rest.get(..new_rest.len() - after)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_small_and_whole() {
        for (old, new) in [
            ("a b c", "a x c"),
            ("é", "éé"),
            ("", "a"),
            ("a", ""),
            ("aé", "aè"),
            ("aaa", "aa"),
            ("abab", "ab"),
        ] {
            let (span, text) = difference(old, new).unwrap();
            assert_eq!(format!("{}{text}{}", &old[..span.start], &old[span.end..]), new);
        }
        assert_eq!(difference("a b c", "a x c"), Some((Span::new(2, 3), "x")));
        assert_eq!(difference("a", "a"), None);
    }
}
