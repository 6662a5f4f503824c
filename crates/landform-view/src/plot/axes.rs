//! The axes of a panel and what stands between them.

use super::axis::Span;
use super::drawing::{Anchor, Colour, Drawing, Frame, INK, Place, Shape, Words};
use super::figure::Panel;
use super::legend;
use super::marks::{LINE_WIDTH, colour, dashes, mark};
use super::picture::Picture;
use super::series::{Area, Rule, Series};
use super::ticks::{Tick, named, ticks};
use crate::text;

/// Height of the letters beside axes.
pub(super) const SMALL: f32 = 11.0;
/// Ink of the rules behind series.
const GREY: Colour = [150; 3];
/// Ink of the lines that ticks stand on.
const FAINT: Colour = [228; 3];
/// Room that a number of the horizontal axis takes, in units.
const NUMBER_WIDTH: f64 = 62.0;
/// Room that a number of the vertical axis takes, in units.
const NUMBER_HEIGHT: f64 = 40.0;

/// The ranges and ticks of a panel.
pub(super) struct Axes {
    x: Span,
    y: Span,
    x_ticks: Vec<Tick>,
    y_ticks: Vec<Tick>,
}

impl Axes {
    /// The axes of a panel of a size.
    pub fn of(panel: &Panel, [width, height]: [f64; 2]) -> Self {
        let points = || panel.series.iter().flat_map(|series| &series.points);
        let corners = || panel.areas.iter().flat_map(|area| &area.corners);
        let x = panel.x.span(points().map(|point| point.x).chain(corners().map(|at| at[0])));
        let ends = points().flat_map(|p| [Some(p.y), p.error.map(|e| e[0]), p.error.map(|e| e[1])]);
        let y = panel.y.span(ends.flatten().chain(corners().map(|at| at[1])));
        let marks = |names: &[String], span: &Span, most: f64| match names.is_empty() {
            true => ticks(span, most as usize),
            false => named(names),
        };
        Self {
            x_ticks: marks(&panel.x.names, &x, width / NUMBER_WIDTH),
            y_ticks: marks(&panel.y.names, &y, height / NUMBER_HEIGHT),
            x,
            y,
        }
    }

    /// Width of the widest number of the vertical axis.
    pub fn numbers_width(&self) -> f32 {
        let texts = self.y_ticks.iter().filter_map(|tick| tick.text.as_deref());
        texts.map(|text| text::width(text, SMALL) as f32).fold(0.0, f32::max)
    }

    /// Draws the panel with its plot in `frame`.
    pub fn draw(&self, panel: &Panel, frame: Frame, drawing: &mut Drawing) {
        drawing.clip = Some(frame);
        if let Some(picture) = &panel.picture {
            self.picture(picture, frame, drawing);
        }
        drawing.clip = None;
        if panel.bare {
            return;
        }
        if panel.picture.is_none() {
            self.grid(frame, drawing);
        }
        drawing.clip = Some(frame);
        panel.areas.iter().for_each(|area| self.area(area, frame, drawing));
        panel.rules.iter().for_each(|rule| self.rule(*rule, frame, drawing));
        for (index, series) in panel.series.iter().enumerate() {
            self.series(series, colour(series, index), frame, drawing);
        }
        drawing.clip = None;
        for note in &panel.notes {
            if let Some([x, y]) = self.place(frame, note.at) {
                drawing.words(&note.text, [x, y], SMALL, Anchor::Start);
            }
        }
        drawing.frame(frame, 1.0, INK);
        self.numbers(frame, drawing);
        labels(panel, frame, self.numbers_width(), drawing);
        let marks = panel.series.iter().flat_map(|series| &series.points);
        let places = marks.filter_map(|point| self.place(frame, [point.x, point.y])).collect();
        legend::draw(panel, frame, places, drawing);
    }

    fn area(&self, area: &Area, frame: Frame, drawing: &mut Drawing) {
        let corners = area.corners.iter().map(|&at| self.place(frame, at));
        if let Some(corners) = corners.collect() {
            drawing.add(Shape::Fill { corners, colour: area.colour });
        }
    }

    /// Width of the axes over their height, in units of both.
    pub fn aspect(&self) -> f64 {
        (self.x.high - self.x.low) / (self.y.high - self.y.low)
    }

    fn picture(&self, picture: &Picture, frame: Frame, drawing: &mut Drawing) {
        let corner = |end: usize| self.place(frame, [picture.x[end], picture.y[end]]);
        if let (Some([left, bottom]), Some([right, top])) = (corner(0), corner(1)) {
            let (image, frame) = (picture.image.clone(), [left, top, right, bottom]);
            drawing.add(Shape::Picture { image, frame });
        }
    }

    /// The place of a pair of values; none for what cannot be drawn.
    fn place(&self, [left, top, right, bottom]: Frame, at: [f64; 2]) -> Option<Place> {
        let [x, y] = [self.x.share(at[0]), self.y.share(at[1])];
        // Far outside, places would lose their digits.
        let drawable = |share: f64| (-1e3..=1e3).contains(&share);
        let [u, v] = [x as f32, y as f32];
        let at = [left + u * (right - left), bottom - v * (bottom - top)];
        (drawable(x) && drawable(y)).then_some(at)
    }

