//! Running the scenarios of a figure and comparing their numbers with the thesis'.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Limits, ProgressHook, Report, Simulation};
use serde::Serialize;

use super::data::{ANALYSIS, Data};
use super::targets::Copy;
use super::{Average, Figure, Quantity, RunEntry, Source, Target, sheet};

/// Whether a number was reproduced.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The average lies in the band, and so do the numbers of most seeds.
    Reproduced,
    /// The average lies in the band, but a seed in four or more does not.
    Partly,
    /// The average lies outside the band.
    Missed,
    /// There is no band: the number stands beside the thesis' own.
    Printed,
    /// The data that it is taken from are not there: neither reproduced nor missed.
    Absent,
}

/// Our numbers beside those of a figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureReport {
    /// Name in the thesis, or another source.
    pub id: String,
    /// What it shows.
    pub title: String,
    /// What the numbers beside ours are from.
    pub source: String,
    /// The scenarios that made it.
    pub scenarios: Vec<PathBuf>,
    /// The files of data that were analysed for it.
    pub data: Vec<PathBuf>,
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
    /// Average over the seeds, the median unless the figure says otherwise; none where data are absent.
    pub value: Option<f64>,
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

/// The runs of every name.
type Runs<'a> = BTreeMap<&'a str, Vec<StageMetrics>>;

/// Folders that a figure has to do with.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a> {
    /// That of the target file, which its scenarios are relative to.
    pub base: &'a Path,
    /// That of the files of data; without it they are absent.
    pub data: Option<&'a Path>,
    /// Where pictures go: `output/RUN/`, those of the first seed.
    pub output: &'a Path,
}

/// Runs the scenarios of `figure` with every seed, analyses its files of data, and compares.
///
/// `tell` hears what is being run; `hook` follows each run and may end it.
///
/// # Errors
/// A message: a scenario that is refused or fails, a file that cannot be analysed, or a metric that
/// they do not have.
pub fn measure(
    figure: &Figure,
    places: Places<'_>,
    registry: &Arc<Registry>,
    limits: Limits,
    tell: &mut dyn FnMut(&str),
    hook: &mut dyn ProgressHook,
) -> Result<FigureReport, String> {
    let mut values = vec![Vec::new(); figure.targets.len()];
    let data = Data::analyze(figure, places, limits, tell)?;
    let mut drawn = Vec::new();
    for seed in 1..=figure.seeds {
        let mut metrics = Runs::new();
        for run in &figure.runs {
            let mut copies = Vec::new();
            for (index, copy) in run.copies(seed)?.iter().enumerate() {
                tell(&what(run, copy, figure.seeds));
                let place = (seed == 1 && index == 0).then(|| places.output.join(&run.name));
                let path = places.base.join(&run.scenario);
                let report = run_once(&path, copy, place.as_deref(), registry, limits, hook)?;
                if place.is_some() {
                    drawn.push((run.name.as_str(), pictures(run, &report)));
                }
                copies.push(stages(report));
            }
            metrics.insert(&run.name, copies);
        }
        for (name, found) in &data.analysed {
            let metrics_of_file = [(ANALYSIS.to_owned(), found.metrics.clone())];
            metrics.insert(name, vec![StageMetrics::from(metrics_of_file)]);
        }
        for (target, values) in figure.targets.iter().zip(&mut values) {
            if data.absence(target).is_none() {
                values.push(quantity(&target.value, &metrics)?);
            }
        }
    }
    drawn.extend(data.analysed.iter().map(|(name, found)| (*name, vec![found.picture.clone()])));
    let sheet = sheet::write(figure, &drawn, places.output)?;
    let drawn = drawn.into_iter().flat_map(|(_, pictures)| pictures);
    let judged = figure.targets.iter().zip(values);
    let judged =
        judged.map(|(target, seeds)| judge(target, figure.average, seeds, data.absence(target)));
    Ok(FigureReport {
        id: figure.id.clone(),
        title: figure.title.clone(),
        source: figure.source.clone(),
        scenarios: figure.runs.iter().map(|run| run.scenario.clone()).collect(),
        data: data.analysed.iter().map(|(_, found)| found.file.clone()).collect(),
        pictures: sheet.into_iter().chain(drawn).collect(),
        targets: judged.collect(),
    })
}

/// What is being run.
fn what(run: &RunEntry, copy: &Copy, seeds: u64) -> String {
    match (&run.over, copy.set.last()) {
        (Some(_), Some((path, value))) => {
            format!("{}, {path} = {value}, seed {}", run.name, copy.seed)
        }
        _ => format!("{}, seed {} of {seeds}", run.name, copy.seed),
    }
}

/// The pictures of a run, relative to the output folder.
fn pictures(run: &RunEntry, report: &Report) -> Vec<PathBuf> {
    let pictures = report.outputs.iter().filter(|output| output.kind == "picture");
    pictures.map(|output| Path::new(&run.name).join(&output.file)).collect()
}

/// The metrics of a run by stage.
fn stages(report: Report) -> StageMetrics {
    let stages = report.stages.into_iter().map(|stage| (stage.name, stage.metrics));
    stages.chain([(INITIAL.to_owned(), report.initial_metrics)]).collect()
}

impl Copy {
    /// The scenario of the run.
    pub(super) fn open(&self, path: &Path) -> Result<ScenarioSource, String> {
        let mut source = ScenarioSource::open(path)?;
        for (path, value) in &self.set {
            source.set(path, value)?;
        }
        Ok(source)
    }
}

