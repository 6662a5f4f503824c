//! Shapes as pixels, with smooth edges.

use super::drawing::{Anchor, Colour, Drawing, Frame, Place, Shape, Words};
use crate::text::{self, blend};
use crate::{Image, ViewError};

impl Drawing {
    /// The page with `scale` pixels a unit.
    pub fn image(&self, scale: f32) -> Result<Image, ViewError> {
        let [width, height] = self.size.map(|size| (size * scale).round() as usize);
        let mut image = Image::filled(width, height, [255; 3])?;
        for (shape, clip) in &self.shapes {
            let clip = clip.unwrap_or([0.0, 0.0, self.size[0], self.size[1]]);
            let mut page = Page { image: &mut image, clip: clip.map(|edge| edge * scale) };
            match shape {
                Shape::Stroke { places, width, dashes, colour } => {
                    let places: Vec<Place> =
                        places.iter().map(|at| at.map(|c| c * scale)).collect();
                    let dashes: Vec<f32> = dashes.iter().map(|length| length * scale).collect();
                    for piece in pieces(&places, &dashes) {
                        page.stroke(&piece, width * scale, *colour);
                    }
                }
                Shape::Fill { corners, colour } => {
                    let corners: Vec<Place> =
                        corners.iter().map(|at| at.map(|c| c * scale)).collect();
                    page.fill(&corners, *colour);
                }
                Shape::Picture { image, frame } => page.picture(image, frame.map(|at| at * scale)),
                Shape::Words(words) => page.words(words, scale),
            }
        }
        Ok(image)
    }
}

/// A picture with the part of it that may be drawn on.
struct Page<'i> {
    image: &'i mut Image,
    clip: Frame,
}

impl Page<'_> {
    /// Covers the pixels near a line. A pixel is covered once by the nearest piece of the line,
    /// so joints do not show.
    fn stroke(&mut self, places: &[Place], width: f32, colour: Colour) {
        let radius = 0.5 * width;
        let near = Window::around(places, radius + 1.0, self);
        let mut cover = vec![0.0_f32; near.columns * near.rows];
        for ends in places.windows(2) {
            let part = Window::around(ends, radius + 1.0, self);
            for (column, row) in part.pixels() {
                let centre = [column as f32 + 0.5, row as f32 + 0.5];
                let share = (radius + 0.5 - distance(centre, ends[0], ends[1])).clamp(0.0, 1.0);
                let pixel = &mut cover[near.index(column, row)];
                *pixel = pixel.max(share.min(width));
            }
        }
        for (column, row) in near.pixels() {
            self.ink(column, row, colour, cover[near.index(column, row)]);
        }
    }

    /// Covers the pixels inside a polygon, by the share of their samples that lie inside.
    fn fill(&mut self, corners: &[Place], colour: Colour) {
        /// Samples along either side of a pixel.
        const SAMPLES: usize = 4;
        let offset = |sample: usize| (sample as f32 + 0.5) / SAMPLES as f32;
        let window = Window::around(corners, 1.0, self);
        let mut inside = vec![0_u8; window.columns];
        for row in window.top..window.top + window.rows {
            inside.fill(0);
            for sample in 0..SAMPLES {
                let ends = crossings(row as f32 + offset(sample), corners);
                for &[from, to] in ends.as_chunks().0 {
                    // The number of samples left of a place.
                    let before = |x: f32| {
                        let samples = (x - window.left as f32) * SAMPLES as f32;
                        (samples - 0.5).ceil().max(0.0) as usize
                    };
                    let last = before(to).min(SAMPLES * window.columns);
                    (before(from)..last).for_each(|sample| inside[sample / SAMPLES] += 1);
                }
            }
            for (column, &count) in inside.iter().enumerate() {
                let share = f32::from(count) / (SAMPLES * SAMPLES) as f32;
                self.ink(window.left + column, row, colour, share);
            }
        }
    }

    /// Stretches a picture over a rectangle: each pixel takes the mean of those that it covers.
    fn picture(&mut self, picture: &Image, frame: Frame) {
        let [left, top, right, bottom] = frame;
        let corners = [[left, top], [right, bottom]];
        let covered = |place: f32, low: f32, high: f32, size: usize| {
            let along = |at: f32| ((at - low) / (high - low) * size as f32).clamp(0.0, size as f32);
            let [start, end] = [along(place), along(place + 1.0)];
            // A pixel within one of the picture's takes that one.
            let first =
                if end - start < 1.0 { (0.5 * (start + end)).floor() } else { start.round() };
            let first = (first as usize).min(size - 1);
            let last = if end - start < 1.0 { first + 1 } else { end.round() as usize };
            first..last.clamp(first + 1, size)
        };
        for (column, row) in Window::around(&corners, 0.0, self).pixels() {
            let across = covered(column as f32, left, right, picture.width);
            let down = covered(row as f32, top, bottom, picture.height);
            let count = (across.len() * down.len()) as u32;
            let mut sum = [0_u32; 3];
            for pixel in down.flat_map(|y| across.clone().map(move |x| picture.pixel(x, y))) {
                sum = [0, 1, 2].map(|channel| sum[channel] + u32::from(pixel[channel]));
            }
            let colour = sum.map(|sum| ((sum + count / 2) / count) as u8);
            let inside =
                |at: f32, low: f32, high: f32| (high.min(at + 1.0) - low.max(at)).clamp(0.0, 1.0);
            let share = inside(column as f32, left, right) * inside(row as f32, top, bottom);
            self.ink(column, row, colour, share);
        }
    }

    fn words(&mut self, words: &Words, scale: f32) {
        let size = words.size * scale;
        let width = text::width(&words.text, size) as f32;
        let before = match words.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * width,
            Anchor::End => width,
        };
        let [x, y] = words.at.map(|at| at * scale);
        let rise = text::MIDDLE * size;
        let ink = super::drawing::INK;
        match words.upward {
            false => text::draw(self.image, &words.text, [x - before, y - rise], size, ink),
            true => text::draw_upward(self.image, &words.text, [x - rise, y + before], size, ink),
        }
    }

    /// Lays ink over a pixel, as far as the pixel lies inside the cut.
    fn ink(&mut self, column: usize, row: usize, colour: Colour, share: f32) {
        let [left, top, right, bottom] = self.clip;
        let (x, y) = (column as f32, row as f32);
        let inside =
            |low: f32, high: f32, at: f32| (high.min(at + 1.0) - low.max(at)).clamp(0.0, 1.0);
        let kept = inside(left, right, x) * inside(top, bottom, y);
        if share * kept > 0.0 {
            blend(self.image, column as i64, row as i64, colour, share * kept);
        }
    }
}

