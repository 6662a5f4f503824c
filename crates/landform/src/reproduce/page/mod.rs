//! The report as one page for a browser, pictures and all, that needs nothing else.

mod picture;
mod section;
mod strip;
mod summary;

use std::fmt::Write;
use std::path::Path;

use super::{Entry, FigureReport, Tally, Verdict};

/// The page: how many numbers are reproduced, then every figure with its pictures, its numbers beside
/// those of the thesis, the verdicts, of which one may be chosen, and the scenarios that made it.
///
/// `reports` are those of `entries`, in their order. Pictures are read from the folder `output`; where
/// a figure has pictures of its own, put together from its runs, those of the runs are only named.
///
/// # Errors
/// A message that names a picture that cannot be read.
pub fn page(entries: &[Entry], reports: &[FigureReport], output: &Path) -> Result<String, String> {
    let (style, script) = (include_str!("page.css"), include_str!("page.js"));
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>Landform: figures and numbers reproduced</title>\n<style>\n{style}</style>\n\
         <h1>Figures and numbers reproduced</h1>\n{}{}",
        summary::summary(entries, reports),
        choice(reports)
    );
    let mut part = "";
    for (entry, report) in entries.iter().zip(reports) {
        if entry.part != part {
            part = &entry.part;
            let _ = writeln!(text, "<h2 class=\"part\">{}</h2>", escape(part));
        }
        text += &section::section(entry, report, output)?;
    }
    let _ = writeln!(text, "<script>\n{script}</script>\n</html>");
    Ok(text)
}

/// The buttons that choose a verdict.
fn choice(reports: &[FigureReport]) -> String {
    let tally = Tally::of(reports);
    let all = tally.all();
    let mut text = format!("<nav><button class=\"on\" data-only=\"all\">all {all}</button>");
    for verdict in Verdict::ALL {
        let (name, count) = (verdict.name(), tally.count(verdict));
        let _ = write!(text, "<button data-only=\"{name}\">{name} {count}</button>");
    }
    text + "</nav>\n"
}

/// Text that a page shows as it is.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
