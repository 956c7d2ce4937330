//! `hray render`: options and output.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

mod common;

use common::{Folder, SCENE, decoded, decoded_text};

#[test]
fn without_an_output_the_picture_has_the_name_of_the_scene() {
    let folder = Folder::new();
    let outcome = folder.run("render scene.hry");
    outcome.says(0, &["scene.png: 40x30 png, 2 objects, 2 lights\n", " camera, ", " rays per second\n"]);
    outcome.says(0, &[" 1,200 camera", " shadow, ", " reflection, ", " refraction\n"]);
    assert!(outcome.stdout.is_empty());
    assert_eq!(folder.names(), ["scene.hry", "scene.png"]);
    assert_eq!(folder.run("render scene.hry --quiet").stderr, "");
    folder.run("render scene.hry -q --format bmp").says(0, &[]);
    assert_eq!(decoded(&folder.path("scene.bmp")), decoded(&folder.path("scene.png")));
}

#[test]
fn all_formats_show_the_same_pixels() {
    let folder = Folder::new();
    folder.run("scene.hry classic.ppm").says(0, &[]);
    folder.run("render scene.hry -o text.ppm --ascii").says(0, &["text.ppm: 40x30 ppm-ascii"]);
    assert_eq!(folder.read("text.ppm"), folder.read("classic.ppm"));
    let classic = decoded_text(&folder.read("classic.ppm"));
    for name in ["a.png", "A.PNG", "a.bmp", "a.tiff"] {
        folder.run(&format!("render scene.hry -o {name}")).says(0, &[]);
        assert_eq!(decoded(&folder.path(name)), classic, "{name}");
    }
    folder.run("render scene.hry -o a.ppm").says(0, &[]);
    let binary = folder.read("a.ppm");
    assert_eq!(binary.strip_prefix(b"P6\n40 30\n255\n"), Some(&classic.2[..]));
}

#[test]
fn the_format_is_told_by_the_option_before_the_name() {
    let folder = Folder::new();
    folder
        .run("render scene.hry -o a.png --format bmp")
        .says(0, &["warning: `a.png` will hold a picture of the format bmp"]);
    assert!(folder.read("a.png").starts_with(b"BM"));
    folder.run("render scene.hry -o picture --format QOI").says(0, &[]);
    assert!(folder.read("picture").starts_with(b"qoif"));
    folder
        .run("render scene.hry -o picture")
        .says(2, &["`picture`: it has no extension; known are png, ppm"]);
    folder
        .run("render scene.hry -o a.jp2")
        .says(2, &["no picture format has the extension `jp2`", "--format"]);
    folder
        .run("render scene.hry --format gif")
        .says(2, &["invalid value 'gif'", "[possible values: png, ppm"]);
    folder.run("render scene.hry -o a.png --ascii").says(2, &["--ascii is for PPM"]);
    folder.run("render scene.hry --ascii").says(2, &["--ascii is for PPM"]);
    folder.run("render scene.hry --ascii --format ppm").says(0, &[]);
    assert!(folder.read("scene.ppm").starts_with(b"P3\n"));
}

#[test]
fn standard_input_and_output_are_files_like_others() {
    let folder = Folder::new();
    folder.run("render scene.hry").says(0, &[]);
    let piped = folder.run_with_input("render - -o -", SCENE.as_bytes());
    piped.says(0, &["the standard output: 40x30 png"]);
    assert_eq!(piped.stdout, folder.read("scene.png"));
    let text = folder.run("render scene.hry -o - --format ppm --ascii -q");
    assert!(text.stdout.starts_with(b"P3\n40 30\n255\n") && text.stderr.is_empty());
    folder.run_with_input("render -", SCENE.as_bytes()).says(2, &["give one with -o"]);
    folder
        .run_with_input("render - -o a.png", b"renderDescr ( resolution")
        .says(1, &["error", "<standard input>:1:"]);
    assert_eq!(folder.names(), ["scene.hry", "scene.png"]);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let folder = Folder::new();
    for threads in [1, 3] {
        folder.run(&format!("render scene.hry -o {threads}.exr --threads {threads}")).says(0, &["s with "]);
    }
    assert_eq!(folder.read("1.exr"), folder.read("3.exr"));
}

