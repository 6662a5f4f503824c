//! Running the scenarios of a figure and comparing their numbers with the thesis'.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Limits, ProgressHook, Report, Simulation};
use serde::Serialize;

use super::{Figure, Quantity, Source, Target};

/// Whether a number was reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The median lies in the band, and so do the numbers of most seeds.
    Reproduced,
    /// The median lies in the band, but a seed in four or more does not.
    Partly,
    /// The median lies outside the band.
    Missed,
    /// There is no band: the number stands beside the thesis' own.
    Printed,
}

/// Our numbers beside those of a figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureReport {
    /// Name in the thesis.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// The scenarios that made it.
    pub scenarios: Vec<PathBuf>,
    /// Pictures of the first seed, relative to the output folder.
    pub pictures: Vec<PathBuf>,
    /// The numbers.
    pub targets: Vec<TargetReport>,
}

/// Our number beside one of the thesis.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TargetReport {
    /// What it is.
    pub name: String,
    /// Median over the seeds.
    pub value: f64,
    /// The number of each seed, from seed 1.
    pub seeds: Vec<f64>,
    /// The thesis' number.
    pub thesis: Option<f64>,
    /// What counts as reproduced.
    pub band: String,
    /// Whether it was reproduced.
    pub verdict: Verdict,
    /// What is known about a difference.
    pub reason: String,
}

/// Name under which a target finds the metrics of the state before the first iteration.
pub(super) const INITIAL: &str = "initial";

/// Metrics by stage of one run.
type StageMetrics = BTreeMap<String, BTreeMap<String, f64>>;

/// Runs the scenarios of `figure` with every seed and compares.
///
/// `base` is the folder of the target file; pictures of the first seed go to
/// `folder/RUN/`. `tell` hears what is being run; `hook` follows each run and may end it.
///
/// # Errors
/// A message: a scenario that is refused or fails, or a metric that it does not have.
pub fn measure(
    figure: &Figure,
    base: &Path,
    folder: &Path,
    registry: &Arc<Registry>,
    limits: Limits,
    tell: &mut dyn FnMut(&str),
    hook: &mut dyn ProgressHook,
) -> Result<FigureReport, String> {
    let mut values = vec![Vec::new(); figure.targets.len()];
    let mut pictures = Vec::new();
    for seed in 1..=figure.seeds {
        let mut metrics = BTreeMap::new();
        for run in &figure.runs {
            tell(&format!("{}, seed {seed} of {}", run.name, figure.seeds));
            let path = base.join(&run.scenario);
            let place = (seed == 1).then(|| folder.join(&run.name));
            let report = run_once(&path, seed, place.as_deref(), registry, limits, hook)?;
            pictures.extend(
                (report.outputs.iter().filter(|output| output.kind == "picture"))
                    .map(|output| Path::new(&run.name).join(&output.file)),
            );
            let stages = report.stages.into_iter().map(|stage| (stage.name, stage.metrics));
            let mut stages: StageMetrics = stages.collect();
            stages.insert(INITIAL.to_owned(), report.initial_metrics);
            metrics.insert(run.name.as_str(), stages);
        }
        for (target, values) in figure.targets.iter().zip(&mut values) {
            values.push(quantity(&target.value, &metrics)?);
        }
    }
    let targets = figure.targets.iter().zip(values);
    Ok(FigureReport {
        id: figure.id.clone(),
        title: figure.title.clone(),
        scenarios: figure.runs.iter().map(|run| run.scenario.clone()).collect(),
        pictures,
        targets: targets.map(|(target, seeds)| judge(target, seeds)).collect(),
    })
}

/// Runs a scenario; outputs are written only when a folder is given.
fn run_once(
    path: &Path,
    seed: u64,
    folder: Option<&Path>,
    registry: &Arc<Registry>,
    limits: Limits,
    hook: &mut dyn ProgressHook,
) -> Result<Report, String> {
    let source = ScenarioSource::open(path)?;
    let mut scenario = source.parse(registry)?;
    scenario.seed = seed;
    if folder.is_none() {
        scenario.outputs.clear();
    }
    let mut simulation = Simulation::new(scenario, source.folder(), limits)
        .map_err(|problem| source.render(&problem))?;
    let folder = folder.unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)
        .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
    let mut report = Report::default();
    simulation
        .run(folder, hook, &mut report)
        .map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(report)
}

fn quantity(quantity: &Quantity, metrics: &BTreeMap<&str, StageMetrics>) -> Result<f64, String> {
    let find = |source: &Source| {
        let stage = metrics.get(source.run.as_str()).and_then(|run| run.get(&source.stage));
        stage.and_then(|metrics| metrics.get(&source.metric)).copied().ok_or_else(|| {
            let Source { run, stage, metric } = source;
            format!("the run `{run}` has no metric `{metric}` at the end of a stage `{stage}`")
        })
    };
    match quantity {
        Quantity::Metric(source) => find(source),
        Quantity::Ratio(of, to) => Ok(find(of)? / find(to)?),
    }
}

fn judge(target: &Target, seeds: Vec<f64>) -> TargetReport {
    let mut sorted = seeds.clone();
    sorted.sort_by(f64::total_cmp);
    let value = sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN);
    let outside = seeds.iter().filter(|&&value| target.band.holds(value) == Some(false)).count();
    let verdict = match target.band.holds(value) {
        None => Verdict::Printed,
        Some(false) => Verdict::Missed,
        Some(true) if 4 * outside >= seeds.len() => Verdict::Partly,
        Some(true) => Verdict::Reproduced,
    };
    TargetReport {
        name: target.name.clone(),
        value,
        seeds,
        thesis: target.thesis,
        band: target.band.to_string(),
        verdict,
        reason: target.reason.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Band;

    fn verdict(band: Band, seeds: &[f64]) -> (f64, Verdict) {
        let source = Source { run: String::new(), stage: String::new(), metric: String::new() };
        let target = Target {
            name: String::new(),
            value: Quantity::Metric(source),
            thesis: None,
            band,
            reason: String::new(),
        };
        let report = judge(&target, seeds.to_vec());
        (report.value, report.verdict)
    }

    #[test]
    fn verdicts_follow_the_median_and_the_seeds() {
        let seeds = [5.0, 1.0, 3.0, 2.0, 4.0];
        assert_eq!(verdict(Band::Printed, &seeds), (3.0, Verdict::Printed));
        assert_eq!(verdict(Band::AtMost(5.0), &seeds), (3.0, Verdict::Reproduced));
        assert_eq!(verdict(Band::AtMost(4.5), &seeds), (3.0, Verdict::Reproduced));
        assert_eq!(verdict(Band::AtMost(3.5), &seeds), (3.0, Verdict::Partly));
        assert_eq!(verdict(Band::AtLeast(3.5), &seeds), (3.0, Verdict::Missed));
        assert_eq!(verdict(Band::Within(0.0, 9.0), &seeds), (3.0, Verdict::Reproduced));
    }
}
