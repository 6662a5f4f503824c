//! The models in Landform: whole runs, with everything that a run checks.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use cpu_time::ThreadTime;
use landform::sim::scenario::ScenarioSource;
use landform::sim::simulation::{Limits, Progress, Report, Simulation};

use crate::model::{Model, SEED, Timed};

/// Runs a process for so many steps.
pub fn run(model: Model, process: &str, side: usize, steps: usize) -> Timed {
    let border = if model.wraps() { "Periodic" } else { "Open" };
    let text = format!(
        "(title: \"peers\", seed: {SEED}, measure_every: {},
          domain: Grid(size: ({side}, {side}), connectivity: Eight, boundary: ({border}, {border})),
          stages: [(processes: [{process}], stop: Iterations({steps}))])",
        steps + 1
    );
    let source = ScenarioSource::from_text("peers.ron", &text, Path::new(""));
    let scenario = source.parse(&Arc::new(landform::registry())).expect("a scenario");
    let mut run = Simulation::new(scenario, Path::new(""), Limits::default()).expect("a run");
    let mut nanoseconds = Vec::new();
    let mut since = ThreadTime::now();
    let mut hook = |progress: &Progress<'_>| {
        if progress.iteration > 0 {
            nanoseconds.push(since.elapsed().as_nanos() as f64);
        }
        since = ThreadTime::now();
        ControlFlow::Continue(())
    };
    run.run(Path::new(""), &mut hook, &mut Report::default()).expect("a run to its end");
    let snapshot = run.snapshot();
    // Agents tell where they are by fields of their own names.
    let names = ["cells", "forest", "alive"];
    let cells = names.iter().find_map(|name| snapshot.field(name).ok()).expect("a field of cells");
    Timed { nanoseconds, cells: cells.iter().map(|&cell| cell as u8).collect() }
}
