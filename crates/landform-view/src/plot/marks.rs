//! Colours, dashes and the shapes of points.

use super::drawing::{Colour, Drawing, Place, Shape};
use super::series::{Line, Marker, Series};

/// Colours that can be told apart by the colour-blind, without yellow, which is too light for
/// lines (Okabe and Ito 2008, "Color universal design").
pub(super) const COLOURS: [Colour; 7] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [60, 60, 60],
];

/// Width of the lines of series.
pub(super) const LINE_WIDTH: f32 = 1.6;

/// The colour of a series that stands at `index` in its panel.
pub(super) fn colour(series: &Series, index: usize) -> Colour {
    COLOURS[series.colour.unwrap_or(index) % COLOURS.len()]
}

/// Lengths of the dashes and gaps of a line.
pub(super) fn dashes(line: Line) -> &'static [f32] {
    match line {
        Line::Solid => &[],
        Line::Dashed => &[6.0, 4.0],
        Line::Dotted => &[1.5, 3.0],
    }
}

/// Draws a marker.
pub(super) fn mark(drawing: &mut Drawing, marker: Marker, at: Place, colour: Colour) {
    let polygon = |count: usize, radius: f32, turn: f32| {
        let corner = |index: usize| {
            let angle = std::f32::consts::TAU * (index as f32 / count as f32 + turn);
            [at[0] + radius * angle.cos(), at[1] - radius * angle.sin()]
        };
        (0..count).map(corner).collect()
    };
    let corners = match marker {
        Marker::Disc => polygon(24, 3.4, 0.0),
        Marker::Dot => polygon(12, 1.6, 0.0),
        Marker::Square => polygon(4, 4.2, 0.125),
        Marker::Diamond => polygon(4, 4.4, 0.0),
        Marker::Triangle => polygon(3, 4.6, 0.25),
    };
    drawing.add(Shape::Fill { corners, colour });
}
