//! Pictures, and what is said about texts.

use crate::page::{BALL, Page, Studio};
use serde_json::{Value, json};

/// A classic scene.
const CLASSIC: &str = "renderDescr ( resolution (133,70) ) 3 [
  scene { camera (0.0,0.0,150.0) (100,75) } { background (0.2,0.3,0.5) }
  { objects (object ( sphere 25.0 (0.0,0.0,-50.0) ) ( texture ( diff perlin ( perlinWood (0.4,0.23,0.1) 5 120.0 0.12 40.0 ) ) 0.3 20 0.0 0.0 )) }
  { lights (pointLight (80.0,80.0,100.0) (0.9,0.9,0.9)) } ]";

/// Puts the tiles of a picture together as a page does; what it looks like after each pass, as red, green and blue.
fn picture(page: &mut Page, frame: u64, [width, height]: [usize; 2]) -> Vec<u8> {
    let mut rgb = vec![0; 3 * width * height];
    let number =
        |bytes: &[u8], at: usize| u32::from_le_bytes(bytes[4 * at..4 * at + 4].try_into().unwrap()) as usize;
    while let Some(message) = page.binary.pop_front() {
        if number(&message, 0) != 1 || number(&message, 1) as u64 != frame {
            continue;
        }
        let [x, y, w, h, step] = [2, 3, 4, 5, 6].map(|at| number(&message, at));
        assert_eq!(message.len(), 28 + 4 * w * h);
        for (sample, rgba) in message[28..].chunks_exact(4).enumerate() {
            assert_eq!(rgba[3], 255);
            for dy in 0..step {
                for dx in 0..step {
                    let (px, py) = (x + sample % w * step + dx, y + sample / w * step + dy);
                    if px < width && py < height {
                        rgb[3 * (py * width + px)..][..3].copy_from_slice(&rgba[..3]);
                    }
                }
            }
        }
    }
    rgb
}

fn shown_and_file(text: &str, size: [usize; 2]) {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.edit("a.hry", 1, text).unwrap();
    page.view("a.hry");
    let frame = page.event_named("frame");
    assert_eq!((&frame["width"], &frame["height"]), (&json!(size[0]), &json!(size[1])));
    let done = page.event(|event| event["event"] == "done" && event["frame"] == frame["frame"]);
    let shown = picture(&mut page, frame["frame"].as_u64().unwrap(), size);
    let answer = page
        .ask(json!({ "do": "render-file", "doc": "a.hry", "version": 1, "time": 0, "format": "ppm" }))
        .unwrap();
    assert_eq!(answer, json!({ "name": "a.ppm", "mime": "image/x-portable-pixmap" }));
    while page.binary.is_empty() {
        page.read().unwrap();
    }
    let message = page.binary.pop_front().unwrap();
    assert_eq!(message[..4], [2, 0, 0, 0]);
    let file = &message[8..];
    assert_eq!(&file[file.len() - shown.len()..], shown, "what is shown is what is rendered");
    assert_eq!(done["hash"], hray_session::hash(file));
    assert!(done["rays"].as_u64().unwrap() > 100 && done["seconds"].as_f64().unwrap() > 0.0);
}

#[test]
fn the_picture_of_a_classic_scene_is_the_file() {
    shown_and_file(CLASSIC, [133, 70]);
}

#[test]
fn the_picture_of_a_scene_with_samples_is_the_file() {
    shown_and_file(&BALL.replace("scene = {", "scene = {\n  samples = 5,"), [64, 48]);
}

#[test]
fn errors_are_told_with_what_mends_them() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.view("é.hry");
    let text = format!("-- caf\u{e9} \u{1d11e}\n{}", BALL.replace("sphere", "spere"));
    page.edit("é.hry", 7, &text).unwrap();
    let problems = page.event_named("problems");
    assert_eq!((&problems["doc"], &problems["version"]), (&json!("é.hry"), &json!(7)));
    let problem = &problems["items"][0];
    assert_eq!((&problem["severity"], &problem["file"]), (&json!("error"), &json!("é.hry")));
    let units: Vec<u16> = text.encode_utf16().collect();
    let part = |value: &Value| {
        let [from, to] = [&value["from"], &value["to"]].map(|at| at.as_u64().unwrap() as usize);
        String::from_utf16(&units[from..to]).unwrap()
    };
    assert_eq!(part(problem), "spere");
    assert!(problem["rendered"].as_str().unwrap().contains("é.hry:4:15"), "{problem}");
    let edit = &problem["fixes"][0]["edits"][0];
    assert_eq!((part(edit).as_str(), &edit["text"]), ("spere", &json!("sphere")));
    let scene = page.event_named("scene");
    assert_eq!((&scene["ok"], &scene["summary"]), (&json!(false), &json!(null)));
    // Mended, it is shown.
    page.edit("é.hry", 8, &text.replace("spere", "sphere")).unwrap();
    let scene = page.event_named("scene");
    assert_eq!(
        (&scene["ok"], &scene["version"], &scene["summary"]["objects"]["total"]),
        (&json!(true), &json!(8), &json!(1))
    );
    page.event_named("done");
}

