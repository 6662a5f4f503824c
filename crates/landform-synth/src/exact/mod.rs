//! Fractals whose dimension is known, to test what measures dimensions, and as shapes: Koch's
//! curves, Cantor's set, Sierpinski's triangle and carpet, and Mandelbrot's squig.
//!
//! All fit into the unit square, or begin at 0, 0 and end at 1, 0.

mod cantor;
mod koch;
mod sierpinski;
mod squig;

pub use cantor::{CANTOR_DIMENSION, cantor_set};
pub use koch::{
    KOCH_DIMENSION, QUADRIC_KOCH_DIMENSION, koch_curve, koch_snowflake, quadric_koch_curve,
};
pub use sierpinski::{
    CARPET_DIMENSION, TRIANGLE_DIMENSION, sierpinski_carpet, sierpinski_carpet_rings,
    sierpinski_triangle,
};
pub use squig::{SQUIG_DIMENSION, squig};

use crate::SynthError;
use crate::error::Checks;

/// Refuses levels that would fill memory.
fn check_level(name: &'static str, level: u32, most: u32) -> Result<(), SynthError> {
    Checks(name).range("level", f64::from(level), 0.0..=f64::from(most))
}
