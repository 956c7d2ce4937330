//! What a user sees of every kind of mistake. The snapshots are to be read as by someone who has never seen the language:
//! what was found, what was expected, how to mend it.

use hray_lang::diagnostic::render;
use hray_lang::hry::ast::PatternKind;
use hray_lang::hry::syntax::parse;
use insta::assert_snapshot;

/// All that there is to say about a text with mistakes in it.
fn shown(text: &str) -> String {
    let parse = parse(text, 0);
    assert!(!parse.errors().is_empty(), "nothing is wrong with {text:?}");
    assert!(parse.errors().len() <= 20);
    render(parse.errors(), "scene.hry", text, false)
}

/// The mistakes of one kind, each with a name.
macro_rules! mistakes {
    ($($kind:ident { $($name:ident: $text:expr;)+ })+) => {$(
        #[test]
        fn $kind() {
            $(assert_snapshot!(concat!(stringify!($kind), "-", stringify!($name)), shown($text));)+
        }
    )+};
}

mistakes! {
    characters {
        slash_comments: "// the floor
floor = plane { height = 0 }  // flat
";
        c_comments: "/* balls */
ball = sphere { radius = 1 }
";
        hash_comments: "# balls
ball = sphere { radius = 1 } # one
";
        hash_word: "#balls
ball = sphere { radius = 1 }
";
        single_quotes: "name = 'hello'
";
        smart_quotes: "name = “hello”
";
        unclosed_text: r#"name = "hello
other = 1
"#;
        bad_escape: r#"path = "C:\scenes\new"
"#;
        negative_without_equals: "a = plane { offset -1 }
b = plane { normal = up, offset -1 }
";
        unicode_minus: "x = −1
y = 3 × 4
z = a ≤ b
";
        unclosed_comment: "x = 1
{- a comment {- nested -}
y = 2
";
        comment_that_swallows: "a = b --> c
x = 3 {-
";
        curly_comment_in_record: "a = {-1}
";
        backtick: "a = 3 `mod` 2
";
        dollar: "f x = g $ h x
";
        ternary: "f x = x > 0 ? 1 : 2
";
        question_mark_in_if: "a x = if x > 0 ? 1 : 2
";
        backwards_pipe: "f x = g <| h x
";
        as_pattern: "f p@(x, y) = p
";
        colours: "a = #12
b = #gggggg
c = #ff00ff80
d = #
";
        povray_scene: "camera { location <0, 2, -3> look_at <0, 1, 2> }
light_source { <2, 4, -3> color White }
plane { <0, 1, 0>, -1 pigment { checker color White, color Black } }
";
        povray_in_a_list: "scene = {
  objects = [
    sphere { <0, 0, 0>, 2 pigment { color Red } },
  ],
}
";
        povray: "sphere { <0, 1, 2>, 2 pigment { color rgb <1, 0, 0> } }
#declare R = 3;
";
        non_breaking_space: "x = 1 +\u{a0}2\n";
        invisible: "x = 1 +\u{200b} 2\n";
        carriage_returns: "a = (1,\r\n  2\r\nb = 3\r\n";
    }

    numbers {
        number_forms: "a = 1.
b = .5
c = 0x1F
d = 1.2.3
e = 1e
f = 2x
g = 2pi + 3r
h = 90degrees
i = 1.5f
j = 1e999
";
        percent: "a = 50 %
b = 7%2
c = 7% 2
";
        deg_apart: "a = 30 deg
";
        unit_after_number: "fov = 35 degrees
h = 3 m
";
        number_call: "a = 3 (4)
b = (1, 2) (3, 4)
c = 2 -1
";
        plus_sign: "a = +1
b = (1, +2, -3)
";
    }

    operators {
        and_or_not: "test a b = a && b || !a
";
        not_equal: "one a b = a /= b
two a b = a <> b
three a b = a !== b
four a b = a === b
";
        power: "f x = x ** 2
";
        chained_comparison: "a x = 0 < x < 1
b x y z = x == y == z
";
        bang_infix: "a = list ! 3
";
        single_equals: "f x = if x = 1 then 2 else 3
g = [x | x <- list, x = 3]
";
        walrus: "x := 3
";
        operator_section: "a = map (+ 1) [1, 2]
b = fold (+) 0 list
c = map (* 2) list
";
        trailing_operator: "a = 1 +
b = 2
";
        increment: "f x = x++
";
        arrow_in_comparison: "f x = x <-1
";
        not_operator: "a = not
b = - 
";
        pipe_first: "a = |> b
";
        text_then_text: r#"a = "one" "two"
"#;
    }

    brackets {
        stray_closing: "list = [1, 2, 3]]
other = (1 + 2))
fine = 3
";
        unclosed_in_middle: "scene = {
  size = (640, 480,
  objects = [ball, floor],
}
other = 1
";
        unclosed_list_then_definition: "list = [1, 2, 3
other = 4
third = (5
";
        wrong_bracket: "point = (1, 2, 3]
list = [1, 2, 3}
";
        unclosed_brace_at_end: "scene = {
  objects = [ sphere { radius = 1 } ],
";
        missing_closing_paren_in_nested_call: "scene = { objects = [ translate (1, 2, 3 (sphere { radius = 1 }) ], depth = 3 }
";
        brace_not_closed_before_the_next_definition: "ball = sphere {
  radius = 1,
  center = (0, 0, 0)

floor = plane { height = 0 }
";
        mixed_line_ends_and_tabs: "a =	(1,
	2
b = 3
";
    }

    vectors {
        four_tuple: "color = (1, 0, 0, 1)
";
        empty_parentheses: "x = f ()
g () = 1
";
        one_tuple: "x = (1,)
";
        trailing_comma_in_call: "a = f(1, 2,)
b = f(1,)
";
        four_pattern: "f (a, b, c, d) = a
";
        missing_comma_vector_name: "p = (x y, 2)
q = (1, 2 3)
";
    }

    lists {
        list_missing_commas: "list = [1 2 3]
point = (1 2 3)
colors = [#fff #000]
";
        range_dots: "a = [0...5]
b = [1, 2, ..5]
c = [1..]
d = [..5]
e = [1, 2, 3 .. 10]
";
        range_in_for: "a = [0 .. 10 step 2]
";
        dot_dot_dot_in_list: "a = [1, ...rest]
";
        comprehension_in: "balls = [x | x in list]
";
        comprehension_empty: "balls = [x | ]
";
        two_bars: "a = [x | x <- list | y <- other]
b = { r | x = 1 | y = 2 }
";
        two_errors: "a = [1, 2,, 3]
b = (1, , 2)
c = { x = , y = 2 }
d = if then else
";
    }

    records {
        record_colons: "ball = sphere { radius: 1, center: (0, 0, 0) }
";
        record_without_equals: "ball = sphere { radius 1, center (0, 0, 0) }
";
        record_missing_comma_lines: "ball = sphere {
  radius = 1
  center = (0, 0, 0)
  material = gold
}
";
        record_missing_comma_one_line: "ball = sphere { radius = 1 center = (0, 0, 0) }
";
        update_empty: "a = { r | }
b = { r with x = 1 }
c = { ...r, x = 1 }
";
        leading_comma_record: "a = { , x = 1 }
";
        two_bars_in_record: "a = { x = 1 | y = 2 }
";
    }

    conditions {
        missing_else: "f x = if x > 0 then x
g = 2
";
        missing_then: "f x = if x > 0 x else 1
";
        braces_if: "f x = if (x > 0) { 1 } else { 2 }
";
        elif: "f x =
  if x > 0 then 1
  elif x < 0 then 2
  else 3
";
        then_on_wrong: "a = then 3
";
        then_newline_else: "a x =
  if x then 1
else 2
";
        if_alone: "a = if
";
        else_without_if: "a = 1 else 2
";
        then_in_condition_missing_value: "a x = if x > then 1 else 2
";
    }

    lets {
        missing_in: "f x =
  let y = x * 2
  y + 1
";
        missing_in_at_the_end: "f x =
  let y = x * 2
";
        let_without_binding: "f x = let in x
";
        let_empty_binding: "f x =
  let y =
  in y
";
        local_definition_without_let: "f x =
  y = x * 2
  y + 1
";
        let_commas: "f x = let a = 1, b = 2 in a + b
g x = let a = 1; b = 2 in a + b
";
        let_two_on_a_line: "f x = let a = 1 b = 2 in a + b
";
        let_at_top: "let radius = 3
let f x = x + 1
";
        lonely_let: "a = let
b = 2
";
        in_without_let: "a = 1 in 2
";
        nested_annotation: "f x =
  let g : Number
  in x
";
        assign_in_let_body: "f x = let a = 1 in b = 2
";
    }

    matches {
        match_of: "f x = match x of
  [] -> 0
";
        match_with: "f x = match x with | [] -> 0
";
        match_arms_without_commas: "f x = match x {
  [] -> 0
  [a] -> a
  _ -> 2
}
";
        match_bar_arms: "f x = match x {
  | [] -> 0
  | _ -> 2
}
";
        match_fat_arrows: "f x = match x { 0 => 1, _ => 2 }
";
        cons: "f list = match list { x :: rest -> x, x : rest -> 2 }
";
        list_pattern_rest_first: "f l = match l { [.. rest, x] -> 1 }
";
        list_pattern_rest_without_comma: "f l = match l { [x .. rest] -> 1 }
";
        match_without_subject: "a = match { [] -> 0 }
";
        match_arm_without_body: "a = match x { [] -> , [y] -> y }
";
        match_arm_without_pattern: "a = match x { -> 1 }
";
        chain_of_arrows_in_case: "f x = match x { 0 -> 1 -> 2 }
";
    }

    functions {
        js_arrow: "double = x => x * 2
ok = map (x -> x * 2) [1, 2]
";
        python_lambda: "double = lambda x: x * 2
";
        lambda_argument: r#"a = map \x -> x + 1 list
b = f if a then b else c
"#;
        lambda_no_arrow: r#"a = \x = x
b = \x x + 1
c = \ -> 1
"#;
        accessor: "a = map .x points
";
        space_before_dot: "a = h .p
b = h. p
";
        equation_clauses: "f 0 = 1
f n = n * f (n - 1)
";
        guards: "f x
  | x > 0 = 1
  | otherwise = 2
";
        type_in_definition: "f (x : Number) = x
";
    }

    names {
        keyword_as_name: "match = 3
in = 4
ball = sphere { in = 3 }
";
        keyword_as_parameter: "f if x = x
g or = or
";
        upper_case: "Radius = 3
ball = sphere { Radius = 3 }
f X = X + 1
";
    }

    definitions {
        no_body: "radius =
other = 2
";
        missing_equals: "radius 3
other = 2
";
        expression_at_top: "sphere { radius = 1 }
";
        semicolons: "radius = 1;
ball = sphere { radius = radius; center = (0, 0, 0) };
";
        comma_between_definitions: "a = 1,
b = 2,
";
        layout_cut: "scene = {
  size = (1, 2)
}
|> foo
other = [1] ++
[2]
";
        layout_cut_operator: "total =