/// Pixels of a picture that a shape may touch.
struct Window {
    left: usize,
    top: usize,
    columns: usize,
    rows: usize,
}

impl Window {
    /// The pixels within `reach` of places, inside the cut of a page.
    fn around(places: &[Place], reach: f32, page: &Page<'_>) -> Self {
        let bounds = |axis: usize, size: usize| {
            let values = places.iter().map(|place| place[axis]);
            let low = values.clone().fold(f32::INFINITY, f32::min) - reach;
            let high = values.fold(f32::NEG_INFINITY, f32::max) + reach;
            let first = low.max(page.clip[axis] - 1.0).floor().clamp(0.0, size as f32) as usize;
            let last = high.min(page.clip[axis + 2] + 1.0).ceil().clamp(0.0, size as f32) as usize;
            (first, last.saturating_sub(first))
        };
        let (left, columns) = bounds(0, page.image.width);
        let (top, rows) = bounds(1, page.image.height);
        Self { left, top, columns, rows }
    }

    fn pixels(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (left, top, columns, rows) = (self.left, self.top, self.columns, self.rows);
        (0..columns * rows).map(move |index| (left + index % columns, top + index / columns))
    }

    fn index(&self, column: usize, row: usize) -> usize {
        column - self.left + self.columns * (row - self.top)
    }
}

/// Distance of a place from the piece of a line between two others.
fn distance(place: Place, from: Place, to: Place) -> f32 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let away = [place[0] - from[0], place[1] - from[1]];
    let length = along[0] * along[0] + along[1] * along[1];
    let dot = along[0] * away[0] + along[1] * away[1];
    let share = if length > 0.0 { (dot / length).clamp(0.0, 1.0) } else { 0.0 };
    (away[0] - share * along[0]).hypot(away[1] - share * along[1])
}

/// Where the edges of a polygon cross a row, from the left: its inside lies between the first and
/// the second, the third and the fourth, and so on.
fn crossings(y: f32, corners: &[Place]) -> Vec<f32> {
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next).filter(|([_, y1], [_, y2])| (*y1 > y) != (*y2 > y));
    let mut places: Vec<f32> =
        edges.map(|([x1, y1], [x2, y2])| x1 + (y - y1) / (y2 - y1) * (x2 - x1)).collect();
    places.sort_by(f32::total_cmp);
    places
}

