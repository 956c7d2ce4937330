//! Files inside one folder, and nothing outside of it.

use crate::source::read_bounded;
use crate::{InputError, MAX_IMAGE_BYTES, MAX_MODEL_BYTES, MAX_SOURCE_BYTES, decode_image, decode_model};
use hray_core::{Image, Model};
use std::fs::{self, File};
use std::io;
use std::path::{Component, Path, PathBuf};

/// The most names of a folder that are looked at for "did you mean".
const MOST_NAMES: usize = 1000;
/// The most files and folders that are looked at to find those of a kind.
const MOST_ENTRIES: usize = 20_000;

/// A folder whose files may be read, and no others: not by `..`, not by absolute paths, not through links that lead out.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Without links, so that it is a prefix of what lies in it.
    root: PathBuf,
}

/// Why a file of a folder is not to be had.
#[derive(Debug)]
#[non_exhaustive]
pub enum FolderError {
    /// There is no such file.
    Missing,
    /// It lies outside the folder.
    Outside,
    /// It cannot be read.
    Input(InputError),
    /// It cannot be written.
    Output(crate::OutputError),
}

/// What changes when a file is written; see [`Folder::stamp`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileStamp {
    /// When it was last written, where the system says.
    pub written: Option<std::time::SystemTime>,
    /// Its length in bytes.
    pub length: u64,
}

