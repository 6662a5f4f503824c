//! Figures of an analysis, laid out as figure 4.22 of the thesis.

mod cave;
mod density;
mod lines;
mod map;
mod raster;
mod streams;
mod view;

use landform_view::plot::{Axis, Note, Panel};

pub(super) use cave::figure as cave_figure;
pub(super) use lines::figure as lines_figure;
pub(super) use raster::figure as raster_figure;
pub(super) use streams::Streams;

/// Width and height of a panel, in units of the figure.
const PANEL: [f64; 2] = [400.0, 370.0];
/// Pixels a unit of the PNG.
const PIXELS_PER_UNIT: f64 = 2.0;

/// A panel with nothing but the reason.
fn empty(title: &str, reason: &str) -> Panel {
    let axis = || Axis { range: Some([0.0, 1.0]), ..Axis::default() };
    Panel {
        title: title.to_owned(),
        x: axis(),
        y: axis(),
        notes: vec![Note { at: [0.1, 0.5], text: reason.to_owned() }],
        ..Panel::default()
    }
}

/// A title that leaves out the folders of a file.
fn title(file: &str) -> String {
    let path = std::path::Path::new(file);
    path.file_name().map_or_else(|| file.to_owned(), |name| name.to_string_lossy().into_owned())
}
