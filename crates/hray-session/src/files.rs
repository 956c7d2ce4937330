//! The files that a session works with.

use crate::protocol::{FileEntry, FileKind, OnDisk, Refusal};
use hray::{AssetError, Assets, Image, Language, Model};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::{Arc, Mutex, PoisonError};

/// The longest text of a document: 8 MiB.
pub const MOST_TEXT: usize = 8 << 20;
/// The most files that are listed.
pub const MOST_FILES: usize = 5000;
/// The endings of the files that scenes can read, besides scenes.
const OTHER_ENDINGS: &[&str] = &[
    "ply", "stl", "obj", "gltf", "glb", "png", "jpg", "jpeg", "exr", "hdr", "webp", "bmp", "tga", "tiff",
    "tif", "gif", "qoi",
];

/// A folder, or what stands for one: what scenes may read, and where they are saved.
///
/// Paths are relative, with slashes, without `.` and `..`; [`is_inside`] says which.
pub trait Files: Assets + Send + Sync {
    /// What it is called.
    fn root(&self) -> String;

    /// All files that are of interest, at most [`MOST_FILES`].
    fn list(&self) -> Vec<FileEntry>;

    /// Writes a text to a file, whole or not at all.
    ///
    /// # Errors
    /// Why that cannot be.
    fn write(&self, path: &str, text: &str) -> Result<(), Refusal>;

    /// Whether anything can be written at all.
    fn can_save(&self) -> bool;
}

/// Whether a path, as a page writes it, names something in the folder: no `..`, nothing absolute, nothing that some system
/// takes for more than a name.
#[must_use]
pub fn is_inside(path: &str) -> bool {
    let plain = |part: &str| !matches!(part, "" | "." | "..");
    path.len() <= 1024 && !path.contains(['\\', ':', '\0']) && path.split('/').all(plain)
}

/// The same, or what is wrong.
pub(crate) fn inside(path: &str) -> Result<&str, Refusal> {
    let help = "only files in the folder that was opened can be read and written; name one by its path in that folder";
    if is_inside(path) {
        Ok(path)
    } else {
        Err(Refusal::new(format!("{path:?} is not a path in the folder")).with_help(help))
    }
}

/// The hash by which a text on the disk is told from another.
#[must_use]
pub fn hash(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Bytes as text.
pub(crate) fn hex(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// The kind of file that a path names, as far as that tells.
#[must_use]
pub(crate) fn kind_of(path: &str) -> Option<FileKind> {
    let (_, ending) = path.rsplit_once('.')?;
    let ending = ending.to_ascii_lowercase();
    if ending == "hry" {
        return Some(FileKind::Scene);
    }
    OTHER_ENDINGS.contains(&&*ending).then_some(FileKind::Other)
}

/// Whether scenes can read such a file, or what they read can name it.
#[must_use]
pub(crate) fn is_read(path: &str) -> bool {
    kind_of(path).is_some() || path.ends_with(".mtl") || path.ends_with(".bin")
}

/// The kind of scene that a text is.
#[must_use]
pub(crate) fn kind_of_text(text: &str) -> FileKind {
    if Language::of(text) == Language::Classic { FileKind::Classic } else { FileKind::Scene }
}

/// A file as it is now: its text and the hash of that.
///
/// # Errors
/// Where it is there and cannot be read.
pub(crate) fn on_disk(files: &dyn Files, path: &str) -> Result<OnDisk, Refusal> {
    match files.text(path) {
        Ok(text) if text.len() > MOST_TEXT => {
            let message =
                format!("{path:?} is longer than the {} MiB that can be edited here", MOST_TEXT >> 20);
            Err(Refusal::new(message))
        }
        Ok(text) => Ok(OnDisk { disk: Some(hash(text.as_bytes())), text: Some(text) }),
        Err(AssetError::NotFound) => Ok(OnDisk { disk: None, text: None }),
        Err(error) => Err(Refusal::new(format!("{path:?} cannot be read: {error}"))),
    }
}

/// The texts that are open, over the files.
pub(crate) struct Overlay {
    pub(crate) files: Arc<dyn Files>,
    pub(crate) open: BTreeMap<String, Arc<str>>,
}

impl Assets for Overlay {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        match self.open.get(path) {
            Some(text) => Ok(text.to_string()),
            None => self.files.text(path),
        }
    }

    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError> {
        self.files.image(path)
    }

    fn model(&self, path: &str) -> Result<Arc<Model>, AssetError> {
        self.files.model(path)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        let mut paths = self.files.neighbours(path);
        let folder =
            |path: &str| path.rsplit_once('/').map_or(String::new(), |(folder, _)| folder.to_owned());
        paths.extend(self.open.keys().filter(|open| folder(open) == folder(path)).cloned());
        paths.sort();
        paths.dedup();
        paths
    }
}

/// Files in memory: what a page brought along.
#[derive(Default)]
pub struct MemoryFiles {
    files: Mutex<BTreeMap<String, Arc<[u8]>>>,
    images: Mutex<BTreeMap<String, Arc<Image>>>,
    models: Mutex<BTreeMap<String, Arc<Model>>>,
}

impl std::fmt::Debug for MemoryFiles {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MemoryFiles").finish_non_exhaustive()
    }
}

