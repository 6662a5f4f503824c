//! A picture of a field.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_sim::field::FieldEntry;
use landform_sim::output::{Output, Sink};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::due::{Due, DueFile};
use super::look::{Look, picture_text, problem, write_picture};
use super::{When, field_file};

/// A picture of a field as PNG, with title, scale and seed in its text entries.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Picture {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// How it is drawn.
    pub look: Look,
    /// When it is drawn.
    pub when: When,
}

impl Default for Picture {
    fn default() -> Self {
        Self {
            file: "picture.png".into(),
            field: "surface".to_owned(),
            look: Look::default(),
            when: When::End,
        }
    }
}

impl Output for Picture {
    const NAME: &'static str = "Picture";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        field_file::check_file(&self.file, &["png"])?;
        self.look.validate(lattice)
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(Due(self.clone()))
    }
}

impl DueFile for Picture {
    const KIND: &'static str = "picture";

    fn order(&self) -> (&PathBuf, &str, When) {
        (&self.file, &self.field, self.when)
    }

    fn write(
        &self,
        path: &Path,
        values: Vec<f64>,
        entry: &FieldEntry,
        snapshot: &Snapshot<'_>,
    ) -> Result<(), Problem> {
        let image = self.look.draw(snapshot.lattice(), &values, entry.unit);
        let text = picture_text(snapshot, &self.field);
        write_picture(&image.map_err(|error| problem(&error))?, path, &text)
    }
}