1 + 2
";
        indented_definition: "a = 1
  b = 2
c = 3
";
        field_assign: "r.x = 3
";
        equals_equals_definition: "x == 3
";
        arrow_definition: "f x -> x + 1
";
        comma_list_at_top: "a, b = (1, 2)
";
        pattern_definition_at_top: "(a, b) = (1, 2)
";
    }

    annotations {
        annotation_alone: "radius : Number
other = 2
";
        annotation_twice: "radius : Number
radius : Number
radius = 3
";
        annotation_with_body: "radius : Number = 3
";
        elm_type: "x : Maybe Number
x = 1
y : List Number
y = []
";
        generic_type: "x : [Number
x = 1
z : (Number, Number)
z = (1, 2)
";
        double_colon: "f :: Number -> Number
f x = x
";
        value_in_type: "x : 3
x = 3
";
        type_arrow_missing: "f : Number Number
f x = x
";
        record_type_equals: "p : { x = Number }
p = { x = 1 }
";
    }

    imports {
        import_without_quotes: "import palette
import palette.hry
";
        import_from: r#"import { gold } from "palette.hry"
from "palette.hry" import gold
"#;
        import_semicolon: r#"import "palette.hry";
x = 1
"#;
        import_list_without_parens: r#"import "palette.hry" gold, ink
"#;
        import_as_upper: r#"import "a.hry" as Foo
"#;
        as_keyword: r#"import "a.hry" as
x = 1
"#;
    }

    other_languages {
        python_def: "def ring(n, radius):
    return [sphere { radius = radius } for i in range(n)]

other = 1
";
        js_function: "function ring(n) {
  return n * 2;
}
const other = 1;
";
        glsl: "vec3 color(vec3 p) { return p; }
