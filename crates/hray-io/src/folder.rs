//! A folder that files are read from, and nothing outside of it.

use crate::source::read_bounded;
use crate::{FolderError, InputError};
use std::fs::{self, File};
use std::io;
use std::path::{Component, Path, PathBuf};

/// So many names of a folder are looked at.
const MOST_NAMES: usize = 10_000;

/// A folder with everything below it. Files in it are named by paths relative to it, with slashes.
///
/// What is read lies in the folder once all links are followed; a link that leads out of it is refused.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Absolute, without links.
    root: PathBuf,
}

impl Folder {
    /// The folder at a path; the current one where that is empty.
    ///
    /// # Errors
    /// [`InputError`] where there is none.
    pub fn new(path: &Path) -> Result<Self, InputError> {
        let root = match or_here(path).canonicalize() {
            Ok(root) => root,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(InputError::NoFolder { path: path.to_owned() });
            }
            Err(source) => return Err(InputError::Io { path: path.to_owned(), source }),
        };
        if root.is_dir() { Ok(Self { root }) } else { Err(InputError::NoFolder { path: path.to_owned() }) }
    }

    /// The folder that a file lies in. A link counts as lying where the link lies.
    ///
    /// # Errors
    /// As [`Folder::new`].
    pub fn around(file: &Path) -> Result<Self, InputError> {
        Self::new(file.parent().unwrap_or(Path::new("")))
    }

    /// The path of a file relative to this folder; none where it does not lie in it.
    #[must_use]
    pub fn relative(&self, file: &Path) -> Option<String> {
        let around = or_here(file.parent()?).canonicalize().ok()?;
        let inside = around.strip_prefix(&self.root).ok()?.join(file.file_name()?);
        let parts: Vec<_> = inside.components().map(|part| part.as_os_str().to_string_lossy()).collect();
        Some(parts.join("/"))
    }

    /// Reads all of a file, `limit` bytes at most.
    ///
    /// # Errors
    /// [`FolderError`] where there is no such file inside the folder, it is longer, or the system refuses.
    pub fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, FolderError> {
        let path = self.find(path)?;
        // Asked before opening, which waits for a writer where the file is a named pipe.
        let metadata = fs::metadata(&path).map_err(from_io)?;
        if !metadata.is_file() {
            return Err(FolderError::NoFile);
        }
        if metadata.len() > limit {
            return Err(FolderError::TooLarge(limit));
        }
        let file = File::open(&path).map_err(from_io)?;
        read_bounded(file, &path, limit).map_err(|error| match error {
            InputError::TooLarge { limit, .. } => FolderError::TooLarge(limit),
            InputError::Io { source, .. } => FolderError::Io(source),
            _ => FolderError::Missing,
        })
    }

    /// The paths of what lies beside a file (that need not exist), in alphabetical order; of a very large folder only
    /// some.
    #[must_use]
    pub fn beside(&self, path: &str) -> Vec<String> {
        let (folder, prefix) = match path.rsplit_once('/') {
            Some((folder, _)) => (folder, format!("{folder}/")),
            None => ("", String::new()),
        };
        let Ok(entries) = self.find(folder).and_then(|folder| fs::read_dir(folder).map_err(from_io)) else {
            return Vec::new();
        };
        let names = entries.take(MOST_NAMES).filter_map(|entry| entry.ok()?.file_name().into_string().ok());
        let mut paths: Vec<String> = names.map(|name| format!("{prefix}{name}")).collect();
        paths.sort_unstable();
        paths
    }

    /// Where a path leads, links followed, if that is inside.
    fn find(&self, path: &str) -> Result<PathBuf, FolderError> {
        let path = Path::new(path);
        if !path.components().all(|part| matches!(part, Component::Normal(_))) {
            return Err(FolderError::Outside);
        }
        let found = self.root.join(path).canonicalize().map_err(from_io)?;
        if found.starts_with(&self.root) { Ok(found) } else { Err(FolderError::Outside) }
    }
}