impl MemoryFiles {
    /// Puts a file there; takes one away where there are no bytes.
    ///
    /// # Errors
    /// Where the path is none.
    pub fn put(&self, path: &str, bytes: Option<Vec<u8>>) -> Result<(), Refusal> {
        inside(path)?;
        let mut files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        match bytes {
            Some(bytes) => {
                files.insert(path.to_owned(), bytes.into());
            }
            None => {
                files.remove(path);
            }
        }
        // Others may have named it.
        self.images.lock().unwrap_or_else(PoisonError::into_inner).clear();
        self.models.lock().unwrap_or_else(PoisonError::into_inner).clear();
        Ok(())
    }

    fn bytes(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        let files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        files.get(path).cloned().ok_or(AssetError::NotFound)
    }
}

impl Assets for MemoryFiles {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        String::from_utf8(self.bytes(path)?.to_vec())
            .map_err(|_| AssetError::Unreadable("it is not UTF-8 text".to_owned()))
    }

    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError> {
        let mut images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(image) = images.get(path) {
            return Ok(image.clone());
        }
        let image = hray::decode_image(&self.bytes(path)?, path.as_ref());
        let image = Arc::new(image.map_err(|error| AssetError::Unreadable(error.reason()))?);
        images.insert(path.to_owned(), image.clone());
        Ok(image)
    }

    fn model(&self, path: &str) -> Result<Arc<Model>, AssetError> {
        let mut models = self.models.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(model) = models.get(path) {
            return Ok(model.clone());
        }
        let companion = |written: &str| {
            let path = hray::resolve_path(path, written).ok_or("it lies outside the root folder")?;
            self.bytes(&path).map(|bytes| bytes.to_vec()).map_err(|error| error.to_string())
        };
        let model = hray::decode_model(&self.bytes(path)?, path.as_ref(), &companion);
        let model = Arc::new(model.map_err(|error| AssetError::Unreadable(error.reason()))?);
        models.insert(path.to_owned(), model.clone());
        Ok(model)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        let files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let here = |path: &&String| path.rsplit_once('/').map_or("", |(folder, _)| folder) == folder;
        files.keys().filter(here).cloned().collect()
    }
}

impl Files for MemoryFiles {
    fn root(&self) -> String {
        String::new()
    }

    fn list(&self) -> Vec<FileEntry> {
        let files = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        let entry = |(path, bytes): (&String, &Arc<[u8]>)| {
            let kind = match kind_of(path)? {
                FileKind::Scene => kind_of_text(std::str::from_utf8(bytes).ok()?),
                kind => kind,
            };
            Some(FileEntry { path: path.clone(), kind })
        };
        files.iter().filter_map(entry).take(MOST_FILES).collect()
    }

    fn write(&self, _path: &str, _text: &str) -> Result<(), Refusal> {
        Err(Refusal::new("nothing can be saved here").with_help("download the scene, or share it as a link"))
    }

    fn can_save(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::is_inside;

    #[test]
    fn paths_are_names_and_slashes() {
        for path in ["a.hry", "a/b.hry", "é ü.hry", ".hidden/x"] {
            assert!(is_inside(path), "{path}");
        }
        for path in ["", "/a", "a/", "a//b", "..", "a/../b", "./a", "a\\b", "c:a", "a\0", &"x".repeat(2000)] {
            assert!(!is_inside(path), "{path:?}");
        }
    }
}
