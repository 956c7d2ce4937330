//! What a warning calls invisible is invisible: without it the picture is the same to the bit.

use conformance::{engine_colors, random};
use hray::{Light, LintLevels, NoiseTables, Plane, Primitive, SceneFile, Shape, Sphere};
use std::sync::Arc;

/// Warnings that say of an object that it cannot be seen.
const UNSEEN: [&str; 4] = ["duplicate-object", "object-behind-plane", "object-inside-object", "plane-normal"];

/// The places of the objects in a printed scene.
fn objects(text: &str) -> Vec<usize> {
    let places = text.match_indices("object").map(|(place, _)| place);
    // Not the section `objects`, whose name begins alike.
    places.filter(|place| !text[*place..].starts_with("objects")).collect()
}

#[test]
fn objects_reported_as_invisible_can_be_removed() {
    let tables = NoiseTables::default();
    let (mut removed, mut by_code) = (0, [0; UNSEEN.len()]);
    for seed in 0..1500 {
        let mut description = random::description(seed).unwrap();
        provoke(seed, &mut description.scene.primitives);
        if seed % 2 == 0 {
            // Lights far away, so that what is behind something is dark as well.
            description.scene.lights.retain(|light| matches!(light, Light::Ambient { .. }));
        }
        let text = hray::write_classic(&description).unwrap();
        let file = SceneFile::parse("random.hry", text.clone().into_bytes(), &LintLevels::default());
        let places = objects(&text);
        assert_eq!(places.len(), description.scene.primitives.len());
        for diagnostic in file.diagnostics() {
            let Some(code) = UNSEEN.iter().position(|code| *code == diagnostic.code) else { continue };
            let index = places.partition_point(|place| *place <= diagnostic.primary.span.start) - 1;
            let mut without = description.clone();
            without.scene.primitives.remove(index);
            let colors = |d| engine_colors(d, &tables, 1).unwrap();
            assert!(
                colors(&description) == colors(&without),
                "seed {seed}: {} is wrong about object {index} of\n{text}",
                diagnostic.code
            );
            removed += 1;
            by_code[code] += 1;
        }
    }
    assert!(by_code.iter().all(|count| *count >= 20), "of {removed}: {by_code:?}");
}

/// Makes objects that are hidden more likely.
fn provoke(seed: u64, primitives: &mut [Primitive]) {
    let Some((last, rest)) = primitives.split_last_mut() else { return };
    let Some(first) = rest.first_mut() else { return };
    match (seed % 3, last.shape.clone()) {
        (0, Shape::Sphere(outer)) => {
            Arc::make_mut(&mut last.material).transmission = 0.0.into();
            first.shape = Shape::Sphere(Sphere { radius: outer.radius / 2.0, center: outer.center });
        }
        (1, _) => {
            Arc::make_mut(&mut last.material).transmission = 0.0.into();
            last.shape = Shape::Plane(Plane { normal: hray::DVec3::new(0.1, 0.2, 1.0), offset: 130.0 });
            let center = hray::DVec3::new(10.0, -5.0, -400.0 - seed as f64);
            first.shape = Shape::Sphere(Sphere { radius: 40.0, center });
        }
        _ => {}
    }
}
