//! The few characters of a source that a diagnostic needs to show.
//!
//! A source may be hundreds of megabytes on one line. What is handed to the layout is an excerpt: the lines
//! that carry a label, of a long line only the surroundings of its labels.

use super::Span;
use super::locate::Locations;
use std::borrow::Cow;
use std::ops::Range;

/// A line up to this many bytes is shown whole.
const SHORT_LINE: usize = 140;
/// How many bytes around a label are shown of a longer line.
const SURROUNDINGS: usize = 48;
/// The longest underline, in bytes.
const LONGEST_LABEL: usize = 100;
/// Lines between two labels are part of the excerpt where they are at most this many bytes.
const NEAR: usize = 4_000;
/// What stands for text that is left out.
const ELISION: &str = "...";

/// Consecutive lines of a source, long ones shortened.
pub(crate) struct Excerpt {
    /// The number of its first line.
    pub(crate) line: usize,
    /// The lines, each ended by a newline.
    pub(crate) text: String,
    /// The labels on it: the index of each, and its bytes in `text`.
    pub(crate) labels: Vec<(usize, Range<usize>)>,
}

/// The excerpts that show `spans` (which fit the source), in the order of the source.
pub(crate) fn excerpts(source: &str, locations: &Locations, spans: &[Span]) -> Vec<Excerpt> {
    let mut order: Vec<usize> = (0..spans.len()).collect();
    order.sort_by_key(|index| spans.get(*index));
    let mut excerpts: Vec<Excerpt> = Vec::new();
    let mut end = 0;
    for labels in order.chunk_by(|a, b| line_of(locations, spans, *a) == line_of(locations, spans, *b)) {
        let [first, ..] = labels else { continue };
        let place = locations.get(start_of(spans, *first));
        let labels: Vec<(usize, Span)> =
            labels.iter().filter_map(|index| spans.get(*index).map(|span| (*index, *span))).collect();
        let line = Line::new(source, place.line_start, &labels);
        match excerpts.last_mut() {
            Some(open) if place.line_start.saturating_sub(end) <= NEAR => {
                open.push_between(source.get(end..place.line_start).unwrap_or_default());
                open.push_line(source, &line, &labels);
            }
            _ => {
                let mut open = Excerpt { line: place.line, text: String::new(), labels: Vec::new() };
                open.push_line(source, &line, &labels);
                excerpts.push(open);
            }
        }
        end = line.end;
    }
    excerpts
}

fn start_of(spans: &[Span], index: usize) -> usize {
    spans.get(index).map_or(0, |span| span.start)
}

fn line_of(locations: &Locations, spans: &[Span], index: usize) -> usize {
    locations.get(start_of(spans, index)).line
}

impl Excerpt {
    /// Adds the lines between two labelled lines; `between` begins with the rest of the first.
    fn push_between(&mut self, between: &str) {
        let Some((_, lines)) = between.split_once('\n') else { return };
        for line in lines.split_terminator('\n') {
            let shown = line.get(..floor(line, SHORT_LINE)).unwrap_or_default();
            self.text.push_str(&printable(shown.trim_end()));
            self.text.push('\n');
        }
    }

    fn push_line(&mut self, source: &str, line: &Line, labels: &[(usize, Span)]) {
        let mut labels = labels.iter().peekable();
        for (i, window) in line.windows.iter().enumerate() {
            if window.start > line.start {
                self.text.push_str(ELISION);
            }
            let shown = self.text.len();
            let place = |offset: usize| {
                let before = Span::new(window.start, offset.clamp(window.start, window.end));
                shown + printable(before.text(source)).len()
            };
            let next = line.windows.get(i + 1).map_or(usize::MAX, |next| next.start);
            while let Some((index, span)) = labels.next_if(|(_, span)| span.start < next) {
                self.labels.push((*index, place(span.start)..place(shown_end(source, *span))));
            }
            self.text.push_str(&printable(window.text(source)));
        }
        if line.windows.last().is_some_and(|window| window.end < line.end) {
            self.text.push_str(ELISION);
        }
        self.text.push('\n');
    }
}

/// Where the underline of a span ends.
fn shown_end(source: &str, span: Span) -> usize {
    span.end.min(floor(source, span.start + LONGEST_LABEL))
}