    /// Faint lines at the numbers.
    fn grid(&self, frame: Frame, drawing: &mut Drawing) {
        let [left, top, right, bottom] = frame;
        for x in places(&self.x, &self.x_ticks, left, right) {
            drawing.line([x.0, top], [x.0, bottom], if x.1.is_some() { 0.8 } else { 0.4 }, FAINT);
        }
        for y in places(&self.y, &self.y_ticks, bottom, top) {
            drawing.line([left, y.0], [right, y.0], if y.1.is_some() { 0.8 } else { 0.4 }, FAINT);
        }
    }

    fn numbers(&self, [left, top, right, bottom]: Frame, drawing: &mut Drawing) {
        for (x, text) in places(&self.x, &self.x_ticks, left, right) {
            let length = if text.is_some() { 5.0 } else { 3.0 };
            drawing.line([x, bottom], [x, bottom + length], 1.0, INK);
            let text = text.unwrap_or_default();
            drawing.words(text, [x, bottom + 1.2 * SMALL], SMALL, Anchor::Middle);
        }
        for (y, text) in places(&self.y, &self.y_ticks, bottom, top) {
            let length = if text.is_some() { 5.0 } else { 3.0 };
            drawing.line([left - length, y], [left, y], 1.0, INK);
            drawing.words(text.unwrap_or_default(), [left - 8.0, y], SMALL, Anchor::End);
        }
    }

    fn rule(&self, rule: Rule, [left, top, right, bottom]: Frame, drawing: &mut Drawing) {
        let frame = [left, top, right, bottom];
        let (value, share) = match rule {
            Rule::Horizontal(y) => (y, self.y.share(y)),
            Rule::Vertical(x) => (x, self.x.share(x)),
        };
        if !(value.is_finite() && (0.0..=1.0).contains(&share)) {
            return;
        }
        let [x, y] =
            [frame[0] + share as f32 * (right - left), bottom - share as f32 * (bottom - top)];
        let places = match rule {
            Rule::Horizontal(_) => vec![[left, y], [right, y]],
            Rule::Vertical(_) => vec![[x, top], [x, bottom]],
        };
        let dashes = dashes(super::Line::Dashed);
        drawing.add(Shape::Stroke { places, width: 1.0, dashes, colour: GREY });
    }

    fn series(&self, series: &Series, colour: Colour, frame: Frame, drawing: &mut Drawing) {
        let places: Vec<Option<Place>> =
            series.points.iter().map(|point| self.place(frame, [point.x, point.y])).collect();
        if let Some(line) = series.line {
            let width = series.width.map_or(LINE_WIDTH, |width| width as f32);
            // What cannot be drawn breaks the line.
            for places in places.split(Option::is_none).filter(|piece| piece.len() > 1) {
                let places = places.iter().copied().flatten().collect();
                let dashes = dashes(line);
                drawing.add(Shape::Stroke { places, width, dashes, colour });
            }
        }
        for (point, at) in series.points.iter().zip(&places) {
            if let (Some([low, high]), Some([x, _])) = (point.error, at) {
                let ends = [low, high].map(|end| self.place(frame, [point.x, end]));
                if let [Some(low), Some(high)] = ends {
                    error_bar(*x, [low[1], high[1]], colour, drawing);
                }
            }
            if let (Some(marker), Some(at)) = (series.marker, at) {
                mark(drawing, marker, *at, colour);
            }
        }
    }
}

/// A bar with feet.
fn error_bar(x: f32, ends: [f32; 2], colour: Colour, drawing: &mut Drawing) {
    const FOOT: f32 = 3.0;
    drawing.line([x, ends[0]], [x, ends[1]], 1.2, colour);
    for end in ends {
        drawing.line([x - FOOT, end], [x + FOOT, end], 1.2, colour);
    }
}

/// Places and texts of the ticks that lie on an axis between two ends.
fn places<'t>(
    span: &Span,
    ticks: &'t [Tick],
    from: f32,
    to: f32,
) -> impl Iterator<Item = (f32, Option<&'t str>)> {
    let place = {
        let span = *span;
        move |tick: &'t Tick| {
            let share = span.share(tick.value);
            let on_axis = (-1e-6..=1.0 + 1e-6).contains(&share);
            on_axis.then_some((from + share as f32 * (to - from), tick.text.as_deref()))
        }
    };
    ticks.iter().filter_map(place)
}

/// The labels of both axes; `numbers` is the width of those beside the vertical one.
fn labels(panel: &Panel, frame: Frame, numbers: f32, drawing: &mut Drawing) {
    let [left, _, right, bottom] = frame;
    let middle = [0.5 * (left + right), bottom + 2.8 * SMALL];
    drawing.words(&panel.x.label, middle, SMALL, Anchor::Middle);
    beside(&panel.y.label, left - numbers - 8.0 - 0.9 * SMALL, frame, drawing);
}

/// Words that run upwards beside a plot, at its middle, or from its top down where they are longer.
pub(super) fn beside(text: &str, x: f32, [_, top, _, bottom]: Frame, drawing: &mut Drawing) {
    let half = 0.5 * text::width(text, SMALL) as f32;
    let at = [x, (0.5 * (top + bottom)).max(top + half)];
    let (text, anchor) = (text.to_owned(), Anchor::Middle);
    drawing.add(Shape::Words(Words { text, at, size: SMALL, anchor, upward: true }));
}
