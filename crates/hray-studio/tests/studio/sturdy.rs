//! What else may come.

use crate::page::{BALL, PATIENCE, Page, Studio, free_port};
use hray_studio::{Options, Server};
use serde_json::json;
use std::time::{Duration, Instant};

/// A scene that is worked out for minutes, if nobody stops it.
const ENDLESS: &str = "count n = if n == 0 then 0 else count (n - 1)\nmuch n = if n == 0 then 0 else count 5000 + much (n - 1)\n\
    scene = { size = (8 + sum [ much 5000 | i <- [1 .. 100000] ], 8) }\n";

#[test]
fn a_scene_that_never_ends_is_stopped_by_the_next_edit() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.view("a.hry");
    page.edit("a.hry", 1, ENDLESS).unwrap();
    std::thread::sleep(Duration::from_millis(500));
    // Other questions are answered meanwhile.
    let start = Instant::now();
    page.ask(json!({ "do": "symbols", "doc": "a.hry", "version": 1 })).unwrap();
    page.edit("a.hry", 2, BALL).unwrap();
    page.event(|event| event["event"] == "done");
    // It would take minutes.
    assert!(start.elapsed() < PATIENCE, "{:?}", start.elapsed());
}

#[test]
fn a_picture_that_is_too_large_is_refused() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.view("a.hry");
    page.edit("a.hry", 1, &BALL.replace("(64, 48)", "(30000, 30000)")).unwrap();
    let failed = page.event_named("failed");
    assert!(failed["message"].as_str().unwrap().contains("too large to be shown here"), "{failed}");
    let refused =
        page.ask(json!({ "do": "render-file", "doc": "a.hry", "version": 1, "time": 0, "format": "png" }));
    assert!(refused.unwrap_err()["message"].as_str().unwrap().contains("too large"));
    // A scene that asks for too much is an error with a place.
    page.edit(
        "a.hry",
        2,
        "scene = { size = (sum [ x * y * z | x <- [1 .. 9000], y <- [1 .. 9000], z <- [ 1 .. 9000] ], 8) }\n",
    )
    .unwrap();
    let problems = page.event(|event| event["event"] == "problems" && event["version"] == 2);
    let code = problems["items"][0]["code"].as_str().unwrap();
    assert!(["list-too-long", "too-much-memory"].contains(&code), "{problems}");
    page.edit("a.hry", 3, BALL).unwrap();
    page.event_named("done");
}

#[test]
fn a_hundred_edits_a_second_are_kept_up_with() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.view("a.hry");
    let start = Instant::now();
    for version in 1..=300 {
        page.send(json!({ "do": "edit", "doc": "a.hry", "version": version, "text": BALL.replace("1, 0)", &format!("1.{version:03}, 0)")) }));
        std::thread::sleep(
            Duration::from_millis(10)
                .saturating_sub(start.elapsed() - Duration::from_millis(10) * (version as u32 - 1)),
        );
    }
    let sent = start.elapsed();
    page.event(|event| event["event"] == "scene" && event["version"] == 300);
    page.event_named("done");
    assert!(start.elapsed() - sent < PATIENCE, "{:?}", start.elapsed() - sent);
    assert!(page.ask(json!({ "do": "hover", "doc": "a.hry", "version": 300, "at": 0 })).is_ok());
}

#[test]
fn messages_that_are_none_and_those_that_are_too_long() {
    let studio = Studio::with(&[("a.hry", BALL)]);
    let mut page = studio.page();
    page.send_raw("{".to_owned()).unwrap();
    assert!(page.event_named("unreadable")["message"].is_string());
    assert!(
        page.ask(json!({ "do": "nothing" })).unwrap_err()["message"].as_str().unwrap().contains("nothing")
    );
    assert!(page.ask(json!({ "do": "edit", "doc": "a.hry" })).is_err());
    assert!(page.ask(json!({ "do": "hover", "doc": "a.hry", "version": 1, "at": -1 })).is_err());
    assert!(page.ask(json!({ "do": "hover", "doc": "none.hry", "version": 1, "at": 1 })).is_err());
    assert!(page.edit("../a.hry", 1, "").is_err());
    let long = page.edit("a.hry", 1, &"x".repeat(9 << 20)).unwrap_err();
    assert!(long["message"].as_str().unwrap().contains("8 MiB"), "{long}");
    assert!(page.ask(json!({ "do": "hello" })).is_ok());
    // Beyond what any text takes, the connection ends, and others go on.
    let mut other = studio.page();
    let ended = page.send_raw("x".repeat(64 << 20)).is_err() || (0..1000).any(|_| page.read().is_err());
    assert!(ended);
    assert!(other.ask(json!({ "do": "hello" })).is_ok());
}

#[test]
fn a_studio_that_was_started_again_has_the_port_and_another_token() {
    let folder = tempfile::tempdir().unwrap();
    let port = free_port();
    let start = || {
        let start = Instant::now();
        loop {
            match Server::start(&Options { target: Some(folder.path().to_owned()), port: Some(port) }) {
                Ok(server) => return server,
                Err(error) => assert!(start.elapsed() < PATIENCE, "{error}"),
            }
            std::thread::sleep(Duration::from_millis(20));
        }
    };
    let first = start();
    let (old, mut page) = (first.address().to_owned(), Page::open(&first));
    page.ask(json!({ "do": "hello" })).unwrap();
    drop(first);
    while page.read().is_ok() {}
    let second = start();
    assert_ne!(second.address(), old);
    assert!(Page::open(&second).ask(json!({ "do": "hello" })).is_ok());
    // A port that is taken is said to be.
    let taken =
        Server::start(&Options { target: Some(folder.path().to_owned()), port: Some(port) }).unwrap_err();
    assert!(taken.to_string().contains(&format!("the port {port} is not to be had")), "{taken}");
    let none = Server::start(&Options { target: Some(folder.path().join("none")), port: None }).unwrap_err();
    assert!(none.to_string().contains("no file and no folder"), "{none}");
}
