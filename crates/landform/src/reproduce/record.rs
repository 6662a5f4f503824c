//! What seeds of figures came to, kept in the output folder so that work that was ended goes on.

use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use landform_io::{IfExists, write_atomically};
use serde::{Deserialize, Serialize};

use super::catalogue::Entry;
use super::measure::SeedNumbers;

/// Name of the file.
const FILE: &str = "done.json";

/// Seeds that are done, in the order in which they were.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Version of the program.
    version: String,
    done: Vec<Done>,
}

/// A seed of a figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Done {
    name: String,
    seed: u64,
    /// What the numbers follow from: texts that have changed are run again.
    text: String,
    /// The bits of the numbers: JSON knows no infinity.
    values: Vec<Option<u64>>,
    pictures: Vec<(String, Vec<PathBuf>)>,
}

impl Record {
    /// Nothing is done.
    #[must_use]
    pub fn new() -> Self {
        Self { version: env!("CARGO_PKG_VERSION").to_owned(), done: Vec::new() }
    }

    /// What is done in an output folder; nothing if another version of the program did it.
    ///
    /// # Errors
    /// A message: a file that cannot be read, or is none of these.
    pub fn read(output: &Path) -> Result<Self, String> {
        let path = output.join(FILE);
        let text = match std::fs::read_to_string(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Self::new()),
            Err(error) => return Err(format!("cannot read {}: {error}", path.display())),
            Ok(text) => text,
        };
        let found: Self = serde_json::from_str(&text)
            .map_err(|error| format!("{}: {error}; remove it to begin anew", path.display()))?;
        Ok(if found.version == Self::new().version { found } else { Self::new() })
    }

    /// Writes it into an output folder.
    ///
    /// # Errors
    /// A message that names the file.
    pub(super) fn write(&self, output: &Path) -> Result<(), String> {
        let text = serde_json::to_string(self).map_err(|error| error.to_string())?;
        write_atomically(&output.join(FILE), IfExists::Replace, |file| {
            file.write_all(text.as_bytes())
        })
        .map_err(|error| error.to_string())
    }

    /// What a seed came to, if it is done.
    pub(super) fn find(&self, entry: &Entry, seed: u64) -> Option<SeedNumbers> {
        let is_this =
            |done: &&Done| done.name == entry.name && done.seed == seed && done.text == entry.text;
        let done = self.done.iter().find(is_this)?;
        let values = done.values.iter().map(|bits| bits.map(f64::from_bits)).collect();
        Some(SeedNumbers { values, pictures: done.pictures.clone() })
    }

    /// Keeps what a seed came to, in place of what it was with other texts.
    pub(super) fn keep(&mut self, entry: &Entry, seed: u64, numbers: SeedNumbers) {
        self.done.retain(|done| done.name != entry.name || done.seed != seed);
        self.done.push(Done {
            name: entry.name.clone(),
            seed,
            text: entry.text.clone(),
            values: numbers.values.iter().map(|value| value.map(f64::to_bits)).collect(),
            pictures: numbers.pictures,
        });
    }
}
