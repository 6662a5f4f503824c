//! What happened while caves grew, as a table.

use std::io::Write;
use std::path::{Path, PathBuf};

use landform_caves::CaveHistory;
use landform_caves::record::{CaveEvent, CaveEventKind};
use landform_graph::Lattice;
use landform_io::{IfExists, write_atomically};
use landform_sim::checkpoint::{Damage, Loader, Saver};
use landform_sim::output::{Moment, Output, OutputFile, Sink, below, check_file};
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::explain::file_problem;

/// Every event in the growth of caves as comma-separated values: `link`s of two sources that do not
/// drain yet, `breakthrough`s to a sink, `capture`s of tributaries, and each `phreatic_loop` on the
/// course of a source that comes to drain; with the stage and its iteration, the numbers of the
/// sources (from 1), the place in metres from the lower south-western voxel, how far the course or the
/// loop goes up, and the length of the course to the sink. The metric `CaveCourses` counts them.
///
/// The place is where the course meets the one it joins, where it ends at a sink, where it turns up,
/// or for a link a voxel of the passages that join both.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CaveEventTable {
    /// File name below the output folder.
    pub file: PathBuf,
}

impl Default for CaveEventTable {
    fn default() -> Self {
        Self { file: "cave_events.csv".into() }
    }
}

impl Output for CaveEventTable {
    const NAME: &'static str = "CaveEventTable";

    fn fields(&self) -> Vec<String> {
        vec!["pressure".to_owned()]
    }

    fn file(&self) -> Option<&Path> {
        Some(&self.file)
    }

    fn validate(&self, _: &Lattice) -> Result<(), Problem> {
        check_file(&self.file, &["csv"])
    }

    fn open(&self) -> Box<dyn Sink> {
        Box::new(EventSink { settings: self.clone(), events: Vec::new() })
    }
}

/// The events of the stages that ended, with their stage.
struct EventSink {
    settings: CaveEventTable,
    events: Vec<(String, CaveEvent)>,
}

impl Sink for EventSink {
    fn observe(
        &mut self,
        moment: Moment,
        snapshot: &Snapshot<'_>,
        folder: &Path,
    ) -> Result<Vec<OutputFile>, Problem> {
        match moment {
            Moment::Start | Moment::Iteration => Ok(Vec::new()),
            Moment::StageEnd => {
                self.gather(snapshot);
                Ok(Vec::new())
            }
            Moment::End => self.write(snapshot, folder),
        }
    }

    fn save<'a>(&'a mut self, to: &mut Saver<'_, 'a>) -> Result<(), Problem> {
        to.value("events", &self.events);
        Ok(())
    }

    fn restore(&mut self, from: &Loader<'_>, _: &Snapshot<'_>, _: &Path) -> Result<(), Damage> {
        self.events = from.value("events")?;
        Ok(())
    }
}

impl EventSink {
    /// Takes over the events of a stage that ended. What an earlier stage left behind is known.
    fn gather(&mut self, snapshot: &Snapshot<'_>) {
        let Some(CaveHistory(record)) = snapshot.world().get_resource::<CaveHistory>() else {
            return;
        };
        let known = self.events.iter().map(|(_, event)| event);
        let is_known = !record.events.is_empty()
            && known.rev().take(record.events.len()).eq(record.events.iter().rev());
        if !is_known {
            let stage = snapshot.stage_name();
            self.events.extend(record.events.iter().map(|event| (stage.to_owned(), event.clone())));
        }
    }

    fn write(&self, snapshot: &Snapshot<'_>, folder: &Path) -> Result<Vec<OutputFile>, Problem> {
        let path = below(folder, &self.settings.file)?;
        let written = write_atomically(&path, IfExists::Replace, |file| {
            writeln!(file, "stage,iteration,event,source,other,x,y,z,rise_m,length_m")?;
            self.events.iter().try_for_each(|(stage, event)| {
                let stage = quoted(stage);
                writeln!(file, "{stage},{}", row(snapshot.lattice(), event))
            })
        });
        written.map_err(|error| file_problem("file", &error))?;
        Ok(vec![OutputFile { file: self.settings.file.clone(), kind: "table".to_owned() }])
    }
}

/// An event as the columns from the iteration on.
fn row(lattice: &Lattice, event: &CaveEvent) -> String {
    let kind = match event.kind {
        CaveEventKind::Link => "link",
        CaveEventKind::Breakthrough => "breakthrough",
        CaveEventKind::Capture => "capture",
        CaveEventKind::PhreaticLoop => "phreatic_loop",
    };
    let other = event.other.map_or_else(String::new, |other| (other + 1).to_string());
    let at = lattice.position(event.node as usize);
    let CaveEvent { iteration, source, rise_m, length_m, .. } = event;
    format!(
        "{iteration},{kind},{},{other},{:?},{:?},{:?},{rise_m:?},{length_m:?}",
        source + 1,
        at.x,
        at.y,
        at.z
    )
}

/// A name between quotation marks where it needs them.
fn quoted(name: &str) -> String {
    match name.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.to_owned(),
    }
}
