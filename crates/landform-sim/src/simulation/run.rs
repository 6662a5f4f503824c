//! The loop: stages, iterations, measurements, outputs, stop rules.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use super::stage;
use super::turn::Turn;
use super::{Progress, ProgressHook, Report, RunError, Simulation, StageReport};
use crate::clock::Clock;
use crate::output::{Moment, OutputFile};
use crate::parameters::Problem;
use crate::snapshot::Snapshot;
use crate::text::nearest;

impl Simulation {
    /// Runs all stages. Outputs write into `folder`, which must exist.
    ///
    /// # Errors
    /// See [`RunError`]. `report` holds what was done until then in any case.
    pub fn run(
        &mut self,
        folder: &Path,
        hook: &mut dyn ProgressHook,
        report: &mut Report,
    ) -> Result<(), RunError> {
        let start = Instant::now();
        let result = self.run_stages(folder, hook, report);
        self.summarise(report);
        report.seconds = start.elapsed().as_secs_f64();
        result
    }

    /// The run as metrics and outputs see it now.
    pub fn snapshot(&self) -> Snapshot<'_> {
        let stage = self.app.world().resource::<Clock>().stage;
        let name = self.stages.get(stage).map_or("", |stage| stage.name.as_str());
        Snapshot::new(self.app.world(), &self.domain, &self.title, name)
    }

    fn run_stages(
        &mut self,
        folder: &Path,
        hook: &mut dyn ProgressHook,
        report: &mut Report,
    ) -> Result<(), RunError> {
        self.measure()?;
        report.initial_metrics = self.latest_metrics();
        report.outputs.extend(self.observe(Moment::Start, folder)?);
        for stage in 0..self.stages.len() {
            let mut clock = self.app.world_mut().resource_mut::<Clock>();
            (clock.stage, clock.iteration) = (stage, 0);
            let start = Instant::now();
            report.stages.push(StageReport {
                name: self.stages[stage].name.clone(),
                processes: names(&self.stages[stage]),
                ..StageReport::default()
            });
            let result = self.run_stage(stage, folder, hook, report);
            let metrics = self.latest_metrics();
            if let Some(summary) = report.stages.last_mut() {
                summary.iterations = self.app.world().resource::<Clock>().iteration;
                summary.seconds = start.elapsed().as_secs_f64();
                summary.metrics = metrics;
                summary.stopped = match &result {
                    Ok(reason) => reason.clone(),
                    Err(error) => error.to_string(),
                };
            }
            result?;
        }
        report.outputs.extend(self.observe(Moment::End, folder)?);
        Ok(())
    }

    /// Runs one stage and says why it was over.
    fn run_stage(
        &mut self,
        stage: usize,
        folder: &Path,
        hook: &mut dyn ProgressHook,
        report: &mut Report,
    ) -> Result<String, RunError> {
        let ends = self.stages[stage].ends();
        let expected = self.stages[stage].stop.latest_end(&ends);
        let mut turns = stage::begin(&mut self.app, &self.stages[stage].processes)?;
        self.tell(stage, 0, expected, hook)?;
        loop {
            let iteration = self.iterate(&mut turns)?;
            let reason = |run: &Self| run.stages[stage].stop.reason(iteration, &ends, &run.series);
            // A rule on a metric looks at fresh measurements only.
            let due = iteration.is_multiple_of(self.measure_every);
            if due && self.measure()? {
                self.check_rule(stage)?;
            }
            report.outputs.extend(self.observe(Moment::Iteration, folder)?);
            if let Some(reason) = reason(self) {
                if !due {
                    self.measure()?;
                }
                report.outputs.extend(self.observe(Moment::StageEnd, folder)?);
                self.tell(stage, iteration, expected, hook)?;
                return Ok(reason);
            }
            self.tell(stage, iteration, expected, hook)?;
        }
    }

    fn iterate(&mut self, turns: &mut [Turn]) -> Result<u64, RunError> {
        stage::iterate(&mut self.app, turns)?;
        let mut clock = self.app.world_mut().resource_mut::<Clock>();
        clock.tick += 1;
        clock.iteration += 1;
        Ok(clock.iteration)
    }

    fn tell(
        &self,
        stage: usize,
        iteration: u64,
        iterations: Option<u64>,
        hook: &mut dyn ProgressHook,
    ) -> Result<(), RunError> {
        let progress = Progress {
            stage,
            stages: self.stages.len(),
            stage_name: &self.stages[stage].name,
            iteration,
            iterations,
        };
        match hook.progress(&progress) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => {
                Err(RunError::Interrupted { iterations: self.app.world().resource::<Clock>().tick })
            }
        }
    }

    /// Refuses a stop rule on a metric that nothing measures, once every metric has spoken.
    fn check_rule(&self, stage: usize) -> Result<(), RunError> {
        let known = self.series.names();
        let wanted = self.stages[stage].stop.metrics();
        let Some(name) = wanted.into_iter().find(|name| known.iter().all(|known| known != name))
        else {
            return Ok(());
        };
        let message = format!("nothing measures `{name}`, so the stage would never end");
        let expected = format!("one of {}", known.join(", "));
        let mut problem = Problem::new(format!("stages[{stage}].stop"), message, expected);
        if let Some(guess) = nearest(name, known.iter().map(String::as_str)) {
            problem = problem.help(format!("did you mean {guess:?}?"));
        }
        Err(recording("stop rule", problem))
    }

    /// Measures all metrics and says whether each of them had something to tell.
    fn measure(&mut self) -> Result<bool, RunError> {
        let mut metrics = std::mem::take(&mut self.metrics);
        let snapshot = self.snapshot();
        let mut row = Vec::new();
        let mut measured = Ok(true);
        for metric in &mut metrics {
            match metric.value.measure(&snapshot) {
                Ok(values) if values.is_empty() => measured = Ok(false),
                Ok(values) => row.extend(values),
                Err(problem) => {
                    measured = Err(recording(metric.name, problem));
                    break;
                }
            }
        }
        let tick = snapshot.clock().tick;
        self.metrics = metrics;
        self.series.push(tick, row);
        measured
    }

    fn observe(&mut self, moment: Moment, folder: &Path) -> Result<Vec<OutputFile>, RunError> {
        let mut sinks = std::mem::take(&mut self.sinks);
        let snapshot = self.snapshot();
        let mut files = Vec::new();
        let mut result = Ok(());
        for (name, sink) in &mut sinks {
            match sink.observe(moment, &snapshot, folder) {
                Ok(written) => files.extend(written),
                Err(problem) => {
                    result = Err(recording(name, problem));
                    break;
                }
            }
        }
        self.sinks = sinks;
        result.map(|()| files)
    }

    /// Latest value of each metric.
    fn latest_metrics(&self) -> BTreeMap<String, f64> {
        let latest = |name: &String| Some((name.clone(), self.series.latest(name)?));
        self.series.names().iter().filter_map(latest).collect()
    }

    fn summarise(&self, report: &mut Report) {
        let snapshot = self.snapshot();
        report.title = self.title.clone();
        report.seed = snapshot.clock().seed;
        report.version = env!("CARGO_PKG_VERSION").to_owned();
        report.size = self.domain.lattice.size();
        report.nodes = self.domain.lattice.node_count();
        report.spacing_m = self.domain.lattice.spacing();
        report.threads = rayon::current_num_threads();
        report.metrics = self.latest_metrics();
        report.ledger = snapshot.ledger().clone();
        report.warnings = self.warnings.clone();
    }
}

fn names(stage: &crate::scenario::StageEntry) -> Vec<String> {
    stage.processes.iter().map(|process| process.name.to_owned()).collect()
}

fn recording(name: &str, problem: Problem) -> RunError {
    RunError::Recording { name: name.to_owned(), problem }
}
