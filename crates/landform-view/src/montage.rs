//! Figures: pictures side by side with letters and captions.

use crate::{Image, ViewError, text};

/// Ink of captions.
const INK: [u8; 3] = [20, 20, 20];

/// A picture of a figure and what it shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// The picture.
    pub image: Image,
    /// Text below it, after the panel's letter.
    pub caption: String,
}

/// Panels side by side below a common heading.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Text above the panels; none when empty.
    pub heading: String,
    /// The panels, from the left.
    pub panels: Vec<Panel>,
}

/// How a figure is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct MontageOptions {
    /// Space between panels and around them, in pixels.
    pub gap: usize,
    /// Colour between panels, sRGB.
    pub background: [u8; 3],
    /// Height of letters in pixels.
    pub text_size: f32,
    /// Whether captions begin with (a), (b), ..., counted row by row.
    pub letters: bool,
}

impl Default for MontageOptions {
    fn default() -> Self {
        Self { gap: 16, background: [255; 3], text_size: 16.0, letters: true }
    }
}

/// Lays panels out as a figure: columns as wide as their widest panel, captions centred below
/// the panels and broken to their width.
///
/// ```
/// use landform_view::Image;
/// use landform_view::montage::{MontageOptions, Panel, Row, panels};
///
/// let panel = |shade: u8, caption: &str| -> Result<Panel, landform_view::ViewError> {
///     Ok(Panel { image: Image::filled(120, 80, [shade; 3])?, caption: caption.into() })
/// };
/// let panels_of_row = vec![panel(90, "before")?, panel(180, "after 100 iterations")?];
/// let row = Row { heading: "Transverse dunes".into(), panels: panels_of_row };
/// let figure = panels(&[row], &MontageOptions::default())?;
/// assert_eq!(figure.width, 120 + 120 + 3 * 16);
/// # Ok::<(), landform_view::ViewError>(())
/// ```
///
/// # Errors
/// [`ViewError::TooSmall`] without a panel, [`ViewError::TooLarge`] beyond memory,
/// [`ViewError::Option`] for letters below 4 or above 200 pixels.
pub fn panels(rows: &[Row], options: &MontageOptions) -> Result<Image, ViewError> {
    let size: f64 = options.text_size.into();
    ViewError::check_option("text_size", size, [4.0, 200.0], "from 4 to 200 pixels")?;
    ViewError::check_option("gap", options.gap as f64, [0.0, 10_000.0], "from 0 to 10000")?;
    for panel in rows.iter().flat_map(|row| &row.panels) {
        panel.image.check()?;
    }
    let layout = Layout::new(rows, options);
    let mut page = Image::filled(layout.width, layout.height, options.background)?;
    for (row, place) in rows.iter().zip(&layout.rows) {
        draw_row(&mut page, row, place, &layout.columns, options);
    }
    Ok(page)
}

/// Where everything goes.
struct Layout {
    /// Left edge and width of each column.
    columns: Vec<[usize; 2]>,
    rows: Vec<RowPlace>,
    width: usize,
    height: usize,
}

struct RowPlace {
    top: usize,
    /// Height of the tallest panel.
    panel_height: usize,
    /// Lines of each panel's caption.
    captions: Vec<Vec<String>>,
}

impl Layout {
    fn new(rows: &[Row], options: &MontageOptions) -> Self {
        let gap = options.gap;
        let mut columns = Vec::new();
        let mut left = gap;
        for column in 0..rows.iter().map(|row| row.panels.len()).max().unwrap_or(0) {
            let panels = rows.iter().filter_map(|row| row.panels.get(column));
            let width = panels.map(|panel| panel.image.width).max().unwrap_or(0);
            columns.push([left, width]);
            left += width + gap;
        }
        let line = text::line_height(options.text_size);
        let mut letter = 0;
        let mut top = gap;
        let mut places = Vec::new();
        for row in rows {
            let captions: Vec<Vec<String>> = row
                .panels
                .iter()
                .zip(&columns)
                .map(|(panel, &[_, width])| {
                    letter += 1;
                    caption_lines(panel, letter, width, options)
                })
                .collect();
            let panel_height = row.panels.iter().map(|p| p.image.height).max().unwrap_or(0);
            let lines = captions.iter().map(Vec::len).max().unwrap_or(0);
            places.push(RowPlace { top, panel_height, captions });
            let heading = if row.heading.is_empty() { 0 } else { line };
            top += heading + panel_height + line / 3 + lines * line + gap;
        }
        let width = if columns.is_empty() { 0 } else { left };
        Self { columns, rows: places, width, height: top }
    }
}

/// Lines of a panel's caption, with its letter, broken to the width of its column.
fn caption_lines(
    panel: &Panel,
    letter: usize,
    width: usize,
    options: &MontageOptions,
) -> Vec<String> {
    let caption = match options.letters {
        true => format!("({}) {}", letter_name(letter), panel.caption),
        false => panel.caption.clone(),
    };
    match caption.trim().is_empty() {
        true => Vec::new(),
        false => text::wrapped(&caption, options.text_size, width),
    }
}

/// a, b, ..., z, aa, ab, ... for 1, 2, ..., 26, 27, 28, ...
pub(crate) fn letter_name(mut number: usize) -> String {
    let mut name = String::new();
    while number > 0 {
        number -= 1;
        name.insert(0, char::from(b'a' + (number % 26) as u8));
        number /= 26;
    }
    name
}

/// Draws a row: its heading, then panels centred in their columns with their captions below.
fn draw_row(
    page: &mut Image,
    row: &Row,
    place: &RowPlace,
    columns: &[[usize; 2]],
    options: &MontageOptions,
) {
    let (size, line) = (options.text_size, text::line_height(options.text_size));
    let mut top = place.top;
    if !row.heading.is_empty() {
        text::draw(page, &row.heading, [options.gap as f32, top as f32], size, INK);
        top += line;
    }
    for ((panel, lines), &[left, width]) in row.panels.iter().zip(&place.captions).zip(columns) {
        page.paste(&panel.image, left + (width - panel.image.width) / 2, top);
        for (index, words) in lines.iter().enumerate() {
            let space = width.saturating_sub(text::width(words, size));
            let below = top + place.panel_height + line / 3 + index * line;
            text::draw(page, words, [(left + space / 2) as f32, below as f32], size, INK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_on_after_z() {
        let names = [1, 2, 26, 27, 28, 52, 53, 702, 703].map(letter_name);
        assert_eq!(names, ["a", "b", "z", "aa", "ab", "az", "ba", "zz", "aaa"]);
    }
}
