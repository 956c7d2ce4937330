//! `hray info`.

use crate::args::InfoArgs;
use crate::console::Console;
use crate::failure::Failure;
use crate::job::READING;
use crate::summary::{counted, grouped};
use hray::{
    CameraSummary, Error, Input, Language, LintLevels, Meshes, Objects, SceneFile, Summary, WorstCase,
};
use std::fmt::Write;

/// Shows what is in a scene.
pub(crate) fn run(arguments: &InfoArgs, console: &Console) -> Result<(), Failure> {
    let input = Input::from_argument(arguments.input.clone());
    let load = arguments.scene.options(&LintLevels::default(), arguments.time.unwrap_or(0.0));
    let file = console.with_patience(READING, || SceneFile::read(&input, &load)).map_err(Error::from)?;
    let Some(description) = file.description() else {
        console.say(file.report(console.has_color()));
        return Err(Failure::Told);
    };
    let summary = Summary::of(description);
    let text = if arguments.json {
        json(&input.name(), &summary, &file)?
    } else {
        // Writing to a string cannot fail.
        let mut text = String::new();
        let _ = write_text(&mut text, &summary, &file);
        text
    };
    console.print(text.as_bytes()).map_err(|error| Failure::stdout(&error))
}

fn json(name: &str, summary: &Summary, file: &SceneFile) -> Result<String, Failure> {
    let mut value = serde_json::to_value(summary)
        .map_err(|error| Failure::Wrong(format!("cannot write JSON: {error}")))?;
    if let Some(object) = value.as_object_mut() {
        object.insert("name".to_owned(), name.into());
        object.insert("language".to_owned(), language(file).into());
        object.insert("animated".to_owned(), file.is_animated().into());
        object.insert("warnings".to_owned(), file.warnings().into());
    }
    Ok(format!("{value:#}\n"))
}

fn language(file: &SceneFile) -> &'static str {
    match file.language() {
        Language::Classic => "classic",
        Language::Hry => "hry",
    }
}

fn write_text(out: &mut String, summary: &Summary, file: &SceneFile) -> std::fmt::Result {
    let Summary { width, height, max_depth, samples, background, materials, .. } = summary;
    let background = background.map_or_else(|| "a function of the direction".to_owned(), triple);
    let lights = light_kinds(summary);
    let all_lights: usize = lights.iter().map(|(_, count)| count).sum();
    writeln!(out, "resolution   {width} x {height} ({} pixels)", grouped(summary.pixels()))?;
    writeln!(out, "depth        {max_depth}")?;
    let is_hry = file.language() == Language::Hry;
    if is_hry || *samples != 1 {
        writeln!(out, "samples      {samples} a pixel")?;
    }
    if is_hry {
        writeln!(out, "integrator   {}", summary.integrator)?;
        writeln!(out, "encoding     {}", summary.encoding)?;
    }
    if file.is_animated() {
        writeln!(out, "time         {} s (the scene is a function of the time)", summary.time)?;
    }
    writeln!(out, "camera       {}", camera(&summary.camera))?;
    writeln!(out, "background   {background}")?;
    let total = grouped(summary.objects.total as u64);
    writeln!(out, "objects      {total} ({})", objects(&summary.objects))?;
    let kinds: Vec<String> = lights.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    writeln!(out, "lights       {} ({})", grouped(all_lights as u64), kinds.join(", "))?;
    writeln!(out, "materials    {} reflective, {} transparent", materials.reflective, materials.transparent)?;
    let textures: Vec<String> =
        materials.textures.iter().map(|(name, count)| format!("{count} {name}")).collect();
    writeln!(
        out,
        "textures     {}",
        if textures.is_empty() { "none".to_owned() } else { textures.join(", ") }
    )?;
    if summary.functions > 0 {
        writeln!(out, "functions    {}", grouped(summary.functions as u64))?;
    }
    if let Some(meshes) = &summary.meshes {
        write_meshes(out, meshes)?;
    }
    if let Some(bounds) = summary.sphere_bounds {
        writeln!(out, "spheres in   {} to {}", triple(bounds.min), triple(bounds.max))?;
    }
    writeln!(out, "worst case   {}", worst_case(&summary.worst_case))?;
    match file.warnings() {
        0 => writeln!(out, "warnings     none"),
        n => writeln!(out, "warnings     {n} (`hray check` shows them)"),
    }
}

fn write_meshes(out: &mut String, meshes: &Meshes) -> std::fmt::Result {
    let Meshes { triangles, placed_triangles, vertices, bytes, .. } = *meshes;
    let placed = if placed_triangles == triangles {
        String::new()
    } else {
        format!(" ({} where they are placed)", grouped(placed_triangles as u64))
    };
    let (count, triangles, vertices) =
        (grouped(meshes.count as u64), grouped(triangles as u64), grouped(vertices as u64));
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    writeln!(
        out,
        "meshes       {count}: {triangles} triangles{placed}, {vertices} vertices, {mebibytes:.1} MiB"
    )?;
    if let Some(bounds) = meshes.bounds {
        writeln!(out, "meshes in    {} to {}", triple(bounds.min), triple(bounds.max))?;
    }
    Ok(())
}

/// The kinds of light, of which the last two are named only where they occur.
fn light_kinds(summary: &Summary) -> Vec<(&'static str, usize)> {
    let mut kinds = vec![("point", summary.point_lights), ("ambient", summary.ambient_lights)];
    let others = [("directional", summary.directional_lights), ("spot", summary.spot_lights)];
    kinds.extend(others.into_iter().filter(|(_, count)| *count > 0));
    kinds
}

fn objects(objects: &Objects) -> String {
    let mut kinds = vec![counted(objects.spheres, "sphere"), counted(objects.planes, "plane")];
    match objects.boxes {
        0 => {}
        1 => kinds.push("1 box".to_owned()),
        n => kinds.push(format!("{} boxes", grouped(n as u64))),
    }
    if objects.round > 0 {
        kinds.push(format!("{} round", grouped(objects.round as u64)));
    }
    if objects.implicit > 0 {
        kinds.push(format!("{} implicit", grouped(objects.implicit as u64)));
    }
    match objects.meshes {
        0 => {}
        1 => kinds.push("1 mesh".to_owned()),
        n => kinds.push(format!("{} meshes", grouped(n as u64))),
    }
    if objects.csg > 0 {
        kinds.push(format!("{} csg", grouped(objects.csg as u64)));
    }
    kinds.join(", ")
}

fn camera(camera: &CameraSummary) -> String {
    match *camera {
        CameraSummary::Window { eye, window: [width, height] } => {
            format!("eye {}, window {width} x {height}", triple(eye))
        }
        CameraSummary::Perspective { from, to, fov } => {
            let degrees = fov.to_degrees();
            format!("perspective, from {} to {}, field of view {degrees:.4}°", triple(from), triple(to))
        }
        CameraSummary::Orthographic { from, to, height } => {
            format!("orthographic, from {} to {}, height {height}", triple(from), triple(to))
        }
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
