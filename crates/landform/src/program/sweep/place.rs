//! The output folder of a sweep: made, or found again.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use landform_sim::code::Code;

use super::share::Share;
use crate::program::arguments::SweepArguments;
use crate::program::{Failure, folder, refused};
use crate::sweep::{ENDING, Outcome, Plan};

/// Makes the folder and writes the plan into it, or goes on in one that holds the same sweep.
///
/// Shares of an array of jobs write the same plan, each of them whole or not at all; nothing
/// else is written by two of them.
pub(super) fn make(
    arguments: &SweepArguments,
    plan: &Plan,
    share: Share,
) -> Result<PathBuf, Failure> {
    let asked = arguments.output.as_deref();
    let Some(folder) = asked else {
        if !share.is_all() {
            let message = "--index needs -o: all shares write into one folder";
            return Err(Failure::refused(Code::Arguments, message));
        }
        return begin(&folder::fresh(&stem(&arguments.sweep)), plan);
    };
    match Plan::read(folder).map_err(refused(Code::OtherSweep))? {
        None => begin(folder, plan),
        Some(earlier) => {
            if let Some(reason) = plan.differs_from(&earlier) {
                let shown = folder.display();
                let message =
                    format!("{shown} holds another sweep: {reason}; name another folder with -o");
                return Err(Failure::refused(Code::OtherSweep, message));
            }
            // Titles and plots may change: they concern no run.
            if earlier != *plan && share.is_all() {
                plan.write(folder).map_err(refused(Code::Unwritable))?;
            }
            Ok(folder.to_owned())
        }
    }
}

/// Claims the folder of a sweep until the value is dropped or the process ends. Shares may work
/// side by side; a whole sweep wants to be alone.
///
/// # Errors
/// A message when another process is at work there.
pub(super) fn claim(folder: &Path, share: Share) -> Result<Option<File>, String> {
    // Where folders cannot be opened or locked, sweeps are not the worse for it.
    let Ok(file) = File::open(folder) else { return Ok(None) };
    let locked = if share.is_all() { file.try_lock() } else { file.try_lock_shared() };
    match locked {
        Err(TryLockError::WouldBlock) => Err(format!(
            "another sweep is at work in {}; wait for its end or name another folder with -o",
            folder.display()
        )),
        _ => Ok(Some(file)),
    }
}

/// Whether a run of the plan is done.
pub(super) fn is_done(plan: &Plan, index: usize, folder: &Path) -> bool {
    let run = &plan.runs[index];
    Outcome::is_done(&folder.join(plan.folder_of(run)), &run.digest)
}

fn begin(folder: &Path, plan: &Plan) -> Result<PathBuf, Failure> {
    // Shares that start together make the folder together.
    let waiting = fs::read_dir(folder).is_ok_and(|mut entries| {
        entries.all(|entry| entry.is_ok_and(|entry| is_ours(&entry.file_name().to_string_lossy())))
    });
    let made = folder::make(Some(folder), "", waiting)?;
    plan.write(&made).map_err(refused(Code::Unwritable))?;
    Ok(made)
}

/// Whether a sweep makes files of this name in a folder that has no plan yet.
fn is_ours(name: &str) -> bool {
    name == "runs" || name == "sweep.json" || (name.starts_with('.') && name.ends_with(".tmp"))
}

/// The name of a sweep file without its ending.
fn stem(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.strip_suffix(ENDING).or(name.strip_suffix(".ron")).unwrap_or(&name).to_owned()
}
