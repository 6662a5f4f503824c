//! The loop: stages, iterations, measurements, outputs, stop rules.

use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

use bevy_ecs::world::World;

use super::checkpoint::Resumed;
use super::stage;
use super::turn::Turn;
use super::{Progress, ProgressHook, Report, RunError, Simulation, StageReport};
use crate::clock::Clock;
use crate::code::Code;
use crate::notes::Notes;
use crate::output::{Moment, OutputFile, Sink};
use crate::parameters::Problem;
use crate::scenario::StageEntry;
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
        let result = result.and(self.flush());
        self.summarise(report);
        report.seconds += start.elapsed().as_secs_f64();
        report.finished = result.is_ok();
        result
    }

    /// The run as metrics and outputs see it now.
    pub fn snapshot(&self) -> Snapshot<'_> {
        let stage = self.app.world().resource::<Clock>().stage;
        let name = self.stages.get(stage).map_or("", |stage| stage.name.as_str());
        Snapshot::new(self.app.world(), &self.domain, &self.title, name, &self.series)
    }

    fn run_stages(
        &mut self,
        folder: &Path,
        hook: &mut dyn ProgressHook,
        report: &mut Report,
    ) -> Result<(), RunError> {
        let mut resumed = self.resumed.take();
        let first = resumed.as_ref().map_or(0, Resumed::stage);
        match &mut resumed {
            Some(resumed) => *report = std::mem::take(&mut resumed.report),
            None => {
                self.measure()?;
                report.initial_metrics = self.latest_metrics();
                report.outputs.extend(self.observe(Moment::Start, folder)?);
            }
        }
        let mut within = resumed.filter(Resumed::is_within_stage);
        for stage in first..self.stages.len() {
            let result = self.run_stage(stage, within.take(), folder, hook, report);
            let reason = match result {
                Ok(reason) => reason,
                Err(error) => {
                    self.close_stage(report, error.to_string());
                    return Err(error);
                }
            };
            self.close_stage(report, reason);
            self.tell(stage, true, hook, report)?;
        }
        report.outputs.extend(self.observe(Moment::End, folder)?);
        Ok(())
    }

    /// Runs one stage, from `resumed` on if it is given, and says why it was over.
    fn run_stage(
        &mut self,
        stage: usize,
        resumed: Option<Resumed>,
        folder: &Path,
        hook: &mut dyn ProgressHook,
        report: &mut Report,
    ) -> Result<String, RunError> {
        let mut turns = match resumed {
            Some(resumed) => self.begin_again(&resumed)?,
            None => self.begin(stage, report)?,
        };
        let ends = self.stages[stage].ends();
        self.tell(stage, false, hook, report)?;
        loop {
            let start = Instant::now();
            let iteration = self.iterate(&mut turns)?;
            let tick = self.app.world().resource::<Clock>().tick;
            let now = [iteration, tick];
            let reason = |run: &Self| run.stages[stage].stop.reason(now, &ends, &run.series);
            // A rule on a metric looks at fresh measurements only.
            let due = iteration.is_multiple_of(self.measure_every);
            if due && self.measure()? {
                self.check_rules(stage)?;
            }
            let reason = reason(self);
            if reason.is_some() && !due {
                self.measure()?;
            }
            report.outputs.extend(self.observe(Moment::Iteration, folder)?);
            if reason.is_some() {
                report.outputs.extend(self.observe(Moment::StageEnd, folder)?);
            }
            if let Some(summary) = report.stages.last_mut() {
                summary.seconds += start.elapsed().as_secs_f64();
            }
            match reason {
                Some(reason) => return Ok(reason),
                None => self.tell(stage, false, hook, report)?,
            }
        }
    }

    /// Begins a stage.
    fn begin(&mut self, stage: usize, report: &mut Report) -> Result<Vec<Turn>, RunError> {
        let mut clock = self.app.world_mut().resource_mut::<Clock>();
        (clock.stage, clock.iteration) = (stage, 0);
        report.stages.push(StageReport {
            name: self.stages[stage].name.clone(),
            processes: names(&self.stages[stage]),
            ..StageReport::default()
        });
        stage::begin(&mut self.app, &self.stages[stage].processes, &self.state, |_| Ok(()))
    }

    /// Begins the stage of a checkpoint once more, for what follows from the fields, and puts the
    /// state of the checkpoint in its place.
    fn begin_again(&mut self, resumed: &Resumed) -> Result<Vec<Turn>, RunError> {
        let Self { app, stages, state, .. } = self;
        let prepare = |world: &mut World| resumed.prepare(state, world);
        let turns = stage::begin(app, &stages[resumed.stage()].processes, state, prepare)?;
        resumed.restore(state, app.world_mut())?;
        Ok(turns)
    }

    /// Completes the report of the stage at hand.
    fn close_stage(&self, report: &mut Report, reason: String) {
        if let Some(summary) = report.stages.last_mut() {
            summary.iterations = self.app.world().resource::<Clock>().iteration;
            summary.metrics = self.latest_metrics();
            summary.stopped = reason;
        }
    }

    fn iterate(&mut self, turns: &mut [Turn]) -> Result<u64, RunError> {
        stage::iterate(&mut self.app, turns)?;
        let mut clock = self.app.world_mut().resource_mut::<Clock>();
        clock.tick += 1;
        clock.iteration += 1;
        Ok(clock.iteration)
    }

    /// Tells the hook where the run stands, and keeps a checkpoint when one is due or the run is to
    /// end here.
    fn tell(
        &mut self,
        stage: usize,
        stage_is_over: bool,
        hook: &mut dyn ProgressHook,
        report: &mut Report,
    ) -> Result<(), RunError> {
        self.take_notes(report);
        let clock = *self.app.world().resource::<Clock>();
        let stages = self.stages.len();
        let entry = &self.stages[stage];
        let progress = Progress {
            stage,
            stages,
            stage_name: &entry.name,
            iteration: clock.iteration,
            iterations: entry.stop.latest_end(&entry.ends()),
            notes: self.app.world().resource::<Notes>().all(),
        };
        let ends = hook.progress(&progress).is_break();
        let due = self.keeper.as_mut().is_some_and(|keeper| keeper.is_due(&progress) || ends);
        let kept = due && self.keep(stage_is_over, report)?;
        match ends {
            true => Err(RunError::Interrupted { iterations: clock.tick, kept }),
            false => Ok(()),
        }
    }

    /// Keeps a checkpoint; `false` when that was impossible.
    fn keep(&mut self, stage_is_over: bool, report: &Report) -> Result<bool, RunError> {
        let Some(mut keeper) = self.keeper.take() else { return Ok(false) };
        let kept = keeper.keep(self.checkpoint(stage_is_over, report)?);
        self.keeper = Some(keeper);
        let Err(message) = kept else { return Ok(true) };
        if !self.warnings.contains(&message) {
            self.warnings.push(message);
        }
        Ok(false)
    }

    /// Refuses a stop rule or a schedule on a metric that nothing measures, once every metric
    /// has spoken.
    fn check_rules(&self, stage: usize) -> Result<(), RunError> {
        let known = self.series.names();
        let stop = self.stages[stage].stop.metrics().into_iter();
        let stop = stop.map(|name| (name, "stop rule", None));
        let outputs = self.schedules.iter();
        let outputs = outputs.map(|(name, output, path)| (name.as_str(), *output, Some(path)));
        let unknown = stop.chain(outputs).find(|(name, ..)| known.iter().all(|each| each != name));
        let Some((name, what, path)) = unknown else { return Ok(()) };
        let path = path.cloned().unwrap_or_else(|| format!("stages[{stage}].stop"));
        let message = format!("nothing measures `{name}`, so this never happens");
        let mut problem =
            Problem::new(path, message, format!("one of {}", known.join(", "))).code(Code::Never);
        if let Some(guess) = nearest(name, known.iter().map(String::as_str)) {
            problem = problem.help(format!("did you mean {guess:?}?"));
        }
        Err(recording(what, problem))
    }

    /// Measures all metrics and says whether each of them had something to tell.
    fn measure(&mut self) -> Result<bool, RunError> {
        let mut metrics = std::mem::take(&mut self.metrics);
        let snapshot = self.snapshot();
        let mut row = Vec::new();
        let mut measured = Ok(true);
        for (name, meter) in &mut metrics {
            match meter.measure(&snapshot) {
                Ok(values) if values.is_empty() => measured = Ok(false),
                Ok(values) => row.extend(values),
                Err(problem) => {
                    measured = Err(recording(name, problem));
                    break;
                }
            }
        }
        let tick = snapshot.clock().tick;
        self.metrics = metrics;
        if measured.is_ok() {
            self.series.push(tick, row);
        }
        measured
    }

    /// Brings to the disk what outputs hold back.
    fn flush(&mut self) -> Result<(), RunError> {
        let flush = |(name, sink): &mut (&'static str, Box<dyn Sink>)| {
            sink.flush().map_err(|problem| recording(name, problem))
        };
        // One that fails must not keep the others from trying.
        let results: Vec<_> = self.sinks.iter_mut().map(flush).collect();
        results.into_iter().collect()
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

    /// Puts the notes of processes into the report, after those of the runs that this one goes on
    /// with.
    fn take_notes(&self, report: &mut Report) {
        for note in self.app.world().resource::<Notes>().all() {
            if !report.notes.contains(note) {
                report.notes.push(note.clone());
            }
        }
    }

    fn summarise(&self, report: &mut Report) {
        self.take_notes(report);
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

/// Names of the processes of a stage.
pub(super) fn names(stage: &StageEntry) -> Vec<String> {
    stage.processes.iter().map(|process| process.name.to_owned()).collect()
}

/// The failure of a metric or an output.
pub(super) fn recording(name: &str, problem: Problem) -> RunError {
    RunError::Recording { name: name.to_owned(), problem: Box::new(problem) }
}
