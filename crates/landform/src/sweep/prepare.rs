//! Checking every run of a sweep before the first one is made.

use std::path::Path;
use std::sync::Arc;

use landform_sim::code::Code;
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
    let (parameters, runs) =
        runs(&sweep).map_err(|problem| source.render(&problem.code(Code::Sweep)))?;
    let names: Vec<String> = parameters.iter().map(|varied| varied.name.clone()).collect();
    check_plots(&sweep, &names).map_err(|problem| source.render(&problem))?;
    let mut prepared = Prepared {
        base: base(&sweep, &source)?,
        plan: Plan {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            title: sweep.title,
            plots: sweep.plots,
            names,
            paths: parameters.iter().map(|varied| varied.path.clone()).collect(),
            runs: Vec::with_capacity(runs.len()),
        },
        needs: Vec::with_capacity(runs.len()),
    };
    for run in runs {
        let added = prepared.add(&run, registry, limits);
        added.map_err(|why| refusal(&source, &parameters, &run, prepared.needs.len(), &why))?;
    }
    Ok(prepared)
}

impl Prepared {
    /// Checks a run and adds it.
    fn add(&mut self, run: &Run, registry: &Arc<Registry>, limits: Limits) -> Result<(), String> {
        let Run { point, seed, values } = run.clone();
        let source = with_values(&self.base, &self.plan.paths, &values, seed)?;
        let scenario = source.parse(registry)?;
        let needs = scenario.check(source.folder(), limits);
        self.needs.push(needs.map_err(|problem| source.render(&problem))?);
        let (number, digest) = (self.needs.len(), digest(source.text()));
        self.plan.runs.push(PlannedRun { number, point, seed, values, digest });
        Ok(())
    }
}

/// The refusal of the run after `earlier` others: at its parameter in the sweep, then what is
/// wrong with its scenario.
fn refusal(
    source: &SweepSource,
    parameters: &[Varied],
    run: &Run,
    earlier: usize,
    why: &str,
) -> String {
    let varied = culprit(parameters, why);
    let value = varied.map_or(String::new(), |(varied, index)| {
        format!(" with {} = {}", varied.name, run.values[index])
    });
    let place = varied.map_or("scenario", |(varied, _)| &varied.place);
    let message = format!("run {}{value} is refused", earlier + 1);
    source.render(&Problem::new(place, message, "").code(Code::SweptRun)) + "\n" + why
}

/// The scenario with the changes that all runs share.
fn base(sweep: &Sweep, source: &SweepSource) -> Result<ScenarioSource, String> {
    let mut base = ScenarioSource::open(&source.folder().join(&sweep.scenario)).map_err(|why| {
        let expected = "the path of a scenario, relative to this file";
        source.render(&Problem::new("scenario", why, expected).code(Code::UnreadableScenario))
    })?;
    for (index, change) in sweep.set.iter().enumerate() {
        base.set(&change.path, change.value.trim().get_ron()).map_err(|why| {
            let message = "the scenario cannot be changed so";
            let problem = Problem::new(format!("set[{index}]"), message, "").code(Code::Edit);
            source.render(&problem) + "\n" + &why
        })?;
    }
    Ok(base)
}

/// The parameter that a message about a scenario points at.
fn culprit<'p>(parameters: &'p [Varied], why: &str) -> Option<(&'p Varied, usize)> {
    let named = |varied: &Varied| why.contains(&format!("--set {}=", varied.path));
    parameters.iter().position(named).map(|index| (&parameters[index], index))
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
                let problem = Problem::new(format!("plots[{index}].{field}"), message, expected)
                    .code(Code::NotInRun);
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
