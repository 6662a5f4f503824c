//! Hillslopes and valleys by the area that each node drains: equation 4.3 of the thesis, after Perron,
//! Dietrich and Kirchner 2008.
//!
//! Kernel: [`evolve`]. Process: [`AreaMapErosion`].

mod kernel;
mod params;
mod plugin;
#[cfg(test)]
mod tests;

pub use kernel::{Evolved, evolve};
pub use params::AreaMapErosion;
