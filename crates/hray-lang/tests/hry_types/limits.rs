//! Nothing that a text contains takes more than linear time, or the stack.

use crate::common::{Files, checked, errors, with_scene};
use std::fmt::Write as _;
use std::time::Instant;

/// What takes less than a second on an idle machine is far below this on a busy one; what grows with the square of
/// the size is above.
const MOST_SECONDS: f64 = 60.0;

/// Checks a text; the number of errors.
fn timed(name: &str, text: &str) -> usize {
    let start = Instant::now();
    let (_, _, diagnostics) = checked(text, &Files(&[]));
    let seconds = start.elapsed().as_secs_f64();
    assert!(seconds < MOST_SECONDS, "{name}: {seconds} s");
    diagnostics.iter().filter(|diagnostic| diagnostic.is_error()).count()
}

#[test]
fn large_files() {
    let numbers: String = (0..100_000).map(|i| format!("{i}, ")).collect();
    assert_eq!(timed("list of 100,000", &with_scene(&format!("a = [{numbers}]"))), 0);
    let spheres: String =
        (0..20_000).map(|i| format!("sphere {{ radius = {}, center = (0, 1, {i}) }}, ", i + 1)).collect();
    assert_eq!(timed("20,000 spheres", &format!("scene = {{ objects = [{spheres}] }}")), 0);
    let chain: String = (1..10_000).map(|i| format!("f{i} x = f{} x + {i}\n", i - 1)).collect();
    assert_eq!(timed("10,000 definitions in a chain", &with_scene(&format!("f0 x = x\n{chain}"))), 0);
    let circle: String = (0..2_000).map(|i| format!("f{i} x = f{} x + {i}\n", (i + 1) % 2_000)).collect();
    assert_eq!(timed("2,000 definitions in a circle", &with_scene(&circle)), 0);
    let fields: String = (0..5_000).map(|i| format!("c{i} = {i}, ")).collect();
    let uses: String = (0..5_000).map(|i| format!("u{i} = palette.c{i}\n")).collect();
    assert_eq!(
        timed("a record of 5,000 fields", &with_scene(&format!("palette = {{ {fields} }}\n{uses}"))),
        0
    );
}

#[test]
fn wrong_a_hundred_thousand_times() {
    let wrong: String = (0..100_000).map(|i| format!("\"{i}\", ")).collect();
    let count = timed("100,000 errors", &with_scene(&format!("a = [1, {wrong}]")));
    assert!((1..=60).contains(&count), "{count}");
}

#[test]
fn types_that_would_grow_without_end() {
    let mut doubled = "f0 x = { a = x, b = x }\n".to_owned();
    for i in 1..60 {
        let _ = writeln!(doubled, "f{i} x = f{} (f{} x)", i - 1, i - 1);
    }
    assert!(errors(&doubled).contains("type-too-large"));
    let mut pairs = "p0 = \\x y z -> { a = x, b = y, c = z }\n".to_owned();
    for i in 1..60 {
        let _ = writeln!(pairs, "p{i} = {{ a = p{}, b = p{} }}", i - 1, i - 1);
    }
    assert!(errors(&pairs).contains("type-too-large"));
    let mut sums = "s0 a b = a + b\n".to_owned();
    for i in 1..30 {
        let _ = writeln!(sums, "s{i} a b = s{} (s{} a b) (s{} b a)", i - 1, i - 1, i - 1);
    }
    timed("sums", &with_scene(&sums));
    let mut nested = "n0 = []\n".to_owned();
    for i in 1..2_000 {
        let _ = writeln!(nested, "n{i} = [n{}]", i - 1);
    }
    assert!(errors(&nested).contains("type-too-large"));
}

#[test]
fn deep_types_from_flat_text() {
    let generators: String = (0..3_000).map(|i| format!("a{i} <- [], ")).collect();
    let guards: Vec<String> = (1..3_000).map(|i| format!("a{} == [a{i}]", i - 1)).collect();
    timed("flat", &with_scene(&format!("x = [0 | {generators} {}]", guards.join(", "))));
    let guards: Vec<String> = (1..3_000).rev().map(|i| format!("a{} == [a{i}]", i - 1)).collect();
    timed("flat, reversed", &with_scene(&format!("x = [0 | {generators} {}]", guards.join(", "))));
    let parameters: String = (0..3_000).map(|i| format!("a{i} ")).collect();
    assert!(errors(&format!("f {parameters} = 1")).contains("too-many-parameters"));
    let arguments = "1 ".repeat(400);
    timed("many arguments", &with_scene(&format!("f x = x {arguments}")));
}

#[test]
fn many_demands_on_one_parameter() {
    let sums: Vec<String> = (0..5_000).map(|i| format!("x.f{}", i % 100)).collect();
    let lists: Vec<String> = sums.chunks(100).map(|sums| format!("[{}]", sums.join(", "))).collect();
    timed("5,000 fields", &with_scene(&format!("f x = [{}]", lists.join(", "))));
    let lets: String = (1..3_000).map(|i| format!("          y{i} = y{} + x\n", i - 1)).collect();
    timed("3,000 sums", &with_scene(&format!("f x z = let y0 = x + z\n{lets}      in y2999")));
}

#[test]
fn deep_texts() {
    let nested = |open: &str, close: &str, middle: &str| {
        format!("x = {}{middle}{}", open.repeat(400), close.repeat(400))
    };
    for (name, text) in [
        ("parentheses", nested("(", ")", "1")),
        ("lists", nested("[", "]", "1")),
        ("ifs", nested("if true then 1 else (", ")", "1")),
        ("lets", nested("let y = 1 in ", "", "y")),
        ("lets inside", nested("(let y = ", " in y)", "1")),
        ("lambdas", nested("\\a -> ", "", "1")),
        ("calls", nested("sin (", ")", "1")),
        ("records", nested("{ a = ", " }", "1")),
        ("spheres", nested("(sphere { radius = ", " })", "1")),
        ("vectors", nested("(1, ", ")", "1")),
        ("matches", nested("match 1 { _ -> ", " }", "1")),
        ("comprehensions", nested("[ 1 | _ <- ", " ]", "[]")),
        ("sums", nested("1 + (", ")", "1")),
        ("vectors as arguments", nested("dot(1, ", ")", "1")),
        ("pipes", format!("x = 1 {}", "|> sin ".repeat(400))),
        ("long sums", format!("x = 1 {}", "+ 1 ".repeat(400))),
    ] {
        timed(name, &with_scene(&text));
    }
}
