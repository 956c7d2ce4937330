//! Noise tables as JSON.
//!
//! One object with four keys: `permutation`, `permutation2` and `permutation3`, each the numbers 0 to 255 in
//! some order, and `gradients`, 256 vectors of three numbers. What each serves for is said at
//! [`hray_core::NoiseTables`].

use crate::source::{open, read_bounded};
use crate::{InputError, Quoted};
use hray_core::{NoiseTables, NoiseTablesError};
use serde::Deserializer;
use serde::de::{DeserializeSeed, Error as _, IgnoredAny, MapAccess, SeqAccess, Unexpected, Visitor};
use std::fmt;
use std::path::{Path, PathBuf};

/// The longest file of noise tables that is read: 1 MiB, fifty times what one needs.
pub const MAX_NOISE_TABLES_BYTES: u64 = 1 << 20;

/// The keys, in the order of [`Parts`].
const KEYS: [&str; 4] = ["permutation", "permutation2", "permutation3", "gradients"];

/// Why there are no noise tables.
#[derive(Debug)]
#[non_exhaustive]
pub enum TablesError {
    /// The file could not be read.
    Input(InputError),
    /// The file is not JSON of the expected form.
    Form {
        /// The path as it was given.
        path: PathBuf,
        /// Line and column, both from 1, of what is wrong.
        place: (usize, usize),
        /// What is wrong.
        message: String,
    },
    /// The file is of the expected form, but its numbers cannot serve.
    Content {
        /// The path as it was given.
        path: PathBuf,
        /// What is wrong.
        error: NoiseTablesError,
    },
}

impl fmt::Display for TablesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Input(error) => write!(f, "{error} (noise tables)"),
            Self::Form { path, place: (line, column), message } => {
                write!(
                    f,
                    "the noise tables {} cannot be used: line {line}, column {column}: {message}",
                    Quoted(path)
                )
            }
            Self::Content { path, error: NoiseTablesError::Repeated { table, value } } if *table < 3 => {
                write!(
                    f,
                    "the noise tables {} cannot be used: `{}` holds the value {value} twice; it must hold each of \
                     0 to 255 once",
                    Quoted(path),
                    KEYS[*table]
                )
            }
            Self::Content { path, error } => {
                write!(f, "the noise tables {} cannot be used: {error}", Quoted(path))
            }
        }
    }
}

impl std::error::Error for TablesError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Input(error) => Some(error),
            Self::Content { error, .. } => Some(error),
            Self::Form { .. } => None,
        }
    }
}

/// Reads noise tables from a file, [`MAX_NOISE_TABLES_BYTES`] at most.
///
/// # Errors
/// [`TablesError`] where the file cannot be read or does not hold what it must.
pub fn read_noise_tables(path: &Path) -> Result<NoiseTables, TablesError> {
    let limit = MAX_NOISE_TABLES_BYTES;
    let bytes =
        open(path, limit).and_then(|file| read_bounded(file, path, limit)).map_err(TablesError::Input)?;
    parse_noise_tables(&bytes, path)
}

/// Makes noise tables of JSON text, which is called `name` in messages.
///
/// # Errors
/// [`TablesError`] where the text does not hold what it must.
pub fn parse_noise_tables(json: &[u8], name: &Path) -> Result<NoiseTables, TablesError> {
    if json.trim_ascii().is_empty() {
        return Err(TablesError::Form {
            path: name.to_owned(),
            place: (1, 1),
            message: format!("the file is empty; expected an object with the keys {}", KEYS.join(", ")),
        });
    }
    let mut deserializer = serde_json::Deserializer::from_slice(json);
    let (permutations, gradients) = deserializer
        .deserialize_map(TablesVisitor)
        .and_then(|parts| deserializer.end().map(|()| parts))
        .map_err(|error| TablesError::Form {
            path: name.to_owned(),
            place: (error.line(), error.column()),
            message: without_place(&error),
        })?;
    NoiseTables::new(permutations, gradients)
        .map_err(|error| TablesError::Content { path: name.to_owned(), error })
}

