//! From a scene to a picture, by each of the ways there are.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test may fail loudly")]

use hray::{
    Background, Control, Description, Destination, Encoding, Error, LintLevels, LoadError, Options,
    PictureFormat, Resolution, SceneFile,
};
use std::num::{NonZeroU32, NonZeroUsize};

const SCENE: &str = "renderDescr ( resolution (61,47) ) 6 [
    scene { camera (0.0,0.0,150.0) (100,75) } { background (0.2,0.3,0.5) }
    { objects
        (object ( sphere 25.0 (10.0,0.0,-50.0) ) ( texture ( diff solid (0.9,0.5,0.1) ) 0.3 20 0.4 1.3 ))
        (object ( plane (0.0,1.0,0.0,30.0) ) ( texture ( diff perlin (perlinTurb (0.5,0.9,0.2) 3 7.5) ) 0.5 20 0.0 0.0 )) }
    { lights (pointLight (80.0,80.0,100.0) (0.9,0.9,0.9)) (ambientLight (0.05,0.05,0.05)) } ]";

fn scene() -> Description {
    SceneFile::parse("scene.hry", SCENE.into(), &LintLevels::default()).into_description().unwrap()
}

fn bytes(options: &Options, format: PictureFormat) -> Vec<u8> {
    hray::render_to_bytes(&scene(), options, format, &Control::new()).unwrap().0
}

#[test]
fn all_ways_give_the_same_picture() {
    let (scene, options) = (scene(), Options::default());
    let directory = tempfile::tempdir().unwrap();
    let (picture, in_memory) = hray::render_to_memory(&scene, &options, &Control::new()).unwrap();
    assert_eq!((picture.width(), picture.height()), (61, 47));
    assert_eq!((picture.pixel(60, 46), picture.pixel(61, 0)), (picture.pixels().last().copied(), None));
    for format in PictureFormat::ALL {
        let expected = bytes(&options, format);
        assert_eq!(picture.encode(format).unwrap(), expected, "{format}");
        let Some(extension) = format.extensions().first() else { continue };
        let path = directory.path().join("a").with_extension(extension);
        let statistics = hray::render_to_file(&scene, &options, &path, &Control::new()).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), expected, "{format}");
        assert_eq!(statistics.rays, in_memory.rays);
        picture.save(&path).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), expected, "{format}");
    }
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let with = |threads| {
        let options = Options { threads: NonZeroUsize::new(threads), ..Options::default() };
        bytes(&options, PictureFormat::Exr)
    };
    let one = with(1);
    for threads in [2, 3, 8] {
        assert_eq!(with(threads), one, "{threads} threads");
    }
}

#[test]
fn a_region_is_that_part_of_the_picture() {
    for samples in [1, 4] {
        let options = Options { samples: NonZeroU32::new(samples), ..Options::default() };
        let (whole, _) = hray::render_to_memory(&scene(), &options, &Control::new()).unwrap();
        let [x, y, width, height] = [13, 21, 17, 9];
        let options = Options { region: Some([x, y, width, height]), ..options };
        let (part, _) = hray::render_to_memory(&scene(), &options, &Control::new()).unwrap();
        assert_eq!((part.width(), part.height()), (width, height));
        for (px, py) in (0..width).flat_map(|px| (0..height).map(move |py| (px, py))) {
            assert_eq!(part.pixel(px, py), whole.pixel(x + px, y + py), "{samples} samples, ({px}, {py})");
        }
    }
}

#[test]
fn a_stopped_render_leaves_what_was_there() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.png");
    std::fs::write(&path, "old").unwrap();
    let control = Control::new();
    control.cancel();
    let result = hray::render_to_file(&scene(), &Options::default(), &path, &control);
    assert!(matches!(result, Err(Error::Cancelled)));
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
}

#[test]
fn what_cannot_be_written_is_refused() {
    let (scene, options, control) = (scene(), Options::default(), Control::new());
    let refused = |path: &str| hray::render_to_file(&scene, &options, path, &control).unwrap_err();
    assert!(matches!(refused("a.gif"), Error::Format(_)));
    assert!(matches!(refused("no/such/directory/a.png"), Error::Output(_)));
    let large = Options { size: Resolution::new(20_000, 10).ok(), ..Options::default() };
    let destination = Destination::stdout();
    let result = hray::render_to(&scene, &large, &destination, PictureFormat::WebP, &control);
    assert!(result.unwrap_err().to_string().contains("too large for the format webp"));
}

