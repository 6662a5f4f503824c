//! Lines of equal value.

use std::path::{Path, PathBuf};

use landform_analysis::{LevelSet, LevelSetEdge, level_sets};
use landform_graph::Lattice;
use landform_io::{Feature, Geometry};
use landform_sim::output::{FileOutput, When};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::map_place::{MapPlace, check_plane};

/// The lines along which a field passes through some levels, contours or coasts, with their levels:
/// as comma-separated values, a point a row with the number of its line, or as GeoJSON, a
/// `LineString` a line. `landform analyze` and map programs read both.
///
/// Land, at or above the level, lies to the left. Points are in metres from the south-western
/// corner of the map, or in the coordinates of the raster that the domain came from; closed lines
/// end at their first point. GeoJSON in metres carries the member `crs` of GeoJSON 2008: null, or
/// the name of the raster's system.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LevelLines {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the field.
    pub field: String,
    /// The levels; 0.5 is the coast of the field `land`.
    #[schemars(length(min = 1))]
    pub levels: Vec<f64>,
    /// When it is written.
    pub when: When,
}

impl Default for LevelLines {
    fn default() -> Self {
        Self {
            file: "lines.csv".into(),
            field: "surface".to_owned(),
            levels: vec![0.0],
            when: When::End,
        }
    }
}

impl FileOutput for LevelLines {
    const NAME: &'static str = "LevelLines";
    const KIND: &'static str = "lines";
    const EXTENSIONS: &'static [&'static str] = &["csv", "geojson"];

    fn order(&self) -> (&Path, &When) {
        (&self.file, &self.when)
    }

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_plane(lattice)?;
        match self.levels.iter().position(|level| !level.is_finite()) {
            Some(index) => {
                let message = format!("the level is {}", self.levels[index]);
                Err(Problem::new(format!("levels[{index}]"), message, "a finite number"))
            }
            None => Ok(()),
        }
    }

    fn write(&self, path: &Path, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let values = field_file::map_values(snapshot, &self.field)?;
        let lattice = snapshot.lattice();
        let size = [lattice.width(), lattice.height()];
        let lines = |level: &f64| {
            let lines = level_sets(&values, size, *level, LevelSetEdge::End);
            lines.map(|lines| (*level, lines))
        };
        let lines = self.levels.iter().map(lines).collect::<Result<Vec<_>, _>>();
        let lines = lines.map_err(|error| Problem::new("levels", error.to_string(), ""))?;
        let place = MapPlace::of(snapshot);
        let features = lines
            .iter()
            .flat_map(|(level, lines)| lines.iter().map(|line| feature(*level, line, &place)));
        place.write(path, &features.collect::<Vec<_>>())
    }
}

/// A line at its place on the map.
fn feature(level: f64, line: &LevelSet, place: &MapPlace) -> Feature {
    let points = line.points.iter().map(|&at| place.point(at)).collect();
    Feature { geometry: Geometry::Line(points), properties: vec![("level", level)] }
}
