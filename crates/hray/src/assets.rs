//! What scenes read besides their own text: files in one folder.

use crate::{Image, Input, InputError, LoadOptions, MAX_SOURCE_BYTES};
use hray_io::{Folder, FolderError};
use hray_lang::hry::assets::{AssetError, Assets};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// What an hry scene is called that has no path.
const NO_PATH: &str = "scene.hry";

/// The files of a folder, or none for a scene that is in no file.
#[derive(Debug)]
pub(crate) struct FolderAssets {
    folder: Option<Folder>,
    /// Images that were read already, by their paths.
    images: Mutex<BTreeMap<String, Arc<Image>>>,
}

impl FolderAssets {
    /// What a scene may read, and the scene's own path in it: the folder that was asked for, else the one that the scene
    /// lies in.
    pub(crate) fn of(input: &Input, options: &LoadOptions) -> Result<(Self, String), InputError> {
        let Input::File(path) = input else { return Self::without_file(options.root.as_deref()) };
        let folder = match &options.root {
            Some(root) => Folder::new(root)?,
            None => Folder::around(path)?,
        };
        match (folder.relative(path), &options.root) {
            (Some(inside), _) => Ok((Self::new(Some(folder)), inside)),
            (None, Some(root)) => Err(InputError::OutsideRoot { path: path.clone(), root: root.clone() }),
            // A path without a last part was read as a file, so this is a device.
            (None, None) => Ok((Self::new(None), NO_PATH.to_owned())),
        }
    }

    /// What a scene may read that is in no file: a folder where one is given.
    pub(crate) fn without_file(root: Option<&Path>) -> Result<(Self, String), InputError> {
        Ok((Self::new(root.map(Folder::new).transpose()?), NO_PATH.to_owned()))
    }

    fn new(folder: Option<Folder>) -> Self {
        Self { folder, images: Mutex::default() }
    }

    fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, AssetError> {
        let Some(folder) = &self.folder else {
            let reason = "the scene is in no file, so there is no folder to read it from; give one with `--root FOLDER`";
            return Err(AssetError::Unreadable(reason.to_owned()));
        };
        folder.read(path, limit).map_err(|error| match error {
            FolderError::Missing => AssetError::NotFound,
            FolderError::Outside => AssetError::Outside,
            other => AssetError::Unreadable(other.to_string()),
        })
    }
}

impl Assets for FolderAssets {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        String::from_utf8(self.read(path, MAX_SOURCE_BYTES)?)
            .map_err(|_| AssetError::Unreadable("it is not UTF-8 text".to_owned()))
    }

    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError> {
        if let Some(image) = self.images.lock().unwrap_or_else(PoisonError::into_inner).get(path) {
            return Ok(image.clone());
        }
        let bytes = self.read(path, hray_io::MAX_IMAGE_BYTES)?;
        let image = hray_io::decode_image(&bytes, Path::new(path));
        let image = Arc::new(image.map_err(|error| AssetError::Unreadable(error.to_string()))?);
        let mut images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        images.insert(path.to_owned(), image.clone());
        Ok(image)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        self.folder.as_ref().map_or_else(Vec::new, |folder| folder.beside(path))
    }
}
