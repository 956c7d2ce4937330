//! Files appear whole or not at all.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

use hray_core::{Encoding, Rgb};
use hray_io::{Destination, Input, OutputError, PictureFormat, PictureWriter, read_source, same_file};
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

const FORMAT: PictureFormat = PictureFormat::Ppm;
const PICTURE: &[u8] = b"P6\n2 1\n255\n\xff\xff\xff\0\0\0";

fn begun(path: &Path) -> Result<PictureWriter, OutputError> {
    let mut writer = PictureWriter::create(&Destination::file(path)?, FORMAT, 2, 1)?;
    writer.write(&FORMAT.encode(&[Rgb::new(1.0, 1.0, 1.0)], Encoding::Raw))?;
    Ok(writer)
}

fn write(path: &Path) -> Result<(), OutputError> {
    let mut writer = begun(path)?;
    writer.write(&FORMAT.encode(&[Rgb::BLACK], Encoding::Raw))?;
    writer.finish()
}

fn names(directory: &TempDir) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(directory.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_is_there_only_when_it_is_finished() {
    let directory = tempdir().unwrap();
    let path = directory.path().join("a.ppm");
    let mut writer = begun(&path).unwrap();
    assert!(!path.exists());
    writer.write(&FORMAT.encode(&[Rgb::BLACK], Encoding::Raw)).unwrap();
    writer.finish().unwrap();
    assert_eq!(fs::read(&path).unwrap(), PICTURE);
    assert_eq!(names(&directory), ["a.ppm"]);
}

#[test]
fn a_writer_that_is_dropped_leaves_no_trace() {
    let directory = tempdir().unwrap();
    let path = directory.path().join("a.ppm");
    drop(begun(&path).unwrap());
    assert!(names(&directory).is_empty());
    fs::write(&path, "old").unwrap();
    drop(begun(&path).unwrap());
    assert!(begun(&path).unwrap().finish().is_err());
    assert_eq!((fs::read(&path).unwrap(), names(&directory)), (b"old".to_vec(), vec!["a.ppm".to_owned()]));
}

#[test]
fn what_cannot_be_written_is_refused_before_anything_is_made() {
    let directory = tempdir().unwrap();
    let inside = |name: &str| Destination::file(&directory.path().join(name)).map(drop);
    assert!(matches!(inside(""), Err(OutputError::Directory { .. })));
    assert!(matches!(inside("."), Err(OutputError::Directory { .. })));
    assert!(matches!(inside("new/"), Err(OutputError::Directory { .. })));
    assert!(matches!(inside("none/a.ppm"), Err(OutputError::NoDirectory { .. })));
    assert!(matches!(Destination::file(Path::new("")), Err(OutputError::Io { .. })));
    fs::write(directory.path().join("file"), "").unwrap();
    let below = inside("file/a.ppm").unwrap_err().to_string();
    assert!(below.contains("directory"), "{below}");
    let long = inside(&"x".repeat(300)).unwrap_err().to_string();
    assert!(long.contains("too long"), "{long}");
    assert_eq!(names(&directory), ["file"]);
}

#[test]
fn one_file_under_two_names_is_the_same_file() {
    let directory = tempdir().unwrap();
    let (a, b) = (directory.path().join("a"), directory.path().join("b"));
    fs::write(&a, "x").unwrap();
    assert!(same_file(&a, &directory.path().join(".").join("a")));
    assert!(!same_file(&a, &b));
    fs::write(&b, "x").unwrap();
    assert!(!same_file(&a, &b));
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o7777
    }

    #[test]
    fn permissions_are_those_of_an_ordinary_file_or_of_the_one_replaced() {
        let directory = tempdir().unwrap();
        let (ordinary, path) = (directory.path().join("ordinary"), directory.path().join("a.ppm"));
        fs::write(&ordinary, "").unwrap();
        write(&path).unwrap();
        assert_eq!(mode(&path), mode(&ordinary));
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write(&path).unwrap();
        assert_eq!(mode(&path), 0o640);
    }

    #[test]
    fn a_link_stays_and_its_target_is_replaced() {
        let directory = tempdir().unwrap();
        let (target, link) = (directory.path().join("target"), directory.path().join("link"));
        fs::create_dir(directory.path().join("sub")).unwrap();
        let far = directory.path().join("sub/far");
        symlink("target", &link).unwrap();
        symlink("../link", &far).unwrap();
        write(&far).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&target).unwrap(), PICTURE);
        assert!(same_file(&far, &target));
        assert_eq!(names(&directory), ["link", "sub", "target"]);
    }

    #[test]
    fn links_in_a_circle_are_an_error() {
        let directory = tempdir().unwrap();
        let path = directory.path().join("circle");
        symlink("circle", &path).unwrap();
        let error = write(&path).unwrap_err().to_string();
        assert!(error.contains("circle"), "{error}");
    }

    #[test]
    fn a_device_is_written_to_and_stays() {
        let null = Path::new("/dev/null");
        write(null).unwrap();
        assert!(fs::metadata(null).unwrap().file_type().is_char_device());
        if Path::new("/dev/full").exists() {
            let error = write(Path::new("/dev/full")).unwrap_err().to_string();
            assert_eq!(
                error,
                "cannot write `/dev/full`: no space left on device; free some space, or write elsewhere"
            );
        }
    }

    #[test]
    fn endless_input_ends() {
        if Path::new("/dev/zero").exists() {
            let error = hray_io::read_noise_tables(Path::new("/dev/zero")).unwrap_err().to_string();
            assert!(error.contains("longer than 1 MiB"), "{error}");
            let error = read_source(&Input::File("/dev/zero".into())).unwrap_err().to_string();
            assert!(error.contains("longer than 256 MiB"), "{error}");
        }
    }
}
