//! What holds for every text.

use hray_lang::diagnostic::render;
use hray_lang::hry::syntax::parse;
use proptest::prelude::*;

/// Pieces of the language and of its neighbours, out of which texts are put together.
const PIECES: &[&str] = &[
    "let ",
    " in ",
    "if ",
    " then ",
    " else ",
    "match ",
    " and ",
    " or ",
    " not ",
    "true",
    "false",
    "import ",
    " as ",
    "x",
    "y",
    "f ",
    "Foo",
    "h.p",
    ".x",
    " .",
    "1",
    "2.5",
    "50%",
    "30deg",
    "7%2",
    "1.2.3",
    "2x",
    "0x1F",
    "1.",
    ".5",
    "#fff",
    "#12",
    "\"text\"",
    "\"open",
    "'quoted'",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ", ",
    " = ",
    " == ",
    " : ",
    " -> ",
    " <- ",
    "\\",
    " | ",
    " |> ",
    " >> ",
    " ++ ",
    " + ",
    " - ",
    " -",
    "-",
    " * ",
    " / ",
    " % ",
    " ^ ",
    " < ",
    "..",
    "...",
    "_",
    ";",
    "!",
    "?",
    " && ",
    "\n",
    "\n  ",
    "\n    ",
    " ",
    "-- note\n",
    "--| doc\n",
    "{- ",
    " -}",
    "// c\n",
    "\u{a0}",
    "\u{2212}",
    "é",
    "\t",
    "\r\n",
    "where ",
    "case ",
    "def ",
    "return ",
    "elif ",
    "import \"a\" (b)\n",
];

fn pieces() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(PIECES), 0..60).prop_map(|pieces| pieces.concat())
}

fn holds(text: &str) -> Result<(), TestCaseError> {
    let shown = render(parse(text, 0).errors(), "scene.hry", text, false);
    let parse = parse(text, 1000);
    prop_assert_eq!(shown.is_empty(), parse.errors().is_empty());
    prop_assert_eq!(parse.root().text().to_string(), text);
    let module = parse.module();
    for error in parse.errors() {
        for span in error.spans() {
            prop_assert!(span.start >= 1000 && span.end <= 1000 + text.len(), "{:?} in {:?}", error, text);
            prop_assert!(text.get(span.start - 1000..span.end - 1000).is_some(), "{:?} in {:?}", error, text);
        }
    }
    let has_errors = format!("{module:?}").contains("Error");
    prop_assert!(!has_errors || !parse.errors().is_empty(), "an error node without an error: {:?}", text);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text_is_kept_and_its_errors_lie_in_it(text in any::<String>()) {
        holds(&text)?;
    }

    #[test]
    fn pieces_of_the_language_are_kept(text in pieces()) {
        holds(&text)?;
    }

    #[test]
    fn bytes_are_kept(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        holds(&String::from_utf8_lossy(&bytes))?;
    }
}

/// Texts that nest without end. The bound of the depth keeps the stack whole.
#[test]
fn deep_nesting_is_an_error_not_a_crash() {
    let many = 100_000;
    let around = |open: &str, middle: &str, close: &str| {
        format!("x = {}{middle}{}", open.repeat(many), close.repeat(many))
    };
    let texts = [
        around("(", "1", ")"),
        around("[", "", "]"),
        around("{ a = ", "1", " }"),
        around("{ r | a = ", "1", " }"),
        around("(", "", ""),
        around("f (", "", ""),
        around("- ", "1", ""),
        around("not ", "true", ""),
        around("1 + ", "1", ""),
        around("1 ^ ", "1", ""),
        around("a ++ ", "b", ""),
        around("f ", "x", ""),
        around("x |> ", "f", ""),
        around("if a then b else ", "c", ""),
        around("if ", "c", " then 1 else 2"),
        around("\\x -> ", "x", ""),
        around("let a = 1 in ", "a", ""),
        around("let a = ", "1", " in a"),
        around("match x { y -> ", "y", " }"),
        around("[x | y <- ", "z", "]"),
        around("a.", "b", ""),
        around("{-", "", "-}"),
        around("{-", "", ""),
        around("f -", "1", ""),
        around("f -(", "1", ")"),
        around("", "1", ")"),
        around("(", "1", "]"),
        around("([", "1", ")"),
        format!("x : {}a", "a -> ".repeat(many)),
        format!("x : {}a{}", "(".repeat(many), ")".repeat(many)),
        format!("x : {}a{}", "[".repeat(many), "]".repeat(many)),
        format!("x {} = 1", "(".repeat(many)),
        format!("x = match y {{ {}a{} -> 1 }}", "[".repeat(many), "]".repeat(many)),
        format!("x = [a | {}", "{ b = ".repeat(many)),
        format!("x =\n{}", (0..2000).map(|i| format!("{}let a{i} =\n", " ".repeat(i))).collect::<String>()),
    ];
    for text in texts {
        let parse = parse(&text, 0);
        assert!(!parse.errors().is_empty(), "{}", text.get(..40).unwrap_or(&text));
        drop(parse.module());
        assert_eq!(parse.root().text(), text.as_str());
    }
}

/// As much as is allowed: the stack holds that too.
#[test]
fn what_is_deep_but_allowed_is_read() {
    let texts = [
        format!("x = {}1{}", "(".repeat(190), ")".repeat(190)),
        format!("x = {}1", "1 + ".repeat(490)),
        format!("x = {}c", "if a then b else ".repeat(490)),
        format!("x = f{}", " a".repeat(490)),
        format!("x = [{}]", "1, ".repeat(100_000)),
    ];
    for text in texts {
        let parse = parse(&text, 0);
        assert!(parse.errors().is_empty(), "{:?}", parse.errors());
        drop(parse.module());
        drop(parse.root());
    }
}
