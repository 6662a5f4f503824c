//! Pictures between the axes of a panel, and what their colours mean.

use super::axes::{SMALL, beside};
use super::axis::Axis;
use super::drawing::{Anchor, Drawing, Frame, INK};
use super::ticks::ticks;
use crate::shade::Ground;
use crate::{Image, text};

/// A picture that lies below the series of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// The picture.
    pub image: Image,
    /// Values of the horizontal axis at its left and its right edge.
    pub x: [f64; 2],
    /// Values of the vertical axis at its lower and its upper edge.
    pub y: [f64; 2],
}

/// A bar of colours beside a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourScale {
    /// How values become colours.
    pub ground: Ground,
    /// Lowest and highest value.
    pub range: [f64; 2],
    /// What the values are, with their unit.
    pub label: String,
}

/// Width of the bar.
const BAR: f32 = 10.0;
/// Space between the plot and the bar.
const GAP: f32 = 10.0;
/// Pieces that the bar is made of.
const PIECES: usize = 96;
/// Room that a number takes along the bar.
const NUMBER_HEIGHT: f32 = 25.0;

impl ColourScale {
    /// Room that the bar takes to the right of a plot.
    pub(super) fn room(&self, height: f32) -> f32 {
        GAP + BAR + 8.0 + self.numbers_width(height) + 1.9 * SMALL
    }

    fn numbers_width(&self, height: f32) -> f32 {
        let texts = self.marks(height).into_iter();
        texts.map(|(_, text)| text::width(&text, SMALL) as f32).fold(0.0, f32::max)
    }

    /// Shares of the height from below, and the numbers that stand there.
    fn marks(&self, height: f32) -> Vec<(f32, String)> {
        let axis = Axis { range: Some(self.range), ..Axis::default() };
        let span = axis.span(std::iter::empty());
        let ticks = ticks(&span, (height / NUMBER_HEIGHT) as usize);
        let on_bar = ticks.into_iter().map(|tick| (span.share(tick.value) as f32, tick.text));
        let on_bar = on_bar.filter(|(share, _)| (-1e-6..=1.0 + 1e-6).contains(share));
        on_bar.filter_map(|(share, text)| Some((share, text?))).collect()
    }

    /// Draws the bar to the right of a plot.
    pub(super) fn draw(&self, frame: Frame, drawing: &mut Drawing) {
        let [_, top, right, bottom] = frame;
        let left = right + GAP;
        let height = bottom - top;
        let [low, high] = self.range;
        for piece in 0..PIECES {
            let share = |piece: usize| piece as f32 / PIECES as f32;
            let value = low + (high - low) * f64::from(share(piece) + 0.5 / PIECES as f32);
            let colour = self.ground.colours.colour(self.ground.place(value, self.range));
            // Pieces overlap, or gaps would show between them.
            let upper = (bottom - height * share(piece + 1) - 0.5).max(top);
            drawing.fill([left, upper, left + BAR, bottom - height * share(piece)], colour);
        }
        drawing.frame([left, top, left + BAR, bottom], 0.6, INK);
        for (share, text) in self.marks(height) {
            let y = bottom - share * height;
            drawing.line([left + BAR, y], [left + BAR + 4.0, y], 1.0, INK);
            drawing.words(&text, [left + BAR + 8.0, y], SMALL, Anchor::Start);
        }
        let x = left + BAR + 8.0 + self.numbers_width(height) + 0.9 * SMALL;
        beside(&self.label, x, frame, drawing);
    }
}
