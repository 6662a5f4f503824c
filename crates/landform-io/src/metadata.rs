//! What a raster means: its field, unit, spacing and seed, carried by every file.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::atomic::{IfExists, write_atomically};
use crate::files::text_beside;
use crate::{Fault, Georeference, IoError};

/// What the values of a raster are and where they come from.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Metadata {
    /// Title of the run or of the survey.
    pub title: Option<String>,
    /// Name of the field: `height`, `sand`.
    pub field: Option<String>,
    /// Unit of the values: `m`, `m3/s`.
    pub unit: Option<String>,
    /// Distance between nodes in metres.
    pub spacing_m: Option<f64>,
    /// Seed of the run.
    pub seed: Option<u64>,
    /// Whatever else belongs to it: version, scenario, iteration.
    pub notes: BTreeMap<String, String>,
}

/// How stored numbers become values: `value = offset + scale * stored`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Encoding {
    /// Value of one step of the stored number.
    pub scale: f64,
    /// Value of the stored number 0.
    pub offset: f64,
    /// The stored number that marks missing cells.
    pub no_data: Option<f64>,
}

impl Default for Encoding {
    /// Stored numbers are the values.
    fn default() -> Self {
        Self { scale: 1.0, offset: 0.0, no_data: None }
    }
}

/// The file `NAME.EXT.json` beside a file whose format has no room for metadata.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sidecar {
    /// Columns, rows (and layers), as the data file has them.
    pub size: Vec<usize>,
    /// Sample type as NumPy writes it: `<f8`.
    pub sample: String,
    /// What the values are.
    pub metadata: Metadata,
    /// How stored numbers become values.
    pub encoding: Encoding,
    /// Where the raster lies.
    pub georeference: Option<Georeference>,
}

impl Encoding {
    /// Turns stored numbers into values, and the no-data number into NaN.
    pub fn decode(&self, numbers: &mut [f64]) {
        let mark = self.no_data.unwrap_or(f64::NAN);
        if !mark.is_nan() {
            for number in numbers.iter_mut().filter(|number| **number == mark) {
                *number = f64::NAN;
            }
        }
        if self.scale != 1.0 || self.offset != 0.0 {
            for number in numbers {
                *number = self.offset + self.scale * *number;
            }
        }
    }
}

impl Metadata {
    /// The entries that are set, as pairs of name and text, in a fixed order.
    pub fn entries(&self) -> Vec<(String, String)> {
        let own = [
            ("title", self.title.clone()),
            ("field", self.field.clone()),
            ("unit", self.unit.clone()),
            ("spacing_m", self.spacing_m.map(|spacing| spacing.to_string())),
            ("seed", self.seed.map(|seed| seed.to_string())),
        ];
        let own = own.into_iter().filter_map(|(name, text)| Some((name.to_string(), text?)));
        own.chain(self.notes.clone()).collect()
    }

    /// The metadata whose [`entries`](Self::entries) these are. Numbers that cannot be read
    /// stay with the notes, so that nothing is lost.
    pub fn from_entries(entries: impl IntoIterator<Item = (String, String)>) -> Self {
        let mut metadata = Self::default();
        for (name, text) in entries {
            match (name.as_str(), text.parse::<f64>(), text.parse::<u64>()) {
                ("title", _, _) => metadata.title = Some(text),
                ("field", _, _) => metadata.field = Some(text),
                ("unit", _, _) => metadata.unit = Some(text),
                ("spacing_m", Ok(spacing), _) => metadata.spacing_m = Some(spacing),
                ("seed", _, Ok(seed)) => metadata.seed = Some(seed),
                _ => drop(metadata.notes.insert(name, text)),
            }
        }
        metadata
    }
}

impl Sidecar {
    /// The name of the sidecar of `path`: the whole name with `.json` appended.
    pub fn path_of(path: &Path) -> PathBuf {
        let mut name = path.file_name().unwrap_or_default().to_os_string();
        name.push(".json");
        path.with_file_name(name)
    }

    /// Writes the data of `path` by `data`, and its sidecar. An older sidecar goes first, so
    /// that data never stand beside the description of other data.
    ///
    /// # Errors
    /// As [`write_atomically`].
    pub fn write_with(
        &self,
        path: &Path,
        if_exists: IfExists,
        data: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), IoError> {
        let sidecar = Self::path_of(path);
        write_atomically(path, if_exists, |writer| {
            data(writer)?;
            match fs::remove_file(&sidecar) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
                _ => Ok(()),
            }
        })?;
        write_atomically(&sidecar, IfExists::Replace, |writer| {
            serde_json::to_writer_pretty(&mut *writer, self)?;
            writeln!(writer)
        })
    }

    /// Reads the sidecar of `path`; `None` when there is none.
    ///
    /// # Errors
    /// When it cannot be read, or is not a sidecar.
    pub fn read(path: &Path) -> Result<Option<Self>, IoError> {
        let sidecar = Self::path_of(path);
        let Some(text) = text_beside(&sidecar)? else { return Ok(None) };
        serde_json::from_str(&text).map(Some).map_err(|error| {
            let advice = "repair it, or remove it to read the data without it";
            Fault::new(error.to_string(), "the sidecar of a raster", advice).reading(&sidecar)
        })
    }
}
