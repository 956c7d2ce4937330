//! Which of the two languages a text is in.

/// A scene language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// The grammar of 2005: [`crate::classic`].
    Classic,
    /// [`crate::hry`].
    Hry,
}

/// The word that a classic scene begins with.
const FIRST_WORD: &str = "renderDescr";
/// So many letters of it may be wrong for a text to be read as classic, and be told so.
const MOST_TYPOS: usize = 3;

impl Language {
    /// The language of a text: classic where it begins, after white space and comments, with the word `renderDescr`.
    ///
    /// Where that word is only nearly right, or missing before the bracket that follows it, the text is classic as well:
    /// nothing in hry looks like that, and the classic parser knows what was meant.
    #[must_use]
    pub fn of(text: &str) -> Self {
        let text = after_comments(text);
        let word =
            |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
        let first = word(text);
        if first == FIRST_WORD {
            return Self::Classic;
        }
        let rest = after_comments(text.get(first.len()..).unwrap_or_default());
        let Some(inside) = rest.strip_prefix('(') else { return Self::Hry };
        let is_header = near(&word(after_comments(inside)), "resolution");
        if is_header && (first.is_empty() || near(&first, FIRST_WORD)) { Self::Classic } else { Self::Hry }
    }
}

fn near(word: &str, wanted: &str) -> bool {
    // Of a word of any length only so much is compared.
    let word: String = word.chars().take(2 * wanted.len()).collect();
    strsim::osa_distance(&word.to_lowercase(), &wanted.to_lowercase()) <= MOST_TYPOS
}

/// The text without the white space and comments at its start. A block comment without an end is taken for text.
fn after_comments(text: &str) -> &str {
    let mut text = text.trim_start_matches('\u{feff}').trim_start();
    loop {
        let rest = if text.starts_with("--") {
            text.find('\n').map_or("", |end| text.get(end..).unwrap_or_default())
        } else if text.starts_with("{-") {
            match block_end(text) {
                Some(end) => text.get(end..).unwrap_or_default(),
                None => return text,
            }
        } else {
            return text;
        };
        text = rest.trim_start();
    }
}

/// Where the block comment ends that a text begins with; such comments nest.
fn block_end(text: &str) -> Option<usize> {
    let (mut depth, mut at) = (0usize, 0);
    let bytes = text.as_bytes();
    while let Some(pair) = bytes.get(at..at + 2) {
        match pair {
            b"{-" => (depth, at) = (depth + 1, at + 2),
            b"-}" => (depth, at) = (depth.saturating_sub(1), at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_word_decides() {
        let header = "( resolution (400,300) ) 3 [";
        let classic = [
            "renderDescr",
            "\u{feff}\n renderDescr",
            "-- c\n{- a {- b -} -}renderDescr",
            "",
            "renderDesc",
            "RenderDescr",
            "render_descr",
        ];
        for start in classic {
            assert_eq!(Language::of(&format!("{start} {header}")), Language::Classic, "{start}");
        }
        for hry in [
            "",
            "scene = {}",
            "-- renderDescr\nscene = {}",
            "{- renderDescr",
            "renderDescription = 1",
            "renderDesc (x, y) = x",
            "renderDesc = (resolution)",
            "import \"a.hry\"",
            "é (resolution)",
            "render (width, height) = 3",
        ] {
            assert_eq!(Language::of(hry), Language::Hry, "{hry}");
        }
        assert_eq!(Language::of("renderDescr"), Language::Classic);
        assert_eq!(Language::of("renderDescr ( resolutoin"), Language::Classic);
        assert_eq!(Language::of("renderDescr = 3"), Language::Classic);
    }
}
