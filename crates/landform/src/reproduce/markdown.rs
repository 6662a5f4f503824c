//! The report as a page of the book.

use std::fmt::Write;

use super::{Entry, FigureReport, Tally, TargetReport, Verdict};

/// All numbers in Markdown: how many of each part have which verdict, then a table for each figure,
/// with what is known about differences below it. `reports` are those of `entries`, in their order.
pub fn markdown(entries: &[Entry], reports: &[FigureReport]) -> String {
    let mut text = "| | figures |".to_owned();
    Verdict::ALL.iter().for_each(|of| text += &format!(" {} |", of.name()));
    text += "\n|---|";
    text += &"--:|".repeat(Verdict::ALL.len() + 1);
    text.push('\n');
    let mut sections = String::new();
    let mut rest = reports;
    for group in entries.chunk_by(|one, other| one.part == other.part) {
        let (of_part, after) = rest.split_at(group.len());
        rest = after;
        text += &counts(&group[0].part, of_part);
        let _ = write!(sections, "\n## {}\n", group[0].part);
        of_part.iter().for_each(|report| sections += &figure(report));
    }
    text += &counts("all", reports);
    text + &sections
}

/// A row of the table of parts.
fn counts(part: &str, reports: &[FigureReport]) -> String {
    let mut text = format!("| {part} | {} |", reports.len());
    let tally = Tally::of(reports);
    Verdict::ALL.iter().for_each(|of| text += &format!(" {} |", tally.count(*of)));
    text + "\n"
}

fn figure(report: &FigureReport) -> String {
    let mut text = format!("\n### {}: {}\n\n`{}`\n", report.id, report.title, report.name);
    if report.targets.is_empty() {
        return text;
    }
    let source = &report.source;
    let _ = write!(
        text,
        "\n| | {source} | ours | over the seeds | band | verdict |\n|---|--:|--:|--:|--:|---|\n"
    );
    report.targets.iter().for_each(|target| text += &row(target));
    let with_reason = report.targets.iter().filter(|target| !target.reason.is_empty());
    for (index, target) in with_reason.enumerate() {
        let before = if index == 0 { "\n" } else { "" };
        let _ = writeln!(text, "{before}- {}: {}.", target.name, target.reason);
    }
    text
}

fn row(target: &TargetReport) -> String {
    let [thesis, ours, seeds] = target.columns();
    let verdict = match target.verdict {
        bad @ (Verdict::Partly | Verdict::Missed) => format!("**{}**", bad.name()),
        other => other.name().to_owned(),
    };
    let name = target.name.replace('|', "\\|");
    format!("| {name} | {thesis} | {ours} | {seeds} | {} | {verdict} |\n", target.band)
}
