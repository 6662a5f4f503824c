//! The page of a cave map: views below each other, and beside them what tells how to read them.

use super::walls::{Drawn, MARGIN, pale};
use super::{CaveMapOptions, CaveView};
use crate::mark::Mark;
use crate::plot::drawing::{Anchor, Drawing, INK, Shape};
use crate::{Image, ViewError, text};

/// Height of letters in pixels.
const LETTERS: f32 = 15.0;
/// Free space around everything, in pixels.
const EDGE: f32 = 18.0;
/// Height of the title of a view.
const TITLE: f32 = 24.0;
/// Height of marks.
const MARK: f32 = 15.0;
/// Lines at round heights, sRGB.
const THIN: [u8; 3] = [190, 190, 190];

/// Puts views on a page.
pub(super) fn draw(views: &[Drawn], options: &CaveMapOptions) -> Result<Image, ViewError> {
    let ruled = views.iter().any(|drawn| drawn.view != CaveView::Plan);
    let left = EDGE + if ruled { 46.0 } else { 0.0 };
    let widest = views.iter().map(|drawn| drawn.image.width).max().unwrap_or(0) as f32;
    let side = Side::new(options);
    let foot = 3.2 * LETTERS;
    let tall: f32 = views.iter().map(|drawn| drawn.image.height as f32 + TITLE).sum();
    let size = [
        left + widest + EDGE + side.width + EDGE,
        (EDGE + tall + foot).max(2.0 * EDGE + side.height),
    ];
    let mut page = Drawing { size, ..Drawing::default() };
    let mut top = EDGE;
    let mut marks = Vec::new();
    for drawn in views {
        page.words(
            drawn.view.title(),
            [left + MARGIN as f32, top + 0.5 * LETTERS],
            LETTERS,
            Anchor::Start,
        );
        top += TITLE;
        view(&mut page, drawn, [left, top], options);
        for &(mark, at) in &options.marks {
            let [x, y] = drawn.place(at, options.pixels_per_m);
            marks.push((mark, [left + x, top + y]));
        }
        top += drawn.image.height as f32;
    }
    scale_bar(&mut page, [left + MARGIN as f32, top + 0.9 * LETTERS], widest, options.pixels_per_m);
    let column = left + widest + EDGE;
    marks.extend(side.draw(&mut page, column, options));
    let mut image = page.image(1.0)?;
    for (mark, at) in marks {
        mark.draw(&mut image, at, MARK);
    }
    Ok(image)
}

/// A view with lines at round heights below it, unless it is a plan.
fn view(page: &mut Drawing, drawn: &Drawn, [left, top]: [f32; 2], options: &CaveMapOptions) {
    let [width, height] = [drawn.image.width as f32, drawn.image.height as f32];
    let frame = [left, top, left + width, top + height];
    page.add(Shape::Picture { image: drawn.image.clone(), frame });
    if drawn.view == CaveView::Plan {
        return;
    }
    let [low, high] = [0, 1].map(|end| options.block[end][2]);
    let room = (height / (2.5 * LETTERS)).max(1.0);
    let step = round_length((high - low) / f64::from(room));
    for count in (low / step).ceil() as i64..=(high / step).floor() as i64 {
        let at = count as f64 * step;
        let row = top + (drawn.corner[1] - at) as f32 * options.pixels_per_m as f32;
        // Beside the view: its walls stay as they are.
        page.line([left - 6.0, row], [left + MARGIN as f32 - 2.0, row], 1.0, THIN);
        let words = format!("{} m", short(at));
        page.words(&words, [left - 9.0, row], 0.85 * LETTERS, Anchor::End);
    }
}

/// A bar of four parts, black and white in turn, a round length that fills about a third of the page.
fn scale_bar(page: &mut Drawing, [left, top]: [f32; 2], room: f32, pixels_per_m: f64) {
    const PARTS: usize = 4;
    let length = round_length(f64::from(room) / pixels_per_m / 3.2 / 1.999);
    let part = (length * pixels_per_m) as f32 / PARTS as f32;
    for number in 0..PARTS {
        let from = left + number as f32 * part;
        let frame = [from, top, from + part, top + 6.0];
        if number % 2 == 0 {
            page.fill(frame, INK);
        }
        page.frame(frame, 1.0, INK);
    }
    let row = top + 6.0 + 0.7 * LETTERS;
    for (share, unit) in [(0.0, ""), (0.5, ""), (1.0, " m")] {
        let words = format!("{}{unit}", short(length * share));
        let at = left + part * PARTS as f32 * share as f32;
        page.words(&words, [at, row], 0.85 * LETTERS, Anchor::Middle);
    }
}