#[test]
fn a_scene_with_errors_is_an_error_that_shows_them() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("wrong.hry");
    std::fs::write(&path, SCENE.replace("sphere", "spere")).unwrap();
    let error = hray::load(&path).unwrap_err();
    assert!(matches!(error, Error::Load(LoadError::Scene(_))));
    let text = error.to_string();
    assert!(text.contains("spere") && text.contains("sphere") && text.contains("wrong.hry:4:"), "{text}");
    assert!(matches!(hray::load(directory.path()), Err(Error::Load(LoadError::Input(_)))));
}

#[test]
fn a_denied_warning_is_an_error() {
    let mut levels = LintLevels::default();
    let text = SCENE.replace("(0.2,0.3,0.5)", "(2.0,0.3,0.5)");
    let warned = SceneFile::parse("a.hry", text.clone().into(), &levels);
    assert_eq!((warned.errors(), warned.warnings() > 0, warned.description().is_some()), (0, true, true));
    levels.set(hray::ALL_LINTS, hray::Level::Deny).unwrap();
    let denied = SceneFile::parse("a.hry", text.into(), &levels);
    assert_eq!((denied.errors() > 0, denied.warnings(), denied.description().is_some()), (true, 0, false));
}

#[test]
fn text_that_is_not_utf8_is_one_error() {
    let file = SceneFile::parse("a.hry", b"renderDescr \xff".to_vec(), &LintLevels::default());
    assert_eq!((file.errors(), file.description()), (1, None));
    assert!(file.report(false).contains("not UTF-8"));
}

/// Linear light comes out of the file as the transfer function of sRGB has it; a raw scene's numbers pass through,
/// and OpenEXR holds what was computed.
#[test]
fn a_colour_s_journey() {
    let file = |format, encoding| {
        let mut description = scene();
        description.encoding = encoding;
        description.scene.background = Background::Uniform(hray::Rgb::new(0.5, 0.5, 0.5));
        description.scene.primitives.clear();
        let (picture, _) =
            hray::render_to_memory(&description, &Options::default(), &Control::new()).unwrap();
        assert_eq!(
            (picture.encoding(), picture.pixel(3, 4)),
            (encoding, Some(hray::Rgb::new(0.5, 0.5, 0.5)))
        );
        let (bytes, _) =
            hray::render_to_bytes(&description, &Options::default(), format, &Control::new()).unwrap();
        assert_eq!(picture.encode(format).unwrap(), bytes);
        bytes
    };
    let last = |format, encoding| file(format, encoding).last().copied();
    assert_eq!(last(PictureFormat::Ppm, Encoding::Srgb), Some(188));
    assert_eq!(last(PictureFormat::Ppm, Encoding::Raw), Some(128));
    let text = |encoding| String::from_utf8(file(PictureFormat::PpmAscii, encoding)).unwrap();
    assert!(text(Encoding::Srgb).ends_with(" 188 188 ") && text(Encoding::Raw).ends_with(" 128 128 "));
    assert_eq!(file(PictureFormat::Exr, Encoding::Srgb), file(PictureFormat::Exr, Encoding::Raw));
    assert_ne!(file(PictureFormat::Farbfeld, Encoding::Srgb), file(PictureFormat::Farbfeld, Encoding::Raw));
}

#[test]
fn the_scene_asks_for_samples_and_options_override_it() {
    let mut description = scene();
    description.samples = NonZeroU32::new(4).unwrap();
    let colors = |description: &Description, options: &Options| {
        hray::render_to_memory(description, options, &Control::new()).unwrap().0
    };
    let four = Options { samples: NonZeroU32::new(4), ..Options::default() };
    let one = Options { samples: NonZeroU32::new(1), ..Options::default() };
    assert_eq!(colors(&description, &Options::default()), colors(&scene(), &four));
    assert_eq!(colors(&description, &one), colors(&scene(), &Options::default()));
}
