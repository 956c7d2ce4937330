//! A folder that somebody works in: its scenes with everything that they may read, where texts that are open in an editor
//! count for more than what is on the disk.

use crate::assets::FolderAssets;
use crate::{Image, InputError, Model};
use hray_io::Folder;
use hray_lang::hry::assets::{AssetError, Assets};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// The folder.
#[derive(Debug)]
pub struct WorkFolder {
    folder: Option<Folder>,
    assets: FolderAssets,
}

/// The texts that are open, by their paths from the folder.
pub type OpenTexts = BTreeMap<String, Arc<str>>;

impl WorkFolder {
    /// The folder at a path.
    ///
    /// # Errors
    /// [`InputError`] where there is none, or it may not be entered.
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let (assets, _) = FolderAssets::without_file(Some(path))?;
        Ok(Self { folder: Some(Folder::open(path)?), assets })
    }

    /// No folder, for texts that are in no file.
    #[must_use]
    pub fn nowhere() -> Self {
        Self { folder: None, assets: FolderAssets::nothing() }
    }

    /// The path from this folder to a file, with slashes; none where the file does not lie in it.
    #[must_use]
    pub fn path_to(&self, file: &Path) -> Option<String> {
        self.folder.as_ref()?.path_to(file)
    }

    /// The paths of the scenes in it and in the folders below, at most so many.
    #[must_use]
    pub fn scenes(&self, most: usize) -> Vec<String> {
        self.folder.as_ref().map_or_else(Vec::new, |folder| folder.below(".hry", most))
    }

    /// What its scenes may read.
    #[must_use]
    pub fn with<'a>(&'a self, open: &'a OpenTexts) -> WorkAssets<'a> {
        WorkAssets { folder: self, open }
    }
}

/// What the scenes of a folder may read.
#[derive(Clone, Copy, Debug)]
pub struct WorkAssets<'a> {
    folder: &'a WorkFolder,
    open: &'a OpenTexts,
}

impl Assets for WorkAssets<'_> {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        match self.open.get(path) {
            Some(text) => Ok(text.to_string()),
            None => self.folder.assets.text(path),
        }
    }

    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError> {
        self.folder.assets.image(path)
    }

    fn model(&self, path: &str) -> Result<Arc<Model>, AssetError> {
        self.folder.assets.model(path)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        self.folder.assets.neighbours(path)
    }
}
