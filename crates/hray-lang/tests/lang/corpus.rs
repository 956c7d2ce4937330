//! The corpus of the fuzz target, replayed in the ordinary tests.

use crate::common::{check_spans, diagnose};
use hray_lang::classic::{parse, write};
use hray_lang::diagnostic::render;
use hray_lang::lint::LintLevels;
use std::path::Path;

#[test]
fn the_fuzz_corpus_is_read_or_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/classic");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        let (diagnostics, text) = diagnose(&bytes, &LintLevels::default());
        check_spans(&diagnostics, &text);
        let shown = render(&diagnostics, "scene.hry", &text, true);
        assert_eq!(shown.is_empty(), diagnostics.is_empty(), "{}", path.display());
        if let Some(description) = parse(&text).description {
            assert_eq!(parse(&write(&description).unwrap()).description.as_ref(), Some(&description));
        }
        count += 1;
    }
    assert!(count >= 40, "only {count} files in the corpus");
}
