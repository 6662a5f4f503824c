//! Heights between level sets: the interior of islands (thesis, sections 4.2.4 and 4.3.4,
//! figures 4.8 and 4.16).
//!
//! Former coastlines are level sets of a terrain: [`Fronts`] of erosion that move on into the land
//! leave them behind, as [`mod@reference`] tells it line by line. [`LevelSets`] says which nodes lie
//! on them; three interpolants give heights to the others:
//!
//! | interpolant | surface |
//! |---|---|
//! | [`terraces`] | the lower of the two nearest level sets: flat steps |
//! | [`hermite`] | cubic from level set to level set, with one slope at each |
//! | [`relax_bending`] | the one of least bending energy, with level sets through or between nodes |
//!
//! In all three a node keeps between the level set below it and the one above it, so level sets
//! never cross.

mod bending;
mod bounded;
mod distance;
mod fronts;
mod hermite;
mod levels;
mod multigrid;
mod plate;
pub mod reference;
mod sea_floor;
mod sparse;
#[cfg(test)]
mod testing;

pub use bending::{Relaxation, RelaxationLimits, bending_energy, relax_bending};
pub use fronts::{FrontFields, FrontRecord, FrontSettings, Fronts};
pub use hermite::hermite;
pub use levels::{Course, LevelSets, LevelSetsError, crossings, terraces};
pub use sea_floor::{SeaFloor, lay_sea_floor};
