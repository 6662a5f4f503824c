//! Marks of places where water comes in and goes out: the same colours and signs in all pictures.

use crate::Image;
use crate::text::blend;

/// What a mark stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Water comes in: a triangle that points down at its place.
    Source,
    /// Water goes out: a disc around its place.
    Sink,
}

impl Mark {
    /// Its colour, sRGB: blue and vermilion, which the colour-blind can tell apart (Okabe and Ito
    /// 2008).
    pub fn colour(self) -> [u8; 3] {
        match self {
            Self::Source => [0, 114, 178],
            Self::Sink => [213, 94, 0],
        }
    }

    /// Draws the mark with a white rim; its place is a column and a row in pixels from the top left
    /// corner, its size about its height in pixels.
    pub fn draw(self, image: &mut Image, [column, row]: [f32; 2], size: f32) {
        let rim = (0.12 * size).max(1.0);
        let reach = (size + rim + 1.0).min(1e4).ceil() as i64;
        let [left, top] = [column, row].map(|at| at.clamp(-1e6, 1e6).floor() as i64);
        for y in top - reach..=top + reach {
            for x in left - reach..=left + reach {
                let away = [x as f32 + 0.5 - column, y as f32 + 0.5 - row];
                let inside = self.depth(away, size);
                blend(image, x, y, [255; 3], (inside + rim + 0.5).clamp(0.0, 1.0));
                blend(image, x, y, self.colour(), (inside + 0.5).clamp(0.0, 1.0));
            }
        }
    }

    /// How far inside the mark a place lies, in pixels; negative outside.
    fn depth(self, [x, y]: [f32; 2], size: f32) -> f32 {
        match self {
            // An equilateral triangle on its point: the distance to the nearest of three sides.
            Self::Source => {
                let side = -y * 0.5 - x.abs() * 0.866;
                side.min(y + size)
            }
            Self::Sink => 0.45 * size - x.hypot(y),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_points_down_at_its_place_and_a_sink_lies_around_it() {
        let mut page = Image::filled(40, 40, [255; 3]).unwrap();
        Mark::Source.draw(&mut page, [20.0, 30.0], 20.0);
        assert_eq!(page.pixel(20, 15), Mark::Source.colour());
        assert_eq!(page.pixel(20, 34), [255; 3]);
        let mut page = Image::filled(40, 40, [255; 3]).unwrap();
        Mark::Sink.draw(&mut page, [20.0, 20.0], 20.0);
        for (x, y) in [(20, 20), (14, 20), (20, 26)] {
            assert_eq!(page.pixel(x, y), Mark::Sink.colour());
        }
        // What lies outside of the picture is cut.
        Mark::Sink.draw(&mut page, [-5.0, 1e9], 20.0);
    }
}
