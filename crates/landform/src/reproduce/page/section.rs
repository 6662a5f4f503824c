//! One figure on the page.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use super::{escape, picture, strip};
use crate::reproduce::{Entry, FigureReport, TargetReport};

/// A figure: what it shows, its pictures, its numbers, and the scenarios that made it.
pub(super) fn section(
    entry: &Entry,
    report: &FigureReport,
    output: &Path,
) -> Result<String, String> {
    let name = escape(&report.name);
    let mut text = format!(
        "<section id=\"{name}\">\n<h3>{}: {}</h3>\n",
        escape(&report.id),
        escape(&report.title)
    );
    let mut said: Vec<&str> = entry.scenarios.iter().map(|of| of.description.as_str()).collect();
    said.dedup();
    said.iter().filter(|of| !of.is_empty()).for_each(|of| {
        let _ = writeln!(text, "<p>{}</p>", escape(of));
    });
    text += "<div class=\"pictures\">\n";
    for path in shown(report) {
        text += &picture::picture(path, &output.join(path))?;
    }
    text += "</div>\n";
    if !report.targets.is_empty() {
        let _ = writeln!(
            text,
            "<table>\n<thead><tr><th></th><th>{}</th><th>ours</th><th>over the seeds</th>\
             <th>band</th><th></th><th>verdict</th></tr></thead>\n<tbody>",
            escape(&report.source)
        );
        entry.figure.targets.iter().zip(&report.targets).for_each(|(target, found)| {
            text += &row(found, &strip::strip(target.band, found));
        });
        text += "</tbody>\n</table>\n";
    }
    Ok(text + &how(entry, &name) + "</section>\n")
}

/// The pictures that are put together from those of the runs, which lie in the folder of the figure
/// itself; those of the runs where there are none.
fn shown(report: &FigureReport) -> Vec<&PathBuf> {
    let is_sheet = |path: &&PathBuf| {
        path.strip_prefix(&report.name).is_ok_and(|within| within.components().count() == 1)
    };
    let sheets: Vec<_> = report.pictures.iter().filter(is_sheet).collect();
    if sheets.is_empty() { report.pictures.iter().collect() } else { sheets }
}

/// The command, the runs and the texts of their scenarios.
fn how(entry: &Entry, name: &str) -> String {
    let mut text = format!(
        "<details><summary>How it was made: <code>landform reproduce {name}</code></summary>\n"
    );
    if !entry.figure.runs.is_empty() {
        text += "<ul>\n";
        for run in &entry.figure.runs {
            let mut changes: Vec<String> = run.set.clone();
            changes.extend(run.over.as_ref().map(|over| {
                format!("{} from {} to {} in {} runs", over.path, over.from, over.to, over.count)
            }));
            let (run_name, scenario) = (escape(&run.name), escape(&shown_path(&run.scenario)));
            let changes = escape(&changes.join("; "));
            let with = if changes.is_empty() { "" } else { " with " };
            let _ = writeln!(
                text,
                "<li>{run_name}: <code>{scenario}</code>{with}<code>{changes}</code></li>"
            );
        }
        text += "</ul>\n";
    }
    for scenario in &entry.scenarios {
        let (path, scenario) = (escape(&shown_path(&scenario.path)), escape(&scenario.text));
        let _ = writeln!(
            text,
            "<details><summary><code>{path}</code></summary><pre>{scenario}</pre></details>"
        );
    }
    text + "</details>\n"
}

fn shown_path(path: &Path) -> String {
    path.display().to_string()
}

fn row(target: &TargetReport, strip: &str) -> String {
    let name = target.verdict.name();
    let [thesis, ours, seeds] = target.columns();
    let reason = match target.reason.as_str() {
        "" => String::new(),
        reason => format!("<small>{}</small>", escape(reason)),
    };
    format!(
        "<tr class=\"{name}\"><td>{}</td><td>{thesis}</td><td>{ours}</td><td>{seeds}</td>\
         <td>{}</td><td>{strip}</td><td><b>{name}</b>{reason}</td></tr>\n",
        escape(&target.name),
        escape(&target.band)
    )
}
