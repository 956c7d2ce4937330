//! The types that are inferred.

use crate::common::{Files, checked, errors, with_scene};

/// The type of the last definition of a text.
fn inferred(text: &str) -> String {
    let whole = with_scene(text);
    let (program, checked, diagnostics) = checked(&whole, &Files(&[]));
    let wrong: Vec<_> = diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).collect();
    assert!(wrong.is_empty(), "{text}\n{wrong:#?}");
    let global = program.root().and_then(|root| {
        let last = root.syntax.definitions.iter().rev().nth(1)?;
        root.scope.names.get(&last.name()?.text).copied()
    });
    global.and_then(|global| checked.scheme_of(global)).unwrap_or_default()
}

macro_rules! types {
    ($($text:literal : $expected:literal;)+) => {
        [$(($text, $expected)),+]
    };
}

#[test]
fn plain_values_and_functions() {
    for (text, expected) in types! {
        "a = 1": "Number";
        "a = -1 % 2": "Number";
        "a = true or 1 < 2": "Bool";
        "a = \"x\" ++ show 1": "Text";
        "a = #ff0000": "Color";
        "a = (1, 2)": "Vec2";
        "a = (1, 2, 3)": "Vec3";
        "a = []": "[a]";
        "a = [1, 2]": "[Number]";
        "a = [0 .. 9]": "[Number]";
        "a = [(x, x) | x <- [1 .. 3], x > 1, let y = x, y < 3]": "[Vec2]";
        "a = { x = 1, b = true }": "{ b : Bool, x : Number }";
        "f x = x": "a -> a";
        "f x y = x": "a -> b -> a";
        "f = \\x -> x + 1": "numeric -> numeric";
        "f x = [x]": "a -> [a]";
        "f g x = g (g x)": "(a -> a) -> a -> a";
        "f (x, y) = x + y": "Vec2 -> Number";
        "f x = if x then 1 else 2": "Bool -> Number";
        "f x = match x { 0 -> \"a\", _ -> \"b\" }": "Number -> Text";
        "f list = match list { [] -> 0, [x, ..rest] -> x + f rest }": "[Number] -> Number";
        "f = sin >> cos": "Number -> Number";
        "f = map (\\x -> x + 1)": "[numeric] -> [numeric]";
        "f x = x |> translate (0, 1, 0) |> scale 2": "placeable -> placeable";
        "f a b = a ++ b": "appendable -> appendable -> appendable";
        "f a b = a == b": "a -> a -> Bool";
        "f n = if n == 0 then 1 else n * f (n - 1)": "Number -> Number";
        "even n = if n == 0 then true else odd (n - 1)\nodd n = if n == 0 then false else even (n - 1)": "Number -> Bool";
        "f = image \"a.png\"": "Image";
    } {
        assert_eq!(inferred(text), expected, "{text}");
    }
}

#[test]
fn arithmetic() {
    for (text, expected) in types! {
        "f x = x * 2": "numeric -> numeric";
        "f x = x + (1, 2)": "a -> Vec2 where a is a number or a vector of two";
        "f x = x + x": "numeric -> numeric";
        "f x = -x": "numeric -> numeric";
        "f x = x ^ 2": "numeric -> numeric";
        "f a b t = a + (b - a) * t": "numeric -> numeric1 -> numeric2 -> numeric3 where numeric1 + numeric : numeric4, numeric4 + numeric2 : numeric5, numeric + numeric5 : numeric3";
        "f x y = x + y": "numeric -> numeric1 -> numeric2 where numeric + numeric1 : numeric2";
        "a = (1, 2, 3) * 2": "Vec3";
        "a = 2 * (1, 2, 3) + (1, 1, 1) % 1": "Vec3";
        "a = #ffffff * 0.5 + #000000": "Color";
        "f v = v / length v": "vector -> vector";
        "g x y = x + y\nf = g 1 (1, 2)": "Vec2";
        "g x y = x + y\nf z = g z 1": "numeric -> numeric";
        "f x = let g y = x + y in g 1 + x": "numeric -> numeric";
        "f x = let g y = y + y in (g x, g x, x)": "Number -> Vec3";
        "f x = let double y = y + y in (double x) * double (1, 1)": "a -> Vec2 where a is a number or a vector of two";
    } {
        assert_eq!(inferred(text), expected, "{text}");
    }
}

#[test]
fn fields_and_hits() {
    for (text, expected) in types! {
        "f r = r.radius": "a -> b where a.radius : b";
        "f r = r.radius + r.radius * 2": "a -> numeric where a.radius : numeric";
        "r = { a = 1 }\nf = r.a": "Number";
        "f v = v.z": "a -> b where a.z : b";
        "f v = v.x * v": "vector -> vector";
        "f v = (v * 2).xy": "vector -> Vec2";
        "f c = c.r + c.g": "a -> numeric where a.g : numeric2, a.r : numeric1, numeric1 + numeric2 : numeric";
        "f h = h.p": "Hit -> Vec3";
        "f h = h.p.x": "Hit -> Number";
        "f h = h.uv": "a -> b where a.uv : b";
        "f h = h.uv.x + h.world.x": "Hit -> Number";
        "f k g h = g { h | p = h.p * k }": "a -> (Hit -> b) -> Hit -> b where a is a number or a vector of three";
        "tiles h = if odd (floor h.p.x + floor h.p.z) then white else #f4efe6": "Hit -> Color";
        "veined size h = let q = h.p / size\n                    vein = sin (q.x * 4 + 6 * turbulence 8 q)\n                in mix white #1d3b53 (vein / 2 + 0.5)": "a -> Hit -> Color where a is a number or a vector of three";
        "f { x, y = z } = x + z": "a -> numeric where a.x : numeric1, a.y : numeric2, numeric1 + numeric2 : numeric";
        "g r = r.a + 1\nf = g { a = 2, b = 3 }": "Number";
        "g r = { r | a = 2 }\nf = g { a = 1, b = 3 }": "{ a : Number, b : Number }";
        "f = \\h -> h.normal.y": "Hit -> Number";
    } {
        assert_eq!(inferred(text), expected, "{text}");
    }
}

