//! Checkpoints of a run: everything that it needs goes in, and comes back.

use std::path::Path;

use bevy_ecs::world::World;
use serde::{Deserialize, Serialize};

use super::state::State;
use super::{Progress, Report, RunError, Simulation};
use crate::checkpoint::{Checkpoint, Damage};
use crate::clock::Clock;

/// Says when checkpoints are due and puts them away.
pub trait Keeper {
    /// Whether a checkpoint is due now. Asked when a stage begins and after each iteration.
    fn is_due(&mut self, progress: &Progress<'_>) -> bool;

    /// Puts a checkpoint away, in the place of the one before.
    ///
    /// # Errors
    /// A message that says why that was impossible. The run goes on and warns of it.
    fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String>;
}

/// Version of the contents of checkpoints; others are refused.
const FORMAT: u32 = 1;

/// Name of the text that says which run a checkpoint is of, and how far it was.
const MANIFEST: &str = "manifest.json";

/// Which run a checkpoint is of, and how far it was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Manifest {
    format: u32,
    version: String,
    title: String,
    seed: u64,
    size: [usize; 3],
    spacing_m: f64,
    /// Hash of the fields before the first iteration.
    start: String,
    /// Names of the processes of each stage.
    stages: Vec<Vec<String>>,
    stage: usize,
    stage_is_over: bool,
    /// Iterations of the stage that are done.
    iteration: u64,
    /// Iterations of the run that are done.
    tick: u64,
}

/// A checkpoint that a run goes on from.
pub(super) struct Resumed {
    checkpoint: Checkpoint<'static>,
    clock: Clock,
    stage_is_over: bool,
    /// The report of the run so far.
    pub(super) report: Report,
}

impl Resumed {
    /// The stage to go on with.
    pub(super) fn stage(&self) -> usize {
        self.clock.stage + usize::from(self.stage_is_over)
    }

    /// Whether the stage to go on with had begun.
    pub(super) fn is_within_stage(&self) -> bool {
        !self.stage_is_over
    }

    /// Shows the world as it was, at the time when its stage began: what `Begin` is to see.
    pub(super) fn prepare(&self, state: &State, world: &mut World) -> Result<(), RunError> {
        let tick = self.clock.tick.saturating_sub(self.clock.iteration);
        let clock = Clock { tick, iteration: 0, ..self.clock };
        Ok(state.restore(world, &self.checkpoint, clock)?)
    }

    /// Puts everything back as it was.
    pub(super) fn restore(&self, state: &State, world: &mut World) -> Result<(), RunError> {
        Ok(state.restore(world, &self.checkpoint, self.clock)?)
    }
}

impl Simulation {
    /// From now on `keeper` is asked for checkpoints.
    pub fn keep_checkpoints(&mut self, keeper: Box<dyn Keeper>) {
        if self.start.is_empty() {
            self.start = self.state.hash_of_fields(self.app.world());
        }
        self.keeper = Some(keeper);
    }

    /// Takes over the state of a checkpoint of the same scenario, before the run;
    /// [`Simulation::run`] goes on from there. Outputs go on with their files in `folder`.
    ///
    /// # Errors
    /// What differs, is missing or cannot be used. The simulation is of no use then.
    pub fn resume(&mut self, checkpoint: Checkpoint<'static>, folder: &Path) -> Result<(), Damage> {
        self.start = self.state.hash_of_fields(self.app.world());
        let (clock, stage_is_over) = self.check_manifest(&checkpoint)?;
        let report: Report = checkpoint.loader("run").value("report")?;
        if clock.stage >= self.stages.len() || report.stages.len() != clock.stage + 1 {
            return Err(checkpoint.loader("run").refuse("report", "its stages do not fit"));
        }
        self.state.restore(self.app.world_mut(), &checkpoint, clock)?;
        self.series = checkpoint.loader("").keep("series")?;
        for (index, (_, meter)) in self.metrics.iter_mut().enumerate() {
            meter.restore(&checkpoint.loader(format!("metrics/{index}")))?;
        }
        let mut sinks = std::mem::take(&mut self.sinks);
        for (index, (_, sink)) in sinks.iter_mut().enumerate() {
            let from = checkpoint.loader(format!("outputs/{index}"));
            sink.restore(&from, &self.snapshot(), folder)?;
        }
        self.sinks = sinks;
        self.resumed = Some(Resumed { checkpoint, clock, stage_is_over, report });
        Ok(())
    }

