//! Maps of caves as those who survey caves draw them: plan and elevations with the walls as lines.
//!
//! 1. The passages are seen along an axis, without perspective. Of every sample the two nearest
//!    surfaces that face the viewer are kept (`layers`).
//! 2. Where a surface ends or steps, there is a wall: a whole line, or a dashed one where another
//!    passage hides it (`walls`).
//! 3. Passages are tinted by height. Scale bar, north arrow, heights, signs and words come on top
//!    (`sheet`).

mod layers;
mod sheet;
mod walls;

use crate::body::Body;
use crate::mark::Mark;
use crate::{ColourMap, Image, ViewError};

/// From where a cave is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaveView {
    /// From above, north at the top.
    Plan,
    /// From the south, west at the left.
    FromSouth,
    /// From the east, south at the left.
    FromEast,
}

impl CaveView {
    /// A place in metres as the viewer sees it: to the right, up, and towards the viewer.
    fn seen(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Plan => [x, y, z],
            Self::FromSouth => [x, z, -y],
            Self::FromEast => [y, z, x],
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Plan => "Plan",
            Self::FromSouth => "Elevation, seen from the south",
            Self::FromEast => "Elevation, seen from the east",
        }
    }
}

/// How a map of a cave is drawn.
#[derive(Clone, Debug)]
pub struct CaveMapOptions {
    /// The views, from the top of the page, all to the same scale.
    pub views: Vec<CaveView>,
    /// Pixels a metre.
    pub pixels_per_m: f64,
    /// Tints by height.
    pub colours: ColourMap,
    /// Lowest and highest corner of the block that holds the cave, in metres.
    pub block: [[f64; 3]; 2],
    /// Step between two surfaces, in metres, from which there is a wall between them.
    pub step_m: f64,
    /// Where water comes in and goes out, in metres.
    pub marks: Vec<(Mark, [f64; 3])>,
    /// Lines of words beside the views.
    pub words: Vec<String>,
}

impl CaveMapOptions {
    fn check(&self, body: &Body<'_>) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        check("views", self.views.len() as f64, [1.0, 3.0], "one to three views")?;
        check("pixels_per_m", self.pixels_per_m, [1e-6, 1e6], "from 1e-6 to 1e6")?;
        check("step_m", self.step_m, [1e-12, 1e12], "a length of more than 0")?;
        let [low, high] = self.block;
        for axis in 0..3 {
            let side = high[axis] - low[axis];
            check("block", side, [1e-9, 1e12], "a block of more than no size")?;
        }
        let marks = self.marks.iter().flat_map(|(_, place)| place);
        for &at in body.positions.iter().flatten().chain(marks).chain(&low) {
            check("a position", at, [-1e12, 1e12], "a number of at most 1e12")?;
        }
        let count = body.positions.len() as f64;
        for &vertex in body.triangles.iter().flatten() {
            check("a vertex", vertex.into(), [0.0, count - 1.0], "a vertex of the body")?;
        }
        Ok(())
    }
}

/// Draws the map of a cave: the surface of its passages, in metres. The same options give the same
/// bytes on any number of threads.
///
/// # Errors
/// [`ViewError::Option`] for options out of range, [`ViewError::TooSmall`] and
/// [`ViewError::TooLarge`] for pictures of no size or beyond memory.
pub fn draw(body: &Body<'_>, options: &CaveMapOptions) -> Result<Image, ViewError> {
    options.check(body)?;
    let views = options.views.iter().map(|&view| walls::draw(body, view, options));
    sheet::draw(&views.collect::<Result<Vec<_>, _>>()?, options)
}

#[cfg(test)]
mod tests;
