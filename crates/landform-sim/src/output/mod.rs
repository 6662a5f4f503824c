//! Outputs: sinks that write pictures, rasters and meshes while a run goes on.

mod file_output;
mod place;
mod when;

pub use file_output::FileOutput;
pub use place::{below, check_file};
pub use when::When;

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use serde::{Deserialize, Serialize};

use crate::agent::GroupUse;
use crate::checkpoint::{Damage, Loader, Saver};
use crate::parameters::{Parameters, Problem};
use crate::snapshot::Snapshot;

/// When an output looks at the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moment {
    /// Before the first iteration.
    Start,
    /// After an iteration.
    Iteration,
    /// After the last iteration of a stage, and after its [`Moment::Iteration`].
    StageEnd,
    /// After everything; outputs finish their files now.
    End,
}

/// A file that an output wrote.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutputFile {
    /// Path, relative to the output folder.
    pub file: PathBuf,
    /// What it is: `picture`, `animation`, `raster`, `mesh`, `table`, `series`, `field`.
    pub kind: String,
}

/// An output, chosen by name in a scenario. One that writes a whole file now and then implements
/// [`FileOutput`] instead.
pub trait Output: Parameters {
    /// Name in scenarios.
    const NAME: &'static str;

    /// Fields that the output needs, so that a wrong name is refused before the run.
    fn fields(&self) -> Vec<String> {
        Vec::new()
    }

    /// Groups of agents that the output needs, so that a wrong name is refused before the run.
    fn groups(&self) -> Vec<GroupUse> {
        Vec::new()
    }

    /// Names of the metrics that decide when it is due. A name that nothing measures is refused
    /// once every metric has had something to say.
    fn metrics(&self) -> Vec<String> {
        Vec::new()
    }

    /// Names of the stages whose end it waits for, so that a wrong name is refused before the run.
    fn stages(&self) -> Vec<String> {
        Vec::new()
    }

    /// The file it writes, below the output folder, or the one from whose name those of
    /// several files are made. Two outputs may not share one.
    fn file(&self) -> Option<&Path> {
        None
    }

    /// Refuses before the run what the ranges of single parameters do not show: a file name
    /// that leads out of the output folder, unknown colours, a lattice that cannot be drawn.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter, what was expected and what to do.
    fn validate(&self, _lattice: &Lattice) -> Result<(), Problem> {
        Ok(())
    }

    /// The sink that does the work during one run.
    fn open(&self) -> Box<dyn Sink>;
}

/// An output at work. A run may be killed at any moment and go on from an earlier checkpoint: the
/// files that it leaves must be the same.
pub trait Sink {
    /// Brings to the disk what it holds back. Asked for when the run ends, whatever the reason.
    ///
    /// # Errors
    /// The [`Problem`] names the file.
    fn flush(&mut self) -> Result<(), Problem> {
        Ok(())
    }

    /// Looks at the run and writes what is due into `folder`. Returns the files that are
    /// finished; a file must never be left half-written.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter or the file.
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem>;

    /// Saves what the sink remembers of earlier moments; a sink that remembers nothing saves
    /// nothing. What it has written so far into files that are not finished goes to the disk
    /// now: they lie in [`checkpoint::FOLDER`](crate::checkpoint::FOLDER), which stays until
    /// the run is over.
    ///
    /// # Errors
    /// The [`Problem`] names the file.
    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem>;

    /// Goes on from what was saved, in the place of a [`Moment::Start`]. What files hold beyond
    /// the checkpoint is cut off.
    ///
    /// # Errors
    /// What is missing or cannot be used.
    fn restore(
        &mut self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<(), Damage>;
}
