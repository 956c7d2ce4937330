//! Any text as a scene in hry, from bytes to the prepared scene and a few pixels of it: it is rendered or refused, never more.
//! What is refused has errors that render; what can be laid out stays as it is when it is laid out again.

#![no_main]

use hray::{Control, Formatted, Limits, LoadOptions, Options, Resolution, SceneFile};
use libfuzzer_sys::fuzz_target;

/// Small enough that a scene which uses them up does so within a moment.
const LIMITS: Limits = Limits { steps: 200_000, depth: 500, list: 5_000, memory: 64 << 20, nodes: 5_000 };

fuzz_target!(|bytes: &[u8]| {
    let options = LoadOptions { limits: LIMITS, ..LoadOptions::default() };
    let Ok(file) = SceneFile::parse_with("scene.hry", bytes.to_vec(), &options) else { return };
    let report = file.report(true);
    assert_eq!(report.is_empty(), file.diagnostics().is_empty());
    assert!(file.description().is_some() || file.errors() > 0);
    if let Formatted::Text(text) = hray::format_scene("scene.hry", bytes) {
        match hray::format_scene("scene.hry", text.as_bytes()) {
            Formatted::Text(again) => assert_eq!(again, text),
            other => panic!("{other:?}"),
        }
    }
    if let (Some(description), Ok(size)) = (file.description(), Resolution::new(4, 3)) {
        let options = Options { size: Some(size), max_depth: Some(2), samples: std::num::NonZeroU32::new(1), ..Options::default() };
        let _ = hray::render_to_memory(description, &options, &Control::new());
    }
});
