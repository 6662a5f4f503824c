//! When an output that writes one file at a time is due.

use std::path::{Path, PathBuf};

use landform_sim::output::Moment;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// When an output is due.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum When {
    /// After the last iteration.
    #[default]
    End,
    /// Before the first iteration.
    Start,
    /// Before the first iteration and at the end of each stage; the number of iterations is
    /// put into the file's name.
    StageEnds,
    /// After every so many iterations; the number of iterations is put into the file's name.
    Every(u64),
}

impl When {
    /// Whether the output is due now.
    pub(crate) fn is_due(self, moment: Moment, snapshot: &Snapshot<'_>) -> bool {
        match self {
            Self::End => moment == Moment::End,
            Self::Start => moment == Moment::Start,
            Self::StageEnds => matches!(moment, Moment::Start | Moment::StageEnd),
            Self::Every(count) => match moment {
                Moment::Start => true,
                Moment::Iteration => snapshot.clock().tick.is_multiple_of(count.max(1)),
                _ => false,
            },
        }
    }

    /// The name of the file that is due now, below the output folder.
    pub(crate) fn file_name(self, file: &Path, snapshot: &Snapshot<'_>) -> PathBuf {
        if matches!(self, Self::End | Self::Start) {
            return file.to_owned();
        }
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let extension = file.extension().unwrap_or_default().to_string_lossy();
        file.with_file_name(format!("{stem}_{:06}.{extension}", snapshot.clock().tick))
    }
}
