//! A classic scene in hry is the same scene.

use conformance::{engine_colors, random};
use hray::{LintLevels, NoiseTables, SceneFile};

#[test]
fn random_scenes_survive_conversion() {
    let tables = NoiseTables::default();
    let mut converted = 0;
    for seed in 0..600 {
        let description = random::description(seed).unwrap();
        let Some(text) = hray::convert(&description) else { continue };
        let file = SceneFile::parse("converted.hry", text.clone().into_bytes(), &LintLevels::default());
        assert_eq!(file.errors(), 0, "seed {seed}: {}\n{text}", file.report(false));
        let found = file.description().unwrap();
        assert!(*found == description, "seed {seed}: {found:#?}\nis not {description:#?}\n{text}");
        if seed % 4 == 0 {
            let [new, old] = [found, &description].map(|d| engine_colors(d, &tables, 1).unwrap());
            // Compared as bits: there are NaNs among them.
            let bits =
                |colors: Vec<hray::Rgb>| colors.iter().flat_map(|c| c.to_array().map(f64::to_bits)).collect();
            let [new, old]: [Vec<u64>; 2] = [bits(new), bits(old)];
            assert!(new == old, "seed {seed}: the pictures differ\n{text}");
        }
        converted += 1;
    }
    assert!(converted > 200, "only {converted} scenes can be said in hry");
}
