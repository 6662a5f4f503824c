//! Scenarios run in memory, through everything but the command line.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::{Arc, Mutex};

use landform::sim::checkpoint::Checkpoint;
use landform::sim::metric::Series;
use landform::sim::registry::Registry;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Keeper, Limits, Progress, Report, Simulation};

/// A run that has ended well.
pub struct Run {
    /// Names and values of all fields at the end, in the order of the run.
    pub fields: Vec<(&'static str, Vec<f64>)>,
    /// What was measured.
    pub series: Series,
    /// Its report.
    pub report: Report,
}

impl Run {
    /// Runs a scenario given as text, which must be good, on `threads` threads. It may have no
    /// outputs.
    pub fn of(text: &str, registry: Registry, threads: usize) -> Self {
        on(threads, || Self::finish(simulation(text, registry)))
    }

    /// As [`Run::of`], in two parts: up to `iteration` on the first number of threads, and from
    /// the checkpoint of then on by another simulation and the second number of threads.
    pub fn broken(
        text: &str,
        registry: fn() -> Registry,
        iteration: u64,
        threads: [usize; 2],
    ) -> Self {
        let kept = Arc::new(Mutex::new(None));
        on(threads[0], || {
            let mut first = simulation(text, registry());
            first.keep_checkpoints(Box::new(KeepOne { iteration, kept: Arc::clone(&kept) }));
            Self::finish(first)
        });
        let checkpoint = kept.lock().expect("the first part has ended").take();
        on(threads[1], || {
            let mut second = simulation(text, registry());
            let resumed = second.resume(checkpoint.expect("a checkpoint"), Path::new(""));
            resumed.unwrap_or_else(|damage| panic!("{damage}\n{text}"));
            Self::finish(second)
        })
    }

    /// Runs a simulation to its end.
    fn finish(mut simulation: Simulation) -> Self {
        let mut report = Report::default();
        let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
        let result = simulation.run(Path::new(""), &mut hook, &mut report);
        result.unwrap_or_else(|error| panic!("{error}"));
        let snapshot = simulation.snapshot();
        let values = |name| snapshot.field(name).unwrap_or_else(|error| panic!("{error}"));
        let fields = snapshot.fields().map(|entry| (entry.name, values(entry.name))).collect();
        Self { fields, series: simulation.series().clone(), report }
    }

    /// The values of a field at the end.
    pub fn field(&self, name: &str) -> &[f64] {
        let field = self.fields.iter().find(|(known, _)| *known == name);
        field.map(|(_, values)| values.as_slice()).unwrap_or_else(|| panic!("no field {name}"))
    }
}

/// Works on so many threads.
fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads").install(work)
}

/// A simulation that is ready to run.
fn simulation(text: &str, registry: Registry) -> Simulation {
    let folder = Path::new("");
    let source = ScenarioSource::from_text("test.ron", text, folder);
    let scenario =
        source.parse(&Arc::new(registry)).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert!(scenario.outputs.is_empty(), "nothing is written");
    let simulation = Simulation::new(scenario, folder, Limits::default());
    simulation.unwrap_or_else(|problem| panic!("{}\n{text}", source.render(&problem)))
}

/// Keeps the checkpoint of one iteration.
struct KeepOne {
    iteration: u64,
    kept: Arc<Mutex<Option<Checkpoint<'static>>>>,
}

impl Keeper for KeepOne {
    fn is_due(&mut self, progress: &Progress<'_>) -> bool {
        progress.iteration == self.iteration
    }

    fn keep(&mut self, checkpoint: Checkpoint<'_>) -> Result<(), String> {
        *self.kept.lock().map_err(|error| error.to_string())? = Some(checkpoint.into_owned());
        Ok(())
    }
}
