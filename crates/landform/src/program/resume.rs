//! What `--resume` finds in the folder of a run.

use std::fs;
use std::path::Path;

use landform_sim::checkpoint::Checkpoint;
use landform_sim::code::Code;
use landform_sim::scenario::ScenarioSource;
use serde_json::Value;

use super::{Failure, checkpoint_file, folder, refused, talk};

/// What is left to do in the folder of a run.
pub(super) enum Rest {
    /// Everything after a checkpoint.
    After(Checkpoint<'static>),
    /// Everything: the run was killed before its first checkpoint.
    Everything,
    /// Nothing.
    Nothing,
}

/// Looks into the folder of a run of the same scenario.
///
/// # Errors
/// A message that says why the run cannot go on, and what to do.
pub(super) fn rest(folder: &Path, source: &ScenarioSource) -> Result<Rest, Failure> {
    let shown = folder.display();
    if is_finished(folder) {
        let text = fs::read_to_string(folder.join("scenario.ron")).unwrap_or_default();
        same_scenario(folder, source.text(), &text)?;
        return Ok(Rest::Nothing);
    }
    if checkpoint_file::path(folder).exists() {
        let mut checkpoint =
            checkpoint_file::read(folder).map_err(refused(Code::DamagedCheckpoint))?;
        let text = checkpoint_file::take_scenario(&mut checkpoint);
        same_scenario(folder, source.text(), &text)?;
        return Ok(Rest::After(checkpoint));
    }
    let begun = checkpoint_file::folder(folder).is_dir() || folder::is_empty(folder);
    if !begun {
        let message = format!(
            "there is no checkpoint in {shown} to resume from; run the scenario again without \
             --resume, into another folder or with --force"
        );
        return Err(Failure::refused(Code::NoCheckpoint, message));
    }
    if let Ok(text) = fs::read_to_string(folder.join("scenario.ron")) {
        same_scenario(folder, source.text(), &text)?;
    }
    talk::tell(&format!("no checkpoint in {shown} yet: the run starts from the beginning"));
    Ok(Rest::Everything)
}

/// Whether the report in the folder is that of a run that came to its end.
fn is_finished(folder: &Path) -> bool {
    let text = fs::read_to_string(folder.join("report.json")).unwrap_or_default();
    serde_json::from_str::<Value>(&text).is_ok_and(|report| report["finished"] == true)
}

/// Refuses another scenario than that of the run in the folder.
fn same_scenario(folder: &Path, present: &str, before: &str) -> Result<(), Failure> {
    if present == before {
        return Ok(());
    }
    let pairs = present.lines().zip(before.lines());
    let same = pairs.take_while(|(present, before)| present == before).count();
    let line = |text: &str| match text.lines().nth(same) {
        Some(line) => format!("`{}`", line.trim()),
        None => "missing".to_owned(),
    };
    let message = format!(
        "the run in {} is one of another scenario: line {} was {} and is now {}; resume with the \
         scenario and the --set options of that run, or start a new run in another folder",
        folder.display(),
        same + 1,
        line(before),
        line(present)
    );
    Err(Failure::refused(Code::OtherScenario, message))
}
