//! A picture of a field.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::look::{Look, Subject, picture_text, problem, write_picture};

/// A picture of a field as PNG, with title, scale and seed in its text entries. Looks that are plots
/// (`Section`, `Hypsometry`) are written as SVG too.
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

impl FileOutput for Picture {
    const NAME: &'static str = "Picture";
    const KIND: &'static str = "picture";
    const EXTENSIONS: &'static [&'static str] = &["png", "svg"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        self.look.fields(&self.field)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if is_svg(&self.file) && !self.look.is_plot() {
            let message = "only plots can be written as SVG";
            return Err(Problem::new("file", message, "a name in .png, or a look Section"));
        }
        self.look.validate(lattice)
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let subject = Subject::of(snapshot, &self.field, &self.look)?;
        if is_svg(path) {
            let Some(figure) = self.look.figure(snapshot.lattice(), &subject) else {
                return Ok(());
            };
            let written = figure.and_then(|figure| figure.write(path, &[]));
            return written.map_err(|error| problem(&error));
        }
        let image = self.look.draw(snapshot.lattice(), &subject);
        let text = picture_text(snapshot, &self.field);
        write_picture(&image.map_err(|error| problem(&error))?, path, &text)
    }
}

fn is_svg(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("svg"))
}
