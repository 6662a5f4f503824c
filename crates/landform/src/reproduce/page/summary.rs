//! How many numbers are reproduced, by chapters and other sources.

use std::fmt::Write;

use super::escape;
use crate::reproduce::{Entry, FigureReport, Tally, Verdict};

/// The opening words, and a table with a row for every part.
pub(super) fn summary(entries: &[Entry], reports: &[FigureReport]) -> String {
    let mut text = format!(
        "<p>Alexei Pytel, <cite>Erosion, Self-Organization, and Procedural Modeling</cite>, Waterloo \
         2015, and what other sources say of the same landforms. Landform {}. {} figures and \
         tables; {}.</p>\n\
         <p>A number is the median over the seeds, or their mean where its source has means. It is \
         reproduced where it lies in the band together with more than three in four of the seeds, \
         partly where fewer do, and missed where it lies outside. Strips show the band, a dot for \
         every seed, and a line at the number of the source.</p>\n\
         <table class=\"parts\">\n<thead><tr><th></th><th>figures</th>",
        env!("CARGO_PKG_VERSION"),
        reports.len(),
        Tally::of(reports)
    );
    Verdict::ALL.iter().for_each(|of| text += &format!("<th>{}</th>", of.name()));
    text += "</tr></thead>\n<tbody>\n";
    let mut start = 0;
    for group in entries.chunk_by(|one, other| one.part == other.part) {
        let of_part = &reports[start..start + group.len()];
        start += group.len();
        let (part, name) = (escape(&group[0].part), escape(&group[0].name));
        let _ = write!(text, "<tr><td><a href=\"#{name}\">{part}</a></td><td>{}</td>", group.len());
        let tally = Tally::of(of_part);
        for verdict in Verdict::ALL {
            let (name, count) = (verdict.name(), tally.count(verdict));
            let _ = write!(text, "<td class=\"{name}\"><b>{count}</b></td>");
        }
        text += "</tr>\n";
    }
    text + "</tbody>\n</table>\n"
}
