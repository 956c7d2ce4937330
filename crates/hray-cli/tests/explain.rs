//! `hray explain`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::Folder;
use serde_json::Value;

/// A mirror at distance 3 from the camera, which shows a red wall 5 behind the camera; a lamp at the camera; a small ball
/// between a second lamp and the mirror. One sample a pixel, so numbers can be checked by hand.
const MIRROR: &str = "mirror = sphere { radius = 1, material = classic { color = rgb 0.5 0.5 0.5, reflection = 0.25, highlight = 0 } }
wall = plane { normal = (0, 0, 1), offset = 9, material = classic { color = rgb 1 0 0 } }
blocker at = sphere { radius = 0.1, center = at }
scene = {
  size = (3, 3), samples = 1, depth = 1, background = rgb 0.1 0.2 0.3,
  camera = perspective { from = (0, 0, 4), to = (0, 0, 0), fov = 20deg },
  objects = [mirror, wall, blocker (0, 0, 20)],
  lights = [point { position = (0, 0, 4), intensity = rgb 1 1 1 },
            point { position = (0, 0, 30), intensity = rgb 1 1 1 }, ambient { intensity = rgb 0.1 0.1 0.1 }] }
";

fn json(folder: &Folder, arguments: &str) -> Value {
    let outcome = folder.run(arguments);
    outcome.says(0, &[]);
    serde_json::from_str(outcome.stdout()).unwrap()
}

fn near(value: &Value, wanted: f64) -> bool {
    (value.as_f64().unwrap() - wanted).abs() < 1e-12
}

#[test]
fn distances_lights_and_shadows_by_hand() {
    let folder = Folder::new();
    folder.write("mirror.hry", MIRROR);
    let value = json(&folder, "explain mirror.hry 1 1 --json");
    assert_eq!((&value["pixel"], &value["size"]), (&serde_json::json!([1, 1]), &serde_json::json!([3, 3])));
    let rays = value["rays"].as_array().unwrap();
    assert_eq!(rays.len(), 2, "{value:#}");

    // The camera is 4 from the middle of a ball of radius 1.
    let first = &rays[0];
    assert!(near(&first["distance"], 3.0), "{first:#}");
    let hit = &first["hit"];
    assert_eq!((&hit["object"]["kind"], &hit["object"]["name"]), (&"sphere".into(), &"mirror".into()));
    assert_eq!((&hit["object"]["place"]["line"], &hit["object"]["place"]["column"]), (&1.into(), &10.into()));
    assert_eq!(hit["inside"], false);

    // Straight above the surface: the colour times the lamp. The other one is behind the wall, which is nearer than the ball.
    let lights = hit["lights"].as_array().unwrap();
    assert_eq!(lights[0]["reach"], "lit");
    assert!(near(&lights[0]["distance"], 3.0) && near(&lights[0]["contribution"][0], 0.5));
    assert_eq!(
        (&lights[1]["reach"], &lights[1]["shadowed_by"]["name"]),
        (&"shadowed".into(), &"wall".into())
    );
    assert!(near(&lights[1]["shadow_distance"], 8.0) && near(&lights[1]["contribution"][0], 0.0));
    assert_eq!(lights[2]["reach"], "everywhere");
    assert!(near(&lights[2]["contribution"][0], 0.05));

    // A quarter of the wall, whose front faces away from the lamp there: 8 away, lit straight on.
    let second = &rays[1];
    assert_eq!((&second["kind"], &second["parent"]), (&"reflection".into(), &0.into()));
    assert!(near(&second["distance"], 8.0) && near(&second["weight"], 0.25));
    assert_eq!(second["hit"]["object"]["name"], "wall");
    assert!(near(&second["color"][0], 1.0), "{second:#}");
    assert!(near(&second["in_pixel"][0], 0.25));
    assert!(near(&value["color"][0], 0.5 + 0.05 + 0.25) && near(&value["color"][1], 0.55), "{value:#}");
}

#[test]
fn the_object_in_the_way_is_found_with_the_calls_that_made_it() {
    let folder = Folder::new();
    folder.write("mirror.hry", MIRROR.replace("blocker (0, 0, 20)", "blocker (0, 0, 3)"));
    let value = json(&folder, "explain mirror.hry 1 1 --json");
    // The ball is in the picture's middle now.
    assert_eq!(value["object"]["name"], "blocker");
    assert_eq!(value["object"]["calls"][0]["text"], "blocker (0, 0, 3)");
    assert_eq!(value["object"]["calls"][0]["line"], 7);
    let text = folder.run("explain mirror.hry 1 1");
    assert!(text.stdout().contains("called from  mirror.hry:7:"), "{}", text.stdout());
}

