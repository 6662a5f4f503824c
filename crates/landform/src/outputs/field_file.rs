//! A field as a raster file, and what outputs of fields have in common.

use std::path::{Component, Path, PathBuf};

use landform_graph::Lattice;
use landform_io::{Georeference, IfExists, Metadata, Raster, write_raster};
use landform_sim::checkpoint;
use landform_sim::field::FieldEntry;
use landform_sim::output::{Output, Sink};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::When;
use super::due::{Due, DueFile};

/// A field as a raster: GeoTIFF (`.tif`), ESRI ASCII (`.asc`), NumPy (`.npy`), 16-bit grey
/// (`.png`) or 32-bit floats (`.raw`), with scale, unit, spacing and seed in it or beside it.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FieldFile {
    /// File name below the output folder; its extension chooses the format.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// When it is written.
    pub when: When,
}

impl Default for FieldFile {
    fn default() -> Self {
        Self { file: "surface.tif".into(), field: "surface".to_owned(), when: When::End }
    }
}

/// Extensions of the raster formats that can be written.
#[cfg(not(feature = "exr"))]
const EXTENSIONS: &[&str] = &["tif", "tiff", "asc", "npy", "png", "raw"];
#[cfg(feature = "exr")]
const EXTENSIONS: &[&str] = &["tif", "tiff", "asc", "npy", "png", "raw", "exr"];

impl Output for FieldFile {
    const NAME: &'static str = "FieldFile";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, _lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, EXTENSIONS)
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(Due(self.clone()))
    }
}

impl DueFile for FieldFile {
    const KIND: &'static str = "raster";

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
        let raster = raster_of(snapshot, values);
        write_raster(path, &raster, &metadata(snapshot, entry), IfExists::Replace)
            .map_err(|error| Problem::new("file", error.to_string(), ""))
    }
}

/// Values of a field and what is known of it.
pub(super) fn values<'a>(
    snapshot: &Snapshot<'a>,
    name: &str,
) -> Result<(Vec<f64>, &'a FieldEntry), Problem> {
    let unknown = |error: landform_sim::field::UnknownField| {
        Problem::new("field", error.to_string(), "a field of the run")
    };
    Ok((snapshot.field(name).map_err(unknown)?, snapshot.entry(name).map_err(unknown)?))
}

/// Refuses names of files that lead out of the output folder, lie among what every run writes,
/// or do not end in one of `extensions`.
pub(super) fn check_file(file: &Path, extensions: &[&str]) -> Result<(), Problem> {
    let refuse = |why: &str, expected: &str| {
        Err(Problem::new("file", format!("`{}` {why}", file.display()), expected))
    };
    let mut parts = file.components();
    if file.file_name().is_none() || !parts.all(|part| matches!(part, Component::Normal(_))) {
        return refuse("leads out of the output folder", "a name below the output folder");
    }
    if file.starts_with("fields") {
        return refuse("lies in the folder of the final fields", "a name outside `fields`");
    }
    if file.starts_with(checkpoint::FOLDER) {
        return refuse("lies in the folder of the checkpoint", "a name outside `checkpoint`");
    }
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match extensions.contains(&extension.as_str()) {
        true => Ok(()),
        false => {
            let expected = format!("one that ends in .{}", extensions.join(", ."));
            refuse("ends in no format that is known here", &expected)
        }
    }
}

/// The path of an output below its folder, whose parent folders are made.
pub(super) fn below(folder: &Path, file: &Path) -> Result<PathBuf, Problem> {
    let path = folder.join(file);
    if let Some(parent) = path.parent() {
        std::fs::create_dir_all(parent).map_err(|error| {
            Problem::new("file", format!("cannot make {}: {error}", parent.display()), "")
        })?;
    }
    Ok(path)
}

/// The values of a field of the run as a raster in its place on Earth, or at the origin.
pub(crate) fn raster_of(snapshot: &Snapshot<'_>, values: Vec<f64>) -> Raster {
    let lattice = snapshot.lattice();
    let [width, height, _] = lattice.size();
    let mut raster = Raster::local(width, height, lattice.spacing(), values);
    let place = snapshot.domain().georeference.as_ref();
    if let Some(place) = place.and_then(|place| place.downcast_ref::<Georeference>()) {
        raster.georeference = Some(place.clone());
    }
    raster
}

/// What goes with the values of a field into a file.
pub(crate) fn metadata(snapshot: &Snapshot<'_>, entry: &FieldEntry) -> Metadata {
    let clock = snapshot.clock();
    let mut metadata = Metadata {
        title: Some(snapshot.title().to_owned()),
        field: Some(entry.name.to_owned()),
        unit: Some(entry.unit.to_owned()),
        spacing_m: Some(snapshot.lattice().spacing()),
        seed: Some(clock.seed),
        ..Metadata::default()
    };
    let notes = [
        ("iteration", clock.tick.to_string()),
        ("software", concat!("landform ", env!("CARGO_PKG_VERSION")).to_owned()),
    ];
    metadata.notes.extend(notes.map(|(key, value)| (key.to_owned(), value)));
    metadata
}
