//! `hray convert`.

use crate::args::ConvertArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::job;
use hray::{Destination, Error, Input, Language, LoadOptions, Quoted};
use std::path::Path;

/// Writes a classic scene, or one that shows a file of meshes, in hry.
pub(crate) fn run(arguments: &ConvertArgs, console: &Console) -> Result<(), Failure> {
    let input = Input::from_argument(arguments.input.clone());
    let output = arguments.output.as_deref().filter(|output| output.as_os_str() != "-");
    if let Some(output) = output.filter(|output| hray::same_file(output, input.path())) {
        return Err(Failure::Usage(format!(
            "the new scene would replace the old one, {}; choose another name for it",
            Quoted(output)
        )));
    }
    if let Some(text) = hray::model_scene(&input).map_err(Error::from)? {
        return write(&text, output, console);
    }
    let file = hray::SceneFile::read(&input, &LoadOptions::default()).map_err(Error::from)?;
    if file.language() == Language::Hry && file.errors() == 0 {
        return Err(Failure::Wrong(format!(
            "{} is a scene in hry already",
            Quoted(Path::new(&input.name()))
        )));
    }
    console.say(job::report(&file, console));
    let text = hray::convert(job::description(&file)?).ok_or_else(|| {
        Failure::Wrong("the scene has numbers that are not finite, which hry has no notation for".to_owned())
    })?;
    write(&text, output, console)
}

fn write(text: &str, output: Option<&Path>, console: &Console) -> Result<(), Failure> {
    match output {
        None => console.print(text.as_bytes()).map_err(|error| Failure::stdout(&error)),
        Some(output) => {
            let destination = Destination::file(output).map_err(Error::from)?;
            Ok(hray::write_text(&destination, text).map_err(Error::from)?)
        }
    }
}
