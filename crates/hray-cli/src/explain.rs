//! `hray explain`.

use crate::args::ExplainArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::{animate, explain_text, interrupt, job};
use hray::{Control, Input, Options};
use std::sync::Arc;

/// Explains a pixel.
pub(crate) fn run(arguments: &ExplainArgs, console: &Console) -> Result<(), Failure> {
    let input = Input::from_argument(arguments.input.clone());
    let load = arguments.scene.options(&arguments.lints.levels, arguments.time.unwrap_or(0.0));
    let file = job::read_scene(&input, &load, console)?;
    if arguments.time.is_some() {
        animate::warn_of_a_still(&file, console, "every moment of it is the same");
    }
    let options = Options {
        size: arguments.size,
        max_depth: arguments.depth,
        samples: arguments.samples,
        region: None,
        threads: None,
        noise_tables: job::noise_tables(&arguments.common)?,
    };
    let description = job::description(&file)?;
    let control = Arc::new(Control::new());
    interrupt::stops(&control);
    let explanation = hray::explain(&file, &options, arguments.x, arguments.y, &control)?;
    let text = if arguments.json {
        let value = serde_json::to_value(&explanation)
            .map_err(|error| Failure::Wrong(format!("cannot write JSON: {error}")))?;
        format!("{value:#}\n")
    } else {
        explain_text::of(&explanation, description, file.is_animated(), arguments.all)
    };
    console.print(text.as_bytes()).map_err(|error| Failure::stdout(&error))
}
