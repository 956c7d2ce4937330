//! Scenes in hry: settings, imports, budgets, and what is said about them.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, SCENE, decoded};

/// A row of balls, as many as `count` says.
const ROW: &str = "-- Balls in a row.
count = 3

ball : Number -> Shape
ball i = sphere { radius = 0.4, center = (i - 1, 0.5, 0), material = classic { color = gold } }

scene = {
  size = (40, 30),
  samples = 1,
  background = sky,
  lights = [ point { position = (3, 4, 5) } ],
  objects = [ ball i | i <- [0 .. count - 1] ],
}
";

fn folder() -> Folder {
    let folder = Folder::new();
    folder.write("row.hry", ROW);
    folder
}

#[test]
fn a_scene_is_rendered_and_settings_change_it() {
    let folder = folder();
    folder.run("render row.hry").says(0, &["row.png: 40x30 png, 3 objects, 1 light"]);
    folder.run("render row.hry -o set.png --set count=1").says(0, &["1 object"]);
    folder.run("render row.hry -o sum.png --set count=1+1").says(0, &["2 objects"]);
    let [three, one] = ["row.png", "set.png"].map(|name| decoded(&folder.path(name)));
    assert_eq!((three.0, three.1), (40, 30));
    assert_ne!(three, one);
    folder.run("row.hry row.ppm").says(0, &[]);
    assert!(folder.read("row.ppm").starts_with(b"P3\n40 30\n"));
}

#[test]
fn the_scene_says_how_many_samples_and_the_command_has_the_last_word() {
    let folder = folder();
    folder.write("default.hry", ROW.replace("  samples = 1,\n", ""));
    folder.run("render default.hry").says(0, &["19,200 camera"]);
    folder.run("render row.hry").says(0, &["1,200 camera"]);
    folder.run("render row.hry --samples 4").says(0, &["4,800 camera"]);
}

#[test]
fn settings_that_do_not_fit_are_refused() {
    let folder = folder();
    folder
        .run("render row.hry --set coutn=1")
        .says(1, &["there is no definition `coutn`", "did you mean `count`?"]);
    folder.run("render row.hry --set count=").says(2, &["a setting is the name of a definition"]);
    folder.run("render row.hry --set count 3").says(2, &["a setting is one word: `--set count=3`"]);
    folder.run("render row.hry --set count=(").says(1, &["--set count:1:"]);
    folder.run("render row.hry --set count=red").says(1, &["error"]);
    folder
        .run("render scene.hry --set count=3")
        .says(1, &["a classic scene has no definitions", "hray convert"]);
    folder.run("row.hry a.ppm --set count=3").says(2, &["use `hray render row.hry -o a.ppm --set ...`"]);
    assert_eq!(folder.names(), ["row.hry", "scene.hry"]);
}

