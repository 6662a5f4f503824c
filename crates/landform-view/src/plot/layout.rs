//! Where the parts of a figure go.

use super::axes::{Axes, SMALL};
use super::drawing::{Anchor, Drawing, Frame};
use super::figure::Figure;
use crate::montage::letter_name;

/// Height of the letters of titles.
const TITLE: f32 = 14.0;
/// Space at the borders of a panel.
const GAP: f32 = 10.0;

/// Draws all panels in rows.
pub(super) fn draw(figure: &Figure) -> Drawing {
    let columns = figure.columns.min(figure.panels.len());
    let rows = figure.panels.len().div_ceil(columns);
    let [width, height] = figure.panel_size.map(|size| size as f32);
    let heading = if figure.title.is_empty() { 0.0 } else { 2.0 * TITLE };
    let size = [width * columns as f32, height * rows as f32 + heading];
    let mut drawing = Drawing { size, ..Drawing::default() };
    drawing.words(&figure.title, [0.5 * size[0], 1.2 * TITLE], TITLE, Anchor::Middle);
    let axes: Vec<Axes> =
        figure.panels.iter().map(|panel| Axes::of(panel, figure.panel_size)).collect();
    // Panels below each other begin at one line.
    let widest = |column: usize| {
        let below = axes.iter().skip(column).step_by(columns);
        below.map(Axes::numbers_width).fold(0.0, f32::max)
    };
    let numbers: Vec<f32> = (0..columns).map(widest).collect();
    let letters = figure.panels.len() > 1;
    for (index, (panel, own)) in figure.panels.iter().zip(&axes).enumerate() {
        let (column, row) = (index % columns, index / columns);
        let corner = [column as f32 * width, heading + row as f32 * height];
        let words = match letters {
            true => format!("({}) {}", letter_name(index + 1), panel.title),
            false => panel.title.clone(),
        };
        let frame = frame(corner, [width, height], numbers[column], !words.is_empty());
        drawing.words(&words, [frame[0], frame[1] - 0.9 * SMALL], 1.1 * SMALL, Anchor::Start);
        own.draw(panel, frame, &mut drawing);
    }
    drawing
}

/// The frame of a plot inside its panel, with room for numbers, labels and a title.
fn frame([left, top]: [f32; 2], [width, height]: [f32; 2], numbers: f32, title: bool) -> Frame {
    [
        // Long names beside an axis must leave room for the plot.
        left + GAP + 1.8 * SMALL + numbers.min(0.4 * width) + 6.0,
        top + GAP + if title { 1.8 * SMALL } else { 0.0 },
        left + width - 1.8 * GAP,
        top + height - GAP - 3.4 * SMALL,
    ]
}
