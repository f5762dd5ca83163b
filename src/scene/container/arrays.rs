//! Named arrays in the layout of safetensors.

use std::collections::BTreeMap;
use std::fmt::Display;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::scene::description::{Reader, Strict};
use crate::scene::did_you_mean;

/// Bytes before the header, with its length.
const LENGTH: usize = 8;
/// Longest header, bytes.
const MOST_HEADER: usize = 1 << 22;
/// Bound of the size of a number, whose square is one of the machine.
const LARGEST: f64 = 1e150;
/// Key of the texts among the arrays.
const METADATA: &str = "__metadata__";
/// Names of arrays; the first part of a name with a dot may be another one.
const KNOWN: [&str; 16] = [
    "mass",
    "centre",
    "inertia",
    "eigenvalues",
    "inertia_1",
    "inertia_2",
    "coupling",
    "cubic",
    "NAME.position",
    "NAME.modes",
    "NAME.rotation",
    "NAME.second",
    "surface.points",
    "surface.modes",
    "surface.stress",
    "surface.triangles",
];

/// Message about an array.
pub(super) fn wrong(name: &str, wanted: &str, found: impl Display) -> String {
    format!("{name}: expected {wanted}, found {found}")
}

/// Reads a value of the header.
fn read<T: DeserializeOwned>(name: &str, value: Value) -> Result<T, String> {
    T::deserialize(Reader(value)).map_err(|error| {
        let dot = if error.path.is_empty() { "" } else { "." };
        format!("{name}{dot}{}: {}", error.path, error.message)
    })
}

/// Where an array is, as the header has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ArrayEntry {
    dtype: String,
    shape: Vec<usize>,
    data_offsets: [usize; 2],
}

/// Arrays of a file that have not been taken yet.
pub(super) struct Arrays<'a> {
    data: &'a [u8],
    entries: BTreeMap<String, ArrayEntry>,
    metadata: BTreeMap<String, String>,
}

impl<'a> Arrays<'a> {
    /// Reads the header of a file.
    ///
    /// # Errors
    /// No header, or arrays that overlap, leave gaps or are not in the file.
    pub fn new(bytes: &'a [u8]) -> Result<Self, String> {
        let (header, data) = split(bytes)?;
        let broken = |error: &dyn Display| format!("header: expected JSON: {error}");
        let text = std::str::from_utf8(header).map_err(|error| broken(&error))?;
        let header: Strict = serde_json::from_str(text).map_err(|error| broken(&error))?;
        let Value::Object(mut keys) = header.0 else {
            return Err(wrong("header", "an object { ... }", "something else"));
        };
        let metadata = match keys.remove(METADATA) {
            None => BTreeMap::new(),
            Some(texts) => read(METADATA, texts)?,
        };
        let entries = keys.into_iter().map(|(name, value)| {
            let entry = read(&name, value)?;
            Ok((name, entry))
        });
        let arrays = Self {
            data,
            entries: entries.collect::<Result<_, String>>()?,
            metadata,
        };
        arrays.check_places()?;
        Ok(arrays)
    }

    /// Texts about the file.
    pub fn metadata(&self) -> &BTreeMap<String, String> {
        &self.metadata
    }

