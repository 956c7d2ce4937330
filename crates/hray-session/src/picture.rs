//! A picture as a file.

use crate::frame::check_size;
use crate::protocol::Refusal;
use crate::scene::Work;
use hray::{Control, Options, PictureFormat};
use std::sync::Arc;

/// A file that is handed to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureFile {
    /// What to call it.
    pub name: String,
    /// What it is called on the web.
    pub mime: &'static str,
    /// As `hray render` writes it.
    pub bytes: Vec<u8>,
}

impl Work {
    /// Renders the picture to the bytes of a file, in the scene's own size.
    ///
    /// # Errors
    /// Where there is no such format, where the scene has errors, where the format cannot hold the picture, and after
    /// [`Control::cancel`].
    pub fn file(&self, format: &str, control: &Control) -> Result<PictureFile, Refusal> {
        let known = PictureFormat::from_name(format);
        let format = known.ok_or_else(|| Refusal::new(format!("there is no picture format {format:?}")))?;
        let stopped = || Refusal::new("the render was stopped");
        let evaluated = self.evaluate(&Arc::default()).ok_or_else(stopped)?;
        let errors = || {
            Refusal::new("the scene has errors, so there is no picture of it").with_help("mend them first")
        };
        let description = evaluated.description.ok_or_else(errors)?;
        check_size(description.resolution)?;
        let made = hray::render_to_bytes(&description, &Options::default(), format, control);
        let (bytes, _) = made.map_err(|error| Refusal::new(error.to_string()))?;
        let name = self.doc.rsplit('/').next().unwrap_or(&self.doc);
        let name = name.strip_suffix(".hry").unwrap_or(name);
        let name = format!("{name}.{}", format.extensions().first().unwrap_or(&"ppm"));
        Ok(PictureFile { name, mime: mime(format), bytes })
    }
}

/// What a format is called on the web.
const fn mime(format: PictureFormat) -> &'static str {
    match format {
        PictureFormat::Png => "image/png",
        PictureFormat::Jpeg => "image/jpeg",
        PictureFormat::WebP => "image/webp",
        PictureFormat::Bmp => "image/bmp",
        PictureFormat::Tiff => "image/tiff",
        PictureFormat::Ppm | PictureFormat::PpmAscii => "image/x-portable-pixmap",
        _ => "application/octet-stream",
    }
}
