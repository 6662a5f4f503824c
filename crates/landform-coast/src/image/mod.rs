//! Coasts as images: the form of the model for graphics processors (thesis, appendix B.1).
//!
//! Land and sea are the pixels of an image. Every iteration does the same to each of them: the
//! lengths of shore in the squares of 2 x 2 pixels are added up over the tiles of a coarse grid,
//! and a land pixel beside the sea falls if it is weaker than the force (equation 4.2) that
//! follows from the lengths of the nearest four tiles, blended bilinearly.
//!
//! All of it is done in whole numbers ([`numbers`]), so that processors and graphics processors
//! of any make give the same land, bit for bit:
//!
//! - [`ImageCoast::run`] on the processor, on all its threads;
//! - `GpuCoast` on a graphics processor (feature `gpu`);
//! - [`mod@reference`]: the same by the letter, for reading and for tests.

#[cfg(feature = "gpu")]
mod gpu;
pub mod numbers;
pub mod reference;
mod rows;
mod settings;
#[cfg(test)]
pub(crate) mod testing;

#[cfg(feature = "gpu")]
pub use gpu::{GpuCoast, GpuError};
pub use rows::ImageCoast;
pub use settings::{ImageCoastError, ImageCoastSettings};
