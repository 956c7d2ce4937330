//! Where imported files, images and meshes come from.

use hray_core::{Image, Model};
use std::fmt;
use std::sync::Arc;

/// What the language may ask for besides the scene's own text. Paths are relative to the root, with slashes, without
/// `.` and `..`: what leads out of the root never gets here.
///
/// The language itself touches no file; whoever embeds it decides what there is.
pub trait Assets {
    /// The text of a file.
    ///
    /// # Errors
    /// [`AssetError`] where there is none, or it is not to be had.
    fn text(&self, path: &str) -> Result<String, AssetError>;

    /// An image, in linear light.
    ///
    /// # Errors
    /// [`AssetError`] where there is none, or it is not to be had.
    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError>;

    /// The meshes in a file, with what that names itself; files may be large, so whoever answers keeps what was read.
    ///
    /// # Errors
    /// [`AssetError`] where there is none, or it is not to be had.
    fn model(&self, path: &str) -> Result<Arc<Model>, AssetError> {
        let _ = path;
        Err(AssetError::NotFound)
    }

    /// Files whose names might have been meant, for "did you mean": those in the same folder.
    fn neighbours(&self, path: &str) -> Vec<String>;

    /// What a file is called in messages: a path that leads to it from where the user is.
    fn name(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Why an asset is not to be had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum AssetError {
    /// There is no such file.
    NotFound,
    /// It lies outside the root, for example behind a link.
    Outside,
    /// Anything else, in words that follow "cannot be read: ".
    Unreadable(String),
}

impl fmt::Display for AssetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFound => f.write_str("there is no such file"),
            Self::Outside => f.write_str("it lies outside the root folder"),
            Self::Unreadable(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for AssetError {}

/// No assets at all: for texts that stand alone.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoAssets;

impl Assets for NoAssets {
    fn text(&self, _path: &str) -> Result<String, AssetError> {
        Err(AssetError::NotFound)
    }

    fn image(&self, _path: &str) -> Result<Arc<Image>, AssetError> {
        Err(AssetError::NotFound)
    }

    fn neighbours(&self, _path: &str) -> Vec<String> {
        Vec::new()
    }
}

/// The path that `written` means in a file at `from` (both relative to the root): from the folder of that file, with `.`
/// and `..` resolved. None where it leads out of the root, or is absolute.
#[must_use]
pub fn resolve(from: &str, written: &str) -> Option<String> {
    if written.is_empty() || written.starts_with('/') || written.contains(['\\', ':', '\0']) {
        return None;
    }
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in written.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    (!parts.is_empty()).then(|| parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::resolve;

    #[test]
    fn paths_stay_inside_the_root() {
        let path = |from, written| resolve(from, written);
        assert_eq!(path("scene.hry", "palette.hry").as_deref(), Some("palette.hry"));
        assert_eq!(path("a/scene.hry", "../b/./c.hry").as_deref(), Some("b/c.hry"));
        for written in ["", "/etc/passwd", "../x.hry", "a/../../x", "c:x", "a\\b", "."] {
            assert_eq!(path("scene.hry", written), None, "{written}");
        }
    }
}
