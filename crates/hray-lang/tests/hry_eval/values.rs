//! Arithmetic, lists, records, functions: cases whose answers are known.

use crate::common::number;

macro_rules! numbers {
    ($($name:ident: $text:expr => $value:expr;)+) => {$(
        #[test]
        fn $name() {
            assert_eq!(number("", $text), $value);
        }
    )+};
}

numbers! {
    precedence: "1 + 2 * 3 ^ 2 - 4 / 2" => 17.0;
    power_binds_tighter_than_minus: "-2 ^ 2" => -4.0;
    power_is_right_associative: "2 ^ 3 ^ 2" => 512.0;
    minus_is_left_associative: "10 - 3 - 2" => 5.0;
    modulo_has_the_sign_of_the_divisor: "(-7) % 3 + 10 * (7 % -3)" => 2.0 - 20.0;
    degrees: "180deg - 3.141592653589793" => 0.0;
    percent: "50%" => 0.5;
    exponents: "1e-3 + 1_000" => 1000.001;
    a_negative_argument: "abs -3" => 3.0;
    pipes: "[1, 2, 3] |> map (\\x -> x * x) |> sum" => 14.0;
    composition: "(abs >> sqrt) -9" => 3.0;
    conditions: "if 1 < 2 and not (2 < 1) then 1 else 0" => 1.0;
    or_stops_early: "if true or at 0 [] then 1 else 0" => 1.0;
    ranges_are_inclusive: "sum [1 .. 10]" => 55.0;
    ranges_with_a_step: "sum [0, 0.5 .. 2] + 10 * count [0, 0.1 .. 1]" => 115.0;
    ranges_that_fall: "count [5, 4 .. 1]" => 5.0;
    ranges_that_are_empty: "count [3 .. 1]" => 0.0;
    comprehensions: "sum [x * y | x <- [1 .. 3], y <- [x .. 3], odd (x + y)]" => 2.0 + 6.0;
    lets_in_comprehensions: "sum [z | x <- [1 .. 3], let z = x * 2, z > 2]" => 10.0;
    lets_in_any_order: "let a = b + 1\n b = 2 in a" => 3.0;
    lets_of_patterns: "let (x, y) = (3, 4) in sqrt (x * x + y * y)" => 5.0;
    vectors_componentwise: "dot ((1, 2, 3) * (4, 5, 6)) (1, 1, 1)" => 32.0;
    vectors_and_numbers: "length ((3, 4) * 2)" => 10.0;
    swizzles: "(1, 2, 3).zyx.x * 10 + (1, 2, 3).xz.y" => 33.0;
    colours: "(rgb 0.1 0.2 0.3).g" => 0.2;
    records: "let r = { a = 1, b = 2 } in { r | b = 5 }.b + r.a" => 6.0;
    matches_of_lists: "let f l = match l { [] -> 0, [x] -> x, [x, y, ..rest] -> x * y + count rest } in f [] + f [3] + f [2, 5, 7, 7]" => 15.0;
    matches_of_numbers: "let f n = match n { 0 -> 10, 1 -> 20, _ -> 30 } in f 0 + f 1 + f 7" => 60.0;
    recursion: "let fib n = if n < 2 then n else fib (n - 1) + fib (n - 2) in fib 15" => 610.0;
    mutual_recursion: "let ev n = if n == 0 then 1 else od (n - 1)\n od n = if n == 0 then 0 else ev (n - 1) in ev 100" => 1.0;
    partial_application: "let add a b c = a + b + c\n f = add 1 2 in f 3 + f 4" => 13.0;
    functions_of_functions: "let twice f x = f (f x) in twice (twice (\\x -> x * 2)) 1" => 16.0;
    closures_keep_what_they_saw: "let f = (\\k -> \\x -> x * k) 3\n k = 100 in f 2 + k - k" => 6.0;
    folds_go_from_the_left: "fold (\\a b -> a - b) 10 [1, 2, 3]" => 4.0;
    elements: "at 2 [5, 6, 7]" => 7.0;
    sorting: "at 0 (sortBy (\\x -> -x) [3, 9, 5])" => 9.0;
    concatenation: "count (concat [[1], [], [2, 3]])" => 3.0;
    texts: "if \"a\" ++ \"b\" == \"ab\" then 1 else 0" => 1.0;
    equality_of_lists: "if [1, 2] == [1, 2] and [1] != [2] then 1 else 0" => 1.0;
    loops: "iterate 10 (\\x -> x > 100) (\\x -> x * 2) 1" => 128.0;
    loops_end: "iterate 3 (\\x -> false) (\\x -> x * 2) 1" => 8.0;
    deep_recursion: "let f n = if n == 0 then 0 else 1 + f (n - 1) in f 9000" => 9000.0;
    noise_is_zero_on_the_lattice: "noise (3, -2, 7)" => 0.0;
    seeds_differ: "if perlin 1 (0.5, 0.3, 0.2) == perlin 2 (0.5, 0.3, 0.2) then 1 else 0" => 0.0;
    random_is_pure: "random 3 4 - random 3 4" => 0.0;
    clamped: "clamp 0 1 7 + clamp 0 1 -7" => 1.0;
    mixed: "mix 10 20 0.25" => 12.5;
}

#[test]
fn random_numbers_lie_in_their_range_and_are_spread() {
    let mean = number("", "sum [random 1 i | i <- [1 .. 10000]] / 10000");
    assert!((mean - 0.5).abs() < 0.02, "{mean}");
    assert_eq!(number("", "count [i | i <- [1 .. 1000], random 7 i < 0 or random 7 i >= 1]"), 0.0);
}

#[test]
fn definitions_have_no_order_and_are_evaluated_once() {
    assert_eq!(number("a = b * 2\nb = c + 1\nc = 20", "a"), 42.0);
}