impl Folder {
    /// The folder at a path.
    ///
    /// # Errors
    /// [`InputError`] where there is none, or it may not be entered.
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let path = if path.as_os_str().is_empty() { Path::new(".") } else { path };
        let failed = |source| InputError::from_io(path.to_owned(), source);
        let root = path.canonicalize().map_err(failed)?;
        if !fs::metadata(&root).map_err(failed)?.is_dir() {
            return Err(InputError::NoDirectory { path: path.to_owned() });
        }
        Ok(Self { root })
    }

    /// The path from this folder to a file, with slashes; none where the file does not lie in it, or has a name that
    /// is not UTF-8.
    #[must_use]
    pub fn path_to(&self, file: &Path) -> Option<String> {
        // The file may be a link or not exist: what counts is the folder it is in.
        let (name, parent) = (file.file_name()?, file.parent()?);
        let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
        let inside = parent.canonicalize().ok()?.strip_prefix(&self.root).ok()?.join(name);
        let parts: Option<Vec<&str>> = inside.components().map(|part| part.as_os_str().to_str()).collect();
        Some(parts?.join("/"))
    }

    /// The path from the file system's root to what `path` is in this folder, which need not exist.
    #[must_use]
    pub fn full_path(&self, path: &str) -> PathBuf {
        self.root.join(path)
    }

    /// The bytes of a text, [`MAX_SOURCE_BYTES`] at most.
    ///
    /// # Errors
    /// [`FolderError`]
    pub fn read(&self, path: &str) -> Result<Vec<u8>, FolderError> {
        self.bytes(path, MAX_SOURCE_BYTES)
    }

    /// An image, see [`decode_image`].
    ///
    /// # Errors
    /// [`FolderError`]
    pub fn image(&self, path: &str) -> Result<Image, FolderError> {
        decode_image(&self.bytes(path, MAX_IMAGE_BYTES)?, Path::new(path)).map_err(FolderError::Input)
    }

    /// A file of meshes, see [`decode_model`], and what it names, which lies in this folder, too.
    ///
    /// # Errors
    /// [`FolderError`]
    pub fn model(&self, path: &str) -> Result<Model, FolderError> {
        let companion = |written: &str| {
            let path = beside(path, written).ok_or_else(|| OUTSIDE.to_owned())?;
            self.bytes(&path, MAX_MODEL_BYTES).map_err(|error| match error {
                FolderError::Missing => "there is no such file".to_owned(),
                FolderError::Outside => OUTSIDE.to_owned(),
                FolderError::Input(error) => error.reason(),
                FolderError::Output(error) => error.to_string(),
            })
        };
        let bytes = self.bytes(path, MAX_MODEL_BYTES)?;
        decode_model(&bytes, Path::new(path), &companion).map_err(FolderError::Input)
    }

    /// The paths of the files in the same folder as `path`, sorted; of a very large folder not all.
    #[must_use]
    pub fn neighbours(&self, path: &str) -> Vec<String> {
        let (before, _) = path.rsplit_once('/').unwrap_or(("", path));
        let Ok(folder) = self.find(before) else { return Vec::new() };
        let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
        let entries = entries.flatten().take(MOST_NAMES);
        let files = entries.filter(|entry| entry.file_type().is_ok_and(|kind| !kind.is_dir()));
        let names = files.filter_map(|entry| entry.file_name().into_string().ok());
        let mut paths: Vec<String> =
            names.map(|name| if before.is_empty() { name } else { format!("{before}/{name}") }).collect();
        paths.sort();
        paths
    }

    /// The paths of the files below this folder whose names end like `ending`, those of each folder before those further
    /// down, sorted: `most` of them at most, and not those of a very large folder that lie last. Hidden folders are passed
    /// over, and so are links to folders, which may lead in circles.
    #[must_use]
    pub fn below(&self, ending: &str, most: usize) -> Vec<String> {
        let (mut found, mut looked_at) = (Vec::new(), 0);
        let mut level = vec![String::new()];
        while !level.is_empty() && found.len() < most && looked_at < MOST_ENTRIES {
            let mut next = Vec::new();
            for folder in level {
                let Ok(entries) = fs::read_dir(self.root.join(&folder)) else { continue };
                for entry in entries.flatten().take(MOST_ENTRIES - looked_at) {
                    looked_at += 1;
                    let Ok(name) = entry.file_name().into_string() else { continue };
                    let path = if folder.is_empty() { name.clone() } else { format!("{folder}/{name}") };
                    match entry.file_type() {
                        Ok(kind) if kind.is_dir() && !name.starts_with('.') => next.push(path),
                        Ok(kind) if !kind.is_dir() && name.ends_with(ending) => found.push(path),
                        _ => {}
                    }
                }
            }
            next.sort();
            level = next;
        }
        found.sort_by(|a, b| (a.matches('/').count(), a).cmp(&(b.matches('/').count(), b)));
        found.truncate(most);
        found
    }

    /// What changes when a file is written: when that was last done, and how long it is. None where there is no such file.
    #[must_use]
    pub fn stamp(&self, path: &str) -> Option<FileStamp> {
        let metadata = fs::metadata(self.find(path).ok()?).ok()?;
        metadata.is_file().then(|| FileStamp { written: metadata.modified().ok(), length: metadata.len() })
    }

    /// Writes a text to a file, whole or not at all. Its folder has to be there.
    ///
    /// # Errors
    /// [`FolderError::Outside`] where the place is not in this folder, links followed; [`FolderError::Output`] where the
    /// system refuses.
    pub fn write(&self, path: &str, text: &str) -> Result<(), FolderError> {
        let relative = Path::new(path);
        let is_plain = relative.components().all(|part| matches!(part, Component::Normal(_)));
        let (true, Some(name)) = (is_plain, relative.file_name()) else { return Err(FolderError::Outside) };
        let parent = self.find(&relative.parent().unwrap_or(Path::new("")).to_string_lossy())?;
        let mut target = parent.join(name);
        // What is a link already is followed, as long as it leads to a place in the folder.
        match self.find(path) {
            Ok(found) => target = found,
            Err(FolderError::Missing) if fs::symlink_metadata(&target).is_err() => {}
            Err(FolderError::Missing) => return Err(FolderError::Outside),
            Err(error) => return Err(error),
        }
        let destination = crate::Destination::file(&target).map_err(FolderError::Output)?;
        if destination.is_direct() {
            return Err(FolderError::Outside);
        }
        crate::write_text(&destination, text).map_err(FolderError::Output)
    }

    /// The true path of what `path` leads to, which lies in the folder.
    fn find(&self, path: &str) -> Result<PathBuf, FolderError> {
        let relative = Path::new(path);
        if relative.components().any(|part| !matches!(part, Component::Normal(_) | Component::CurDir)) {
            return Err(FolderError::Outside);
        }
        let found = self.root.join(relative).canonicalize().map_err(|error| Self::failed(path, error))?;
        if found.starts_with(&self.root) { Ok(found) } else { Err(FolderError::Outside) }
    }

    fn bytes(&self, path: &str, limit: u64) -> Result<Vec<u8>, FolderError> {
        let found = self.find(path)?;
        let metadata = fs::metadata(&found).map_err(|error| Self::failed(path, error))?;
        let given = PathBuf::from(path);
        if metadata.is_dir() {
            return Err(FolderError::Input(InputError::Directory { path: given }));
        }
        // A pipe or a device may never end, or wait for ever.
        if !metadata.is_file() {
            let source = io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file");
            return Err(FolderError::Input(InputError::Io { path: given, source }));
        }
        if metadata.len() > limit {
            return Err(FolderError::Input(InputError::TooLarge { path: given, limit }));
        }
        let file = File::open(&found).map_err(|error| Self::failed(path, error))?;
        read_bounded(file, Path::new(path), limit).map_err(FolderError::Input)
    }

    fn failed(path: &str, error: io::Error) -> FolderError {
        match error.kind() {
            io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => FolderError::Missing,
            _ => FolderError::Input(InputError::from_io(PathBuf::from(path), error)),
        }
    }
}

const OUTSIDE: &str = "it lies outside the root folder";

