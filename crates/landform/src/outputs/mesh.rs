//! A field of heights as a mesh.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::mesh::{self, height_mesh};
use landform_io::{IfExists, IoError, Metadata, Raster};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::ColourMap;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::map_place::check_plane;

/// A field of heights as a triangle mesh with colours: glTF (`.glb`), `.obj`, `.ply`, `.stl`.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Mesh {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// Name of the colour map of the vertices.
    pub colours: String,
    /// When it is written.
    pub when: When,
}

impl Default for Mesh {
    fn default() -> Self {
        Self {
            file: "surface.glb".into(),
            field: "surface".to_owned(),
            colours: "sand".to_owned(),
            when: When::End,
        }
    }
}

impl FileOutput for Mesh {
    const NAME: &'static str = "Mesh";
    const KIND: &'static str = "mesh";
    const EXTENSIONS: &'static [&'static str] = &["glb", "obj", "ply", "stl"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        colour_map(&self.colours)?;
        check_plane(lattice)?;
        let [width, height, _] = lattice.size();
        match width.min(height) {
            0 | 1 => {
                let message = format!("{width} x {height} nodes span no surface");
                Err(Problem::new("", message, "at least 2 x 2 nodes"))
            }
            _ => Ok(()),
        }
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (values, entry) = field_file::values(snapshot, &self.field)?;
        let colours = colour_map(&self.colours)?;
        let raster = field_file::raster_of(snapshot, values);
        let metadata = field_file::metadata(snapshot, entry);
        write_mesh(path, &raster, &metadata, colours, IfExists::Replace)
            .map_err(|error| Problem::new("file", error.to_string(), ""))
    }
}

fn colour_map(name: &str) -> Result<ColourMap, Problem> {
    ColourMap::named(name).map_err(|error| Problem::new("colours", error.to_string(), ""))
}

/// Writes the surface of a raster of heights as a mesh, coloured by height.
pub(crate) fn write_mesh(
    path: &Path,
    raster: &Raster,
    metadata: &Metadata,
    colours: ColourMap,
    if_exists: IfExists,
) -> Result<(), IoError> {
    let spacing_m = metadata.spacing_m.or(raster.spacing_m().ok()).unwrap_or(1.0);
    let mut surface = height_mesh(raster, spacing_m).map_err(|fault| fault.writing(path))?;
    let [low, high] = raster.range().unwrap_or([0.0, 1.0]);
    let span = if high > low { high - low } else { 1.0 };
    let present = raster.values.iter().filter(|value| !value.is_nan());
    surface.colours = present.map(|value| colours.colour((value - low) / span)).collect();
    mesh::write_mesh(path, &surface, metadata, if_exists)
}
