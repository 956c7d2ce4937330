//! The values of options, from text.

use clap::builder::{PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, Error};
use hray::{MAX_DEPTH, MAX_SAMPLES, MIN_DEPTH, PictureFormat, Resolution};
use std::ffi::OsStr;
use std::num::{NonZeroU32, NonZeroUsize};

/// More threads than this are refused: no machine of today runs as many at once.
const MAX_THREADS: usize = 1024;

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
    fn numbers_in_their_ranges() {
        assert_eq!((depth("-1"), depth("10000")), (Ok(-1), Ok(10_000)));
        assert!(depth("-2").is_err() && depth("10001").is_err() && depth("1.5").is_err());
        assert!(samples("65536").is_ok() && samples("0").is_err() && samples("65537").is_err());
        assert!(threads("1024").is_ok() && threads("0").is_err() && threads("1025").is_err());
    }
}
