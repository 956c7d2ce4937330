//! The memory of the whole process, which other tests would use as well.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests may fail loudly")]

#[path = "studio/page.rs"]
#[allow(dead_code, reason = "others use the rest")]
mod page;

use page::{BALL, Studio};
use serde_json::json;

#[test]
fn memory_does_not_grow_with_edits() {
    let resident = || {
        let status = std::fs::read_to_string("/proc/self/status").unwrap();
        let line = status.lines().find(|line| line.starts_with("VmRSS")).unwrap();
        line.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap()
    };
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.view("a.hry");
    let mut edit = |version: u64| {
        page.edit("a.hry", version, &BALL.replace("1, 0)", &format!("1.{version:05}, 0)"))).unwrap();
        if version.is_multiple_of(10) {
            page.event(|event| event["event"] == "scene" && event["version"] == version);
            page.ask(json!({ "do": "complete", "doc": "a.hry", "version": version, "at": 12 })).unwrap();
        }
        page.binary.clear();
    };
    (1..=2000).for_each(&mut edit);
    let before = resident();
    (2001..=10_000).for_each(&mut edit);
    let after = resident();
    assert!(after < before + (8 << 10), "{before} KiB became {after} KiB");
}
