//! Any bytes as a classic scene file: they are read or refused, never more. What is refused has errors that
//! render, with spans that fit; what is accepted is the same after it is printed and read again.

#![no_main]

use hray_lang::classic::{parse, write};
use hray_lang::decode::decode;
use hray_lang::diagnostic::{Diagnostic, render};
use hray_lang::lint::{self, LintLevels};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let decoded = decode(bytes);
    if let Some(error) = decoded.error {
        return show(&[error], &decoded.text);
    }
    let parsed = parse(&decoded.text);
    show(&parsed.diagnostics, &decoded.text);
    assert_eq!(parsed.description.is_some(), parsed.diagnostics.is_empty());
    if let Some(description) = &parsed.description {
        show(&lint::check(&decoded.text, description, &parsed.spans, &LintLevels::default()), &decoded.text);
        let text = write(description).expect("the grammar can say what it said");
        assert_eq!(parse(&text).description.as_ref(), Some(description));
    }
});

fn show(diagnostics: &[Diagnostic], source: &str) {
    for span in diagnostics.iter().flat_map(Diagnostic::spans) {
        assert!(source.get(span.start..span.end).is_some(), "{span:?} does not fit: {diagnostics:?}");
    }
    let text = render(diagnostics, "scene.hry", source, true);
    assert_eq!(text.is_empty(), diagnostics.is_empty());
}
