//! Names of numbered pictures: `out/frame-####.png`.

use std::path::{Path, PathBuf};

/// A file name in which a run of `#` stands for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// The pattern in the last part of a path; none where that has no `#`. Of several runs the last one counts.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let (upto, after) = name.rsplit_once('#')?;
        let before = upto.trim_end_matches('#');
        Some(Self {
            folder: path.parent().map(Path::to_owned).unwrap_or_default(),
            before: before.to_owned(),
            digits: upto.len() - before.len() + 1,
            after: after.to_owned(),
        })
    }

    /// The name of one picture: its number has as many digits as there are `#`, or more where it needs them.
    pub(crate) fn name(&self, number: u32) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }

    /// The folder that the pictures lie in.
    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(pattern: &str, number: u32) -> Option<String> {
        Some(Pattern::of(Path::new(pattern))?.name(number).to_string_lossy().into_owned())
    }

    #[test]
    fn numbers_are_padded_and_widen() {
        assert_eq!(name("out/frame-####.png", 7).as_deref(), Some("out/frame-0007.png"));
        assert_eq!(name("a#.png", 12345).as_deref(), Some("a12345.png"));
        assert_eq!(name("a#b##.png", 3).as_deref(), Some("a#b03.png"));
        assert_eq!((name("a##/b.png", 3), name("b.png", 3), name("", 3)), (None, None, None));
    }
}
