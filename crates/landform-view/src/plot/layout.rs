//! Where the parts of a figure go.

use super::axes::{Axes, SMALL};
use super::drawing::{Anchor, Drawing, Frame};
use super::figure::{Figure, Panel};
use crate::montage::letter_name;
use crate::text;

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
        figure.panels.iter().map(|panel| axes(panel, figure.panel_size)).collect();
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
        let room = room(panel, corner, [width, height], numbers[column], !words.is_empty());
        drawing.words(&words, [room[0], room[1] - 0.9 * SMALL], 1.1 * SMALL, Anchor::Start);
        let frame = match panel.exaggeration.or(panel.bare.then_some(1.0)) {
            Some(exaggeration) => fitted(room, own.aspect() / exaggeration),
            None => room,
        };
        own.draw(panel, frame, &mut drawing);
        if let Some(colours) = &panel.colours {
            colours.draw(frame, &mut drawing);
        }
        // Below the plot, but not beyond the panel however narrow the plot is.
        let half = 0.5 * text::width(&panel.caption, SMALL) as f32;
        let middle = (0.5 * (frame[0] + frame[2])).max(corner[0] + GAP + half);
        let below = [middle, corner[1] + height - 0.9 * SMALL];
        drawing.words(&panel.caption, below, SMALL, Anchor::Middle);
    }
    drawing
}

/// The axes of a panel of a size, with as many numbers as its plot has room for.
fn axes(panel: &Panel, [width, height]: [f64; 2]) -> Axes {
    let axes = Axes::of(panel, [width, height]);
    let Some(exaggeration) = panel.exaggeration else { return axes };
    let room = [0.0, 0.0, width as f32, height as f32];
    let [left, top, right, bottom] = fitted(room, axes.aspect() / exaggeration);
    Axes::of(panel, [(right - left).into(), (bottom - top).into()])
}

/// The frame that a plot inside its panel may have, with room for numbers, labels, a title, a
/// caption and a bar of colours.
fn room(
    panel: &Panel,
    [left, top]: [f32; 2],
    [width, height]: [f32; 2],
    numbers: f32,
    title: bool,
) -> Frame {
    let top_of_plot = top + GAP + if title { 1.8 * SMALL } else { 0.0 };
    let caption = if panel.caption.is_empty() { 0.0 } else { 1.6 * SMALL };
    let (beside, below) = match panel.bare {
        true => (0.0, 0.0),
        // Long names beside an axis must leave room for the plot.
        false => (1.8 * SMALL + numbers.min(0.4 * width) + 6.0, 3.4 * SMALL),
    };
    let bottom = top + height - GAP - below - caption;
    let scale = panel.colours.as_ref().map_or(0.0, |colours| colours.room(bottom - top_of_plot));
    [left + GAP + beside, top_of_plot, left + width - 1.8 * GAP - scale, bottom]
}

/// The largest frame of an aspect inside another, in its upper left corner.
fn fitted([left, top, right, bottom]: Frame, aspect: f64) -> Frame {
    let [width, height] = [right - left, bottom - top];
    let aspect = if aspect.is_finite() && aspect > 0.0 { aspect as f32 } else { 1.0 };
    // Nothing is thinner than a tenth of its room, however long the map is.
    let [across, down] = match width / height > aspect {
        true => [(height * aspect).max(0.1 * width), height],
        false => [width, (width / aspect).max(0.1 * height)],
    };
    [left, top, left + across, top + down]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_units_fit_into_their_room() {
        let room = [10.0, 20.0, 210.0, 120.0];
        assert_eq!(fitted(room, 2.0), room);
        assert_eq!(fitted(room, 1.0), [10.0, 20.0, 110.0, 120.0]);
        assert_eq!(fitted(room, 4.0), [10.0, 20.0, 210.0, 70.0]);
        for aspect in [1e-9, 1e9, 0.0, f64::NAN] {
            let [left, top, right, bottom] = fitted(room, aspect);
            assert!(right > left && bottom > top, "{aspect}");
        }
    }
}
