//! Anything at all is read or refused: the corpus of the fuzz target, and good scenes cut short and damaged.

use crate::common::{Files, run_with, shown};
use hray_lang::hry::eval::Limits;
use std::path::Path;

const LIMITS: Limits = Limits { steps: 100_000, depth: 300, list: 5_000, memory: 64 << 20, nodes: 5_000 };

fn texts() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus/hry");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path| String::from_utf8_lossy(&std::fs::read(path).unwrap()).into_owned();
    paths.into_iter().map(read).collect()
}

fn survives(text: &str) {
    let (program, evaluated) = run_with(text, &Files::default(), 0.0, &LIMITS);
    let report = shown(&program, &evaluated.diagnostics);
    assert_eq!(report.is_empty(), evaluated.diagnostics.is_empty());
    let errors = evaluated.diagnostics.iter().any(hray_lang::diagnostic::Diagnostic::is_error);
    assert!(evaluated.description.is_some() != errors, "{report}\n{text}");
    assert!(!report.contains("error[internal]"), "{report}\n{text}");
}

#[test]
fn the_fuzz_corpus_is_read_or_refused() {
    let texts = texts();
    assert!(texts.len() >= 10);
    texts.iter().for_each(|text| survives(text));
}

#[test]
fn scenes_that_end_early_are_refused_in_order() {
    for text in texts() {
        for end in (0..text.len()).step_by(5).filter(|end| text.is_char_boundary(*end)) {
            survives(&text[..end]);
        }
    }
}

#[test]
fn scenes_with_damage_are_refused_in_order() {
    for text in texts() {
        for at in (0..text.len())
            .step_by(7)
            .filter(|at| text.is_char_boundary(*at) && text.is_char_boundary(at + 1))
        {
            survives(&format!("{}{}", &text[..at], &text[at + 1..]));
            for insert in ["(", "}", "\n", " -", "=", "\"", "{ p", "|>"] {
                survives(&format!("{}{insert}{}", &text[..at], &text[at..]));
            }
        }
    }
}
