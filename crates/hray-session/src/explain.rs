//! Why a pixel has the colour that it has.

use crate::protocol::Refusal;
use crate::scene::Work;
use hray::{Control, Options};
use serde_json::Value;
use std::sync::Arc;

impl Work {
    /// Explains a pixel of the picture in the scene's own size, as `hray explain --json` does.
    ///
    /// # Errors
    /// Where the scene has errors, where there is no such pixel, and after [`Control::cancel`].
    pub fn explain(&self, x: u32, y: u32, control: &Control) -> Result<Value, Refusal> {
        let stopped = || Refusal::new("it was stopped");
        let file = self.scene_file(&Arc::default()).ok_or_else(stopped)?;
        if file.description().is_none() {
            let message = "the scene has errors, so there is no picture of it";
            return Err(Refusal::new(message).with_help("mend them first"));
        }
        let explained = hray::explain(&file, &Options::default(), x, y, control);
        let explained = explained.map_err(|error| Refusal::new(error.to_string()))?;
        serde_json::to_value(explained).map_err(|error| Refusal::new(error.to_string()))
    }
}