/// What is shown of one line.
struct Line {
    start: usize,
    /// Its end, or a place beyond everything that is shown.
    end: usize,
    /// The parts that are shown, in order and apart.
    windows: Vec<Span>,
}

impl Line {
    /// `labels` are on one line, in order.
    fn new(source: &str, start: usize, labels: &[(usize, Span)]) -> Self {
        let last = labels.iter().map(|(_, span)| span.start).max().unwrap_or(start);
        let far = floor(source, last + LONGEST_LABEL + 2 * SHORT_LINE);
        let rest = source.get(last..far).unwrap_or_default();
        let end = rest.find('\n').map_or(far, |length| last + length);
        let ends_here = end < far || far == source.len();
        let end = if source.get(start..end).is_some_and(|text| text.ends_with('\r')) { end - 1 } else { end };
        let end = end.max(start);
        if ends_here && end - start <= SHORT_LINE {
            return Self { start, end, windows: vec![Span::new(start, end)] };
        }
        let mut windows: Vec<Span> = Vec::new();
        for (_, span) in labels {
            let from = floor(source, span.start.saturating_sub(SURROUNDINGS)).max(start);
            let to = floor(source, shown_end(source, *span) + SURROUNDINGS).clamp(from, end.max(from));
            match windows.last_mut() {
                Some(window) if from <= window.end + ELISION.len() => window.end = window.end.max(to),
                _ => windows.push(Span::new(from, to)),
            }
        }
        Self { start, end, windows }
    }
}

/// Text without the control characters that the layout lets through: those of ISO 6429, such as U+009B.
fn printable(text: &str) -> Cow<'_, str> {
    let is_control = |c: char| ('\u{80}'..='\u{9f}').contains(&c);
    if text.contains(is_control) {
        Cow::Owned(text.replace(is_control, "\u{fffd}"))
    } else {
        Cow::Borrowed(text)
    }
}

/// The last character boundary that is not after `offset`.
fn floor(text: &str, offset: usize) -> usize {
    text.floor_char_boundary(offset)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn show(source: &str, spans: &[Span]) -> Vec<(usize, String, Vec<String>)> {
        let locations = Locations::new(source, spans.iter().map(|span| span.start).collect());
        let texts = |e: Excerpt| {
            let labels = e.labels.iter().map(|(_, range)| e.text[range.clone()].to_string()).collect();
            (e.line, e.text, labels)
        };
        excerpts(source, &locations, spans).into_iter().map(texts).collect()
    }

    #[test]
    fn a_short_line_is_shown_whole_without_its_line_end() {
        let shown = show("one\r\ntwo three\r\nfour", &[Span::new(9, 14)]);
        assert_eq!(shown, [(2, "two three\n".into(), vec!["three".into()])]);
    }

    #[test]
    fn of_a_long_line_the_surroundings_of_each_label_are_shown() {
        let source = format!("{}here{}there{}", "a".repeat(5000), "b".repeat(5000), "c".repeat(5000));
        let [shown] = &show(&source, &[Span::new(5000, 5004), Span::new(10_004, 10_009)])[..] else {
            panic!()
        };
        assert!(shown.1.len() < 300, "{}", shown.1);
        assert_eq!(shown.2, ["here", "there"]);
        assert!(shown.1.starts_with("...a") && shown.1.ends_with("c...\n"), "{}", shown.1);
    }

    #[test]
    fn near_lines_share_an_excerpt_and_far_ones_do_not() {
        let source = format!("{{\n1\n2\n}}{}\nx", "\n".repeat(NEAR + 10));
        let x = source.len() - 1;
        let shown = show(&source, &[Span::new(6, 7), Span::new(0, 1), Span::new(x, x + 1)]);
        assert_eq!(shown.len(), 2);
        assert_eq!(shown[0], (1, "{\n1\n2\n}\n".into(), vec!["{".into(), "}".into()]));
        assert_eq!(shown[1].2, ["x"]);
    }

    #[test]
    fn the_end_of_a_file_and_an_empty_file_can_be_shown() {
        assert_eq!(show("", &[Span::at(0)]), [(1, "\n".into(), vec![String::new()])]);
        assert_eq!(show("ab\n", &[Span::at(3)]), [(2, "\n".into(), vec![String::new()])]);
        assert_eq!(show("ab", &[Span::at(2)]), [(1, "ab\n".into(), vec![String::new()])]);
    }
}
