//! `hray fmt` and `hray convert`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, SCENE};

const UNTIDY: &str = "scene={objects=[sphere{}],lights=[ambient{intensity=1}]}\n";

#[test]
fn a_classic_scene_becomes_one_in_hry_with_the_same_picture() {
    let folder = Folder::new();
    folder.run("convert scene.hry -o new.hry").says(0, &[]);
    let printed = folder.run("convert scene.hry");
    assert_eq!(printed.stdout, folder.read("new.hry"));
    folder.run("check new.hry --deny warnings").says(0, &["no errors, no warnings"]);
    for name in ["scene", "new"] {
        folder.run(&format!("{name}.hry {name}.ppm")).says(0, &[]);
        folder.run(&format!("render {name}.hry -o {name}.png -q")).says(0, &[]);
    }
    assert_eq!(folder.read("scene.ppm"), folder.read("new.ppm"));
    assert_eq!(folder.read("scene.png"), folder.read("new.png"));
    let piped = folder.run_with_input("convert -", SCENE.as_bytes());
    assert_eq!(piped.stdout, printed.stdout);
}

#[test]
fn what_cannot_be_converted_is_refused() {
    let folder = Folder::new();
    folder.write("new.hry", UNTIDY);
    folder.run("convert new.hry").says(1, &["`new.hry` is a scene in hry already"]);
    folder.run("convert scene.hry -o scene.hry").says(2, &["would replace the old one"]);
    folder.run("convert none.hry").says(1, &["there is no such file"]);
    folder.run("convert scene.hry -o no/new.hry").says(1, &["there is no directory `no`"]);
    folder.write("wrong.hry", SCENE.replace("sphere", "spere"));
    folder.run("convert wrong.hry -o new.hry").says(1, &["wrong.hry:5:"]);
    assert_eq!(folder.read("new.hry"), UNTIDY.as_bytes());
    folder.write("inside-out.hry", SCENE.replace("sphere 25.0", "sphere -25.0"));
    folder.run("convert inside-out.hry").says(1, &["a radius greater than 0"]);
}
