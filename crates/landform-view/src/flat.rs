//! Fields as flat colours, and colour bars.

use crate::{ColourMap, Image, ViewError, text};

/// Colour of values that are not numbers.
const MISSING: [u8; 3] = [205, 205, 205];

/// Ink of ticks and letters.
const INK: [u8; 3] = [40, 40, 40];

/// Draws a field of `width * height` values (row 0 at the top) in flat colours, each node a
/// square of `pixels_per_node` pixels.
///
/// ```
/// use landform_view::{ColourMap, flat};
///
/// let change: Vec<f64> = (0..60 * 40).map(|node| f64::from(node % 60 - 30) / 10.0).collect();
/// let (colours, range) = (ColourMap::named("vik")?, [-3.0, 3.0]);
/// let picture = flat::colour_field(&change, 60, 40, colours, Some(range), 4)?;
/// let label = "change of height (m)".into();
/// let bar = flat::ColourBar { colours, range, label, text_size: 13.0 };
/// let picture = bar.beside(&picture)?;
/// assert!(picture.width > 240 && picture.height == 160);
/// # Ok::<(), landform_view::ViewError>(())
/// ```
///
/// `range` holds the values of the first and the last colour of the map; the field's own range
/// when missing. Values outside take the colours of the ends, NaN is grey.
///
/// # Errors
/// [`ViewError::Length`] when the number of values is wrong, [`ViewError::TooSmall`] and
/// [`ViewError::TooLarge`] for sizes that no picture can have, [`ViewError::Option`] for a range
/// that is not finite.
pub fn colour_field(
    values: &[f64],
    width: usize,
    height: usize,
    colours: ColourMap,
    range: Option<[f64; 2]>,
    pixels_per_node: usize,
) -> Result<Image, ViewError> {
    ViewError::check_size("a field", [width, height], 1)?;
    if values.len() != width * height {
        return Err(ViewError::Length { what: "a field", found: values.len(), width, height });
    }
    let range = range.unwrap_or_else(|| finite_range(values));
    check_range(range)?;
    let [columns, rows] = [width, height].map(|nodes| nodes.saturating_mul(pixels_per_node));
    let mut image = Image::filled(columns, rows, MISSING)?;
    for (row, line) in image.rgb.chunks_mut(columns).enumerate() {
        let values = &values[row / pixels_per_node * width..];
        for (column, pixel) in line.iter_mut().enumerate() {
            let value = values[column / pixels_per_node];
            if !value.is_nan() {
                *pixel = colours.colour(share(value, range));
            }
        }
    }
    Ok(image)
}

/// Lowest and highest finite value; [0, 1] when there is none.
pub fn finite_range(values: &[f64]) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let range = values
        .iter()
        .filter(|value| value.is_finite())
        .fold(start, |[low, high], &value| [low.min(value), high.max(value)]);
    if range[0] <= range[1] { range } else { [0.0, 1.0] }
}

/// A scale of colours with ticks and a label.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourBar {
    /// Its colours.
    pub colours: ColourMap,
    /// Values of the first and the last colour.
    pub range: [f64; 2],
    /// What the values are, with their unit: `height (m)`.
    pub label: String,
    /// Height of letters in pixels.
    pub text_size: f32,
}

impl ColourBar {
    /// The picture with the bar at its right, on white.
    ///
    /// # Errors
    /// [`ViewError::Option`] for a range that is not finite or letters below 4 or above 200
    /// pixels; [`ViewError::TooLarge`] beyond memory.
    pub fn beside(&self, image: &Image) -> Result<Image, ViewError> {
        image.check()?;
        check_range(self.range)?;
        ViewError::check_option("text_size", self.text_size.into(), [4.0, 200.0], "4 to 200")?;
        let size = self.text_size;
        let unit = size.ceil() as usize;
        let ticks = ticks(self.range, (image.height / (3 * unit)).clamp(2, 10));
        let labels: Vec<String> = ticks.iter().map(|&tick| tick_label(tick, &ticks)).collect();
        let widest = labels.iter().map(|label| text::width(label, size)).max().unwrap_or(0);
        let room = (2 * unit + widest).max(text::width(&self.label, size)) + 2 * unit;
        // The bar leaves room for its label above and half a letter below.
        let (head, foot) = (text::line_height(size) + unit / 2, unit);
        let bar_height = image.height.saturating_sub(head + foot).max(1);
        let height = image.height.max(head + foot + 1);
        let mut page = Image::filled(image.width + room, height, [255; 3])?;
        page.paste(image, 0, 0);
        let left = image.width + unit;
        text::draw(&mut page, &self.label, [left as f32, 0.0], size, INK);
        self.draw_bar(&mut page, [left, head], [unit, bar_height]);
        for (tick, label) in ticks.iter().zip(&labels) {
            let row = head as f64 + (1.0 - share(*tick, self.range)) * (bar_height - 1) as f64;
            self.draw_tick(&mut page, left + unit, row.round() as usize, label);
        }
        Ok(page)
    }