#[test]
fn constructors() {
    for (text, expected) in types! {
        "a = sphere {}": "Shape";
        "f r = sphere { radius = r }": "Number -> Shape";
        "f r = sphere r": "a -> Shape where a fits `sphere`";
        "a = map sphere [{ radius = 1 }]": "[Shape]";
        "base = { radius = 1, center = (0, 0, 0) }\na = [sphere base, sphere { base | radius = 2 }]": "[Shape]";
        "a = { radius = 2 } |> sphere |> translate (0, 1, 0)": "Shape";
        "a = classic { color = 0.5 }": "Material";
        "a = classic { color = \\h -> h.normal.x }": "Material";
        "a = classic { color = \\h -> mix white black h.uv.x, reflection = \\h -> h.p.x }": "Material";
        "a = classic { color = checker white black, bump = \\h -> h.p.x }": "Material";
        "f c = classic { color = c }": "a -> Material where a fits `color` of `classic`";
        "f c = classic { color = c }\ng = [f white, f 0.5, f (\\h -> white * h.p.x)]": "[Material]";
        "f c = point { position = (0, 1, 2), intensity = c }": "a -> Light where a is a number or a colour";
        "ring n radius shape =\n  [ shape |> translate (radius * cos a, 0, radius * sin a)\n  | i <- [0 .. n - 1], let a = turn * i / n ]": "Number -> Number -> placeable -> [placeable]";
        "a = [rotate up 1 (\\h -> h.p.x)]": "[Hit -> Number]";
        "a = scale 2 (classic {})": "Material";
    } {
        assert_eq!(inferred(text), expected, "{text}");
    }
}

#[test]
fn annotations() {
    for (text, expected) in types! {
        "f : Number -> Number\nf x = x": "Number -> Number";
        "f : numeric -> numeric -> numeric\nf a b = a + b * 2": "numeric -> numeric -> numeric";
        "f : a -> [a] -> Bool\nf x list = any [x == y | y <- list]": "a -> [a] -> Bool";
        "f : vector -> Number\nf v = v.x + length v": "vector -> Number";
        "f : { a : Number } -> Number\nf r = r.a": "{ a : Number } -> Number";
        "a = ([] : [Number])": "[Number]";
        "f x = let g : b -> b\n          g y = y\n      in g x": "a -> a";
    } {
        assert_eq!(inferred(text), expected, "{text}");
    }
}

#[test]
fn polymorphic_lets_are_used_at_several_types() {
    assert_eq!(inferred("a = let f x = [x] in { n = f 1, t = f \"x\" }"), "{ n : [Number], t : [Text] }");
    assert_eq!(inferred("a = let (x, y) = (1, 2)\n        z = x + y\n    in z"), "Number");
    assert_eq!(
        inferred(
            "a = let even n = n == 0 or odd (n - 1)\n        odd n = n != 0 and even (n - 1)\n    in even 4"
        ),
        "Bool"
    );
}

#[test]
fn what_would_go_wrong_is_refused() {
    for text in [
        "f x = x x",
        "f : a -> Number\nf x = x",
        "f : a -> b\nf x = x",
        "f : numeric -> numeric1 -> numeric\nf a b = a + b",
        "f : a -> Number\nf x = x.y",
        "f : a -> a\nf x = x + 1",
        "f x = (x.a + 1, x.a ++ \"x\")",
        "f = (\\x -> x) == (\\x -> x)",
        "f x = let g : a -> a\n          g y = x\n      in g 1",
        "same a b = a == b\nf = same sin cos",
        "f r = sphere r\ng = f { radios = 1 }",
        "f r = sphere r\ng = f 3",
        "f r = r.a\ng = f { b = 1 }",
        "add a b = a + b\ng = add (1, 2) (1, 2, 3)",
        "f v = v.z\ng = f (1, 2)",
        "f x = translate (0, 0, 0) x\ng = f 1",
        "f x = translate (0, 0, 0) x\ng = f (\\y -> y + 1 == 2)",
        "f c = classic { color = c }\ng = f \"red\"",
        "f c = classic { color = c }\ng = f (\\v -> v.x + (v.z + v.y))\nh = f sin",
        "f n = f (n + 1) + f true",
        "f (x, y) = x\ng = f (1, 2, 3)",
        "f { x } = x\ng = f (1, 2, 3)",
        "f h = { h | p = 1 }\ng = f { p = true }",
    ] {
        assert_ne!(errors(text), "", "{text}");
    }
}
