//! The values of options, from text.

use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, Error};
use hray::{MAX_DEPTH, MAX_FPS, MAX_SAMPLES, MIN_DEPTH, MIN_FPS, PictureFormat, Resolution};
use std::ffi::OsStr;
use std::num::{NonZeroU32, NonZeroUsize};

/// More threads than this are refused: no machine of today runs as many at once.
const MAX_THREADS: usize = 1024;
/// More calls inside calls than this are refused: each takes a kilobyte or so.
const MAX_EVAL_DEPTH: u32 = 1_000_000;

/// A recursion depth in its range.
pub(crate) type Depth = i32;

/// `640x480`.
pub(crate) fn size(text: &str) -> Result<Resolution, String> {
    let sides = text.split_once(['x', 'X']);
    match sides.map(|(width, height)| (width.parse::<i64>(), height.parse::<i64>())) {
        Some((Ok(width), Ok(height))) => Resolution::new(width, height).map_err(|error| error.to_string()),
        _ => Err("a size is two whole numbers of pixels, such as 640x480".to_owned()),
    }
}

/// `-1` to `10000`.
pub(crate) fn depth(text: &str) -> Result<Depth, String> {
    let depth = text.parse().ok().filter(|depth| (MIN_DEPTH..=MAX_DEPTH).contains(depth));
    depth.ok_or_else(|| format!("a depth is a whole number from {MIN_DEPTH} to {MAX_DEPTH}"))
}

/// A column or a row of a picture.
pub(crate) fn coordinate(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| "a pixel's place is a whole number, counted from 0".to_owned())
}

/// `1` to `65536`.
pub(crate) fn samples(text: &str) -> Result<NonZeroU32, String> {
    let samples = text.parse().ok().filter(|samples: &NonZeroU32| samples.get() <= MAX_SAMPLES);
    samples.ok_or_else(|| format!("a number of samples goes from 1 to {MAX_SAMPLES}"))
}

/// `1` to `1024`.
pub(crate) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    let threads = text.parse().ok().filter(|threads: &NonZeroUsize| threads.get() <= MAX_THREADS);
    threads.ok_or_else(|| format!("a number of threads goes from 1 to {MAX_THREADS}"))
}

/// `10,20,300,200`.
pub(crate) fn region(text: &str) -> Result<[u32; 4], String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| {
        "a region is four whole numbers of pixels: left, top, width, height, such as 10,20,300,200".to_owned()
    })
}

/// `NAME=VALUE`.
pub(crate) fn setting(text: &str) -> Result<(String, String), String> {
    let wrong =
        || "a setting is the name of a definition, `=` and an expression, such as count=12".to_owned();
    let (name, value) = text.split_once('=').ok_or_else(wrong)?;
    let (name, value) = (name.trim(), value.trim());
    let letter = |c: char| c.is_alphabetic() || c == '_';
    let is_name = name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_numeric() || c == '\'');
    if is_name && !value.is_empty() { Ok((name.to_owned(), value.to_owned())) } else { Err(wrong()) }
}

/// A moment: any number of seconds.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let seconds = text.parse().ok().filter(|seconds: &f64| seconds.is_finite());
    seconds.ok_or_else(|| "a time is a number of seconds, such as 1.5".to_owned())
}

/// Frames a second.
pub(crate) fn fps(text: &str) -> Result<f64, String> {
    let fps = text.parse().ok().filter(|fps| (MIN_FPS..=MAX_FPS).contains(fps));
    fps.ok_or_else(|| format!("a number of frames a second goes from 1/60 (0.01667) to {MAX_FPS}"))
}

/// The number of a frame.
pub(crate) fn frame(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("a frame is a whole number from 0 to {}", u32::MAX))
}

/// `A..B`, both included.
pub(crate) fn frames(text: &str) -> Result<Frames, String> {
    let ends = text.split_once("..").map(|(first, last)| (first.trim().parse(), last.trim().parse()));
    match ends {
        Some((Ok(first), Ok(last))) if first <= last && last < u32::MAX => Ok(Frames { first, last }),
        Some((Ok(first), Ok(last))) if first > last => {
            Err(format!("frames go from the first to the last: {last}..{first}"))
        }
        _ => Err("frames are the first and the last of them, such as 0..47 for 48".to_owned()),
    }
}

/// Frames of an animation, the first and the last included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Frames {
    pub first: u32,
    pub last: u32,
}

impl Frames {
    /// How many they are; never none.
    pub(crate) const fn count(self) -> u32 {
        self.last - self.first + 1
    }
}

/// A budget of steps.
pub(crate) fn steps(text: &str) -> Result<u64, String> {
    budget(text, u64::MAX / 2)
}

