//! `landform reproduce`: numbers of the thesis beside ours.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use landform_sim::code::Code;
use landform_sim::registry::Registry;
use landform_sim::simulation::Limits;
use serde::Serialize;

use super::arguments::ReproduceArguments;
use super::{Failure, Outcome, failed, folder, interrupt, memory, refused, talk};
use crate::reproduce::{
    Entry, FigureReport, Record, Tally, Verdict, Work, all, find, markdown, page,
};

/// Where the thesis' target files lie, from where the program is called.
const THESIS: &str = "scenarios/thesis";

/// What `report.json` holds.
#[derive(Serialize)]
struct Reproduction<'a> {
    version: &'static str,
    figures: &'a [FigureReport],
}

/// Reproduces the figures of the arguments.
pub(super) fn reproduce(arguments: &ReproduceArguments, registry: &Arc<Registry>) -> Outcome {
    let data = arguments.data.as_deref();
    if let Some(missing) = data.filter(|data| !data.is_dir()) {
        let message = format!("there is no folder {}", missing.display());
        return Err(Failure::refused(Code::Arguments, message));
    }
    let processors = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let jobs = arguments.jobs.map_or_else(processors, usize::from);
    let memory_bytes = memory::limit(None).map_err(refused(Code::Arguments))? / jobs.max(1) as u64;
    let limits = Limits { memory_bytes };
    let entries = entries(arguments, registry, limits).map_err(refused(Code::Figure))?;
    let folder = folder::make(
        arguments.output.as_deref(),
        "reproduction",
        arguments.force || arguments.resume,
    )?;
    let record = if arguments.resume { Record::read(&folder) } else { Ok(Record::new()) };
    let record = record.map_err(refused(Code::DamagedFile))?;
    interrupt::watch();
    let work = Work {
        entries: &entries,
        data,
        output: &folder,
        registry,
        limits,
        jobs,
        tell: &|what| talk::tell(what),
        stop: &interrupt::asked,
    };
    let reports = work.reproduce(record).map_err(|message| match interrupt::asked() {
        true => Failure::interrupted(format!("{message}; go on with --resume")),
        false => Failure::failed(Code::FailedFigure, message),
    })?;
    for report in &reports {
        let absent = report.targets.iter().filter(|target| target.verdict == Verdict::Absent);
        if let Some(first) = absent.clone().next() {
            let (count, why) = (absent.count(), &first.reason);
            talk::tell(&format!("{}: {count} numbers want data: {why}", report.id));
        }
        talk::say(&table(report))?;
    }
    let reproduction = Reproduction { version: env!("CARGO_PKG_VERSION"), figures: &reports };
    let [json, html, text] =
        ["report.json", "report.html", "report.md"].map(|name| folder.join(name));
    folder::write_json(&json, &reproduction).map_err(failed(Code::Unwritable))?;
    let page = page(&entries, &reports, &folder).map_err(failed(Code::Unwritable))?;
    folder::write_text(&html, &page).map_err(failed(Code::Unwritable))?;
    folder::write_text(&text, &markdown(&entries, &reports)).map_err(failed(Code::Unwritable))?;
    let written = [json, html, text].map(|path| format!("report {}\n", path.display())).concat();
    talk::say(&format!("{}\n{written}", Tally::of(&reports)))
}

/// The figures that the arguments ask for.
fn entries(
    arguments: &ReproduceArguments,
    registry: &Arc<Registry>,
    limits: Limits,
) -> Result<Vec<Entry>, String> {
    let thesis = Path::new(THESIS);
    let mut paths: Vec<PathBuf> = match (arguments.all, &arguments.chapter) {
        (false, None) => Vec::new(),
        (_, chapter) => all(thesis, chapter.as_deref())?,
    };
    for name in &arguments.figures {
        let found = find(name, thesis)?;
        let new: Vec<PathBuf> = found.into_iter().filter(|path| !paths.contains(path)).collect();
        paths.extend(new);
    }
    let mut entries: Vec<Entry> = Vec::with_capacity(paths.len());
    for path in paths {
        let seeds = if arguments.quick { Some(1) } else { arguments.seeds };
        let entry = Entry::read(&path, thesis, seeds, registry, limits)?;
        if let Some(other) = entries.iter().find(|other| other.name == entry.name) {
            let (name, base) = (&entry.name, other.base.display());
            return Err(format!("two target files are called {name}, the first in {base}"));
        }
        entries.push(entry);
    }
    Ok(entries)
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
        let [thesis, ours, seeds] = target.columns();
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
