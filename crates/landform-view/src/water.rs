//! Water that stands at one level.

use rayon::prelude::*;

use crate::ViewError;
use crate::light::{Rgb, decode, mix};
use crate::surface::Surface;

/// A water level and what the water looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Height of the surface in metres.
    pub level_m: f64,
    /// Colour of deep water, sRGB.
    pub colour: [u8; 3],
    /// Depth in metres at which about two thirds of the ground's colour are gone.
    pub clear_m: f64,
}

impl Water {
    /// Blue-green water at a level; it hides the ground at depths of a few `clear_m` metres.
    pub fn at(level_m: f64, clear_m: f64) -> Self {
        Self { level_m, colour: [38, 92, 120], clear_m }
    }

    pub(crate) fn check(&self) -> Result<(), ViewError> {
        let check = ViewError::check_option;
        check("water.level_m", self.level_m, [-1e12, 1e12], "a height in metres")?;
        let range = [f64::MIN_POSITIVE, f64::MAX];
        check("water.clear_m", self.clear_m, range, "a positive number of metres")
    }

    /// Colour of ground seen through `path_m` metres of water.
    pub(crate) fn over(&self, ground: Rgb, path_m: f64) -> Rgb {
        let deep = self.colour.map(decode);
        // Even a film of water darkens the ground, which makes the shore a line.
        let share = 1.0 - 0.8 * (-path_m / self.clear_m).exp();
        mix(ground, deep, share as f32)
    }

    /// Covers the nodes of a surface that lie below the level, seen from above.
    pub(crate) fn cover(&self, surface: &Surface, colours: &mut [Rgb]) {
        colours.par_iter_mut().zip(&surface.heights).for_each(|(colour, &height)| {
            let depth = self.level_m - surface.metres(height);
            if depth > 0.0 {
                *colour = self.over(*colour, depth);
            }
        });
    }
}