/// Runs a scenario; outputs are written only when a folder is given.
fn run_once(
    path: &Path,
    copy: &Copy,
    folder: Option<&Path>,
    registry: &Arc<Registry>,
    limits: Limits,
    hook: &mut dyn ProgressHook,
) -> Result<Report, String> {
    let source = copy.open(path)?;
    let mut scenario = source.parse(registry)?;
    scenario.seed = copy.seed;
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

fn quantity(quantity: &Quantity, runs: &Runs<'_>) -> Result<f64, String> {
    let all = |source: &Source| {
        let Source { run, stage, metric } = source;
        let runs = runs.get(run.as_str()).map_or(&[][..], Vec::as_slice);
        let find = |run: &StageMetrics| run.get(stage)?.get(metric).copied();
        let values: Option<Vec<f64>> = runs.iter().map(find).collect();
        values.filter(|values| !values.is_empty()).ok_or_else(|| {
            format!("the run `{run}` has no metric `{metric}` at the end of a stage `{stage}`")
        })
    };
    let first = |source: &Source| all(source).map(|values| values[0]);
    Ok(match quantity {
        Quantity::Metric(source) => first(source)?,
        Quantity::Ratio(of, to) => first(of)? / first(to)?,
        Quantity::Difference(of, less) => first(of)? - first(less)?,
        Quantity::Sum(one, other) => first(one)? + first(other)?,
        Quantity::Smallest(source) => all(source)?.into_iter().fold(f64::INFINITY, f64::min),
        Quantity::Largest(source) => all(source)?.into_iter().fold(f64::NEG_INFINITY, f64::max),
    })
}

/// Compares the numbers of a target; there are none where data are absent.
fn judge(
    target: &Target,
    average: Average,
    seeds: Vec<f64>,
    absence: Option<&str>,
) -> TargetReport {
    let value = average.of(&seeds);
    let outside = seeds.iter().filter(|&&value| target.band.holds(value) == Some(false)).count();
    let verdict = match value.map(|value| target.band.holds(value)) {
        None => Verdict::Absent,
        Some(None) => Verdict::Printed,
        Some(Some(false)) => Verdict::Missed,
        Some(Some(true)) if 4 * outside >= seeds.len() => Verdict::Partly,
        Some(Some(true)) => Verdict::Reproduced,
    };
    TargetReport {
        name: target.name.clone(),
        value,
        seeds,
        thesis: target.thesis,
        band: target.band.to_string(),
        verdict,
        reason: absence.unwrap_or(&target.reason).to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::{Band, Over};

    fn verdict(band: Band, seeds: &[f64]) -> (f64, Verdict) {
        let source = Source { run: String::new(), stage: String::new(), metric: String::new() };
        let target = Target {
            name: String::new(),
            value: Quantity::Metric(source),
            thesis: None,
            band,
            reason: String::new(),
        };
        let report = judge(&target, Average::Median, seeds.to_vec(), None);
        (report.value.unwrap_or(f64::NAN), report.verdict)
    }

    #[test]
    fn averages_are_medians_or_means() {
        let seeds = [5.0, 1.0, 3.0, 2.0, 9.0];
        assert_eq!(
            [Average::Median, Average::Mean].map(|of| of.of(&seeds)),
            [Some(3.0), Some(4.0)]
        );
        assert_eq!([Average::Median, Average::Mean].map(|of| of.of(&[])), [None; 2]);
    }

    #[test]
    fn several_runs_have_values_and_seeds_of_their_own() {
        let over = Over { path: "initial[0].from.hurst".into(), from: 0.5, to: 0.75, count: 3 };
        let set = vec!["domain.spacing_m=5.0".to_owned()];
        let entry =
            RunEntry { name: "fbm".into(), scenario: "a.ron".into(), set, over: Some(over) };
        let copies = |seed| entry.copies(seed).unwrap();
        let last = &copies(2)[2];
        assert_eq!(last.set[0], ("domain.spacing_m".to_owned(), "5.0".to_owned()));
        assert_eq!(last.set[1], ("initial[0].from.hurst".to_owned(), "0.75".to_owned()));
        let seeds: Vec<u64> = [1, 2].into_iter().flat_map(copies).map(|copy| copy.seed).collect();
        assert_eq!(seeds, [1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn quantities_are_taken_over_runs() {
        let run = |value: f64| {
            let metrics = BTreeMap::from([("m".to_owned(), value)]);
            StageMetrics::from([("s".to_owned(), metrics)])
        };
        let runs = Runs::from([("a", vec![run(3.0), run(5.0), run(2.0)]), ("b", vec![run(4.0)])]);
        let source = |run: &str| Source { run: run.into(), stage: "s".into(), metric: "m".into() };
        let [a, b] = ["a", "b"].map(source);
        for (asked, expected) in [
            (Quantity::Smallest(a.clone()), 2.0),
            (Quantity::Largest(a), 5.0),
            (Quantity::Difference(b.clone(), b.clone()), 0.0),
            (Quantity::Sum(b.clone(), b.clone()), 8.0),
            (Quantity::Ratio(b.clone(), b), 1.0),
        ] {
            assert_eq!(quantity(&asked, &runs), Ok(expected), "{asked:?}");
        }
        let none = quantity(&Quantity::Metric(source("c")), &runs);
        assert!(none.is_err_and(|why| why.contains("`c` has no metric `m`")));
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
