//! Size alone does no harm: neither time nor output grows beyond what the input asks for.

use crate::common::{SCENE, broken, diagnose};
use hray_lang::diagnostic::render;
use hray_lang::lint::LintLevels;
use std::time::{Duration, Instant};

/// Reads a large file and renders what there is to say. The bound is generous: it is to catch time that
/// grows with the square of the size, which would be minutes.
fn read_large(what: &str, source: &str) {
    let start = Instant::now();
    let (diagnostics, text) = diagnose(source.as_bytes(), &LintLevels::default());
    let shown = render(&diagnostics, "scene.hry", &text, false);
    assert!(start.elapsed() < Duration::from_secs(20), "{what} took {:?}", start.elapsed());
    assert!(shown.len() < 100_000, "{what}: {} bytes of diagnostics", shown.len());
}

#[test]
fn large_garbage_is_refused_in_linear_time() {
    const SIZE: usize = 2_000_000;
    let (start, end) = SCENE.split_at(SCENE.find("(object ( plane").unwrap());
    for piece in [
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        ",",
        "{-",
        "/*",
        "{- -}",
        "// \n",
        "#",
        "+-",
        "- ",
        "-",
        "--",
        ".",
        "1",
        "1e",
        "@",
        "@ ",
        "a",
        "a ",
        "( (",
        "(object",
        "object ",
        "(object (",
        "objects ",
        "{ lights",
        "( {- ",
        "\u{feff}",
        "é",
        "1.0 ",
        "\t",
        "\n",
        "\r",
        "(0.0,",
        "(object ( sphere 1.0 (",
        "} {",
        "] ",
    ] {
        let garbage = piece.repeat(SIZE / piece.len());
        read_large(piece, &garbage);
        read_large(piece, &format!("{start}{garbage}{end}"));
        read_large(piece, &format!("renderDescr ( {garbage}"));
    }
}

#[test]
fn an_error_in_a_long_line_is_shown_in_a_few_words() {
    let objects =
        "(object ( sphere 1.0 (0.0,0.0,-150.0) ) ( texture ( diff solid (0.8,0.2,0.2) ) 0.3 60 0.0 0.0 )) ";
    let source =
        broken("(object ( plane", &format!("{}(object ( plain", objects.repeat(20_000))).replace('\n', " ");
    let (diagnostics, text) = diagnose(source.as_bytes(), &LintLevels::default());
    assert_eq!(diagnostics.len(), 1);
    assert!(render(&diagnostics, "scene.hry", &text, false).len() < 1500);
}

#[test]
fn long_literals_are_read_and_shown_in_part() {
    let source =
        broken("sphere 40.0", &format!("sphere {}.{}", "0".repeat(1_000_000), "3".repeat(1_000_000)));
    assert_eq!(diagnose(source.as_bytes(), &LintLevels::default()).0, []);
    for long in ["9".repeat(1_000_000), "x".repeat(1_000_000), "1.".repeat(500_000), "@".repeat(1_000_000)] {
        let source = broken("sphere 40.0", &format!("sphere {long}"));
        let (diagnostics, text) = diagnose(source.as_bytes(), &LintLevels::default());
        assert!(render(&diagnostics, "scene.hry", &text, false).len() < 5000);
    }
}
