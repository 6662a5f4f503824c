//! `landform sweep`: many runs of a scenario.

mod place;
mod share;
mod work;

use std::sync::Arc;

use landform_sim::code::Code;
use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;

use super::arguments::SweepArguments;
use super::collect;
use super::{Failure, Outcome, failed, memory, refused, talk};
use crate::sweep::{Prepared, prepare};
use share::Share;
use work::{Limit, work};

/// Runs the sweep of the arguments, or lists its runs.
pub(super) fn sweep(arguments: &SweepArguments, registry: &Arc<Registry>) -> Outcome {
    let unusable = refused(Code::Arguments);
    let memory_bytes = memory::limit(arguments.memory_limit_gib).map_err(unusable)?;
    let limit = limit(arguments, memory_bytes).map_err(unusable)?;
    let share = Share::parse(arguments.index.as_deref()).map_err(unusable)?;
    let prepared = prepare(&arguments.sweep, registry, Limits { memory_bytes })
        .map_err(refused(Code::UnreadableScenario))?;
    check_disk(&prepared, arguments.disk_limit_gib)?;
    if arguments.dry_run {
        return talk::say(&(listing(&prepared) + &estimate(&prepared)));
    }
    let folder = place::make(arguments, &prepared.plan, share)?;
    let _claim = place::claim(&folder, share).map_err(refused(Code::Busy))?;
    talk::tell(estimate(&prepared).trim_end());
    let todo: Vec<usize> = (0..prepared.plan.runs.len())
        .filter(|&index| share.has(index) && !place::is_done(&prepared.plan, index, &folder))
        .collect();
    let done = work(&prepared, &todo, &folder, registry, limit, arguments.quiet);
    let results = match share.is_all() {
        true => Some(collect::gather(&prepared.plan, &folder).map_err(failed(Code::Unwritable))?),
        false => None,
    };
    if done.interrupted {
        let left = todo.len() - done.ended;
        let (sweep, shown) = (arguments.sweep.display(), folder.display());
        return Err(Failure::interrupted(format!(
            "interrupted: {left} runs are left; `landform sweep {sweep} -o {shown}` goes on"
        )));
    }
    match results {
        Some(results) => collect::tell(&results, &folder),
        None => end_of_share(&done, &folder),
    }
}

/// What a share says at its end.
fn end_of_share(done: &work::Done, folder: &std::path::Path) -> Outcome {
    let shown = folder.display();
    talk::say(&format!(
        "{} runs of this share ended; `landform collect {shown}` gathers all\n",
        done.ended
    ))?;
    match done.failed {
        0 => Ok(()),
        failed => {
            let message = format!("{failed} runs failed; `run.json` in their folders says why");
            Err(Failure::failed(Code::FailedRuns, message))
        }
    }
}

fn limit(arguments: &SweepArguments, memory_bytes: u64) -> Result<Limit, String> {
    const MOST: usize = 1024;
    for (name, value) in [("--jobs", arguments.jobs), ("--threads", arguments.threads)] {
        if value.is_some_and(|value| !(1..=MOST).contains(&value)) {
            return Err(format!("{name} must be from 1 to {MOST}"));
        }
    }
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = arguments.threads.unwrap_or(cores);
    let jobs = arguments.jobs.unwrap_or(threads);
    Ok(Limit { jobs, threads: threads.div_ceil(jobs), memory_bytes })
}

fn check_disk(prepared: &Prepared, most_gib: f64) -> Result<(), Failure> {
    if !(most_gib.is_finite() && most_gib > 0.0) {
        let message = format!("--disk-limit-gib is {most_gib}; it must be a positive number");
        return Err(Failure::refused(Code::Arguments, message));
    }
    let needed = gib(disk_bytes(prepared));
    match needed <= most_gib {
        true => Ok(()),
        false => {
            let message = format!(
                "the final fields of {} runs need {needed:.1} GiB on the disk and {most_gib} GiB \
                 may be used; make the domain smaller, the runs fewer, or raise --disk-limit-gib",
                prepared.plan.runs.len(),
            );
            Err(Failure::refused(Code::Disk, message))
        }
    }
}

/// Size of the final fields of all runs.
fn disk_bytes(prepared: &Prepared) -> u64 {
    prepared.needs.iter().fold(0, |sum, needs| sum.saturating_add(needs.field_bytes))
}

fn gib(bytes: u64) -> f64 {
    bytes as f64 / (1_u64 << 30) as f64
}

/// The runs, one a line.
fn listing(prepared: &Prepared) -> String {
    let plan = &prepared.plan;
    let line = |run| {
        let folder = plan.folder_of(run);
        format!("{}  {}, seed {}\n", folder.display(), plan.describe(run), run.seed)
    };
    plan.runs.iter().map(line).map(|line| line.replace("  , ", "  ")).collect()
}

fn estimate(prepared: &Prepared) -> String {
    let most = prepared.needs.iter().map(|needs| needs.memory_bytes).max().unwrap_or(0);
    format!(
        "{} runs, at most {:.0} MiB of memory each; final fields of {:.0} MiB, pictures besides\n",
        prepared.plan.runs.len(),
        1024.0 * gib(most),
        1024.0 * gib(disk_bytes(prepared)),
    )
}
