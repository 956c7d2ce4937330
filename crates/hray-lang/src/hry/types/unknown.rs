//! Names that mean nothing, and what was probably meant.

use crate::diagnostic::{Diagnostic, Span};
use crate::hry::ast::{Pattern, PatternKind};
use crate::hry::library::{CONSTRUCTORS, Constructor, Makes};
use crate::hry::program::{Global, LoadedModule, listed, nearest};
use crate::hry::syntax::complaint::foreign::is_put_before_definitions;
use std::collections::HashMap;
use std::sync::Arc;

/// A name of another language, and how its meaning is written here. Where the second is not empty, it can
/// simply be put in the name's place.
struct Foreign(&'static str, &'static str, &'static str);

/// In place of a help: it is a shape that there is not.
const NO_SHAPE: &str = "no such shape";

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
    Foreign(
        "capsule",
        "",
        "a rod with round ends is `implicit { function = rodField (0, 0, 0) (0, 1, 0) 0.3 }`",
    ),
    Foreign("case", "", "cases are written `match x { 0 -> a, _ -> b }`"),
    Foreign("ceiling", "ceil", ""),
    Foreign("clipped_by", "clip", "`shape |> clip solid` leaves what is inside the solid"),
    Foreign("clock", "", "the time in seconds is the parameter of the scene: `scene t = { ... }`"),
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
    Foreign("complement", "inverse", ""),
    Foreign("concatmap", "", "a comprehension does it: `[ y | x <- list, y <- f x ]`"),
    Foreign("const", "", "a function that ignores its argument is `\\_ -> x`"),
    Foreign("cuboid", "box", ""),
    Foreign("cut", "difference", ""),
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
    Foreign("disk", "disc", ""),
    Foreign("do", "", "there are no statements; intermediate values are named by `let ... in`"),
    Foreign("down", "", "it is `-up`"),
    Foreign("e", "", "it is `exp 1`"),
    Foreign("elif", "", "write `else if`"),
    Foreign("ellipsoid", "", "an ellipsoid is a sphere, stretched: `sphere {} |> stretch (2, 1, 1)`"),
    Foreign("enumerate", "", "numbers and elements together are `zipWith f [0 .. count list - 1] list`"),
    Foreign("exp2", "", "a power is written `2 ^ x`"),
    Foreign("exponent", "exp", ""),
    Foreign("fabs", "abs", ""),
    Foreign(
        "finish",
        "",
        "a material is one record: `classic { color = gold, reflection = 0.3, shine = 60 }`",
    ),
    Foreign("fisheye", "", "the cameras are `perspective`, `orthographic` and `window`"),
    Foreign("float", "", "there is one kind of numbers, `Number`; nothing has to be converted"),
    Foreign("fmod", "", "the rest of a division is `a % b`, with spaces around the `%`"),
    Foreign("foldl", "fold", ""),
    Foreign("foldr", "fold", "`fold step start list` goes through a list from the left"),
    Foreign("for", "", "a list of many is a comprehension: `[ f i | i <- [0 .. 9] ]`"),
    Foreign("foreach", "", "a list of many is a comprehension: `[ f i | i <- [0 .. 9] ]`"),
    Foreign("forward", "", "a direction is a vector: `(0, 0, -1)`"),
    Foreign("frac", "fract", ""),
    Foreign("frame", "", "a scene is a function of the time in seconds: `scene t = { ... }`"),
    Foreign("fun", "", "a function is `\\x -> x + 1`, or a definition with a parameter"),
    Foreign("function", "", "a function is `\\x -> x + 1`, or a definition with a parameter"),
    Foreign("glass", "", "glass is `classic { transparency = 0.9, ior = 1.5, reflection = 0.1 }`"),
    Foreign("head", "", "the first element is `at 0 list`"),
    Foreign("height_field", "", NO_SHAPE),
    Foreign("heightfield", "", NO_SHAPE),
    Foreign("id", "identity", ""),
    Foreign("int", "", "there is one kind of numbers; `floor x` drops what follows the point"),
    Foreign("intersect", "intersection", ""),
    Foreign("inversesqrt", "", "write `1 / sqrt x`"),
    Foreign("invert", "inverse", ""),
    Foreign(
        "isosurface",
        "implicit",
        "a surface where a function is 0 is `implicit { function = \\p -> ... }`",
    ),
    Foreign("join", "union", ""),
    Foreign("lambda", "", "a function is `\\x -> x + 1`"),
    Foreign("lambert", "classic", ""),
    Foreign("lathe", "", NO_SHAPE),
    Foreign("left", "", "it is `-right`"),
    Foreign("len", "", "the number of elements is `count list`, the length of a vector `length v`"),
    Foreign("length_of", "length", ""),
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
    Foreign("matte", "classic", ""),
    Foreign("merge", "union", ""),
    Foreign("metaballs", "blob", ""),
    Foreign("metal", "", "a mirror is `classic { reflection = 0.8, color = silver }`"),
    Foreign("mirror", "", "a mirror is `classic { reflection = 0.8 }`"),
    Foreign("mod", "", "the rest of a division is `a % b`, with spaces around the `%`"),
    Foreign("modulo", "", "the rest of a division is `a % b`, with spaces around the `%`"),
    Foreign("move", "translate", ""),
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
    Foreign("panorama", "", "the cameras are `perspective`, `orthographic` and `window`"),
    Foreign("panoramic", "", "the cameras are `perspective`, `orthographic` and `window`"),
    Foreign("phong", "classic", ""),
    Foreign(
        "pigment",
        "",
        "a colour, or a function of a hit, goes straight into a material: `classic { color = ... }`",
    ),
    Foreign("pinhole", "", "the cameras are `perspective`, `orthographic` and `window`"),
    Foreign("pointlight", "point", ""),
    Foreign("point_light", "point", ""),
    Foreign("pow", "", "a power is written `a ^ b`"),
    Foreign("power", "", "a power is written `a ^ b`"),
    Foreign("print", "", "`show x` turns a value into text; nothing can be printed from inside a scene"),
    Foreign("prism", "", NO_SHAPE),
    Foreign("product", "", "a product is `fold (\\a b -> a * b) 1 list`"),
    Foreign("putstrln", "", "nothing can be printed from inside a scene"),
    Foreign("pyramid", "", NO_SHAPE),
    Foreign(
        "quad",
        "",
        "a flat face is `triangles { points = [(-1, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 1, 0)], faces = [[0, 1, 2, 3]] }`, a thin plate `box { size = (2, 1, 0.01) }`",
    ),
    Foreign("radians", "", "angles are in radians everywhere; one in degrees is written `30deg`"),
    Foreign("rand", "random", "`random seed i` is the random number i of a seed: the same at every run"),
    Foreign("range", "", "a range is `[0 .. n - 1]`, its last element included"),
    Foreign(
        "rectangle",
        "",
        "a flat face is `triangles { points = [(-1, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 1, 0)], faces = [[0, 1, 2, 3]] }`, a thin plate `box { size = (2, 1, 0.01) }`",
    ),
    Foreign("reduce", "fold", "`fold step start list` goes through a list from the left"),
    Foreign("repeat", "", "write `[ x | _ <- [1 .. n] ]`"),
    Foreign("replicate", "", "write `[ x | _ <- [1 .. n] ]`"),
    Foreign(
        "return",
        "",
        "the value of a definition is the expression after `=`; nothing has to be returned",
    ),
    Foreign("rgba", "rgb", "colours have no alpha; a material has `transparency`"),
    Foreign("rgbf", "rgb", "colours have no filter; a material has `transparency`"),
    Foreign("rotate_x", "", "a rotation about the x axis is `rotate right 30deg`"),
    Foreign("rotate_y", "", "a rotation about the y axis is `rotate up 30deg`"),
    Foreign("rotate_z", "", "a rotation about the z axis is `rotate back 30deg`"),
    Foreign("rotatex", "", "a rotation about the x axis is `rotate right 30deg`"),
    Foreign("rotatey", "", "a rotation about the y axis is `rotate up 30deg`"),
    Foreign("rotatez", "", "a rotation about the z axis is `rotate back 30deg`"),
    Foreign("roundedbox", "roundedBox", ""),
    Foreign("saturate", "", "write `clamp 0 1 x`"),
    Foreign("scalex", "", "along the x axis: `stretch (2, 1, 1)`"),
    Foreign("scaley", "", "along the y axis: `stretch (1, 2, 1)`"),
    Foreign("scalez", "", "along the z axis: `stretch (1, 1, 2)`"),
    Foreign("self", "", "there are no objects with methods; fields are read by `value.field`"),
    Foreign("smooth", "smoothstep", ""),
    Foreign("sphere_sweep", "sphere", ""),
    Foreign("spot", "spotlight", ""),
    Foreign("spot_light", "spotlight", ""),
    Foreign("sqr", "", "a square is `x ^ 2`"),
    Foreign("square", "", "a square is `x ^ 2`; a solid with equal sides is `cube { size = 1 }`"),
    Foreign("str", "show", ""),
    Foreign("substract", "difference", "to cut one shape out of another: `difference a b`"),
    Foreign("subtract", "difference", "to cut one shape out of another: `difference a b`"),
    Foreign("sumof", "sum", ""),
    Foreign(
        "sun",
        "directional",
        "a light from far away, such as the sun, is `directional { direction = (-1, -3, -1) }`",
    ),
    Foreign("switch", "", "cases are written `match x { 0 -> a, _ -> b }`"),
    Foreign("tail", "", "all but the first element are `drop 1 list`"),
    Foreign("tau", "turn", "a whole turn in radians is `turn`"),
    Foreign("tetrahedron", "", NO_SHAPE),
    Foreign("text", "", NO_SHAPE),
    Foreign(
        "texture",
        "",
        "a colour, or a function of a hit, goes straight into a material: `classic { color = ... }`",
    ),
    Foreign("thin_lens", "", "the cameras are `perspective`, `orthographic` and `window`"),
    Foreign("thinlens", "", "the cameras are `perspective`, `orthographic` and `window`"),
    Foreign("this", "", "there are no objects with methods; fields are read by `value.field`"),
    Foreign("time", "", "the time in seconds is the parameter of the scene: `scene t = { ... }`"),
    Foreign("tostring", "show", ""),
    Foreign("transform", "", "use `translate`, `rotate`, `scale`, `stretch` or `matrix`"),
    Foreign("translatex", "", "along the x axis: `translate (1, 0, 0)`"),
    Foreign("translatey", "", "along the y axis: `translate (0, 1, 0)`"),
    Foreign("translatez", "", "along the z axis: `translate (0, 0, 1)`"),
    Foreign(
        "triangle",
        "",
        "a triangle is `triangles { points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces = [[0, 1, 2]] }`",
    ),
    Foreign("trunc", "floor", ""),
    Foreign("turbulance", "turbulence", ""),
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
    Foreign(
        "x",
        "",
        "axes are `right` (x), `up` (y) and `back` (z); the parts of a vector v are `v.x`, `v.y` and `v.z`",
    ),
    Foreign(
        "y",
        "",
        "axes are `right` (x), `up` (y) and `back` (z); the parts of a vector v are `v.x`, `v.y` and `v.z`",
    ),
    Foreign(
        "z",
        "",
        "axes are `right` (x), `up` (y) and `back` (z); the parts of a vector v are `v.x`, `v.y` and `v.z`",
    ),
    Foreign("zip", "", "`zipWith f a b` goes through two lists at once"),
    Foreign("π", "pi", ""),
    Foreign("τ", "turn", ""),
];