/// A budget of calls inside calls.
pub(crate) fn eval_depth(text: &str) -> Result<u32, String> {
    budget(text, u64::from(MAX_EVAL_DEPTH)).map(|depth| u32::try_from(depth).unwrap_or(MAX_EVAL_DEPTH))
}

/// A budget of elements.
pub(crate) fn list(text: &str) -> Result<usize, String> {
    budget(text, 1 << 40).map(|list| usize::try_from(list).unwrap_or(usize::MAX))
}

/// A budget of memory in MiB.
pub(crate) fn memory(text: &str) -> Result<u64, String> {
    budget(text, 1 << 24)
}

/// A budget of operations.
pub(crate) fn nodes(text: &str) -> Result<usize, String> {
    budget(text, u64::from(u32::MAX / 2)).map(|nodes| usize::try_from(nodes).unwrap_or(usize::MAX))
}

fn budget(text: &str, most: u64) -> Result<u64, String> {
    // As numbers are written in scenes.
    let digits = text.replace('_', "");
    let number = digits.parse().ok().filter(|number| (1..=most).contains(number));
    number.ok_or_else(|| format!("a budget is a whole number from 1 to {most}"))
}

/// The name of a format. A parser of its own, so that help and completions know the names.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FormatParser;

impl TypedValueParser for FormatParser {
    type Value = PictureFormat;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<PictureFormat, Error> {
        value.to_str().and_then(PictureFormat::from_name).ok_or_else(|| {
            let mut error = Error::new(ErrorKind::InvalidValue).with_cmd(command);
            if let Some(arg) = arg {
                error.insert(ContextKind::InvalidArg, ContextValue::String(arg.to_string()));
            }
            let value = value.to_string_lossy().into_owned();
            error.insert(ContextKind::InvalidValue, ContextValue::String(value));
            let names = PictureFormat::ALL.map(|format| format.name().to_owned()).to_vec();
            error.insert(ContextKind::ValidValue, ContextValue::Strings(names));
            error
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let values = PictureFormat::ALL.into_iter();
        Some(Box::new(values.map(|format| PossibleValue::new(format.name()).help(format.description()))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes() {
        assert_eq!(size("640x480"), Ok(Resolution::new(640, 480).unwrap()));
        assert!(size("640").unwrap_err().contains("640x480"));
        assert!(size("0x480").unwrap_err().contains("no pixels"));
        assert!(size("2000000000x2000000000").unwrap_err().contains("too large"));
        assert!(size("99999999999999999999x1").is_err() && size("1x-1").is_err() && size("x").is_err());
    }

    #[test]
    fn regions() {
        assert_eq!(region("1, 2,3,4"), Ok([1, 2, 3, 4]));
        for wrong in ["", "1,2,3", "1,2,3,4,5", "-1,2,3,4", "a,b,c,d", "1,2,3,4294967296"] {
            assert!(region(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn settings() {
        assert_eq!(setting("count = 12 + 1"), Ok(("count".to_owned(), "12 + 1".to_owned())));
        assert_eq!(setting("a'=x == 1"), Ok(("a'".to_owned(), "x == 1".to_owned())));
        for wrong in ["", "=", "count", "count=", "=3", "2x=3", "a b=3", "a.b=3"] {
            assert!(setting(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn frames_and_times() {
        assert_eq!(frames("0..47"), Ok(Frames { first: 0, last: 47 }));
        assert_eq!(frames("7 .. 7").map(Frames::count), Ok(1));
        assert_eq!(frames("5..2").unwrap_err(), "frames go from the first to the last: 2..5");
        for wrong in ["", "..", "1", "1..", "-1..3", "0...3", "0..4294967295", "a..b"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
        assert_eq!((seconds("-1.5"), seconds("1e3")), (Ok(-1.5), Ok(1000.0)));
        assert!(seconds("inf").is_err() && seconds("NaN").is_err() && seconds("1s").is_err());
        assert!(fps("24").is_ok() && fps("0.5").is_ok() && fps("0").is_err() && fps("1001").is_err());
    }

    #[test]
    fn budgets() {
        assert_eq!((steps("1_000_000"), memory("512")), (Ok(1_000_000), Ok(512)));
        assert!(steps("0").is_err() && steps("-1").is_err() && eval_depth("1000001").is_err());
    }

    #[test]
    fn numbers_in_their_ranges() {
        assert_eq!((depth("-1"), depth("10000")), (Ok(-1), Ok(10_000)));
        assert!(depth("-2").is_err() && depth("10001").is_err() && depth("1.5").is_err());
        assert!(samples("65536").is_ok() && samples("0").is_err() && samples("65537").is_err());
        assert!(threads("1024").is_ok() && threads("0").is_err() && threads("1025").is_err());
    }
}
