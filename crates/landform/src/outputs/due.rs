//! What outputs have in common that write a file of one field whenever it is due.

use std::path::{Path, PathBuf};

use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::field::FieldEntry;
use landform_sim::output::{Moment, OutputFile, Sink};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;

use super::{When, field_file};

/// An output that writes a file of one field at a time.
pub(super) trait DueFile {
    /// What the file is, for the report.
    const KIND: &'static str;

    /// The file, the field and when it is due.
    fn order(&self) -> (&PathBuf, &str, When);

    /// Writes the values of the field to `path`.
    fn write(
        &self,
        path: &Path,
        values: Vec<f64>,
        entry: &FieldEntry,
        snapshot: &Snapshot<'_>,
    ) -> Result<(), Problem>;
}

/// The sink of such an output.
pub(super) struct Due<O>(pub(super) O);

impl<O: DueFile> Sink for Due<O> {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        let (file, field, when) = self.0.order();
        if !when.is_due(moment, snapshot) {
            return Ok(Vec::new());
        }
        let (values, entry) = field_file::values(snapshot, field)?;
        let file = when.file_name(file, snapshot);
        let path = field_file::below(folder, &file)?;
        self.0.write(&path, values, entry, snapshot)?;
        Ok(vec![OutputFile { file, kind: O::KIND.to_owned() }])
    }

    fn save<'a>(&'a mut self, _: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        Ok(())
    }

    fn restore(&mut self, _: &Loader<'_>, _: &Snapshot<'_>, _: &Path) -> Result<(), Damage> {
        Ok(())
    }
}
