//! Where water would flow on a terrain: depressions, drainage and their scaling laws.
//!
//! All of it works on a [`Grid`](crate::grid::Grid) and heights in metres, NaN where there are
//! no data. Water moves between 8 neighbours and leaves at outlets: cells on the edge of the grid
//! and beside no-data.

mod depressions;
mod directions;
mod drainage;
mod fill;
mod flats;
mod infinity;
mod links;
mod scaling;
mod streams;
#[cfg(test)]
mod testing;

pub use depressions::Depressions;
pub use directions::FlowDirections;
pub use drainage::Drainage;
pub use fill::fill_depressions;
pub use infinity::DInfinity;
pub use links::{StreamLink, stream_links, wet_cells};
pub use scaling::{
    AreaRange, PowerLaw, SlopeArea, area_exceedance, hack_exponent, longest_ways, slope_area,
};
pub use streams::{Horton, stream_orders};
