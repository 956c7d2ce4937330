//! Names that mean nothing, and what was probably meant.

use crate::diagnostic::{Diagnostic, Span};
use crate::hry::library::{CONSTRUCTORS, Constructor};
use crate::hry::program::{Global, LoadedModule, listed, nearest};
use std::collections::HashMap;
use std::sync::Arc;

/// A name of another language, and how its meaning is written here. Where the second is not empty, it can
/// simply be put in the name's place.
struct Foreign(&'static str, &'static str, &'static str);

/// In alphabetical order, in small letters.
const FOREIGN: &[Foreign] = &[
    Foreign("ambient_light", "ambient", "light from everywhere is `ambient { intensity = 0.1 }`"),
    Foreign("append", "", "lists are joined by `a ++ b`"),
    Foreign("arccos", "acos", ""),
    Foreign("arcsin", "asin", ""),
    Foreign("arctan", "atan", ""),
    Foreign("arctan2", "atan2", ""),
    Foreign("area_light", "", "the lights are `point`, `directional`, `spotlight` and `ambient`"),
    Foreign(
        "background",
        "",
        "the background is a field of the scene: `scene = { background = #cfe3ff, ... }`",
    ),
    Foreign("boolean", "", "the type of `true` and `false` is `Bool`"),
    Foreign(
        "camera",
        "",
        "a camera is `perspective { from = ..., to = ... }`, `orthographic { ... }` or `window { ... }`",
    ),
    Foreign("case", "", "cases are written `match x { 0 -> a, _ -> b }`"),
    Foreign("ceiling", "ceil", ""),
    Foreign(
        "color",
        "",
        "a colour is `rgb 1 0.5 0` or `#ff8800`; a material of that colour `classic { color = #ff8800 }`",
    ),
    Foreign(
        "colour",
        "",
        "a colour is `rgb 1 0.5 0` or `#ff8800`; a material of that colour `classic { color = #ff8800 }`",
    ),
    Foreign("concatmap", "", "a comprehension does it: `[ y | x <- list, y <- f x ]`"),
    Foreign("const", "", "a function that ignores its argument is `\\_ -> x`"),
    Foreign("cuboid", "box", ""),
    Foreign("cylinder", "", "there is no cylinder yet; the shapes are `sphere`, `plane`, `cube` and `box`"),
    Foreign("declare", "", "a definition is `name = value`"),
    Foreign("def", "", "a function is `name parameter = value`"),
    Foreign("define", "", "a definition is `name = value`"),
    Foreign(
        "degrees",
        "",
        "angles are in radians everywhere, and `30deg` is a number; `angle / 1deg` is in degrees",
    ),
    Foreign("diffuse", "classic", "a matte material is `classic { color = ... }`"),
    Foreign("directional_light", "directional", ""),
    Foreign("do", "", "there are no statements; intermediate values are named by `let ... in`"),
    Foreign("e", "", "it is `exp 1`"),
    Foreign("elif", "", "write `else if`"),
    Foreign("exp2", "", "a power is written `2 ^ x`"),
    Foreign("exponent", "exp", ""),
    Foreign("fabs", "abs", ""),
    Foreign(
        "finish",
        "",
        "a material is one record: `classic { color = gold, reflection = 0.3, shine = 60 }`",
    ),
    Foreign("float", "", "there is one kind of numbers, `Number`; nothing has to be converted"),
    Foreign("fmod", "", "the rest of a division is `a % b`, with spaces around the `%`"),
    Foreign("foldl", "fold", ""),
    Foreign("foldr", "fold", "`fold step start list` goes through a list from the left"),
    Foreign("for", "", "a list of many is a comprehension: `[ f i | i <- [0 .. 9] ]`"),
    Foreign("foreach", "", "a list of many is a comprehension: `[ f i | i <- [0 .. 9] ]`"),
    Foreign("frac", "fract", ""),
    Foreign("fun", "", "a function is `\\x -> x + 1`, or a definition with a parameter"),
    Foreign("function", "", "a function is `\\x -> x + 1`, or a definition with a parameter"),
    Foreign("head", "", "the first element is `at 0 list`"),
    Foreign("id", "identity", ""),
    Foreign("int", "", "there is one kind of numbers; `floor x` drops what follows the point"),
    Foreign("inversesqrt", "", "write `1 / sqrt x`"),
    Foreign("lambda", "", "a function is `\\x -> x + 1`"),
    Foreign("len", "", "the number of elements is `count list`, the length of a vector `length v`"),
    Foreign("lerp", "mix", ""),
    Foreign("light_source", "point", "a lamp is `point { position = ..., intensity = ... }`"),
    Foreign("lightsource", "point", "a lamp is `point { position = ..., intensity = ... }`"),
    Foreign("log", "ln", "the natural logarithm is `ln`"),
    Foreign("log10", "", "write `ln x / ln 10`"),
    Foreign("log2", "", "write `ln x / ln 2`"),
    Foreign("macro", "", "a function is a definition with parameters: `name x = ...`"),
    Foreign("map_range", "remap", ""),
    Foreign("material", "classic", "a material is `classic { color = ... }`"),
    Foreign("math", "", "functions of numbers need no prefix: `sin x`, `sqrt x`"),
    Foreign("merge", "union", ""),
    Foreign("mod", "", "the rest of a division is `a % b`, with spaces around the `%`"),
    Foreign("modulo", "", "the rest of a division is `a % b`, with spaces around the `%`"),
    Foreign("new", "", "nothing has to be made new: `sphere { radius = 1 }` is a value"),
    Foreign(
        "nil",
        "",
        "there is no value for `nothing`; the empty list is `[]`, and a field that is not needed is left out",
    ),
    Foreign(
        "none",
        "",
        "there is no value for `nothing`; the empty list is `[]`, and a field that is not needed is left out",
    ),
    Foreign("normalise", "normalize", ""),
    Foreign(
        "null",
        "",
        "there is no value for `nothing`; the empty list is `[]`, and a field that is not needed is left out",
    ),
    Foreign("object", "", "a shape with its material is simply the shape: `sphere { material = ... }`"),
    Foreign("otherwise", "", "cases end with `else`, or with `_ ->` in a match"),
    Foreign(
        "pigment",
        "",
        "a colour, or a function of a hit, goes straight into a material: `classic { color = ... }`",
    ),
    Foreign("pointlight", "point", ""),
    Foreign("point_light", "point", ""),
    Foreign("pow", "", "a power is written `a ^ b`"),
    Foreign("power", "", "a power is written `a ^ b`"),
    Foreign("print", "", "`show x` turns a value into text; nothing can be printed from inside a scene"),
    Foreign("putstrln", "", "nothing can be printed from inside a scene"),
    Foreign("radians", "", "angles are in radians everywhere; one in degrees is written `30deg`"),
    Foreign("rand", "random", "`random seed i` is the random number i of a seed: the same at every run"),
    Foreign("range", "", "a range is `[0 .. n - 1]`, its last element included"),
    Foreign("repeat", "", "write `[ x | _ <- [1 .. n] ]`"),
    Foreign("replicate", "", "write `[ x | _ <- [1 .. n] ]`"),
    Foreign(
        "return",
        "",
        "the value of a definition is the expression after `=`; nothing has to be returned",
    ),
    Foreign("rgba", "rgb", "colours have no alpha; a material has `transparency`"),
    Foreign("rgbf", "rgb", "colours have no filter; a material has `transparency`"),
    Foreign("saturate", "", "write `clamp 0 1 x`"),
    Foreign("self", "", "there are no objects with methods; fields are read by `value.field`"),
    Foreign("smooth", "smoothstep", ""),
    Foreign("sphere_sweep", "sphere", ""),
    Foreign("spot", "spotlight", ""),
    Foreign("spot_light", "spotlight", ""),
    Foreign("sqr", "", "a square is `x ^ 2`"),
    Foreign("square", "", "a square is `x ^ 2`; a solid with equal sides is `cube { size = 1 }`"),
    Foreign("str", "show", ""),
    Foreign("subtract", "difference", "to cut one shape out of another: `difference a b`"),
    Foreign("switch", "", "cases are written `match x { 0 -> a, _ -> b }`"),
    Foreign("tail", "", "all but the first element are `drop 1 list`"),
    Foreign("tau", "turn", "a whole turn in radians is `turn`"),
    Foreign(
        "texture",
        "",
        "a colour, or a function of a hit, goes straight into a material: `classic { color = ... }`",
    ),
    Foreign("this", "", "there are no objects with methods; fields are read by `value.field`"),
    Foreign("tostring", "show", ""),
    Foreign("torus", "", "there is no torus yet; the shapes are `sphere`, `plane`, `cube` and `box`"),
    Foreign("transform", "", "use `translate`, `rotate`, `scale`, `stretch` or `matrix`"),
    Foreign("triangle", "", "there is no triangle yet; the shapes are `sphere`, `plane`, `cube` and `box`"),
    Foreign("trunc", "floor", ""),
    Foreign(
        "undefined",
        "",
        "there is no value for `nothing`; the empty list is `[]`, and a field that is not needed is left out",
    ),
    Foreign("unit", "normalize", ""),
    Foreign("var", "", "a definition is `name = value`"),
    Foreign("vec", "", "a vector is written in parentheses: `(x, y, z)`"),
    Foreign("vec2", "", "a vector is written in parentheses: `(x, y)`"),
    Foreign("vec3", "", "a vector is written in parentheses: `(x, y, z)`"),
    Foreign("vec4", "", "vectors have two or three components: `(x, y, z)`; a colour is `rgb r g b`"),
    Foreign("vector", "", "a vector is written in parentheses: `(x, y, z)`"),
    Foreign("vector3", "", "a vector is written in parentheses: `(x, y, z)`"),
    Foreign("vlength", "length", ""),
    Foreign("vnormalize", "normalize", ""),
    Foreign("vdot", "dot", ""),
    Foreign("vcross", "cross", ""),
    Foreign("where", "", "names for intermediate values come first: `let name = ... in ...`"),
    Foreign("while", "", "a loop is a function that calls itself, or `iterate max until step start`"),
    Foreign("zip", "", "`zipWith f a b` goes through two lists at once"),
];

/// The name that was probably meant. Names of one letter are near to nothing.
pub(super) fn near<'n>(name: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let is_short = |name: &str| name.chars().count() < 2;
    if is_short(name) {
        return names.into_iter().find(|other| *other != name && other.to_lowercase() == name.to_lowercase());
    }
    nearest(name, names.filter(|other| !is_short(other)))
}

