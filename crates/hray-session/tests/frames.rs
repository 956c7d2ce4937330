//! Pictures in tiles are the pictures of `hray render`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail loudly")]

use hray::{Description, LintLevels, Options, Resolution, Rgb, SceneFile};
use hray_session::{Control, Frame, MeshTrees, Tracer};
use std::path::PathBuf;

fn scene(text: &str) -> Description {
    let file = SceneFile::parse("a.hry", text.into(), &LintLevels::default());
    file.description().cloned().unwrap_or_else(|| panic!("{}", file.report(false)))
}

/// The last pass put together, and how many pixels each pass rendered.
fn picture(frame: &Frame) -> (Vec<Rgb>, Vec<usize>) {
    let [width, height] = [frame.resolution().width() as usize, frame.resolution().height() as usize];
    let mut pixels = vec![Rgb::new(-1.0, -1.0, -1.0); width * height];
    let (mut tracer, control) = (Tracer::new(), Control::new());
    let last = frame.passes().len() - 1;
    let mut counts = Vec::new();
    for pass in 0..=last {
        let mut count = 0;
        for tile in frame.tiles(pass).iter().rev() {
            let found = frame.render(tile, &mut tracer, &control).unwrap();
            let [x, y, w, h, step] = found.place.map(|n| n as usize);
            assert_eq!((found.colors.len(), found.rgba.len()), (w * h, 4 * w * h));
            assert_eq!(step, frame.passes()[pass].step.get() as usize);
            count += w * h;
            if pass == last {
                for (row, colors) in found.colors.chunks_exact(w).enumerate() {
                    pixels[(y + row) * width + x..][..w].copy_from_slice(colors);
                }
            }
        }
        counts.push(count);
    }
    (pixels, counts)
}

fn same_as_render(description: &Description, size: Option<Resolution>) {
    let mut meshes = MeshTrees::default();
    let frame = Frame::new(description, size, &mut meshes).unwrap();
    let options = Options { size, ..Options::default() };
    let (expected, _) = hray::render_to_memory(description, &options, &Control::new()).unwrap();
    let (found, _) = picture(&frame);
    for (index, (found, expected)) in found.iter().zip(expected.pixels()).enumerate() {
        let bits = |color: &Rgb| color.to_array().map(f64::to_bits);
        assert_eq!(bits(found), bits(expected), "pixel {index}");
    }
    assert_eq!(found.len(), expected.pixels().len());
}

const GLASS: &str = "scene = {
  size = (150, 83), samples = 3,
  objects = [
    plane {},
    sphere { center = (0, 1, 0), material = classic { color = #222222, transparency = 0.8, reflection = 0.2 } },
    triangles { points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces = [[0, 1, 2]] } |> move (1, 0, 1),
  ],
  lights = [ point { position = (3, 4, 5) } ],
}";

#[test]
fn every_pixel_is_that_of_a_render() {
    same_as_render(&scene(GLASS), None);
    same_as_render(&scene(GLASS), Resolution::new(65, 129).ok());
    same_as_render(&scene(&GLASS.replace("samples = 3", "samples = 700").replace("150, 83", "9, 5")), None);
    same_as_render(&scene(&GLASS.replace("samples = 3", "depth = -1")), None);
    same_as_render(&scene(&GLASS.replace("(150, 83)", "(1, 1)")), None);
}

#[test]
fn every_pixel_of_the_classic_scenes_is_that_of_a_render() {
    let own = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    for folder in std::env::var_os("HRAY_CLASSIC").map(PathBuf::from).into_iter().chain([own]) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "hry") {
                let text = std::fs::read_to_string(&path).unwrap();
                if text.starts_with("renderDescr") {
                    // Their shapes, at a size that does not take long.
                    same_as_render(&scene(&text), Resolution::new(97, 71).ok());
                }
            }
        }
    }
}

#[test]
fn passes_go_from_coarse_to_fine() {
    let frame = Frame::new(&scene(GLASS), None, &mut MeshTrees::default()).unwrap();
    let steps: Vec<[u32; 2]> =
        frame.passes().iter().map(|pass| [pass.step.get(), pass.samples.get()]).collect();
    assert_eq!(steps, [[16, 1], [4, 1], [1, 1], [1, 3]]);
    let (_, counts) = picture(&frame);
    assert_eq!(counts, [10 * 6, 38 * 21, 150 * 83, 150 * 83]);
    assert_eq!(frame.samples(), (60 + 798 + 4 * 150 * 83) as u64);
    // The middle comes first.
    let tiles = frame.tiles(3);
    let holds = |x: u32, y: u32| {
        let region = tiles[0].region;
        (region.x()..region.x() + region.width()).contains(&x)
            && (region.y()..region.y() + region.height()).contains(&y)
    };
    assert!(holds(75, 41));
}

#[test]
fn trees_over_meshes_are_kept_as_long_as_the_meshes_are_there() {
    let mut meshes = MeshTrees::default();
    let mut prepare = |text: &str| {
        Frame::new(&scene(text), None, &mut meshes).unwrap();
        meshes.len()
    };
    assert_eq!(prepare(GLASS), 1);
    // Another evaluation makes the same mesh anew.
    assert_eq!(prepare(&GLASS.replace("0.8", "0.7")), 1);
    assert_eq!(prepare(&GLASS.replace("(1, 0, 0)", "(2, 0, 0)")), 1);
    assert_eq!(prepare("scene = { size = (4, 3) }"), 0);
}

#[test]
fn a_picture_that_no_page_has_memory_for_is_refused() {
    let refused =
        Frame::new(&scene("scene = { size = (8193, 8192) }"), None, &mut MeshTrees::default()).unwrap_err();
    assert!(refused.message.contains("8193x8192 pixels is too large"), "{}", refused.message);
    assert!(Frame::new(&scene("scene = { size = (8192, 8192) }"), None, &mut MeshTrees::default()).is_ok());
}

#[test]
fn a_stopped_tile_is_an_error() {
    let frame = Frame::new(&scene(GLASS), None, &mut MeshTrees::default()).unwrap();
    let control = Control::new();
    control.cancel();
    assert!(frame.render(&frame.tiles(0)[0], &mut Tracer::new(), &control).is_err());
}