/// Colours that have a name elsewhere (those of CSS, and a few more), in alphabetical order.
const COLORS: &[(&str, &str)] = &[
    ("amber", "#ffbf00"),
    ("aqua", "#00ffff"),
    ("beige", "#f5f5dc"),
    ("bronze", "#cd7f32"),
    ("chocolate", "#d2691e"),
    ("coral", "#ff7f50"),
    ("cream", "#fffdd0"),
    ("crimson", "#dc143c"),
    ("darkblue", "#00008b"),
    ("darkgray", "#a9a9a9"),
    ("darkgreen", "#006400"),
    ("darkgrey", "#a9a9a9"),
    ("fuchsia", "#ff00ff"),
    ("gray", "#808080"),
    ("hotpink", "#ff69b4"),
    ("indigo", "#4b0082"),
    ("khaki", "#f0e68c"),
    ("lavender", "#e6e6fa"),
    ("lightblue", "#add8e6"),
    ("lightgray", "#d3d3d3"),
    ("lightgrey", "#d3d3d3"),
    ("lime", "#00ff00"),
    ("magenta", "#ff00ff"),
    ("maroon", "#800000"),
    ("navy", "#000080"),
    ("olive", "#808000"),
    ("orchid", "#da70d6"),
    ("plum", "#dda0dd"),
    ("purple", "#800080"),
    ("salmon", "#fa8072"),
    ("skyblue", "#87ceeb"),
    ("steelblue", "#4682b4"),
    ("teal", "#008080"),
    ("tomato", "#ff6347"),
    ("turquoise", "#40e0d0"),
];