#[test]
fn the_text_is_calm_and_complete() {
    let folder = Folder::new();
    folder.write("mirror.hry", MIRROR);
    let outcome = folder.run("explain mirror.hry 1 1");
    outcome.says(0, &[]);
    assert_eq!(
        outcome.stdout(),
        r"pixel (1, 1) of 3x3: #e7c4c4 (0.8, 0.55, 0.55)

shows the sphere `mirror` at mirror.hry:1:10
  made by      sphere { radius = 1, material = classic { color = rgb 0.5 0.5 0.5, reflection = 0.25, highlight = 0...

ray from the camera: #e7c4c4 (0.8, 0.55, 0.55)
  meets the sphere `mirror` at mirror.hry:1:10, 3 away
  surface #bcbcbc (0.5, 0.5, 0.5), mirrors 0.25
  point light at mirror.hry:8:13: adds #bcbcbc (0.5, 0.5, 0.5)
  point light at mirror.hry:9:13: in the shadow of the plane `wall` at mirror.hry:2:8, 8 away
  ambient light at mirror.hry:9:69: adds #3f3f3f (0.05, 0.05, 0.05)
  mirrored ray: #ff0000 (1, 0, 0), times 0.25 adds #890000 (0.25, 0, 0)
    meets the plane `wall` at mirror.hry:2:8, 8 away, seen from behind
    surface #ff0000 (1, 0, 0)
    point light at mirror.hry:8:13: adds #ff0000 (1, 0, 0)
    point light at mirror.hry:9:13: the surface faces away from it
    ambient light at mirror.hry:9:69: adds #590000 (0.1, 0, 0)
    all of it together is (1.1, 0, 0), which is clipped to 0..1
"
    );
    let cut = folder.run("explain mirror.hry 1 1 --depth 0");
    assert!(cut.stdout().contains("mirrored ray: the depth of the picture ends here"), "{}", cut.stdout());
    let black = folder.run("explain mirror.hry 1 1 --depth -1");
    assert!(black.stdout().contains("The depth is -1, so no ray is followed"), "{}", black.stdout());
}

#[test]
fn the_background_and_several_samples() {
    let folder = Folder::new();
    folder.write(
        "edge.hry",
        "scene = { size = (9, 9), samples = 64, background = rgb 0 0 1,
  camera = perspective { from = (0, 0, 4), to = (0, 0, 0), fov = 90deg }, objects = [sphere {}] }",
    );
    let corner = folder.run("explain edge.hry 0 0");
    corner.says(0, &[]);
    assert!(corner.stdout().contains("#0000ff (0, 0, 1)"), "{}", corner.stdout());
    assert!(corner.stdout().contains("64 see the background"), "{}", corner.stdout());
    let value = json(&folder, "explain edge.hry 3 3 --json");
    let seen: Vec<u64> =
        value["seen"].as_array().unwrap().iter().map(|s| s["samples"].as_u64().unwrap()).collect();
    assert_eq!(seen.iter().sum::<u64>(), 64);
    assert_eq!(seen.len(), 2, "{value:#}");
}

#[test]
fn classic_scenes_lead_to_their_lines() {
    let folder = Folder::new();
    let value = json(&folder, "explain scene.hry 24 15 --json");
    assert_eq!(value["object"]["place"]["line"], 5);
    assert_eq!(value["object"]["place"]["column"], 11);
    assert_eq!(value["rays"][0]["hit"]["lights"][0]["place"]["line"], 7);
    // Offsets are in UTF-16 code units.
    folder.write(
        "wide.hry",
        "ball = sphere {} -- 😀é\nscene = { samples = 1, objects = [ball, cube {} |> translate (0, 0, -9)] }",
    );
    let value = json(&folder, "explain wide.hry 400 300 --json");
    assert_eq!((&value["object"]["place"]["from"], &value["object"]["place"]["to"]), (&7.into(), &16.into()));
}

#[test]
fn what_is_wrong_is_said() {
    let folder = Folder::new();
    folder
        .run("explain scene.hry 40 3")
        .says(2, &["there is no pixel (40, 3)", "40x30", "from 0 at the left to 39", "to 29"]);
    folder.run("explain scene.hry 3 30").says(2, &["there is no pixel (3, 30)"]);
    assert_eq!(folder.run("explain scene.hry 79 3 --size 80x60").code, Some(0));
    folder.run("explain scene.hry -1 3").says(2, &["a whole number, counted from 0"]);
    folder.run("explain scene.hry 1.5 3").says(2, &["a whole number, counted from 0"]);
    folder.run("explain scene.hry 1").says(2, &["<Y>"]);
    folder.run("explain none.hry 1 1").says(1, &["there is no such file"]);
    folder.write("wrong.hry", "scene = { objects = 3 }");
    folder.run("explain wrong.hry 1 1").says(1, &["error[", "wrong.hry:1:"]);
    assert!(folder.run("explain --help").stdout().contains("counted from 0 at the top"));
}

/// Twice as many rays with every level: told of the first ones, and all others are counted.
#[test]
fn there_may_be_very_many_rays() {
    let folder = Folder::new();
    folder.write("many.hry", common::ENDLESS.replace(") ) 60 [", ") ) 13 ["));
    let value = json(&folder, "explain many.hry 200 150 --json");
    assert_eq!(value["rays"].as_array().unwrap().len(), 4096);
    assert!(value["omitted"].as_u64().unwrap() > 0);
}
