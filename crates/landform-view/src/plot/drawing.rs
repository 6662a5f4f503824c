//! Shapes on a page, which both kinds of file draw.

use crate::Image;

/// A colour, sRGB.
pub(crate) type Colour = [u8; 3];

/// A place on the page: columns from the left, rows from the top.
pub(crate) type Place = [f32; 2];

/// Which part of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of words; its place is at half the height of its letters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Words {
    pub text: String,
    pub at: Place,
    pub size: f32,
    pub anchor: Anchor,
    /// Whether the line runs upwards.
    pub upward: bool,
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A line through places; lengths of dashes and gaps in turn, none for a whole line.
    Stroke { places: Vec<Place>, width: f32, dashes: &'static [f32], colour: Colour },
    /// A filled polygon.
    Fill { corners: Vec<Place>, colour: Colour },
    /// A picture, stretched over a rectangle.
    Picture { image: Image, frame: Frame },
    /// Words.
    Words(Words),
}

/// A rectangle: left, top, right and bottom.
pub(crate) type Frame = [f32; 4];

/// A page with shapes, the first below the others.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Drawing {
    pub size: Place,
    /// Shapes and the rectangles that cut them.
    pub shapes: Vec<(Shape, Option<Frame>)>,
    /// The rectangle that cuts the shapes which are added.
    pub clip: Option<Frame>,
}

/// Ink of axes and words.
pub(crate) const INK: Colour = [20, 20, 20];

impl Drawing {
    pub fn add(&mut self, shape: Shape) {
        self.shapes.push((shape, self.clip));
    }

    /// A whole line.
    pub fn line(&mut self, from: Place, to: Place, width: f32, colour: Colour) {
        self.add(Shape::Stroke { places: vec![from, to], width, dashes: &[], colour });
    }

    /// A filled rectangle.
    pub fn fill(&mut self, [left, top, right, bottom]: Frame, colour: Colour) {
        let corners = vec![[left, top], [right, top], [right, bottom], [left, bottom]];
        self.add(Shape::Fill { corners, colour });
    }

    /// The border of a rectangle.
    pub fn frame(&mut self, [left, top, right, bottom]: Frame, width: f32, colour: Colour) {
        let places = vec![[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
        self.add(Shape::Stroke { places, width, dashes: &[], colour });
    }

    /// Words that run to the right.
    pub fn words(&mut self, text: &str, at: Place, size: f32, anchor: Anchor) {
        let text = text.to_owned();
        self.add(Shape::Words(Words { text, at, size, anchor, upward: false }));
    }
}
