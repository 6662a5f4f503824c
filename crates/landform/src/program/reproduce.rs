//! `landform reproduce`: numbers of the thesis beside ours.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_sim::registry::Registry;
use landform_sim::simulation::{Limits, Progress};
use serde::Serialize;

use super::arguments::ReproduceArguments;
use super::{Failure, Outcome, folder, interrupt, memory, talk};
use crate::reproduce::{Figure, FigureReport, Places, Verdict, check, measure};

/// What `report.json` holds.
#[derive(Serialize)]
struct Reproduction {
    version: &'static str,
    figures: Vec<FigureReport>,
}

/// Reproduces the figures of the arguments.
pub(super) fn reproduce(arguments: &ReproduceArguments, registry: &Arc<Registry>) -> Outcome {
    let memory_bytes = memory::limit(None).map_err(Failure::Refused)?;
    let limits = Limits { memory_bytes };
    let data = arguments.data.as_deref();
    if let Some(missing) = data.filter(|data| !data.is_dir()) {
        let message = format!("there is no folder {}", missing.display());
        return Err(Failure::Refused(message));
    }
    let mut figures = Vec::new();
    for name in &arguments.figures {
        let path = find(name).map_err(Failure::Refused)?;
        let mut figure = read(&path).map_err(Failure::Refused)?;
        figure.seeds = arguments.seeds.unwrap_or(figure.seeds);
        let base = path.parent().unwrap_or(Path::new("")).to_owned();
        check(&figure, &base, registry, limits).map_err(|why| {
            Failure::Refused(format!("{}: {}", path.display(), why.trim_start_matches("error: ")))
        })?;
        figures.push((base, figure));
    }
    let folder = folder::make(arguments.output.as_deref(), "reproduction", arguments.force)
        .map_err(Failure::Refused)?;
    interrupt::watch();
    let mut reports = Vec::new();
    for (base, figure) in figures {
        let mut tell = |what: &str| talk::tell(&format!("{}: {what}", figure.id));
        let mut hook = |_: &Progress<'_>| match interrupt::asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let places = Places { base: &base, data, output: &folder };
        let report = measure(&figure, places, registry, limits, &mut tell, &mut hook);
        let report = report.map_err(|message| match interrupt::asked() {
            true => Failure::Interrupted(message),
            false => Failure::Failed(message),
        })?;
        let absent = report.targets.iter().filter(|target| target.verdict == Verdict::Absent);
        if let Some(first) = absent.clone().next() {
            let (count, why) = (absent.count(), &first.reason);
            talk::tell(&format!("{}: {count} numbers want data: {why}", figure.id));
        }
        talk::say(&table(&report))?;
        reports.push(report);
    }
    let reproduction = Reproduction { version: env!("CARGO_PKG_VERSION"), figures: reports };
    folder::write_json(&folder.join("report.json"), &reproduction).map_err(Failure::Failed)?;
    talk::say(&format!("report {}\n", folder.join("report.json").display()))
}

/// The target file of a figure: a path, the name of a file below `scenarios/thesis`, or that of one
/// below `scenarios` with its folder.
fn find(name: &str) -> Result<PathBuf, String> {
    let below = |folder: &str| Path::new(folder).join(format!("{name}.targets.ron"));
    let named = below("scenarios/thesis");
    let candidates = [PathBuf::from(name), named.clone(), below("scenarios")];
    candidates
        .into_iter()
        .find(|path| path.is_file())
        .ok_or_else(|| format!("there is no target file {name}, nor {}", named.display()))
}

fn read(path: &Path) -> Result<Figure, String> {
    let text = std::fs::read_to_string(path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let source = landform_sim::text::Source::new(path.display().to_string(), text);
    let options = ron::Options::default()
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
        .with_default_extension(ron::extensions::Extensions::UNWRAP_VARIANT_NEWTYPES);
    options
        .from_str(source.text())
        .map_err(|error| landform_sim::text::ron_diagnostic(&source, &error).render(&source))
}

/// The numbers of a figure as a table.
fn table(report: &FigureReport) -> String {
    let width = report.targets.iter().map(|target| target.name.len()).max().unwrap_or(0);
    let mut text = format!("{}: {}\n", report.id, report.title);
    text += &format!(
        "  {:width$}  {:>9}  {:>9}  {:>18}  {:>16}  verdict\n",
        "", report.source, "ours", "over the seeds", "band"
    );
    for target in &report.targets {
        let thesis = target.thesis.map_or("-".to_owned(), |value| value.to_string());
        let digits = decimals(&thesis).max(decimals(&target.band)).max(2);
        let (ours, seeds) = match target.value {
            Some(value) => (format!("{value:.digits$}"), range(&target.seeds, digits)),
            None => ("-".to_owned(), "-".to_owned()),
        };
        text += &format!(
            "  {:width$}  {thesis:>9}  {ours:>9}  {seeds:>18}  {:>16}  {:?}\n",
            target.name, target.band, target.verdict,
        );
        if !target.reason.is_empty() {
            text += &format!("  {:width$}    {}\n", "", target.reason);
        }
    }
    text
}

/// The smallest and the largest of some numbers.
fn range(values: &[f64], digits: usize) -> String {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    format!("{low:.digits$} to {high:.digits$}")
}

/// Most decimals of a number in a text.
fn decimals(text: &str) -> usize {
    let after = text.split('.').skip(1);
    let digits = |rest: &str| rest.chars().take_while(char::is_ascii_digit).count();
    after.map(digits).max().unwrap_or(0)
}
