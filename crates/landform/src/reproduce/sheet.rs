//! One figure of the pictures of several runs, laid out as in the thesis.

use std::path::{Path, PathBuf};

use landform_view::Image;
use landform_view::montage::{MontageOptions, Panel, Row, panels};

use super::Figure;

/// Writes a figure of the first pictures of all runs and analyses, `drawn` with their names, side by
/// side, and returns its name in `folder`; `None` when none is asked for or nothing was drawn.
pub(super) fn write(
    figure: &Figure,
    drawn: &[(&str, Vec<PathBuf>)],
    folder: &Path,
) -> Result<Option<PathBuf>, String> {
    let mut pictures = Vec::new();
    for (name, drawn) in drawn {
        let Some(first) = drawn.first() else { continue };
        let read = Image::read_png(&folder.join(first)).map_err(|error| error.to_string())?;
        pictures.push(Panel { image: read.0, caption: (*name).to_owned() });
    }
    if figure.columns == 0 || pictures.is_empty() {
        return Ok(None);
    }
    let rows = pictures.chunks(figure.columns);
    let rows: Vec<Row> =
        rows.map(|row| Row { heading: String::new(), panels: row.to_vec() }).collect();
    let options = MontageOptions { letters: false, ..MontageOptions::default() };
    let sheet = panels(&rows, &options).map_err(|error| error.to_string())?;
    let name = PathBuf::from(format!("{}.png", file_name(&figure.id)));
    let title = [("Title", figure.title.as_str())];
    sheet.write_png(&folder.join(&name), &title).map_err(|error| error.to_string())?;
    Ok(Some(name))
}

/// The name of a figure with nothing in it that a file name cannot hold.
fn file_name(id: &str) -> String {
    id.chars().map(|letter| if letter.is_ascii_alphanumeric() { letter } else { '_' }).collect()
}
