//! The library as files, for editors to show.

use hray::ide::library_text;
use hray::{Destination, create_folder, write_text};
use std::env;
use std::path::PathBuf;

/// The folder of the library's files: in the user's own cache.
pub(crate) fn folder() -> PathBuf {
    let var = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let cache = var("XDG_CACHE_HOME")
        .or_else(|| var("LOCALAPPDATA"))
        .or_else(|| var("HOME").map(|home| home.join(".cache")))
        .unwrap_or_else(|| env::temp_dir().join(format!("hray-{}", std::process::id())));
    cache.join("hray").join(concat!("library-", env!("CARGO_PKG_VERSION")))
}

/// The path of a file of the library, which is written where it is missing or has another text. None where that cannot be.
pub(crate) fn file(name: &str) -> Option<PathBuf> {
    let text = library_text(name)?;
    let folder = folder();
    let path = folder.join(format!("{name}.hry"));
    let input = hray::Input::File(path.clone());
    if hray::read_source(&input).is_ok_and(|bytes| bytes == text.as_bytes()) {
        return Some(path);
    }
    create_folder(&folder).ok()?;
    write_text(&Destination::file(&path).ok()?, text).ok()?;
    Some(path)
}
