//! Where a picture is to go, found out before any of it is made.

use crate::OutputError;
use crate::output::Output;
use std::fs::{self, File, OpenOptions, Permissions};
use std::io;
use std::path::{Path, PathBuf};

/// How many links are followed before they are taken for a circle; what Linux allows.
const MAX_LINKS: u32 = 40;

/// A place for a picture that can be expected to take it.
///
/// A regular file is replaced as a whole, keeping its permissions; a link to one stays, and the file it leads
/// to is replaced. (Other hard links keep the old content.) What is no regular file, such as `/dev/null` or a
/// named pipe, is written to and never replaced.
#[derive(Debug)]
pub struct Destination {
    /// The path as it was given, for messages.
    name: PathBuf,
    place: Place,
}

#[derive(Debug)]
enum Place {
    Stdout,
    /// A device, a pipe, or a descriptor of this process.
    Direct,
    /// The final path, links followed, and the permissions of what is there now.
    Replace(PathBuf, Option<Permissions>),
}

impl Destination {
    /// The standard output.
    #[must_use]
    pub fn stdout() -> Self {
        Self { name: PathBuf::from("-"), place: Place::Stdout }
    }

    /// A file.
    ///
    /// # Errors
    /// [`OutputError`] where it is a directory, where there is no directory for it, and where the system does
    /// not let it be written.
    pub fn file(path: &Path) -> Result<Self, OutputError> {
        if path == Path::new("/dev/stdout") {
            return Ok(Self { name: path.to_owned(), place: Place::Stdout });
        }
        let place = place_of(path).map_err(|source| match source.kind() {
            io::ErrorKind::IsADirectory => OutputError::Directory { path: path.to_owned() },
            _ => OutputError::Io { path: path.to_owned(), source },
        })?;
        if let Place::Replace(target, _) = &place {
            let directory = parent(target);
            if !fs::metadata(directory).is_ok_and(|metadata| metadata.is_dir()) {
                return Err(OutputError::NoDirectory {
                    path: path.to_owned(),
                    directory: directory.to_owned(),
                });
            }
        }
        Ok(Self { name: path.to_owned(), place })
    }

    /// Whether what is written there can no longer be taken back: anything but a regular file.
    #[must_use]
    pub fn is_direct(&self) -> bool {
        !matches!(self.place, Place::Replace(..))
    }

    /// Whether it is the standard output.
    #[must_use]
    pub fn is_stdout(&self) -> bool {
        matches!(self.place, Place::Stdout)
    }

    /// The path as it was given; `-` for the standard output.
    pub(crate) fn name(&self) -> &Path {
        &self.name
    }

    pub(crate) fn open(&self) -> io::Result<Output> {
        match &self.place {
            Place::Stdout => Ok(Output::stream(Box::new(io::stdout()))),
            Place::Direct => {
                let file = OpenOptions::new().write(true).truncate(true).open(&self.name)?;
                Ok(Output::stream(Box::new(file)))
            }
            Place::Replace(target, permissions) => {
                let mut builder = tempfile::Builder::new();
                builder.prefix(".hray-").suffix(".tmp");
                // What a newly made file gets: all that the umask leaves of this. (The crate's default is
                // for secrets, readable by nobody else.)
                #[cfg(unix)]
                builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
                let (file, temporary) = builder.tempfile_in(parent(target))?.into_parts();
                if let Some(permissions) = permissions {
                    file.set_permissions(permissions.clone())?;
                }
                Ok(Output::replacing(file, temporary, target.clone()))
            }
        }
    }
}

/// Makes a folder for pictures, and those it lies in, where they are missing. The empty path is the current one.
///
/// # Errors
/// [`OutputError::Io`] where the system refuses, or there is a file of that name.
pub fn create_folder(path: &Path) -> Result<(), OutputError> {
    if path.as_os_str().is_empty() {
        return Ok(());
    }
    fs::create_dir_all(path).map_err(|source| OutputError::Io { path: path.to_owned(), source })
}

/// Follows links, and sees what is there.
fn place_of(path: &Path) -> io::Result<Place> {
    let mut target = path.to_owned();
    for _ in 0..=MAX_LINKS {
        if target.as_os_str().is_empty() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "a file needs a name"));
        }
        let metadata = match fs::symlink_metadata(&target) {
            Ok(metadata) => metadata,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return if written_as_directory(&target) {
                    Err(directory())
                } else {
                    Ok(Place::Replace(target, None))
                };
            }
            Err(error) => return Err(error),
        };
        if metadata.is_symlink() {
            if is_descriptor(&target) {
                return Ok(Place::Direct);
            }
            target = parent(&target).join(fs::read_link(&target)?);
        } else if metadata.is_dir() {
            return Err(directory());
        } else if metadata.is_file() {
            // Replacing a file asks for no right on the file itself; whoever protected it meant it.
            File::options().write(true).open(&target)?;
            return Ok(Place::Replace(target, Some(metadata.permissions())));
        } else {
            return Ok(Place::Direct);
        }
    }
    Err(io::Error::other("its links lead in a circle"))
}

fn directory() -> io::Error {
    io::Error::from(io::ErrorKind::IsADirectory)
}

/// The directory of a file; that of a bare name is the current one.
fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Whether a path ends as only a directory's does.
fn written_as_directory(path: &Path) -> bool {
    path.file_name().is_none() || path.as_os_str().as_encoded_bytes().last().is_some_and(|&b| b == b'/')
}

/// Whether a link is one of those under `/proc/self/fd`, which are no places in a directory but files that
/// are open already, such as the other end of a shell's `>(...)`.
fn is_descriptor(link: &Path) -> bool {
    parent(link)
        .canonicalize()
        .is_ok_and(|directory| directory.starts_with("/proc") && directory.ends_with("fd"))
}
