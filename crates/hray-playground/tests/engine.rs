//! The engine as a page uses it, run on this machine.

#![allow(clippy::unwrap_used, reason = "tests may fail loudly")]

use hray_playground::Engine;
use serde_json::{Value, json};

fn ask(engine: &mut Engine, mut request: Value) -> Result<Value, Value> {
    request["id"] = 7.into();
    let answer: Value = serde_json::from_str(&engine.request(&request.to_string())).unwrap();
    assert_eq!(answer["id"], 7);
    answer.get("error").map_or_else(|| Ok(answer["ok"].clone()), |error| Err(error.clone()))
}

fn edit(engine: &mut Engine, text: &str) {
    ask(engine, json!({ "do": "edit", "doc": "a.hry", "version": 1, "text": text })).unwrap();
}

fn show(engine: &mut Engine, number: u32, view: &Value) -> Value {
    serde_json::from_str(&engine.show(number, &view.to_string())).unwrap()
}

#[test]
fn engines_that_share_the_tiles_make_the_picture_of_one() {
    let mut engines = [Engine::new(2, 2000), Engine::new(2, 2000)];
    let example = ask(&mut engines[0], json!({ "do": "example", "name": "still-life" })).unwrap();
    let view = json!({ "doc": "a.hry", "time": 0.0, "width": 90, "height": 70 });
    let mut told = Vec::new();
    for engine in &mut engines {
        edit(engine, example["text"].as_str().unwrap());
        told.push(show(engine, 3, &view));
    }
    assert_eq!(told[0], told[1]);
    let events: Vec<&str> =
        told[0]["events"].as_array().unwrap().iter().map(|e| e["event"].as_str().unwrap()).collect();
    assert_eq!(events, ["problems", "scene", "frame"]);
    let mut tiles = Vec::new();
    for (pass, count) in told[0]["tiles"].as_array().unwrap().iter().enumerate() {
        for index in 0..count.as_u64().unwrap() as usize {
            let [one, two] = engines.each_mut().map(|engine| engine.tile(pass, index));
            assert_eq!(one, two);
            assert_eq!(one[..8], [1, 0, 0, 0, 3, 0, 0, 0]);
            tiles.push(one);
        }
    }
    assert_eq!(tiles.len(), 1 + 1 + 4);
    assert!(engines[0].tile(0, 99).is_empty() && engines[0].tile(9, 0).is_empty());
    assert!(engines[0].rays() > 1000.0);
}

#[test]
fn what_is_imported_is_what_the_page_brought() {
    let mut engine = Engine::new(1, 2000);
    edit(&mut engine, "import \"x/part.hry\" (wide)\nscene = { size = (wide, 8) }\n");
    let view = json!({ "doc": "a.hry" });
    assert_eq!(show(&mut engine, 1, &view)["events"][1]["ok"], false);
    engine.put("x/part.hry", Some(b"wide = 16\n".to_vec())).unwrap();
    assert_eq!(show(&mut engine, 2, &view)["events"][2]["width"], 16);
    assert!(engine.put("../x", Some(Vec::new())).is_err());
    assert!(ask(&mut engine, json!({ "do": "save", "doc": "a.hry", "text": "", "disk": null })).is_err());
}

#[test]
fn a_file_is_what_is_rendered() {
    let mut engine = Engine::new(1, 2000);
    edit(&mut engine, "scene = { size = (5, 4), background = #ff0000 }\n");
    let request = json!({ "id": 9, "do": "render-file", "doc": "a.hry", "version": 1, "format": "ppm" });
    assert_eq!(engine.request(&request.to_string()), "");
    let file = engine.file(&request.to_string());
    assert_eq!(file.answer(), r#"{"id":9,"ok":{"mime":"image/x-portable-pixmap","name":"a.ppm"}}"#);
    assert_eq!(file.bytes()[..19], *b"\x02\0\0\0\x09\0\0\0P6\n5 4\n255\n");
    let refused = engine.file(&request.to_string().replace("ppm", "nope"));
    assert!(refused.answer().contains("no picture format") && refused.bytes().is_empty());
}

#[test]
fn a_scene_that_never_ends_ends() {
    let mut engine = Engine::new(1, 2000);
    edit(&mut engine, "scene = { size = (8 + sum [ 0 * x | x <- [1 .. 9000], y <- [1 .. 9000] ], 8) }\n");
    let told = show(&mut engine, 1, &json!({ "doc": "a.hry" }));
    let code = told["events"][0]["items"][0]["code"].as_str().unwrap();
    assert!(["list-too-long", "too-many-steps", "too-much-memory"].contains(&code), "{told}");
    edit(&mut engine, "deep n = 1 + deep (n + 1)\nscene = { size = (deep 0, 8) }\n");
    let told = show(&mut engine, 2, &json!({ "doc": "a.hry" }));
    assert_eq!(told["events"][0]["items"][0]["severity"], "error", "{told}");
    assert_eq!(told["tiles"], json!([]));
}
