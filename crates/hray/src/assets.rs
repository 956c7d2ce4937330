//! What scenes read besides their own text: files in one folder.

use crate::{Image, Input, InputError, Model};
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
    /// Files of meshes, too.
    models: Mutex<BTreeMap<String, Arc<Model>>>,
}

impl FolderAssets {
    /// What a scene may read, and the scene's own path in it: the folder that was asked for, else the one that the scene
    /// lies in.
    pub(crate) fn of(input: &Input, root: Option<&Path>) -> Result<(Self, String), InputError> {
        let Input::File(path) = input else { return Self::without_file(root) };
        let folder = Folder::open(root.or(path.parent()).unwrap_or(Path::new("")))?;
        match (folder.path_to(path), root) {
            (Some(inside), _) => Ok((Self::new(Some(folder)), inside)),
            (None, Some(root)) => Err(InputError::OutsideRoot { path: path.clone(), root: root.to_owned() }),
            // Only what is no ordinary file, or has a name that is not UTF-8.
            (None, None) => Ok((Self::new(Some(folder)), NO_PATH.to_owned())),
        }
    }

    /// What a scene may read that is in no file: a folder where one is given.
    pub(crate) fn without_file(root: Option<&Path>) -> Result<(Self, String), InputError> {
        Ok((Self::new(root.map(Folder::open).transpose()?), NO_PATH.to_owned()))
    }

    /// Nothing to read.
    pub(crate) fn nothing() -> Self {
        Self::new(None)
    }

    fn new(folder: Option<Folder>) -> Self {
        Self { folder, images: Mutex::default(), models: Mutex::default() }
    }

    fn folder(&self) -> Result<&Folder, AssetError> {
        self.folder.as_ref().ok_or_else(|| {
            let reason = "the scene is in no file, so there is no folder to read it from; give one with `--root FOLDER`";
            AssetError::Unreadable(reason.to_owned())
        })
    }
}

impl Assets for FolderAssets {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        let bytes = self.folder()?.read(path).map_err(unavailable)?;
        String::from_utf8(bytes).map_err(|_| AssetError::Unreadable("it is not UTF-8 text".to_owned()))
    }

    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError> {
        if let Some(image) = self.images.lock().unwrap_or_else(PoisonError::into_inner).get(path) {
            return Ok(image.clone());
        }
        let image = Arc::new(self.folder()?.image(path).map_err(unavailable)?);
        let mut images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        images.insert(path.to_owned(), image.clone());
        Ok(image)
    }

    fn model(&self, path: &str) -> Result<Arc<Model>, AssetError> {
        if let Some(model) = self.models.lock().unwrap_or_else(PoisonError::into_inner).get(path) {
            return Ok(model.clone());
        }
        let model = Arc::new(self.folder()?.model(path).map_err(unavailable)?);
        let mut models = self.models.lock().unwrap_or_else(PoisonError::into_inner);
        models.insert(path.to_owned(), model.clone());
        Ok(model)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        self.folder.as_ref().map_or_else(Vec::new, |folder| folder.neighbours(path))
    }
}

fn unavailable(error: FolderError) -> AssetError {
    match error {
        FolderError::Missing => AssetError::NotFound,
        FolderError::Outside => AssetError::Outside,
        FolderError::Input(error) => AssetError::Unreadable(error.reason()),
        _ => AssetError::Unreadable("it is not to be had".to_owned()),
    }
}
