//! How many numbers are reproduced, by chapters and other sources.

use std::fmt::Write;

use super::{VERDICTS, count, escape};
use crate::reproduce::{Entry, FigureReport, Verdict};

/// The opening words, and a table with a row for every part.
pub(super) fn summary(entries: &[Entry], reports: &[FigureReport]) -> String {
    let [good, partly, missed] = [Verdict::Reproduced, Verdict::Partly, Verdict::Missed]
        .map(|verdict| count(reports, verdict));
    let judged = good + partly + missed;
    let share = 100.0 * good as f64 / judged.max(1) as f64;
    let mut text = format!(
        "<p>Alexei Pytel, <cite>Erosion, Self-Organization, and Procedural Modeling</cite>, Waterloo \
         2015, and what other sources say of the same landforms. Landform {}. {} figures and tables; \
         of {judged} numbers with a band {good} are reproduced ({share:.0} %), {partly} partly, \
         {missed} missed.</p>\n\
         <p>A number is the median over the seeds, or their mean where its source has means. It is \
         reproduced where it lies in the band together with more than three in four of the seeds, \
         partly where fewer do, and missed where it lies outside. Strips show the band, a dot for \
         every seed, and a line at the number of the source.</p>\n\
         <table class=\"parts\">\n<thead><tr><th></th><th>figures</th>",
        env!("CARGO_PKG_VERSION"),
        reports.len()
    );
    VERDICTS.iter().for_each(|(_, name)| text += &format!("<th>{name}</th>"));
    text += "</tr></thead>\n<tbody>\n";
    let mut start = 0;
    for group in entries.chunk_by(|one, other| one.part == other.part) {
        let of_part = &reports[start..start + group.len()];
        start += group.len();
        let (part, name) = (escape(&group[0].part), escape(&group[0].name));
        let _ = write!(text, "<tr><td><a href=\"#{name}\">{part}</a></td><td>{}</td>", group.len());
        for (verdict, name) in VERDICTS {
            let _ = write!(text, "<td class=\"{name}\"><b>{}</b></td>", count(of_part, verdict));
        }
        text += "</tr>\n";
    }
    text + "</tbody>\n</table>\n"
}
