//! What a run tells about its progress, and how it is asked to stop.

use std::ops::ControlFlow;

/// Where a run stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress<'a> {
    /// Number of the stage, from zero.
    pub stage: usize,
    /// Number of stages.
    pub stages: usize,
    /// Name of the stage.
    pub stage_name: &'a str,
    /// Iterations of the stage that are done; zero when it begins.
    pub iteration: u64,
    /// Iterations that the stage will have, when that is known.
    pub iterations: Option<u64>,
    /// What processes have told until now, the latest last.
    pub notes: &'a [String],
}

/// Is told after each iteration and when a stage begins; may end the run.
pub trait ProgressHook {
    /// Looks at the progress. `Break` ends the run after this iteration.
    fn progress(&mut self, progress: &Progress<'_>) -> ControlFlow<()>;
}

impl<F: FnMut(&Progress<'_>) -> ControlFlow<()>> ProgressHook for F {
    fn progress(&mut self, progress: &Progress<'_>) -> ControlFlow<()> {
        self(progress)
    }
}