fn from_io(error: io::Error) -> FolderError {
    match error.kind() {
        io::ErrorKind::NotFound => FolderError::Missing,
        _ => FolderError::Io(error),
    }
}

fn or_here(path: &Path) -> &Path {
    if path.as_os_str().is_empty() { Path::new(".") } else { path }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(folder: &Folder, path: &str) -> Result<String, String> {
        let bytes = folder.read(path, 100).map_err(|error| error.to_string())?;
        String::from_utf8(bytes).map_err(|error| error.to_string())
    }

    #[test]
    fn files_inside_are_read_and_nothing_else() {
        let directory = tempfile::tempdir().unwrap();
        let inside = directory.path().join("in");
        fs::create_dir_all(inside.join("sub")).unwrap();
        fs::write(directory.path().join("secret"), "secret").unwrap();
        fs::write(inside.join("a"), "a").unwrap();
        fs::write(inside.join("sub/b"), "b").unwrap();
        fs::write(inside.join("long"), [b'x'; 101]).unwrap();
        let folder = Folder::new(&inside).unwrap();
        assert_eq!((text(&folder, "a"), text(&folder, "sub/b")), (Ok("a".into()), Ok("b".into())));
        for outside in ["../secret", "sub/../../secret", "/etc/hostname", "./../secret"] {
            assert!(matches!(folder.read(outside, 100), Err(FolderError::Outside)), "{outside}");
        }
        assert!(matches!(folder.read("none", 100), Err(FolderError::Missing)));
        assert!(matches!(folder.read("sub", 100), Err(FolderError::NoFile)));
        assert!(matches!(folder.read("long", 100), Err(FolderError::TooLarge(100))));
        assert_eq!(folder.beside("x"), ["a", "long", "sub"]);
        assert_eq!(folder.beside("sub/x"), ["sub/b"]);
        assert_eq!((folder.beside("none/x"), folder.beside("../x")), (vec![], vec![]));
    }

    #[test]
    fn a_scene_has_a_path_in_its_folder_and_in_those_above() {
        let directory = tempfile::tempdir().unwrap();
        fs::create_dir_all(directory.path().join("in/sub")).unwrap();
        let scene = directory.path().join("in/sub/scene.hry");
        let relative = |root: &str| Folder::new(&directory.path().join(root)).unwrap().relative(&scene);
        assert_eq!(Folder::around(&scene).unwrap().relative(&scene).as_deref(), Some("scene.hry"));
        assert_eq!(relative("in").as_deref(), Some("sub/scene.hry"));
        fs::create_dir(directory.path().join("other")).unwrap();
        assert_eq!(relative("other"), None);
        assert!(Folder::new(&scene).is_err());
        assert!(Folder::new(Path::new("")).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_only_inside() {
        use std::os::unix::fs::symlink;
        let directory = tempfile::tempdir().unwrap();
        let inside = directory.path().join("in");
        fs::create_dir_all(inside.join("sub")).unwrap();
        fs::write(directory.path().join("secret"), "secret").unwrap();
        fs::write(inside.join("a"), "a").unwrap();
        symlink("../a", inside.join("sub/good")).unwrap();
        symlink("../secret", inside.join("bad")).unwrap();
        symlink("..", inside.join("up")).unwrap();
        symlink("circle", inside.join("circle")).unwrap();
        symlink(&inside, directory.path().join("way")).unwrap();
        let folder = Folder::new(&directory.path().join("way")).unwrap();
        assert_eq!(text(&folder, "sub/good"), Ok("a".into()));
        assert!(matches!(folder.read("bad", 100), Err(FolderError::Outside)));
        assert!(matches!(folder.read("up/secret", 100), Err(FolderError::Outside)));
        assert!(folder.read("circle", 100).is_err());
        assert!(folder.beside("up/x").is_empty());
        assert_eq!(folder.relative(&directory.path().join("way/sub/s.hry")).as_deref(), Some("sub/s.hry"));
    }
}
