//! Properties of reading and writing, whatever the text.

use crate::common::{SCENE, check_spans, description, diagnose, tokens};
use hray_core::Description;
use hray_lang::classic::{parse, write};
use hray_lang::decode::decode;
use hray_lang::diagnostic::{Diagnostic, Span, render};
use hray_lang::lint::LintLevels;
use proptest::prelude::*;

/// Equal to the bit: `==` would take 0.0 for -0.0.
fn same_bits(a: &Description, b: &Description) -> bool {
    // The debug format shows the sign of zero and otherwise enough digits.
    a == b && format!("{a:?}") == format!("{b:?}")
}

/// Reads a text as a user would have it read, renders what there is to say, and checks what always holds.
fn read(bytes: &[u8]) {
    let (diagnostics, text) = diagnose(bytes, &LintLevels::default());
    check_spans(&diagnostics, &text);
    assert!(diagnostics.iter().filter(|d| d.is_error()).count() <= 21);
    let shown = render(&diagnostics, "scene.hry", &text, false);
    assert_eq!(shown.is_empty(), diagnostics.is_empty());
}

/// A change of a list of tokens.
#[derive(Clone, Debug)]
enum Change {
    Delete(prop::sample::Index),
    Double(prop::sample::Index),
    Swap(prop::sample::Index, prop::sample::Index),
    Replace(prop::sample::Index, String),
    Cut(prop::sample::Index),
}

fn change() -> impl Strategy<Value = Change> {
    let index = any::<prop::sample::Index>;
    let text = prop_oneof![
        Just("(".into()),
        Just(")".into()),
        Just("{".into()),
        Just("}".into()),
        Just(",".into()),
        Just("1".into()),
        Just("2.5".into()),
        Just("// x".into()),
        Just("object".into()),
        Just("lights".into()),
        Just("perlinWood".into()),
        "\\PC{0,3}",
        "[a-zA-Z]{1,9}",
    ];
    prop_oneof![
        index().prop_map(Change::Delete),
        index().prop_map(Change::Double),
        (index(), index()).prop_map(|(a, b)| Change::Swap(a, b)),
        (index(), text).prop_map(|(i, text)| Change::Replace(i, text)),
        index().prop_map(Change::Cut),
    ]
}

fn changed(source: &str, changes: &[Change], separator: &str) -> String {
    let mut texts: Vec<String> = tokens(source).into_iter().map(|range| source[range].to_string()).collect();
    for change in changes {
        if texts.is_empty() {
            break;
        }
        let count = texts.len();
        match change {
            Change::Delete(i) => drop(texts.remove(i.index(count))),
            Change::Double(i) => texts.insert(i.index(count), texts[i.index(count)].clone()),
            Change::Swap(a, b) => texts.swap(a.index(count), b.index(count)),
            Change::Replace(i, text) => texts[i.index(count)].clone_from(text),
            Change::Cut(i) => texts.truncate(i.index(count)),
        }
    }
    texts.join(separator)
}

