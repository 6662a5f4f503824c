//! The legend of a panel, in the corner where it hides least.

use super::axes::SMALL;
use super::drawing::{Anchor, Drawing, Frame, Place, Shape};
use super::figure::Panel;
use super::marks::{LINE_WIDTH, colour, dashes, mark};
use super::series::Series;
use crate::text;

/// Width of the sample of a line.
const SAMPLE: f32 = 24.0;
/// Space around the entries and from the frame.
const GAP: f32 = 6.0;

/// Draws the names of the series that have one; `points` are the places that should stay clear.
pub(super) fn draw(panel: &Panel, frame: Frame, points: Vec<Place>, drawing: &mut Drawing) {
    let entries: Vec<(usize, &Series)> =
        panel.series.iter().enumerate().filter(|(_, series)| !series.name.is_empty()).collect();
    if entries.is_empty() {
        return;
    }
    let line = 1.35 * SMALL;
    let widest = entries.iter().map(|(_, series)| text::width(&series.name, SMALL)).max();
    let size = [widest.unwrap_or(0) as f32 + SAMPLE + 3.0 * GAP, line * entries.len() as f32 + GAP];
    let boxed = corner(frame, size, &points);
    drawing.fill(boxed, [255; 3]);
    drawing.frame(boxed, 0.6, [190; 3]);
    for (row, (index, series)) in entries.into_iter().enumerate() {
        let y = boxed[1] + 0.5 * GAP + (row as f32 + 0.5) * line;
        let left = boxed[0] + GAP;
        let colour = colour(series, index);
        if let Some(style) = series.line {
            let places = vec![[left, y], [left + SAMPLE, y]];
            let dashes = dashes(style);
            drawing.add(Shape::Stroke { places, width: LINE_WIDTH, dashes, colour });
        }
        if let Some(marker) = series.marker {
            mark(drawing, marker, [left + 0.5 * SAMPLE, y], colour);
        }
        drawing.words(&series.name, [left + SAMPLE + GAP, y], SMALL, Anchor::Start);
    }
}

/// The corner of the frame where a box of a size covers the fewest points; the first of equals,
/// from the upper right.
fn corner([left, top, right, bottom]: Frame, [width, height]: [f32; 2], points: &[Place]) -> Frame {
    let boxes = [
        [right - GAP - width, top + GAP],
        [left + GAP, top + GAP],
        [right - GAP - width, bottom - GAP - height],
        [left + GAP, bottom - GAP - height],
    ]
    .map(|[left, top]| [left, top, left + width, top + height]);
    let hidden = |frame: &Frame| {
        let inside = |[x, y]: &&Place| {
            (frame[0]..=frame[2]).contains(x) && (frame[1]..=frame[3]).contains(y)
        };
        points.iter().filter(inside).count()
    };
    boxes.into_iter().min_by_key(hidden).unwrap_or([left, top, left + width, top + height])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_emptiest_corner_is_taken() {
        let frame = [0.0, 0.0, 100.0, 100.0];
        let at = |points: &[Place]| corner(frame, [30.0, 20.0], points);
        assert_eq!(at(&[]), [64.0, 6.0, 94.0, 26.0]);
        assert_eq!(at(&[[70.0, 10.0]]), [6.0, 6.0, 36.0, 26.0]);
        assert_eq!(at(&[[70.0, 10.0], [10.0, 10.0]]), [64.0, 74.0, 94.0, 94.0]);
    }
}
