//! Checks of a scenario that need no domain: ranges, stages, stop rules, repeated names.

use std::path::Path;

use super::{Scenario, StageEntry};
use crate::code::Code;
use crate::parameters::Problem;
use crate::registry::{AnyOutput, AnyParameters, Chosen};
use crate::simulation::{Limits, Needs};

impl Scenario {
    /// Everything wrong with the scenario that its text alone shows, with full paths.
    pub(crate) fn problems(&self) -> Vec<Problem> {
        let mut problems = ranges("domain", &self.domain);
        for (index, entry) in self.initial.iter().enumerate() {
            problems.extend(ranges(&format!("initial[{index}].from"), &entry.from));
        }
        for (index, metric) in self.metrics.iter().enumerate() {
            problems.extend(ranges(&format!("metrics[{index}]"), metric));
        }
        for (index, output) in self.outputs.iter().enumerate() {
            problems.extend(ranges(&format!("outputs[{index}]"), output));
        }
        for (index, stage) in self.stages.iter().enumerate() {
            problems.extend(
                stage
                    .problems()
                    .into_iter()
                    .map(|problem| below(&format!("stages[{index}]"), problem)),
            );
        }
        let waits = |stage: &StageEntry| !stage.stop.metrics().is_empty();
        if let (true, Some(stage)) = (self.metrics.is_empty(), self.stages.iter().position(waits)) {
            let message = "the stop rule waits for a metric and the scenario measures none";
            let expected = "an entry in `metrics`, or another rule";
            let path = format!("stages[{stage}].stop");
            problems.push(Problem::new(path, message, expected).code(Code::Never));
        }
        let waits = |output: &Chosen<dyn AnyOutput>| !output.value.metrics().is_empty();
        if let (true, Some(index)) = (self.metrics.is_empty(), self.outputs.iter().position(waits))
        {
            let message = "the output waits for a metric and the scenario measures none";
            let expected = "an entry in `metrics`, or another moment";
            let path = format!("outputs[{index}].when");
            problems.push(Problem::new(path, message, expected).code(Code::Never));
        }
        if self.measure_every == 0 {
            let message = "measurements cannot follow each other by zero iterations";
            let problem = Problem::new("measure_every", message, "at least 1");
            problems.push(problem.code(Code::OutOfRange));
        }
        problems
    }
}

impl Scenario {
    /// Checks everything that can be checked without running: reads the files of the domain
    /// and checks the processes against it, but allocates no nodes. Larger domains than fit
    /// into the limits are refused. Returns what the run will need.
    ///
    /// # Errors
    /// The first [`Problem`], with the full path of its parameter.
    pub fn check(&self, folder: &Path, limits: Limits) -> Result<Needs, Problem> {
        crate::simulation::check(self, folder, limits)
    }
}

impl StageEntry {
    fn problems(&self) -> Vec<Problem> {
        let mut problems = Vec::new();
        for (index, process) in self.processes.iter().enumerate() {
            problems.extend(ranges(&format!("processes[{index}]"), process));
            if self.processes[..index].iter().any(|other| other.name == process.name) {
                let message = format!("`{}` stands twice in one stage", process.name);
                problems.push(
                    Problem::new(format!("processes[{index}]"), message, "each process once")
                        .code(Code::Stage)
                        .help("put the second one into a stage of its own"),
                );
            }
        }
        if self.processes.is_empty() {
            let problem = Problem::new("processes", "the stage has no process", "at least one");
            problems.push(problem.code(Code::Stage));
        } else if problems.is_empty() {
            problems.extend(self.stop.check(&self.ends()).err());
        }
        problems
    }
}

/// Values out of range in an entry that stands at `path`.
fn ranges<T: ?Sized + AnyParameters>(path: &str, entry: &Chosen<T>) -> Vec<Problem> {
    entry.value.check().into_iter().map(|problem| below(path, problem)).collect()
}

/// Puts `path` in front of the parameter of a problem.
pub(crate) fn below(path: &str, problem: Problem) -> Problem {
    let parameter = match problem.parameter.as_str() {
        "" => path.to_owned(),
        parameter => format!("{path}.{parameter}"),
    };
    Problem { parameter, ..problem }
}