/// The complaint about a name that means nothing.
pub(super) fn name(name: &str, span: Span, module: &LoadedModule, locals: &[&str]) -> Diagnostic {
    let error = Diagnostic::error("unknown-name", format!("there is no `{name}` here"), span, "not defined");
    if let Some(foreign) = foreign(name) {
        return suggest_foreign(error, span, foreign);
    }
    if let Some(prefix) = name.strip_suffix("deg").or_else(|| name.strip_suffix("rad"))
        && prefix.parse::<f64>().is_ok()
    {
        return error.with_help("`deg` directly follows the digits of a number");
    }
    let all = module.scope.all();
    let known = locals.iter().copied().chain(all.iter().map(|(name, _)| &**name));
    if let Some(near) = near(name, known) {
        return error.with_suggestion(span, near, format!("did you mean `{near}`?"));
    }
    if let Some(qualified) = qualified_home(name, module) {
        let text = format!("it is in an import with a name of its own: `{qualified}`");
        return error.with_suggestion(span, qualified, text);
    }
    if let Some(constructor) = field_of(name) {
        let text = format!(
            "`{name}` is a field of `{}`; it is written inside `{} {{ ... }}`",
            constructor.name, constructor.name
        );
        return error.with_help(text);
    }
    error.with_help(format!("define it somewhere in this file, for example: `{name} = 1`"))
}

