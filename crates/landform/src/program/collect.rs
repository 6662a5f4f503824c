//! `landform collect`: the runs of a sweep as a table, a contact sheet and plots.

use std::path::Path;

use landform_sim::code::Code;

use super::{Failure, Outcome, failed, refused, talk};
use crate::sweep::{Plan, Results, Status};

/// Gathers the sweep in a folder.
pub(super) fn collect(folder: &Path) -> Outcome {
    let plan = Plan::read(folder).map_err(refused(Code::OtherSweep))?.ok_or_else(|| {
        let shown = folder.display();
        let message = format!("{shown} holds no sweep; name what `landform sweep` got by -o");
        Failure::refused(Code::OtherSweep, message)
    })?;
    let gathered = gather(&plan, folder).map_err(failed(Code::Unwritable))?;
    tell(&gathered, folder)
}

/// What was gathered.
pub(super) struct Gathered {
    files: Vec<&'static str>,
    done: usize,
    missing: usize,
    failed: usize,
    why: Option<(usize, String)>,
    notes: Vec<String>,
}

/// Reads the runs and writes the files.
pub(super) fn gather(plan: &Plan, folder: &Path) -> Result<Gathered, String> {
    let results = Results::read(plan, folder);
    Ok(Gathered {
        files: results.write(folder)?,
        done: results.count(Some(Status::Done)),
        missing: results.count(None),
        failed: results.count(Some(Status::Failed)),
        notes: results.unmeasured(),
        why: results.first_failure().map(|(number, why)| (number, why.to_owned())),
    })
}

/// Says what was gathered; runs that failed are a failure.
pub(super) fn tell(gathered: &Gathered, folder: &Path) -> Outcome {
    let Gathered { files, done, missing, failed, why, notes } = gathered;
    let mut text = format!("{done} runs are done");
    if *missing > 0 {
        text += &format!(", {missing} are missing");
    }
    text += "\n";
    for file in files {
        text += &format!("  {}\n", folder.join(file).display());
    }
    for note in notes {
        text += &format!("  note: {note}\n");
    }
    talk::say(&text)?;
    match why {
        None => Ok(()),
        Some((number, why)) => {
            let table = folder.join("table.csv");
            let message = format!(
                "{failed} runs failed, run {number} by: {why}\n{} says why for each",
                table.display()
            );
            Err(Failure::failed(Code::FailedRuns, message))
        }
    }
}
