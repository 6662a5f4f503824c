//! The runs of a sweep as they are kept in its output folder.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::file::PlotEntry;

/// The file of a plan.
const FILE: &str = "sweep.json";

/// A sweep with all its runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Plan {
    /// Version of Landform.
    pub version: String,
    /// What the sweep shows.
    pub title: String,
    /// What is plotted.
    pub plots: Vec<PlotEntry>,
    /// Names of the parameters.
    pub names: Vec<String>,
    /// Paths of the parameters in the scenario.
    pub paths: Vec<String>,
    /// The runs in order.
    pub runs: Vec<PlannedRun>,
}

/// A run of a sweep.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct PlannedRun {
    /// Number, from one.
    pub number: usize,
    /// Number of the point, from zero; runs at one point differ in their seed only.
    pub point: usize,
    /// Seed.
    pub seed: u64,
    /// A value for each parameter, as RON.
    pub values: Vec<String>,
    /// Digest of the scenario with all changes: FNV-1a, 64 bits.
    pub digest: String,
}

impl Plan {
    /// The plan in a folder; none where there is none.
    ///
    /// # Errors
    /// A message when there is one that cannot be read.
    pub fn read(folder: &Path) -> Result<Option<Self>, String> {
        let path = folder.join(FILE);
        if !path.exists() {
            return Ok(None);
        }
        let shown = path.display();
        let text =
            fs::read_to_string(&path).map_err(|error| format!("cannot read {shown}: {error}"))?;
        serde_json::from_str(&text).map(Some).map_err(|error| {
            format!("{shown} is damaged ({error}); remove it and run the sweep again")
        })
    }

    /// Writes the plan into its folder.
    ///
    /// # Errors
    /// A message when it cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        crate::program::write_json(&folder.join(FILE), self)
    }

    /// The folder of a run below that of the sweep.
    pub fn folder_of(&self, run: &PlannedRun) -> PathBuf {
        let width = self.runs.len().to_string().len().max(4);
        Path::new("runs").join(format!("{:0width$}", run.number))
    }

    /// The values of a run in words, for captions and messages.
    pub fn describe(&self, run: &PlannedRun) -> String {
        let values = self.names.iter().zip(&run.values);
        values.map(|(name, value)| format!("{name} {value}")).collect::<Vec<_>>().join(", ")
    }

    /// Why runs that were made by the plan `earlier` cannot stand beside those of this one; none
    /// when they can.
    pub fn differs_from(&self, earlier: &Self) -> Option<String> {
        if self.version != earlier.version {
            let (new, old) = (&self.version, &earlier.version);
            return Some(format!("it was begun by version {old} and this is version {new}"));
        }
        if (&self.names, &self.paths) != (&earlier.names, &earlier.paths) {
            let (new, old) = (self.paths.join(", "), earlier.paths.join(", "));
            return Some(format!("it varied {old} and varies {new} now"));
        }
        if self.runs.len() != earlier.runs.len() {
            let (new, old) = (self.runs.len(), earlier.runs.len());
            return Some(format!("it had {old} runs and has {new} now"));
        }
        let mut pairs = self.runs.iter().zip(&earlier.runs);
        let (new, old) = pairs.find(|(new, old)| new != old)?;
        let number = new.number;
        Some(if new.values != old.values {
            let (new, old) = (self.describe(new), self.describe(old));
            format!("run {number} had {old} and has {new} now")
        } else if new.seed != old.seed {
            format!("run {number} had the seed {} and has {} now", old.seed, new.seed)
        } else {
            format!("the scenario of run {number} is another one")
        })
    }
}

/// The digest of a text: FNV-1a, 64 bits, in hexadecimal figures.
pub(super) fn digest(text: &str) -> String {
    let hash = text.bytes().fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3)
    });
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_those_of_the_published_function() {
        // Test vectors of the authors of FNV.
        assert_eq!(digest(""), "cbf29ce484222325");
        assert_eq!(digest("a"), "af63dc4c8601ec8c");
        assert_eq!(digest("foobar"), "85944171f73967e8");
    }
}