/// The complaint about the name of a hit in a value that is no function of one.
pub(super) fn hit(name: &str, span: Span, value: Span) -> Diagnostic {
    let message = format!("there is no hit `{name}` here: this value is not a function");
    let text = "what varies over a surface is a function of the hit:";
    Diagnostic::error("unknown-name", message, span, "not defined")
        .with_secondary(value, "may be a function")
        .with_suggestion(Span::at(value.start), format!("\\{name} -> "), text)
}

fn foreign(name: &str) -> Option<&'static Foreign> {
    let lower = name.to_lowercase();
    FOREIGN.iter().find(|foreign| foreign.0 == lower)
}

fn suggest_foreign(error: Diagnostic, span: Span, foreign: &Foreign) -> Diagnostic {
    match (foreign.1, foreign.2) {
        ("", help) => error.with_help(help),
        (here, "") => error.with_suggestion(span, here, format!("it is called `{here}` here")),
        (here, help) => error.with_suggestion(span, here, format!("it is called `{here}` here: {help}")),
    }
}

/// `p.gold`, where `gold` is defined by an import `as p`.
fn qualified_home(name: &str, module: &LoadedModule) -> Option<String> {
    let homes = module.scope.qualified.iter().filter(|(_, names)| names.contains_key(name));
    homes.map(|(prefix, _)| format!("{prefix}.{name}")).min()
}

