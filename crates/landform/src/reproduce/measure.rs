//! Running the scenarios of a figure and comparing their numbers with the thesis'.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::scenario::ScenarioSource;
use landform_sim::simulation::{Limits, Progress, Report, Simulation};

use super::data::{ANALYSIS, Data};
use super::judge::{FigureReport, TargetReport, judge};
use super::quantity::{Runs, StageMetrics};
use super::targets::Copy;
use super::{Figure, RunEntry, Target, plot, sheet};

/// Name under which a target finds the metrics of the state before the first iteration.
pub(super) const INITIAL: &str = "initial";

/// Folders that a figure has to do with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Places<'a> {
    /// That of the target file, which its scenarios are relative to.
    pub base: &'a Path,
    /// That of the files of data; without it they are absent.
    pub data: Option<&'a Path>,
    /// Where pictures go: `output/RUN/`, those of the first seed.
    pub output: &'a Path,
}

/// What a seed of a figure came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SeedNumbers {
    /// The number of each target; none where data are absent.
    pub values: Vec<Option<f64>>,
    /// Pictures by runs, relative to the output folder; those of the first seed only.
    pub pictures: Vec<(String, Vec<PathBuf>)>,
}

/// What follows runs.
#[derive(Clone, Copy)]
pub(super) struct Watch<'a> {
    /// Hears what is being run.
    pub tell: &'a (dyn Fn(&str) + Sync),
    /// Whether to end.
    pub stop: &'a (dyn Fn() -> bool + Sync),
}

/// Runs the scenarios of `figure` with a seed, and takes its numbers from them and from `data`.
///
/// # Errors
/// A message: a scenario that is refused or fails, or a metric that they do not have.
pub(super) fn measure(
    figure: &Figure,
    seed: u64,
    places: Places<'_>,
    (registry, limits): (&Arc<Registry>, Limits),
    data: &Data<'_>,
    watch: Watch<'_>,
) -> Result<SeedNumbers, String> {
    let mut metrics = Runs::new();
    let mut pictures_of = Vec::new();
    for run in &figure.runs {
        let mut copies = Vec::new();
        for (index, copy) in run.copies(seed)?.iter().enumerate() {
            (watch.tell)(&what(run, copy, figure.seeds));
            let place = (seed == 1 && index == 0).then(|| places.output.join(&run.name));
            let path = places.base.join(&run.scenario);
            let report = run_once(&path, copy, place.as_deref(), registry, limits, watch)?;
            if place.is_some() {
                pictures_of.push((run.name.clone(), pictures(run, &report)));
            }
            copies.push(stages(report));
        }
        metrics.insert(&run.name, copies);
    }
    for (name, found) in &data.analysed {
        let metrics_of_file = [(ANALYSIS.to_owned(), found.metrics.clone())];
        metrics.insert(name, vec![StageMetrics::from(metrics_of_file)]);
    }
    let value = |target: &Target| match data.absence(target) {
        Some(_) => Ok(None),
        None => target.value.of(&metrics).map(Some),
    };
    let values = figure.targets.iter().map(value).collect::<Result<_, _>>()?;
    Ok(SeedNumbers { values, pictures: pictures_of })
}

/// Judges the numbers of all seeds of a figure, and puts its pictures together.
///
/// # Errors
/// A message: pictures that cannot be read or written.
pub(super) fn conclude(
    figure: &Figure,
    name: &str,
    seeds: &[SeedNumbers],
    data: &Data<'_>,
    output: &Path,
) -> Result<FigureReport, String> {
    let mut drawn: Vec<(&str, Vec<PathBuf>)> = Vec::new();
    for seed in seeds {
        drawn.extend(seed.pictures.iter().map(|(run, files)| (run.as_str(), files.clone())));
    }
    drawn.extend(data.analysed.iter().map(|(name, found)| (*name, vec![found.picture.clone()])));
    let sheet = sheet::write(figure, &drawn, output)?;
    let judged = figure.targets.iter().enumerate().map(|(index, target)| {
        let values = seeds.iter().filter_map(|seed| seed.values[index]).collect();
        judge(target, figure.average, values, data.absence(target))
    });
    let targets: Vec<TargetReport> = judged.collect();
    let whole = sheet.into_iter().chain(plot::write(figure, &targets, output)?);
    let pictures = whole.chain(drawn.into_iter().flat_map(|(_, pictures)| pictures));
    Ok(FigureReport {
        name: name.to_owned(),
        id: figure.id.clone(),
        title: figure.title.clone(),
        source: figure.source.clone(),
        scenarios: figure.runs.iter().map(|run| run.scenario.clone()).collect(),
        data: data.analysed.iter().map(|(_, found)| found.file.clone()).collect(),
        pictures: pictures.map(|picture| Path::new(name).join(picture)).collect(),
        targets,
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
    watch: Watch<'_>,
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
    let mut hook = |_: &Progress<'_>| match (watch.stop)() {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    simulation
        .run(folder, &mut hook, &mut report)
        .map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(report)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::Over;

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
}