    /// Everything that the run needs to go on later.
    pub(super) fn checkpoint(
        &mut self,
        stage_is_over: bool,
        report: &Report,
    ) -> Result<Checkpoint<'_>, RunError> {
        self.state.check(self.app.world(), "a process of the stage")?;
        let manifest = self.manifest(stage_is_over);
        let mut checkpoint = Checkpoint::default();
        checkpoint.texts.insert(MANIFEST.to_owned(), manifest.text());
        for (index, (name, sink)) in self.sinks.iter_mut().enumerate() {
            sink.save(&mut checkpoint.saver(format!("outputs/{index}")))
                .map_err(|problem| super::run::recording(name, problem))?;
        }
        for (index, (_, meter)) in self.metrics.iter().enumerate() {
            meter.save(&mut checkpoint.saver(format!("metrics/{index}")));
        }
        checkpoint.saver("").keep("series", &self.series);
        checkpoint.saver("run").value("report", report);
        self.state.save(self.app.world(), &mut checkpoint);
        checkpoint.check()?;
        Ok(checkpoint)
    }

    fn manifest(&self, stage_is_over: bool) -> Manifest {
        let Clock { tick, iteration, stage, seed } = *self.app.world().resource::<Clock>();
        Manifest {
            format: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: self.title.clone(),
            seed,
            size: self.domain.lattice.size(),
            spacing_m: self.domain.lattice.spacing(),
            start: self.start.clone(),
            stages: self.stages.iter().map(super::run::names).collect(),
            stage,
            stage_is_over,
            iteration,
            tick,
        }
    }

    /// Refuses checkpoints of other runs. Gives the clock and whether the stage was over.
    fn check_manifest(&self, checkpoint: &Checkpoint<'_>) -> Result<(Clock, bool), Damage> {
        let found = Manifest::of(checkpoint)?;
        found.check_is_of(&self.manifest(found.stage_is_over))?;
        let Manifest { tick, iteration, stage, seed, stage_is_over, .. } = found;
        Ok((Clock { tick, iteration, stage, seed }, stage_is_over))
    }
}

impl Manifest {
    fn text(&self) -> String {
        // Strings, whole numbers and a spacing that is finite can always be written.
        serde_json::to_string_pretty(self).unwrap_or_default()
    }

    fn of(checkpoint: &Checkpoint<'_>) -> Result<Self, Damage> {
        let name = MANIFEST.to_owned();
        let Some(text) = checkpoint.texts.get(MANIFEST) else {
            return Err(Damage::Missing { name });
        };
        serde_json::from_str(text)
            .map_err(|error| Damage::Value { name, message: error.to_string() })
    }

    /// Refuses the manifest of another run than `present`.
    fn check_is_of(&self, present: &Self) -> Result<(), Damage> {
        let of = |manifest: &Self| -> [(&'static str, String); 7] {
            let Manifest { format, version, seed, size, spacing_m, start, stages, .. } = manifest;
            let processes: Vec<String> = stages.iter().map(|stage| stage.join(", ")).collect();
            [
                ("format", format.to_string()),
                ("version of Landform", version.clone()),
                ("seed", seed.to_string()),
                ("size of the domain", format!("{size:?}")),
                ("spacing in metres", spacing_m.to_string()),
                ("list of stages", processes.join("; ")),
                ("ground at the start (hash of all fields)", start.clone()),
            ]
        };
        let pairs = of(self).into_iter().zip(of(present));
        for ((what, found), (_, expected)) in pairs {
            if found != expected {
                return Err(Damage::Foreign { what, found, expected });
            }
        }
        Ok(())
    }
}