/// The dashes of a line; the whole line when there are none.
fn pieces(places: &[Place], dashes: &[f32]) -> Vec<Vec<Place>> {
    let Some(&first) = dashes.first().filter(|_| dashes.iter().all(|&length| length > 0.0)) else {
        return vec![places.to_vec()];
    };
    let (mut pieces, mut dash, mut left) = (Vec::new(), 0, first);
    let mut piece: Vec<Place> = places.first().copied().into_iter().collect();
    for ends in places.windows(2) {
        let (mut from, to) = (ends[0], ends[1]);
        loop {
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            if length <= left {
                left -= length;
                piece.push(to);
                break;
            }
            let share = left / length;
            from = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
            piece.push(from);
            if dash % 2 == 0 {
                pieces.push(std::mem::take(&mut piece));
            }
            piece = vec![from];
            dash = (dash + 1) % dashes.len();
            left = dashes[dash];
        }
    }
    if dash % 2 == 0 {
        pieces.push(piece);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(shape: Shape, clip: Option<Frame>) -> Image {
        let drawing = Drawing { size: [8.0, 6.0], shapes: vec![(shape, clip)], clip: None };
        drawing.image(1.0).unwrap()
    }

    /// Ink on the page in whole pixels.
    fn ink(image: &Image) -> f64 {
        image.rgb.iter().map(|pixel| 1.0 - f64::from(pixel[0]) / 255.0).sum()
    }

    #[test]
    fn shapes_cover_their_area() {
        let corners = vec![[1.0, 1.0], [5.0, 1.0], [5.0, 4.0], [1.0, 4.0]];
        let square = page(Shape::Fill { corners: corners.clone(), colour: [0; 3] }, None);
        assert_eq!(ink(&square), 12.0);
        assert_eq!((square.pixel(1, 1), square.pixel(0, 1)), ([0; 3], [255; 3]));
        let cut = page(Shape::Fill { corners, colour: [0; 3] }, Some([2.0, 2.0, 8.0, 6.0]));
        assert_eq!(ink(&cut), 6.0);
        let triangle = vec![[1.0, 1.0], [5.0, 1.0], [1.0, 5.0]];
        let triangle = page(Shape::Fill { corners: triangle, colour: [0; 3] }, None);
        assert!((ink(&triangle) - 8.0).abs() < 0.6, "{}", ink(&triangle));
        let places = vec![[1.0, 2.5], [7.0, 2.5]];
        let line = Shape::Stroke { places, width: 1.0, dashes: &[], colour: [0; 3] };
        let line = page(line, None);
        assert!((ink(&line) - 6.0).abs() < 1.0, "{}", ink(&line));
        assert_eq!(line.pixel(3, 2), [0; 3]);
    }

    /// A place lies in a polygon that has an odd number of edges to its right.
    fn is_inside([x, y]: Place, corners: &[Place]) -> bool {
        let next = corners.iter().cycle().skip(1);
        let right = corners.iter().zip(next).filter(|([x1, y1], [x2, y2])| {
            (*y1 > y) != (*y2 > y) && x < x1 + (y - y1) / (y2 - y1) * (x2 - x1)
        });
        right.count() % 2 == 1
    }

    #[test]
    fn a_pixel_is_covered_by_the_samples_inside() {
        // A star that crosses itself, and a comb with corners on samples.
        let star = vec![[4.0, 0.3], [6.1, 5.7], [0.4, 2.2], [7.7, 2.4], [1.9, 5.6]];
        let comb = vec![[0.125, 5.0], [1.0, 0.625], [2.125, 4.0], [3.0, 1.0], [6.625, 5.125]];
        for corners in [star, comb] {
            let drawn = page(Shape::Fill { corners: corners.clone(), colour: [0; 3] }, None);
            for (pixel, colour) in drawn.rgb.iter().enumerate() {
                let corner = [pixel % 8, pixel / 8].map(|at| at as f32);
                let sample = |sample: usize| {
                    [corner[0] + (sample % 4) as f32 / 4.0, corner[1] + (sample / 4) as f32 / 4.0]
                        .map(|at| at + 0.125)
                };
                let inside = (0..16).filter(|&each| is_inside(sample(each), &corners)).count();
                let found = (1.0 - f64::from(colour[0]) / 255.0) * 16.0;
                assert!((found - inside as f64).abs() < 0.05, "{pixel}: {found}, not {inside}");
            }
        }
    }

    #[test]
    fn a_picture_fills_its_rectangle() {
        let mut image = Image::filled(4, 2, [0; 3]).unwrap();
        image.rgb[7] = [200; 3];
        let half = page(Shape::Picture { image: image.clone(), frame: [1.0, 1.0, 3.0, 2.0] }, None);
        assert_eq!([half.pixel(1, 1), half.pixel(2, 1)], [[0; 3], [50; 3]]);
        assert_eq!(half.pixel(3, 1), [255; 3]);
        let twice = page(Shape::Picture { image, frame: [0.0, 0.0, 8.0, 4.0] }, None);
        assert_eq!([twice.pixel(5, 3), twice.pixel(6, 2)], [[0; 3], [200; 3]]);
        assert_eq!(twice.pixel(0, 4), [255; 3]);
    }

    #[test]
    fn dashes_add_up_to_the_line_without_its_gaps() {
        let places = [[0.0, 0.0], [6.0, 0.0], [6.0, 5.0]];
        let length = |piece: &[Place]| {
            piece.windows(2).map(|e| (e[1][0] - e[0][0]).hypot(e[1][1] - e[0][1])).sum::<f32>()
        };
        let found: Vec<f32> = pieces(&places, &[3.0, 1.0]).iter().map(|p| length(p)).collect();
        assert_eq!(found, [3.0, 3.0, 3.0]);
        assert_eq!(pieces(&places, &[]).len(), 1);
    }
}