/// The crate's message without the place at its end, which is said before it.
fn without_place(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let end = text.rfind(" at line ").unwrap_or(text.len());
    // It may quote a string of any length.
    text[..end].chars().take(200).collect()
}

type Parts = ([[u8; 256]; 3], [[f64; 3]; 256]);

struct TablesVisitor;

impl<'de> Visitor<'de> for TablesVisitor {
    type Value = Parts;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "an object with the keys {}", KEYS.join(", "))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Parts, A::Error> {
        let mut permutations = [None; 3];
        let mut gradients = None;
        while let Some(key) = map.next_key::<String>()? {
            let Some(index) = KEYS.iter().position(|known| *known == key) else {
                let key: String = key.chars().take(40).flat_map(char::escape_debug).collect();
                return Err(A::Error::custom(format_args!(
                    "unknown key `{key}`; known are {}",
                    KEYS.join(", ")
                )));
            };
            let twice = || A::Error::custom(format_args!("`{}` is given twice", KEYS[index]));
            if let Some(permutation) = permutations.get_mut(index) {
                let value = map.next_value_seed(Table { key: KEYS[index], entry: Byte })?;
                if permutation.replace(value).is_some() {
                    return Err(twice());
                }
            } else if gradients.replace(map.next_value_seed(Table { key: KEYS[3], entry: Vector })?).is_some()
            {
                return Err(twice());
            }
        }
        let missing = |key: &str| A::Error::custom(format_args!("the key `{key}` is missing"));
        let [Some(first), Some(second), Some(third)] = permutations else {
            let index = permutations.iter().position(Option::is_none).unwrap_or(0);
            return Err(missing(KEYS[index]));
        };
        Ok(([first, second, third], gradients.ok_or_else(|| missing(KEYS[3]))?))
    }
}

/// A table of 256 entries.
struct Table<E> {
    key: &'static str,
    entry: E,
}

impl<'de, E: DeserializeSeed<'de, Value: Copy + Default> + Copy> DeserializeSeed<'de> for Table<E> {
    type Value = [E::Value; 256];

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de, E: DeserializeSeed<'de, Value: Copy + Default> + Copy> Visitor<'de> for Table<E> {
    type Value = [E::Value; 256];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of 256 entries for `{}`", self.key)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut table = [E::Value::default(); 256];
        for (n, place) in table.iter_mut().enumerate() {
            *place = list.next_element_seed(self.entry)?.ok_or_else(|| {
                A::Error::custom(format_args!("`{}` has {n} entries; it must have 256", self.key))
            })?;
        }
        match list.next_element::<IgnoredAny>()? {
            None => Ok(table),
            Some(_) => Err(A::Error::custom(format_args!(
                "`{}` has more than 256 entries; it must have 256",
                self.key
            ))),
        }
    }
}

/// An entry of a permutation.
#[derive(Clone, Copy)]
struct Byte;

impl<'de> DeserializeSeed<'de> for Byte {
    type Value = u8;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<u8, D::Error> {
        deserializer.deserialize_u8(self)
    }
}

impl Visitor<'_> for Byte {
    type Value = u8;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a whole number from 0 to 255")
    }

    fn visit_u64<E: serde::de::Error>(self, value: u64) -> Result<u8, E> {
        u8::try_from(value).map_err(|_| E::invalid_value(Unexpected::Unsigned(value), &self))
    }
}

/// A gradient.
#[derive(Clone, Copy)]
struct Vector;

