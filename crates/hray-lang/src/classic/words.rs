//! Words that are almost right.

/// Longer words are never taken for a slip.
const LONGEST: usize = 40;

/// Every word of the grammar. (`light` is a token of the 2005 lexer that its grammar never uses.)
pub(crate) const WORDS: &[&str] = &[
    "renderDescr",
    "resolution",
    "scene",
    "camera",
    "background",
    "objects",
    "object",
    "sphere",
    "plane",
    "texture",
    "diff",
    "solid",
    "perlin",
    "perlinSolid",
    "perlinSemiTurb",
    "perlinTurb",
    "perlinFire",
    "perlinPlasma",
    "perlinMarble",
    "perlinMarbleBase",
    "perlinWood",
    "lights",
    "pointLight",
    "ambientLight",
];

/// The candidate that `word` was probably meant to be: the same but for upper and lower case, a slip of the
/// finger away, or a part of it (`marble` for `perlinMarble`).
pub(crate) fn nearest(
    word: &str,
    candidates: impl Iterator<Item = &'static str> + Clone,
) -> Option<&'static str> {
    if word.len() > LONGEST {
        return None;
    }
    let lower = word.to_lowercase();
    let closest = candidates
        .clone()
        .map(|candidate| (strsim::osa_distance(&lower, &candidate.to_lowercase()), candidate))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, candidate)| *distance <= tolerance(&lower, candidate));
    let part = |candidate: &&str| lower.len() >= 4 && candidate.to_lowercase().contains(&lower);
    closest.map(|(_, candidate)| candidate).or_else(|| candidates.clone().find(part))
}

/// How many slips are forgiven: about one in three letters.
fn tolerance(word: &str, candidate: &str) -> usize {
    (word.chars().count().max(candidate.len()) + 1) / 3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_cases_and_parts_are_recognised_and_other_words_are_not() {
        let near = |word| nearest(word, WORDS.iter().copied());
        for (word, meant) in [
            ("spere", "sphere"),
            ("Sphere", "sphere"),
            ("SPHERE", "sphere"),
            ("sphere", "sphere"),
            ("shpere", "sphere"),
            ("plain", "plane"),
            ("renderdesc", "renderDescr"),
            ("perlinMarbel", "perlinMarble"),
            ("marbleBase", "perlinMarbleBase"),
            ("point", "pointLight"),
            ("ambient", "ambientLight"),
            ("sphère", "sphere"),
        ] {
            assert_eq!(near(word), Some(meant), "{word}");
        }
        for word in ["cube", "torus", "x", "a", "hello", "cylinder", &"sphere".repeat(20)] {
            assert_eq!(near(word), None, "{word}");
        }
    }
}
