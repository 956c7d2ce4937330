//! The formatter: its layout, and that it never changes what a text means.

use crate::generate::program;
use hray_lang::hry::format::{WIDTH, format};
use hray_lang::hry::syntax::parse;
use insta::assert_snapshot;
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;

/// The abstract syntax without its spans, as text.
fn meaning(text: &str) -> String {
    let written = format!("{:?}", parse(text, 0).module());
    let mut pieces = written.split("Span { start: ");
    let first = pieces.next().unwrap_or("").to_owned();
    pieces.fold(first, |all, piece| all + piece.split_once('}').map_or("", |(_, rest)| rest))
}

/// Every comment of a text, in order. What is a comment is asked of the tree.
fn comments(text: &str) -> Vec<String> {
    let root = parse(text, 0).root();
    let tokens = root.descendants_with_tokens().filter_map(|element| element.into_token());
    let comments = tokens.filter(|token| token.kind().is_trivia() && !token.text().trim().is_empty());
    comments.map(|token| token.text().trim().to_owned()).collect()
}

/// Formats a text that is right, and checks what has to hold.
fn holds(text: &str) -> Result<String, TestCaseError> {
    let formatted = match format(text) {
        Ok(formatted) => formatted,
        Err(errors) => return Err(TestCaseError::fail(format!("{errors:?} in\n{text}"))),
    };
    let errors = parse(&formatted, 0).errors().to_vec();
    prop_assert!(errors.is_empty(), "{:?}\n{}\nbecame\n{}", errors, text, formatted);
    prop_assert_eq!(meaning(text), meaning(&formatted), "{}\nbecame\n{}", text, &formatted);
    let (mut before, mut after) = (comments(text), comments(&formatted));
    before.sort();
    after.sort();
    prop_assert_eq!(before, after, "{}\nbecame\n{}", text, &formatted);
    let again = format(&formatted).map_err(|errors| TestCaseError::fail(format!("{errors:?}")))?;
    prop_assert_eq!(&again, &formatted, "formatting again changes\n{}", text);
    prop_assert!(
        formatted.lines().all(|line| line == line.trim_end() || line.contains("{-")),
        "{}",
        formatted
    );
    Ok(formatted)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, max_global_rejects: 100_000, ..ProptestConfig::default() })]

    #[test]
    fn formatting_keeps_meaning_and_comments(text in program()) {
        prop_assume!(parse(&text, 0).errors().is_empty());
        holds(&text)?;
    }
}

#[test]
fn most_random_programs_are_programs() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let right = (0..200).filter(|_| {
        let text = program().new_tree(&mut runner).expect("a program").current();
        parse(&text, 0).errors().is_empty()
    });
    assert!(right.count() > 60);
}

#[test]
fn a_text_with_errors_is_not_touched() {
    assert!(format("a = (1").is_err());
}

#[test]
fn nothing_and_comments_alone_are_kept() {
    assert_eq!(format("").as_deref(), Ok(""));
    assert_eq!(format("\n\n").as_deref(), Ok(""));
    assert_eq!(format("\n-- a\n\n\n\n{- b -}").as_deref(), Ok("-- a\n\n{- b -}\n"));
    assert_eq!(format("\u{feff}a=1\r\n").as_deref(), Ok("a = 1\n"));
}

/// The standard library and the examples keep their meaning too.
#[test]
fn the_files_of_the_project_can_be_formatted() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut count = 0;
    for folder in ["std", "../../examples"] {
        let Ok(files) = std::fs::read_dir(root.join(folder)) else { continue };
        let hry = files
            .flatten()
            .map(|file| file.path())
            .filter(|path| path.extension().is_some_and(|end| end == "hry"));
        for path in hry {
            let text = std::fs::read_to_string(&path).expect("a file of the project");
            if !text.trim_start().starts_with("renderDescr") && parse(&text, 0).errors().is_empty() {
                holds(&text).expect("a file that can be formatted");
                count += 1;
            }
        }
    }
    assert!(count > 3);
}

/// Each a text, and its layout beside it as a snapshot.
macro_rules! layouts {
    ($($name:ident: $text:expr;)+) => {$(
        #[test]
        fn $name() {
            let formatted = holds($text).expect("a text that can be formatted");
            assert!(formatted.lines().all(|line| line.chars().count() <= WIDTH));
            assert_snapshot!(stringify!($name), formatted);
        }
    )+};
}

