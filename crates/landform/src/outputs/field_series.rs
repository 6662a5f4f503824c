//! A series of fields in one NetCDF file.

use std::path::{Path, PathBuf};

use landform_graph::Lattice;
use landform_io::netcdf::{Axis, Layout, SeriesWriter, Variable, axes};
use landform_io::{Georeference, IfExists, IoError};
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::code::Code;
use landform_sim::output::{Moment, Output, OutputFile, Sink, When, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::field_file;
use crate::explain::file_problem;

/// Fields as they change: one NetCDF file (`.nc`) with a record for each iteration at which it is
/// due, with units, coordinates, title and seed. The file is whole after each record.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FieldSeries {
    /// File name below the output folder.
    pub file: PathBuf,
    /// Names of the fields.
    #[schemars(length(min = 1))]
    pub fields: Vec<String>,
    /// When a record is added.
    pub when: When,
}

impl Default for FieldSeries {
    fn default() -> Self {
        Self { file: "fields.nc".into(), fields: vec!["surface".to_owned()], when: When::StageEnds }
    }
}

impl Output for FieldSeries {
    const NAME: &'static str = "FieldSeries";

    fn fields(&self) -> Vec<String> {
        self.fields.clone()
    }

    fn metrics(&self) -> Vec<String> {
        self.when.metrics()
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, _lattice: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["nc"])?;
        self.when.check()?;
        let twice = |(index, name): &(usize, &String)| self.fields[..*index].contains(name);
        match self.fields.iter().enumerate().find(twice) {
            Some((index, name)) => {
                let message = format!("field `{name}` stands twice");
                Err(Problem::new(format!("fields[{index}]"), message, "each field once"))
            }
            None => Ok(()),
        }
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(SeriesSink { settings: self.clone(), writer: None })
    }
}

struct SeriesSink {
    settings: FieldSeries,
    writer: Option<SeriesWriter>,
}

impl Sink for SeriesSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        let FieldSeries { file, fields, when } = &self.settings;
        if moment == Moment::Start {
            let layout = layout(snapshot, fields)?;
            let path = below(folder, file)?;
            let writer = SeriesWriter::create(&path, &layout, IfExists::Replace);
            self.writer = Some(writer.map_err(|error| problem(&error))?);
        }
        if when.is_due(moment, snapshot) {
            let tick = snapshot.clock().tick as f64;
            let values = |name: &String| field_file::map_values(snapshot, name);
            let values = fields.iter().map(values).collect::<Result<Vec<_>, _>>()?;
            let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
            if let Some(writer) = &mut self.writer {
                writer.append(tick, &values).map_err(|error| problem(&error))?;
            }
        }
        Ok(match moment {
            Moment::End => vec![OutputFile { file: file.clone(), kind: "fields".to_owned() }],
            _ => Vec::new(),
        })
    }

    fn save<'a>(&'a mut self, _: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        Ok(())
    }

    fn restore(
        &mut self,
        from: &Loader<'_>,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<(), Damage> {
        let refuse = |message: String| from.refuse("", message);
        let FieldSeries { file, fields, .. } = &self.settings;
        let layout = layout(snapshot, fields).map_err(|problem| refuse(problem.to_string()))?;
        let last = snapshot.clock().tick as f64;
        let writer = SeriesWriter::reopen(&folder.join(file), &layout, last);
        self.writer = Some(writer.map_err(|error| refuse(error.to_string()))?);
        Ok(())
    }
}

fn problem(error: &IoError) -> Problem {
    file_problem("file", error)
}

/// What the file of these fields holds.
fn layout(snapshot: &Snapshot<'_>, fields: &[String]) -> Result<Layout, Problem> {
    let lattice = snapshot.lattice();
    let [width, height, depth] = lattice.size();
    let place = snapshot.domain().georeference.as_ref();
    let place = place.and_then(|place| place.downcast_ref::<Georeference>()).cloned();
    let place = place.unwrap_or_else(|| Georeference::local(height, lattice.spacing()));
    let (map, system) = axes(&place, [width, height]);
    let mut axes: Vec<Axis> = map.into();
    if depth > 1 {
        axes.insert(0, layers(depth, lattice.spacing()));
    }
    let field = |name: &String| {
        let entry = snapshot.entry(name);
        let entry = entry
            .map_err(|error| Problem::new("fields", error.to_string(), "").code(Code::NotInRun))?;
        let variable = Variable::new(entry.name).text("long_name", entry.meaning);
        let mapping = if system.is_some() { "crs" } else { "" };
        Ok(variable.text("units", entry.unit).text("grid_mapping", mapping))
    };
    Ok(Layout {
        whole: Variable::new("")
            .text("Conventions", "CF-1.8")
            .text("title", snapshot.title())
            .text("source", concat!("landform ", env!("CARGO_PKG_VERSION")))
            .text("seed", &snapshot.clock().seed.to_string())
            .number("spacing_m", lattice.spacing()),
        record: Variable::new("iteration").text("long_name", "iterations done").text("units", "1"),
        axes,
        fields: fields.iter().map(field).collect::<Result<_, Problem>>()?,
        system,
    })
}

/// The axis of layers, with the heights of their middles.
fn layers(depth: usize, spacing_m: f64) -> Axis {
    let variable = Variable::new("z")
        .text("long_name", "height above the lower border")
        .text("units", "m")
        .text("positive", "up")
        .text("axis", "Z");
    Axis { variable, values: (0..depth).map(|layer| (layer as f64 + 0.5) * spacing_m).collect() }
}