/// The name that was probably meant. Names of one letter are near to nothing.
pub(super) fn near<'n>(name: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let is_short = |name: &str| name.chars().count() < 2;
    if is_short(name) {
        return names.into_iter().find(|other| *other != name && other.to_lowercase() == name.to_lowercase());
    }
    // Short names are near to many; the first letter is rarely wrong.
    let is_alike = |other: &str| {
        name.chars().count() > 4
            || name.chars().next().map(|c| c.to_ascii_lowercase())
                == other.chars().next().map(|c| c.to_ascii_lowercase())
    };
    nearest(name, names.filter(|other| !is_short(other) && is_alike(other)))
}

/// What is known about the place of a name that means nothing.
pub(super) struct Around<'a> {
    pub(super) module: &'a LoadedModule,
    /// The names that are bound around it.
    pub(super) locals: &'a [&'a str],
    /// The values of which its place takes one, where there are so few.
    pub(super) choices: &'a [&'a str],
    /// Whether it is called with arguments.
    pub(super) is_called: bool,
    /// The definition at the top that it is in.
    pub(super) current: Option<&'a str>,
}

/// The complaint about a name that means nothing.
pub(super) fn name(name: &str, span: Span, around: &Around<'_>) -> Diagnostic {
    let module = around.module;
    let error = Diagnostic::error("unknown-name", format!("there is no `{name}` here"), span, "not defined");
    if let Some(near) = near(name, around.choices.iter().copied()) {
        return error.with_suggestion(span, near, format!("did you mean `{near}`?"));
    }
    if let [_, ..] = around.choices {
        return error.with_help(format!("what can stand here: {}", listed(around.choices)));
    }
    if matches!(name, "deg" | "degree" | "degrees" | "rad") && !around.is_called {
        return error.with_help(
            "the unit of an angle directly follows its digits, without a space: `30deg`; of any other value it is a \
             factor: `angle * 1deg`",
        );
    }
    if let Some(qualified) = qualified_home(name, module) {
        let text = format!("it is in an import with a name of its own: `{qualified}`");
        return error.with_suggestion(span, qualified, text);
    }
    if let Some((owner, place)) = parameter_of_another(name, around) {
        let inside = around.current.unwrap_or("f");
        return error.with_secondary(place, format!("a parameter of `{owner}`")).with_help(format!(
            "`{name}` exists only inside `{owner}`; make `{inside}` a function of it, `{inside} {name} = ...`, and give it the \
             value where it is used: `{inside} {name}`"
        ));
    }
    if let Some((word, surplus)) = defined_with_word(name, module) {
        let message =
            format!("`{word} {name} = ...` defines a function `{word}`, whose parameter is `{name}`");
        let error = error.with_secondary(surplus, "a definition begins with its name").with_note(message);
        if !is_put_before_definitions(word) {
            return error.with_help(format!("a name is one word: `{word}_{name}` in both places"));
        }
        return error.with_suggestion(surplus, "", format!("leave out `{word}`"));
    }
    if let Some(foreign) = foreign(name) {
        return suggest_foreign(error, span, foreign);
    }
    let lower = name.to_lowercase();
    if let Some((_, color)) = COLORS.iter().find(|(name, _)| *name == lower.replace('_', "")) {
        let text = format!("no colour of that name is known; the usual {name} is `{color}`:");
        return error.with_suggestion(span, *color, text);
    }
    if let Some(prefix) = name.strip_suffix("deg").or_else(|| name.strip_suffix("rad"))
        && prefix.parse::<f64>().is_ok()
    {
        return error.with_help("`deg` directly follows the digits of a number");
    }
    let all = module.scope.all();
    let known = around.locals.iter().copied().chain(all.iter().map(|(name, _)| &**name));
    if let Some(near) = near(name, known) {
        return error.with_suggestion(span, near, format!("did you mean `{near}`?"));
    }
    if let Some(constructor) = field_of(name) {
        let text = format!(
            "`{name}` is a field of `{}`; it is written inside `{} {{ ... }}`",
            constructor.name, constructor.name
        );
        return error.with_help(text);
    }
    let example = if around.is_called { format!("{name} x = ...") } else { format!("{name} = ...") };
    error.with_help(format!(
        "define it on a line of its own in this file, `{example}`; what there is already is listed in the reference"
    ))
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
        ("", NO_SHAPE) => {
            let shapes = CONSTRUCTORS.iter().filter(|constructor| constructor.makes == Makes::Shape);
            let shapes: Vec<&str> = shapes.map(|constructor| constructor.name).collect();
            error.with_help(format!("there is no {} yet; the shapes are {}", foreign.0, listed(&shapes)))
        }
        ("", help) => error.with_help(help),
        (here, "") => error.with_suggestion(span, here, format!("it is called `{here}` here")),
        (here, help) => error.with_suggestion(span, here, format!("it is called `{here}` here: {help}")),
    }
}