impl<'de> DeserializeSeed<'de> for Vector {
    type Value = [f64; 3];

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<[f64; 3], D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for Vector {
    type Value = [f64; 3];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of three numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<[f64; 3], A::Error> {
        let mut vector = [0.0; 3];
        for (n, component) in vector.iter_mut().enumerate() {
            *component = list.next_element()?.ok_or_else(|| A::Error::invalid_length(n, &self))?;
        }
        match list.next_element::<IgnoredAny>()? {
            None => Ok(vector),
            Some(_) => Err(A::Error::custom("a gradient of more than three numbers")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn json(tables: &NoiseTables) -> serde_json::Value {
        let [first, second, third] = tables.permutations().map(|p| p.to_vec());
        let gradients: Vec<Vec<f64>> = tables.gradients().iter().map(|g| g.to_vec()).collect();
        serde_json::json!({
            "permutation": first, "permutation2": second, "permutation3": third, "gradients": gradients,
        })
    }

    fn parse(value: &serde_json::Value) -> Result<NoiseTables, TablesError> {
        parse_noise_tables(value.to_string().as_bytes(), Path::new("t.json"))
    }

    fn message(value: &serde_json::Value) -> String {
        let text = parse(value).unwrap_err().to_string();
        assert!(text.starts_with("the noise tables `t.json` cannot be used: "), "{text}");
        text
    }

    #[test]
    fn what_is_written_is_read_to_the_bit() {
        for seed in 0..20 {
            let tables = NoiseTables::generate(seed);
            assert_eq!(parse(&json(&tables)).unwrap(), tables);
        }
    }

    #[test]
    fn what_is_wrong_is_explained() {
        let good = json(&NoiseTables::default());
        let with = |change: &dyn Fn(&mut serde_json::Value)| {
            let mut value = good.clone();
            change(&mut value);
            message(&value)
        };
        let short = with(&|v| {
            v["permutation2"].as_array_mut().unwrap().pop();
        });
        assert!(short.contains("`permutation2` has 255 entries; it must have 256"), "{short}");
        assert!(short.contains("line 1, column "), "{short}");
        let long = with(&|v| v["gradients"].as_array_mut().unwrap().push(serde_json::json!([0, 0, 1])));
        assert!(long.contains("`gradients` has more than 256 entries"), "{long}");
        let large = with(&|v| v["permutation"][7] = 256.into());
        assert!(large.contains("integer `256`, expected a whole number from 0 to 255"), "{large}");
        let text = with(&|v| v["permutation"] = "abc".into());
        assert!(text.contains("expected a list of 256 entries for `permutation`"), "{text}");
        let flat = with(&|v| v["gradients"][3] = serde_json::json!([1.0, 0.5]));
        assert!(flat.contains("expected a list of three numbers"), "{flat}");
        let unknown = with(&|v| v["perm\n"] = 1.into());
        assert!(unknown.contains("unknown key `perm\\n`; known are permutation, "), "{unknown}");
        let missing = with(&|v| {
            v.as_object_mut().unwrap().remove("permutation3");
        });
        assert!(missing.contains("the key `permutation3` is missing"), "{missing}");
        let twice = with(&|v| v["permutation"][0] = v["permutation"][1].clone());
        assert!(
            twice.contains("`permutation` holds the value ")
                && twice.contains("twice; it must hold each of 0 to 255 once"),
            "{twice}"
        );
        assert!(
            message(&serde_json::json!([1, 2])).contains("expected an object with the keys permutation, ")
        );
    }

    #[test]
    fn syntax_errors_have_their_place() {
        let error = parse_noise_tables(b"{\n  \"permutation\": [1, 2,\n x", Path::new("t.json")).unwrap_err();
        assert!(error.to_string().contains("line 3, column 2: "), "{error}");
        let empty = parse_noise_tables(b" \n", Path::new("t.json")).unwrap_err().to_string();
        assert!(
            empty.contains("the file is empty; expected an object with the keys permutation, "),
            "{empty}"
        );
        let brackets = "[".repeat(1 << 20);
        assert!(parse_noise_tables(brackets.as_bytes(), Path::new("t.json")).is_err());
    }

    proptest! {
        #[test]
        fn no_text_panics(text in prop::collection::vec(any::<u8>(), 0..200)) {
            let _ = parse_noise_tables(&text, Path::new("t.json"));
        }
    }
}
