//! How a run of a sweep ended, in a file of its folder.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

/// The file of an outcome. It is written last, so a run that has it is over.
const FILE: &str = "run.json";

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Status {
    /// To its end.
    Done,
    /// Before its end.
    Failed,
}

/// How a run ended, and what it was.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Outcome {
    /// Digest of its scenario: see [`super::PlannedRun::digest`].
    pub digest: String,
    /// How it ended.
    pub status: Status,
    /// Why it failed.
    pub reason: String,
}

impl Outcome {
    /// The outcome in the folder of a run; none where the run is not over, or where the file is
    /// damaged.
    pub fn read(folder: &Path) -> Option<Self> {
        serde_json::from_str(&fs::read_to_string(folder.join(FILE)).ok()?).ok()
    }

    /// Writes the outcome into the folder of its run.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        crate::program::write_json(&folder.join(FILE), self)
    }

    /// Whether the run of this digest is done and need not be run again.
    pub fn is_done(folder: &Path, digest: &str) -> bool {
        let outcome = Self::read(folder);
        let done = outcome.is_some_and(|own| own.status == Status::Done && own.digest == digest);
        done && folder.join("report.json").is_file()
    }
}