#[test]
fn files_are_imported_from_the_folder_and_errors_are_shown_in_them() {
    let folder = folder();
    std::fs::create_dir_all(folder.path("parts/deep")).unwrap();
    folder.write("parts/palette.hry", "warm = gold\n");
    folder.write("parts/deep/use.hry", "import \"../palette.hry\"\nscene = { background = warm, objects = [ sphere {} ], lights = [ ambient {} ] }\n");
    folder.run("render parts/deep/use.hry").says(1, &["leads out of the root folder", "--root FOLDER"]);
    folder.run("check parts/deep/use.hry --root parts").says(0, &["no errors, no warnings"]);
    folder.run("check parts/deep/use.hry --root .").says(0, &["no errors"]);
    folder
        .run("check row.hry --root parts")
        .says(1, &["the scene `row.hry` does not lie in the root folder `parts`"]);
    folder.run("check row.hry --root none").says(1, &["`none`"]);
    folder.run("check row.hry --root scene.hry").says(1, &["`scene.hry`"]);

    folder.write("lamp.hry", "import \"parts/palette.hry\"\nscene = { background = wram }\n");
    folder.run("check lamp.hry").says(1, &["lamp.hry:2:", "`warm`"]);
    folder.write("lamp.hry", "import \"parts/pallete.hry\"\nscene = { background = black }\n");
    folder.run("check lamp.hry").says(1, &["lamp.hry:1:8", "did you mean \"parts/palette.hry\"?"]);
    folder.write("parts/palette.hry", "warm = gold +\n");
    folder.write("lamp.hry", "import \"parts/palette.hry\"\nscene = { background = warm, objects = [ sphere {} ], lights = [ ambient {} ] }\n");
    folder.run("check lamp.hry").says(1, &["parts/palette.hry:"]);
    folder.write("parts/palette.hry", "import \"../lamp.hry\"\nwarm = gold\n");
    folder.run("check lamp.hry").says(1, &["in a circle"]);
    folder.write("parts/palette.hry", b"warm = \xff");
    folder.run("check lamp.hry").says(1, &["it is not UTF-8 text"]);

    folder
        .run_with_input("check -", b"import \"row.hry\"\nscene = {}\n")
        .says(1, &["in no file", "--root FOLDER"]);
    folder
        .run_with_input(
            "check - --root . --allow warnings",
            b"import \"row.hry\" (ball)\nscene = { objects = [ball 1] }\n",
        )
        .says(0, &["no errors"]);
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out_of_the_folder() {
    let outer = folder();
    std::fs::create_dir(outer.path("in")).unwrap();
    outer.write("secret.hry", "secret = 3\n");
    std::os::unix::fs::symlink("../secret.hry", outer.path("in/link.hry")).unwrap();
    outer.write("in/scene.hry", "import \"link.hry\"\nscene = { depth = secret }\n");
    outer.run("check in/scene.hry").says(1, &["lies outside the root folder", "--root FOLDER"]);
    outer.run("check in/scene.hry --root .").says(0, &["no errors"]);
}

#[test]
fn images_are_read_from_the_folder() {
    let folder = folder();
    folder.run("render row.hry -o map.png").says(0, &[]);
    let scene = "scene = { size = (20, 10), samples = 1, lights = [ambient { intensity = 1 }],
  objects = [sphere { material = classic { color = imageMap (image \"map.png\") } }] }\n";
    folder.write("map.hry", scene);
    folder.run("render map.hry -o a.png").says(0, &["a.png: 20x10 png"]);
    folder.write("map.hry", scene.replace("map.png", "mpa.png"));
    folder.run("render map.hry -o a.png").says(1, &["did you mean \"map.png\"?"]);
    folder.write("map.hry", scene.replace("map.png", "row.hry"));
    folder.run("render map.hry -o a.png").says(1, &["\"row.hry\" cannot be read: it is no image"]);
}

#[test]
fn a_file_that_is_imported_is_not_replaced() {
    let folder = folder();
    folder.write("palette.ppm", "warm = gold\n");
    folder.write("a.hry", "import \"palette.ppm\"\nscene = { size = (4, 3), background = warm, objects = [ sphere {} ], lights = [ ambient {} ] }\n");
    folder.run("render a.hry -o palette.ppm").says(2, &["would replace a file that the scene imports"]);
    folder.run("a.hry palette.ppm").says(2, &["would replace a file that the scene imports"]);
    assert_eq!(folder.read("palette.ppm"), b"warm = gold\n");
    std::fs::create_dir(folder.path("deep")).unwrap();
    folder.write("deep/a.hry", "import \"../palette.ppm\"\nscene = { size = (4, 3), background = warm, objects = [ sphere {} ], lights = [ ambient {} ] }\n");
    folder
        .run_in("deep", "render a.hry --root .. -o ../palette.ppm")
        .says(2, &["would replace a file that the scene imports"]);
}

#[test]
fn an_image_that_is_used_is_not_replaced() {
    let folder = folder();
    folder.run("render row.hry -o map.png").says(0, &[]);
    let map = folder.read("map.png");
    let scene = "paper = image \"map.png\"
scene = { size = (4, 3), objects = [sphere { material = classic { color = imageMap paper } }] }\n";
    folder.write("map.hry", scene);
    let refusal = "would replace an image that the scene uses, `map.png`";
    folder.run("render map.hry").says(2, &[refusal]);
    folder.run("render map.hry -o map.png").says(2, &[refusal]);
    folder.run("render map.hry -o ./map.png").says(2, &["would replace an image"]);
    std::fs::create_dir(folder.path("deep")).unwrap();
    folder.run_in("deep", "render ../map.hry -o ../map.png").says(2, &["would replace an image"]);
    folder.write("1.png", &map);
    folder.write("moves.hry", scene.replace("map.png", "1.png").replace("scene =", "scene time ="));
    folder
        .run("render moves.hry --frames 0..1 -o #.png")
        .says(2, &["would replace an image that the scene uses, `1.png`"]);
    folder.write("map.apng", &map);
    folder.write("late.hry", scene.replace("map.png", "map.apng").replace("scene =", "scene time ="));
    folder.run("render late.hry --frames 0..1 -o map.apng").says(2, &["would replace an image"]);
    assert!(folder.read("map.png") == map && folder.read("1.png") == map && folder.read("map.apng") == map);
}

#[test]
fn files_are_called_as_they_are_found_from_here() {
    let folder = folder();
    std::fs::create_dir_all(folder.path("a/b")).unwrap();
    folder.write("palette.hry", "warm = gold +\n");
    folder.write("a/other.hry", "cold = sky +\n");
    folder.write("a/b/use.hry", "import \"../../palette.hry\"\nimport \"../other.hry\"\nscene = {}\n");
    folder.run("check a/b/use.hry --root .").says(1, &["--> palette.hry:1:", "--> a/other.hry:1:"]);
    folder
        .run_in("a/b", "check use.hry --root ../..")
        .says(1, &["--> ../../palette.hry:1:", "--> ../other.hry:1:"]);
    folder.run_in("a", "check b/use.hry --root ..").says(1, &["--> ../palette.hry:1:", "--> other.hry:1:"]);
    // What is read is not decided by what it is called.
    folder.run("render row.hry -o a/map.png").says(0, &[]);
    folder.write("a/b/map.hry", "scene = { depth = floor (aspect (image \"../map.png\")) }\n");
    folder.run_in("a/b", "check map.hry --root ../..").says(0, &["no errors"]);
    folder
        .run_in("a/b", "check map.hry --root ../.. --set scene={depth=floor(aspect(image\"../map.png\"))}")
        .says(0, &[]);
}

#[test]
fn a_file_without_a_scene_can_be_checked_and_not_rendered() {
    let folder = folder();
    folder.write("palette.hry", "warm : Color\nwarm = gold\ncold = sky\n");
    folder.run("check palette.hry row.hry").says(
        0,
        &[
            "`palette.hry` has no scene, only 2 definitions for others to import",
            "checked 2 files: no errors",
        ],
    );
    assert_eq!(folder.run("check palette.hry --json").stdout(), "[]\n");
    for command in ["render palette.hry", "info palette.hry"] {
        folder.run(command).says(1, &["error[no-scene]", "the smallest scene"]);
    }
    folder.write("wrong.hry", "warm : Number\nwarm = gold\n");
    let outcome = folder.run("check wrong.hry");
    outcome.says(1, &["wrong.hry:2:8", "1 error"]);
    assert!(!outcome.stderr.contains("no-scene"), "{}", outcome.stderr);
    folder.write("typo.hry", "scnee = { objects = [] }\n");
    folder.run("check typo.hry").says(1, &["error[no-scene]", "what is rendered is called `scene`"]);
}

#[test]
fn a_value_of_another_type_can_be_set_where_it_fits() {
    let folder = folder();
    let scene = "paint : Color\npaint = gold\nballs : Number\nballs = 2
scene = { size = (4, 3), depth = balls, objects = [sphere { material = classic { color = paint } }] }\n";
    folder.write("a.hry", scene);
    folder.run("check a.hry --set paint=\\h->gold*h.u").says(1, &["error"]);
    folder.run("check a.hry --set paint=\\h->gold*h.uv.x").says(0, &["no errors"]);
    folder.run("check a.hry --set balls=red").says(1, &["--set balls:1:9", "a.hry:3:9"]);
}

#[test]
fn a_scene_that_never_ends_ends() {
    let folder = folder();
    folder.write("loop.hry", "grow n = grow (n + 1)\nscene = { depth = grow 0 }\n");
    folder.run("render loop.hry --eval-steps 1_000_000").says(1, &["error", "loop.hry:1:", "--eval-"]);
    folder.write("long.hry", "scene = { depth = count [0 .. 100] - 98 }\n");
    folder.run("check long.hry").says(0, &[]);
    folder.run("check long.hry --eval-list 50").says(1, &["--eval-list"]);
    folder.run("check long.hry --eval-steps 50").says(1, &["--eval-steps"]);
    for wrong in ["--eval-steps 0", "--eval-depth 1e3", "--eval-list x", "--eval-memory -1", "--eval-nodes 0"]
    {
        folder.run(&format!("check long.hry {wrong}")).says(2, &[]);
    }
}

#[test]
fn a_file_that_is_nearly_classic_is_told_so_and_one_without_a_scene_too() {
    let folder = folder();
    folder.write("typo.hry", SCENE.replace("renderDescr", "renderDesc"));
    folder.run("check typo.hry").says(1, &["`renderDescr`"]);
    folder.write("none.hry", "ball = sphere {}\n");
    folder.run("info none.hry").says(1, &["none.hry", "scene"]);
    folder.write("empty.hry", "");
    folder.run("check empty.hry").says(1, &["empty.hry", "scene"]);
}

#[test]
fn warnings_have_levels() {
    let folder = folder();
    folder.write("unused.hry", format!("spare = 3\n{ROW}"));
    folder.run("check unused.hry").says(0, &["unused-definition", "1 warning"]);
    folder.run("check unused.hry --allow unused-definition").says(0, &["no warnings"]);
    folder.run("render unused.hry --deny warnings").says(1, &["error[unused-definition]"]);
    assert!(folder.run("check --help").stdout().contains("unused-definition"));
}

#[test]
fn info_knows_what_hry_adds() {
    let folder = folder();
    let outcome = folder.run("info row.hry");
    outcome.says(0, &[]);
    for line in
        ["samples      1 a pixel", "integrator   whitted", "encoding     srgb", "objects      3 (3 spheres"]
    {
        assert!(outcome.stdout().contains(line), "{line}: {}", outcome.stdout());
    }
    let value: serde_json::Value = serde_json::from_str(folder.run("info row.hry --json").stdout()).unwrap();
    assert_eq!((&value["language"], &value["animated"]), (&"hry".into(), &false.into()));
    assert_eq!((&value["integrator"], &value["encoding"]), (&"whitted".into(), &"srgb".into()));
    folder.write("time.hry", ROW.replace("scene =", "scene time =").replace("(3, 4, 5)", "(3, time, 5)"));
    let outcome = folder.run("info time.hry --time 1.5 --set count=2");
    assert!(outcome.stdout().contains("time         1.5 s") && outcome.stdout().contains("2 spheres"));
}

#[test]
fn findings_are_json_for_programs() {
    let folder = folder();
    folder.write("wrong.hry", "s\u{f6} = 1\nscene = { objects = [spere {}] }\n");
    folder.write("classic.hry", SCENE.replace("sphere", "spere"));
    let outcome = folder.run("check row.hry wrong.hry classic.hry none.hry --json");
    outcome.says(1, &[]);
    assert_eq!(outcome.stderr, "");
    let found: serde_json::Value = serde_json::from_str(outcome.stdout()).unwrap();
    let of = |file: &str| found.as_array().unwrap().iter().find(|finding| finding["file"] == file).unwrap();
    let classic = of("classic.hry");
    assert_eq!((&classic["severity"], &classic["labels"][0]["line"]), (&"error".into(), &5.into()));
    assert_eq!(of("none.hry")["labels"], serde_json::json!([]));
    let all = found.as_array().unwrap();
    let spere =
        all.iter().find(|f| f["message"].as_str().unwrap().contains("spere") && f["file"] == "wrong.hry");
    let label = &spere.unwrap()["labels"][0];
    assert_eq!(
        [
            &label["line"],
            &label["column"],
            &label["end_line"],
            &label["end_column"],
            &label["start"],
            &label["end"]
        ],
        [2, 22, 2, 27, 29, 34]
    );
    assert_eq!(label["primary"], true);
    assert_eq!(folder.run("check row.hry --json").stdout(), "[]\n");
}
