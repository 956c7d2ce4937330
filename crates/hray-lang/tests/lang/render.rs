//! The layout of odd sources.

use crate::common::{SCENE, broken, shown};
use hray_lang::classic::parse;
use hray_lang::diagnostic::{Diagnostic, Span, render, render_sources};
use hray_lang::hry::{STANDARD_BASE, Sources};
use insta::assert_snapshot;

#[test]
fn tabs_line_ends_and_other_scripts() {
    let source = broken("sphere 40.0", "sphere 40");
    assert_snapshot!("tabs", shown(source.replace("        (", "\t\t(").as_bytes()));
    assert_snapshot!("carriage_returns", shown(source.replace('\n', "\r\n").as_bytes()));
    assert_snapshot!("other_scripts", shown(broken("{ background", "{ 背景 é ß 🙂 background").as_bytes()));
    assert_snapshot!(
        "byte_order_mark",
        shown(format!("\u{feff}{}", broken("renderDescr", "renderdescr")).as_bytes())
    );
    assert_snapshot!("control_characters", shown(broken("sphere 40.0", "sphere \u{1b}[31m40.0").as_bytes()));
}

#[test]
fn one_long_line() {
    let source = broken("sphere 40.0", "sphere 40").replace('\n', " ");
    assert_snapshot!("long_line", shown(source.as_bytes()));
    // The bracket that is not closed is far from where that shows.
    let source = broken("-150.0) )", "-150.0)").replace('\n', &" ".repeat(60));
    assert_snapshot!("long_line_with_far_labels", shown(source.as_bytes()));
}

#[test]
fn far_apart_lines() {
    let source = broken("0.0 0 0.0 0.0 )) }", "0.0 0 0.0 0.0 ))")
        .replace("{ objects\n", &format!("{{ objects{}", "\n".repeat(9000)));
    assert_snapshot!("far_apart_lines", shown(source.as_bytes()));
}

#[test]
fn colours_are_optional() {
    let source = broken("sphere 40.0", "sphere 40");
    let diagnostics = parse(&source).diagnostics;
    assert!(render(&diagnostics, "scene.hry", &source, true).contains("\u{1b}["));
    assert!(!render(&diagnostics, "scene.hry", &source, false).contains('\u{1b}'));
    assert_eq!(render(&[], "scene.hry", SCENE, true), "");
}

#[test]
fn neither_a_file_name_nor_a_source_can_control_the_terminal() {
    let source = broken("sphere 40.0", "sphere 40");
    let text = render(&parse(&source).diagnostics, "a\u{1b}[2J\nb.hry", &source, false);
    assert!(!text.contains('\u{1b}') && text.contains("b.hry:5:26"), "{text}");
    let text = shown(broken("sphere 40.0", "sphere \u{202e}\u{1b}\u{2066} \u{85} 40.0").as_bytes());
    assert!(!text.contains(['\u{1b}', '\u{202e}', '\u{2066}', '\u{85}']), "{text}");
}

/// Three files; the middle one is `one\ntwo\nthree`.
fn sources() -> (Sources, usize) {
    let mut sources = Sources::default();
    sources.add("scene.hry".to_owned(), "import \"palette.hry\"\nscene = blue 3\n".into());
    let palette = sources.add("parts/palette.hry".to_owned(), "one\ntwo\nthree\n".into());
    sources.add("--set x".to_owned(), "x = 1".into());
    let base = sources.files()[palette].base;
    (sources, base)
}

#[test]
fn labels_are_shown_in_their_own_files() {
    let (sources, palette) = sources();
    let two = Span::new(palette + 4, palette + 7);
    let diagnostic =
        Diagnostic::error("several-files", "two files do not agree", Span::new(29, 33), "used here")
            .with_secondary(two, "defined here")
            .with_secondary(Span::new(0, 6), "imported here")
            .with_suggestion(two, "2", "write a number");
    assert_snapshot!("several_files", render_sources(&[diagnostic], &sources, false));
    let library = Span::new(STANDARD_BASE, STANDARD_BASE + 3);
    let diagnostic = Diagnostic::warning("library", "something of the library", two, "here")
        .with_secondary(library, "and there");
    let text = render_sources(&[diagnostic], &sources, false);
    assert!(text.contains(".hry of the library:1:1"), "{text}");
}

#[test]
fn what_is_missing_from_a_file_has_no_place_in_it() {
    let (sources, palette) = sources();
    let diagnostic =
        |at| Diagnostic::error("no-scene", "there is no `scene`", Span::at(at), "").with_help("define it");
    assert_snapshot!("no_place", render_sources(&[diagnostic(0), diagnostic(palette)], &sources, false));
    assert_eq!(render_sources(&[diagnostic(0)], &Sources::default(), false).lines().count(), 3);
}
