//! Lettering: smooth letters of an embedded font (DejaVu Sans, a free font).

use std::sync::LazyLock;

use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

use crate::Image;

/// The font; it is part of the program, so it is there and whole.
static FONT: LazyLock<FontRef<'static>> = LazyLock::new(|| {
    FontRef::try_from_slice(dejavu::sans::regular()).expect("the embedded font is a font")
});

/// From the top of a line down to half the height of its figures, as a share of its size.
pub(crate) const MIDDLE: f32 = 0.484;
/// From there down to the foot of the figures.
pub(crate) const FOOT: f32 = 0.313;
/// The size that CSS knows the font by, its em, as a share of the size meant here.
pub(crate) const EM: f32 = 0.859;

/// Height of a line of letters `size` pixels high, in pixels.
pub(crate) fn line_height(size: f32) -> usize {
    (size * 1.25).ceil() as usize
}

/// Width of a line of text, in pixels.
pub(crate) fn width(text: &str, size: f32) -> usize {
    layout(text, size).1.ceil() as usize
}

/// Writes a line of text with its top left corner at a column and a row; letters outside the
/// picture are cut.
pub(crate) fn draw(image: &mut Image, text: &str, at: [f32; 2], size: f32, colour: [u8; 3]) {
    cover(text, size, at, |x, y, share| blend(image, x, y, colour, share));
}

/// Writes a line of text that runs upwards; its top left corner, seen with the head to the left,
/// is at a column and a row.
pub(crate) fn draw_upward(image: &mut Image, text: &str, at: [f32; 2], size: f32, colour: [u8; 3]) {
    let [column, row] = [at[0] as i64, at[1] as i64];
    cover(text, size, [0.0; 2], |x, y, share| {
        blend(image, column + y, row - 1 - x, colour, share);
    });
}

/// Calls `ink` with the column, the row and the covered share of each pixel of a line of text.
fn cover(text: &str, size: f32, at: [f32; 2], mut ink: impl FnMut(i64, i64, f32)) {
    for mut glyph in layout(text, size).0 {
        glyph.position += point(at[0], at[1]);
        let Some(outline) = FONT.outline_glyph(glyph) else { continue };
        let corner = outline.px_bounds().min;
        outline.draw(|x, y, coverage| {
            let (column, row) = (corner.x as i64 + i64::from(x), corner.y as i64 + i64::from(y));
            ink(column, row, coverage.min(1.0));
        });
    }
}

/// Breaks a text into lines of at most `room` pixels, between words where possible.
pub(crate) fn wrapped(text: &str, size: f32, room: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last().map_or("", String::as_str);
        let longer = if line.is_empty() { word.into() } else { format!("{line} {word}") };
        if line.is_empty() || width(&longer, size) <= room {
            lines.pop();
            lines.push(longer);
        } else {
            lines.push(word.into());
        }
    }
    lines
}

/// Letters of a line in their places, and its width.
fn layout(text: &str, size: f32) -> (Vec<Glyph>, f32) {
    let font = FONT.as_scaled(PxScale::from(size));
    let mut glyphs = Vec::new();
    let mut x = 0.0;
    for letter in text.chars() {
        let id = font.glyph_id(letter);
        if let Some(last) = glyphs.last() {
            let last: &Glyph = last;
            x += font.kern(last.id, id);
        }
        glyphs.push(id.with_scale_and_position(size, point(x, font.ascent())));
        x += font.h_advance(id);
    }
    (glyphs, x)
}

/// Lays ink over a pixel, if the picture has it; `share` is how much of the pixel is covered.
pub(crate) fn blend(image: &mut Image, column: i64, row: i64, colour: [u8; 3], share: f32) {
    let (Ok(column), Ok(row)) = (usize::try_from(column), usize::try_from(row)) else { return };
    if column < image.width && row < image.height {
        let pixel = &mut image.rgb[column + image.width * row];
        for (channel, &ink) in pixel.iter_mut().zip(&colour) {
            let paper = f32::from(*channel);
            *channel = (paper + (f32::from(ink) - paper) * share).round() as u8;
        }
    }
}