float x = 1.0;
";
        where: "f x = y + 1
  where y = x * 2
";
        case_of: "f x = case x of
  [] -> 0
  _ -> 1
";
        for_loop: "balls = for i in [1 .. 3] { sphere { radius = i } }
";
        python_comprehension: "balls = [sphere { radius = i } for i in [1 .. 3]]
";
        do_block: "main = do
  x <- f
  g x
";
        data_type: "type Point = { x : Number }
data Shape = Sphere
";
        module_header: "module Main where
x = 1
";
    }
}

/// However much is wrong, no more is said than anybody reads.
#[test]
fn at_most_twenty_errors_are_shown() {
    let text = "a = (1,, 2)\n".repeat(100);
    assert_eq!(parse(&text, 0).errors().len(), 20);
}

/// A mistake in one definition leaves the others as they are.
#[test]
fn other_definitions_are_read_all_the_same() {
    let text = "a = (1\nb = 2 +\nc x =\n  y = 3\n  y\nd = [1 2]\ne = 5\n";
    let parse = parse(text, 0);
    let definitions = parse.module().definitions;
    let names: Vec<&str> = definitions
        .iter()
        .filter_map(|one| match &one.target.kind {
            PatternKind::Name(name) => Some(&**name),
            _ => None,
        })
        .collect();
    assert_eq!(names, ["a", "b", "c", "d", "e"]);
    assert_eq!(parse.errors().len(), 4);
}
