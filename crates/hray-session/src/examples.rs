//! What a gallery shows of an example.

use crate::protocol::Example;
use hray::Language;

include!(concat!(env!("OUT_DIR"), "/examples.rs"));

/// The examples that come with hray. `has_picture` tells whether there is a picture at an address.
#[must_use]
pub fn examples(has_picture: impl Fn(&str) -> bool) -> Vec<Example> {
    let scenes =
        EXAMPLES.iter().filter(|(_, text)| text.starts_with("renderDescr") || text.contains("\nscene"));
    let example = |(name, text): &(&str, &str)| {
        let picture = Some(format!("examples/{name}.jpg")).filter(|picture| has_picture(picture));
        example_of(name, text, picture)
    };
    scenes.map(example).collect()
}

/// The files that examples import, by their paths.
pub fn companions() -> impl Iterator<Item = (String, &'static str)> {
    EXAMPLES.iter().map(|(name, text)| (format!("{name}.hry"), *text))
}

/// The example in a file `NAME.hry`: what it is about stands in the comment that it begins with.
#[must_use]
fn example_of(name: &str, text: &str, picture: Option<String>) -> Example {
    let comment = text.lines().take_while(|line| line.starts_with("--"));
    let comment: Vec<&str> = comment.map(|line| line.trim_start_matches('-').trim()).collect();
    let classic = Language::of(text) == Language::Classic;
    let about = match comment.join(" ") {
        about if !about.is_empty() => about,
        _ if classic => "A scene in the grammar of 2005.".to_owned(),
        about => about,
    };
    let mut title = name.replace('-', " ");
    if let Some(first) = title.get(..1).map(str::to_uppercase) {
        title.replace_range(..1, &first);
    }
    let time = !classic && text.lines().any(takes_time);
    Example { name: name.to_owned(), title, about, time, picture, text: text.to_owned() }
}

/// Whether a line defines the scene as a function.
fn takes_time(line: &str) -> bool {
    let Some(rest) = line.strip_prefix("scene ") else { return false };
    let parameter = rest.split('=').next().unwrap_or("").trim();
    !parameter.is_empty() && !parameter.starts_with(':')
}

#[cfg(test)]
mod tests {
    use super::example_of;

    #[test]
    fn an_example_is_described_by_its_first_comment() {
        let found = example_of("two-balls", "-- Two balls.\n-- In sun.\nscene t = {}\n", None);
        assert_eq!((&*found.title, &*found.about, found.time), ("Two balls", "Two balls. In sun.", true));
        let found = example_of("x", "scene = {}\n-- not this\n", None);
        assert_eq!((&*found.about, found.time), ("", false));
        let found = example_of("x", "renderDescr ( resolution (1,1) ) 1 []", None);
        assert_eq!((&*found.about, found.time), ("A scene in the grammar of 2005.", false));
    }
}
