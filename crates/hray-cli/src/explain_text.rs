//! An explanation for people: a tree, from the pixel to the lights.

use crate::summary::grouped;
use hray::{Description, Explanation, Hit, LightShare, Object, Ray, Rgb, SourcePlace, display_color};
use std::fmt::Write;

/// What adds less than this to every component of the pixel is not shown: it changes no step of 255.
const FAINT: f64 = 1.0 / 1024.0;

/// The explanation as text. `all` shows the faint rays, too.
pub(crate) fn of(explanation: &Explanation, description: &Description, animated: bool, all: bool) -> String {
    let mut text = Text { out: String::new(), description, all };
    text.pixel(explanation, animated);
    if explanation.rays.is_empty() {
        text.line(0, "The depth is -1, so no ray is followed and the picture is black.");
    } else {
        text.rays(&explanation.rays);
    }
    match explanation.omitted {
        0 => {}
        n => {
            text.line(0, &format!("\nMore rays than are told of were followed: {} in addition.", grouped(n)))
        }
    }
    text.out
}

struct Text<'a> {
    out: String,
    description: &'a Description,
    all: bool,
}

impl Text<'_> {
    fn line(&mut self, depth: usize, line: &str) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.out, "{:indent$}{line}", "", indent = 2 * depth);
    }

    /// `#c8321e (0.5781, 0.0319, 0.013)`.
    fn color(&self, color: [f64; 3]) -> String {
        let [r, g, b] = color.map(short);
        format!("{} ({r}, {g}, {b})", display_color(Rgb::from(color), self.description))
    }

    fn pixel(&mut self, explanation: &Explanation, animated: bool) {
        let Explanation { pixel: [x, y], size: [width, height], samples, .. } = explanation;
        let moment = if animated { format!(" at {} s", explanation.time) } else { String::new() };
        let color = self.color(explanation.color);
        self.line(0, &format!("pixel ({x}, {y}) of {width}x{height}{moment}: {color}"));
        if *samples > 1 && !explanation.rays.is_empty() {
            self.line(1, &format!("the mean of {samples} samples around it, of which"));
            for seen in &explanation.seen {
                let what = seen.object.as_ref().map_or_else(|| "the background".to_owned(), named);
                let verb = if seen.samples == 1 { "sees" } else { "see" };
                self.line(2, &format!("{} {verb} {what}", seen.samples));
            }
        }
        self.line(0, "");
        match (&explanation.object, explanation.rays.first()) {
            (Some(object), _) => self.object(object),
            (None, Some(_)) => self.line(0, "shows the background: the ray from the camera meets nothing"),
            (None, None) => {}
        }
        if *samples > 1
            && let Some(first) = explanation.rays.first()
        {
            let color = self.color(first.color);
            self.line(
                0,
                &format!(
                    "\nWhat follows is the one ray through the middle of the samples, which alone gives {color}."
                ),
            );
        }
        self.line(0, "");
    }

    fn object(&mut self, object: &Object) {
        self.line(0, &format!("shows {}", named(object)));
        if let Some(place) = &object.place {
            self.line(1, &format!("made by      {}", place.text));
        }
        for call in &object.calls {
            self.line(1, &format!("called from  {}: {}", position(call), call.text));
        }
        if let Some(solid) = &object.solid {
            self.line(1, &format!("part of      {}: {}", position(solid), solid.text));
        }
    }

    /// The rays, each before those that it leads to.
    fn rays(&mut self, rays: &[Ray]) {
        let children = children(rays);
        // What is still to be written, the next one last.
        let mut open = vec![(0, 0)];
        while let Some((index, depth)) = open.pop() {
            let Some(ray) = rays.get(index) else { continue };
            self.ray(ray, depth);
            let below = children.get(index).map_or(&[][..], Vec::as_slice);
            let is_shown =
                |child: &&usize| self.all || rays.get(**child).is_none_or(|ray| !is_faint(ray.in_pixel));
            let shown: Vec<usize> = below.iter().filter(is_shown).copied().collect();
            for child in below.iter().filter(|child| !shown.contains(child)) {
                if let Some(ray) = rays.get(*child) {
                    self.line(depth + 1, &format!("a {} too faint to see (--all shows it)", kind(ray)));
                }
            }
            open.extend(shown.into_iter().rev().map(|child| (child, depth + 1)));
        }
    }

    fn ray(&mut self, ray: &Ray, depth: usize) {
        let color = self.color(ray.color);
        let head = if ray.parent.is_none() {
            format!("{}: {color}", kind(ray))
        } else {
            let adds = self.color(ray.contribution);
            format!("{}: {color}, times {} adds {adds}", kind(ray), short(ray.weight))
        };
        self.line(depth, &head);
        let Some(hit) = &ray.hit else {
            self.line(depth + 1, "meets nothing: this is the background");
            return;
        };
        self.hit(ray, hit, depth + 1);
    }

    fn hit(&mut self, ray: &Ray, hit: &Hit, depth: usize) {
        let distance =
            ray.distance.map_or_else(String::new, |distance| format!(", {} away", short(distance)));
        let inside = match (hit.inside, hit.object.kind) {
            (false, _) => "",
            // These have no inside, or need not have one.
            (true, "plane" | "mesh") => ", seen from behind",
            (true, _) => ", seen from inside",
        };
        self.line(depth, &format!("meets {}{distance}{inside}", named(&hit.object)));
        let material = &hit.material;
        let mut surface = format!("surface {}", self.color(material.color));
        if material.reflection != 0.0 {
            let _ = write!(surface, ", mirrors {}", short(material.reflection));
        }
        if material.transparency != 0.0 {
            let (share, ior) = (short(material.transparency), short(material.ior));
            let _ = write!(surface, ", lets {share} through (ior {ior})");
        }
        self.line(depth, &surface);
        for light in &hit.lights {
            self.light(light, depth);
        }
        if hit.glow != [0.0; 3] {
            let glow = self.color(hit.glow);
            self.line(depth, &format!("glows, adds {glow}"));
        }
        let depth_limit = "the depth of the picture ends here, so it counts as black (--depth)";
        for (what, became) in [("mirrored", hit.mirrored), ("refracted", hit.refracted)] {
            match became {
                "too-deep" => self.line(depth, &format!("{what} ray: {depth_limit}")),
                "lost" => {
                    self.line(depth, &format!("{what} ray: none, the light cannot leave at this angle"))
                }
                _ => {}
            }
        }
        if hit.clipped {
            let sum = hit.sum.map(short).join(", ");
            self.line(depth, &format!("all of it together is ({sum}), which is clipped to 0..1"));
        }
    }

    fn light(&mut self, light: &LightShare, depth: usize) {
        let place = light.place.as_ref().map_or_else(String::new, |place| format!(" at {}", position(place)));
        let name =
            if light.kind == "spotlight" { light.kind.to_owned() } else { format!("{} light", light.kind) };
        let adds = self.color(light.contribution);
        let what = match (light.reach, &light.shadowed_by) {
            ("shadowed", Some(object)) => {
                let distance =
                    light.shadow_distance.map_or_else(String::new, |d| format!(", {} away", short(d)));
                format!("in the shadow of {}{distance}", named(object))
            }
            ("behind", _) if light.contribution == [0.0; 3] => "the surface faces away from it".to_owned(),
            ("behind", _) => format!("shines from behind, which by the rules of 2005 adds {adds}"),
            ("outside-cone", _) => "outside its cone".to_owned(),
            _ if light.highlight != [0.0; 3] => {
                let (matte, shiny) = (self.color(light.diffuse), self.color(light.highlight));
                format!("adds {adds}: matte {matte}, highlight {shiny}")
            }
            _ => format!("adds {adds}"),
        };
        self.line(depth, &format!("{name}{place}: {what}"));
    }
}