    /// Fills a rectangle with the colours, the last one at the top.
    fn draw_bar(&self, page: &mut Image, [left, top]: [usize; 2], [width, height]: [usize; 2]) {
        for row in 0..height {
            let place = 1.0 - (row as f64 + 0.5) / height as f64;
            let start = left + page.width * (top + row);
            page.rgb[start..start + width].fill(self.colours.colour(place));
        }
    }

    /// Draws a tick to the right of the bar and its label beside it.
    fn draw_tick(&self, page: &mut Image, left: usize, row: usize, label: &str) {
        let length = (self.text_size / 3.0).ceil() as usize;
        let start = left + page.width * row;
        page.rgb[start..start + length].fill(INK);
        let at = [(left + 2 * length) as f32, row as f32 - 0.6 * self.text_size];
        text::draw(page, label, at, self.text_size, INK);
    }
}

/// Place of a value in a range, 0 at its start and 1 at its end.
fn share(value: f64, [low, high]: [f64; 2]) -> f64 {
    let span = high - low;
    if span == 0.0 { 0.5 } else { ((value - low) / span).clamp(0.0, 1.0) }
}

fn check_range(range: [f64; 2]) -> Result<(), ViewError> {
    // Half of the largest number, so that the difference of the ends is finite too.
    let finite = [-f64::MAX / 2.0, f64::MAX / 2.0];
    range.into_iter().try_for_each(|end| {
        ViewError::check_option("range", end, finite, "a finite number of at most 8.9e307")
    })
}

/// Round values in a range, 1, 2 or 5 times a power of ten apart, at most `most` of them.
fn ticks(range: [f64; 2], most: usize) -> Vec<f64> {
    let [low, high] = [range[0].min(range[1]), range[0].max(range[1])];
    let rough = (high - low) / most as f64;
    if rough <= f64::MIN_POSITIVE * 1e3 {
        return vec![low];
    }
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|step| step * power >= rough * 0.999);
    let step = step.unwrap_or(10.0) * power;
    let first = (low / step - 1e-9).ceil();
    let last = (high / step + 1e-9).floor();
    let count = (last - first).clamp(0.0, most as f64) as usize;
    (0..=count).map(|index| (first + index as f64) * step).collect()
}

/// A tick's value with as many digits as its neighbours need.
fn tick_label(tick: f64, ticks: &[f64]) -> String {
    let step = match ticks {
        [first, second, ..] => second - first,
        _ => tick.abs(),
    };
    let largest = ticks.iter().fold(0.0_f64, |largest, tick| largest.max(tick.abs()));
    if largest >= 1e6 || (largest > 0.0 && largest < 1e-3) {
        return format!("{tick:.1e}");
    }
    let digits = if step > 0.0 { (-step.log10().floor()).clamp(0.0, 9.0) as usize } else { 0 };
    format!("{tick:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_cover_the_range() {
        assert_eq!(ticks([0.0, 10.0], 5), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks([-16.0, 16.0], 4), [-10.0, 0.0, 10.0]);
        assert_eq!(ticks([16.0, -16.0], 4), [-10.0, 0.0, 10.0]);
        assert_eq!(ticks([3.0, 3.0], 4), [3.0]);
    }

    #[test]
    fn labels_have_the_digits_they_need() {
        let label = |values: &[f64]| tick_label(values[0], values);
        assert_eq!(label(&[0.05, 0.1]), "0.05");
        assert_eq!(label(&[-20.0, 0.0]), "-20");
        assert_eq!(label(&[2e7, 4e7]), "2.0e7");
        assert_eq!(label(&[1500.0, 2000.0]), "1500");
    }
}
