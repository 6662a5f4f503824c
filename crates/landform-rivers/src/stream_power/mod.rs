//! Mountains that rise and rivers that cut them down: the stream-power equation with creep, in years.
//!
//! Where the water of a node goes is found by [`Routes`], lakes included; [`incise`] lets all rivers
//! cut down for a time step of any length, [`Creep`] lets hillslopes creep. [`Evolution`] does all of
//! it in turn. Process: [`StreamPowerErosion`].

mod creep;
mod evolution;
mod flood;
mod incision;
mod params;
mod plugin;
#[cfg(test)]
mod reference;
mod routes;
mod steepest;
#[cfg(test)]
mod tests;

pub use creep::Creep;
pub use evolution::{Evolution, Evolved};
pub use incision::{StreamPowerLaw, incise};
pub use params::StreamPowerErosion;
pub use plugin::{ErosionRate, Uplift};
pub use routes::Routes;
