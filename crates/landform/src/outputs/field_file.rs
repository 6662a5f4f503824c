//! A field as a raster file, and what outputs of fields have in common.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::{
    Georeference, IfExists, IoError, Metadata, Raster, SampleType, npy, vtk, write_raster,
};
use landform_sim::field::FieldEntry;
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::explain::file_problem;

/// A field as a raster: GeoTIFF (`.tif`), ESRI ASCII (`.asc`), NumPy (`.npy`), 16-bit grey
/// (`.png`) or 32-bit floats (`.raw`), with scale, unit, spacing and seed in it or beside it; or as
/// VTK image data (`.vti`). Volumes are written as `.npy` (layers, rows, columns) or `.vti`.
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
const EXTENSIONS: &[&str] = &["tif", "tiff", "asc", "npy", "png", "raw", "vti"];
#[cfg(feature = "exr")]
const EXTENSIONS: &[&str] = &["tif", "tiff", "asc", "npy", "png", "raw", "vti", "exr"];

impl FileOutput for FieldFile {
    const NAME: &'static str = "FieldFile";
    const KIND: &'static str = "raster";
    const EXTENSIONS: &'static [&'static str] = EXTENSIONS;

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        if lattice.depth() == 1 || extension(&self.file) == "npy" || extension(&self.file) == "vti"
        {
            return Ok(());
        }
        let message = format!("`{}` is a format of maps", self.file.display());
        Err(Problem::new(
            "file",
            message,
            "one that ends in .npy or .vti, as the domain is a volume",
        ))
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (values, entry) = values(snapshot, &self.field)?;
        write_field(path, snapshot, values, entry).map_err(|error| file_problem("file", &error))
    }
}

fn extension(file: &Path) -> String {
    file.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// Writes the values of a field in the format of the file's extension.
pub(crate) fn write_field(
    path: &Path,
    snapshot: &Snapshot<'_>,
    values: Vec<f64>,
    entry: &FieldEntry,
) -> Result<(), IoError> {
    let metadata = metadata(snapshot, entry);
    let lattice = snapshot.lattice();
    let [width, height, layers] = lattice.size();
    if extension(path) == "vti" {
        let spacing = lattice.spacing();
        vtk::write_image_data(path, lattice.size(), spacing, &values, &metadata, IfExists::Replace)
    } else if layers > 1 {
        let shape = [layers, height, width];
        npy::write_array(path, &shape, &values, &metadata, SampleType::F64, IfExists::Replace)
    } else {
        write_raster(path, &raster_of(snapshot, values), &metadata, IfExists::Replace)
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

/// Values of a field, NaN at nodes outside the map.
pub(super) fn map_values(snapshot: &Snapshot<'_>, name: &str) -> Result<Vec<f64>, Problem> {
    let (mut values, _) = values(snapshot, name)?;
    snapshot.domain().outside.blank(&mut values);
    Ok(values)
}

/// The values of a field of the run as a raster in its place on Earth, or at the origin; without
/// data outside the map.
pub(super) fn raster_of(snapshot: &Snapshot<'_>, mut values: Vec<f64>) -> Raster {
    let (lattice, domain) = (snapshot.lattice(), snapshot.domain());
    domain.outside.blank(&mut values);
    let [width, height, _] = lattice.size();
    let mut raster = Raster::local(width, height, lattice.spacing(), values);
    raster.no_data = domain.no_data;
    let place = domain.georeference.as_ref();
    if let Some(place) = place.and_then(|place| place.downcast_ref::<Georeference>()) {
        raster.georeference = Some(place.clone());
    }
    raster
}

/// What goes with the values of a field into a file.
pub(super) fn metadata(snapshot: &Snapshot<'_>, entry: &FieldEntry) -> Metadata {
    let (field, unit) = (Some(entry.name.to_owned()), Some(entry.unit.to_owned()));
    Metadata { field, unit, ..run_metadata(snapshot) }
}

/// What goes into a file that shows no field.
pub(super) fn run_metadata(snapshot: &Snapshot<'_>) -> Metadata {
    let clock = snapshot.clock();
    let mut metadata = Metadata {
        title: Some(snapshot.title().to_owned()),
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
