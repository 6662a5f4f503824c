//! Hydraulic erosion by the water that flows (thesis, section 4.3.1), and avalanches that widen
//! channels.
//!
//! [`flow_map`] turns the water that nodes received into the flow f of equation 4.5; [`erode`]
//! integrates equation 4.4, or 4.6 with diffusion everywhere and uplift. Process:
//! [`HydraulicErosion`].

mod equation;
mod flow_map;
mod params;
#[cfg(test)]
mod tests;

pub use equation::{Change, compact_laplacian, erode};
pub use flow_map::{additional_flow, flow_map, relative_flow};
pub use params::{Diffusion, HydraulicErosion};
