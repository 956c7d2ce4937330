//! Whether two names lead to one file.

use std::path::Path;

/// Whether two paths lead to the same regular file, through whatever links. A path that leads nowhere is the
/// same as none; devices and pipes, which writing does not destroy, are never "the same".
#[must_use]
pub fn same_file(a: &Path, b: &Path) -> bool {
    match (std::fs::metadata(a), std::fs::metadata(b)) {
        (Ok(x), Ok(y)) if x.is_file() && y.is_file() => same(a, &x, b, &y),
        _ => false,
    }
}

#[cfg(unix)]
fn same(_: &Path, x: &std::fs::Metadata, _: &Path, y: &std::fs::Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (x.dev(), x.ino()) == (y.dev(), y.ino())
}

#[cfg(not(unix))]
fn same(a: &Path, _: &std::fs::Metadata, b: &Path, _: &std::fs::Metadata) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(x), Ok(y)) if x == y)
}
