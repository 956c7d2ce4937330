//! What a user sees of every lint, and that sensible scenes give none.

use crate::common::{SCENE, broken, diagnose, shown};
use hray_lang::lint::{CLASSIC_LINTS, Level, LintLevels, MOST_PER_LINT};
use insta::assert_snapshot;

/// One change of the scene for each lint, two where it has two faces.
const SUSPICIOUS: &[(&str, &str, &str)] = &[
    ("black-picture", ") 3 [", ") -1 ["),
    ("component-range", "solid (0.8,0.2,0.2)", "solid (0.8,1.2,-0.2)"),
    ("component-range", "0.3 60 0.0 0.0", "3.0 60 0.0 0.0"),
    ("component-range", "(0.7,0.7,0.7)", "(0.7,0.7,70.0)"),
    ("duplicate-object", "plane (0.0,1.0,0.0,50.0)", "sphere 40.0 (0.0,0.0,-150.0)"),
    ("eye-in-window", "(0.0,0.0,150.0)", "(0.0,0.0,0.0)"),
    ("light-inside-sphere", "(90.0,80.0,70.0)", "(0.0,10.0,-150.0)"),
    ("many-octaves", "10 64.0", "100 64.0"),
    ("negative-shine", "0.3 60", "0.3 -60"),
    (
        "no-lights",
        "\n        (pointLight (90.0,80.0,70.0) (0.7,0.7,0.7))\n        (ambientLight (0.1,0.1,0.1))",
        "",
    ),
    ("noise-grid", "10 64.0", "10 0.0"),
    ("object-behind-plane", "(0.0,0.0,-150.0)", "(0.0,-100.0,-150.0)"),
    ("object-inside-object", "plane (0.0,1.0,0.0,50.0)", "sphere 20.0 (5.0,0.0,-150.0)"),
    ("pixel-aspect", "(400,300)", "(400,320)"),
    ("plane-normal", "(0.0,1.0,0.0,50.0)", "(0.0,0.0,0.0,50.0)"),
    ("refraction-index", "0.3 60 0.0 0.0", "0.3 60 0.8 0.0"),
    ("sphere-radius", "sphere 40.0", "sphere -40.0"),
    ("sphere-radius", "sphere 40.0", "sphere 0.0"),
    ("window-size", "(100,75)", "(100,-75)"),
];

#[test]
fn every_lint_has_its_say() {
    for (index, (code, from, to)) in SUSPICIOUS.iter().enumerate() {
        let source = broken(from, to);
        let (found, _) = diagnose(source.as_bytes(), &LintLevels::default());
        assert!(found.iter().all(|warning| warning.code == *code && !warning.is_error()), "{found:#?}");
        assert_snapshot!(format!("{code}-{index}"), shown(source.as_bytes()));
    }
    let tried = |code| SUSPICIOUS.iter().any(|(tried, ..)| *tried == code);
    assert!(CLASSIC_LINTS.iter().all(|lint| tried(lint.code)), "a lint is not tried");
}

#[test]
fn a_lint_can_be_silenced_or_made_an_error() {
    for (code, from, to) in SUSPICIOUS {
        let source = broken(from, to);
        let mut levels = LintLevels::default();
        levels.set(code, Level::Allow).unwrap();
        assert_eq!(diagnose(source.as_bytes(), &levels).0, []);
        levels.set("warnings", Level::Deny).unwrap();
        let (found, _) = diagnose(source.as_bytes(), &levels);
        assert!(!found.is_empty() && found.iter().all(|error| error.is_error()), "{code}");
    }
}

#[test]
fn a_sensible_scene_gives_no_warning() {
    assert_eq!(shown(SCENE.as_bytes()), "");
    for (from, to) in [
        // A matt surface without highlight, and opaque ones with any refraction index.
        ("0.3 60 0.0 0.0", "0.0 0 0.0 1.5"),
        // Glass.
        ("0.3 60 0.0 0.0", "0.1 60 0.8 1.5"),
        // Two that overlap.
        ("plane (0.0,1.0,0.0,50.0)", "sphere 40.0 (10.0,0.0,-150.0)"),
        // A room: a sphere around window, lights and objects.
        ("plane (0.0,1.0,0.0,50.0)", "sphere 500.0 (0.0,0.0,0.0)"),
        // A sphere that stands out of the floor, or is touched by it.
        ("(0.0,0.0,-150.0)", "(0.0,-60.0,-150.0)"),
        ("(0.0,0.0,-150.0)", "(0.0,-10.0,-150.0)"),
        // A picture of few pixels cannot have the proportions of the window.
        ("(400,300)", "(3,2)"),
        ("(400,300)", "(1,1)"),
        ("(400,300)", "(401,300)"),
        // No objects, and so no need for lights.
        (") 3 [", ") 0 ["),
    ] {
        let source = broken(from, to);
        assert_eq!(shown(source.as_bytes()), "", "{to}");
    }
}

#[test]
fn what_is_lit_or_seen_some_other_way_is_not_called_hidden() {
    // A sphere behind the floor, but a light is there, too: the floor is lit from below.
    let source =
        broken("(0.0,0.0,-150.0)", "(0.0,-100.0,-150.0)").replace("(90.0,80.0,70.0)", "(90.0,-80.0,70.0)");
    assert_eq!(shown(source.as_bytes()), "");
    // A glass floor.
    let source = broken("(0.0,0.0,-150.0)", "(0.0,-100.0,-150.0)").replace("0.0 0 0.0 0.0", "0.0 0 0.5 1.0");
    assert_eq!(shown(source.as_bytes()), "");
    // A sphere inside an opaque one, in the place of which a glass one is seen.
    let double = "sphere 40.0 (0.0,0.0,-150.0) ) ( texture ( diff solid (0.8,0.2,0.2) ) 0.3 60 0.5 1.5 ))
        (object ( sphere 20.0 (0.0,0.0,-150.0)";
    let source = broken("plane (0.0,1.0,0.0,50.0)", double);
    let (found, _) = diagnose(source.as_bytes(), &LintLevels::default());
    assert!(found.iter().all(|warning| warning.code == "duplicate-object"), "{found:#?}");
    // A sphere inside a glass one.
    let source = broken("plane (0.0,1.0,0.0,50.0)", "sphere 41.0 (0.0,0.0,-150.0)")
        .replace("0.0 0 0.0 0.0", "0.0 0 0.5 1.5");
    assert_eq!(shown(source.as_bytes()), "");
}

#[test]
fn many_findings_of_one_kind_are_counted() {
    let object =
        "(object ( sphere 1.0 (0.0,0.0,-9.0) ) ( texture ( diff solid (2.0,0.0,0.0) ) 0.0 0 0.0 0.0 ))\n";
    let objects: String = (0..30).map(|i| object.replace("-9.0", &format!("-{}.0", 10 + 5 * i))).collect();
    let source = broken("(object ( plane", &format!("{objects}(object ( plane"));
    let (mut found, _) = diagnose(source.as_bytes(), &LintLevels::default());
    found.retain(|warning| warning.code == "component-range");
    assert_eq!(found.len(), MOST_PER_LINT);
    assert_eq!(found.last().unwrap().notes, ["there are 25 more findings of this kind"]);
}