proptest! {
    #[test]
    fn what_is_written_reads_back_to_the_same_bits(description in description()) {
        let text = write(&description).unwrap();
        let parsed = parse(&text);
        prop_assert_eq!(&parsed.diagnostics, &vec![]);
        prop_assert!(same_bits(&parsed.description.unwrap(), &description), "{}", text);
        prop_assert_eq!(parsed.spans.primitives.len(), description.scene.primitives.len());
        for span in parsed.spans.primitives.iter().chain(&parsed.spans.light_list) {
            prop_assert!(span.text(&text).starts_with('(') && span.text(&text).ends_with(')'));
        }
    }

    #[test]
    fn the_order_and_spacing_of_tokens_is_all_that_counts(description in description()) {
        let text = write(&description).unwrap();
        let places = tokens(&text);
        let mut dense = String::new();
        for (place, next) in places.iter().zip(places.iter().skip(1).map(Some).chain([None])) {
            dense.push_str(&text[place.clone()]);
            // White space is needed only between words, and between numbers.
            let kind = |c: char| if c.is_ascii_digit() || c == '.' { 'n' } else if c.is_alphabetic() { 'w' } else { c };
            let last = text[place.clone()].chars().next_back().map(kind);
            let first = next.and_then(|next| text[next.clone()].chars().next()).map(kind);
            if last == first && matches!(first, Some('n' | 'w')) {
                dense.push('\u{2003}');
            }
        }
        let parsed = parse(&dense);
        prop_assert_eq!(&parsed.diagnostics, &vec![], "{}", dense);
        prop_assert!(same_bits(&parsed.description.unwrap(), &description));
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        read(&bytes);
    }

    #[test]
    fn any_text_is_read_or_refused(text in "\\PC{0,200}") {
        read(text.as_bytes());
    }

    #[test]
    fn any_mixture_of_tokens_is_read_or_refused(
        words in prop::collection::vec(prop::sample::select(PIECES), 0..80),
        start in any::<bool>(),
    ) {
        let header = if start { "renderDescr ( resolution (4,3) ) 1 [ scene " } else { "" };
        read((header.to_string() + &words.join(" ")).as_bytes());
        read((header.to_string() + &words.concat()).as_bytes());
    }

    #[test]
    fn a_changed_scene_is_read_or_refused(
        changes in prop::collection::vec(change(), 1..6),
        separator in prop::sample::select(vec![" ", "\n", "\r\n", "\t", ""]),
    ) {
        read(changed(SCENE, &changes, separator).as_bytes());
    }

    #[test]
    fn one_change_gives_few_errors(change in change()) {
        let text = changed(SCENE, std::slice::from_ref(&change), " ");
        let count = parse(&text).diagnostics.len();
        prop_assert!(count <= 6, "{count} errors for {change:?}");
    }

    #[test]
    fn any_diagnostic_can_be_rendered(
        source in prop_oneof!["\\PC{0,300}", "[a\\n\\r\\té\u{feff}]{0,100}"],
        spans in prop::collection::vec((0..400usize, 0..400usize), 1..6),
        replacement in "[a\\n ]{0,4}",
        text in "\\PC{0,20}",
    ) {
        // The spans need not fit anything.
        let mut spans = spans.into_iter().map(|(start, end)| Span::new(start, end));
        let first = spans.next().unwrap();
        let diagnostic = Diagnostic::error("code", text.as_str(), first, text.as_str())
            .with_suggestion(first, replacement, text.as_str())
            .with_note(text.as_str())
            .with_help(text.as_str());
        let diagnostic = spans.fold(diagnostic, |d, span| d.with_secondary(span, text.as_str()));
        for color in [false, true] {
            let shown = render(std::slice::from_ref(&diagnostic), &text, &source, color);
            prop_assert!(shown.contains("error"));
        }
    }

    #[test]
    fn decoding_finds_the_first_wrong_byte(text in "\\PC{0,40}", tail in prop::collection::vec(any::<u8>(), 0..20)) {
        let mut bytes = text.clone().into_bytes();
        bytes.push(0xFF);
        bytes.extend(tail);
        let decoded = decode(&bytes);
        let error = decoded.error.unwrap();
        let place = format!("at byte offset {}", text.len());
        prop_assert!(error.message.contains(&place), "{}", error.message);
        check_spans(&[error], &decoded.text);
    }
}

/// Pieces of scenes, right and wrong.
const PIECES: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    "1",
    "-2",
    "3.5",
    "-0.5",
    "1.",
    ".5",
    "1e5",
    "-",
    "+",
    "--",
    "@",
    "scene",
    "camera",
    "background",
    "objects",
    "lights",
    "object",
    "sphere",
    "plane",
    "texture",
    "diff",
    "solid",
    "perlin",
    "perlinSolid",
    "perlinMarbleBase",
    "pointLight",
    "ambientLight",
    "renderDescr",
    "resolution",
    "spere",
    "x",
    "(1.0,2.0,3.0)",
    "(object ( sphere 1.0 (1.0,2.0,3.0) )",
    "{ camera",
    "{ objects",
    "{ lights",
    "// c\n",
    "{-",
    "-}",
    "\u{feff}",
    "é",
    "−",
];

#[test]
fn any_missing_token_is_an_error() {
    for place in tokens(SCENE) {
        let text = format!("{} {}", &SCENE[..place.start], &SCENE[place.end..]);
        let parsed = parse(&text);
        assert!(parsed.description.is_none() && !parsed.diagnostics.is_empty(), "{}", &SCENE[place]);
    }
}

#[test]
fn one_missing_or_doubled_token_is_one_error() {
    for place in tokens(SCENE) {
        let (before, token, after) = (&SCENE[..place.start], &SCENE[place.clone()], &SCENE[place.end..]);
        for text in [format!("{before} {after}"), format!("{before}{token} {token}{after}")] {
            let errors = parse(&text).diagnostics;
            assert_eq!(
                errors.len(),
                1,
                "{token} at {}\n{}",
                place.start,
                render(&errors, "scene", &text, false)
            );
        }
    }
}

#[test]
fn every_suggestion_for_one_slip_mends_it() {
    let slips = [
        ("40.0", "40"),
        ("sphere", "spere"),
        ("(0.8,0.8,0.8)", "(0.8 0.8 0.8)"),
        (") 3 [", ") 3.0 ["),
        ("-150.0) )", "-150.0)"),
        ("object (", "object (("),
        ("-150.0", "- 150.0"),
        ("diff ", ""),
        ("{ lights", "{ Lights"),
    ];
    for (right, wrong) in slips {
        let text = SCENE.replacen(right, wrong, 1);
        let parsed = parse(&text);
        let [error] = &parsed.diagnostics[..] else { panic!("{wrong}: {:?}", parsed.diagnostics) };
        let change = error.suggestion.clone().unwrap();
        let mut mended = text.clone();
        mended.replace_range(change.span.start..change.span.end, &change.replacement);
        assert_eq!(parse(&mended).description, parse(SCENE).description, "{mended}");
    }
}
