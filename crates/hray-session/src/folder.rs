//! A folder on the disk as the files of a session.

use crate::files::{Files, MOST_FILES, kind_of, kind_of_text};
use crate::protocol::{FileEntry, FileKind, Refusal};
use hray::{AssetError, Assets, FileStamp, Folder, FolderError, Image, InputError, Model};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// How much of images and meshes is kept that the last scenes used, in bytes about.
const MOST_KEPT: usize = 1 << 30;

/// The files of one folder. Images and meshes are read again only where they changed.
#[derive(Debug)]
pub struct FolderFiles {
    folder: Folder,
    name: String,
    images: Mutex<Kept<Image>>,
    models: Mutex<Kept<Model>>,
    /// What kind of scene the files were when they were looked at last.
    kinds: Mutex<BTreeMap<String, (Option<FileStamp>, FileKind)>>,
}

impl FolderFiles {
    /// The folder at a path.
    ///
    /// # Errors
    /// [`InputError`] where there is none, or it may not be entered.
    pub fn open(path: &Path) -> Result<Self, InputError> {
        let folder = Folder::open(path)?;
        let name = folder.full_path("").to_string_lossy().trim_end_matches('/').to_owned();
        let (images, models, kinds) = (Mutex::default(), Mutex::default(), Mutex::default());
        Ok(Self { folder, name, images, models, kinds })
    }

    /// The folder itself.
    #[must_use]
    pub const fn folder(&self) -> &Folder {
        &self.folder
    }

    /// Reads images and meshes anew when they are asked for next: what they name themselves may have changed.
    pub fn forget(&self) {
        self.images.lock().unwrap_or_else(PoisonError::into_inner).entries.clear();
        self.models.lock().unwrap_or_else(PoisonError::into_inner).entries.clear();
    }
}

/// What was read, as long as its file does not change.
#[derive(Debug)]
struct Kept<T> {
    entries: BTreeMap<String, Entry<T>>,
    clock: u64,
}

#[derive(Debug)]
struct Entry<T> {
    stamp: Option<FileStamp>,
    value: Arc<T>,
    bytes: usize,
    used: u64,
}

impl<T> Default for Kept<T> {
    fn default() -> Self {
        Self { entries: BTreeMap::new(), clock: 0 }
    }
}

impl<T> Kept<T> {
    fn get(&mut self, path: &str, stamp: Option<FileStamp>) -> Option<Arc<T>> {
        self.clock += 1;
        let entry = self.entries.get_mut(path).filter(|entry| stamp.is_some() && entry.stamp == stamp)?;
        entry.used = self.clock;
        Some(entry.value.clone())
    }

    /// Keeps a value, and lets go of those that were not used for longest where there is too much.
    fn put(&mut self, path: &str, stamp: Option<FileStamp>, value: Arc<T>, bytes: usize) {
        self.entries.insert(path.to_owned(), Entry { stamp, value, bytes, used: self.clock });
        while self.entries.len() > 1
            && self.entries.values().map(|entry| entry.bytes).sum::<usize>() > MOST_KEPT
        {
            let oldest =
                self.entries.iter().min_by_key(|(_, entry)| entry.used).map(|(path, _)| path.clone());
            let Some(oldest) = oldest else { return };
            self.entries.remove(&oldest);
        }
    }
}

impl Assets for FolderFiles {
    fn text(&self, path: &str) -> Result<String, AssetError> {
        let bytes = self.folder.read(path).map_err(unavailable)?;
        String::from_utf8(bytes).map_err(|_| AssetError::Unreadable("it is not UTF-8 text".to_owned()))
    }

    fn image(&self, path: &str) -> Result<Arc<Image>, AssetError> {
        let stamp = self.folder.stamp(path);
        if let Some(image) = self.images.lock().unwrap_or_else(PoisonError::into_inner).get(path, stamp) {
            return Ok(image);
        }
        let image = Arc::new(self.folder.image(path).map_err(unavailable)?);
        let bytes = size_of_val(image.pixels());
        let mut images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        images.put(path, stamp, image.clone(), bytes);
        Ok(image)
    }

    fn model(&self, path: &str) -> Result<Arc<Model>, AssetError> {
        let stamp = self.folder.stamp(path);
        if let Some(model) = self.models.lock().unwrap_or_else(PoisonError::into_inner).get(path, stamp) {
            return Ok(model);
        }
        let model = Arc::new(self.folder.model(path).map_err(unavailable)?);
        let bytes = model.bytes();
        let mut models = self.models.lock().unwrap_or_else(PoisonError::into_inner);
        models.put(path, stamp, model.clone(), bytes);
        Ok(model)
    }

    fn neighbours(&self, path: &str) -> Vec<String> {
        self.folder.neighbours(path)
    }
}

impl Files for FolderFiles {
    fn root(&self) -> String {
        self.name.clone()
    }

    fn list(&self) -> Vec<FileEntry> {
        let mut kinds = self.kinds.lock().unwrap_or_else(PoisonError::into_inner);
        let mut known = std::mem::take(&mut *kinds);
        let entry = |path: String| {
            let kind = match kind_of(&path)? {
                FileKind::Scene => {
                    let stamp = self.folder.stamp(&path);
                    let (_, kind) = match known.remove(&path).filter(|(before, _)| *before == stamp) {
                        Some(known) => known,
                        None => (stamp, kind_of_text(&self.text(&path).ok()?)),
                    };
                    kinds.insert(path.clone(), (stamp, kind));
                    kind
                }
                kind => kind,
            };
            Some(FileEntry { path, kind })
        };
        self.folder.below("", 4 * MOST_FILES).into_iter().filter_map(entry).take(MOST_FILES).collect()
    }

    fn write(&self, path: &str, text: &str) -> Result<(), Refusal> {
        self.folder.write(path, text).map_err(|error| {
            Refusal::new(match error {
                FolderError::Missing => format!("the folder of {path:?} does not exist"),
                FolderError::Outside => format!("{path:?} does not lie in the folder that is open"),
                FolderError::Input(error) => format!("{path:?} cannot be written: {}", error.reason()),
                FolderError::Output(error) => error.to_string(),
                _ => format!("{path:?} cannot be written"),
            })
        })
    }

    fn can_save(&self) -> bool {
        true
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
