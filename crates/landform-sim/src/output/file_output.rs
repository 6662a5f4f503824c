//! Outputs that write one file at a time, whenever it is due.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;

use super::{Moment, Output, OutputFile, Sink, When, below, check_file};
use crate::agent::GroupUse;
use crate::checkpoint::{Damage, Loader, Saver};
use crate::parameters::{Parameters, Problem};
use crate::snapshot::Snapshot;

/// An output that writes one whole file whenever it is due. Implement it instead of
/// [`Output`]: the schedule, the name of the file and their checks are done.
pub trait FileOutput: Parameters {
    /// Name in scenarios.
    const NAME: &'static str;

    /// What the files are, for the report: `picture`, `raster`, `mesh`, `table`.
    const KIND: &'static str;

    /// Extensions of the formats that can be written, in lower case.
    const EXTENSIONS: &'static [&'static str];

    /// The file below the output folder, and when it is due.
    fn order(&self) -> (&Path, &When);

    /// Fields that the output needs: see [`Output::fields`].
    fn fields(&self) -> Vec<String> {
        Vec::new()
    }

    /// Groups that the output needs: see [`Output::groups`].
    fn groups(&self) -> Vec<GroupUse> {
        Vec::new()
    }

    /// Refuses what suits neither the lattice nor itself, beside the file and the schedule.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter, what was expected and what to do.
    fn validate(&self, _lattice: &Lattice) -> Result<(), Problem> {
        Ok(())
    }

    /// Writes the state of the run to `path`, wholly or not at all.
    ///
    /// # Errors
    /// The [`Problem`] names the parameter or the file.
    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem>;
}

impl<F: FileOutput> Output for F {
    const NAME: &'static str = <F as FileOutput>::NAME;

    fn fields(&self) -> Vec<String> {
        FileOutput::fields(self)
    }

    fn groups(&self) -> Vec<GroupUse> {
        FileOutput::groups(self)
    }

    fn metrics(&self) -> Vec<String> {
        self.order().1.metrics()
    }

    fn file(&self) -> Option<&Path> {
        Some(self.order().0)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        let (file, when) = self.order();
        check_file(file, F::EXTENSIONS)?;
        when.check()?;
        FileOutput::validate(self, lattice)
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(FileSink(self.clone()))
    }
}

struct FileSink<F>(F);

impl<F: FileOutput> Sink for FileSink<F> {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        let (file, when) = self.0.order();
        if !when.is_due(moment, snapshot) {
            return Ok(Vec::new());
        }
        let file: PathBuf = when.file_name(file, snapshot);
        self.0.write(&below(folder, &file)?, snapshot)?;
        Ok(vec![OutputFile { file, kind: F::KIND.to_owned() }])
    }

    fn save<'a>(&'a mut self, _: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        Ok(())
    }

    fn restore(&mut self, _: &Loader<'_>, _: &Snapshot<'_>, _: &Path) -> Result<(), Damage> {
        Ok(())
    }
}
