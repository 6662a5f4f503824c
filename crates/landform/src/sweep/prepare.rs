//! Checking every run of a sweep before the first one is made.

use std::path::Path;
use std::sync::Arc;

use landform_sim::parameters::Problem;
use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Limits, Needs};

use super::plan::digest;
use super::unroll::{Run, Varied};
use super::{Plan, PlannedRun, Sweep, SweepSource, runs};

/// A sweep whose runs are all good.
pub(crate) struct Prepared {
    /// The runs.
    pub plan: Plan,
    /// What each run needs.
    pub needs: Vec<Needs>,
    base: ScenarioSource,
}

impl Prepared {
    /// The scenario of a run.
    ///
    /// # Errors
    /// A message, which cannot happen for a run that was checked.
    pub fn scenario(&self, run: &PlannedRun) -> Result<ScenarioSource, String> {
        with_values(&self.base, &self.plan.paths, &run.values, run.seed)
    }
}

/// Reads the sweep at `path` and checks the scenario of every run against `limits`.
///
/// # Errors
/// A message with the place in the sweep file and, below it, in the scenario.
pub(crate) fn prepare(
    path: &Path,
    registry: &Arc<Registry>,
    limits: Limits,
) -> Result<Prepared, String> {
    let source = SweepSource::open(path)?;
    let sweep = source.parse(path)?;
    let at = |place: &str, message: String, expected: &str| {
        source.render(&Problem::new(place, message, expected))
    };
    let (parameters, runs) = runs(&sweep).map_err(|problem| source.render(&problem))?;
    let scenario = source.folder().join(&sweep.scenario);
    let base = ScenarioSource::open(&scenario)
        .map_err(|why| at("scenario", why, "the path of a scenario, relative to this file"))?;
    let base = with_changes(base, &sweep).map_err(|(index, why)| {
        at(&format!("set[{index}]"), "the scenario cannot be changed so".to_owned(), "")
            + "\n"
            + &why
    })?;
    let paths: Vec<String> = parameters.iter().map(|varied| varied.path.clone()).collect();
    let mut prepared = Prepared {
        plan: Plan {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: sweep.title.clone(),
            plots: sweep.plots.clone(),
            names: parameters.iter().map(|varied| varied.name.clone()).collect(),
            paths,
            runs: Vec::with_capacity(runs.len()),
        },
        needs: Vec::with_capacity(runs.len()),
        base,
    };
    check_plots(&sweep, &prepared.plan.names).map_err(|problem| source.render(&problem))?;
    for (index, run) in runs.into_iter().enumerate() {
        let Run { point, seed, values } = run;
        let checked = with_values(&prepared.base, &prepared.plan.paths, &values, seed)
            .and_then(|source| Ok((digest(source.text()), needs(&source, registry, limits)?)));
        let (digest, needs) = checked.map_err(|why| {
            let varied = culprit(&parameters, &why);
            let value = varied.map_or(String::new(), |(varied, index)| {
                format!(" with {} = {}", varied.name, values[index])
            });
            let place = varied.map_or("scenario", |(varied, _)| &varied.place);
            let message = format!("run {}{value} is refused", index + 1);
            at(place, message, "") + "\n" + &why
        })?;
        let number = index + 1;
        prepared.plan.runs.push(PlannedRun { number, point, seed, values, digest });
        prepared.needs.push(needs);
    }
    Ok(prepared)
}

/// The parameter that a message about a scenario points at.
fn culprit<'p>(parameters: &'p [Varied], why: &str) -> Option<(&'p Varied, usize)> {
    let named = |varied: &Varied| why.contains(&format!("--set {}=", varied.path));
    parameters.iter().position(named).map(|index| (&parameters[index], index))
}

/// The scenario with the changes that all runs share; else the number of the change and why.
fn with_changes(
    mut base: ScenarioSource,
    sweep: &Sweep,
) -> Result<ScenarioSource, (usize, String)> {
    for (index, change) in sweep.set.iter().enumerate() {
        let value = change.value.trim().get_ron();
        base.set(&change.path, value).map_err(|why| (index, why))?;
    }
    Ok(base)
}

/// The scenario with the values and the seed of a run.
fn with_values(
    base: &ScenarioSource,
    paths: &[String],
    values: &[String],
    seed: u64,
) -> Result<ScenarioSource, String> {
    let mut source = base.clone();
    for (path, value) in paths.iter().zip(values) {
        source.set(path, value)?;
    }
    source.set("seed", &seed.to_string())?;
    Ok(source)
}

fn needs(
    source: &ScenarioSource,
    registry: &Arc<Registry>,
    limits: Limits,
) -> Result<Needs, String> {
    let scenario = source.parse(registry)?;
    scenario.check(source.folder(), limits).map_err(|problem| source.render(&problem))
}

/// Checks that plots name parameters of the sweep.
fn check_plots(sweep: &Sweep, names: &[String]) -> Result<(), Problem> {
    for (index, plot) in sweep.plots.iter().enumerate() {
        for (field, name) in [("against", &plot.against), ("by", &plot.by)] {
            if !name.is_empty() && !names.contains(name) {
                let message = format!("no parameter of the sweep is called `{name}`");
                let expected = match names {
                    [] => "a sweep that varies something".to_owned(),
                    names => format!("one of {}", names.join(", ")),
                };
                let problem = Problem::new(format!("plots[{index}].{field}"), message, expected);
                return Err(
                    match landform_sim::text::nearest(name, names.iter().map(String::as_str)) {
                        Some(guess) => problem.help(format!("did you mean {guess:?}?")),
                        None => problem,
                    },
                );
            }
        }
    }
    Ok(())
}