fn field_of(name: &str) -> Option<&'static Constructor> {
    CONSTRUCTORS.iter().find(|constructor| constructor.field(name).is_some())
}

/// The complaint about `prefix.name` where the import does not define it.
pub(super) fn qualified(
    prefix: &str,
    name: &crate::hry::ast::Name,
    names: &HashMap<Arc<str>, Global>,
) -> Diagnostic {
    let message = format!("the import `{prefix}` does not define `{}`", name.text);
    let error = Diagnostic::error("unknown-name", message, name.span, "not defined there");
    let mut all: Vec<&str> = names.keys().map(AsRef::as_ref).collect();
    all.sort_unstable();
    match near(&name.text, all.iter().copied()) {
        Some(near) => error.with_suggestion(name.span, near, format!("did you mean `{near}`?")),
        None if all.is_empty() => error.with_help("that file defines nothing"),
        None => error.with_help(format!("it defines {}", listed(&all))),
    }
}

/// What a field of another program's vocabulary is called here, by the constructor's fields.
pub(super) fn field_synonym(constructor: &Constructor, name: &str) -> Option<&'static str> {
    const SYNONYMS: &[(&[&str], &[&str])] = &[
        (&["r", "rad", "diameter"], &["radius"]),
        (
            &["position", "pos", "location", "at", "centre", "origin", "middle", "translate"],
            &["center", "position", "from", "eye"],
        ),
        (&["eye", "camera", "location"], &["from", "position"]),
        (&["target", "lookat", "look_at", "look", "center", "at"], &["to", "target"]),
        (&["angle", "fieldofview", "zoom"], &["fov", "angle"]),
        (&["brightness", "power", "strength", "energy", "color", "colour"], &["intensity"]),
        (&["texture", "pigment", "color", "colour", "finish", "surface"], &["material"]),
        (&["texture", "pigment", "colour", "diffuse", "albedo"], &["color"]),
        (&["mirror", "reflect", "specular", "metallic"], &["reflection"]),
        (&["shininess", "gloss", "roughness"], &["shine"]),
        (&["transmission", "transmit", "filter", "opacity", "alpha"], &["transparency"]),
        (&["refraction", "refractiveindex", "index"], &["ior"]),
        (&["emission", "emissive"], &["glow"]),
        (&["normalmap", "displacement", "height"], &["bump"]),
        (&["side", "width", "length", "dimensions", "extent"], &["size"]),
        (&["resolution", "width", "height", "dimensions"], &["size"]),
        (&["height", "distance", "d"], &["offset"]),
        (&["dir", "towards", "toward"], &["direction", "normal"]),
        (&["antialiasing", "aa", "spp", "samplesperpixel"], &["samples"]),
        (&["recursion", "bounces", "maxdepth"], &["depth"]),
        (&["shape", "shapes", "primitives", "children", "world"], &["objects"]),
        (&["lamp", "lamps", "lightsource", "lightsources"], &["lights"]),
        (&["sky", "environment", "backdrop"], &["background"]),
    ];
    let lower: String = name.to_lowercase().chars().filter(|c| *c != '_').collect();
    let matching = SYNONYMS.iter().filter(|(foreign, _)| foreign.iter().any(|f| f.replace('_', "") == lower));
    matching.flat_map(|(_, ours)| ours.iter()).copied().find(|ours| constructor.field(ours).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hry::program::standard;

    #[test]
    fn what_is_suggested_exists() {
        for Foreign(name, here, help) in FOREIGN {
            assert!(!here.is_empty() || !help.is_empty(), "{name}");
            assert!(here.is_empty() || standard().names.contains_key(*here), "{name}: {here}");
            assert_eq!(*name, name.to_lowercase());
        }
    }

    #[test]
    fn names_of_one_letter_are_near_to_nothing() {
        assert_eq!(near("c", ["a", "b"].into_iter()), None);
        assert_eq!(near("radios", ["radius", "center"].into_iter()), Some("radius"));
    }
}