#[test]
fn a_region_is_that_part_of_the_picture() {
    let folder = Folder::new();
    folder.run("render scene.hry").says(0, &[]);
    folder.run("render scene.hry -o part.png --region 7,11,13,5").says(0, &["part.png: 13x5 png"]);
    let (width, _, whole) = decoded(&folder.path("scene.png"));
    let rows = whole.chunks_exact(3 * width as usize).skip(11).take(5);
    let cropped: Vec<u8> = rows.flat_map(|row| &row[3 * 7..3 * (7 + 13)]).copied().collect();
    assert_eq!(decoded(&folder.path("part.png")), (13, 5, cropped));
    folder.run("render scene.hry --region 30,0,11,1").says(2, &["does not lie inside the picture of 40x30"]);
    folder.run("render scene.hry --region 0,0,0,1").says(2, &["has no pixels"]);
    folder.run("render scene.hry --region 4294967295,0,2,1").says(2, &["does not lie inside"]);
    folder.run("render scene.hry --region 1,2,3").says(2, &["four whole numbers"]);
}

#[test]
fn size_depth_and_samples_replace_those_of_the_scene() {
    let folder = Folder::new();
    folder.run("render scene.hry -o a.png --size 80x60").says(0, &["a.png: 80x60"]);
    let same_shape = folder.run("render scene.hry -o a.png --size 20x15 -q");
    assert_eq!(same_shape.stderr, "");
    folder.run("render scene.hry -o a.png --size 40x40").says(
        0,
        &[
            "warning: --size 40x40 has another shape than the scene's 40x30",
            "squeezed to 0.75 times its width",
        ],
    );
    folder.run("render scene.hry -o black.png --depth -1").says(0, &["\n0 rays"]);
    assert!(decoded(&folder.path("black.png")).2.iter().all(|component| *component == 0));
    folder.run("render scene.hry -o flat.png --depth 0").says(0, &[" 0 reflection, 0 refraction"]);
    folder.run("render scene.hry -o a.png --samples 4").says(0, &["4,800 camera"]);

    folder.run("render scene.hry --size 0x9").says(2, &["has no pixels"]);
    folder.run("render scene.hry --size 2000000000x2000000000").says(2, &["too large"]);
    folder.run("render scene.hry --size big").says(2, &["such as 640x480"]);
    folder.run("render scene.hry --depth 10001").says(2, &["from -1 to 10000"]);
    folder.run("render scene.hry --samples 0").says(2, &["from 1 to 65536"]);
    folder.run("render scene.hry --threads 0").says(2, &["from 1 to 1024"]);
    folder.run("render scene.hry -o a.webp --size 20000x10").says(1, &["too large for the format webp"]);
}

#[test]
fn warnings_are_allowed_and_denied_in_the_order_of_the_command_line() {
    let folder = Folder::new();
    folder.write("bright.hry", SCENE.replace("(0.2,0.3,0.5)", "(2.0,0.3,0.5)"));
    folder.run("render bright.hry").says(0, &["warning[component-range]"]);
    let allowed = folder.run("render bright.hry -q --deny warnings --allow component-range");
    assert_eq!((allowed.code, allowed.stderr.as_str()), (Some(0), ""));
    let again = folder.run("render bright.hry -q --allow component-range --warn component-range");
    again.says(0, &["warning[component-range]"]);
    folder
        .run("render bright.hry -o b.png --allow component-range --deny component-range")
        .says(1, &["error[component-range]"]);
    assert!(!folder.path("b.png").exists());
    folder.run("render bright.hry --deny component-rang").says(2, &["component-range"]);
}

#[test]
fn what_the_picture_is_made_from_is_not_replaced() {
    let folder = Folder::new();
    folder
        .run("render scene.hry -o ./scene.hry --format png")
        .says(2, &["would replace the scene `./scene.hry`"]);
    folder.run("scene.hry scene.hry").says(2, &["scene.hry"]);
    folder.write("tables.png", "{}");
    folder
        .run("render scene.hry -o tables.png --noise-tables tables.png")
        .says(2, &["would replace the noise tables `tables.png`"]);
    folder.write("scene.png", SCENE);
    folder.run("render scene.png").says(2, &["would replace the scene `scene.png`"]);
    assert_eq!((folder.read("scene.hry"), folder.read("tables.png")), (SCENE.into(), b"{}".to_vec()));
}

#[test]
fn messages_have_no_colours_where_nobody_sees_them() {
    let folder = Folder::new();
    folder.write("wrong.hry", SCENE.replace("sphere", "spere"));
    let outcome = folder.run("render wrong.hry");
    outcome.says(1, &["error", "wrong.hry:5:", "spere", "sphere"]);
    assert!(!outcome.stderr.contains('\u{1b}'));
}
