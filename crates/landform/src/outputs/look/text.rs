//! Writing pictures with what they show in their text entries.

use std::path::Path;

use landform_sim::code::Code;
use landform_sim::parameters::Problem;
use landform_sim::snapshot::Snapshot;
use landform_view::{Image, ViewError};

/// A failure to draw as a problem of the output that wanted the picture.
pub(crate) fn problem(error: &ViewError) -> Problem {
    Problem::new("", error.to_string(), "").code(Code::Picture)
}

/// What goes into the text of a picture of a field: where it came from and its scale.
pub(crate) fn picture_text(snapshot: &Snapshot<'_>, field: &str) -> Vec<(String, String)> {
    let clock = snapshot.clock();
    let unit = snapshot.entry(field).map_or("", |entry| entry.unit);
    let pairs = [
        ("Title", snapshot.title().to_owned()),
        ("Software", concat!("landform ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("field", format!("{field} ({unit})")),
        ("spacing_m", snapshot.lattice().spacing().to_string()),
        ("seed", clock.seed.to_string()),
        ("iteration", clock.tick.to_string()),
    ];
    pairs.map(|(key, value)| (key.to_owned(), value)).into()
}

/// Writes a picture with its text.
pub(crate) fn write_picture(
    image: &Image,
    path: &Path,
    text: &[(String, String)],
) -> Result<(), Problem> {
    let text: Vec<_> = text.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    image.write_png(path, &text).map_err(|error| problem(&error))
}