/// The path that `written` means in the file at `from`; none where it leads out of the folder.
fn beside(from: &str, written: &str) -> Option<String> {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for component in Path::new(written).components() {
        match component {
            Component::CurDir => {}
            Component::Normal(part) => parts.push(part.to_str()?),
            Component::ParentDir => {
                parts.pop()?;
            }
            Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folders() -> (tempfile::TempDir, Folder) {
        let outer = tempfile::tempdir().unwrap();
        let inner = outer.path().join("inner");
        fs::create_dir_all(inner.join("sub")).unwrap();
        fs::write(outer.path().join("secret.hry"), "secret").unwrap();
        fs::write(inner.join("a.hry"), "a").unwrap();
        fs::write(inner.join("sub/b.hry"), "b").unwrap();
        let folder = Folder::open(&inner).unwrap();
        (outer, folder)
    }

    #[test]
    fn files_inside_are_read_and_nothing_else_is() {
        let (_outer, folder) = folders();
        assert_eq!(folder.read("a.hry").unwrap(), b"a");
        assert_eq!(folder.read("sub/b.hry").unwrap(), b"b");
        for path in ["../secret.hry", "sub/../../secret.hry", "/etc/hostname", "sub/../a.hry"] {
            assert!(matches!(folder.read(path), Err(FolderError::Outside)), "{path}");
        }
        for path in ["none.hry", "a.hry/b", "none/none.hry"] {
            assert!(matches!(folder.read(path), Err(FolderError::Missing)), "{path}");
        }
        assert!(matches!(folder.read("sub"), Err(FolderError::Input(InputError::Directory { .. }))));
        assert!(matches!(folder.image("a.hry"), Err(FolderError::Input(InputError::Image { .. }))));
        assert_eq!(folder.neighbours("x.hry"), ["a.hry"]);
        assert_eq!(folder.neighbours("sub/x.hry"), ["sub/b.hry"]);
        assert!(folder.neighbours("../x").is_empty() && folder.neighbours("none/x").is_empty());
    }

    #[test]
    fn files_of_a_kind_are_found_below() {
        let (outer, folder) = folders();
        let inner = outer.path().join("inner");
        for path in ["sub/deep", ".hidden"] {
            fs::create_dir_all(inner.join(path)).unwrap();
        }
        for path in ["z.hry", "a.png", "sub/deep/c.hry", ".hidden/d.hry"] {
            fs::write(inner.join(path), "").unwrap();
        }
        assert_eq!(folder.below(".hry", 9), ["a.hry", "z.hry", "sub/b.hry", "sub/deep/c.hry"]);
        assert_eq!(folder.below(".hry", 2), ["a.hry", "z.hry"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_may_lead_about_inside_but_not_out() {
        use std::os::unix::fs::symlink;
        let (outer, folder) = folders();
        let inner = outer.path().join("inner");
        symlink("a.hry", inner.join("good.hry")).unwrap();
        symlink("../secret.hry", inner.join("bad.hry")).unwrap();
        symlink("..", inner.join("up")).unwrap();
        symlink("circle", inner.join("circle")).unwrap();
        symlink("gone", inner.join("dangling")).unwrap();
        assert_eq!(folder.read("good.hry").unwrap(), b"a");
        for path in ["bad.hry", "up/secret.hry"] {
            assert!(matches!(folder.read(path), Err(FolderError::Outside)), "{path}");
        }
        assert_eq!(folder.read("up/inner/a.hry").unwrap(), b"a");
        assert!(folder.neighbours("up/x").is_empty());
        assert!(matches!(folder.read("circle"), Err(FolderError::Input(_))));
        assert!(matches!(folder.read("dangling"), Err(FolderError::Missing)));
    }

    #[cfg(unix)]
    #[test]
    fn what_never_ends_is_not_begun() {
        let (outer, folder) = folders();
        let pipe = outer.path().join("inner/pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        if made.is_ok_and(|status| status.success()) {
            assert!(matches!(folder.read("pipe"), Err(FolderError::Input(InputError::Io { .. }))));
        }
    }

    #[test]
    fn the_path_to_a_file_is_found() {
        let (outer, folder) = folders();
        let path = |name: &str| folder.path_to(&outer.path().join(name));
        assert_eq!(path("inner/a.hry").as_deref(), Some("a.hry"));
        assert_eq!(path("inner/sub/../sub/new.hry").as_deref(), Some("sub/new.hry"));
        assert_eq!((path("secret.hry"), path("none/x.hry")), (None, None));
        assert!(matches!(
            Folder::open(&outer.path().join("secret.hry")),
            Err(InputError::NoDirectory { .. })
        ));
        assert!(matches!(Folder::open(&outer.path().join("none")), Err(InputError::Missing { .. })));
    }
}
