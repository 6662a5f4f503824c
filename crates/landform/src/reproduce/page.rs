//! The report as one page for a browser, pictures and all, that needs nothing else.

use std::fmt::Write;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::{FigureReport, TargetReport, Verdict};

/// All verdicts, in the order in which the page counts them.
const VERDICTS: [(Verdict, &str); 5] = [
    (Verdict::Reproduced, "reproduced"),
    (Verdict::Partly, "partly"),
    (Verdict::Missed, "missed"),
    (Verdict::Printed, "printed"),
    (Verdict::Absent, "absent"),
];

/// The page: every figure with its pictures, its numbers beside the thesis', and the verdicts, of which
/// one may be chosen.
///
/// Pictures are read from the folder `output`; where a figure has its pictures put together, that one
/// is shown and the others are named.
///
/// # Errors
/// A message that names a picture that cannot be read.
pub fn page(reports: &[FigureReport], output: &Path) -> Result<String, String> {
    let (style, script) = (include_str!("page.css"), include_str!("page.js"));
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Numbers of the thesis beside ours</title>\n<style>\n{style}</style>\n\
         <h1>Numbers of the thesis beside ours</h1>\n<p>{}</p>\n{}",
        summary(reports),
        choice(reports)
    );
    for report in reports {
        text += &section(report, output)?;
    }
    let _ = writeln!(text, "<script>\n{script}</script>\n</html>");
    Ok(text)
}

fn count(reports: &[FigureReport], verdict: Verdict) -> usize {
    let targets = reports.iter().flat_map(|report| &report.targets);
    targets.filter(|target| target.verdict == verdict).count()
}

/// How many of the numbers with a band are reproduced.
fn summary(reports: &[FigureReport]) -> String {
    let [good, partly, missed] = [Verdict::Reproduced, Verdict::Partly, Verdict::Missed]
        .map(|verdict| count(reports, verdict));
    let judged = good + partly + missed;
    let share = 100.0 * good as f64 / judged.max(1) as f64;
    format!(
        "Alexei Pytel, <cite>Erosion, Self-Organization, and Procedural Modeling</cite>, Waterloo \
         2015. Landform {}. {} figures and tables; of {judged} numbers with a band {good} are \
         reproduced ({share:.0} %), {partly} partly, {missed} missed. A number is the median over \
         the seeds; it is reproduced where it lies in the band together with more than three in four \
         of the seeds, and partly where fewer do.",
        env!("CARGO_PKG_VERSION"),
        reports.len()
    )
}

fn choice(reports: &[FigureReport]) -> String {
    let all: usize = reports.iter().map(|report| report.targets.len()).sum();
    let mut text = format!("<nav><button class=\"on\" data-only=\"all\">all {all}</button>");
    for (verdict, name) in VERDICTS {
        let count = count(reports, verdict);
        let _ = write!(text, "<button data-only=\"{name}\">{name} {count}</button>");
    }
    text + "</nav>\n"
}

fn section(report: &FigureReport, output: &Path) -> Result<String, String> {
    let name = escape(&report.name);
    let scenarios: Vec<String> =
        report.scenarios.iter().map(|path| escape(&path.display().to_string())).collect();
    let mut text = format!(
        "<section id=\"{name}\">\n<h2>{}: {}</h2>\n\
         <p class=\"how\"><code>landform reproduce {name}</code> {}</p>\n<div class=\"pictures\">\n",
        escape(&report.id),
        escape(&report.title),
        scenarios.join(", ")
    );
    // The sheet, where there is one, lies in the folder of the figure itself.
    let is_sheet = |path: &&std::path::PathBuf| path.components().count() == 2;
    let sheets: Vec<_> = report.pictures.iter().filter(is_sheet).collect();
    let shown = if sheets.is_empty() { report.pictures.iter().collect() } else { sheets };
    for picture in shown {
        let path = output.join(picture);
        let bytes = std::fs::read(&path)
            .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let file = escape(&picture.display().to_string());
        let data = STANDARD.encode(bytes);
        let _ = writeln!(
            text,
            "<img alt=\"{file}\" title=\"{file}\" loading=\"lazy\" src=\"data:{};base64,{data}\">",
            kind(picture)
        );
    }
    let _ = writeln!(
        text,
        "</div>\n<table>\n<thead><tr><th></th><th>{}</th><th>ours</th><th>over the seeds</th>\
         <th>band</th><th>verdict</th></tr></thead>\n<tbody>",
        escape(&report.source)
    );
    report.targets.iter().for_each(|target| text += &row(target));
    Ok(text + "</tbody>\n</table>\n</section>\n")
}

fn row(target: &TargetReport) -> String {
    let name =
        VERDICTS.iter().find(|(verdict, _)| *verdict == target.verdict).map_or("", |of| of.1);
    let [thesis, ours, seeds] = target.columns();
    let reason = match target.reason.as_str() {
        "" => String::new(),
        reason => format!("<small>{}</small>", escape(reason)),
    };
    format!(
        "<tr class=\"{name}\"><td>{}</td><td>{thesis}</td><td>{ours}</td><td>{seeds}</td>\
         <td>{}</td><td><b>{name}</b>{reason}</td></tr>\n",
        escape(&target.name),
        escape(&target.band)
    )
}

/// The media type of a picture.
fn kind(picture: &Path) -> &'static str {
    match picture.extension().and_then(|extension| extension.to_str()) {
        Some("gif") => "image/gif",
        Some("svg") => "image/svg+xml",
        _ => "image/png",
    }
}

/// Text that a page shows as it is.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
