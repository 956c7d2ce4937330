//! Changes that others make.

use crate::page::{BALL, Studio};
use serde_json::json;
use std::fs;

#[test]
fn what_another_editor_writes_is_told() {
    let studio = Studio::with(&[("a.hry", BALL)]);
    let mut page = studio.page();
    page.ask(json!({ "do": "open", "path": "a.hry" })).unwrap();
    let text = BALL.replace("64", "32");
    fs::write(studio.path("a.hry"), &text).unwrap();
    let event = page.event_named("disk");
    assert_eq!((&event["path"], &event["text"]), (&json!("a.hry"), &json!(text)));
    assert_eq!(event["disk"], page.ask(json!({ "do": "open", "path": "a.hry" })).unwrap()["disk"]);
    fs::remove_file(studio.path("a.hry")).unwrap();
    let event = page.event_named("disk");
    assert_eq!((&event["disk"], &event["text"]), (&json!(null), &json!(null)));
    fs::write(studio.path("new.hry"), BALL).unwrap();
    page.event(|event| {
        event["event"] == "files" && event["files"] == json!([{ "path": "new.hry", "kind": "scene" }])
    });
}

#[test]
fn what_a_scene_imports_is_read_again() {
    let scene = "import \"part.hry\" (wide)\nscene = { size = (wide, 8) }\n";
    let studio = Studio::with(&[("a.hry", scene), ("part.hry", "wide = 16\n")]);
    let mut page = studio.page();
    page.edit("a.hry", 1, scene).unwrap();
    page.view("a.hry");
    assert_eq!(page.event_named("frame")["width"], 16);
    fs::write(studio.path("part.hry"), "wide = 24\n").unwrap();
    assert_eq!(page.event_named("frame")["width"], 24);
    // A text that is open counts for more than the disk.
    page.edit("part.hry", 1, "wide = 40\n").unwrap();
    assert_eq!(page.event(|event| event["event"] == "frame" && event["width"] != 24)["width"], 40);
}

#[test]
fn two_pages_on_one_file_do_not_lose_a_text() {
    let studio = Studio::with(&[("a.hry", BALL)]);
    let (mut one, mut two) = (studio.page(), studio.page());
    let disk = one.ask(json!({ "do": "open", "path": "a.hry" })).unwrap()["disk"].clone();
    assert_eq!(two.ask(json!({ "do": "open", "path": "a.hry" })).unwrap()["disk"], disk);
    // What is typed in one is not in the other.
    one.edit("a.hry", 1, "one = 1\n").unwrap();
    two.edit("a.hry", 1, "two = 2\n").unwrap();
    one.ask(json!({ "do": "save", "doc": "a.hry", "text": "one = 1\n", "disk": disk })).unwrap();
    assert_eq!(two.event_named("disk")["text"], "one = 1\n");
    let refused =
        two.ask(json!({ "do": "save", "doc": "a.hry", "text": "two = 2\n", "disk": disk })).unwrap_err();
    assert_eq!(refused["conflict"]["text"], "one = 1\n");
    assert_eq!(fs::read_to_string(studio.path("a.hry")).unwrap(), "one = 1\n");
}
