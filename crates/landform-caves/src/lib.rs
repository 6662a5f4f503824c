//! Caves that dissolving water makes (thesis, sections 2.3.4 and 2.4.2 and chapter 5).
//!
//! [`rock`] makes the porosity of voxels. [`stage_one`] lets protochannels grow from sources before
//! anything breaks through. Then channels grow: [`pressure`] keeps pressure at what rock and channels
//! allow, [`water`] flows down the pressure, [`erosion`] dissolves rock where it flows, and
//! [`passages`] knows what hangs together.

pub mod courses;
pub mod erosion;
mod error;
pub mod growth;
pub mod passages;
mod place;
pub mod pressure;
pub mod record;
pub mod rock;
pub mod stage_one;
pub mod water;

pub use error::CaveError;
pub use place::{CaveSink, CaveSource, box_nodes, displacement, height, separation};
