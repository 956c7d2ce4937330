//! Which files are read and written.

use crate::page::{BALL, Studio};
use serde_json::json;
use std::fs;

#[test]
fn only_files_in_the_folder_are_read() {
    let studio = Studio::with(&[
        ("a.hry", BALL),
        ("sub/b.hry", "gold = 1\n"),
        ("old.hry", "renderDescr ( resolution (4,3) ) 1 []"),
    ]);
    fs::write(studio.folder.path().join("secret.hry"), "secret = 1\n").unwrap();
    let mut page = studio.page();
    let hello = page.ask(json!({ "do": "hello" })).unwrap();
    assert_eq!(
        hello["files"],
        json!([
            { "path": "a.hry", "kind": "scene" },
            { "path": "old.hry", "kind": "classic" },
            { "path": "sub/b.hry", "kind": "scene" },
        ])
    );
    let opened = page.ask(json!({ "do": "open", "path": "sub/b.hry" })).unwrap();
    assert_eq!(opened["text"], "gold = 1\n");
    assert_eq!(opened["disk"].as_str().unwrap().len(), 64);
    let outside = studio.folder.path().join("secret.hry");
    for path in [
        "../secret.hry",
        "sub/../../secret.hry",
        "/etc/hostname",
        outside.to_str().unwrap(),
        "",
        ".",
        "a\\b",
        "C:x",
    ] {
        let refused = page.ask(json!({ "do": "open", "path": path })).unwrap_err();
        assert!(
            refused["message"].as_str().unwrap().contains("not a path in the folder"),
            "{path}: {refused}"
        );
    }
    assert!(page.ask(json!({ "do": "open", "path": "none.hry" })).is_err());
    assert!(page.ask(json!({ "do": "open", "path": "sub" })).is_err());
    // Not by an import either.
    page.edit("a.hry", 1, "import \"../secret.hry\"\nscene = {}\n").unwrap();
    let problems = page.event_named("problems");
    assert!(problems["items"][0]["message"].as_str().unwrap().contains("root folder"), "{problems}");
}

#[cfg(unix)]
#[test]
fn links_lead_nowhere_outside() {
    use std::os::unix::fs::symlink;
    let studio = Studio::with(&[("a.hry", BALL)]);
    let secret = studio.folder.path().join("secret.hry");
    fs::write(&secret, "secret = 1\n").unwrap();
    fs::create_dir(studio.folder.path().join("elsewhere")).unwrap();
    symlink("../secret.hry", studio.path("link.hry")).unwrap();
    symlink("../new.hry", studio.path("dangling.hry")).unwrap();
    symlink("../elsewhere", studio.path("out")).unwrap();
    symlink("a.hry", studio.path("inside.hry")).unwrap();
    let mut page = studio.page();
    assert!(page.ask(json!({ "do": "open", "path": "inside.hry" })).is_ok());
    let save = |path: &str| json!({ "do": "save", "doc": path, "text": "x = 1\n", "disk": null });
    for path in ["link.hry", "dangling.hry", "out/new.hry"] {
        assert!(page.ask(json!({ "do": "open", "path": path })).is_err(), "{path}");
        assert!(page.ask(save(path)).is_err(), "{path}");
    }
    assert_eq!(fs::read_to_string(&secret).unwrap(), "secret = 1\n");
    assert!(!studio.folder.path().join("new.hry").exists());
    assert_eq!(fs::read_dir(studio.folder.path().join("elsewhere")).unwrap().count(), 0);
}

#[test]
fn nothing_is_written_but_the_scene_that_is_saved() {
    let studio = Studio::with(&[("a.hry", BALL)]);
    let before = studio.names();
    let mut page = studio.page();
    let opened = page.ask(json!({ "do": "open", "path": "a.hry" })).unwrap();
    let text = BALL.replace("center = (0, 1, 0)", "center = (0, 1.5, 0)");
    page.edit("a.hry", 1, &text).unwrap();
    page.view("a.hry");
    page.event_named("done");
    page.ask(json!({ "do": "render-file", "doc": "a.hry", "version": 1, "time": 0, "format": "png" }))
        .unwrap();
    assert_eq!(
        (studio.names(), fs::read_to_string(studio.path("a.hry")).unwrap()),
        (before.clone(), BALL.to_owned())
    );

    let saved =
        page.ask(json!({ "do": "save", "doc": "a.hry", "text": text, "disk": opened["disk"] })).unwrap();
    assert_eq!((studio.names(), fs::read_to_string(studio.path("a.hry")).unwrap()), (before, text.clone()));
    assert_eq!(page.ask(json!({ "do": "open", "path": "a.hry" })).unwrap()["disk"], saved["disk"]);

    page.ask(json!({ "do": "save", "doc": "new.hry", "text": text, "disk": null })).unwrap();
    assert_eq!(studio.names(), ["a.hry", "new.hry"]);
    for path in ["../new.hry", "/tmp/new.hry", "none/new.hry", "new.txt", ".bashrc", "new"] {
        assert!(page.ask(json!({ "do": "save", "doc": path, "text": "", "disk": null })).is_err(), "{path}");
    }
    assert_eq!(studio.names(), ["a.hry", "new.hry"]);
}

#[test]
fn a_file_that_changed_on_the_disk_is_not_replaced() {
    let studio = Studio::with(&[("a.hry", BALL)]);
    let mut page = studio.page();
    let opened = page.ask(json!({ "do": "open", "path": "a.hry" })).unwrap();
    let other = BALL.replace("64", "65");
    fs::write(studio.path("a.hry"), &other).unwrap();
    let save = |disk: &serde_json::Value| json!({ "do": "save", "doc": "a.hry", "text": "mine = 1\n", "disk": disk });
    let refused = page.ask(save(&opened["disk"])).unwrap_err();
    assert_eq!(refused["conflict"]["text"], other);
    assert!(page.ask(save(&json!(null))).unwrap_err()["conflict"]["disk"].is_string());
    assert_eq!(fs::read_to_string(studio.path("a.hry")).unwrap(), other);
    // Who has seen what is there may replace it.
    page.ask(save(&refused["conflict"]["disk"])).unwrap();
    assert_eq!(fs::read_to_string(studio.path("a.hry")).unwrap(), "mine = 1\n");
    // One that is gone is not made again without a word.
    fs::remove_file(studio.path("a.hry")).unwrap();
    let refused = page.ask(save(&opened["disk"])).unwrap_err();
    assert_eq!(refused["conflict"], json!({ "disk": null, "text": null }));
}

#[cfg(unix)]
#[test]
fn a_protected_file_stays_as_it_is() {
    use std::os::unix::fs::PermissionsExt;
    let studio = Studio::with(&[("a.hry", BALL)]);
    fs::set_permissions(studio.path("a.hry"), fs::Permissions::from_mode(0o640)).unwrap();
    let mut page = studio.page();
    let opened = page.ask(json!({ "do": "open", "path": "a.hry" })).unwrap();
    page.ask(json!({ "do": "save", "doc": "a.hry", "text": "x = 1\n", "disk": opened["disk"] })).unwrap();
    let mode = fs::metadata(studio.path("a.hry")).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640, "who may read it is as before");
}
