//! What scenes read besides their own text: files in one folder.

use crate::{Image, Input, InputError, Model};
use hray_io::{Folder, FolderError};
use hray_lang::hry::assets::{AssetError, Assets};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf, is_separator};
use std::sync::{Arc, Mutex, PoisonError};

/// What an hry scene is called that has no path.
const NO_PATH: &str = "scene.hry";

/// The files of a folder, or none for a scene that is in no file.
#[derive(Debug)]
pub(crate) struct FolderAssets {
    folder: Option<Folder>,
    names: Names,
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
            (Some(inside), _) => {
                let names = Names::beside(&path.to_string_lossy(), &inside);
                Ok((Self::new(Some(folder), names), inside))
            }
            (None, Some(root)) => Err(InputError::OutsideRoot { path: path.clone(), root: root.to_owned() }),
            // Only what is no ordinary file, or has a name that is not UTF-8.
            (None, None) => Ok((Self::new(Some(folder), Names::default()), NO_PATH.to_owned())),
        }
    }

    /// What a scene may read that is in no file: a folder where one is given.
    pub(crate) fn without_file(root: Option<&Path>) -> Result<(Self, String), InputError> {
        let names = root.map_or_else(Names::default, |root| Names::inside(&root.to_string_lossy()));
        Ok((Self::new(root.map(Folder::open).transpose()?, names), NO_PATH.to_owned()))
    }

    /// Nothing to read.
    pub(crate) fn nothing() -> Self {
        Self::new(None, Names::default())
    }

    fn new(folder: Option<Folder>, names: Names) -> Self {
        Self { folder, names, images: Mutex::default(), models: Mutex::default() }
    }

    /// The images and meshes that were read so far: the paths that lead to them from anywhere.
    pub(crate) fn assets_read(&self) -> Vec<PathBuf> {
        let images = self.images.lock().unwrap_or_else(PoisonError::into_inner);
        let models = self.models.lock().unwrap_or_else(PoisonError::into_inner);
        let full =
            |folder: &Folder| images.keys().chain(models.keys()).map(|path| folder.full_path(path)).collect();
        self.folder.as_ref().map_or_else(Vec::new, full)
    }

    fn folder(&self) -> Result<&Folder, AssetError> {
        self.folder.as_ref().ok_or_else(|| {
            let reason = "the scene is in no file, so there is no folder to read it from; give one with `--root FOLDER`";
            AssetError::Unreadable(reason.to_owned())
        })
    }
}

/// What a scene reads from.
#[derive(Debug)]
pub(crate) enum SceneAssets {
    /// A folder.
    Folder(FolderAssets),
    /// Whatever the caller has.
    Given(Given),
}

/// Assets of the caller's.
pub(crate) struct Given(pub(crate) Arc<dyn Assets + Send + Sync>);

impl std::fmt::Debug for Given {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Given").finish_non_exhaustive()
    }
}

impl SceneAssets {
    pub(crate) fn get(&self) -> &dyn Assets {
        match self {
            Self::Folder(folder) => folder,
            Self::Given(Given(given)) => &**given,
        }
    }

    /// The images and meshes that were read so far, where these lie in a folder.
    pub(crate) fn assets_read(&self) -> Vec<PathBuf> {
        match self {
            Self::Folder(folder) => folder.assets_read(),
            Self::Given(_) => Vec::new(),
        }
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

    fn name(&self, path: &str) -> String {
        self.names.of(path)
    }
}

/// How the files of a folder are called: by paths that lead to them from where the program was started.
#[derive(Debug, Default)]
struct Names {
    /// The path, as the user writes it, of a folder that lies in the root folder or is it; with a slash where not empty.
    known: String,
    /// Where in the root folder that one is, folder by folder.
    inside: Vec<String>,
}

impl Names {
    /// For the root folder at a path.
    fn inside(root: &str) -> Self {
        let slash = if root.is_empty() || root.ends_with(is_separator) { "" } else { "/" };
        Self { known: if root == "." { String::new() } else { format!("{root}{slash}") }, inside: Vec::new() }
    }

    /// For the folder in which the file that the user calls `written` is `path`.
    fn beside(written: &str, path: &str) -> Self {
        let mut inside: Vec<String> = path.split('/').map(str::to_owned).collect();
        inside.pop();
        let mut known = written.get(..written.rfind(is_separator).map_or(0, |slash| slash + 1)).unwrap_or("");
        // What the two end in alike needs no way back: where `scenes` is the folder of `a/scenes/b.hry`, it is `a/` that
        // the folder around is called, and not `a/scenes/../`.
        while let Some(before) = inside.last().and_then(|name| {
            let before = known.strip_suffix(is_separator)?.strip_suffix(name.as_str())?;
            (before.is_empty() || before.ends_with(is_separator)).then_some(before)
        }) {
            known = before;
            inside.pop();
        }
        Self { known: known.to_owned(), inside }
    }

    fn of(&self, path: &str) -> String {
        let parts: Vec<&str> = path.split('/').collect();
        let alike = self.inside.iter().zip(&parts).take_while(|(a, b)| a == *b).count();
        let back = "../".repeat(self.inside.len() - alike);
        format!("{}{back}{}", self.known, parts.get(alike..).unwrap_or(&[]).join("/"))
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

#[cfg(test)]
mod tests {
    use super::Names;

    #[test]
    fn files_are_called_by_paths_that_lead_to_them() {
        let name = |written, path, other| Names::beside(written, path).of(other);
        assert_eq!(name("use.hry", "use.hry", "parts/palette.hry"), "parts/palette.hry");
        assert_eq!(name("parts/use.hry", "use.hry", "palette.hry"), "parts/palette.hry");
        assert_eq!(name("./use.hry", "use.hry", "palette.hry"), "./palette.hry");
        assert_eq!(name("a/deep/use.hry", "deep/use.hry", "palette.hry"), "a/palette.hry");
        assert_eq!(name("/a/deep/use.hry", "a/deep/use.hry", "palette.hry"), "/palette.hry");
        // The root is further up than where the user is.
        assert_eq!(name("use.hry", "deep/use.hry", "palette.hry"), "../palette.hry");
        assert_eq!(name("use.hry", "a/deep/use.hry", "a/palette.hry"), "../palette.hry");
        assert_eq!(name("use.hry", "a/deep/use.hry", "a/deep/x/y.hry"), "x/y.hry");
        assert_eq!(name("link/use.hry", "deep/use.hry", "palette.hry"), "link/../palette.hry");
        for (root, name) in
            [("", "p.hry"), (".", "p.hry"), ("a", "a/p.hry"), ("a/", "a/p.hry"), ("..", "../p.hry")]
        {
            assert_eq!(Names::inside(root).of("p.hry"), name, "{root}");
        }
    }
}