/// A definition that has the name as a parameter, where that may be what was meant, and its place.
fn parameter_of_another<'m>(name: &str, around: &Around<'m>) -> Option<(&'m str, Span)> {
    around.module.syntax.definitions.iter().find_map(|definition| {
        let PatternKind::Name(owner) = &definition.target.kind else { return None };
        let is_it = |parameter: &&Pattern| matches!(&parameter.kind, PatternKind::Name(p) if **p == *name);
        let parameter = definition.parameters.iter().find(is_it)?;
        // The time; other parameters are named alike by chance.
        (&**owner == "scene" && around.current != Some(&**owner)).then_some((&**owner, parameter.span))
    })
}

/// The word of another language in `const name = ...`, and its place with the space after it.
fn defined_with_word<'m>(name: &str, module: &'m LoadedModule) -> Option<(&'m str, Span)> {
    module.syntax.definitions.iter().find_map(|definition| {
        let PatternKind::Name(word) = &definition.target.kind else { return None };
        let first = definition.parameters.first()?;
        let is_it = matches!(&first.kind, PatternKind::Name(parameter) if **parameter == *name);
        let surplus = Span::new(definition.target.span.start, first.span.start);
        let is_alone = definition.parameters.len() == 1;
        (is_it && (is_put_before_definitions(word) || is_alone)).then_some((&**word, surplus))
    })
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
        (&["r", "rad"], &["radius"]),
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
        (&["mirror", "reflect", "metallic"], &["reflection"]),
        (&["specular", "phong"], &["highlight"]),
        (&["shininess", "gloss", "phongsize"], &["shine"]),
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
