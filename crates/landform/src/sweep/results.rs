//! What the runs of a sweep left.

use std::fs;
use std::path::{Path, PathBuf};

use landform_sim::text::nearest;
use serde_json::Value;

use super::{Outcome, Plan, PlannedRun, Status, plot, sheet, table};

/// A run with what it left.
pub(super) struct Finished<'p> {
    /// The run.
    pub run: &'p PlannedRun,
    /// How it ended; none while it is not over.
    pub outcome: Option<Outcome>,
    /// Iterations of all stages, for runs that are done.
    pub iterations: Option<u64>,
    /// Last values of its metrics, for runs that are done.
    pub metrics: Vec<(String, f64)>,
    /// Its first picture.
    pub picture: Option<PathBuf>,
}

/// A sweep with everything that its runs left.
pub(crate) struct Results<'p> {
    pub(super) plan: &'p Plan,
    pub(super) runs: Vec<Finished<'p>>,
}

impl<'p> Results<'p> {
    /// Reads what lies below the folder of a sweep.
    pub fn read(plan: &'p Plan, folder: &Path) -> Self {
        let read = |run| finished(run, &folder.join(plan.folder_of(run)));
        Self { plan, runs: plan.runs.iter().map(read).collect() }
    }

    /// Number of runs that ended so; of those that are not over for none.
    pub fn count(&self, status: Option<Status>) -> usize {
        let ended = |run: &&Finished| run.outcome.as_ref().map(|own| own.status) == status;
        self.runs.iter().filter(ended).count()
    }

    /// Why the first run that failed did so, with its number.
    pub fn first_failure(&self) -> Option<(usize, &str)> {
        self.runs.iter().find_map(|run| match &run.outcome {
            Some(own) if own.status == Status::Failed => Some((run.run.number, &*own.reason)),
            _ => None,
        })
    }

    /// Writes the table, and the contact sheet and the plots where there is something to show.
    /// Returns the names of the files.
    ///
    /// # Errors
    /// A message when a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<Vec<&'static str>, String> {
        crate::program::write_text(&folder.join("table.csv"), &table::csv(self))?;
        let mut files = vec!["table.csv"];
        if sheet::write(self, &folder.join("pictures.png"))? {
            files.push("pictures.png");
        }
        if plot::write(self, folder)? {
            files.extend(["plots.png", "plots.svg"]);
        }
        Ok(files)
    }

    /// What is wrong with plots that the sweep asks for: metrics that no run measured.
    pub fn unmeasured(&self) -> Vec<String> {
        let known = self.metric_names();
        let asked = self.plan.plots.iter().map(|plot| plot.metric.as_str());
        let unknown = asked.filter(|asked| !known.is_empty() && !known.iter().any(|k| k == asked));
        let note = |metric| match nearest(metric, known.iter().map(String::as_str)) {
            Some(near) => format!(
                "no run measured {metric:?}, which is to be plotted; did you mean {near:?}?"
            ),
            None => format!(
                "no run measured {metric:?}, which is to be plotted; there are {}",
                known.join(", ")
            ),
        };
        unknown.map(note).collect()
    }

    /// Names of all metrics, in alphabetical order.
    pub(super) fn metric_names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.runs.iter().flat_map(|run| &run.metrics).map(|(name, _)| name.clone()).collect();
        names.sort();
        names.dedup();
        names
    }
}

impl Finished<'_> {
    /// The last value of a metric.
    pub fn metric(&self, name: &str) -> Option<f64> {
        self.metrics.iter().find(|(known, _)| known == name).map(|(_, value)| *value)
    }
}

fn finished<'p>(run: &'p PlannedRun, folder: &Path) -> Finished<'p> {
    let outcome = Outcome::read(folder).filter(|outcome| outcome.digest == run.digest);
    let mut finished =
        Finished { run, outcome, iterations: None, metrics: Vec::new(), picture: None };
    let done = finished.outcome.as_ref().is_some_and(|own| own.status == Status::Done);
    let report = fs::read_to_string(folder.join("report.json")).ok().filter(|_| done);
    let report: Option<Value> = report.and_then(|text| serde_json::from_str(&text).ok());
    let Some(report) = report else {
        // A run without its report has to be run again.
        finished.outcome = finished.outcome.filter(|own| own.status == Status::Failed);
        return finished;
    };
    let stages = report["stages"].as_array().into_iter().flatten();
    finished.iterations = Some(stages.filter_map(|stage| stage["iterations"].as_u64()).sum());
    let metrics = report["metrics"].as_object().into_iter().flatten();
    finished.metrics =
        metrics.filter_map(|(name, value)| Some((name.clone(), value.as_f64()?))).collect();
    let mut outputs = report["outputs"].as_array().into_iter().flatten();
    finished.picture = outputs.find_map(|output| {
        let file = output["file"].as_str().filter(|_| output["kind"] == "picture")?;
        Some(folder.join(file))
    });
    finished
}
