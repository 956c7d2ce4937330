//! Wavefront's material libraries, as far as they tell colours: the diffuse colour, what is given off, and how solid
//! something is. Colours are taken for linear.

use super::obj::floats;
use super::problem::{Outcome, Problem};
use hray_core::{ModelMaterial, Rgb};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Adds the materials of a library.
pub(super) fn read(
    bytes: &[u8],
    into: &mut BTreeMap<String, Arc<ModelMaterial>>,
    notes: &mut Vec<String>,
) -> Outcome<()> {
    let mut current: Option<ModelMaterial> = None;
    let mut has_textures = false;
    let mut keep = |material: Option<ModelMaterial>| {
        if let Some(material) = material {
            into.insert(material.name.clone(), Arc::new(material));
        }
    };
    for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let (line, number) = (line.trim_ascii(), number + 1);
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let Some(first) = words.next() else { continue };
        if first == b"newmtl" {
            let name = String::from_utf8_lossy(line.get(first.len()..).unwrap_or_default().trim_ascii());
            // Where a file says nothing, things are a light grey.
            keep(current.replace(ModelMaterial::new(name.into_owned(), Rgb::new(0.8, 0.8, 0.8))));
            continue;
        }
        let Some(material) = &mut current else { continue };
        match first {
            b"Kd" => material.base_color = color(&mut words, number)?.unwrap_or(material.base_color),
            b"Ke" => material.emission = color(&mut words, number)?.unwrap_or(material.emission),
            b"d" => material.opacity = share(&mut words, number)?,
            b"Tr" => material.opacity = 1.0 - share(&mut words, number)?,
            _ => has_textures |= first.starts_with(b"map_"),
        }
    }
    keep(current);
    if has_textures {
        notes.push("the images that materials name are not read".to_owned());
    }
    Ok(())
}

/// A colour; none where it is a spectrum, or in CIE XYZ.
fn color<'w>(words: &mut impl Iterator<Item = &'w [u8]>, line: usize) -> Outcome<Option<Rgb>> {
    let mut words = words.peekable();
    if matches!(words.peek(), Some(&(b"spectral" | b"xyz"))) {
        return Ok(None);
    }
    let mut values = [0.0; 3];
    match floats(&mut words, &mut values, "a component of a colour", line)? {
        // One is a grey.
        1 => Ok(Some(Rgb::from([f64::from(values[0]); 3]))),
        3 => Ok(Some(Rgb::from(values.map(f64::from)))),
        count => Err(Problem::line(line, format!("a colour has three components, and this has {count}"))),
    }
}

fn share<'w>(words: &mut impl Iterator<Item = &'w [u8]>, line: usize) -> Outcome<f64> {
    let mut words = words.filter(|word| *word != b"-halo");
    let mut values = [1.0];
    floats(&mut words, &mut values, "a share", line)?;
    Ok(f64::from(values[0]).clamp(0.0, 1.0))
}
