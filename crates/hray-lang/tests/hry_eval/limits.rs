//! Whatever a scene says, evaluation ends, and says why.

use crate::common::{errors, errors_with};
use hray_lang::hry::eval::Limits;

fn with(change: impl FnOnce(&mut Limits)) -> Limits {
    let mut limits = Limits::default();
    change(&mut limits);
    limits
}

#[test]
fn recursion_without_end() {
    let text = errors("f n = f (n + 1)\nscene = { objects = [sphere { radius = f 0 }] }");
    assert!(text.contains("calls go deeper than 10,000") && text.contains("in `f`, called at 1:7"), "{text}");
}

#[test]
fn steps_run_out() {
    let limits = with(|limits| limits.steps = 1000);
    let text = errors_with("scene = { objects = [sphere { radius = sum [1 .. 2000] }] }", &limits);
    assert!(text.contains("more than 1,000 steps"), "{text}");
}

#[test]
fn lists_get_too_long() {
    let limits = with(|limits| limits.list = 100);
    for list in ["[1 .. 200]", "[x | x <- [1 .. 99], y <- [1 .. 99]]", "fold (\\l i -> l ++ l) [1] [1 .. 20]"]
    {
        let text =
            errors_with(&format!("scene = {{ objects = [sphere {{ radius = count ({list}) }}] }}"), &limits);
        assert!(text.contains("the list at 1:") && text.contains("grew past 100 elements"), "{text}");
    }
}

#[test]
fn memory_runs_out() {
    let limits = with(|limits| limits.memory = 1 << 20);
    let text = errors_with(
        "x = fold (\\t i -> t ++ t) \"ab\" [1 .. 40]\nscene = { objects = [sphere { radius = if x == \"\" then 1 else 2 }] }",
        &limits,
    );
    assert!(text.contains("more than 1 MiB"), "{text}");
    let text = errors_with(
        "scene = { objects = [sphere { radius = count [[1 .. 100] | i <- [1 .. 10000]] }] }",
        &limits,
    );
    assert!(text.contains("more than 1 MiB"), "{text}");
}

#[test]
fn functions_get_too_large() {
    let limits = with(|limits| limits.nodes = 50);
    let text = errors_with(
        "scene = { objects = [sphere { material = classic { reflection = \\h -> fbm 100 h.p } }] }",
        &limits,
    );
    assert!(text.contains("more than 50 operations") && text.contains("--eval-nodes"), "{text}");
}

#[test]
fn recursion_that_the_hit_ends() {
    let text = errors(
        "f x h = if x > h.p.x then x else f (x * 2) h\nscene = { objects = [sphere { material = classic { reflection = f 1 } }] }",
    );
    assert!(text.contains("ends only where the hit says so") && text.contains("iterate"), "{text}");
}

#[test]
fn chains_of_functions_are_bounded() {
    let text = errors(
        "f = fold (\\g i -> g >> abs) abs [1 .. 100000]\nscene = { objects = [sphere { radius = f 1 }] }",
    );
    assert!(text.contains("put one into the other"), "{text}");
}

#[test]
fn solids_do_not_nest_without_bound() {
    let text =
        errors("scene = { objects = [fold union (sphere {}) [sphere { radius = i } | i <- [1 .. 1000]]] }");
    assert!(text.contains("nested more than 200 deep"), "{text}");
}

#[test]
fn endless_loops_end() {
    let limits = with(|limits| limits.steps = 100_000);
    let text = errors_with(
        "scene = { objects = [sphere { radius = iterate 1e9 (\\x -> false) (\\x -> x) 1 }] }",
        &limits,
    );
    assert!(text.contains("100,000 steps"), "{text}");
}

#[test]
fn loops_in_loops_are_bounded() {
    let text = errors(
        "inner h x = iterate 90000 (\\y -> y > h.p.y) (\\y -> y + 1) x
f h = iterate 90000 (\\x -> x > h.p.x) (inner h) 0
scene = { objects = [sphere { material = classic { reflection = f } }] }",
    );
    assert!(text.contains("more than 100 million operations for one hit"), "{text}");
}
