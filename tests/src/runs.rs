//! Scenarios run in memory, through everything but the command line.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use landform::sim::metric::Series;
use landform::sim::registry::Registry;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, Simulation};

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
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let folder = Path::new("");
            let source = ScenarioSource::from_text("test.ron", text, folder);
            let scenario =
                source.parse(&Arc::new(registry)).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert!(scenario.outputs.is_empty(), "nothing is written");
            let simulation = Simulation::new(scenario, folder, Limits::default());
            let mut simulation =
                simulation.unwrap_or_else(|problem| panic!("{}\n{text}", source.render(&problem)));
            let mut report = Report::default();
            let mut hook = |_: &Progress<'_>| ControlFlow::Continue(());
            let result = simulation.run(folder, &mut hook, &mut report);
            result.unwrap_or_else(|error| panic!("{error}\n{text}"));
            let snapshot = simulation.snapshot();
            let values = |name| snapshot.field(name).unwrap_or_else(|error| panic!("{error}"));
            let fields = snapshot.fields().map(|entry| (entry.name, values(entry.name))).collect();
            Self { fields, series: simulation.series().clone(), report }
        })
    }

    /// The values of a field at the end.
    pub fn field(&self, name: &str) -> &[f64] {
        let field = self.fields.iter().find(|(known, _)| *known == name);
        field.map(|(_, values)| values.as_slice()).unwrap_or_else(|| panic!("no field {name}"))
    }
}