layouts! {
    definitions: "a=1\nb   =  2 -- two\n\n\n\nc x y=x+y";
    operators: "a = -x^2*y+f -1 (- 2) - -3\nb = - -x\nc = not a and b or c\nd = a-b -c\n";
    records: "a = {x=1,y=2,}\nb = {\nx=1,y=2}\nc = {x\n,y\n}\nd = { r|x=1 }\ne = { r |\n x=1, y }\nf = {}\n";
    leading_commas: "a = [ 1 -- one\n    , 2 -- two\n    -- before three\n    , 3 ]\n";
    long_list: "a = [firstElementOfTheList, secondElementOfTheList, thirdElementOfTheList, fourthElementOfTheList, fifth]\n";
    pipelines: "a = sphere { radius = 1 } |> translate (1, 2, 3) |> rotate up (turn * t) |> scale 3 |> paint (classic { color = gold })
b = sphere { radius = 1 }
  |> translate (1, 2, 3)
c = f x |> g\n";
    lets: "a = let x = 1 in x\nb = let x = 1\n        y = 2\n  in x + y\nc =\n  let -- why\n    x = 1\n\n    --| doc\n    y = 2\n    -- before\n    in y\n";
    ifs: "a x = if x > 0 then 1 else 2\nb x = if x > 0 then 1\n  else if x < 0 then { a = 1,\n b = 2 } else\n  3\n";
    matches: "a l = match l { [] -> 0, [x,..rest] -> x }\nb l = match l {\n[] -> 0, [_,..] -> { value = 1 } }\n";
    comprehensions: "a = [x*y|x<-[1..3],y<-[0,0.5..1],x>y]
b = [ sphere { radius = r, center = p } | r <- [1 .. 10], p <- [(x, 0, y) | x <- [0 .. 9], y <- [0 .. 9]], let q = p * r, keep q ]
c = [ x
    | x <- list ]\n";
    functions: "a = map (\\x y->x) list\nb = fold (\\total element -> let doubled = element * 2 in total + doubled * someOtherFactor) 0 theLongList\n";
    applications: "a = aVeryLongFunctionName firstArgumentThatIsLong secondArgumentThatIsLong thirdArgumentThatIsLong four
b = sphere { radius = 0.4, center = (0, 0.4, 0), material = classic { color = gold, reflection = 0.6, shine = 80 } }\n";
    comments_anywhere: "-- top\n\n{- block -} a = {- in -} 1 -- end\n-- between\nb = f -- first\n  x {- y -} z\n-- last";
    imports: "import   \"a.hry\"\nimport \"b.hry\" ( x,y, )\nimport \"c.hry\"   as   c\na = c.x\n";
    annotations: "a:Number->Number\na x=x\nb : {a:Number,b:[Vec3]}->(a->b)->Color\nb r f = #fff\nc = (1:Number)\n";
    long_updates: "a = { floor | color = checker aFirstColourOfSome aSecondColour, reflection = 0.3, shine = 60, ior = 1.5 }
b = { floor |
  color = gold, -- like the ring
  shine = 3, }
c = { floor
  | -- why
    color = gold }
d = f { floor | x = 1,
y = 2 } { floor |
 x = 1 }\n";
    rests: "a l = match l { [ .. rest] -> rest, [x, .. ] -> x, [_,..others] -> 1 }\n";
    appended: "a = [sphere { radius = 1 }, sphere { radius = 2 }] ++ ring 12 2.4 (sphere { radius = 0.25 }) ++ moreOfThem
b = { objects = [floor, ball] ++ [sphere { radius = 0.3, center = (i, 0, 0), material = classic { color = gold } } | i <- [0 .. 9]] }\n";
    parenthesised_arguments: "a = difference (box { size = (1, 1, 1), material = classic { color = gold } }) (sphere { radius = 0.6, center = up })
b = translate (0, 1, 0) (box { size = (1, 1, 1), center = (0, 0.5, 0), material = classic { color = gold } })
c = union (box { size = (1, 1, 1) } |> translate up) (box { size = (2, 1, 1), material = classic { color = gold } } |> scale 2)\n";
    operators_over_lines: "a = [\n  x,\n] ++ ring 12 2.4 ball\nb = aLongNameForAValueThatIsAdded + anotherLongNameForAValue * aFactorOfTheOther - theLastOfThemAll x\n";
}