fn is_faint(color: [f64; 3]) -> bool {
    color.iter().all(|v| v.abs() < FAINT)
}

/// The rays that each leads to.
fn children(rays: &[Ray]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); rays.len()];
    for ray in rays {
        if let Some(list) = ray.parent.and_then(|parent| children.get_mut(parent)) {
            list.push(ray.index);
        }
    }
    children
}

fn kind(ray: &Ray) -> &'static str {
    match ray.kind {
        "camera" => "ray from the camera",
        "reflection" => "mirrored ray",
        "transmission" => "refracted ray",
        _ => "ray mirrored inside",
    }
}

/// The sphere `ball` at scene.hry:12:8.
fn named(object: &Object) -> String {
    let name = object.name.as_ref().map_or_else(String::new, |name| format!(" `{name}`"));
    let place = object.place.as_ref().map_or_else(String::new, |place| format!(" at {}", position(place)));
    format!("the {}{name}{place}", object.kind)
}

fn position(place: &SourcePlace) -> String {
    format!("{}:{}:{}", place.file, place.line, place.column)
}

/// A number with four digits, which is what one can take in.
fn short(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return format!("{number}");
    }
    let exponent: i32 = format!("{number:.3e}").rsplit('e').next().and_then(|e| e.parse().ok()).unwrap_or(0);
    let digits = 3 - exponent;
    if !(-3..=9).contains(&digits) {
        return format!("{number:.3e}");
    }
    let text = format!("{number:.places$}", places = digits.max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let shown =
            [0.0, 1.0, 0.5, 1.0 / 3.0, 12.3456, 1234.5, 123_456.0, 1e-12, 1e30, f64::NAN, -0.25].map(short);
        let wanted =
            ["0", "1", "0.5", "0.3333", "12.35", "1234", "123456", "1.000e-12", "1.000e30", "NaN", "-0.25"];
        assert_eq!(shown, wanted);
    }
}
