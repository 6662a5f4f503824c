//! Erosion where slope and drainage area together are too large, after Rodriguez-Iturbe and
//! Rinaldo.
//!
//! The water that passes a site is proportional to the area A that the site drains, and the
//! depth of a river grows as the square root of its water, so the shear stress on its bed grows as
//! `sqrt(A) S`, with S the slope to the neighbour that takes the water. Where it is above a
//! threshold the site is lowered until it is not. That steepens the slopes of the sites above,
//! turns the water of others, and so sets off more events: the terrain organises itself into a
//! state where no site is above the threshold.
//!
//! Kernels: [`drain`] and [`unstable_sites`]. Process: [`SlopeAreaErosion`].

mod kernel;
mod params;
mod plugin;
#[cfg(test)]
mod tests;

pub use kernel::{Event, drain, unstable_sites};
pub use params::{Pits, SlopeAreaErosion};
pub(crate) use plugin::drainage_area_log10;
pub use plugin::{DrainageArea, ErodingSites};
