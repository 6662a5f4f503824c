//! What stands in a panel: points with errors, lines, areas, rules and notes.

/// A point of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Value along the horizontal axis.
    pub x: f64,
    /// Value along the vertical axis.
    pub y: f64,
    /// Ends of the error bar, as values along the vertical axis.
    pub error: Option<[f64; 2]>,
}

impl Point {
    /// A point without an error bar.
    pub fn new(x: f64, y: f64) -> Self {
        Self { x, y, error: None }
    }
}

/// How the points of a series are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// By a line.
    Solid,
    /// By dashes, for models and fits.
    Dashed,
    /// By dots.
    Dotted,
}

/// The shape of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Disc,
    /// A square.
    Square,
    /// A triangle.
    Triangle,
    /// A square on its corner.
    Diamond,
    /// A small disc, for many points.
    Dot,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name in the legend; none when empty.
    pub name: String,
    /// The points in the order of their line. What is not finite breaks the line.
    pub points: Vec<Point>,
    /// How they are joined; not at all without it.
    pub line: Option<Line>,
    /// Their shape; none without it.
    pub marker: Option<Marker>,
    /// Number of the colour. Without it series take their colours in order.
    pub colour: Option<usize>,
    /// Width of the line in units; the usual one without it.
    pub width: Option<f64>,
}

impl Series {
    /// A series without line and marker, which the caller chooses.
    pub fn new(name: impl Into<String>, points: Vec<Point>) -> Self {
        Self { name: name.into(), points, line: None, marker: None, colour: None, width: None }
    }
}

/// A filled polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Its corners as values along both axes. An area with a corner that cannot be drawn is left
    /// out.
    pub corners: Vec<[f64; 2]>,
    /// Its colour, sRGB.
    pub colour: [u8; 3],
}

/// A dotted rule across a panel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// At a value of the vertical axis.
    Horizontal(f64),
    /// At a value of the horizontal axis.
    Vertical(f64),
}

/// Words in a panel, which begin at a place.
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// Values along both axes.
    pub at: [f64; 2],
    /// The words.
    pub text: String,
}
