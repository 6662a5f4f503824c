//! The progress bar.

use std::ops::ControlFlow;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use landform_sim::simulation::{Progress, ProgressHook};

use super::{interrupt, talk};

/// Shows where a run stands on standard error, with the time that is left, and what its processes
/// tell.
pub(super) struct Bar {
    bar: ProgressBar,
    quiet: bool,
    stage: Option<usize>,
    /// Notes that were told.
    told: usize,
}

impl Bar {
    pub(super) fn new(quiet: bool) -> Self {
        Self { bar: ProgressBar::hidden(), quiet, stage: None, told: 0 }
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn begin_stage(&mut self, progress: &Progress<'_>) {
        if self.quiet {
            return;
        }
        self.bar.finish_and_clear();
        let (bar, template) = match progress.iterations {
            Some(iterations) => (ProgressBar::new(iterations), KNOWN),
            None => (ProgressBar::no_length(), UNKNOWN),
        };
        bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(8));
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        let stage = format!("stage {}/{}", progress.stage + 1, progress.stages);
        bar.set_prefix(match progress.stage_name {
            "" => stage,
            name => format!("{stage} {name}"),
        });
        self.bar = bar;
    }
}

const KNOWN: &str = "{prefix} [{bar:36}] {pos}/{len} iterations, {eta} left";
const UNKNOWN: &str = "{prefix} {spinner} {pos} iterations, {elapsed}";

impl ProgressHook for Bar {
    fn progress(&mut self, progress: &Progress<'_>) -> ControlFlow<()> {
        if self.stage.replace(progress.stage) != Some(progress.stage) {
            self.begin_stage(progress);
        }
        for note in progress.notes.iter().skip(self.told) {
            self.bar.suspend(|| talk::tell(note));
        }
        self.told = progress.notes.len();
        self.bar.set_position(progress.iteration);
        match interrupt::asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }
}