/// The least of 1, 2 and 5 times a power of ten that is at least `least`.
fn round_length(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().find(|step| step * power >= least * 0.999);
    step.unwrap_or(10.0) * power
}

/// A number with no more than three decimals.
fn short(value: f64) -> String {
    let rounded = (value * 1e3).round() / 1e3;
    // Not -0.
    format!("{}", rounded + 0.0)
}

/// What stands beside the views.
struct Side {
    width: f32,
    height: f32,
    has: [bool; 2],
}

impl Side {
    const NORTH: f32 = 74.0;
    const BAR: f32 = 120.0;

    fn new(options: &CaveMapOptions) -> Self {
        let has = [Mark::Source, Mark::Sink]
            .map(|mark| options.marks.iter().any(|(other, _)| *other == mark));
        let longest = options.words.iter().map(|line| text::width(line, LETTERS)).max();
        let width = (longest.unwrap_or(0) as f32).max(150.0);
        let lines = options.words.len() + has.iter().filter(|&&has| has).count() + 2;
        let height = Self::NORTH + Self::BAR + (lines + 3) as f32 * 1.5 * LETTERS;
        Self { width, height, has }
    }

    /// Draws it and returns the marks that explain those of the views.
    fn draw(
        &self,
        page: &mut Drawing,
        left: f32,
        options: &CaveMapOptions,
    ) -> Vec<(Mark, [f32; 2])> {
        let mut row = EDGE;
        if options.views.contains(&CaveView::Plan) {
            north_arrow(page, [left + 20.0, row]);
            row += Self::NORTH;
        }
        row += LETTERS;
        for line in &options.words {
            page.words(line, [left, row], LETTERS, Anchor::Start);
            row += 1.5 * LETTERS;
        }
        row += 0.5 * LETTERS;
        let mut marks = Vec::new();
        let names = [(Mark::Source, "water comes in"), (Mark::Sink, "water goes out")];
        for ((mark, name), _) in names.into_iter().zip(self.has).filter(|(_, has)| *has) {
            let foot = if mark == Mark::Source { row + 0.5 * MARK } else { row };
            marks.push((mark, [left + 0.6 * MARK, foot]));
            page.words(name, [left + 1.6 * MARK, row], LETTERS, Anchor::Start);
            row += 1.5 * LETTERS;
        }
        page.add(Shape::Stroke {
            places: vec![[left, row], [left + 1.3 * MARK, row]],
            width: 1.6,
            dashes: &[5.0, 4.0],
            colour: [95; 3],
        });
        page.words("below others", [left + 1.6 * MARK, row], LETTERS, Anchor::Start);
        heights(page, [left, row + 1.8 * LETTERS], options);
        marks
    }
}

/// An arrow that points north, half of it black, and its letter.
fn north_arrow(page: &mut Drawing, [middle, top]: [f32; 2]) {
    page.words("N", [middle, top + 0.4 * LETTERS], 1.1 * LETTERS, Anchor::Middle);
    let [tip, notch, foot] = [top + 1.1 * LETTERS, top + 46.0, top + 54.0];
    let west = vec![[middle, tip], [middle, notch], [middle - 10.0, foot]];
    page.add(Shape::Fill { corners: west, colour: INK });
    let outline = vec![
        [middle, tip],
        [middle + 10.0, foot],
        [middle, notch],
        [middle - 10.0, foot],
        [middle, tip],
        [middle, notch],
    ];
    page.add(Shape::Stroke { places: outline, width: 1.2, dashes: &[], colour: INK });
}

/// The tints with their heights.
fn heights(page: &mut Drawing, [left, top]: [f32; 2], options: &CaveMapOptions) {
    let [low, high] = [0, 1].map(|end| options.block[end][2]);
    page.words("height", [left, top], LETTERS, Anchor::Start);
    let top = top + LETTERS;
    let rows = (Side::BAR - 2.0 * LETTERS) as usize;
    for row in 0..rows {
        let share = 1.0 - (row as f64 + 0.5) / rows as f64;
        let at = top + row as f32;
        page.fill([left, at, left + 14.0, at + 1.0], pale(options.colours.colour(share)));
    }
    page.frame([left, top, left + 14.0, top + rows as f32], 1.0, INK);
    for (share, row) in [(1.0, top), (0.0, top + rows as f32)] {
        let words = format!("{} m", short(low + share * (high - low)));
        page.words(&words, [left + 20.0, row], 0.85 * LETTERS, Anchor::Start);
    }
}
