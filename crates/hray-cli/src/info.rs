//! `hray info`.

use crate::args::InfoArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::summary::{counted, grouped};
use hray::{Error, Input, LintLevels, SceneFile, Summary, WorstCase};
use std::fmt::Write;

/// Shows what is in a scene.
pub(crate) fn run(arguments: &InfoArgs, console: &Console) -> Result<(), Failure> {
    let input = Input::from_argument(arguments.input.clone());
    let file = SceneFile::read(&input, &LintLevels::default()).map_err(Error::from)?;
    let warnings = file.warnings();
    let Some(description) = file.description() else {
        console.say(file.report(console.has_color()));
        return Err(Failure::Told);
    };
    let summary = Summary::of(description);
    let text = if arguments.json {
        json(&input.name(), &summary, warnings)?
    } else {
        // Writing to a string cannot fail.
        let mut text = String::new();
        let _ = write_text(&mut text, &summary, warnings);
        text
    };
    console.print(text.as_bytes()).map_err(|error| Failure::stdout(&error))
}

fn json(name: &str, summary: &Summary, warnings: usize) -> Result<String, Failure> {
    let mut value = serde_json::to_value(summary)
        .map_err(|error| Failure::Wrong(format!("cannot write JSON: {error}")))?;
    if let Some(object) = value.as_object_mut() {
        object.insert("name".to_owned(), name.into());
        object.insert("warnings".to_owned(), warnings.into());
    }
    Ok(format!("{value:#}\n"))
}

fn write_text(out: &mut String, summary: &Summary, warnings: usize) -> std::fmt::Result {
    let Summary { width, height, max_depth, camera, background, objects, materials, .. } = summary;
    let [eye, background] = [camera.eye, *background].map(triple);
    let [window_width, window_height] = camera.window;
    let lights = summary.point_lights + summary.ambient_lights;
    writeln!(out, "resolution   {width} x {height} ({} pixels)", grouped(summary.pixels()))?;
    writeln!(out, "depth        {max_depth}")?;
    writeln!(out, "camera       eye {eye}, window {window_width} x {window_height}")?;
    writeln!(out, "background   {background}")?;
    writeln!(
        out,
        "objects      {} ({}, {})",
        grouped(objects.total as u64),
        counted(objects.spheres, "sphere"),
        counted(objects.planes, "plane")
    )?;
    writeln!(
        out,
        "lights       {} ({} point, {} ambient)",
        grouped(lights as u64),
        summary.point_lights,
        summary.ambient_lights
    )?;
    writeln!(out, "materials    {} reflective, {} transparent", materials.reflective, materials.transparent)?;
    let textures: Vec<String> =
        materials.textures.iter().map(|(name, count)| format!("{count} {name}")).collect();
    writeln!(
        out,
        "textures     {}",
        if textures.is_empty() { "none".to_owned() } else { textures.join(", ") }
    )?;
    if let Some(bounds) = summary.sphere_bounds {
        writeln!(out, "spheres in   {} to {}", triple(bounds.min), triple(bounds.max))?;
    }
    writeln!(out, "worst case   {}", worst_case(&summary.worst_case))?;
    match warnings {
        0 => writeln!(out, "warnings     none"),
        n => writeln!(out, "warnings     {n} (`hray check` shows them)"),
    }
}

fn triple([x, y, z]: [f64; 3]) -> String {
    format!("({x}, {y}, {z})")
}

fn worst_case(worst: &WorstCase) -> String {
    let rays = match worst.rays_per_sample {
        None => "more than 2^64 rays a sample".to_owned(),
        Some(1) => "1 ray a sample".to_owned(),
        Some(n) => format!("{} rays a sample", grouped(n)),
    };
    match worst.branches {
        2 => format!("{rays}: objects that reflect and transmit double the rays with every level of depth"),
        _ => rays,
    }
}