#[test]
fn questions_about_a_text_are_answered() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    let text = "-- \u{1d11e}\ngold = #ffcc00\nball = sphere { radius = 1.25, material = classic { color = gold } }\nscene = { objects = [ ball, rotate up 30deg ball ] }\n";
    page.edit("a.hry", 3, text).unwrap();
    let at = |needle: &str| text[..text.find(needle).unwrap()].encode_utf16().count();
    let mut ask = |name: &str, more: Value| {
        let mut request = json!({ "do": name, "doc": "a.hry", "version": 3 });
        request.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        page.ask(request)
    };
    let hover = ask("hover", json!({ "at": at("sphere") })).unwrap();
    assert_eq!((&hover["from"], &hover["to"]), (&json!(at("sphere")), &json!(at("sphere") + 6)));
    assert!(hover["text"].as_str().unwrap().len() > 10, "{hover}");
    let found = ask("complete", json!({ "at": at("radius") })).unwrap();
    assert!(found["items"].as_array().unwrap().iter().any(|item| item["label"] == "center"), "{found}");
    let place = ask("definition", json!({ "at": at("gold }") })).unwrap();
    assert_eq!(
        place,
        json!({ "doc": "a.hry", "name": "a.hry", "text": null, "from": at("gold ="), "to": at("gold =") + 4 })
    );
    let library = ask("definition", json!({ "at": at("rotate up") })).unwrap();
    assert!(library["doc"].is_null() && library["text"].as_str().unwrap().len() > 100, "{library}");
    let colors = ask("colors", json!({})).unwrap();
    assert_eq!(colors, json!([{ "from": at("#ffcc"), "to": at("#ffcc") + 7, "color": [1.0, 0.8, 0.0] }]));
    let ways =
        ask("present", json!({ "from": at("#ffcc"), "to": at("#ffcc") + 7, "color": [0.0, 0.0, 1.0] }))
            .unwrap();
    assert_eq!(ways[0], "#0000ff");
    let numbers = ask("numbers", json!({})).unwrap();
    assert_eq!(numbers.as_array().unwrap().len(), 2);
    assert_eq!((&numbers[0]["value"], &numbers[0]["step"]), (&json!(1.25), &json!(0.01)));
    assert_eq!((&numbers[0]["min"], &numbers[1]["min"]), (&json!(0.01), &json!(null)));
    assert_eq!(
        (&numbers[1]["value"], &numbers[1]["unit"], &numbers[1]["step"]),
        (&json!(30.0), &json!("deg"), &json!(1.0))
    );
    assert_eq!(ask("references", json!({ "at": at("ball") })).unwrap().as_array().unwrap().len(), 3);
    let renamed = ask("rename", json!({ "at": at("ball"), "name": "orb" })).unwrap();
    assert_eq!(renamed["files"][0]["edits"].as_array().unwrap().len(), 3, "{renamed}");
    assert!(ask("rename", json!({ "at": at("ball"), "name": "gold" })).is_err());
    assert_eq!(ask("symbols", json!({})).unwrap().as_array().unwrap().len(), 3);
    assert!(ask("format", json!({})).unwrap()["text"].as_str().unwrap().contains("gold = #ffcc00"));
    // A question about a text that is no longer there has no answer.
    let late = ask("hover", json!({ "version": 2, "at": 3 })).unwrap_err();
    assert!(late["message"].as_str().unwrap().contains("version 3"), "{late}");
    let command = ask("command", json!({ "time": 1.5, "width": 80, "height": 60 })).unwrap();
    assert_eq!(command["command"], "hray render a.hry --size 80x60 --time 1.5");
    // What is in a folder of its own may read what lies beside that.
    let command = ask("command", json!({ "doc": "deeper/it's.hry" })).unwrap();
    assert_eq!(command["command"], r"hray render 'deeper/it'\''s.hry' --root .");
}

#[test]
fn time_and_size_are_those_of_the_view() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    let text = "scene t = { size = (32 + 8 * t, 16) }\n";
    page.edit("a.hry", 1, text).unwrap();
    page.view("a.hry");
    assert_eq!(page.event_named("scene")["animated"], true);
    page.event_named("done");
    page.ask(json!({ "do": "view", "doc": "a.hry", "time": 2, "width": null, "height": null })).unwrap();
    assert_eq!(page.event_named("frame")["width"], 48);
    page.ask(json!({ "do": "view", "doc": "a.hry", "time": 2, "width": 8, "height": 4 })).unwrap();
    assert_eq!(page.event(|event| event["event"] == "frame" && event["width"] != 48)["width"], 8);
}

#[test]
fn a_pixel_leads_to_the_line_that_made_it() {
    let studio = Studio::with(&[]);
    let mut page = studio.page();
    page.edit("a.hry", 1, BALL).unwrap();
    let explain =
        |x: u32, y: u32| json!({ "do": "explain", "doc": "a.hry", "version": 1, "x": x, "y": y, "time": 0 });
    let found = page.ask(explain(32, 24)).unwrap();
    let place = &found["object"]["place"];
    assert_eq!((&found["object"]["kind"], &place["line"]), (&json!("sphere"), &json!(3)), "{found}");
    let [from, to] = [&place["from"], &place["to"]].map(|at| at.as_u64().unwrap() as usize);
    assert_eq!(&BALL[from..to], "sphere { center = (0, 1, 0) }");
    assert!(page.ask(explain(64, 0)).is_err());
    page.edit("a.hry", 2, "scene = ").unwrap();
    let refused =
        page.ask(json!({ "do": "explain", "doc": "a.hry", "version": 2, "x": 1, "y": 1 })).unwrap_err();
    assert!(refused["message"].as_str().unwrap().contains("has errors"), "{refused}");
}
