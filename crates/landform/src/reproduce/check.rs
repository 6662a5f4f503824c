//! What can be wrong with a target file, found before the first of its runs.

use std::path::{Component, Path};
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;

use super::data::ANALYSIS;
use super::measure::INITIAL;
use super::{Figure, RunEntry, Source, plot};

/// Checks that every scenario of `figure` can run and that every number is taken from one of
/// its runs and stages, and returns what the scenario of each run says of itself. Files of data may be
/// absent. `base` is the folder of the target file.
///
/// # Errors
/// A message that names the run or the target, what is wrong with it and what there is.
pub fn check(
    figure: &Figure,
    base: &Path,
    registry: &Arc<Registry>,
    limits: Limits,
) -> Result<Vec<String>, String> {
    let mut stages = Vec::with_capacity(figure.runs.len());
    let mut descriptions = Vec::with_capacity(figure.runs.len());
    for run in &figure.runs {
        let (of_run, description) =
            check_run(run, base, registry, limits).map_err(|why| without_code(&why).to_owned())?;
        stages.push((run.name.as_str(), of_run));
        descriptions.push(description);
    }
    for entry in &figure.analyses {
        check_name(&entry.name)?;
        stages.push((entry.name.as_str(), vec![ANALYSIS.to_owned()]));
    }
    for target in &figure.targets {
        if let Some(why) = target.value.problem() {
            return Err(format!("{}: {why}", target.name));
        }
        for source in target.value.sources() {
            check_source(source, &stages).map_err(|why| format!("{}: {why}", target.name))?;
            let several =
                figure.runs.iter().any(|run| run.name == source.run && run.over.is_some());
            if several && !target.value.is_extreme() {
                let (target, run) = (&target.name, &source.run);
                return Err(format!(
                    "{target}: several runs are called `{run}`; take their Smallest or Largest"
                ));
            }
        }
    }
    plot::check(figure)?;
    match figure.seeds {
        0 => Err(format!("{}: zero seeds; expected at least one", figure.id)),
        _ => Ok(descriptions),
    }
}

/// A message without `error[L0102]: ` before it: the target file has a code of its own.
fn without_code(message: &str) -> &str {
    let rest = message.strip_prefix("error").and_then(|rest| rest.split_once(": "));
    rest.map_or(message, |(_, rest)| rest)
}

/// Checks a run and returns the names of its stages, and what its scenario says of itself.
fn check_run(
    run: &RunEntry,
    base: &Path,
    registry: &Arc<Registry>,
    limits: Limits,
) -> Result<(Vec<String>, String), String> {
    check_name(&run.name)?;
    let (mut stages, mut description) = (Vec::new(), String::new());
    for copy in run.copies(1)? {
        let source = copy.open(&base.join(&run.scenario))?;
        let scenario = source.parse(registry)?;
        scenario.check(source.folder(), limits).map_err(|problem| source.render(&problem))?;
        stages = scenario.stages.into_iter().map(|stage| stage.name).collect();
        description = scenario.description;
    }
    stages.push(INITIAL.to_owned());
    Ok((stages, description))
}

/// Refuses a name that can be no folder.
fn check_name(name: &str) -> Result<(), String> {
    let mut parts = Path::new(name).components();
    match (parts.next(), parts.next()) {
        (Some(Component::Normal(_)), None) => Ok(()),
        _ => Err(format!("the run `{name}` cannot name a folder; expected a plain name")),
    }
}

fn check_source(source: &Source, stages: &[(&str, Vec<String>)]) -> Result<(), String> {
    let Some((_, stages)) = stages.iter().find(|(name, _)| *name == source.run) else {
        let names: Vec<&str> = stages.iter().map(|(name, _)| *name).collect();
        return Err(format!("no run is called `{}`; there are: {}", source.run, names.join(", ")));
    };
    match stages.contains(&source.stage) {
        true => Ok(()),
        false => {
            let Source { run, stage, .. } = source;
            let stages = stages.join(", ");
            Err(format!("the run `{run}` has no stage `{stage}`; there are: {stages}"))
        }
    }
}