    /// Iterates over the names of these arrays.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.keys().map(String::as_str)
    }

    /// Shape of an array.
    ///
    /// # Errors
    /// The array is missing.
    pub fn shape(&self, name: &str) -> Result<&[usize], String> {
        let entry = self.entries.get(name);
        let missing = || wrong(name, "an array of this name", "none");
        entry.map(|entry| &entry.shape[..]).ok_or_else(missing)
    }

    /// Takes an array of F64.
    ///
    /// # Errors
    /// The array is missing, has another type or shape, or numbers that are not finite or too large.
    pub fn numbers(&mut self, name: &str, shape: &[usize]) -> Result<Vec<f64>, String> {
        let numbers = self.take(name, "F64", shape, f64::from_le_bytes)?;
        check_finite(name, numbers.iter().copied())?;
        Ok(numbers)
    }

    /// Takes an array of F64 that may be missing.
    ///
    /// # Errors
    /// The array has another type or shape, or numbers that are not finite or too large.
    pub fn optional(&mut self, name: &str, shape: &[usize]) -> Result<Option<Vec<f64>>, String> {
        let is_there = self.entries.contains_key(name);
        is_there.then(|| self.numbers(name, shape)).transpose()
    }

    /// Takes an array of F32.
    ///
    /// # Errors
    /// The array is missing, has another type or shape, or numbers that are not finite or too large.
    pub fn singles(&mut self, name: &str, shape: &[usize]) -> Result<Vec<f32>, String> {
        let numbers = self.take(name, "F32", shape, f32::from_le_bytes)?;
        check_finite(name, numbers.iter().copied().map(f64::from))?;
        Ok(numbers)
    }

    /// Takes an array of U32.
    ///
    /// # Errors
    /// The array is missing, or has another type or shape.
    pub fn integers(&mut self, name: &str, shape: &[usize]) -> Result<Vec<u32>, String> {
        self.take(name, "U32", shape, u32::from_le_bytes)
    }

    /// Checks that every array was taken.
    ///
    /// # Errors
    /// An array that no reduced model has.
    pub fn finish(&self) -> Result<(), String> {
        let Some(name) = self.names().next() else {
            return Ok(());
        };
        let interface = name.split_once('.').map_or("NAME", |(first, _)| first);
        let known = KNOWN.map(|known| known.replace("NAME", interface));
        let meant = did_you_mean(name, known.iter().map(String::as_str));
        let wanted = format!("one of {} or stress.NAME", KNOWN.join(", "));
        Err(format!(
            "expected arrays named {wanted}, found {name:?}{meant}"
        ))
    }

    fn take<T, const BYTES: usize>(
        &mut self,
        name: &str,
        dtype: &str,
        shape: &[usize],
        read: fn([u8; BYTES]) -> T,
    ) -> Result<Vec<T>, String> {
        let found = self.shape(name)?;
        if found != shape {
            let wanted = format!("the shape {shape:?}");
            return Err(wrong(name, &wanted, format!("{found:?}")));
        }
        let entry = &self.entries[name];
        if entry.dtype != dtype {
            let wanted = format!("numbers of the type {dtype}");
            return Err(wrong(name, &wanted, format!("{:?}", entry.dtype)));
        }
        let [begin, end] = entry.data_offsets;
        let count = shape
            .iter()
            .try_fold(1, |product: usize, of| product.checked_mul(*of));
        let length = count.and_then(|count| count.checked_mul(BYTES));
        if length != Some(end - begin) {
            let wanted = format!("{BYTES} bytes for each number of the shape {shape:?}");
            return Err(wrong(name, &wanted, format!("{} in all", end - begin)));
        }
        self.entries.remove(name);
        let (chunks, _) = self.data[begin..end].as_chunks::<BYTES>();
        Ok(chunks.iter().map(|chunk| read(*chunk)).collect())
    }

    /// Checks that arrays fill the data, each byte once.
    fn check_places(&self) -> Result<(), String> {
        let mut places: Vec<([usize; 2], &str)> = (self.entries.iter())
            .map(|(name, entry)| (entry.data_offsets, name.as_str()))
            .collect();
        places.sort_unstable();
        let (mut filled, mut before) = (0, "the beginning");
        for ([begin, end], name) in places {
            let size = self.data.len();
            if begin > end || end > size {
                let wanted = format!("data_offsets [begin, end] up to {size}");
                return Err(wrong(name, &wanted, format!("[{begin}, {end}]")));
            }
            if begin != filled {
                let is = if begin < filled {
                    "overlaps"
                } else {
                    "leaves a gap to"
                };
                let wanted = format!("data that begins at {filled}");
                let found = format!("{begin}, which {is} {before}");
                return Err(wrong(name, &wanted, found));
            }
            (filled, before) = (end, name);
        }
        if filled != self.data.len() {
            let found = format!("{} more", self.data.len() - filled);
            return Err(wrong(
                "data",
                &format!("{filled} bytes, which the arrays have"),
                found,
            ));
        }
        Ok(())
    }
}

/// The header and the data of a file.
fn split(bytes: &[u8]) -> Result<(&[u8], &[u8]), String> {
    let wanted = "the length of the header in the first 8 bytes";
    let Some((length, rest)) = bytes.split_first_chunk::<LENGTH>() else {
        return Err(wrong("header", wanted, format!("{} bytes", bytes.len())));
    };
    let found = u64::from_le_bytes(*length);
    let most = rest.len().min(MOST_HEADER);
    match usize::try_from(found) {
        Ok(length) if length <= most => Ok(rest.split_at(length)),
        _ => {
            let wanted = format!("{wanted}, at most {most}");
            Err(wrong("header", &wanted, found))
        }
    }
}

fn check_finite(name: &str, mut numbers: impl Iterator<Item = f64>) -> Result<(), String> {
    let is_fit = |number: &f64| number.abs() < LARGEST;
    match numbers.find(|number| !is_fit(number)) {
        Some(found) => Err(wrong(
            name,
            &format!("numbers of a size below {LARGEST:e}"),
            found,
        )),
        None => Ok(()),
    }
}
