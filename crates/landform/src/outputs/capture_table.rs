//! Captures of tributaries as a table.

use std::io::Write;
use std::path::{Path, PathBuf};

use landform_analysis::grid::Grid;
use landform_graph::Lattice;
use landform_io::{IfExists, write_atomically};
use landform_rivers::captures::CaptureRecord;
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::output::{Moment, Output, OutputFile, Sink, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use super::map_place::{MapPlace, check_plane};
use crate::explain::file_problem;

/// Every capture of a tributary as comma-separated values: the iteration of the survey that found
/// it, the place of the captured stream's lowest node, the area that drains through it, and the
/// numbers of the rivers that lost and took it. The metric `TributaryCaptures` says what a capture
/// is.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaptureTable {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Name of the field of heights.
    pub field: String,
    /// Nodes that drain through the beginning of a river.
    #[schemars(range(min = 1))]
    pub channel_nodes: u32,
    /// Iterations from one survey to the next.
    #[schemars(range(min = 1))]
    pub every: u64,
}

impl Default for CaptureTable {
    fn default() -> Self {
        Self { file: "captures.csv".into(), field: "bed".to_owned(), channel_nodes: 100, every: 10 }
    }
}

impl Output for CaptureTable {
    const NAME: &'static str = "CaptureTable";

    fn fields(&self) -> Vec<String> {
        vec![self.field.clone()]
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["csv"])?;
        check_plane(lattice)
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(CaptureSink { settings: self.clone(), record: CaptureRecord::default() })
    }
}

struct CaptureSink {
    settings: CaptureTable,
    record: CaptureRecord,
}

impl Sink for CaptureSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        let tick = snapshot.clock().tick;
        match moment {
            Moment::Start => self.survey(snapshot)?,
            Moment::Iteration if tick.is_multiple_of(self.settings.every) => {
                self.survey(snapshot)?;
            }
            Moment::Iteration | Moment::StageEnd => {}
            Moment::End => return self.write(snapshot, folder),
        }
        Ok(Vec::new())
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        to.value("record", &self.record);
        Ok(())
    }

    fn restore(&mut self, from: &Loader<'_>, _: &Snapshot<'_>, _: &Path) -> Result<(), Damage> {
        self.record = from.value("record")?;
        Ok(())
    }
}

impl CaptureSink {
    fn survey(&mut self, snapshot: &Snapshot<'_>) -> Result<(), Problem> {
        let (bed, _) = field_file::values(snapshot, &self.settings.field)?;
        let lattice = snapshot.lattice();
        let grid = Grid::new([lattice.width(), lattice.height()], [lattice.spacing(); 2]);
        let nodes = self.settings.channel_nodes;
        grid.and_then(|grid| self.record.survey(&grid, &bed, nodes, snapshot.clock().tick))
            .map_err(|error| Problem::new("", error.to_string(), ""))
    }

    fn write(&self, snapshot: &Snapshot<'_>, folder: &Path) -> Result<Vec<OutputFile>, Problem> {
        let path = below(folder, &self.settings.file)?;
        let (place, lattice) = (MapPlace::of(snapshot), snapshot.lattice());
        let node_m2 = lattice.spacing().powi(2);
        let written = write_atomically(&path, IfExists::Replace, |file| {
            writeln!(file, "iteration,x,y,area_m2,from,to")?;
            for capture in &self.record.captures {
                let [column, row, _] = lattice.coordinates(capture.node as usize);
                let [x, y] = place.point([column as f64, row as f64]);
                let area_m2 = node_m2 * f64::from(capture.area_nodes);
                let (from, to) = (capture.from, capture.to);
                writeln!(file, "{},{x:?},{y:?},{area_m2:?},{from},{to}", capture.iteration)?;
            }
            Ok(())
        });
        written.map_err(|error| file_problem("file", &error))?;
        Ok(vec![OutputFile { file: self.settings.file.clone(), kind: "table".to_owned() }])
    }
}
