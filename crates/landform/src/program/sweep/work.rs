//! Runs side by side, within limits of memory and number.

use std::fs;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::{Arc, mpsc};
use std::thread;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use landform_sim::registry::Registry;
use landform_sim::simulation::{Limits, Progress, RunError, Simulation};

use crate::program::{interrupt, run, talk};
use crate::sweep::{Outcome, PlannedRun, Prepared, Status};

/// What the runs may use together.
#[derive(Clone, Copy)]
pub(super) struct Limit {
    /// Most runs at a time.
    pub jobs: usize,
    /// Threads of each run.
    pub threads: usize,
    /// Memory of all runs that go on at a time, in bytes.
    pub memory_bytes: u64,
}

/// What was done.
#[derive(Default)]
pub(super) struct Done {
    /// Runs that ended, well or not.
    pub ended: usize,
    /// Runs that failed.
    pub failed: usize,
    /// Whether the user stopped the sweep.
    pub interrupted: bool,
}

/// Runs the runs `todo` of a sweep in `folder`, in order as far as the limits let them start.
///
/// A run has threads of its own and its results depend on its scenario alone, so neither its
/// neighbours nor the limits matter to it.
pub(super) fn work(
    prepared: &Prepared,
    todo: &[usize],
    folder: &Path,
    registry: &Arc<Registry>,
    limit: Limit,
    quiet: bool,
) -> Done {
    interrupt::watch();
    let bar = bar(todo.len(), quiet);
    let mut done = Done::default();
    let (mut active, mut used) = (0, 0_u64);
    let mut queue = todo.iter().copied().peekable();
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        loop {
            while let Some(&index) = queue.peek() {
                let bytes = prepared.needs[index].memory_bytes;
                let fits = active == 0 || used.saturating_add(bytes) <= limit.memory_bytes;
                if interrupt::asked() || active >= limit.jobs || !fits {
                    break;
                }
                queue.next();
                (active, used) = (active + 1, used.saturating_add(bytes));
                let sender = sender.clone();
                scope.spawn(move || {
                    let ended = guarded(prepared, index, folder, registry, limit);
                    // The receiver lives until the last run has ended.
                    let _ = sender.send((index, ended));
                });
            }
            if active == 0 {
                break;
            }
            let Ok((index, ended)) = receiver.recv() else { break };
            (active, used) = (active - 1, used.saturating_sub(prepared.needs[index].memory_bytes));
            note(&mut done, &prepared.plan.runs[index], ended, &bar);
        }
    });
    bar.finish_and_clear();
    done.interrupted = interrupt::asked() && done.ended < todo.len();
    done
}

/// Counts a run that is over, and tells why it failed.
fn note(done: &mut Done, run: &PlannedRun, ended: Option<Outcome>, bar: &ProgressBar) {
    let Some(outcome) = ended else { return };
    done.ended += 1;
    bar.inc(1);
    if outcome.status == Status::Failed {
        done.failed += 1;
        bar.suspend(|| talk::tell(&format!("run {} failed: {}", run.number, outcome.reason)));
    }
}

fn bar(runs: usize, quiet: bool) -> ProgressBar {
    if quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(runs as u64);
    bar.set_draw_target(ProgressDrawTarget::stderr_with_hz(4));
    if let Ok(style) = ProgressStyle::with_template("[{bar:36}] {pos}/{len} runs, {eta} left") {
        bar.set_style(style.progress_chars("=> "));
    }
    bar
}

/// Runs one run; a defect of a process ends that run and not the others. `None` when the user
/// stopped it.
fn guarded(
    prepared: &Prepared,
    index: usize,
    folder: &Path,
    registry: &Arc<Registry>,
    limit: Limit,
) -> Option<Outcome> {
    let planned = &prepared.plan.runs[index];
    let folder = folder.join(prepared.plan.folder_of(planned));
    let ended = catch_unwind(AssertUnwindSafe(|| one(prepared, planned, &folder, registry, limit)));
    let ended = ended.unwrap_or_else(|_| Err("a process ended in a panic".to_owned()));
    let (status, reason) = match ended {
        Ok(true) => (Status::Done, String::new()),
        Ok(false) => return None,
        Err(reason) => (Status::Failed, reason),
    };
    let outcome = Outcome { digest: planned.digest.clone(), status, reason };
    Some(match outcome.write(&folder) {
        Ok(()) => outcome,
        Err(reason) => Outcome { status: Status::Failed, reason, ..outcome },
    })
}

/// Runs one run in its folder; `false` when the user stopped it, else why it failed.
fn one(
    prepared: &Prepared,
    planned: &PlannedRun,
    folder: &Path,
    registry: &Arc<Registry>,
    limit: Limit,
) -> Result<bool, String> {
    let source = prepared.scenario(planned)?;
    renew(folder)?;
    run::pool(Some(limit.threads))?.install(|| {
        let scenario = source.parse(registry)?;
        let limits = Limits { memory_bytes: limit.memory_bytes };
        let mut simulation = Simulation::new(scenario, source.folder(), limits)
            .map_err(|problem| format!("{}: {problem}", problem.code))?;
        let mut hook = |_: &Progress<'_>| match interrupt::asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        match run::run_in(folder, &mut simulation, &source, &mut hook)?.1 {
            Ok(()) => Ok(true),
            Err(RunError::Interrupted { .. }) => Ok(false),
            Err(error) => Err(format!("{}: {error}", error.code())),
        }
    })
}

/// An empty folder for a run; what an earlier attempt left goes.
fn renew(folder: &Path) -> Result<(), String> {
    let shown = folder.display();
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| format!("cannot clear {shown}: {error}"))?;
    }
    fs::create_dir_all(folder).map_err(|error| format!("cannot make {shown}: {error}"))
}
