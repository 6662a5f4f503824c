//! The contact sheet: a small picture of every point.

use std::path::Path;

use landform_view::Image;
use landform_view::montage::{MontageOptions, Panel, Row, panels};

use super::{Plan, Results};

/// Widest small picture, in pixels.
const WIDTH: usize = 300;
/// Most pictures on a sheet, and most in a row.
const MOST: usize = 60;
const MOST_IN_ROW: usize = 6;

/// Writes the first pictures of the first run at each point, as far as there are any.
pub(super) fn write(results: &Results<'_>, path: &Path) -> Result<bool, String> {
    let mut points = std::collections::BTreeSet::new();
    let first =
        results.runs.iter().filter(|run| run.picture.is_some() && points.insert(run.run.point));
    let first: Vec<_> = first.collect();
    let columns = columns(results.plan, first.len());
    let mut rows: Vec<Row> = Vec::new();
    for (index, run) in first.iter().take(MOST).enumerate() {
        // A picture that was removed since is left out.
        let Some(Ok((image, _))) = run.picture.as_deref().map(Image::read_png) else { continue };
        let values = results.plan.describe(run.run);
        let caption = format!("run {}: {values}", run.run.number);
        if index % columns == 0 || rows.is_empty() {
            rows.push(Row { heading: String::new(), panels: Vec::new() });
        }
        if let Some(row) = rows.last_mut() {
            row.panels.push(Panel { image: image.shrunk(WIDTH), caption });
        }
    }
    rows.retain(|row| !row.panels.is_empty());
    if rows.is_empty() {
        return Ok(false);
    }
    if let (Some(row), true) = (rows.first_mut(), first.len() > MOST) {
        row.heading = format!("the first {MOST} of {} points", first.len());
    }
    let options = MontageOptions { letters: false, text_size: 12.0, ..MontageOptions::default() };
    let sheet = panels(&rows, &options).map_err(|error| error.to_string())?;
    let title = [("Title", results.plan.title.as_str())];
    sheet.write_png(path, &title).map_err(|error| error.to_string())?;
    Ok(true)
}

/// Pictures in a row: the values of the last parameter where they fit, so that rows and columns
/// of a grid are those of the sheet.
fn columns(plan: &Plan, pictures: usize) -> usize {
    let last: std::collections::BTreeSet<&String> =
        plan.runs.iter().filter_map(|run| run.values.last()).collect();
    match last.len() {
        count @ 2..=MOST_IN_ROW if pictures.is_multiple_of(count) => count,
        _ => ((pictures as f64).sqrt().ceil() as usize).clamp(1, MOST_IN_ROW),
    }
}
